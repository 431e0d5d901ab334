#include "natnet.h"

#include "capture.h"
#include "natnet_server.h"
#include "natnet_writer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#define SECOND INT64_C(1000000)

static const uint8_t versions[][2] = {
    {2, 5},  {2, 6}, {2, 7}, {2, 8}, {2, 9}, {2, 10},
    {2, 11}, {3, 0}, {3, 1}, {4, 0}, {4, 1}, {4, 2},
};

static const struct written_body bodies[] = {
    {3, "mu-03", {1.25f, 0.5f, -2}, {0, 0.6f, 0, 0.8f}, true},
    {7, "mu-07", {-1, 0.25f, 0.75f}, {0.5f, 0.5f, 0.5f, 0.5f}, true},
};

static const uint8_t group[] = {239, 1, 2, 3};

static struct natnet_writer writer;
static struct capture_frame frame;
static char words[CAPTURE_WORDS_MAX];
static void *session;

static void begin(const struct capture_options *options)
{
    natnet_protocol.begin(session, options);
}

void setUp(void)
{
    session = malloc(natnet_protocol.session_bytes);
    TEST_ASSERT_NOT_NULL(session);
    begin(&(struct capture_options){.unicast = false});
}

void tearDown(void)
{
    free(session);
}

static enum capture_news take_bytes(const uint8_t *bytes, size_t count)
{
    size_t used = 0;
    uint8_t *exact = malloc(count > 0 ? count : 1); /* so that AddressSanitizer knows the end */

    TEST_ASSERT_NOT_NULL(exact);
    if (count > 0)
        memcpy(exact, bytes, count);
    words[0] = '\0';
    enum capture_news news = natnet_protocol.take(session, exact, count, &used, &frame, words);
    TEST_ASSERT_EQUAL_UINT(count, used);
    TEST_ASSERT_TRUE(news < CAPTURE_TOLD || words[0] != '\0');
    free(exact);
    return news;
}

static enum capture_news take(void)
{
    return take_bytes(writer.bytes, writer.count);
}

static void meet(uint8_t major, uint8_t minor)
{
    writer.major = major;
    writer.minor = minor;
    natnet_write_server(&writer, true, 1601, group);
    TEST_ASSERT_EQUAL(CAPTURE_TOLD, take());
}

static struct written_frame crowded_frame(void)
{
    return (struct written_frame){
        .number = 4711,
        .time = 12.5,
        .exposed = 5 * SECOND,
        .sent = 5 * SECOND + 3500,
        .crowded = true,
        .count = 2,
        .body = bodies,
    };
}

static void write_crowded(void)
{
    struct written_frame written = crowded_frame();

    natnet_write_frame(&writer, &written);
}

static void assert_body(const struct written_body *expected, const struct capture_body *body)
{
    TEST_ASSERT_EQUAL_INT(expected->id, body->id);
    TEST_ASSERT_EQUAL_STRING(expected->name, body->name);
    TEST_ASSERT_EQUAL(expected->tracked, body->tracked);
    for (size_t i = 0; i < 3; i++)
        TEST_ASSERT_TRUE(body->at[i] == expected->at[i]);
    for (size_t i = 0; i < 4; i++)
        TEST_ASSERT_DOUBLE_WITHIN(1e-7, expected->turn[i], body->turn[i]);
}

static void test_every_version(void)
{
    for (size_t i = 0; i < sizeof versions / sizeof *versions; i++) {
        begin(&(struct capture_options){.unicast = false});
        meet(versions[i][0], versions[i][1]);
        natnet_write_models(&writer, bodies, 2, true);
        TEST_ASSERT_EQUAL(CAPTURE_NOTHING, take());
        write_crowded();
        TEST_ASSERT_EQUAL_MESSAGE(CAPTURE_FRAME, take(), words);
        TEST_ASSERT_TRUE(frame.numbered);
        TEST_ASSERT_EQUAL_UINT(4711, frame.number);
        TEST_ASSERT_TRUE(frame.time == 12.5);
        TEST_ASSERT_EQUAL_UINT(2, frame.count);
        assert_body(&bodies[0], &frame.body[0]);
        assert_body(&bodies[1], &frame.body[1]);
    }
}

