#include "crew.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>

/* Who waits looks this often before it goes to sleep: a tick of native robots takes less time
 * than to be woken. */
#define PATIENCE 1000

/* Jobs are taken in shares, so many for each thread. */
#define SHARES 64

struct crew {
    unsigned threads; /* beside the caller */
    pthread_t *thread;
    pthread_mutex_t lock;
    pthread_cond_t begun, ended;
    atomic_uint runs; /* begun so far */
    atomic_uint busy; /* threads that have not ended the last one */
    atomic_size_t next;
    size_t count, share;
    crew_job *job; /* NULL: leave */
    void *context;
};

static void work(struct crew *crew)
{
    for (;;) {
        size_t index = atomic_fetch_add(&crew->next, crew->share);
        size_t end = index + crew->share < crew->count ? index + crew->share : crew->count;

        if (index >= crew->count)
            return;
        for (; index < end; index++)
            crew->job(crew->context, index);
    }
}

static void wait_for(struct crew *crew, atomic_uint *number, unsigned value,
                     pthread_cond_t *changed)
{
    for (unsigned i = 0; i < PATIENCE; i++) {
        if (*number == value)
            return;
        sched_yield();
    }
    pthread_mutex_lock(&crew->lock);
    while (*number != value)
        pthread_cond_wait(changed, &crew->lock);
    pthread_mutex_unlock(&crew->lock);
}

static void begin(struct crew *crew, size_t count, crew_job *job, void *context)
{
    crew->count = count;
    crew->share = 1 + count / (SHARES * (crew->threads + 1));
    crew->job = job;
    crew->context = context;
    crew->next = 0;
    crew->busy = crew->threads;
    pthread_mutex_lock(&crew->lock);
    crew->runs++;
    pthread_mutex_unlock(&crew->lock);
    pthread_cond_broadcast(&crew->begun);
}

static void end(struct crew *crew)
{
    pthread_mutex_lock(&crew->lock);
    crew->busy--;
    pthread_mutex_unlock(&crew->lock);
    pthread_cond_signal(&crew->ended);
}

static void *member(void *argument)
{
    struct crew *crew = argument;

    for (unsigned run = 1;; run++) {
        wait_for(crew, &crew->runs, run, &crew->begun);
        if (crew->job == NULL)
            return NULL;
        work(crew);
        end(crew);
    }
}

struct crew *crew_new(unsigned threads)
{
    struct crew *crew = calloc(1, sizeof *crew);

    if (crew == NULL)
        return NULL;
    pthread_mutex_init(&crew->lock, NULL);
    pthread_cond_init(&crew->begun, NULL);
    pthread_cond_init(&crew->ended, NULL);
    crew->thread = calloc(threads, sizeof *crew->thread);
    while (crew->thread != NULL && crew->threads + 1 < threads &&
           pthread_create(&crew->thread[crew->threads], NULL, member, crew) == 0)
        crew->threads++;
    if (crew->thread != NULL && crew->threads + 1 == threads)
        return crew;
    crew_free(crew);
    return NULL;
}

void crew_run(struct crew *crew, size_t count, crew_job *job, void *context)
{
    begin(crew, count, job, context);
    work(crew);
    wait_for(crew, &crew->busy, 0, &crew->ended);
}

void crew_free(struct crew *crew)
{
    if (crew == NULL)
        return;
    begin(crew, 0, NULL, NULL);
    for (unsigned i = 0; i < crew->threads; i++)
        pthread_join(crew->thread[i], NULL);
    pthread_mutex_destroy(&crew->lock);
    pthread_cond_destroy(&crew->begun);
    pthread_cond_destroy(&crew->ended);
    free(crew->thread);
    free(crew);
}
