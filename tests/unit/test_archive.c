#include "archive.h"

#include "facts.h"
#include "message.h"
#include "recording.h"
#include "story.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <unity.h>

#define ROBOTS 2
#define TICKS 150
#define DIES 50 /* the tick at which robot 7 does, and another formation is in force */

static const char head[] = "t,robot,x,y,theta,v,omega,role,vertex,distance_error,alive\n";

static char dir[] = "/tmp/muster-archive-XXXXXX";
static char error[512];
static char *paths[4];
static size_t path_count;
static struct archive **archives;

static const char *in_dir(const char *name)
{
    static char path[256];

    snprintf(path, sizeof path, "%s/%s", dir, name);
    return path;
}

/* Adds a folder that is to be read. */
static void given_folder(const char *name)
{
    paths[path_count] = strdup(in_dir(name));
    TEST_ASSERT_NOT_NULL(paths[path_count]);
    mkdir(paths[path_count++], 0700);
}

static void given_file(const char *name, const char *text)
{
    FILE *file = fopen(in_dir(name), "w");

    TEST_ASSERT_NOT_NULL(file);
    fputs(text, file);
    fclose(file);
}

void setUp(void)
{
    strcpy(dir + strlen(dir) - 6, "XXXXXX");
    TEST_ASSERT_NOT_NULL(mkdtemp(dir));
    error[0] = '\0';
    path_count = 0;
    archives = NULL;
}

void tearDown(void)
{
    static const char *const names[] = {"trace.csv", "events.csv", "summary.json", "run.mcap"};
    char path[512];

    if (archives != NULL)
        archive_free_all(archives, path_count);
    while (path_count > 0) {
        char *folder = paths[--path_count];

        for (size_t i = 0; i < 4; i++) {
            snprintf(path, sizeof path, "%s/%s", folder, names[i]);
            unlink(path);
        }
        rmdir(folder);
        free(folder);
    }
    rmdir(in_dir("x"));
    rmdir(in_dir("y"));
    rmdir(dir);
}

static const struct archive *read_first(void)
{
    archives = archive_read_all(paths, path_count, error, sizeof error);
    TEST_ASSERT_NOT_NULL_MESSAGE(archives, error);
    return archives[0];
}

static void refused(const char *words)
{
    archives = archive_read_all(paths, path_count, error, sizeof error);
    TEST_ASSERT_NULL(archives);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(error, words), error);
}

/* ---- trace.csv ------------------------------------------------------------------------- */

static void given_trace(const char *name, const char *rows)
{
    char text[1024];

    snprintf(text, sizeof text, "%s%s", head, rows);
    given_file(name, text);
}

static void a_trace_is_read_row_by_row(void)
{
    given_folder("a");
    given_trace("a/trace.csv", "0.00,7,1.5,-2,0.25,0.1,-0.5,L,1,0.125,1\n"
                               "0.00,12,3,4,-1,0,0,F,2,0.5,1\n"
                               "0.02,7,1.5,-2,0.25,0.1,-0.5,L,1,0.25,0\n"
                               "0.02,12,3,4,-1,0,0,C,0,0.75,1\n");
    const struct history *history = &read_first()->history;
    const struct glimpse *g = history_at(history, 0, 0);

    TEST_ASSERT_EQUAL_UINT(2, history->robots);
    TEST_ASSERT_EQUAL_UINT(2, history->ticks);
    TEST_ASSERT_EQUAL_UINT(7, history->id[0]);
    TEST_ASSERT_EQUAL_UINT(12, history->id[1]);
    TEST_ASSERT_TRUE(history_time(history, 1) == 0.02);
    TEST_ASSERT_TRUE(g->x == 1.5f && g->y == -2 && g->theta == 0.25f && g->omega == -0.5f);
    TEST_ASSERT_TRUE(g->error == 0.125f && g->alive && g->role == ROLE_LEADER && g->vertex == 1);
    TEST_ASSERT_FALSE(history_at(history, 1, 0)->alive);
    TEST_ASSERT_EQUAL_UINT(ROLE_CANDIDATE, history_at(history, 1, 1)->role);
    TEST_ASSERT_TRUE(history_mean_error(history, 1) == 0.75);
    TEST_ASSERT_NULL(archives[0]->summary);
    TEST_ASSERT_TRUE(archive_end(archives[0]) == 0.02);
}

