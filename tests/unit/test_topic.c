#include "topic.h"

#include "cdr.h"
#include "message.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#define ROBOTS_MAX 120

static struct scene_robot robots[ROBOTS_MAX];
static struct scene_point vertices[ROBOTS_MAX];
static struct scene scene;
static uint8_t *bytes;

/* In a line, a metre apart, with ids of five digits; the second one leads. */
void setUp(void)
{
    for (uint16_t i = 0; i < ROBOTS_MAX; i++) {
        robots[i] = (struct scene_robot){
            .x = i, .id = 65000 + i, .role = ROLE_FOLLOWER, .alive = true, .linked = true};
        vertices[i] = (struct scene_point){i, 1};
    }
    robots[1].role = ROLE_LEADER;
    scene = (struct scene){
        .time_ms = INT32_MAX,
        .mean_distance_error = 0.5,
        .range = 1,
        .leader = 65001,
        .robots = robots,
        .robot_count = 4,
        .vertices = vertices,
        .vertex_count = 3,
    };
}

void tearDown(void)
{
    free(bytes);
    bytes = NULL;
}

static size_t write(enum topic topic)
{
    size_t room = topic_room(&scene);

    free(bytes);
    bytes = malloc(room);
    TEST_ASSERT_NOT_NULL(bytes);
    return topic_write(topic, &scene, bytes, room);
}

static void test_all_are_told_apart_and_defined(void)
{
    for (enum topic topic = 0; topic < TOPIC_COUNT; topic++) {
        const struct topic_kind *kind = &topic_kinds[topic];

        TEST_ASSERT_EQUAL_HEX8('/', kind->name[0]);
        TEST_ASSERT_NOT_NULL(strstr(kind->type, "/msg/"));
        TEST_ASSERT_NULL(strstr(kind->definition, "/msg/")); /* parts are named without it */
        TEST_ASSERT_EQUAL_HEX8('\n', kind->definition[strlen(kind->definition) - 1]);
        TEST_ASSERT_EQUAL_INT(0, kind->period_ms % 20);
        for (enum topic other = 0; other < topic; other++)
            TEST_ASSERT_TRUE(strcmp(kind->name, topic_kinds[other].name) != 0);
    }
    TEST_ASSERT_EQUAL_INT(0, topic_kinds[TOPIC_EVENTS].period_ms);
}

static void check_room(void)
{
    for (enum topic topic = 0; topic < TOPIC_COUNT; topic++) {
        size_t count = write(topic);

        TEST_ASSERT_EQUAL_INT(topic != TOPIC_EVENTS, count > 0);
        if (topic == TOPIC_EVENTS || topic == TOPIC_FLEET)
            continue;
        bytes[count - 1] = 0xAA;
        TEST_ASSERT_EQUAL_UINT(0, topic_write(topic, &scene, bytes, count - 1));
        TEST_ASSERT_EQUAL_HEX8(0xAA, bytes[count - 1]);
    }
}

static void test_the_room_is_enough(void)
{
    memset(scene.formation, 'x', sizeof scene.formation - 1);
    check_room();
    scene.vertex_count = ROBOTS_MAX;
    check_room();
    scene.robot_count = 16; /* have their ranges drawn */
    check_room();
    scene.robot_count = 17;
    check_room();
    scene.range = 1000;
    scene.robot_count = 100;
    check_room();
    scene.robot_count = ROBOTS_MAX;
    check_room();
    scene.robot_count = scene.vertex_count = 0;
    check_room();
}

static void test_the_room_is_not_wasted(void)
{
    scene.range = 1000;
    scene.robot_count = 100;
    TEST_ASSERT_LESS_THAN_UINT(write(TOPIC_LINKS) + 8192, topic_room(&scene));
    scene.robot_count = 16;
    scene.vertex_count = ROBOTS_MAX;
    TEST_ASSERT_LESS_THAN_UINT(write(TOPIC_MARKERS) + 8192, topic_room(&scene));
}

static void test_numbers(void)
{
    static const uint8_t half[] = {0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0xE0, 0x3F};
    static const uint8_t leader[] = {0, 1, 0, 0, 0xE9, 0xFD};

    TEST_ASSERT_EQUAL_UINT(sizeof half, write(TOPIC_MEAN_ERROR));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(half, bytes, sizeof half);
    TEST_ASSERT_EQUAL_UINT(sizeof leader, write(TOPIC_LEADER));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(leader, bytes, sizeof leader);
}

static void test_the_fleet_is_the_scene(void)
{
    uint8_t expected[2048];
    size_t count = scene_write(&scene, expected, sizeof expected);

    TEST_ASSERT_EQUAL_UINT(count, write(TOPIC_FLEET));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, bytes, count);
}

