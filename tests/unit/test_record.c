#define _GNU_SOURCE /* fopencookie() */
#include "record.h"

#include "message.h"
#include "progress.h"
#include "tape.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <unity.h>

static char dir[] = "/tmp/muster-record-XXXXXX";
static char error[256];
static struct record *record;

static const struct recording_about about = {
    .scenario = "test", .robots = "native", .seed = 1, .duration = 10};
static struct scene_robot robots[2];
static struct scene scene;

/* What the audience was shown. */
static struct audience audience;
static int scenes, events;
static int32_t scene_time, event_time;
static struct scene shown;
static struct scene_robot shown_robots[2];
static char words[SCENE_EVENT_MAX];
static struct scene_event told;

/* In place of the clock's. */
static int64_t now_ns;

int64_t __wrap_wall_ns(void);

int64_t __wrap_wall_ns(void)
{
    return now_ns;
}

static const char *in_dir(const char *name)
{
    static char path[256];

    snprintf(path, sizeof path, "%s/%s", dir, name);
    return path;
}

static void see_scene(void *context, int32_t time_ms, const uint8_t *fleet, size_t count)
{
    TEST_ASSERT_EQUAL_PTR(&scenes, context);
    scenes++;
    scene_time = time_ms;
    TEST_ASSERT_TRUE(scene_read(&shown, shown_robots, 2, NULL, 0, fleet, count));
}

static void see_event(void *context, int32_t time_ms, const uint8_t *log, size_t count)
{
    TEST_ASSERT_EQUAL_PTR(&scenes, context);
    events++;
    event_time = time_ms;
    TEST_ASSERT_TRUE(scene_event_read(&told, words, log, count));
}

void setUp(void)
{
    memset(robots, 0, sizeof robots);
    robots[0].id = 7;
    robots[1].id = 65534;
    scene = (struct scene){.robot_count = 2, .robots = robots};
    audience = (struct audience){&scenes, NULL, NULL};
    scenes = events = 0;
    strcpy(dir + strlen(dir) - 6, "XXXXXX");
    TEST_ASSERT_NOT_NULL(mkdtemp(dir));
    error[0] = '\0';
    record = NULL;
}

void tearDown(void)
{
    unlink(in_dir("trace.csv"));
    unlink(in_dir("events.csv"));
    unlink(in_dir("run.mcap"));
    rmdir(dir);
}

static void open_record(bool trace)
{
    record = record_open(dir, &about, trace, &audience, error, sizeof error);
    TEST_ASSERT_NOT_NULL_MESSAGE(record, error);
}

static void close_record(void)
{
    TEST_ASSERT_TRUE_MESSAGE(record_close(record, error, sizeof error), error);
}

