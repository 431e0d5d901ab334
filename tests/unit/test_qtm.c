#include "capturing.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unity.h>

#define SECOND INT64_C(1000000)
#define NAMES(a, b)                                                                                \
    "<Q><The_6D><Body><Name>" a "</Name></Body><Body><Name>" b "</Name></Body></The_6D></Q>"

enum { KIND_ERROR, KIND_COMMAND, KIND_XML, KIND_DATA, KIND_END, KIND_EVENT = 6 };

static struct capturing qtm;
static struct packet packet;

void setUp(void)
{
    packet.count = 0;
    capturing_begin(&qtm, &qtm_protocol, NULL);
}

void tearDown(void)
{
    capturing_end(&qtm);
}

static enum capture_news take(void)
{
    return capturing_take_packet(&qtm, &packet);
}

static void put_header(uint32_t count, uint32_t kind)
{
    put_u32_le(&packet, 8 + count);
    put_u32_le(&packet, kind);
}

/* All that QTM says at once, until it is read or makes news. */
static enum capture_news hear(uint32_t kind, const char *text)
{
    enum capture_news news;

    put_header((uint32_t)strlen(text) + 1, kind);
    put_field(&packet, text, strlen(text) + 1);
    do
        news = take();
    while (news == CAPTURE_NOTHING && packet.count > 0 && qtm.used > 0);
    return news;
}

static enum capture_news hear_event(uint8_t event)
{
    put_header(1, KIND_EVENT);
    put_u8(&packet, event);
    return take();
}

/* NaN for x: the body is lost. Turned a quarter to the left. */
static void put_frame(uint32_t number, uint32_t bodies, float x)
{
    const float columns[9] = {0, 1, 0, -1, 0, 0, 0, 0, 1};

    put_header(16 + 16 + 48 * bodies, KIND_DATA);
    put_u64_le(&packet, 2500000);
    put_u32_le(&packet, number);
    put_u32_le(&packet, 1);
    put_u32_le(&packet, 16 + 48 * bodies);
    put_u32_le(&packet, 5);
    put_u32_le(&packet, bodies);
    put_u32_le(&packet, 0);
    for (uint32_t i = 0; i < bodies; i++) {
        put_f32_le(&packet, x + (float)i);
        put_f32_le(&packet, isnan(x) ? x : -2000);
        put_f32_le(&packet, isnan(x) ? x : 125);
        for (int k = 0; k < 9; k++)
            put_f32_le(&packet, isnan(x) ? x : columns[k]);
    }
}

static void assert_asks(const char *command, int64_t now_us)
{
    uint8_t bytes[CAPTURE_ASK_MAX];
    uint32_t length = (uint32_t)strlen(command);
    const uint8_t header[8] = {(uint8_t)(9 + length), 0, 0, 0, KIND_COMMAND, 0, 0, 0};

    TEST_ASSERT_EQUAL_UINT(9 + length, qtm_protocol.ask(qtm.session, now_us, bytes, sizeof bytes));
    TEST_ASSERT_EQUAL_MEMORY(header, bytes, 8);
    TEST_ASSERT_EQUAL_STRING(command, (const char *)bytes + 8);
}

static void assert_asks_nothing(int64_t now_us)
{
    uint8_t bytes[CAPTURE_ASK_MAX];

    TEST_ASSERT_EQUAL_UINT(0, qtm_protocol.ask(qtm.session, now_us, bytes, sizeof bytes));
}

static void agree(void)
{
    assert_asks_nothing(0);
    TEST_ASSERT_EQUAL_INT(CAPTURE_NOTHING, hear(KIND_COMMAND, "QTM RT Interface connected"));
    assert_asks("Version 1.28", 0);
    assert_asks_nothing(0);
    TEST_ASSERT_EQUAL_INT(CAPTURE_TOLD, hear(KIND_COMMAND, "Version set to 1.28"));
    TEST_ASSERT_EQUAL_STRING("QTM 1.28", qtm.words);
}