struct seen_marker {
    char space[16];
    int32_t id, shape, action;
    double x, y, z;
    float red;
    size_t points;
    double first_x, last_x;
    char text[8];
};

static void skip(struct cdr_reader *cdr, size_t count, size_t size)
{
    cdr_take_block(cdr, count * size, size);
}

static struct seen_marker take_marker(struct cdr_reader *cdr)
{
    struct seen_marker seen = {0};
    char word[16];

    TEST_ASSERT_EQUAL_INT(scene.time_ms, cdr_take_time(cdr));
    cdr_take_string(cdr, word, sizeof word);
    TEST_ASSERT_EQUAL_STRING("map", word);
    cdr_take_string(cdr, seen.space, sizeof seen.space);
    seen.id = cdr_take_i32(cdr);
    seen.shape = cdr_take_i32(cdr);
    seen.action = cdr_take_i32(cdr);
    seen.x = cdr_take_f64(cdr);
    seen.y = cdr_take_f64(cdr);
    seen.z = cdr_take_f64(cdr);
    skip(cdr, 7, 8); /* orientation, scale */
    const uint8_t *color = cdr_take_block(cdr, 16, 4);
    TEST_ASSERT_NOT_NULL(color);
    memcpy(&seen.red, color, sizeof seen.red);
    TEST_ASSERT_EQUAL_INT(0, cdr_take_time(cdr)); /* lifetime */
    TEST_ASSERT_FALSE(cdr_take_bool(cdr));
    seen.points = cdr_take_count(cdr, 24);
    for (size_t i = 0; i < 3 * seen.points; i++) {
        seen.last_x = i % 3 == 0 ? cdr_take_f64(cdr) : (cdr_take_f64(cdr), seen.last_x);
        seen.first_x = i == 0 ? seen.last_x : seen.first_x;
    }
    size_t colors = cdr_take_count(cdr, 16);
    TEST_ASSERT_TRUE(colors == 0 || colors == seen.points);
    skip(cdr, 4 * colors, 4);
    cdr_take_string(cdr, word, sizeof word);
    cdr_take_time(cdr); /* texture */
    cdr_take_string(cdr, word, sizeof word);
    cdr_take_string(cdr, word, sizeof word);
    TEST_ASSERT_EQUAL_UINT(0, cdr_take_u32(cdr));
    TEST_ASSERT_EQUAL_UINT(0, cdr_take_u32(cdr)); /* uv_coordinates */
    cdr_take_string(cdr, seen.text, sizeof seen.text);
    cdr_take_string(cdr, word, sizeof word); /* mesh */
    cdr_take_string(cdr, word, sizeof word);
    TEST_ASSERT_EQUAL_UINT(0, cdr_take_u32(cdr));
    TEST_ASSERT_FALSE(cdr_take_bool(cdr));
    TEST_ASSERT_FALSE(cdr->short_of);
    return seen;
}

static struct seen_marker links(void)
{
    size_t count = write(TOPIC_LINKS);
    struct cdr_reader cdr = cdr_open(bytes, count);
    struct seen_marker seen = take_marker(&cdr);

    TEST_ASSERT_EQUAL_UINT(count, cdr.used);
    TEST_ASSERT_EQUAL_STRING("links", seen.space);
    return seen;
}

enum { ADD = 0, DELETE = 2, DELETEALL = 3 };

static void test_leaders_reach_all_and_followers_their_neighbours(void)
{
    struct seen_marker seen = links();

    TEST_ASSERT_EQUAL_INT(ADD, seen.action);
    TEST_ASSERT_EQUAL_UINT(2 * (3 + 1), seen.points); /* 1-0, 1-2, 1-3; 2-3 */
    TEST_ASSERT_TRUE(seen.first_x == 1 && seen.last_x == 3);
    scene.range = 2;
    TEST_ASSERT_EQUAL_UINT(2 * (3 + 2), links().points);
    robots[2].role = ROLE_LEADER; /* two of them: one line between them */
    TEST_ASSERT_EQUAL_UINT(2 * 5, links().points);
}

static void test_a_candidate_that_hears_nobody_has_no_link(void)
{
    robots[1].role = ROLE_CANDIDATE;
    scene.robot_count = 2;
    robots[1].x = 5;
    TEST_ASSERT_EQUAL_INT(DELETE, links().action);
    robots[0].role = ROLE_CANDIDATE;
    TEST_ASSERT_EQUAL_UINT(2, links().points);
}

static void test_no_links_delete_those_there_were(void)
{
    for (size_t i = 0; i < 4; i++)
        robots[i].muted = true;
    struct seen_marker seen = links();
    TEST_ASSERT_EQUAL_INT(DELETE, seen.action);
    TEST_ASSERT_EQUAL_UINT(0, seen.points);
}

