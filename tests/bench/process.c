#include "process.h"

#include <err.h>
#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

struct process process_start(const char *const *argv)
{
    struct process process = {.name = argv[0], .argument = argv[1]};
    int out[2];

    if (pipe(out) != 0 || (process.pid = fork()) < 0)
        err(EXIT_FAILURE, "%s", argv[0]);
    if (process.pid == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
        dup2(out[1], STDOUT_FILENO);
        close(out[0]);
        close(out[1]);
        execv(argv[0], (char *const *)argv);
        err(EXIT_FAILURE, "%s", argv[0]);
    }
    close(out[1]);
    process.out = fdopen(out[0], "r");
    if (process.out == NULL)
        err(EXIT_FAILURE, "%s", argv[0]);
    return process;
}

void process_give_way(pid_t pid)
{
    struct sched_param least = {.sched_priority = sched_get_priority_min(SCHED_FIFO)};

    if (sched_getscheduler(pid) == SCHED_FIFO && sched_setscheduler(pid, SCHED_FIFO, &least) != 0)
        warn("cannot change the priority of process %d", pid);
}

double process_cpu(pid_t pid)
{
    clockid_t clock;
    struct timespec had;

    if (clock_getcpuclockid(pid, &clock) != 0 || clock_gettime(clock, &had) != 0)
        errx(EXIT_FAILURE, "process %d is gone", pid);
    return (double)had.tv_sec + (double)had.tv_nsec / 1e9;
}

double process_wait(struct process *process)
{
    struct rusage usage;
    int status;

    if (wait4(process->pid, &status, 0, &usage) != process->pid)
        err(EXIT_FAILURE, "%s", process->name);
    fclose(process->out);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        errx(EXIT_FAILURE, "%s %s did not end well", process->name, process->argument);
    return (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
           (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec) / 1e6;
}

void process_stop(struct process *process)
{
    kill(process->pid, SIGTERM);
    process_wait(process);
}
