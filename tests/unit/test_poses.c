#include "capturing.h"
#include "poses.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#define UPRIGHT "0,0,0,1"

static struct capturing poses;
static struct packet packet;

void setUp(void)
{
    packet.count = 0;
    capturing_begin(&poses, &poses_protocol, NULL);
}

void tearDown(void)
{
    capturing_end(&poses);
}

static enum capture_news take(void)
{
    return capturing_take_packet(&poses, &packet);
}

static void put_lines(const char *lines)
{
    put_text(&packet, POSES_HEADER "\n");
    put_text(&packet, lines);
}

static void test_frames(void)
{
    put_lines("0,one,7,1,2,3," UPRIGHT ",1\n"
              "0,\"t,\"\"wo\",,4,5,6,0,0,0.6,0.8,0\r\n"
              "0.01,one,7,1.5,2,3," UPRIGHT ",1\n");
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take());
    TEST_ASSERT_EQUAL_UINT(2, poses.frame.count);
    TEST_ASSERT_TRUE(poses.frame.time == 0);
    ASSERT_BODY("one", 7, true, poses.frame.body[0]);
    ASSERT_AT(1, 2, 3, poses.frame.body[0]);
    ASSERT_BODY("t,\"wo", CAPTURE_ID_NONE, false, poses.frame.body[1]);
    ASSERT_TURN(0, 0, 0.6, 0.8, poses.frame.body[1]);
    TEST_ASSERT_EQUAL_INT(CAPTURE_NOTHING, take());
    TEST_ASSERT_EQUAL_UINT(0, packet.count);
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take()); /* the end of the file */
    TEST_ASSERT_EQUAL_UINT(1, poses.frame.count);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.01, poses.frame.time);
    TEST_ASSERT_EQUAL_INT(CAPTURE_NOTHING, take());
}

static void test_lines_come_in_pieces(void)
{
    put_lines("0,one,7,1,2,3," UPRIGHT ",1\n");
    for (size_t i = 0; i < packet.count; i++) {
        TEST_ASSERT_EQUAL_INT(CAPTURE_NOTHING, capturing_take(&poses, packet.bytes, i));
        if (poses.used > 0)
            i = (size_t)-1;
        packet.count -= poses.used;
        memmove(packet.bytes, packet.bytes + poses.used, packet.count);
    }
    TEST_ASSERT_EQUAL_INT(CAPTURE_NOTHING, take());
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take());
    ASSERT_BODY("one", 7, true, poses.frame.body[0]);
}

static void assert_refused(const char *words, const char *line)
{
    poses_protocol.begin(poses.session, NULL);
    packet.count = 0;
    put_lines("1,one,7,1,2,3," UPRIGHT ",1\n");
    put_text(&packet, line);
    put_text(&packet, "\n");
    TEST_ASSERT_EQUAL_INT_MESSAGE(CAPTURE_BROKEN, take(), line);
    TEST_ASSERT_EQUAL_STRING_LEN_MESSAGE("line 3: ", poses.words, 8, line);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(poses.words, words), poses.words);
}

static void test_bad_lines(void)
{
    assert_refused("11 fields", "");
    assert_refused("11 fields", "1,one,7,1,2,3," UPRIGHT);
    assert_refused("11 fields", "1,one,7,1,2,3," UPRIGHT ",1,1");
    assert_refused("quotes", "1,\"one,7,1,2,3," UPRIGHT ",1");
    assert_refused("quotes", "1,\"one\"s,7,1,2,3," UPRIGHT ",1");
    assert_refused("t: ", "x,one,7,1,2,3," UPRIGHT ",1");
    assert_refused("t: ", "0.9,one,7,1,2,3," UPRIGHT ",1");
    assert_refused("body: ", "1,o\tne,7,1,2,3," UPRIGHT ",1");
    assert_refused("body: ", "1,"
                             "0123456789012345678901234567890123456789012345678901234567890123"
                             ",7,1,2,3," UPRIGHT ",1");
    assert_refused("id: ", "1,one,7.5,1,2,3," UPRIGHT ",1");
    assert_refused("id: ", "1,one,2147483648,1,2,3," UPRIGHT ",1");
    assert_refused("x to qw: ", "1,one,7,1,,3," UPRIGHT ",1");
    assert_refused("x to qw: ", "1,one,7,nan,2,3," UPRIGHT ",1");
    assert_refused("unit quaternion", "1,one,7,1,2,3,0,0,0,2,1");
    assert_refused("tracked: ", "1,one,7,1,2,3," UPRIGHT ",yes");
}