static void test_more_links_than_anybody_can_see_are_left_out(void)
{
    scene.range = 1000;
    scene.robot_count = 100;
    TEST_ASSERT_EQUAL_UINT(2 * 100 * 99 / 2, links().points);
    scene.robot_count = ROBOTS_MAX;
    TEST_ASSERT_EQUAL_UINT(2 * 5000, links().points);
    for (size_t i = 0; i < ROBOTS_MAX; i++)
        robots[i].role = ROLE_LEADER;
    TEST_ASSERT_EQUAL_UINT(2 * 5000, links().points);
}

static struct seen_marker seen_markers[1 + ROBOTS_MAX * 4];

static size_t markers(void)
{
    size_t size = write(TOPIC_MARKERS);
    struct cdr_reader cdr = cdr_open(bytes, size);
    size_t count = cdr_take_count(&cdr, 1);

    TEST_ASSERT_LESS_OR_EQUAL_UINT(sizeof seen_markers / sizeof seen_markers[0], count);
    for (size_t i = 0; i < count; i++)
        seen_markers[i] = take_marker(&cdr);
    TEST_ASSERT_EQUAL_UINT(size, cdr.used);
    return count;
}

static const struct seen_marker *marker(const char *space, int32_t id)
{
    size_t count = markers();

    for (size_t i = 0; i < count; i++)
        if (strcmp(seen_markers[i].space, space) == 0 && seen_markers[i].id == id)
            return &seen_markers[i];
    TEST_FAIL_MESSAGE("there is no such marker");
    return NULL;
}

static void test_vertices_that_are_no_more_are_deleted_first(void)
{
    TEST_ASSERT_EQUAL_UINT(1 + 3 + 3 * 4, markers());
    TEST_ASSERT_EQUAL_INT(DELETEALL, seen_markers[0].action);
    TEST_ASSERT_EQUAL_STRING("vertices", seen_markers[0].space);
    for (size_t i = 1; i < 4; i++)
        TEST_ASSERT_EQUAL_STRING("vertices", seen_markers[i].space);
}

static void test_bodies_and_ids_lie_where_robots_are(void)
{
    robots[2].y = -3;
    const struct seen_marker *body = marker("bodies", 65002);
    TEST_ASSERT_TRUE(body->x == 2 && body->y == -3 && body->z == 0);
    TEST_ASSERT_EQUAL_UINT(6, body->points);
    const struct seen_marker *id = marker("ids", 65002);
    TEST_ASSERT_TRUE(id->x == 2 && id->y == -3 && id->z > 0);
    TEST_ASSERT_EQUAL_STRING("65002", id->text);
    TEST_ASSERT_TRUE(marker("vertices", 3)->x == 2);
}

static void test_colours_say_who_is_what(void)
{
    float leader = marker("bodies", 65001)->red, follower = marker("bodies", 65002)->red;

    robots[0].role = ROLE_CANDIDATE;
    float candidate = marker("bodies", 65000)->red;
    robots[1].alive = false;
    float dead = marker("bodies", 65001)->red;
    TEST_ASSERT_TRUE(leader > dead && dead > candidate && dead > follower);
    TEST_ASSERT_EQUAL_INT(ADD, marker("bodies", 65001)->action);
}

static void test_ranges_of_live_followers_of_small_fleets(void)
{
    TEST_ASSERT_EQUAL_INT(DELETE, marker("range", 65001)->action); /* leads */
    const struct seen_marker *circle = marker("range", 65002);
    TEST_ASSERT_EQUAL_INT(ADD, circle->action);
    TEST_ASSERT_TRUE(circle->first_x == 1 && fabs(circle->last_x - 1) < 1e-12);
    robots[2].alive = false;
    circle = marker("range", 65002);
    TEST_ASSERT_EQUAL_INT(DELETE, circle->action);
    TEST_ASSERT_EQUAL_UINT(0, circle->points);
    scene.robot_count = 17;
    TEST_ASSERT_EQUAL_UINT(1 + 3 + 2 * 17, markers());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_all_are_told_apart_and_defined);
    RUN_TEST(test_the_room_is_enough);
    RUN_TEST(test_the_room_is_not_wasted);
    RUN_TEST(test_numbers);
    RUN_TEST(test_the_fleet_is_the_scene);
    RUN_TEST(test_leaders_reach_all_and_followers_their_neighbours);
    RUN_TEST(test_a_candidate_that_hears_nobody_has_no_link);
    RUN_TEST(test_no_links_delete_those_there_were);
    RUN_TEST(test_more_links_than_anybody_can_see_are_left_out);
    RUN_TEST(test_vertices_that_are_no_more_are_deleted_first);
    RUN_TEST(test_bodies_and_ids_lie_where_robots_are);
    RUN_TEST(test_colours_say_who_is_what);
    RUN_TEST(test_ranges_of_live_followers_of_small_fleets);
    return UNITY_END();
}