/* The server of the virtual arena, which was written apart from the decoder. */
static void test_the_arena_is_understood(void)
{
    static uint8_t bytes[NATNET_DATAGRAM_MAX];
    static const uint8_t models[4] = {4};
    static struct capture_frame moved = {.number = 9, .time = 2.5, .count = 1};
    bool client;

    moved.body[0] = (struct capture_body){"Robot5", 5, true, {1, 2, 3}, {0, 0, 0, 1}};
    for (size_t i = 0; i < sizeof versions / sizeof *versions; i++) {
        struct natnet_server server = {.version = {versions[i][0], versions[i][1]}};

        begin(&(struct capture_options){.version = {versions[i][0], versions[i][1]}});
        size_t count = natnet_server_answer(&server, &moved, 2.5, models, sizeof models, bytes,
                                            sizeof bytes, &client);
        TEST_ASSERT_EQUAL(CAPTURE_NOTHING, take_bytes(bytes, count));
        count = natnet_server_frame(&server, &moved, bytes, sizeof bytes);
        TEST_ASSERT_EQUAL_MESSAGE(CAPTURE_FRAME, take_bytes(bytes, count), words);
        TEST_ASSERT_EQUAL_UINT(9, frame.number);
        TEST_ASSERT_TRUE(frame.time == 2.5);
        TEST_ASSERT_EQUAL_STRING("Robot5", frame.body[0].name);
        TEST_ASSERT_TRUE(frame.body[0].tracked && frame.body[0].at[2] == 3);
    }
}

static void test_no_other_version_understands_it(void)
{
    /* Frames of those with the same number are laid out alike. */
    static const uint8_t row[] = {0, 1, 2, 2, 3, 3, 4, 5, 5, 5, 6, 6};

    for (size_t i = 0; i < sizeof row; i++) {
        for (size_t j = 0; j < sizeof row; j++) {
            if (row[i] == row[j])
                continue;
            begin(&(struct capture_options){.unicast = false});
            meet(versions[i][0], versions[i][1]);
            writer.major = versions[j][0];
            writer.minor = versions[j][1];
            write_crowded();
            TEST_ASSERT_EQUAL(CAPTURE_BROKEN, take());
        }
    }
}

static void test_unknown_versions_are_refused(void)
{
    static const uint8_t unknown[][2] = {{1, 0}, {2, 4}, {2, 12}, {3, 2}, {4, 3}, {5, 0}, {0, 0}};

    for (size_t i = 0; i < sizeof unknown / sizeof *unknown; i++) {
        begin(&(struct capture_options){.unicast = false});
        writer.major = unknown[i][0];
        writer.minor = unknown[i][1];
        natnet_write_server(&writer, true, 1601, group);
        TEST_ASSERT_EQUAL(CAPTURE_REFUSED, take());
        TEST_ASSERT_NOT_NULL(strstr(words, "4.2"));
        TEST_ASSERT_EQUAL(CAPTURE_NOTHING, take()); /* said once */
        write_crowded();
        TEST_ASSERT_EQUAL(CAPTURE_NOTHING, take());
    }
    meet(3, 0);
    write_crowded();
    TEST_ASSERT_EQUAL(CAPTURE_FRAME, take());
}

static void test_listening_needs_a_version(void)
{
    writer.major = 2;
    writer.minor = 9;
    write_crowded();
    TEST_ASSERT_EQUAL(CAPTURE_NOTHING, take());
    begin(&(struct capture_options){.version = {2, 9}});
    TEST_ASSERT_EQUAL(CAPTURE_FRAME, take());
    TEST_ASSERT_EQUAL_STRING("", frame.body[0].name);
    begin(&(struct capture_options){.version = {2, 4}});
    TEST_ASSERT_EQUAL(CAPTURE_REFUSED, take());
    TEST_ASSERT_EQUAL(CAPTURE_NOTHING, take());
}

