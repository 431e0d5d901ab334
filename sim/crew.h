/* crew.h: a few threads that share out independent jobs, again and again. */
#ifndef CREW_H
#define CREW_H

#include <stddef.h>

struct crew;

typedef void crew_job(void *context, size_t index);

/* NULL when the threads cannot be started. The caller is one of `threads` >= 1. */
struct crew *crew_new(unsigned threads);

/* Runs job(context, 0..count-1), each once, in any order, and returns when all are done. */
void crew_run(struct crew *crew, size_t count, crew_job *job, void *context);

void crew_free(struct crew *crew);

#endif