static void stream(void)
{
    agree();
    assert_asks("GetParameters 6d", 0);
    assert_asks_nothing(0);
    TEST_ASSERT_EQUAL_INT(CAPTURE_TOLD, hear(KIND_XML, NAMES("one", "two")));
    TEST_ASSERT_EQUAL_STRING("QTM 1.28 with 2 bodies", qtm.words);
    assert_asks("StreamFrames AllFrames 6d", 0);
    assert_asks_nothing(0);
}

static void test_frames(void)
{
    stream();
    put_frame(42, 2, 1500);
    capturing_assert_cuts(&qtm, &packet);
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take());
    TEST_ASSERT_EQUAL_UINT(0, packet.count);
    TEST_ASSERT_TRUE(qtm.frame.numbered);
    TEST_ASSERT_EQUAL_UINT32(42, qtm.frame.number);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2.5, qtm.frame.time);
    TEST_ASSERT_EQUAL_UINT(2, qtm.frame.count);
    ASSERT_BODY("one", CAPTURE_ID_NONE, true, qtm.frame.body[0]);
    ASSERT_AT(1.5, -2, 0.125, qtm.frame.body[0]);
    ASSERT_TURN(0, 0, 0.70710678, 0.70710678, qtm.frame.body[0]);
    ASSERT_BODY("two", CAPTURE_ID_NONE, true, qtm.frame.body[1]);
    ASSERT_AT(1.501, -2, 0.125, qtm.frame.body[1]);
}

static void test_lost_bodies(void)
{
    stream();
    put_frame(42, 2, NAN);
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take());
    ASSERT_BODY("one", CAPTURE_ID_NONE, false, qtm.frame.body[0]);
}

static void test_older_versions(void)
{
    hear(KIND_COMMAND, "QTM RT Interface connected");
    assert_asks("Version 1.28", 0);
    TEST_ASSERT_EQUAL_INT(CAPTURE_NOTHING, hear(KIND_ERROR, "Version NOT supported"));
    assert_asks("Version 1.24", 0);
    TEST_ASSERT_EQUAL_INT(CAPTURE_NOTHING, hear(KIND_COMMAND, "Version NOT supported"));
    assert_asks("Version 1.21", 0);
    TEST_ASSERT_EQUAL_INT(CAPTURE_TOLD, hear(KIND_COMMAND, "Version set to 1.21"));
    assert_asks("GetParameters 6d", 0);
}

static void test_no_version_in_common(void)
{
    enum capture_news news = hear(KIND_COMMAND, "QTM RT Interface connected");
    uint8_t bytes[CAPTURE_ASK_MAX];

    for (int i = 0; i < 7; i++) {
        TEST_ASSERT_EQUAL_INT(CAPTURE_NOTHING, news);
        TEST_ASSERT_TRUE(qtm_protocol.ask(qtm.session, 0, bytes, sizeof bytes) > 0);
        news = hear(KIND_ERROR, "Version NOT supported");
    }
    TEST_ASSERT_EQUAL_INT(CAPTURE_REFUSED, news);
    TEST_ASSERT_EQUAL_STRING("QTM speaks none of the versions 1.8 to 1.28: Version NOT supported",
                             qtm.words);
}

static void test_other_servers(void)
{
    TEST_ASSERT_EQUAL_INT(CAPTURE_REFUSED, hear(KIND_COMMAND, "220 ftp"));
    TEST_ASSERT_EQUAL_STRING("what answers is no QTM: 220 ftp", qtm.words);
    tearDown();
    setUp();
    TEST_ASSERT_EQUAL_INT(CAPTURE_BROKEN, capturing_take(&qtm, "HTTP/1.1 400\r\n", 14));
    TEST_ASSERT_EQUAL_STRING("a message of 1347703880 bytes, which is none of QTM's", qtm.words);
}

