#include "scene.h"

#include "message.h"

#include <math.h>
#include <string.h>
#include <unity.h>

static struct scene_robot robots[3];
static const struct scene_point vertices[2] = {{1.5, -2.5}, {3.25, 0.125}};
static struct scene scene;
static uint8_t bytes[1024];

void setUp(void)
{
    static const struct scene_robot robot = {
        .x = 1.25,
        .y = -2.5,
        .theta = 0.75,
        .v = 0.5,
        .omega = -0.25,
        .distance_error = 0.125,
        .pose_age = 0.0625f,
        .loss = 0.1f,
        .battery = 7.2f,
        .load = NAN,
        .id = 0x1234,
        .vertex = 2,
        .term = 3,
        .group = 4,
        .role = ROLE_FOLLOWER,
        .state = 6,
        .faults = 7,
        .candidate = true,
        .alive = true,
        .linked = true,
    };

    for (size_t i = 0; i < 3; i++)
        robots[i] = robot;
    scene = (struct scene){
        .time_ms = 12340,
        .mean_distance_error = 0.5,
        .range = 2,
        .loss = 0.25,
        .delay = 0.04,
        .reference = {1, 2, 3},
        .about = {4, 5, 6},
        .leader = 0x1234,
        .complete = true,
        .robot_count = 2,
        .robots = robots,
        .vertex_count = 2,
        .vertices = vertices,
        .formation = "diamond",
    };
    memset(bytes, 0xAA, sizeof bytes);
}

void tearDown(void)
{
}

static double f64_at(size_t offset)
{
    double value;

    memcpy(&value, bytes + 4 + offset, sizeof value);
    return value;
}

static uint32_t u32_at(size_t offset)
{
    uint32_t value;

    memcpy(&value, bytes + 4 + offset, sizeof value);
    return value;
}

/* The page reads messages by these offsets. */
static void test_the_layout(void)
{
    static const uint8_t last[] = {8, 0, 0, 0, 'd', 'i', 'a', 'm', 'o', 'n', 'd', 0};
    size_t count = scene_write(&scene, bytes, sizeof bytes);

    TEST_ASSERT_EQUAL_UINT(4 + 104 + 2 * 80 + 2 * 16 + sizeof last, count);
    TEST_ASSERT_EQUAL_HEX8(0, bytes[0]);
    TEST_ASSERT_EQUAL_HEX8(1, bytes[1]);
    TEST_ASSERT_EQUAL_UINT(12, u32_at(0));
    TEST_ASSERT_EQUAL_UINT(340000000, u32_at(4));
    TEST_ASSERT_TRUE(f64_at(8) == 0.5 && f64_at(16) == 2 && f64_at(24) == 0.25);
    TEST_ASSERT_TRUE(f64_at(32) == 0.04);
    for (size_t i = 0; i < 6; i++)
        TEST_ASSERT_TRUE(f64_at(40 + 8 * i) == (double)i + 1);
    TEST_ASSERT_EQUAL_HEX32(0x00011234, u32_at(88)); /* leader, complete, estopped */
    TEST_ASSERT_EQUAL_UINT(2, u32_at(92));
    TEST_ASSERT_EQUAL_UINT(2, u32_at(96 + 160));
    TEST_ASSERT_TRUE(f64_at(104 + 160) == 1.5 && f64_at(104 + 160 + 8) == -2.5);
    TEST_ASSERT_TRUE(f64_at(104 + 176) == 3.25);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(last, bytes + 4 + 104 + 192, sizeof last);
}

static void test_the_layout_of_a_robot(void)
{
    static const uint8_t small[] = {0x34, 0x12, 2, 0, 3, 0, 4, 0, 2, 6, 7, 1, 1, 1, 0, 0};
    float floats[4];

    scene_write(&scene, bytes, sizeof bytes);
    TEST_ASSERT_TRUE(f64_at(176) == 1.25 && f64_at(184) == -2.5 && f64_at(192) == 0.75);
    TEST_ASSERT_TRUE(f64_at(200) == 0.5 && f64_at(208) == -0.25 && f64_at(216) == 0.125);
    memcpy(floats, bytes + 4 + 224, sizeof floats);
    TEST_ASSERT_TRUE(floats[0] == 0.0625f && floats[1] == 0.1f && floats[2] == 7.2f);
    TEST_ASSERT_TRUE(isnan(floats[3]));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(small, bytes + 4 + 240, sizeof small);
}

