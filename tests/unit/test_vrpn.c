#include "capturing.h"

#include <math.h>
#include <string.h>
#include <unity.h>

#define POS_QUAT 5

static struct capturing vrpn;
static struct packet packet;

static void put_header(uint32_t body, uint32_t seconds, uint32_t microseconds, int32_t sender,
                       int32_t type)
{
    put_u32_be(&packet, 24 + body);
    put_u32_be(&packet, seconds);
    put_u32_be(&packet, microseconds);
    put_u32_be(&packet, (uint32_t)sender);
    put_u32_be(&packet, (uint32_t)type);
    put_u32_be(&packet, 77);
}

static void put_description(int32_t kind, int32_t number, const char *name)
{
    uint32_t length = (uint32_t)strlen(name) + 1;

    put_header(4 + length, 9, 9, number, kind);
    put_u32_be(&packet, length);
    put_field(&packet, name, length);
    put_zeros(&packet, -(4 + length) % 8);
}

static void put_pose(int32_t sender, uint32_t sensor, uint32_t microseconds, double x)
{
    const double pose[7] = {x, -2.5, 0.125, 0, 0, 0.6, 0.8};

    put_header(64, 100, microseconds, sender, POS_QUAT);
    put_u32_be(&packet, sensor);
    put_u32_be(&packet, 0xDEADBEEF);
    for (int i = 0; i < 7; i++)
        put_f64_be(&packet, pose[i]);
}

static enum capture_news take(void)
{
    return capturing_take_packet(&vrpn, &packet);
}

static void meet(void)
{
    put_field(&packet, "vrpn: ver. 07.34  0", 24);
    TEST_ASSERT_EQUAL_INT(CAPTURE_TOLD, take());
    put_description(-1, 0, "VRPN Control");
    put_description(-1, 3, "robot 1");
    put_description(-1, 4, "robot 2");
    put_description(-2, POS_QUAT - 1, "vrpn_Tracker Velocity");
    put_description(-2, POS_QUAT, "vrpn_Tracker Pos_Quat");
    TEST_ASSERT_EQUAL_INT(CAPTURE_NOTHING, take());
    TEST_ASSERT_EQUAL_UINT(0, packet.count);
}

void setUp(void)
{
    packet.count = 0;
    capturing_begin(&vrpn, &vrpn_protocol, NULL);
}

void tearDown(void)
{
    capturing_end(&vrpn);
}

static void test_cookies(void)
{
    uint8_t bytes[CAPTURE_ASK_MAX];

    TEST_ASSERT_EQUAL_UINT(24, vrpn_protocol.ask(vrpn.session, 0, bytes, sizeof bytes));
    TEST_ASSERT_EQUAL_MEMORY("vrpn: ver. 07.35  0\0\0\0\0\0", bytes, 24);
    TEST_ASSERT_EQUAL_UINT(0, vrpn_protocol.ask(vrpn.session, 0, bytes, sizeof bytes));

    put_field(&packet, "vrpn: ver. 07.34  0", 24);
    capturing_assert_cuts(&vrpn, &packet);
    TEST_ASSERT_EQUAL_INT(CAPTURE_TOLD, take());
    TEST_ASSERT_EQUAL_STRING("VRPN 07.34", vrpn.words);
    TEST_ASSERT_EQUAL_UINT(0, packet.count);
}

static void test_other_servers(void)
{
    TEST_ASSERT_EQUAL_INT(CAPTURE_REFUSED,
                          capturing_take(&vrpn, "vrpn: ver. 08.00  0\0\0\0\0", 24));
    TEST_ASSERT_NOT_NULL(strstr(vrpn.words, "another version"));
    TEST_ASSERT_EQUAL_INT(CAPTURE_REFUSED,
                          capturing_take(&vrpn, "HTTP/1.1 400 Bad Request\r\n", 24));
    TEST_ASSERT_NOT_NULL(strstr(vrpn.words, "no VRPN server"));
}

static void test_pose(void)
{
    meet();
    put_pose(3, 0, 250000, 1.5);
    capturing_assert_cuts(&vrpn, &packet);
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take());
    TEST_ASSERT_EQUAL_UINT(1, vrpn.frame.count);
    TEST_ASSERT_FALSE(vrpn.frame.numbered);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 100.25, vrpn.frame.time);
    ASSERT_BODY("robot 1", 0, true, vrpn.frame.body[0]);
    ASSERT_AT(1.5, -2.5, 0.125, vrpn.frame.body[0]);
    ASSERT_TURN(0, 0, 0.6, 0.8, vrpn.frame.body[0]);
    TEST_ASSERT_EQUAL_INT(CAPTURE_NOTHING, take());
}