static void a_trace_ends_where_it_is_torn(void)
{
    given_folder("a");
    given_trace("a/trace.csv", "0.00,1,1,2,0,0,0,L,1,0,1\n"
                               "0.00,2,3,4,0,0,0,F,2,0,1\n"
                               "0.02,1,1,2,0,0,0,L,1,0,1\n"
                               "0.02,2,3,4,0,0,0,F,2,0,1\n"
                               "0.04,1,1,2,0,0,0,L,1,0,1\n"
                               "0.04,2,3,4,0,0,0,F,2,0,");
    TEST_ASSERT_EQUAL_UINT(2, read_first()->history.ticks);
}

static void a_row_that_is_none_is_not_taken(void)
{
    static const char *const rows[] = {"", "this,is,no,row\n", "0.00,1,nan,2,0,0,0,L,1,0,1\n",
                                       "0.00,1,1,2,0,0,0,X,1,0,1\n", "0.00,1,1,2,0,0,0,L,1,0,1"};

    given_folder("a");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        given_trace("a/trace.csv", rows[i]);
        refused("a/trace.csv: not one good row is in it");
    }
}

static void events_are_told_in_words(void)
{
    struct story stories[4];

    given_folder("a");
    given_trace("a/trace.csv", "0.00,1,1,2,0,0,0,L,1,0,1\n9.00,1,1,2,0,0,0,L,1,0,1\n");
    given_file("a/events.csv", "t,robot,event,detail\n"
                               "-0.50,1,role,L\n"
                               "1.00,1,kill,\n"
                               "1.50,2,vertex_won,3\n"
                               "1.58,2,role,L\n"
                               "1.60,2,role,F\n"
                               "2.00,0,formation,\n"
                               "3.00,0,mocap,lost, and found; again\n");
    const struct archive *archive = read_first();

    TEST_ASSERT_EQUAL_UINT(7, archive->incident_count);
    TEST_ASSERT_EQUAL_INT32(-500, archive->incidents[0].time_ms);
    TEST_ASSERT_EQUAL_STRING("lost, and found; again", archive->incidents[6].detail);
    TEST_ASSERT_EQUAL_STRING("", archive->incidents[1].detail);
    TEST_ASSERT_EQUAL_UINT(3, stories_tell(archive, stories, 4));
    TEST_ASSERT_EQUAL_STRING("robot 1 is lost", stories[0].words);
    TEST_ASSERT_EQUAL_STRING("robot 2 leads", stories[1].words);
    TEST_ASSERT_TRUE(stories[1].t == 1.58);
    TEST_ASSERT_EQUAL_STRING("another formation", stories[2].words);
    TEST_ASSERT_EQUAL_UINT(3, stories_tell(archive, stories, 1));
}

/* ---- run.mcap -------------------------------------------------------------------------- */

static struct scene_robot robots[ROBOTS] = {{.id = 7, .alive = true, .role = ROLE_LEADER},
                                            {.id = 12, .alive = true, .role = ROLE_FOLLOWER}};
static struct scene_point vertices[3];

/* Robot 7 drives along y, the formation about it: vertices ahead of it and to its left. */
static struct scene scene_at(int tick)
{
    bool second = tick >= DIES;
    double y = tick / 10.0;

    robots[0].y = robots[1].y = y;
    robots[0].alive = !second;
    robots[1].distance_error = tick / 100.0;
    vertices[0] = (struct scene_point){5, y};
    vertices[1] = (struct scene_point){5, y + (second ? 3 : 2)};
    vertices[2] = (struct scene_point){4, y};
    struct scene scene = {.time_ms = 20 * tick,
                          .reference = {1, 2, 3},
                          .about = {5, y, 1.5707963267948966},
                          .robot_count = ROBOTS,
                          .robots = robots,
                          .vertex_count = 3,
                          .vertices = vertices};
    strcpy(scene.formation, second ? "long" : "short");
    return scene;
}

static void given_recording(const char *folder)
{
    const struct recording_about about = {"two", "avr", UINT64_MAX, 3};
    const struct scene_event events[] = {
        {-500, 7, "role", "L"}, {20 * DIES, 7, "kill", ""}, {20 * DIES, 0, "formation", ""}};
    struct recording *recording = recording_open(folder, &about, error, sizeof error);
    uint8_t bytes[2048];

    TEST_ASSERT_NOT_NULL_MESSAGE(recording, error);
    for (size_t i = 0; i < 3; i++)
        recording_event(recording, events[i].time_ms, bytes,
                        scene_event_write(&events[i], bytes, sizeof bytes));
    for (int tick = 0; tick < TICKS; tick++) {
        struct scene scene = scene_at(tick);
        recording_scene(recording, &scene, bytes, scene_write(&scene, bytes, sizeof bytes));
    }
    TEST_ASSERT_TRUE_MESSAGE(recording_close(recording, error, sizeof error), error);
}