static void test_errors_are_told_and_it_is_asked_again(void)
{
    agree();
    assert_asks("GetParameters 6d", 0);
    TEST_ASSERT_EQUAL_INT(CAPTURE_TOLD, hear(KIND_ERROR, "Parameters not available"));
    TEST_ASSERT_EQUAL_STRING("QTM, asked for its bodies' names, answers: Parameters not available",
                             qtm.words);
    assert_asks_nothing(0);
    assert_asks_nothing(SECOND - 1);
    assert_asks("GetParameters 6d", SECOND);
    TEST_ASSERT_EQUAL_INT(CAPTURE_TOLD, hear(KIND_XML, NAMES("one", "two")));
    assert_asks("StreamFrames AllFrames 6d", SECOND);
    TEST_ASSERT_EQUAL_INT(CAPTURE_TOLD, hear(KIND_ERROR, "No measurement is running"));
    TEST_ASSERT_EQUAL_STRING("QTM, asked for frames, answers: No measurement is running",
                             qtm.words);
    assert_asks_nothing(SECOND);
    assert_asks("StreamFrames AllFrames 6d", 2 * SECOND);
}

static void test_frames_that_stop_are_asked_for_again(void)
{
    stream();
    put_frame(1, 2, 0);
    take();
    assert_asks_nothing(SECOND / 2);
    assert_asks_nothing(SECOND);
    put_header(0, KIND_END);
    TEST_ASSERT_EQUAL_INT(CAPTURE_NOTHING, take());
    assert_asks("StreamFrames AllFrames 6d", 3 * SECOND / 2);
    assert_asks_nothing(2 * SECOND);
}

static void test_changed_settings(void)
{
    stream();
    TEST_ASSERT_EQUAL_INT(CAPTURE_TOLD, hear_event(11));
    TEST_ASSERT_EQUAL_STRING("QTM's settings have changed", qtm.words);
    put_frame(1, 2, 0);
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take());
    TEST_ASSERT_EQUAL_UINT(0, qtm.frame.count);
    assert_asks("GetParameters 6d", SECOND);

    /* They change again before the answer is there: it is too old, and so are its names. */
    TEST_ASSERT_EQUAL_INT(CAPTURE_TOLD, hear_event(11));
    TEST_ASSERT_EQUAL_INT(CAPTURE_TOLD, hear(KIND_XML, NAMES("old", "names")));
    put_frame(2, 2, 0);
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take());
    TEST_ASSERT_EQUAL_UINT(0, qtm.frame.count);
    assert_asks("GetParameters 6d", SECOND);
    TEST_ASSERT_EQUAL_INT(CAPTURE_TOLD, hear(KIND_XML, NAMES("two", "one")));
    assert_asks("StreamFrames AllFrames 6d", SECOND);
    put_frame(3, 2, 0);
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take());
    ASSERT_BODY("two", CAPTURE_ID_NONE, true, qtm.frame.body[0]);
}

static void test_as_many_names_as_bodies_or_none(void)
{
    stream();
    put_frame(1, 3, 0);
    TEST_ASSERT_EQUAL_INT(CAPTURE_TOLD, take());
    TEST_ASSERT_EQUAL_STRING("QTM's frames have 3 bodies and its settings 2 names: which is whose?",
                             qtm.words);
    put_frame(2, 3, 0);
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take());
    TEST_ASSERT_EQUAL_UINT(0, qtm.frame.count);
    assert_asks_nothing(0);
    assert_asks("GetParameters 6d", SECOND);

    /* No better: it is not said again. */
    TEST_ASSERT_EQUAL_INT(CAPTURE_TOLD, hear(KIND_XML, NAMES("one", "two")));
    put_frame(3, 3, 0);
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take());
    TEST_ASSERT_EQUAL_UINT(0, qtm.frame.count);
}

static void test_names_of_any_length(void)
{
    agree();
    assert_asks("GetParameters 6d", 0);
    put_header(200000 + (uint32_t)strlen(NAMES("one", "two")), KIND_XML);
    enum capture_news news = take();
    for (int i = 0; i < 200; i++) {
        TEST_ASSERT_EQUAL_INT(CAPTURE_NOTHING, news);
        for (int k = 0; k < 1000; k++)
            put_u8(&packet, ' ');
        news = take();
        TEST_ASSERT_EQUAL_UINT(0, packet.count);
    }
    put_text(&packet, NAMES("one", "two"));
    TEST_ASSERT_EQUAL_INT(CAPTURE_TOLD, take());
    TEST_ASSERT_EQUAL_STRING("QTM 1.28 with 2 bodies", qtm.words);
}