static void test_what_the_system_tells(void)
{
    struct natnet_streaming streaming = natnet_streaming(session);

    TEST_ASSERT_FALSE(streaming.answered);
    TEST_ASSERT_EQUAL_UINT(NATNET_DATA_PORT, streaming.port);
    meet(2, 9);
    TEST_ASSERT_EQUAL_STRING("Motive 2.1, NatNet 2.9", words);
    streaming = natnet_streaming(session);
    TEST_ASSERT_TRUE(streaming.answered);
    TEST_ASSERT_FALSE(streaming.told);
    TEST_ASSERT_EQUAL_UINT8(239, streaming.group[0]);
    TEST_ASSERT_EQUAL_UINT8(99, streaming.group[3]);
    meet(3, 1);
    streaming = natnet_streaming(session);
    TEST_ASSERT_TRUE(streaming.told);
    TEST_ASSERT_TRUE(streaming.multicast);
    TEST_ASSERT_EQUAL_UINT(1601, streaming.port);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(group, streaming.group, 4);
    natnet_write_server(&writer, true, 1601, group);
    TEST_ASSERT_EQUAL(CAPTURE_NOTHING, take()); /* no news */
}

static void take_one(const struct written_body *body)
{
    struct written_frame written = {.number = 1, .count = 1, .body = body};

    natnet_write_frame(&writer, &written);
    TEST_ASSERT_EQUAL(CAPTURE_FRAME, take());
}

static void test_lost_bodies(void)
{
    struct written_body body = bodies[0];

    meet(3, 0);
    body.tracked = false;
    take_one(&body);
    TEST_ASSERT_FALSE(frame.body[0].tracked);
    body.tracked = true;
    body.at[1] = NAN;
    take_one(&body);
    TEST_ASSERT_FALSE(frame.body[0].tracked);
    body = (struct written_body){3, "mu-03", {0, 0, 0}, {0, 0, 0, 1}, true};
    take_one(&body);
    TEST_ASSERT_TRUE(frame.body[0].tracked);
    meet(2, 5); /* has no such bit */
    take_one(&body);
    TEST_ASSERT_FALSE(frame.body[0].tracked);
    body.at[0] = 1;
    take_one(&body);
    TEST_ASSERT_TRUE(frame.body[0].tracked);
    body.turn[3] = 0;
    take_one(&body);
    TEST_ASSERT_FALSE(frame.body[0].tracked);
}

static void test_latency(void)
{
    struct written_frame written = crowded_frame();

    meet(3, 0);
    write_crowded();
    TEST_ASSERT_EQUAL(CAPTURE_FRAME, take());
    TEST_ASSERT_TRUE(fabs(frame.latency - 0.0035) < 1e-9);
    written.exposed = 0;
    natnet_write_frame(&writer, &written);
    take();
    TEST_ASSERT_TRUE(frame.latency == 0);
    written.exposed = written.sent + 1;
    natnet_write_frame(&writer, &written);
    take();
    TEST_ASSERT_TRUE(frame.latency == 0);
    written.exposed = written.sent - 2 * SECOND; /* a recording */
    natnet_write_frame(&writer, &written);
    take();
    TEST_ASSERT_TRUE(frame.latency == 0);
    meet(2, 9);
    write_crowded();
    take();
    TEST_ASSERT_TRUE(frame.latency == 0);
}

static void test_optional_parts_of_the_suffix(void)
{
    struct written_frame written = crowded_frame();

    meet(4, 1);
    written.precise = true;
    natnet_write_frame(&writer, &written);
    TEST_ASSERT_EQUAL(CAPTURE_FRAME, take());
    meet(4, 0);
    natnet_write_frame(&writer, &written);
    TEST_ASSERT_EQUAL(CAPTURE_FRAME, take());
    meet(2, 5); /* may end without time and flags */
    natnet_write_frame(&writer, &written);
    writer.count -= 6;
    memset(writer.bytes + writer.count - 4, 0, 4);
    writer.bytes[2] = (uint8_t)(writer.count - 4);
    writer.bytes[3] = (uint8_t)((writer.count - 4) >> 8);
    TEST_ASSERT_EQUAL(CAPTURE_FRAME, take());
    TEST_ASSERT_TRUE(isnan(frame.time));
}