static void test_another_file(void)
{
    put_text(&packet, "t,robot,x,y,theta\n");
    TEST_ASSERT_EQUAL_INT(CAPTURE_BROKEN, take());
    TEST_ASSERT_EQUAL_STRING("line 1: the first line has to be " POSES_HEADER, poses.words);
}

static void test_a_line_without_end(void)
{
    for (int i = 0; i < 600; i++)
        put_text(&packet, "x");
    TEST_ASSERT_EQUAL_INT(CAPTURE_BROKEN, take());
    TEST_ASSERT_EQUAL_STRING("line 1: it is too long", poses.words);
}

static void test_too_many_bodies(void)
{
    put_lines("");
    enum capture_news news = CAPTURE_NOTHING;
    for (int i = 0; i <= CAPTURE_BODIES_MAX && news == CAPTURE_NOTHING; i++) {
        put_text(&packet, "1,one,7,1,2,3," UPRIGHT ",1\n");
        news = take();
    }
    TEST_ASSERT_EQUAL_INT(CAPTURE_BROKEN, news);
    TEST_ASSERT_NOT_NULL(strstr(poses.words, "line 514: more than 512 bodies"));
}

static void fill(struct capture_frame *frame)
{
    *frame = (struct capture_frame){
        .count = 3,
        .body =
            {
                {"plain", 12, true, {1.0 / 3, -2e-9, 12345.678}, {0, 0, 0.6, 0.8}},
                {"a, \"b\"\n", CAPTURE_ID_NONE, true, {0, 0, 0}, {0, 0, 0, 1}},
                {"", -5, false, {NAN, INFINITY, 1}, {NAN, 0, 0, 0}},
            },
    };
}

static void test_what_is_written_is_read(void)
{
    static struct capture_frame frame;
    char *text;
    size_t length;
    FILE *out = open_memstream(&text, &length);

    fill(&frame);
    poses_write_header(out);
    poses_write_frame(out, 500000, &frame);
    poses_write_frame(out, 500001, &frame);
    fclose(out);
    put_bytes(&packet, text, length);
    free(text);

    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take());
    TEST_ASSERT_EQUAL_UINT(3, poses.frame.count);
    TEST_ASSERT_TRUE(poses.frame.time == 0.5);
    ASSERT_BODY("plain", 12, true, poses.frame.body[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.0 / 3, poses.frame.body[0].at[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-18, -2e-9, poses.frame.body[0].at[1]);
    TEST_ASSERT_TRUE(poses.frame.body[0].turn[2] == 0.6);
    ASSERT_BODY("a, \"b\"_", CAPTURE_ID_NONE, true, poses.frame.body[1]);
    ASSERT_BODY("", -5, false, poses.frame.body[2]);
    ASSERT_AT(0, 0, 1, poses.frame.body[2]);
    take();
    TEST_ASSERT_EQUAL_INT(CAPTURE_FRAME, take());
    TEST_ASSERT_TRUE(poses.frame.time == 0.500001);
}

static void assert_t(int64_t t_us, struct poses_clock *clock, double time, int64_t arrival_us)
{
    static struct capture_frame frame;

    frame.time = time;
    TEST_ASSERT_TRUE(poses_clock_next(clock, &frame, arrival_us) == t_us);
}

static void test_the_clock_of_a_recording(void)
{
    struct poses_clock clock = {0};

    assert_t(0, &clock, 5000, 70);
    assert_t(8000, &clock, 5000.008, 12070); /* late, but measured in time */
    assert_t(8001, &clock, 5000.008, 12080);
    assert_t(9001, &clock, 4999, 13080); /* set back */
    assert_t(10001, &clock, 4999.001, 13090);
    assert_t(11001, &clock, 9000, 14090); /* set forward */
    assert_t(13001, &clock, NAN, 16090);
    assert_t(15001, &clock, 9000.1, 18090);
    assert_t(15002, &clock, NAN, 18000);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_frames);
    RUN_TEST(test_lines_come_in_pieces);
    RUN_TEST(test_bad_lines);
    RUN_TEST(test_another_file);
    RUN_TEST(test_a_line_without_end);
    RUN_TEST(test_too_many_bodies);
    RUN_TEST(test_what_is_written_is_read);
    RUN_TEST(test_the_clock_of_a_recording);
    return UNITY_END();
}