static void a_recording_says_all_of_it(void)
{
    struct story stories[2];

    given_folder("a");
    given_recording(paths[0]);
    given_file("a/trace.csv", "the recording is preferred");
    const struct archive *archive = read_first();
    const struct history *history = &archive->history;

    TEST_ASSERT_FALSE(archive->cut);
    TEST_ASSERT_EQUAL_UINT(TICKS, history->ticks);
    TEST_ASSERT_EQUAL_UINT(12, history->id[1]);
    TEST_ASSERT_TRUE(history_at(history, 20, 1)->y == 2.0f);
    TEST_ASSERT_TRUE(history_at(history, 20, 1)->error == 0.2f);
    TEST_ASSERT_TRUE(history->moments[20].reference.theta == 3);
    TEST_ASSERT_EQUAL_UINT(DIES, history_death(history));
    TEST_ASSERT_EQUAL_UINT(2, stories_tell(archive, stories, 2));
    TEST_ASSERT_EQUAL_STRING("robot 7 is lost", stories[0].words);
    TEST_ASSERT_EQUAL_STRING("formation long", stories[1].words);
}

static void shapes_are_seen_from_what_they_are_placed_about(void)
{
    given_folder("a");
    given_recording(paths[0]);
    const struct history *history = &read_first()->history;
    const struct shape *shape = history_shape_at(history, DIES - 1);

    TEST_ASSERT_EQUAL_UINT(2, history->shapes);
    TEST_ASSERT_EQUAL_STRING("short", shape->name);
    TEST_ASSERT_EQUAL_UINT(3, shape->count);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2, shape->vertices[1].x);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0, shape->vertices[1].y);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1, shape->vertices[2].y);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 3, history_shape_at(history, DIES)->vertices[1].x);
}

static void a_recording_goes_as_far_as_it_was_written(void)
{
    char words[FACT_WORDS_MAX];

    given_folder("a");
    given_recording(paths[0]);
    struct stat about;
    TEST_ASSERT_EQUAL_INT(0, stat(in_dir("a/run.mcap"), &about));
    TEST_ASSERT_EQUAL_INT(0, truncate(in_dir("a/run.mcap"), about.st_size * 2 / 3));
    const struct archive *archive = read_first();

    TEST_ASSERT_TRUE(archive->cut);
    TEST_ASSERT_TRUE(archive->history.ticks > 20 && archive->history.ticks < TICKS);
    TEST_ASSERT_TRUE(fact_tell(&facts[0], archive, words, sizeof words));
    TEST_ASSERT_EQUAL_STRING("two", words);
    TEST_ASSERT_TRUE(fact_tell(&facts[1], archive, words, sizeof words));
    TEST_ASSERT_EQUAL_STRING("18446744073709551615", words);
}

static void a_recording_of_nothing_is_refused(void)
{
    given_folder("a");
    given_recording(paths[0]);
    TEST_ASSERT_EQUAL_INT(0, truncate(in_dir("a/run.mcap"), 60));
    refused("nothing was recorded");
    given_file("a/run.mcap", "something else");
    refused("is no MCAP file");
}

/* ---- summary.json ---------------------------------------------------------------------- */

static const struct fact *find_fact(const char *path)
{
    const struct fact *fact = facts;

    while (fact->words != NULL && strcmp(fact->path, path) != 0)
        fact++;
    TEST_ASSERT_NOT_NULL_MESSAGE(fact->words, path);
    return fact;
}

static void assert_fact(const char *path, const char *words)
{
    char told[FACT_WORDS_MAX];

    TEST_ASSERT_TRUE_MESSAGE(fact_tell(find_fact(path), archives[0], told, sizeof told), path);
    TEST_ASSERT_EQUAL_STRING(words, told);
}

