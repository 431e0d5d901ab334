#define _GNU_SOURCE /* memfd_create() */
#include "session.h"

#include "address.h"
#include "loop.h"

#include <arpa/inet.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>
#include <unity.h>

#define ROBOTS 2

/* A job, and the robot's end of its link. It is all one thread: the robot acts when its job is
 * called. */
struct pair {
    struct job job;
    int listener, robot;
    unsigned linked, lost;
    char heard[64]; /* by the job */
    void (*turn)(struct pair *pair);
};

static struct pair pair[ROBOTS];
static struct site_robot robots[ROBOTS];
static struct site site;
static char error[256];
static char *said; /* on stderr */
static const size_t chosen[] = {0, 1};
static struct session_watcher watcher;

static struct pair *pair_of(struct job *job)
{
    return (struct pair *)job;
}

static void linked(struct job *job, int64_t now_us)
{
    struct pair *self = pair_of(job);

    (void)now_us;
    self->linked++;
    self->robot = accept(self->listener, NULL, NULL);
    TEST_ASSERT_TRUE(self->robot >= 0);
}

static void lost(struct job *job, const char *words, int64_t now_us)
{
    (void)now_us;
    TEST_ASSERT_NOT_EQUAL('\0', words[0]);
    pair_of(job)->lost++;
}

static void received(struct job *job, const uint8_t *bytes, size_t count, int64_t now_us)
{
    (void)now_us;
    strncat(pair_of(job)->heard, (const char *)bytes, count);
}

static size_t send_nothing(struct job *job, int64_t now_us, uint8_t *bytes, size_t room)
{
    (void)now_us;
    (void)bytes;
    (void)room;
    if (pair_of(job)->turn != NULL)
        pair_of(job)->turn(pair_of(job));
    return 0;
}

static size_t send_hello(struct job *job, int64_t now_us, uint8_t *bytes, size_t room)
{
    (void)now_us;
    if (pair_of(job)->turn != NULL)
        pair_of(job)->turn(pair_of(job));
    if (room < 5 || job->state != JOB_WORKING)
        return 0;
    memcpy(bytes, "hello", 5);
    return 5;
}

static const struct job_kind silent = {linked, lost, received, NULL, send_nothing};
static const struct job_kind greeting = {linked, lost, received, NULL, send_hello};

static void open_pair(size_t i)
{
    struct sockaddr_in address = {
        .sin_family = AF_INET,
        .sin_addr.s_addr = htonl(INADDR_LOOPBACK),
    };
    int listener = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);

    TEST_ASSERT_EQUAL_INT(0, bind(listener, (const struct sockaddr *)&address, sizeof address));
    TEST_ASSERT_EQUAL_INT(0, listen(listener, 4));
    pair[i] = (struct pair){
        .job = {.kind = &silent, .robot = (uint16_t)(i + 1)},
        .listener = listener,
        .robot = -1,
    };
    robots[i] = (struct site_robot){
        .id = (uint16_t)(i + 1),
        .link = {.address = {.kind = LINK_TCP,
                             .name = "127.0.0.1",
                             .port = ntohs(address_bound(listener).sin_port)},
                 .adapter = -1,
                 .baud = 115200},
    };
}

void setUp(void)
{
    for (size_t i = 0; i < ROBOTS; i++)
        open_pair(i);
    site = (struct site){.robot_count = ROBOTS, .robots = robots};
    watcher = (struct session_watcher){.context = NULL};
    error[0] = '\0';
    said = NULL;
}

void tearDown(void)
{
    for (size_t i = 0; i < ROBOTS; i++) {
        if (pair[i].robot >= 0)
            close(pair[i].robot);
        if (pair[i].listener >= 0)
            close(pair[i].listener);
    }
    if (said != NULL)
        munmap(said, 4096);
}

/* What it says on stderr is in `said` then. */
static enum session_end run(double patience, bool quiet)
{
    const struct session_options options = {
        .patience = patience,
        .quiet = quiet,
        .watcher = watcher,
    };
    struct job *const jobs[] = {&pair[0].job, &pair[1].job};
    int before = dup(STDERR_FILENO), file = memfd_create("stderr", 0);

    TEST_ASSERT_EQUAL_INT(0, ftruncate(file, 4096));
    dup2(file, STDERR_FILENO);
    enum session_end end = session_run(&site, chosen, jobs, ROBOTS, &options, error, sizeof error);
    dup2(before, STDERR_FILENO);
    said = mmap(NULL, 4096, PROT_READ, MAP_PRIVATE, file, 0);
    close(before);
    close(file);
    return end;
}

static void finish(struct pair *self)
{
    if (self->linked > 0)
        job_done(&self->job, "all went well");
}

/* The robot echoes what it hears, and the job is done when it has come back. */
static void echo(struct pair *self)
{
    char bytes[64];
    ssize_t count = self->robot < 0 ? 0 : recv(self->robot, bytes, sizeof bytes, MSG_DONTWAIT);

    if (count > 0)
        TEST_ASSERT_EQUAL_INT(count, write(self->robot, bytes, (size_t)count));
    if (strstr(self->heard, "hello") != NULL)
        job_done(&self->job, "%s", "");
}

