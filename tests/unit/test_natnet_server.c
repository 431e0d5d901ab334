#include "natnet_server.h"

#include <string.h>
#include <unity.h>

static const struct natnet_server system3 = {
    .version = {3, 0},
    .multicast = true,
    .group = {239, 255, 42, 99},
    .data_port = 1511,
};
static struct capture_frame frame;
static uint8_t bytes[4096];

void setUp(void)
{
    memset(&frame, 0, sizeof frame);
    frame.number = 0x01020304;
    frame.time = 2;
    frame.latency = 0.5;
    frame.count = 1;
    frame.body[0] = (struct capture_body){"Robot5", 5, true, {1, 2, -1}, {0, 0, 0, 1}};
}

void tearDown(void)
{
}

/* Every byte, worked out by hand. */
static void test_a_frame_of_3_0(void)
{
    static const uint8_t expected[] = {
        7,    0,    116,  0,                                     /* FRAME, bytes behind this */
        4,    3,    2,    1,                                     /* number */
        0,    0,    0,    0,    0, 0, 0, 0,                      /* marker sets, other markers */
        1,    0,    0,    0,    5, 0, 0, 0,                      /* bodies: number 5 */
        0,    0,    0x80, 0x3F, 0, 0, 0, 0x40, 0, 0, 0x80, 0xBF, /* 1, 2, -1 */
        0,    0,    0,    0,    0, 0, 0, 0,    0, 0, 0,    0,    0, 0, 0x80, 0x3F, /* turn */
        0,    0,    0,    0,    1, 0,          /* marker error, tracked */
        0,    0,    0,    0,    0, 0, 0, 0,    /* skeletons, labelled markers */
        0,    0,    0,    0,    0, 0, 0, 0,    /* plates, devices */
        0,    0,    0,    0,    0, 0, 0, 0,    /* timecode */
        0,    0,    0,    0,    0, 0, 0, 0x40, /* 2 s */
        0x80, 0x84, 0x1E, 0,    0, 0, 0, 0,    /* exposure, us */
        0x80, 0x84, 0x1E, 0,    0, 0, 0, 0,    /* arrival */
        0xA0, 0x25, 0x26, 0,    0, 0, 0, 0,    /* sending */
        0,    0,    0,    0,    0, 0,          /* parameters, end */
    };

    TEST_ASSERT_EQUAL_UINT(sizeof expected,
                           natnet_server_frame(&system3, &frame, bytes, sizeof bytes));
    TEST_ASSERT_EQUAL_MEMORY(expected, bytes, sizeof expected);
}

static void test_a_lost_body_says_so(void)
{
    frame.body[0].tracked = false;
    natnet_server_frame(&system3, &frame, bytes, sizeof bytes);
    TEST_ASSERT_EQUAL_HEX8(0, bytes[56]);
}

static void test_what_does_not_fit_is_not_written(void)
{
    size_t whole = natnet_server_frame(&system3, &frame, bytes, sizeof bytes);

    memset(bytes, 0xAA, sizeof bytes);
    for (size_t room = 0; room < whole; room++) {
        TEST_ASSERT_EQUAL_UINT(0, natnet_server_frame(&system3, &frame, bytes, room));
        TEST_ASSERT_EQUAL_HEX8(0xAA, bytes[room]);
    }
    TEST_ASSERT_EQUAL_UINT(whole, natnet_server_frame(&system3, &frame, bytes, whole));
}

static void test_versions(void)
{
    static const uint8_t good[][2] = {{2, 5}, {2, 11}, {3, 0}, {3, 1}, {4, 0}, {4, 2}};
    static const uint8_t bad[][2] = {{2, 4}, {1, 9}, {4, 3}, {0, 0}, {5, 0}};

    for (size_t i = 0; i < sizeof good / sizeof *good; i++)
        TEST_ASSERT_TRUE(natnet_server_speaks(good[i]));
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        TEST_ASSERT_FALSE(natnet_server_speaks(bad[i]));
}