static void a_summary_is_told_in_words(void)
{
    char told[FACT_WORDS_MAX];

    given_folder("a");
    given_trace("a/trace.csv", "0.00,1,1,2,0,0,0,L,1,0,1\n");
    given_file("a/summary.json", "{\"scenario\": \"two\", \"seed\": 7, \"final_leader\": null,\n"
                                 " \"allocation\": {\"complete\": true, \"switches\": 3},\n"
                                 " \"mean_distance_error_m\": {\"final\": 0.0123456}}\n");
    read_first();
    assert_fact("scenario", "two");
    assert_fact("seed", "7");
    assert_fact("final_leader", "none");
    assert_fact("allocation.complete", "yes");
    assert_fact("allocation.switches", "3");
    assert_fact("mean_distance_error_m.final", "0.0123");
    TEST_ASSERT_FALSE(fact_tell(find_fact("cpu.load_max_pct"), archives[0], told, sizeof told));
    TEST_ASSERT_FALSE(fact_tell(find_fact("robots"), archives[0], told, sizeof told));
}

static void without_a_summary_it_is_measured(void)
{
    given_folder("a");
    given_trace("a/trace.csv", "0.00,1,1,2,0,0,0,L,1,3,1\n0.00,2,1,2,0,0,0,F,2,1,1\n"
                               "0.02,1,1,2,0,0,0,L,1,1,1\n0.02,2,1,2,0,0,0,F,2,2,1\n");
    read_first();
    assert_fact("robots", "2");
    assert_fact("duration", "0.02");
    assert_fact("mean_distance_error_m.final", "1.5000");
    assert_fact("mean_distance_error_m.peak", "2.000");
    assert_fact("mean_distance_error_m.integral", "0.07");
}

static void a_summary_that_is_none_is_refused(void)
{
    given_folder("a");
    given_trace("a/trace.csv", "0.00,1,1,2,0,0,0,L,1,0,1\n");
    given_file("a/summary.json", "{\n\"seed\": }");
    refused("a/summary.json:2:");
}

static void a_seed_too_large_for_json_is_left_out(void)
{
    char told[FACT_WORDS_MAX];

    given_folder("a");
    given_trace("a/trace.csv", "0.00,1,1,2,0,0,0,L,1,0,1\n");
    given_file("a/summary.json", "{\"seed\": 18446744073709551615, \"robots\": 4}");
    read_first();
    assert_fact("robots", "4");
    TEST_ASSERT_FALSE(fact_tell(find_fact("seed"), archives[0], told, sizeof told));
}

/* ---- folders --------------------------------------------------------------------------- */

static void a_folder_without_a_run_is_refused(void)
{
    given_folder("a");
    refused("a: no run is in it");
    rmdir(paths[0]);
    refused("a: No such file or directory");
}

static void names_are_as_long_as_they_have_to_be(void)
{
    mkdir(in_dir("x"), 0700);
    mkdir(in_dir("y"), 0700);
    given_folder("x/one");
    given_folder("y/one");
    given_folder("y/two/");
    for (size_t i = 0; i < 3; i++) {
        char name[64];
        snprintf(name, sizeof name, "%s/trace.csv", paths[i] + strlen(dir) + 1);
        given_trace(name, "0.00,1,1,2,0,0,0,L,1,0,1\n");
    }
    read_first();
    TEST_ASSERT_EQUAL_STRING("x/one", archives[0]->name);
    TEST_ASSERT_EQUAL_STRING("y/one", archives[1]->name);
    TEST_ASSERT_EQUAL_STRING("y/two", archives[2]->name);
    struct archive **two = archive_read_all(paths + 1, 2, error, sizeof error);
    TEST_ASSERT_NOT_NULL(two);
    TEST_ASSERT_EQUAL_STRING("one", two[0]->name);
    TEST_ASSERT_EQUAL_STRING("two", two[1]->name);
    archive_free_all(two, 2);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_trace_is_read_row_by_row);
    RUN_TEST(a_trace_ends_where_it_is_torn);
    RUN_TEST(a_row_that_is_none_is_not_taken);
    RUN_TEST(events_are_told_in_words);
    RUN_TEST(a_recording_says_all_of_it);
    RUN_TEST(shapes_are_seen_from_what_they_are_placed_about);
    RUN_TEST(a_recording_goes_as_far_as_it_was_written);
    RUN_TEST(a_recording_of_nothing_is_refused);
    RUN_TEST(a_summary_is_told_in_words);
    RUN_TEST(without_a_summary_it_is_measured);
    RUN_TEST(a_summary_that_is_none_is_refused);
    RUN_TEST(a_seed_too_large_for_json_is_left_out);
    RUN_TEST(a_folder_without_a_run_is_refused);
    RUN_TEST(names_are_as_long_as_they_have_to_be);
    return UNITY_END();
}
