/* `muster sim --view` as those who look on have it: it shows at once what they do while time stands
 * still, and when it is over it stays as long as they do. */
#define _GNU_SOURCE /* nftw() */
#include "stage.h"
#include "visitor.h"

#include <ftw.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <unistd.h>
#include <unity.h>

static struct loop loop;
static struct watch clock_watch;
static struct process sim;
static struct visitor visitor;
static char directory[64], run[96];

static void on_clock(struct watch *watch, uint32_t events)
{
    (void)events;
    loop_periods(watch->fd);
}

/* Until it has said this. */
static void says(const char *words)
{
    int64_t deadline_us = loop_now() + INT64_C(60000000);

    while (process_said(&sim, words) == NULL) {
        TEST_ASSERT_TRUE_MESSAGE(loop_now() < deadline_us, words);
        TEST_ASSERT_TRUE(loop_wait(&loop));
    }
}

static void ends(int status)
{
    int64_t deadline_us = loop_now() + INT64_C(60000000);

    while (!process_ended(&sim)) {
        TEST_ASSERT_TRUE_MESSAGE(loop_now() < deadline_us, "it does not end");
        TEST_ASSERT_TRUE(loop_wait(&loop));
    }
    TEST_ASSERT_EQUAL_INT(status, sim.status);
}

void setUp(void)
{
    const char *argv[] = {STAGE_MUSTER, "sim",     "--robots",
                          "native",     "--quiet", "--view=0",
                          "--out",      run,       STAGE_SCENARIOS "/paper-sim-leader-fault.yaml",
                          NULL};

    strcpy(directory, "/tmp/muster-looked-at-XXXXXX");
    TEST_ASSERT_NOT_NULL(mkdtemp(directory));
    snprintf(run, sizeof run, "%s/run", directory);
    TEST_ASSERT_TRUE(loop_open(&loop));
    clock_watch = (struct watch){.fd = loop_timer(20000), .ready = on_clock};
    TEST_ASSERT_TRUE(loop_watch(&loop, &clock_watch, EPOLLIN));
    process_start(&sim, &loop, argv, NULL);
    says("\n"); /* the whole line */
    visitor_join(&visitor, &sim);
}

static int forget(const char *path, const struct stat *status, int kind, struct FTW *where)
{
    (void)status;
    (void)kind;
    (void)where;
    return remove(path);
}

void tearDown(void)
{
    visitor_leave(&visitor);
    process_close(&sim);
    close(clock_watch.fd);
    loop_close(&loop);
    nftw(directory, forget, 8, FTW_DEPTH | FTW_PHYS);
}

static bool time_goes_on(const struct scene *scene)
{
    return scene->time_ms >= 100;
}

static bool robot_3_is_elsewhere(const struct scene *scene)
{
    const struct scene_robot *robot = &scene->robots[2];

    return robot->id == 3 && fabs(robot->x - 77) < 1e-9 && fabs(robot->y + 5) < 1e-9;
}

static bool robot_1_is_dead(const struct scene *scene)
{
    return scene->robots[0].id == 1 && !scene->robots[0].alive;
}

static bool another_formation_is_there(const struct scene *scene)
{
    return strcmp(scene->formation, "pair") == 0 && scene->vertex_count == 2;
}

static void what_is_done_while_time_stands_still_is_seen(void)
{
    visitor_see(&visitor, time_goes_on);
    visitor_ask(&visitor, "\"pause\"", "null");
    visitor_ask(&visitor, "\"move\",\"robot\":3,\"x\":77,\"y\":-5,\"theta\":0", "null");
    visitor_see(&visitor, robot_3_is_elsewhere);
    int32_t stood = visitor.scene.time_ms;
    visitor_ask(&visitor, "\"kill\",\"robot\":1", "null");
    visitor_see(&visitor, robot_1_is_dead);
    visitor_ask(&visitor, "\"draw\",\"name\":\"pair\",\"L\":[0,1],\"psi\":[0,0]", "null");
    visitor_see(&visitor, another_formation_is_there);
    TEST_ASSERT_EQUAL_INT32(stood, visitor.scene.time_ms);
    visitor_leave(&visitor);
    process_signal(&sim, SIGTERM);
    ends(1);
}

static void it_stays_as_long_as_somebody_looks_on(void)
{
    char summary[128];

    visitor_see(&visitor, time_goes_on);
    visitor_ask(&visitor, "\"end\"", "null");
    says("the page stays");
    snprintf(summary, sizeof summary, "%s/summary.json", run);
    TEST_ASSERT_EQUAL_INT(0, access(summary, R_OK));
    visitor_ask(&visitor, "\"kill\",\"robot\":1", "the run is over");
    TEST_ASSERT_FALSE(process_ended(&sim));
    visitor_leave(&visitor);
    ends(1); /* it was interrupted */
}

static void a_signal_ends_its_stay(void)
{
    visitor_see(&visitor, time_goes_on);
    visitor_ask(&visitor, "\"end\"", "null");
    says("the page stays");
    process_signal(&sim, SIGINT);
    ends(1);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(what_is_done_while_time_stands_still_is_seen);
    RUN_TEST(it_stays_as_long_as_somebody_looks_on);
    RUN_TEST(a_signal_ends_its_stay);
    return UNITY_END();
}