/* Cut anywhere, or with any byte of a count changed, nothing is read out of bounds. */
static void test_cut_and_broken_frames(void)
{
    for (size_t i = 0; i < sizeof versions / sizeof *versions; i++) {
        meet(versions[i][0], versions[i][1]);
        write_crowded();
        size_t whole = writer.count;
        for (size_t count = 0; count < whole; count++) {
            TEST_ASSERT_EQUAL(CAPTURE_BROKEN, take_bytes(writer.bytes, count));
            if (count < 4)
                continue;
            uint8_t cut[2048];
            memcpy(cut, writer.bytes, count);
            cut[2] = (uint8_t)(count - 4);
            cut[3] = (uint8_t)((count - 4) >> 8);
            TEST_ASSERT_NOT_EQUAL(CAPTURE_NOTHING, take_bytes(cut, count));
        }
        for (size_t at = 8; at < whole; at++) {
            writer.bytes[at] ^= 0xFF;
            take();
            writer.bytes[at] ^= 0xFF;
        }
    }
}

static void test_section_sizes_have_to_fit(void)
{
    meet(4, 1);
    write_crowded();
    writer.bytes[4 + 4 + 4]++; /* of the marker sets */
    TEST_ASSERT_EQUAL(CAPTURE_BROKEN, take());
}

static void test_more_bodies_than_there_is_room_for(void)
{
    static struct written_body many[CAPTURE_BODIES_MAX + 1];
    struct written_frame written = {.number = 1, .count = CAPTURE_BODIES_MAX, .body = many};

    for (size_t i = 0; i < sizeof many / sizeof *many; i++)
        many[i] = (struct written_body){(int32_t)i, "", {0, 0, 0}, {0, 0, 0, 1}, true};
    meet(3, 0);
    natnet_write_frame(&writer, &written);
    TEST_ASSERT_EQUAL(CAPTURE_FRAME, take());
    TEST_ASSERT_EQUAL_UINT(CAPTURE_BODIES_MAX, frame.count);
    written.count++;
    natnet_write_frame(&writer, &written);
    TEST_ASSERT_EQUAL(CAPTURE_BROKEN, take());
}

static void test_messages_of_no_concern(void)
{
    meet(3, 0);
    natnet_write_message(&writer, 3, 4);
    TEST_ASSERT_EQUAL(CAPTURE_NOTHING, take());
    writer.count--;
    TEST_ASSERT_EQUAL(CAPTURE_BROKEN, take());
    natnet_write_message(&writer, 13, 16);
    TEST_ASSERT_EQUAL(CAPTURE_NOTHING, take());
    natnet_write_message(&writer, 100, 0);
    TEST_ASSERT_EQUAL(CAPTURE_NOTHING, take());
    natnet_write_message(&writer, 4711, 0);
    TEST_ASSERT_EQUAL(CAPTURE_BROKEN, take());
}

/* The id of what is asked for at a time, or -1. */
static int asked(int64_t now_us)
{
    uint8_t bytes[CAPTURE_ASK_MAX];
    size_t count = natnet_protocol.ask(session, now_us, bytes, sizeof bytes);

    if (count == 0)
        return -1;
    TEST_ASSERT_EQUAL_UINT(count, 4u + bytes[2] + 256u * bytes[3]);
    TEST_ASSERT_EQUAL_UINT(bytes[0] == 0 ? 268 : 4, count);
    return bytes[0] + 256 * bytes[1];
}