static struct scene read_again(size_t count)
{
    static struct scene_robot read_robots[3];
    static struct scene_point read_vertices[2];
    struct scene read;

    memset(read_robots, 0, sizeof read_robots);
    TEST_ASSERT_TRUE(scene_read(&read, read_robots, 3, read_vertices, 2, bytes, count));
    return read;
}

static void test_what_is_written_is_read(void)
{
    size_t robot_count, vertex_count;

    scene.time_ms = -480;
    scene.estopped = true;
    size_t count = scene_write(&scene, bytes, sizeof bytes);
    TEST_ASSERT_TRUE(scene_counts(bytes, count, &robot_count, &vertex_count));
    TEST_ASSERT_EQUAL_UINT(2, robot_count);
    TEST_ASSERT_EQUAL_UINT(2, vertex_count);
    struct scene read = read_again(count);
    TEST_ASSERT_EQUAL_INT(-480, read.time_ms);
    TEST_ASSERT_TRUE(read.mean_distance_error == 0.5 && read.range == 2 && read.delay == 0.04);
    TEST_ASSERT_TRUE(read.reference.theta == 3 && read.about.x == 4);
    TEST_ASSERT_EQUAL_UINT(0x1234, read.leader);
    TEST_ASSERT_TRUE(read.complete && read.estopped);
    TEST_ASSERT_EQUAL_UINT(2, read.robot_count);
    TEST_ASSERT_EQUAL_MEMORY(robots, read.robots, 2 * sizeof robots[0]);
    TEST_ASSERT_EQUAL_UINT(2, read.vertex_count);
    TEST_ASSERT_EQUAL_MEMORY(vertices, read.vertices, sizeof vertices);
    TEST_ASSERT_EQUAL_STRING("diamond", read.formation);
}

static void test_nobody_and_nowhere(void)
{
    scene.robot_count = 0;
    scene.vertex_count = 0;
    size_t count = scene_write(&scene, bytes, sizeof bytes);
    TEST_ASSERT_EQUAL_UINT(4 + 96 + 4 + 12, count); /* what is not there is not aligned */
    struct scene read = read_again(count);
    TEST_ASSERT_EQUAL_UINT(0, read.robot_count);
    TEST_ASSERT_EQUAL_UINT(0, read.vertex_count);
    TEST_ASSERT_EQUAL_STRING("diamond", read.formation);
}

static void test_the_size_is_enough_and_needed(void)
{
    memset(scene.formation, 'x', sizeof scene.formation - 1);
    size_t size = scene_size(2, 2);
    TEST_ASSERT_EQUAL_UINT(size, scene_write(&scene, bytes, size));
    memset(bytes, 0xAA, sizeof bytes);
    TEST_ASSERT_EQUAL_UINT(0, scene_write(&scene, bytes, size - 1));
    TEST_ASSERT_EQUAL_UINT(0, scene_write(&scene, bytes, 0));
}

static void test_a_message_cut_short_or_too_long_is_none(void)
{
    struct scene_robot two_robots[2];
    struct scene_point two_vertices[2];
    struct scene read;
    size_t some, count = scene_write(&scene, bytes, sizeof bytes);

    for (size_t i = 0; i < sizeof bytes; i++) {
        bool whole = i == count;

        TEST_ASSERT_EQUAL_INT(whole, scene_counts(bytes, i, &some, &some));
        TEST_ASSERT_EQUAL_INT(whole, scene_read(&read, two_robots, 2, two_vertices, 2, bytes, i));
    }
    TEST_ASSERT_FALSE(scene_read(&read, two_robots, 1, two_vertices, 2, bytes, count));
    TEST_ASSERT_FALSE(scene_read(&read, two_robots, 2, two_vertices, 1, bytes, count));
}

