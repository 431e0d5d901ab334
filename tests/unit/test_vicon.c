#include "capturing.h"

#include <math.h>
#include <unity.h>

static struct capturing vicon;
static struct packet packet;

void setUp(void)
{
    packet.count = 0;
    capturing_begin(&vicon, &vicon_protocol, NULL);
}

void tearDown(void)
{
    capturing_end(&vicon);
}

static void put_frame(uint32_t number, uint8_t items)
{
    put_u32_le(&packet, number);
    put_u8(&packet, items);
}

static void put_object(const char *name, double x, double y, double z, double rx, double ry,
                       double rz)
{
    const double value[6] = {x, y, z, rx, ry, rz};

    put_u8(&packet, 0);
    put_u16_le(&packet, 72);
    put_field(&packet, name, 24);
    for (int i = 0; i < 6; i++)
        put_f64_le(&packet, value[i]);
}

static enum capture_news take(void)
{
    return capturing_take_packet(&vicon, &packet);
}

static void test_objects(void)
{
    put_frame(4711, 2);
    put_object("robot 1", 1500, -250, 12.5, 0, 0, M_PI / 2);
    put_object("a name of just 24 bytes!", 0, 1, 0, M_PI / 2, 0, 0);
    capturing_assert_cuts(&vicon, &packet);
    put_zeros(&packet, 1024 - packet.count);
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take());
    TEST_ASSERT_EQUAL_UINT(0, packet.count);
    TEST_ASSERT_TRUE(vicon.frame.numbered);
    TEST_ASSERT_EQUAL_UINT32(4711, vicon.frame.number);
    TEST_ASSERT_TRUE(isnan(vicon.frame.time));
    TEST_ASSERT_EQUAL_UINT(2, vicon.frame.count);
    ASSERT_BODY("robot 1", CAPTURE_ID_NONE, true, vicon.frame.body[0]);
    ASSERT_AT(1.5, -0.25, 0.0125, vicon.frame.body[0]);
    ASSERT_TURN(0, 0, 0.70710678, 0.70710678, vicon.frame.body[0]);
    ASSERT_BODY("a name of just 24 bytes!", CAPTURE_ID_NONE, true, vicon.frame.body[1]);
    ASSERT_TURN(0.70710678, 0, 0, 0.70710678, vicon.frame.body[1]);
}

static void test_objects_that_are_not_seen(void)
{
    put_frame(1, 2);
    put_object("noughts", 0, 0, 0, 0, 0, 0);
    put_object("nan", NAN, 0, 0, 0, 0, 0);
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take());
    ASSERT_BODY("noughts", CAPTURE_ID_NONE, false, vicon.frame.body[0]);
    ASSERT_BODY("nan", CAPTURE_ID_NONE, false, vicon.frame.body[1]);
}

static void test_no_objects(void)
{
    put_frame(1, 0);
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take());
    TEST_ASSERT_EQUAL_UINT(0, vicon.frame.count);
    put_frame(1, 0);
    put_zeros(&packet, 1019);
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take());
    put_frame(1, 0);
    put_text(&packet, "no objects");
    TEST_ASSERT_EQUAL_INT(CAPTURE_BROKEN, take());
}

static void test_other_items_are_skipped(void)
{
    put_frame(1, 2);
    put_u8(&packet, 1);
    put_u16_le(&packet, 3);
    put_zeros(&packet, 3);
    put_object("robot 1", 1000, 0, 0, 0, 0, 0);
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take());
    TEST_ASSERT_EQUAL_UINT(1, vicon.frame.count);
    ASSERT_AT(1, 0, 0, vicon.frame.body[0]);
}

static void test_sizes_that_are_wrong(void)
{
    put_frame(1, 1);
    put_u8(&packet, 0);
    put_u16_le(&packet, 71);
    put_zeros(&packet, 80);
    TEST_ASSERT_EQUAL_INT(CAPTURE_BROKEN, take());
    put_frame(1, 3);
    put_object("robot 1", 1000, 0, 0, 0, 0, 0);
    put_object("robot 2", 1000, 0, 0, 0, 0, 0);
    TEST_ASSERT_EQUAL_INT(CAPTURE_BROKEN, take());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_objects);
    RUN_TEST(test_objects_that_are_not_seen);
    RUN_TEST(test_no_objects);
    RUN_TEST(test_other_items_are_skipped);
    RUN_TEST(test_sizes_that_are_wrong);
    return UNITY_END();
}
