#include "crew.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>

struct crew {
    unsigned threads; /* beside the caller */
    pthread_t *thread;
    pthread_mutex_t door; /* shut until all are hired */
    pthread_barrier_t begin, end;
    bool hired, leaving;
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

    pthread_mutex_lock(&crew->door);
    bool hired = crew->hired;
    pthread_mutex_unlock(&crew->door);
    while (hired) {
        pthread_barrier_wait(&crew->begin);
        if (crew->leaving)
            break;
        work(crew);
        pthread_barrier_wait(&crew->end);
    }
    return NULL;
}

/* All or none: the barriers would wait for those that are missing. */
static bool hire(struct crew *crew)
{
    unsigned hired = 0;

    pthread_mutex_lock(&crew->door);
    while (hired < crew->threads && pthread_create(&crew->thread[hired], NULL, member, crew) == 0)
        hired++;
    crew->hired = hired == crew->threads;
    pthread_mutex_unlock(&crew->door);
    if (crew->hired)
        return true;
    for (unsigned i = 0; i < hired; i++)
        pthread_join(crew->thread[i], NULL);
    return false;
}

static void discard(struct crew *crew)
{
    pthread_mutex_destroy(&crew->door);
    pthread_barrier_destroy(&crew->begin);
    pthread_barrier_destroy(&crew->end);
    free(crew->thread);
    free(crew);
}

struct crew *crew_new(unsigned threads)
{
    struct crew *crew = calloc(1, sizeof *crew);

    if (crew == NULL)
        return NULL;
    crew->threads = threads - 1;
    pthread_mutex_init(&crew->door, NULL);
    pthread_barrier_init(&crew->begin, NULL, threads);
    pthread_barrier_init(&crew->end, NULL, threads);
    crew->thread = calloc(threads, sizeof *crew->thread);
    if (crew->thread != NULL && hire(crew))
        return crew;
    discard(crew);
    return NULL;
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
    discard(crew);
}
