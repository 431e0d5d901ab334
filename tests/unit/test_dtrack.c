#include "capturing.h"
#include "rotation.h"

#include <math.h>
#include <string.h>
#include <unity.h>

#define UPRIGHT "[1 0 0 0 1 0 0 0 1]"

static struct capturing dtrack;

void setUp(void)
{
    capturing_begin(&dtrack, &dtrack_protocol, NULL);
}

void tearDown(void)
{
    capturing_end(&dtrack);
}

static enum capture_news take(const char *text)
{
    return capturing_take(&dtrack, text, strlen(text));
}

static void test_bodies(void)
{
    TEST_ASSERT_EQUAL_INT(
        CAPTURE_FRAME,
        take("fr 21753\r\nts 39596.024831\r\n6dcal 3\r\n"
             "6d 2 [0 1.000][326.848 -187.216 109.503 -160.4704 -3.6963 -7.0913]"
             "[-0.940508 -0.339238 -0.019025 0.333599 -0.932599 0.137735 -0.064467 0.123194 "
             "0.990286] [2 0.5][1.0 2.0 3.0 0 0 0][0 1 0 -1 0 0 0 0 1]\r\n"
             "3d 0\r\n"));
    TEST_ASSERT_TRUE(dtrack.frame.numbered);
    TEST_ASSERT_EQUAL_UINT32(21753, dtrack.frame.number);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 39596.024831, dtrack.frame.time);
    TEST_ASSERT_EQUAL_UINT(2, dtrack.frame.count);
    ASSERT_BODY("", 0, true, dtrack.frame.body[0]);
    ASSERT_AT(0.326848, -0.187216, 0.109503, dtrack.frame.body[0]);
    ASSERT_BODY("", 2, true, dtrack.frame.body[1]);
    ASSERT_TURN(0, 0, 0.70710678, 0.70710678, dtrack.frame.body[1]);
}

/* The manual's example has the matrix's angles beside it, in degrees about z, y and x: by its own
 * formula R = Rx Ry Rz, which rows for columns would not give. */
static void test_the_manuals_matrix(void)
{
    const double angles[3] = {-7.0913 * M_PI / 180, -3.6963 * M_PI / 180, -160.4704 * M_PI / 180};
    double turn[4];

    TEST_ASSERT_EQUAL_INT(
        CAPTURE_FRAME,
        take("fr 1\r\n6d 1 [0 1.000][326.848 -187.216 109.503 -160.4704 -3.6963 -7.0913]"
             "[-0.940508 -0.339238 -0.019025 0.333599 -0.932599 0.137735 -0.064467 0.123194 "
             "0.990286]\r\n"));
    TEST_ASSERT_TRUE(rotation_of_angles(angles, turn));
    double sign = turn[2] * dtrack.frame.body[0].turn[2] < 0 ? -1 : 1;
    for (int i = 0; i < 4; i++)
        TEST_ASSERT_DOUBLE_WITHIN(2e-6, turn[i], sign * dtrack.frame.body[0].turn[i]);
}

static void test_the_longer_time(void)
{
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take("fr 1\r\nts2 1700000000 250000 8000\r\n6d 0\r\n"));
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 1700000000.25, dtrack.frame.time);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.008, dtrack.frame.latency);
    TEST_ASSERT_EQUAL_UINT(0, dtrack.frame.count);
}

static void test_no_time(void)
{
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take("fr 1\n6d 0\n"));
    TEST_ASSERT_TRUE(isnan(dtrack.frame.time));
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take("fr 1\nts -1\n6d 0"));
    TEST_ASSERT_TRUE(isnan(dtrack.frame.time));
}

static void test_bodies_that_are_not_tracked(void)
{
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME,
                          take("fr 1\r\n6d 3 "
                               "[0 -1.000][1 2 3 0 0 0]" UPRIGHT "[1 0.000][1 2 3 0 0 0]" UPRIGHT
                               "[2 1.000][1 2 3 0 0 0][0 0 0 0 0 0 0 0 0]\r\n"));
    for (int i = 0; i < 3; i++)
        ASSERT_BODY("", i, false, dtrack.frame.body[i]);
}

static void test_an_output_without_bodies(void)
{
    TEST_ASSERT_EQUAL_INT(CAPTURE_TOLD, take("fr 1\r\n3d 0\r\n"));
    TEST_ASSERT_NOT_NULL(strstr(dtrack.words, "6d"));
    TEST_ASSERT_EQUAL_INT(CAPTURE_NOTHING, take("fr 2\r\n3d 0\r\n"));
}

static void test_malformed(void)
{
    static const char *const wrong[] = {
        "",
        "hello",
        "6d 0\r\n",
        "fr x\r\n6d 0\r\n",
        "fr 4294967296\r\n6d 0\r\n",
        "fr 1\r\nts 1,5\r\n6d 0\r\n",
        "fr 1\r\nts2 1 1000000 0\r\n6d 0\r\n",
        "fr 1\r\n6d\r\n",
        "fr 1\r\n6d -1\r\n",
        "fr 1\r\n6d 513\r\n",
        "fr 1\r\n6d 1\r\n",
        "fr 1\r\n6d 1 [0 1][1 2 3 0 0 0]\r\n",
        "fr 1\r\n6d 1 [0 1][1 2 3 0 0]" UPRIGHT "\r\n",
        "fr 1\r\n6d 1 [0 1][1 2 3 0 0 0 0]" UPRIGHT "\r\n",
        "fr 1\r\n6d 1 [0 1][1 2 nan 0 0 0]" UPRIGHT "\r\n",
        "fr 1\r\n6d 1 [0.5 1][1 2 3 0 0 0]" UPRIGHT "\r\n",
        "fr 1\r\n6d 1 [0 1][1 2 3 0 0 0]" UPRIGHT "[1 1][1 2 3 0 0 0]" UPRIGHT "\r\n",
        "fr 1\r\n6d 1 [0 1][1 2 3 0 0 0][1 0 0 0 1 0 0 0 1\r\n",
    };

    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        TEST_ASSERT_EQUAL_INT_MESSAGE(CAPTURE_BROKEN, take(wrong[i]), wrong[i]);
    TEST_ASSERT_EQUAL_STRING("line 2 of a datagram is no output of DTrack's", dtrack.words);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_bodies);
    RUN_TEST(test_the_manuals_matrix);
    RUN_TEST(test_the_longer_time);
    RUN_TEST(test_no_time);
    RUN_TEST(test_bodies_that_are_not_tracked);
    RUN_TEST(test_an_output_without_bodies);
    RUN_TEST(test_malformed);
    return UNITY_END();
}
