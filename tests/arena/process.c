#define _GNU_SOURCE /* pipe2() */
#include "process.h"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <unity.h>

#define CHUNK 4096

static void hear(struct watch *watch, uint32_t events)
{
    struct process *process = (struct process *)watch;
    char *grown = realloc(process->said, process->length + CHUNK + 1);

    (void)events;
    TEST_ASSERT_NOT_NULL(grown);
    process->said = grown;
    ssize_t count = read(watch->fd, grown + process->length, CHUNK);
    if (count > 0)
        process->length += (size_t)count;
    else
        loop_forget(process->loop, watch);
    grown[process->length] = '\0';
}

static void become(const char *const argv[], const struct process_options *options, int input,
                   int output, pid_t parent)
{
    sigset_t none;

    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, NULL);
    signal(SIGPIPE, SIG_DFL);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent || dup2(input, STDIN_FILENO) < 0 || dup2(output, STDOUT_FILENO) < 0 ||
        dup2(output, STDERR_FILENO) < 0)
        _exit(127);
    if (options->preload != NULL)
        setenv("LD_PRELOAD", options->preload, 1);
    execv(argv[0], (char *const *)argv);
    _exit(127);
}

static void close_fds(struct process *process)
{
    loop_forget(process->loop, &process->output);
    if (process->output.fd > 0)
        close(process->output.fd);
    if (process->input > 0)
        close(process->input);
    process->output.fd = process->input = -1;
}

void process_start(struct process *process, struct loop *loop, const char *const argv[],
                   const struct process_options *options)
{
    static const struct process_options ordinary = {0};
    int input[2], output[2];
    pid_t parent = getpid();

    if (options == NULL)
        options = &ordinary;
    process->loop = loop;
    process->name = argv[1];
    close_fds(process);
    TEST_ASSERT_EQUAL_INT(0, pipe2(input, O_CLOEXEC));
    TEST_ASSERT_EQUAL_INT(0, pipe2(output, O_CLOEXEC));
    process->pid = fork();
    if (process->pid == 0)
        become(argv, options, input[0], options->output > 0 ? options->output : output[1], parent);
    TEST_ASSERT_TRUE_MESSAGE(process->pid > 0, "cannot fork");
    close(input[0]);
    close(output[1]);
    process->input = input[1];
    process->output = (struct watch){.fd = output[0], .ready = hear};
    TEST_ASSERT_TRUE(loop_watch(loop, &process->output, EPOLLIN));
}

const char *process_said(const struct process *process, const char *words)
{
    return process->said == NULL ? NULL : strstr(process->said + process->heard, words);
}

void process_tell(const struct process *process, const char *line)
{
    /* In one piece: the line may be the last one that is read. */
    TEST_ASSERT_EQUAL_INT(strlen(line) + 1, dprintf(process->input, "%s\n", line));
}

bool process_ended(struct process *process)
{
    int status;

    if (process->pid > 0 && waitpid(process->pid, &status, WNOHANG) == process->pid) {
        process->pid = 0;
        process->status = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }
    return process->pid == 0;
}

void process_signal(const struct process *process, int number)
{
    TEST_ASSERT_TRUE_MESSAGE(process->pid > 0, process->name);
    TEST_ASSERT_EQUAL_INT(0, kill(process->pid, number));
}

size_t process_memory(const struct process *process)
{
    char path[64];
    unsigned long pages = 0;

    snprintf(path, sizeof path, "/proc/%d/statm", (int)process->pid);
    FILE *file = fopen(path, "r");
    TEST_ASSERT_NOT_NULL(file);
    TEST_ASSERT_EQUAL_INT(1, fscanf(file, "%*u %lu", &pages));
    fclose(file);
    return pages * (size_t)sysconf(_SC_PAGESIZE);
}

void process_close(struct process *process)
{
    if (process->pid > 0) {
        kill(process->pid, SIGKILL);
        waitpid(process->pid, NULL, 0);
    }
    if (process->loop != NULL)
        close_fds(process);
    free(process->said);
    *process = (struct process){.input = -1};
}
