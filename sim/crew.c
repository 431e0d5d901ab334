#include "crew.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>

struct crew {
    unsigned threads; /* beside the caller */
    pthread_t *thread;
    pthread_barrier_t begin, end;
    bool leaving;
    atomic_size_t next;
    size_t count;
    crew_job *job;
    void *context;
};

static void work(struct crew *crew)
{
    for (;;) {
        size_t index = atomic_fetch_add(&crew->next, 1);

        if (index >= crew->count)
            return;
        crew->job(crew->context, index);
    }
}

static void *member(void *argument)
{
    struct crew *crew = argument;

    for (;;) {
        pthread_barrier_wait(&crew->begin);
        if (crew->leaving)
            return NULL;
        work(crew);
        pthread_barrier_wait(&crew->end);
    }
}

static bool hire(struct crew *crew)
{
    for (unsigned i = 0; i < crew->threads; i++) {
        if (pthread_create(&crew->thread[i], NULL, member, crew) == 0)
            continue;
        /* The barrier would wait for those that are missing. */
        for (unsigned j = 0; j < i; j++) {
            pthread_cancel(crew->thread[j]);
            pthread_join(crew->thread[j], NULL);
        }
        return false;
    }
    return true;
}

struct crew *crew_new(unsigned threads)
{
    struct crew *crew = calloc(1, sizeof *crew);

    if (crew == NULL)
        return NULL;
    crew->threads = threads - 1;
    crew->thread = calloc(threads, sizeof *crew->thread);
    if (crew->thread == NULL || pthread_barrier_init(&crew->begin, NULL, threads) != 0 ||
        pthread_barrier_init(&crew->end, NULL, threads) != 0 || !hire(crew)) {
        free(crew->thread);
        free(crew);
        return NULL;
    }
    return crew;
}

void crew_run(struct crew *crew, size_t count, crew_job *job, void *context)
{
    crew->count = count;
    crew->job = job;
    crew->context = context;
    atomic_store(&crew->next, 0);
    if (crew->threads == 0) {
        work(crew);
        return;
    }
    pthread_barrier_wait(&crew->begin);
    work(crew);
    pthread_barrier_wait(&crew->end);
}

void crew_free(struct crew *crew)
{
    if (crew == NULL)
        return;
    if (crew->threads > 0) {
        crew->leaving = true;
        pthread_barrier_wait(&crew->begin);
    }
    for (unsigned i = 0; i < crew->threads; i++)
        pthread_join(crew->thread[i], NULL);
    pthread_barrier_destroy(&crew->begin);
    pthread_barrier_destroy(&crew->end);
    free(crew->thread);
    free(crew);
}