static void assert_file(const char *name, const char *expected)
{
    char text[4096];
    FILE *file = fopen(in_dir(name), "r");

    TEST_ASSERT_NOT_NULL(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    TEST_ASSERT_EQUAL_STRING(expected, text);
}

static void report(enum server_report_kind kind, uint16_t robot, uint32_t value, uint32_t was)
{
    record_event(record, 10060, &(struct server_report){kind, robot, value, was});
}

static void test_the_trace_has_a_row_per_robot_and_tick(void)
{
    robots[0] = (struct scene_robot){.id = 7,
                                     .x = -1.25,
                                     .y = 2,
                                     .theta = -3.1415927,
                                     .v = 0.5,
                                     .omega = -0.0625,
                                     .role = ROLE_LEADER,
                                     .vertex = 1,
                                     .alive = true,
                                     .distance_error = 0.0000004};
    robots[1] = (struct scene_robot){.id = 65534,
                                     .x = 1e3,
                                     .role = ROLE_CANDIDATE,
                                     .vertex = 1024,
                                     .distance_error = 12.3456789};

    open_record(true);
    record_scene(record, &scene);
    robots[1].role = ROLE_FOLLOWER;
    scene.time_ms = 86400000;
    record_scene(record, &scene);
    close_record();
    assert_file("trace.csv",
                "t,robot,x,y,theta,v,omega,role,vertex,distance_error,alive\n"
                "0.00,7,-1.250000,2.000000,-3.141593,0.500000,-0.062500,L,1,0.000000,1\n"
                "0.00,65534,1000.000000,0.000000,0.000000,0.000000,0.000000,C,1024,12.345679,0\n"
                "86400.00,7,-1.250000,2.000000,-3.141593,0.500000,-0.062500,L,1,0.000000,1\n"
                "86400.00,65534,1000.000000,0.000000,0.000000,0.000000,0.000000,F,1024,12.345679,"
                "0\n");
}

/* Beside the trace: the same scene and event as the audience is shown. */
static void test_a_run_with_a_trace_is_recorded(void)
{
    struct tape_message message;
    size_t fleet = 0, log = 0;

    audience.scene = see_scene;
    open_record(true);
    scene.time_ms = 40;
    robots[1].x = 0.125;
    record_scene(record, &scene);
    record_note(record, 60, 7, "mocap", "gone, for now");
    close_record();
    struct tape *tape = tape_open(dir, error, sizeof error);
    TEST_ASSERT_NOT_NULL_MESSAGE(tape, error);
    TEST_ASSERT_TRUE(tape_about(tape)->whole);
    TEST_ASSERT_EQUAL_STRING("native", tape_about(tape)->robots);
    while (tape_next(tape, &message)) {
        if (strcmp(message.topic, "/muster/fleet") == 0 && ++fleet > 0)
            see_scene(&scenes, message.time_ms, message.bytes, message.count);
        if (strcmp(message.topic, "/muster/events") == 0 && ++log > 0)
            see_event(&scenes, message.time_ms, message.bytes, message.count);
    }
    tape_close(tape);
    TEST_ASSERT_EQUAL_UINT(1, fleet);
    TEST_ASSERT_EQUAL_INT(2, scenes);
    TEST_ASSERT_EQUAL_INT32(40, scene_time);
    TEST_ASSERT_EQUAL_DOUBLE(0.125, shown_robots[1].x);
    TEST_ASSERT_EQUAL_UINT(1, log);
    TEST_ASSERT_EQUAL_INT32(60, event_time);
    TEST_ASSERT_EQUAL_STRING("gone, for now", told.detail);
}

static void assert_rows(const char *name, size_t rows)
{
    FILE *file = fopen(in_dir(name), "r");
    size_t lines = 0;

    TEST_ASSERT_NOT_NULL(file);
    for (int c; (c = fgetc(file)) != EOF;)
        lines += c == '\n';
    fclose(file);
    TEST_ASSERT_EQUAL_UINT(rows, lines - (lines > 0));
}

/* Of the clock on the wall: a simulation may be slow. */
static void test_the_files_have_what_is_a_second_old(void)
{
    now_ns = 5000000000;
    open_record(true);
    record_scene(record, &scene);
    assert_rows("trace.csv", 2);
    report(REPORT_ELECTION, 7, 1, 0);
    for (scene.time_ms = 20; scene.time_ms <= 100; scene.time_ms += 20) {
        now_ns += 240000000;
        record_scene(record, &scene);
        assert_rows("trace.csv", scene.time_ms < 100 ? 2 : 12);
        assert_rows("events.csv", scene.time_ms < 100 ? 0 : 1);
    }
    close_record();
}

static void test_without_a_trace_there_is_no_file(void)
{
    open_record(false);
    TEST_ASSERT_FALSE(record_wants_scenes(record));
    record_scene(record, &scene);
    close_record();
    TEST_ASSERT_TRUE(access(in_dir("trace.csv"), F_OK) != 0);
    TEST_ASSERT_TRUE(access(in_dir("run.mcap"), F_OK) != 0);
    assert_file("events.csv", "t,robot,event,detail\n");
}

/* ---- those who look on ----------------------------------------------------------------- */

static void given_an_audience(void)
{
    audience.scene = see_scene;
    audience.event = see_event;
}

static void test_a_scene_is_shown_as_it_is_recorded(void)
{
    given_an_audience();
    open_record(false);
    TEST_ASSERT_TRUE(record_wants_scenes(record));
    scene.time_ms = 1040;
    robots[1].x = 2.5;
    record_scene(record, &scene);
    close_record();
    TEST_ASSERT_EQUAL_INT(1, scenes);
    TEST_ASSERT_EQUAL_INT32(1040, scene_time);
    TEST_ASSERT_EQUAL_INT32(1040, shown.time_ms);
    TEST_ASSERT_EQUAL_UINT16(65534, shown_robots[1].id);
    TEST_ASSERT_EQUAL_DOUBLE(2.5, shown_robots[1].x);
}

static void test_what_is_only_shown_leaves_no_row(void)
{
    given_an_audience();
    open_record(true);
    record_show(record, &scene);
    close_record();
    TEST_ASSERT_EQUAL_INT(1, scenes);
    assert_file("trace.csv", "t,robot,x,y,theta,v,omega,role,vertex,distance_error,alive\n");
}

static void test_a_row_of_events_is_shown_as_well(void)
{
    given_an_audience();
    open_record(false);
    report(REPORT_VERTEX, 7, 2, 0);
    TEST_ASSERT_EQUAL_INT(1, events);
    TEST_ASSERT_EQUAL_INT32(10060, event_time);
    TEST_ASSERT_EQUAL_UINT16(7, told.robot);
    TEST_ASSERT_EQUAL_STRING("vertex_won", told.event);
    TEST_ASSERT_EQUAL_STRING("2", told.detail);
    record_note(record, 10080, 0, "mocap", "lost, and found");
    close_record();
    TEST_ASSERT_EQUAL_INT(2, events);
    TEST_ASSERT_EQUAL_STRING("lost, and found", told.detail);
    assert_file("events.csv", "t,robot,event,detail\n"
                              "10.06,7,vertex_won,2\n"
                              "10.08,0,mocap,lost; and found\n");
}

static void test_what_was_long_before_the_mission_is_shown_as_of_its_beginning(void)
{
    given_an_audience();
    open_record(false);
    record_note(record, -60000, 7, "link_up", "tcp");
    TEST_ASSERT_EQUAL_INT32(AUDIENCE_BEGIN_MS, event_time);
    TEST_ASSERT_EQUAL_INT32(AUDIENCE_BEGIN_MS, told.time_ms);
    record_note(record, -480, 7, "link_up", "tcp");
    close_record();
    TEST_ASSERT_EQUAL_INT32(-480, event_time);
    assert_file("events.csv", "t,robot,event,detail\n"
                              "-60.00,7,link_up,tcp\n"
                              "-0.48,7,link_up,tcp\n");
}

/* ---- events ---------------------------------------------------------------------------- */

static void test_every_report_is_a_row(void)
{
    open_record(false);
    record_event(record, -480, &(struct server_report){REPORT_ROLE, 7, ROLE_CANDIDATE, 0});
    report(REPORT_START, 0, 0, 0);
    report(REPORT_ROLE, 7, ROLE_LEADER, ROLE_CANDIDATE);
    report(REPORT_ELECTION, 7, 3, 2);
    report(REPORT_LINK, 7, 12, 10);
    report(REPORT_RESTART, 7, 0, 0);
    close_record();
    assert_file("events.csv", "t,robot,event,detail\n"
                              "-0.48,7,role,C\n"
                              "10.06,0,start,the mission begins\n"
                              "10.06,7,role,L\n"
                              "10.06,7,election,term 3\n"
                              "10.06,7,link_error,12 bad frames\n"
                              "10.06,7,restart,lost its mission and is given it again\n");
}

static void test_vertices_are_lost_and_won(void)
{
    open_record(false);
    report(REPORT_VERTEX, 7, 2, 0);
    report(REPORT_VERTEX, 7, 3, 2);
    report(REPORT_VERTEX, 7, 0, 3);
    close_record();
    assert_file("events.csv", "t,robot,event,detail\n"
                              "10.06,7,vertex_won,2\n"
                              "10.06,7,vertex_lost,2\n"
                              "10.06,7,vertex_won,3\n"
                              "10.06,7,vertex_lost,3\n");
}

static void test_faults_are_named(void)
{
    open_record(false);
    report(REPORT_FAULT, 7, FAULT_POSE_STALE | FAULT_LINK_LOST, 0);
    report(REPORT_FAULT, 7, FAULT_NO_ID | FAULT_STALL, 0);
    report(REPORT_FAULT, 7, FAULT_ESTOP | FAULT_REFUSED, 0);
    report(REPORT_FAULT, 7, FAULT_BATTERY | WARN_BATTERY, 0);
    report(REPORT_FAULT, 7, 0, FAULT_ESTOP);
    close_record();
    assert_file("events.csv", "t,robot,event,detail\n"
                              "10.06,7,fault,pose stale + link lost\n"
                              "10.06,7,fault,no id + stall\n"
                              "10.06,7,fault,emergency stop + mission refused\n"
                              "10.06,7,fault,battery critical + battery low\n"
                              "10.06,7,fault,none\n");
}

/* By the words of the scenario file. */
static void test_actions_have_the_scenarios_names(void)
{
    static const char *const names[] = {
        [EVENT_KILL] = "kill",           [EVENT_REVIVE] = "revive", [EVENT_STALL] = "stall",
        [EVENT_MUTE] = "mute",           [EVENT_UNMUTE] = "unmute", [EVENT_LOSS] = "loss",
        [EVENT_FORMATION] = "formation", [EVENT_DELAY] = "delay",   [EVENT_RANGE] = "range",
        [EVENT_PARTITION] = "partition", [EVENT_ESTOP] = "estop",   [EVENT_HEAL] = "heal",
        [EVENT_DRAIN] = "drain",
    };
    char expected[1024] = "t,robot,event,detail\n";

    open_record(false);
    for (uint32_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        size_t length = strlen(expected);

        report(REPORT_EVENT, 7, i, 0);
        snprintf(expected + length, sizeof expected - length, "10.06,7,%s,\n", names[i]);
    }
    close_record();
    assert_file("events.csv", expected);
}

static void test_a_directory_that_is_not_there_gives_words(void)
{
    rmdir(dir);
    TEST_ASSERT_NULL(record_open(dir, &about, true, NULL, error, sizeof error));
    TEST_ASSERT_NOT_NULL(strstr(error, "cannot write"));
    TEST_ASSERT_NOT_NULL(strstr(error, in_dir("events.csv")));
}

static void test_a_file_that_cannot_be_made_gives_words(void)
{
    TEST_ASSERT_EQUAL_INT(0, symlink("nowhere/at all", in_dir("trace.csv")));
    TEST_ASSERT_NULL(record_open(dir, &about, true, NULL, error, sizeof error));
    TEST_ASSERT_NOT_NULL(strstr(error, in_dir("trace.csv")));
}

static void assert_full_disk_noticed(const char *name, bool much)
{
    TEST_ASSERT_EQUAL_INT(0, symlink("/dev/full", in_dir(name)));
    open_record(true);
    for (int i = 0; i < (much ? 1000 : 1); i++) {
        scene.time_ms = i * 20;
        record_scene(record, &scene);
        report(REPORT_ELECTION, 7, 1, 0);
    }
    TEST_ASSERT_FALSE(record_close(record, error, sizeof error));
    TEST_ASSERT_NOT_NULL(strstr(error, dir));
    tearDown();
    setUp();
}

static void test_a_full_disk_gives_words(void)
{
    assert_full_disk_noticed("trace.csv", false);
    assert_full_disk_noticed("trace.csv", true);
    assert_full_disk_noticed("events.csv", false);
    assert_full_disk_noticed("events.csv", true);
    assert_full_disk_noticed("run.mcap", false);
    assert_full_disk_noticed("run.mcap", true);
}

/* A disk that is full for a moment. */
static ssize_t fail_once(void *cookie, const char *bytes, size_t count)
{
    bool *failed = cookie;

    (void)bytes;
    if (*failed)
        return (ssize_t)count;
    *failed = true;
    errno = ENOSPC;
    return 0;
}

static void test_a_row_lost_in_the_middle_is_not_forgotten(void)
{
    bool failed = false;
    FILE *file = fopencookie(&failed, "w", (cookie_io_functions_t){.write = fail_once});

    TEST_ASSERT_NOT_NULL(file);
    fputs("a row", file);
    fflush(file);
    fputs("another", file);
    TEST_ASSERT_FALSE(record_finish(file));
    TEST_ASSERT_TRUE(failed);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_trace_has_a_row_per_robot_and_tick);
    RUN_TEST(test_a_run_with_a_trace_is_recorded);
    RUN_TEST(test_the_files_have_what_is_a_second_old);
    RUN_TEST(test_without_a_trace_there_is_no_file);
    RUN_TEST(test_a_scene_is_shown_as_it_is_recorded);
    RUN_TEST(test_what_is_only_shown_leaves_no_row);
    RUN_TEST(test_a_row_of_events_is_shown_as_well);
    RUN_TEST(test_what_was_long_before_the_mission_is_shown_as_of_its_beginning);
    RUN_TEST(test_every_report_is_a_row);
    RUN_TEST(test_vertices_are_lost_and_won);
    RUN_TEST(test_faults_are_named);
    RUN_TEST(test_actions_have_the_scenarios_names);
    RUN_TEST(test_a_directory_that_is_not_there_gives_words);
    RUN_TEST(test_a_file_that_cannot_be_made_gives_words);
    RUN_TEST(test_a_full_disk_gives_words);
    RUN_TEST(test_a_row_lost_in_the_middle_is_not_forgotten);
    return UNITY_END();
}