static void test_frames_by_udp(void)
{
    static const char half[] = "<Q><The_6D><Body><Na";
    static const char rest[] = "me>one</Name></Body></The_6D></Q>";

    capturing_end(&qtm);
    capturing_begin(&qtm, &qtm_protocol, &(struct capture_options){.data_port = 4711});
    agree();
    assert_asks("GetParameters 6d", 0);
    put_header(sizeof half - 1 + sizeof rest - 1, KIND_XML);
    put_text(&packet, half);
    take();
    take();
    TEST_ASSERT_EQUAL_UINT(0, packet.count);

    put_frame(1, 1, 0); /* a late one, amid the names */
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take());
    TEST_ASSERT_EQUAL_UINT(0, qtm.frame.count);
    TEST_ASSERT_EQUAL_INT(CAPTURE_TOLD, capturing_take(&qtm, rest, sizeof rest - 1));
    assert_asks("StreamFrames AllFrames UDP:4711 6d", 0);
    put_frame(2, 1, 0);
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take());
    ASSERT_BODY("one", CAPTURE_ID_NONE, true, qtm.frame.body[0]);
}

static void test_other_components_and_messages(void)
{
    stream();
    put_header(16 + 12, KIND_DATA);
    put_zeros(&packet, 12);
    put_u32_le(&packet, 1);
    put_u32_le(&packet, 12);
    put_u32_le(&packet, 1); /* 3D */
    put_zeros(&packet, 4);
    TEST_ASSERT_EQUAL_INT(CAPTURE_NOTHING, take());
    TEST_ASSERT_EQUAL_INT(CAPTURE_NOTHING, hear(5, "a file"));
    TEST_ASSERT_EQUAL_INT(CAPTURE_NOTHING, hear(9, "something new"));
    TEST_ASSERT_EQUAL_INT(CAPTURE_NOTHING, hear(KIND_XML, "nobody asked"));
    TEST_ASSERT_EQUAL_UINT(0, packet.count);
}

static void assert_malformed_with(size_t at, uint8_t byte)
{
    packet.count = 0;
    put_frame(1, 2, 0);
    packet.bytes[at] = byte;
    TEST_ASSERT_EQUAL_INT(CAPTURE_BROKEN, take());
    TEST_ASSERT_EQUAL_STRING("a malformed frame from QTM", qtm.words);
}

static void test_malformed(void)
{
    stream();
    assert_malformed_with(20, 2);    /* components */
    assert_malformed_with(24, 7);    /* the component's size: less than its header */
    assert_malformed_with(24, 111);  /* less than its bodies */
    assert_malformed_with(25, 1);    /* more than there is */
    assert_malformed_with(32, 3);    /* bodies */
    assert_malformed_with(35, 0x80); /* 2,147,483,650 of them */

    packet.count = 0;
    put_frame(1, CAPTURE_BODIES_MAX + 1, 0);
    TEST_ASSERT_EQUAL_INT(CAPTURE_BROKEN, take());

    packet.count = 0;
    put_u32_le(&packet, 7);
    put_u32_le(&packet, KIND_DATA);
    TEST_ASSERT_EQUAL_INT(CAPTURE_BROKEN, take());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_frames);
    RUN_TEST(test_lost_bodies);
    RUN_TEST(test_older_versions);
    RUN_TEST(test_no_version_in_common);
    RUN_TEST(test_other_servers);
    RUN_TEST(test_errors_are_told_and_it_is_asked_again);
    RUN_TEST(test_frames_that_stop_are_asked_for_again);
    RUN_TEST(test_changed_settings);
    RUN_TEST(test_as_many_names_as_bodies_or_none);
    RUN_TEST(test_names_of_any_length);
    RUN_TEST(test_frames_by_udp);
    RUN_TEST(test_other_components_and_messages);
    RUN_TEST(test_malformed);
    return UNITY_END();
}