static void test_one_time_is_one_frame(void)
{
    meet();
    put_pose(3, 0, 1000, 1);
    put_pose(4, 0, 1000, 2);
    put_pose(4, 1, 1000, 3);
    put_pose(4, 1, 2000, 4);
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take());
    TEST_ASSERT_EQUAL_UINT(3, vrpn.frame.count);
    ASSERT_BODY("robot 1", 0, true, vrpn.frame.body[0]);
    ASSERT_BODY("robot 2", 0, true, vrpn.frame.body[1]);
    ASSERT_BODY("robot 2", 1, true, vrpn.frame.body[2]);
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take());
    TEST_ASSERT_EQUAL_UINT(1, vrpn.frame.count);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 100.002, vrpn.frame.time);
    ASSERT_AT(4, -2.5, 0.125, vrpn.frame.body[0]);
}

static void test_another_time_is_another_frame(void)
{
    meet();
    put_pose(3, 0, 1000, 1);
    put_pose(4, 0, 1001, 2);
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take());
    TEST_ASSERT_EQUAL_UINT(1, vrpn.frame.count);
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take());
    TEST_ASSERT_EQUAL_UINT(1, vrpn.frame.count);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 100.001001, vrpn.frame.time);
    ASSERT_BODY("robot 2", 0, true, vrpn.frame.body[0]);
}

static void test_a_body_comes_once_in_a_frame(void)
{
    meet();
    put_pose(3, 0, 1000, 1);
    put_pose(4, 0, 1000, 2);
    put_pose(3, 0, 1000, 3);
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take());
    TEST_ASSERT_EQUAL_UINT(2, vrpn.frame.count);
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take());
    ASSERT_AT(3, -2.5, 0.125, vrpn.frame.body[0]);
}

static void test_a_full_frame(void)
{
    meet();
    for (uint32_t sensor = 0; sensor < CAPTURE_BODIES_MAX + 1; sensor++)
        put_pose(3, sensor, 1000, sensor);
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take());
    TEST_ASSERT_EQUAL_UINT(CAPTURE_BODIES_MAX, vrpn.frame.count);
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take());
    ASSERT_BODY("robot 1", CAPTURE_BODIES_MAX, true, vrpn.frame.body[0]);
}

static void test_what_is_of_no_concern(void)
{
    meet();
    put_header(3, 1, 1, 3, POS_QUAT - 1); /* another type, padded */
    put_zeros(&packet, 8);
    put_header(20, 1, 1, 0, -3); /* where to send by UDP */
    put_zeros(&packet, 24);
    put_pose(9, 0, 1, 1); /* nobody has said who that is */
    TEST_ASSERT_EQUAL_INT(CAPTURE_NOTHING, take());
    TEST_ASSERT_EQUAL_UINT(0, packet.count);
}

static void test_numbers_that_are_no_pose(void)
{
    meet();
    put_pose(3, 0, 1000, NAN);
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take());
    TEST_ASSERT_FALSE(vrpn.frame.body[0].tracked);
}

static void assert_broken(void)
{
    TEST_ASSERT_EQUAL_INT(CAPTURE_BROKEN, take());
    TEST_ASSERT_NOT_NULL(strstr(vrpn.words, "malformed"));
    packet.count = 0;
}

static void test_malformed(void)
{
    meet();
    put_header(-1u, 0, 0, 3, POS_QUAT); /* shorter than a header */
    assert_broken();
    put_header(64000, 0, 0, 3, POS_QUAT); /* longer than VRPN has room for */
    assert_broken();
    put_header(56, 0, 0, 3, POS_QUAT); /* a pose that ends early */
    put_zeros(&packet, 56);
    assert_broken();
    put_description(-1, 2000, "far");
    assert_broken();
    put_description(-1, -1, "near");
    assert_broken();
    put_header(8, 0, 0, 3, -1); /* a name without an end */
    put_text(&packet, "....name");
    assert_broken();
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_cookies);
    RUN_TEST(test_other_servers);
    RUN_TEST(test_pose);
    RUN_TEST(test_one_time_is_one_frame);
    RUN_TEST(test_another_time_is_another_frame);
    RUN_TEST(test_a_body_comes_once_in_a_frame);
    RUN_TEST(test_a_full_frame);
    RUN_TEST(test_what_is_of_no_concern);
    RUN_TEST(test_numbers_that_are_no_pose);
    RUN_TEST(test_malformed);
    return UNITY_END();
}
