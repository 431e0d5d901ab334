/* process.h: programs that a measurement needs around it. */
#ifndef PROCESS_H
#define PROCESS_H

#include <stdio.h>
#include <sys/types.h>

struct process {
    const char *name, *argument; /* the first one */
    pid_t pid;
    FILE *out; /* what it prints */
};

/* Starts argv[0], which ends with this program. What cannot be started ends this program. */
struct process process_start(const char *const *argv);

/* Lets those that are measured go before it, where they have real-time priority. */
void process_give_way(pid_t pid);

/* Seconds of a processor that it has had, user's and kernel's. 0: this process itself. */
double process_cpu(pid_t pid);

/* Waits for its end; returns process_cpu() of its whole life. Any exit status but 0 ends this
 * program, with words. */
double process_wait(struct process *process);

/* Asks it to end, and waits. */
void process_stop(struct process *process);

#endif