static bool reads_with(size_t offset, uint8_t value)
{
    struct scene_robot two_robots[2];
    struct scene_point two_vertices[2];
    struct scene read;
    size_t count = scene_write(&scene, bytes, sizeof bytes);

    bytes[4 + offset] = value;
    return scene_read(&read, two_robots, 2, two_vertices, 2, bytes, count);
}

static void test_bytes_that_are_no_scene(void)
{
    TEST_ASSERT_TRUE(reads_with(8, 0xFF));
    TEST_ASSERT_FALSE(reads_with(7, 0xFF));             /* nanoseconds */
    TEST_ASSERT_FALSE(reads_with(90, 2));               /* complete */
    TEST_ASSERT_FALSE(reads_with(95, 0xFF));            /* robots */
    TEST_ASSERT_FALSE(reads_with(96 + 75, 2));          /* candidate */
    TEST_ASSERT_FALSE(reads_with(96 + 159, 2));         /* stalled */
    TEST_ASSERT_FALSE(reads_with(96 + 160, 3));         /* vertices */
    TEST_ASSERT_FALSE(reads_with(104 + 192, 9));        /* length of the name */
    TEST_ASSERT_FALSE(reads_with(104 + 192 + 11, 'x')); /* its end */
}

static void put(size_t robot, double x, uint8_t role)
{
    robots[robot].x = x;
    robots[robot].role = role;
    robots[robot].candidate = false;
}

static void test_followers_hear_within_the_range(void)
{
    put(0, 0, ROLE_FOLLOWER);
    put(1, 2 + 1e-12, ROLE_FOLLOWER);
    TEST_ASSERT_TRUE(scene_hears(&scene, 0, 1));
    TEST_ASSERT_FALSE(scene_hears(&scene, 0, 0));
    robots[1].y += 0.1;
    TEST_ASSERT_FALSE(scene_hears(&scene, 0, 1));
    TEST_ASSERT_FALSE(scene_hears(&scene, 1, 0));
}

static void test_leader_and_candidates_are_heard_everywhere(void)
{
    put(0, 0, ROLE_LEADER);
    put(1, 100, ROLE_FOLLOWER);
    TEST_ASSERT_TRUE(scene_hears(&scene, 0, 1));
    TEST_ASSERT_FALSE(scene_hears(&scene, 1, 0));
    put(0, 0, ROLE_CANDIDATE);
    TEST_ASSERT_TRUE(scene_hears(&scene, 0, 1));
    put(0, 0, ROLE_FOLLOWER);
    TEST_ASSERT_FALSE(scene_hears(&scene, 0, 1));
    robots[0].candidate = true;
    TEST_ASSERT_TRUE(scene_hears(&scene, 0, 1));
}

static void check_neither_hears(const char *why)
{
    TEST_ASSERT_FALSE_MESSAGE(scene_hears(&scene, 0, 1), why);
    TEST_ASSERT_FALSE_MESSAGE(scene_hears(&scene, 1, 0), why);
    setUp();
}

static void test_who_takes_no_part_hears_nobody(void)
{
    TEST_ASSERT_TRUE(scene_hears(&scene, 0, 1));
    robots[1].alive = false;
    check_neither_hears("dead");
    robots[1].linked = false;
    check_neither_hears("not linked");
    robots[0].muted = true;
    check_neither_hears("muted");
    robots[0].group = 1;
    check_neither_hears("of another group");
}

static struct scene_event read_event(size_t count)
{
    static char words[SCENE_EVENT_MAX];
    struct scene_event event;

    TEST_ASSERT_TRUE(scene_event_read(&event, words, bytes, count));
    return event;
}

