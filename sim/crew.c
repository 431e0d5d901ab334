#include "crew.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>

/* Who waits looks this often before it goes to sleep: a tick of native robots takes less time
 * than to be woken. */
#define PATIENCE 1000

/* Of a cache. */
#define LINE_BYTES 64

struct worker {
    _Alignas(LINE_BYTES) atomic_size_t next; /* of its jobs; others may take it too */
    size_t end;
    struct crew *crew;
    pthread_t thread;
};

struct crew {
    unsigned count; /* of workers, the caller being the first */
    struct worker *worker;
    pthread_mutex_t lock;
    pthread_cond_t begun, ended;
    atomic_uint runs; /* begun so far */
    atomic_uint busy; /* workers beside the caller that have not ended the last one */
    crew_job *job;    /* NULL: leave */
    void *context;
};

/* Every worker begins with jobs that it had in the last run too, whose memory its cache may still
 * hold, and then helps the others. */
static void work(struct worker *self)
{
    struct crew *crew = self->crew;
    size_t me = (size_t)(self - crew->worker);

    for (size_t i = 0; i < crew->count; i++) {
        struct worker *whose = &crew->worker[(me + i) % crew->count];
        size_t index;

        while ((index = atomic_fetch_add(&whose->next, 1)) < whose->end)
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
    for (size_t i = 0; i < crew->count; i++) {
        crew->worker[i].next = count * i / crew->count;
        crew->worker[i].end = count * (i + 1) / crew->count;
    }
    crew->job = job;
    crew->context = context;
    crew->busy = crew->count - 1;
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

static void *worker_main(void *argument)
{
    struct worker *self = argument;
    struct crew *crew = self->crew;

    for (unsigned run = 1;; run++) {
        wait_for(crew, &crew->runs, run, &crew->begun);
        if (crew->job == NULL)
            return NULL;
        work(self);
        end(crew);
    }
}

/* How many of the workers there are. */
static unsigned hire(struct crew *crew, unsigned wanted)
{
    unsigned count = 0;

    while (count < wanted) {
        struct worker *worker = &crew->worker[count];

        *worker = (struct worker){.crew = crew};
        if (count > 0 && pthread_create(&worker->thread, NULL, worker_main, worker) != 0)
            break;
        count++;
    }
    return count;
}

struct crew *crew_new(unsigned threads)
{
    struct crew *crew = calloc(1, sizeof *crew);

    if (crew == NULL)
        return NULL;
    pthread_mutex_init(&crew->lock, NULL);
    pthread_cond_init(&crew->begun, NULL);
    pthread_cond_init(&crew->ended, NULL);
    crew->worker = aligned_alloc(LINE_BYTES, threads * sizeof *crew->worker);
    if (crew->worker != NULL)
        crew->count = hire(crew, threads);
    if (crew->count == threads)
        return crew;
    crew_free(crew);
    return NULL;
}

void crew_run(struct crew *crew, size_t count, crew_job *job, void *context)
{
    begin(crew, count, job, context);
    work(&crew->worker[0]);
    wait_for(crew, &crew->busy, 0, &crew->ended);
}

void crew_free(struct crew *crew)
{
    if (crew == NULL)
        return;
    begin(crew, 0, NULL, NULL);
    for (unsigned i = 1; i < crew->count; i++)
        pthread_join(crew->worker[i].thread, NULL);
    pthread_mutex_destroy(&crew->lock);
    pthread_cond_destroy(&crew->begun);
    pthread_cond_destroy(&crew->ended);
    free(crew->worker);
    free(crew);
}
