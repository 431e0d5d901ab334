#include "crew.h"

#include <errno.h>
#include <pthread.h>
#include <stdatomic.h>
#include <string.h>
#include <unity.h>

#define JOBS_MAX 100000

static atomic_uint done[JOBS_MAX + 1];
static int starts_left; /* threads that can still be started; -1: any number */

/* Linked in place of the original, which it calls (ld --wrap). */
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
                          void *(*routine)(void *), void *argument);
int __real_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
                          void *(*routine)(void *), void *argument);

int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
                          void *(*routine)(void *), void *argument)
{
    if (starts_left == 0)
        return EAGAIN;
    if (starts_left > 0)
        starts_left--;
    return __real_pthread_create(thread, attributes, routine, argument);
}

void setUp(void)
{
    memset(done, 0, sizeof done);
    starts_left = -1;
}

void tearDown(void)
{
}

static void do_job(void *context, size_t index)
{
    atomic_uint *counts = context;

    atomic_fetch_add(&counts[index], 1);
}

static void assert_done(size_t count, unsigned times)
{
    for (size_t i = 0; i < count; i++)
        TEST_ASSERT_EQUAL_UINT(times, done[i]);
    for (size_t i = count; i <= JOBS_MAX; i++)
        TEST_ASSERT_EQUAL_UINT(0, done[i]);
}

static void test_every_job_is_done_once(void)
{
    static const size_t counts[] = {0, 1, 2, 7, JOBS_MAX};

    for (unsigned threads = 1; threads <= 8; threads++) {
        struct crew *crew = crew_new(threads);

        TEST_ASSERT_NOT_NULL(crew);
        for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++) {
            setUp();
            crew_run(crew, counts[i], do_job, done);
            assert_done(counts[i], 1);
        }
        crew_free(crew);
    }
}

static void test_a_crew_works_again_and_again(void)
{
    struct crew *crew = crew_new(3);

    TEST_ASSERT_NOT_NULL(crew);
    for (unsigned run = 1; run <= 2000; run++) {
        crew_run(crew, 5, do_job, done);
        for (size_t i = 0; i < 5; i++)
            TEST_ASSERT_EQUAL_UINT(run, done[i]); /* before crew_run() returns */
    }
    assert_done(5, 2000);
    crew_free(crew);
}

/* Jobs that wait for one another can only all be done by as many threads. */
static void meet(void *context, size_t index)
{
    (void)index;
    pthread_barrier_wait(context);
}

static void test_as_many_threads_work_as_were_asked_for(void)
{
    struct crew *crew = crew_new(4);
    pthread_barrier_t barrier;

    TEST_ASSERT_NOT_NULL(crew);
    TEST_ASSERT_EQUAL_INT(0, pthread_barrier_init(&barrier, NULL, 4));
    crew_run(crew, 4, meet, &barrier);
    pthread_barrier_destroy(&barrier);
    crew_free(crew);
}

/* The first two jobs are one worker's, if it gets to do them all. */
static void meet_if_early(void *context, size_t index)
{
    if (index < 2)
        meet(context, index);
}

static void test_who_is_done_helps_the_others(void)
{
    struct crew *crew = crew_new(2);
    pthread_barrier_t barrier;

    TEST_ASSERT_NOT_NULL(crew);
    TEST_ASSERT_EQUAL_INT(0, pthread_barrier_init(&barrier, NULL, 2));
    crew_run(crew, 4, meet_if_early, &barrier);
    pthread_barrier_destroy(&barrier);
    crew_free(crew);
}

/* Long enough for all who wait to fall asleep; how long does not matter. */
static void dawdle(void *context, size_t index)
{
    volatile unsigned steps = index == 0 ? 20000000 : 0;

    while (steps > 0)
        steps--;
    do_job(context, index);
}

static void test_who_sleeps_is_woken(void)
{
    struct crew *crew = crew_new(4);
    atomic_uint beside = 0;

    TEST_ASSERT_NOT_NULL(crew);
    for (unsigned run = 1; run <= 5; run++) {
        crew_run(crew, 3, dawdle, done); /* the others and perhaps the caller wait for one */
        dawdle(&beside, 0);              /* the others wait for the caller */
        for (size_t i = 0; i < 3; i++)
            TEST_ASSERT_EQUAL_UINT(run, done[i]);
    }
    crew_free(crew);
}

static void note_thread(void *context, size_t index)
{
    ((pthread_t *)context)[index] = pthread_self();
}

static void test_a_crew_of_one_is_the_caller(void)
{
    pthread_t threads[10];

    starts_left = 0;
    struct crew *crew = crew_new(1);
    TEST_ASSERT_NOT_NULL(crew);
    crew_run(crew, 10, note_thread, threads);
    for (size_t i = 0; i < 10; i++)
        TEST_ASSERT_TRUE(pthread_equal(pthread_self(), threads[i]));
    crew_free(crew);
}

static void test_a_crew_that_cannot_be_hired_is_none(void)
{
    for (int starts = 0; starts < 5; starts++) {
        starts_left = starts;
        TEST_ASSERT_NULL(crew_new(6));
    }
}

/* Its threads may not have come to begin yet. */
static void test_a_crew_that_never_worked_can_be_dismissed(void)
{
    for (unsigned i = 0; i < 200; i++) {
        struct crew *crew = crew_new(2);

        TEST_ASSERT_NOT_NULL(crew);
        crew_free(crew);
    }
}

static void test_no_crew_can_be_dismissed(void)
{
    crew_free(NULL);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_every_job_is_done_once);
    RUN_TEST(test_a_crew_works_again_and_again);
    RUN_TEST(test_as_many_threads_work_as_were_asked_for);
    RUN_TEST(test_who_is_done_helps_the_others);
    RUN_TEST(test_who_sleeps_is_woken);
    RUN_TEST(test_a_crew_of_one_is_the_caller);
    RUN_TEST(test_a_crew_that_cannot_be_hired_is_none);
    RUN_TEST(test_a_crew_that_never_worked_can_be_dismissed);
    RUN_TEST(test_no_crew_can_be_dismissed);
    return UNITY_END();
}