static void test_bytes_go_both_ways_until_all_jobs_are_done(void)
{
    for (size_t i = 0; i < ROBOTS; i++) {
        pair[i].job.kind = &greeting;
        pair[i].turn = echo;
    }
    TEST_ASSERT_EQUAL_INT(SESSION_DONE, run(60, false));
    TEST_ASSERT_EQUAL_STRING("", said);
    TEST_ASSERT_EQUAL_STRING("", error);
}

static void test_words_of_jobs_are_told_when_they_end(void)
{
    pair[0].turn = pair[1].turn = finish;
    TEST_ASSERT_EQUAL_INT(SESSION_DONE, run(60, false));
    TEST_ASSERT_NOT_NULL(strstr(said, "robot 1: all went well\n"));
    TEST_ASSERT_NOT_NULL(strstr(said, "robot 2: all went well\n"));
}

static void test_a_quiet_session_tells_of_failures_only(void)
{
    pair[0].turn = finish;
    close(pair[1].listener);
    pair[1].listener = -1;
    TEST_ASSERT_EQUAL_INT(SESSION_INCOMPLETE, run(0.3, true));
    TEST_ASSERT_NULL(strstr(said, "all went well"));
    TEST_ASSERT_NOT_NULL(strstr(said, "robot 2 (tcp:127.0.0.1:"));
}

static void test_a_link_that_does_not_come_up_fails_its_robot_in_its_own_words(void)
{
    pair[0].turn = finish;
    close(pair[1].listener);
    pair[1].listener = -1;
    TEST_ASSERT_EQUAL_INT(SESSION_INCOMPLETE, run(0.3, false));
    TEST_ASSERT_EQUAL_INT(JOB_DONE, pair[0].job.state);
    TEST_ASSERT_EQUAL_INT(JOB_FAILED, pair[1].job.state);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(pair[1].job.words, "nothing listens"), pair[1].job.words);
}

static void test_a_robot_that_is_linked_and_silent_fails_too(void)
{
    pair[0].turn = finish;
    TEST_ASSERT_EQUAL_INT(SESSION_INCOMPLETE, run(0.3, true));
    TEST_ASSERT_EQUAL_UINT(1, pair[1].linked);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(pair[1].job.words, "nothing heard"), pair[1].job.words);
}

static void hang_up_once(struct pair *self)
{
    if (self->linked == 1 && self->robot >= 0) {
        close(self->robot);
        self->robot = -1;
    }
    if (self->linked == 2)
        job_done(&self->job, "%s", "");
}

static void test_a_lost_link_is_dialled_again(void)
{
    pair[0].turn = hang_up_once;
    pair[1].turn = finish;
    TEST_ASSERT_EQUAL_INT(SESSION_DONE, run(60, true));
    TEST_ASSERT_EQUAL_UINT(1, pair[0].lost);
    TEST_ASSERT_EQUAL_UINT(2, pair[0].linked);
}

static void interrupt(struct pair *self)
{
    if (self->linked > 0)
        raise(SIGINT);
}

static void test_an_interrupt_ends_those_that_are_at_work(void)
{
    sigset_t after;

    pair[0].turn = interrupt;
    TEST_ASSERT_EQUAL_INT(SESSION_INTERRUPTED, run(60, false));
    TEST_ASSERT_EQUAL_INT(JOB_FAILED, pair[0].job.state);
    TEST_ASSERT_EQUAL_STRING("interrupted", pair[0].job.words);
    sigprocmask(SIG_SETMASK, NULL, &after);
    TEST_ASSERT_EQUAL_INT(0, sigismember(&after, SIGINT));
    TEST_ASSERT_EQUAL_INT(0, recv(pair[0].robot, &(char){0}, 1, 0));
}

static const char *stop_words;

static void put_right(struct pair *self)
{
    job_failed(&self->job, "%s, and all is as it was", stop_words);
}

static void stop(void *context, const char *words, int64_t now_us)
{
    (void)context;
    (void)now_us;
    stop_words = words;
    pair[0].turn = put_right;
}

/* Two seconds are what the other one has. */
static void test_who_is_told_of_an_interrupt_may_put_things_right(void)
{
    pair[0].turn = interrupt;
    watcher.stop = stop;
    TEST_ASSERT_EQUAL_INT(SESSION_INTERRUPTED, run(60, false));
    TEST_ASSERT_EQUAL_STRING("interrupted, and all is as it was", pair[0].job.words);
    TEST_ASSERT_EQUAL_INT(JOB_FAILED, pair[1].job.state);
    TEST_ASSERT_EQUAL_STRING("interrupted", pair[1].job.words);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_bytes_go_both_ways_until_all_jobs_are_done);
    RUN_TEST(test_words_of_jobs_are_told_when_they_end);
    RUN_TEST(test_a_quiet_session_tells_of_failures_only);
    RUN_TEST(test_a_link_that_does_not_come_up_fails_its_robot_in_its_own_words);
    RUN_TEST(test_a_robot_that_is_linked_and_silent_fails_too);
    RUN_TEST(test_a_lost_link_is_dialled_again);
    RUN_TEST(test_an_interrupt_ends_those_that_are_at_work);
    RUN_TEST(test_who_is_told_of_an_interrupt_may_put_things_right);
    return UNITY_END();
}