static size_t ask(const struct natnet_server *server, uint8_t message, size_t count, bool *client)
{
    static uint8_t request[300];

    memset(request, 0, sizeof request);
    request[0] = message;
    request[2] = (uint8_t)(count - 4);
    request[3] = (uint8_t)((count - 4) >> 8);
    memset(request + 4, 0x5A, count - 4);
    return natnet_server_answer(server, &frame, 2, request, count, bytes, sizeof bytes, client);
}

static void test_connecting_asks_who_is_there(void)
{
    bool client;

    TEST_ASSERT_EQUAL_UINT(4 + 256 + 4 + 4 + 15, ask(&system3, 0, 274, &client));
    TEST_ASSERT_TRUE(client);
    TEST_ASSERT_EQUAL_HEX8(1, bytes[0]);
    TEST_ASSERT_EQUAL_STRING("Muster arena", (char *)bytes + 4);
    static const uint8_t tail[] = {3, 0, 0,    0,    0x40, 0x42, 0x0F, 0,  0, 0,
                                   0, 0, 0xE7, 0x05, 1,    239,  255,  42, 99};
    TEST_ASSERT_EQUAL_MEMORY(tail, bytes + 4 + 256 + 4, sizeof tail);
}

static void test_2_x_tells_no_ports(void)
{
    bool client;
    const struct natnet_server old = {.version = {2, 9}};

    TEST_ASSERT_EQUAL_UINT(4 + 256 + 4 + 4, ask(&old, 0, 274, &client));
}

static void test_the_other_questions(void)
{
    bool client;

    TEST_ASSERT_EQUAL_UINT(0, ask(&system3, 10, 4, &client)); /* keep-alive */
    TEST_ASSERT_TRUE(client);
    TEST_ASSERT_EQUAL_UINT(4 + 4 + 4 + 7 + 4 + 4 + 12 + 4,
                           ask(&system3, 4, 4, &client)); /* models */
    TEST_ASSERT_FALSE(client);
    TEST_ASSERT_EQUAL_HEX8(5, bytes[0]);
    TEST_ASSERT_EQUAL_STRING("Robot5", (char *)bytes + 12);
    TEST_ASSERT_EQUAL_UINT(4 + 16, ask(&system3, 12, 12, &client)); /* echo */
    TEST_ASSERT_EQUAL_HEX8(13, bytes[0]);
    TEST_ASSERT_EQUAL_HEX8(0x5A, bytes[4 + 7]);
    TEST_ASSERT_EQUAL_HEX8(0x80, bytes[12]);
    TEST_ASSERT_EQUAL_UINT(4,
                           ask(&system3, 2, 20, &client)); /* a request, of which none is known */
    TEST_ASSERT_EQUAL_HEX8(100, bytes[0]);
    TEST_ASSERT_EQUAL_UINT(0, ask(&system3, 7, 4, &client));
}

static void test_what_is_cut_off_is_not_answered(void)
{
    static const uint8_t connect[] = {0, 0, 2, 0, 1};
    static const uint8_t echo[] = {12, 0, 4, 0, 1, 2, 3, 4};
    bool client = true;

    for (size_t count = 0; count <= sizeof connect; count++) {
        TEST_ASSERT_EQUAL_UINT(0, natnet_server_answer(&system3, &frame, 0, connect, count, bytes,
                                                       sizeof bytes, &client));
        TEST_ASSERT_FALSE(client);
    }
    TEST_ASSERT_EQUAL_UINT(0, natnet_server_answer(&system3, &frame, 0, echo, sizeof echo, bytes,
                                                   sizeof bytes, &client));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_frame_of_3_0);
    RUN_TEST(test_a_lost_body_says_so);
    RUN_TEST(test_what_does_not_fit_is_not_written);
    RUN_TEST(test_versions);
    RUN_TEST(test_connecting_asks_who_is_there);
    RUN_TEST(test_2_x_tells_no_ports);
    RUN_TEST(test_the_other_questions);
    RUN_TEST(test_what_is_cut_off_is_not_answered);
    return UNITY_END();
}
