/* process.h: a child process of a test: what it says, and how it ends. */
#ifndef PROCESS_H
#define PROCESS_H

#include "loop.h"

#include <stddef.h>
#include <sys/types.h>

struct process {
    struct watch output; /* its stdout and stderr */
    struct loop *loop;
    const char *name;
    pid_t pid;  /* 0: it does not run */
    int input;  /* its stdin; -1: none */
    int status; /* of its end: the exit status, or minus the signal */
    char *said; /* everything, with a NUL */
    size_t length;
    size_t heard; /* where process_said() begins to look */
};

/* The child's ends, if they are not to be the ordinary ones. */
struct process_options {
    const char *preload; /* a library in LD_PRELOAD; NULL: none */
    int output;          /* for its stdout and stderr; 0: a pipe that is read */
};

/* Starts it anew; what an earlier child of it has said stays. Never outlives the test. The test
 * fails when it cannot be started. */
void process_start(struct process *process, struct loop *loop, const char *const argv[],
                   const struct process_options *options);

/* Where in the output these words stand, since `heard`; NULL: not yet. */
const char *process_said(const struct process *process, const char *words);

/* One line to its stdin. */
void process_tell(const struct process *process, const char *line);

/* Whether it has ended; its status is there then. */
bool process_ended(struct process *process);

void process_signal(const struct process *process, int number);

/* Resident memory, bytes. */
size_t process_memory(const struct process *process);

/* Ends it if it still runs, and forgets everything. */
void process_close(struct process *process);

#endif
