#include "census.h"

#include <stdlib.h>
#include <string.h>
#include <unity.h>

static struct census census;
static struct capture_frame frame;

void setUp(void)
{
    memset(&census, 0, sizeof census);
    memset(&frame, 0, sizeof frame);
}

void tearDown(void)
{
}

static void put_body(const char *name, int32_t id, bool tracked)
{
    struct capture_body *body = &frame.body[frame.count++];

    strcpy(body->name, name);
    body->id = id;
    body->tracked = tracked;
}

static void test_bodies_are_told_apart(void)
{
    put_body("one", 1, true);
    put_body("one", 2, true);
    put_body("two", CAPTURE_ID_NONE, false);
    census_take(&census, &frame, 0);
    frame.count = 0;
    put_body("two", CAPTURE_ID_NONE, true); /* in another order, and not all of them */
    put_body("one", 1, true);
    census_take(&census, &frame, 8000);
    TEST_ASSERT_EQUAL_UINT(3, census.count);
    TEST_ASSERT_EQUAL_UINT(2, census.body[0].frames);
    TEST_ASSERT_EQUAL_UINT(1, census.body[1].frames);
    TEST_ASSERT_EQUAL_UINT(2, census.body[2].frames);
    TEST_ASSERT_EQUAL_UINT(1, census.body[2].frames_tracked);
    TEST_ASSERT_EQUAL_UINT(3, census_tracked(&census));
}

static void test_rate_and_gaps(void)
{
    static const struct {
        int64_t at_us;
        bool tracked;
    } frames[] = {{1000000, true}, {1010000, true}, {1015000, false}, {1040000, true}};

    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0, census_rate(&census));
    put_body("one", 1, true);
    for (size_t i = 0; i < 4; i++) {
        frame.body[0].tracked = frames[i].tracked;
        census_take(&census, &frame, frames[i].at_us);
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 75, census_rate(&census));
    TEST_ASSERT_EQUAL_INT64(25000, census.gap_us);
    TEST_ASSERT_EQUAL_INT64(30000, census.body[0].gap_us);
    TEST_ASSERT_EQUAL_UINT(3, census.body[0].frames_tracked);
}

static void test_more_bodies_than_are_counted(void)
{
    for (int i = 0; i < CAPTURE_BODIES_MAX; i++)
        put_body("one", i, true);
    census_take(&census, &frame, 0);
    frame.count = 0;
    put_body("another", 1, true);
    census_take(&census, &frame, 1);
    TEST_ASSERT_EQUAL_UINT(CAPTURE_BODIES_MAX, census.count);
    TEST_ASSERT_EQUAL_UINT(2, census.frames);
}

static void test_the_table(void)
{
    char *text;
    size_t length;
    FILE *out = open_memstream(&text, &length);

    put_body("one", 7, true);
    put_body("", CAPTURE_ID_NONE, false);
    census_take(&census, &frame, 0);
    census_take(&census, &frame, 12800);
    census_print(&census, out);
    fclose(out);
    TEST_ASSERT_EQUAL_STRING("body                         id    frames  tracked  longest gap\n"
                             "one                           7         2  100.0 %      12.8 ms\n"
                             "-                             -         2    0.0 %       0.0 ms\n",
                             text);
    free(text);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_bodies_are_told_apart);
    RUN_TEST(test_rate_and_gaps);
    RUN_TEST(test_more_bodies_than_are_counted);
    RUN_TEST(test_the_table);
    return UNITY_END();
}