static void test_an_event(void)
{
    static const uint8_t expected[] = {
        0,   1,   0,   0,                                                 /* head */
        4,   0,   0,   0,   0,   0x2D, 0x31, 0x01,                        /* 4.02 s */
        20,  0,   0,   0,   8,   0,    0,    0,                           /* level, name */
        'r', 'o', 'b', 'o', 't', '_',  '3',  0,                           /* */
        13,  0,   0,   0,                                                 /* msg */
        'v', 'e', 'r', 't', 'e', 'x',  '_',  'w',  'o', 'n', ' ', '2', 0, /* */
        0,   0,   0,   2,   0,   0,    0,    '2',  0,                     /* file */
        0,   0,   11,  0,   0,   0,                                       /* function */
        'v', 'e', 'r', 't', 'e', 'x',  '_',  'w',  'o', 'n', 0,           /* */
        0,   3,   0,   0,   0,                                            /* line */
    };
    struct scene_event event = {4020, 3, "vertex_won", "2"};
    size_t count = scene_event_write(&event, bytes, sizeof bytes);

    TEST_ASSERT_EQUAL_UINT(sizeof expected, count);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, bytes, sizeof expected);
    struct scene_event read = read_event(count);
    TEST_ASSERT_EQUAL_INT(4020, read.time_ms);
    TEST_ASSERT_EQUAL_UINT(3, read.robot);
    TEST_ASSERT_EQUAL_STRING("vertex_won", read.event);
    TEST_ASSERT_EQUAL_STRING("2", read.detail);
}

static uint8_t level_of(const char *word, const char *detail)
{
    struct scene_event event = {0, 0, word, detail};

    TEST_ASSERT_GREATER_THAN_UINT(0, scene_event_write(&event, bytes, sizeof bytes));
    TEST_ASSERT_EQUAL_STRING("fleet", (char *)bytes + 20);
    return bytes[12];
}

static void test_trouble_is_a_warning(void)
{
    TEST_ASSERT_EQUAL_UINT(20, level_of("start", "the mission begins"));
    TEST_ASSERT_EQUAL_UINT(30, level_of("fault", "link lost"));
    TEST_ASSERT_EQUAL_UINT(20, level_of("fault", "none"));
    TEST_ASSERT_EQUAL_UINT(30, level_of("estop", ""));
}

static void test_an_event_always_fits(void)
{
    static char word[2000], detail[2000];
    struct scene_event event = {INT32_MIN, UINT16_MAX, word, detail};

    memset(word, 'w', sizeof word - 1);
    memset(detail, '\xFF', sizeof detail - 1);
    size_t count = scene_event_write(&event, bytes, SCENE_EVENT_MAX);
    TEST_ASSERT_GREATER_THAN_UINT(0, count);
    struct scene_event read = read_event(count);
    TEST_ASSERT_EQUAL_INT(INT32_MIN, read.time_ms);
    TEST_ASSERT_EQUAL_UINT(UINT16_MAX, read.robot);
    TEST_ASSERT_EQUAL_STRING_LEN("wwwwwwww", read.event, 8);
    TEST_ASSERT_EQUAL_STRING_LEN("????????", read.detail, 8);
    TEST_ASSERT_EQUAL_UINT(0, scene_event_write(&event, bytes, count - 1));
}

static void test_an_event_cut_short_is_none(void)
{
    struct scene_event event = {0, 3, "role", "L"}, read;
    char words[SCENE_EVENT_MAX];
    size_t count = scene_event_write(&event, bytes, sizeof bytes);

    for (size_t i = 0; i <= sizeof bytes; i++)
        TEST_ASSERT_EQUAL_INT(i == count, scene_event_read(&read, words, bytes, i));
    bytes[count - 2] = 1; /* robot 65,539 */
    TEST_ASSERT_FALSE(scene_event_read(&read, words, bytes, count));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_layout);
    RUN_TEST(test_the_layout_of_a_robot);
    RUN_TEST(test_what_is_written_is_read);
    RUN_TEST(test_nobody_and_nowhere);
    RUN_TEST(test_the_size_is_enough_and_needed);
    RUN_TEST(test_a_message_cut_short_or_too_long_is_none);
    RUN_TEST(test_bytes_that_are_no_scene);
    RUN_TEST(test_followers_hear_within_the_range);
    RUN_TEST(test_leader_and_candidates_are_heard_everywhere);
    RUN_TEST(test_who_takes_no_part_hears_nobody);
    RUN_TEST(test_an_event);
    RUN_TEST(test_trouble_is_a_warning);
    RUN_TEST(test_an_event_always_fits);
    RUN_TEST(test_an_event_cut_short_is_none);
    return UNITY_END();
}
