#include "track.h"

#include <stdlib.h>
#include <string.h>
#include <unity.h>

/* 10 s of a run in 4 s, and 1 s of pause. */
static const struct timeline timeline = {.from = 20, .to = 30, .play = 4, .total = 5};

static struct track track;
static FILE *out;
static char *text;
static size_t length;

void setUp(void)
{
    out = open_memstream(&text, &length);
    TEST_ASSERT_NOT_NULL(out);
    TEST_ASSERT_TRUE(track_open(&track, &timeline));
}

void tearDown(void)
{
    free(text);
}

static void assert_track(const char *times, const char *values)
{
    char wanted[256];

    track_close(&track, out, "animate attributeName=\"r\"");
    fclose(out);
    snprintf(wanted, sizeof wanted,
             "<animate attributeName=\"r\" dur=\"5s\" repeatCount=\"indefinite\" keyTimes=\"%s\" "
             "values=\"%s\"/>",
             times, values);
    TEST_ASSERT_EQUAL_STRING(wanted, text);
}

static void the_run_goes_on_until_the_pause(void)
{
    TEST_ASSERT_TRUE(timeline_share(&timeline, 20) == 0);
    TEST_ASSERT_TRUE(timeline_share(&timeline, 25) == 0.4);
    TEST_ASSERT_TRUE(timeline_share(&timeline, 30) == 0.8);
    TEST_ASSERT_TRUE(timeline_share(&timeline, 10) == 0);
    TEST_ASSERT_TRUE(timeline_share(&timeline, 99) == 0.8);
    track_close(&track, out, "animate");
    fclose(out);
}

static void the_last_value_is_held(void)
{
    track_key(&track, 20, "%d %g", 1, 2.5);
    track_key(&track, 21, "%d %g", 3, 4.0);
    track_key(&track, 30, "%d %g", 5, 6.0);
    assert_track("0;.08;.8;1", "1 2.5;3 4;5 6;5 6");
}

static void the_first_value_is_there_from_the_beginning(void)
{
    track_key(&track, 25, "a");
    track_key(&track, 26.23456, "b");
    assert_track("0;.4;.4988;1", "a;a;b;b");
}

static void a_single_value_stays(void)
{
    track_key(&track, 20, "a");
    assert_track("0;1", "a;a");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(the_run_goes_on_until_the_pause);
    RUN_TEST(the_last_value_is_held);
    RUN_TEST(the_first_value_is_there_from_the_beginning);
    RUN_TEST(a_single_value_stays);
    return UNITY_END();
}