static void test_asks_until_it_is_answered(void)
{
    TEST_ASSERT_EQUAL_INT(0, asked(-5 * SECOND));
    TEST_ASSERT_EQUAL_INT(-1, asked(-5 * SECOND));
    TEST_ASSERT_EQUAL_INT(-1, asked(-4 * SECOND - 1));
    TEST_ASSERT_EQUAL_INT(0, asked(-4 * SECOND));
    meet(3, 0);
    TEST_ASSERT_EQUAL_INT(4, asked(-4 * SECOND)); /* the names */
    TEST_ASSERT_EQUAL_INT(-1, asked(-4 * SECOND));
    natnet_write_models(&writer, bodies, 2, false);
    take();
    TEST_ASSERT_EQUAL_INT(0, asked(-3 * SECOND)); /* for there are no frames */
    TEST_ASSERT_EQUAL_INT(-1, asked(-3 * SECOND));
    write_crowded();
    take();
    TEST_ASSERT_EQUAL_INT(-1, asked(-2 * SECOND));
    TEST_ASSERT_EQUAL_INT(0, asked(-1 * SECOND)); /* for there are none any more */
}

static void test_asks_for_names_when_bodies_change(void)
{
    struct written_frame written = crowded_frame();

    meet(3, 0);
    while (asked(0) >= 0)
        ;
    natnet_write_models(&writer, bodies, 1, false);
    take();
    written.count = 1;
    natnet_write_frame(&writer, &written);
    take();
    TEST_ASSERT_EQUAL_INT(-1, asked(SECOND));
    written.models_changed = true;
    natnet_write_frame(&writer, &written);
    take();
    TEST_ASSERT_EQUAL_INT(4, asked(SECOND));
    TEST_ASSERT_EQUAL_INT(-1, asked(SECOND));
    natnet_write_models(&writer, bodies, 1, false);
    take();
    written.models_changed = false;
    written.count = 2; /* a body whose name is not known */
    natnet_write_frame(&writer, &written);
    take();
    TEST_ASSERT_EQUAL_STRING("mu-03", frame.body[0].name);
    TEST_ASSERT_EQUAL_STRING("", frame.body[1].name);
    TEST_ASSERT_EQUAL_INT(4, asked(2 * SECOND));
}

static void test_keeps_unicast_alive(void)
{
    begin(&(struct capture_options){.unicast = true});
    TEST_ASSERT_EQUAL_INT(0, asked(0));
    meet(3, 0);
    natnet_write_models(&writer, bodies, 2, false);
    take();
    write_crowded();
    take();
    TEST_ASSERT_EQUAL_INT(10, asked(0));
    TEST_ASSERT_EQUAL_INT(-1, asked(0));
    take();
    TEST_ASSERT_EQUAL_INT(10, asked(SECOND));
}

static void test_a_broken_list_of_names_changes_nothing(void)
{
    meet(4, 2);
    natnet_write_models(&writer, bodies, 2, true);
    TEST_ASSERT_EQUAL(CAPTURE_NOTHING, take());
    for (size_t cut = 1; cut < writer.count - 8; cut++) {
        uint8_t bytes[2048];
        size_t count = writer.count - cut;
        memcpy(bytes, writer.bytes, count);
        bytes[2] = (uint8_t)(count - 4);
        bytes[3] = (uint8_t)((count - 4) >> 8);
        TEST_ASSERT_EQUAL(CAPTURE_BROKEN, take_bytes(bytes, count));
    }
    write_crowded();
    take();
    TEST_ASSERT_EQUAL_STRING("mu-07", frame.body[1].name);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_every_version);
    RUN_TEST(test_the_arena_is_understood);
    RUN_TEST(test_no_other_version_understands_it);
    RUN_TEST(test_unknown_versions_are_refused);
    RUN_TEST(test_listening_needs_a_version);
    RUN_TEST(test_what_the_system_tells);
    RUN_TEST(test_lost_bodies);
    RUN_TEST(test_latency);
    RUN_TEST(test_optional_parts_of_the_suffix);
    RUN_TEST(test_cut_and_broken_frames);
    RUN_TEST(test_section_sizes_have_to_fit);
    RUN_TEST(test_more_bodies_than_there_is_room_for);
    RUN_TEST(test_messages_of_no_concern);
    RUN_TEST(test_asks_until_it_is_answered);
    RUN_TEST(test_asks_for_names_when_bodies_change);
    RUN_TEST(test_keeps_unicast_alive);
    RUN_TEST(test_a_broken_list_of_names_changes_nothing);
    return UNITY_END();
}
