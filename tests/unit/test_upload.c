#include "upload.h"

#include "random.h"

#include <unity.h>

static struct upload upload;

void setUp(void)
{
    upload_begin(&upload);
}

void tearDown(void)
{
}

static void add_knots(unsigned count)
{
    for (uint32_t i = 0; i < count; i++)
        upload_add(&upload, (struct upload_item){.kind = UPLOAD_KNOT, .index = i});
}

static void let_pass(unsigned ticks)
{
    for (unsigned i = 0; i < ticks; i++)
        upload_wait(&upload);
}

/* How many items may be sent now; they are. */
static unsigned send_all(void)
{
    struct upload_item item;
    uint8_t sequence;
    unsigned count = 0;

    while (upload_next(&upload, &item, &sequence))
        count++;
    return count;
}

static void assert_next(uint8_t expected)
{
    struct upload_item item;
    uint8_t sequence;

    TEST_ASSERT_TRUE(upload_next(&upload, &item, &sequence));
    TEST_ASSERT_EQUAL_UINT8(expected, sequence);
}

static void test_it_begins_with_the_mission_as_number_0(void)
{
    struct upload_item item;
    uint8_t sequence = 77;

    TEST_ASSERT_FALSE(upload_done(&upload));
    TEST_ASSERT_TRUE(upload_next(&upload, &item, &sequence));
    TEST_ASSERT_EQUAL_UINT8(UPLOAD_MISSION, item.kind);
    TEST_ASSERT_EQUAL_UINT8(0, sequence);
    TEST_ASSERT_FALSE(upload_next(&upload, &item, &sequence));
    TEST_ASSERT_FALSE(upload_done(&upload));
    TEST_ASSERT_TRUE(upload_acknowledge(&upload, 1));
    TEST_ASSERT_TRUE(upload_done(&upload));
}

static void test_items_are_sent_in_order(void)
{
    struct upload_item item;
    uint8_t sequence;

    add_knots(5);
    assert_next(0);
    for (uint8_t i = 0; i < 5; i++) {
        TEST_ASSERT_TRUE(upload_next(&upload, &item, &sequence));
        TEST_ASSERT_EQUAL_UINT8(i + 1, sequence);
        TEST_ASSERT_EQUAL_UINT8(UPLOAD_KNOT, item.kind);
        TEST_ASSERT_EQUAL_UINT32(i, item.index);
    }
}

static void test_no_more_than_the_window_is_on_its_way(void)
{
    add_knots(100);
    TEST_ASSERT_EQUAL_UINT(UPLOAD_WINDOW, send_all());
    TEST_ASSERT_TRUE(upload_acknowledge(&upload, 3));
    TEST_ASSERT_EQUAL_UINT(3, send_all());
    TEST_ASSERT_TRUE(upload_acknowledge(&upload, UPLOAD_WINDOW + 3));
    TEST_ASSERT_EQUAL_UINT(UPLOAD_WINDOW, send_all());
}

static void test_out_of_patience_it_goes_back_to_the_first_one_missing(void)
{
    add_knots(9);
    TEST_ASSERT_EQUAL_UINT(10, send_all());
    TEST_ASSERT_TRUE(upload_acknowledge(&upload, 4));
    let_pass(UPLOAD_PATIENCE_TICKS - 1);
    TEST_ASSERT_EQUAL_UINT(0, send_all());
    let_pass(1);
    assert_next(4);
    TEST_ASSERT_EQUAL_UINT(5, send_all());
    let_pass(UPLOAD_PATIENCE_TICKS);
    assert_next(4);
}

static void test_progress_renews_the_patience(void)
{
    add_knots(9);
    send_all();
    let_pass(UPLOAD_PATIENCE_TICKS - 1);
    TEST_ASSERT_TRUE(upload_acknowledge(&upload, 1));
    let_pass(UPLOAD_PATIENCE_TICKS - 1);
    TEST_ASSERT_EQUAL_UINT(0, send_all());
    TEST_ASSERT_TRUE(upload_acknowledge(&upload, 1)); /* nothing new */
    let_pass(1);
    assert_next(1);
}

static void test_with_nothing_on_its_way_patience_does_not_run_out(void)
{
    send_all();
    upload_acknowledge(&upload, 1);
    let_pass(UPLOAD_PATIENCE_TICKS - 1);
    add_knots(1);
    assert_next(1);
    let_pass(UPLOAD_PATIENCE_TICKS - 1);
    TEST_ASSERT_EQUAL_UINT(0, send_all());
}

static void test_what_was_acknowledged_meanwhile_is_not_sent_again(void)
{
    add_knots(9);
    send_all();
    let_pass(UPLOAD_PATIENCE_TICKS);
    assert_next(0);
    TEST_ASSERT_TRUE(upload_acknowledge(&upload, 6));
    assert_next(6);
}

static void test_a_number_that_was_not_sent_is_no_acknowledgement(void)
{
    add_knots(9);
    send_all();
    TEST_ASSERT_TRUE(upload_acknowledge(&upload, 5));
    TEST_ASSERT_FALSE(upload_acknowledge(&upload, 4));
    TEST_ASSERT_FALSE(upload_acknowledge(&upload, 0));
    TEST_ASSERT_FALSE(upload_acknowledge(&upload, 11));
    TEST_ASSERT_FALSE(upload_acknowledge(&upload, 255));
    TEST_ASSERT_TRUE(upload_acknowledge(&upload, 10));
    TEST_ASSERT_TRUE(upload_done(&upload));
}

static void test_255_items_have_room(void)
{
    TEST_ASSERT_EQUAL_UINT8(254, upload_room(&upload));
    add_knots(254);
    TEST_ASSERT_EQUAL_UINT8(0, upload_room(&upload));
    send_all();
    upload_acknowledge(&upload, 10);
    TEST_ASSERT_EQUAL_UINT8(10, upload_room(&upload));
}

static void test_beginning_anew_forgets_all(void)
{
    add_knots(50);
    send_all();
    upload_acknowledge(&upload, 20);
    TEST_ASSERT_TRUE(upload.taken);
    upload_begin(&upload);
    TEST_ASSERT_FALSE(upload.taken);
    TEST_ASSERT_EQUAL_UINT8(254, upload_room(&upload));
    TEST_ASSERT_EQUAL_UINT(1, send_all());
}

/* A robot that takes only what it expects, over a link that loses half of everything: numbers go
 * round at 256, and every item arrives once and in order. */
static void test_a_bad_link_gets_everything_in_order(void)
{
    const uint32_t items = 2000;
    struct upload_item item;
    uint32_t state = 1, added = 0, taken = 0;
    uint8_t sequence, expected = 0;

    for (unsigned tick = 0; tick < 1000000 && taken < items + 1; tick++) {
        for (; added < items && upload_room(&upload) > 0; added++)
            upload_add(&upload, (struct upload_item){.kind = UPLOAD_KNOT, .index = added});
        upload_wait(&upload);
        while (upload_next(&upload, &item, &sequence)) {
            if (random_next(&state) % 2 == 0 || sequence != expected)
                continue;
            TEST_ASSERT_EQUAL_UINT8(taken == 0 ? UPLOAD_MISSION : UPLOAD_KNOT, item.kind);
            TEST_ASSERT_EQUAL_UINT32(taken == 0 ? 0 : taken - 1, item.index);
            taken++;
            expected++;
        }
        bool heard = random_next(&state) % 2 == 0;
        TEST_ASSERT_TRUE(!heard || upload_acknowledge(&upload, expected));
    }
    TEST_ASSERT_EQUAL_UINT32(items + 1, taken);
    TEST_ASSERT_TRUE(upload_acknowledge(&upload, expected));
    TEST_ASSERT_TRUE(upload_done(&upload));
}

static void test_it_mentions_a_formation_until_all_of_it_is_acknowledged(void)
{
    upload_add(&upload, (struct upload_item){.kind = UPLOAD_VERTICES, .formation = 7});
    upload_add(&upload, (struct upload_item){.kind = UPLOAD_VERTICES, .formation = 7, .index = 8});
    upload_add(&upload, (struct upload_item){.kind = UPLOAD_KNOT, .formation = 9});
    send_all();
    TEST_ASSERT_TRUE(upload_acknowledge(&upload, 2));
    TEST_ASSERT_TRUE(upload_mentions(&upload, 7));
    TEST_ASSERT_FALSE(upload_mentions(&upload, 8));
    TEST_ASSERT_FALSE(upload_mentions(&upload, 9));
    TEST_ASSERT_TRUE(upload_acknowledge(&upload, 3));
    TEST_ASSERT_FALSE(upload_mentions(&upload, 7));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_it_begins_with_the_mission_as_number_0);
    RUN_TEST(test_items_are_sent_in_order);
    RUN_TEST(test_no_more_than_the_window_is_on_its_way);
    RUN_TEST(test_out_of_patience_it_goes_back_to_the_first_one_missing);
    RUN_TEST(test_progress_renews_the_patience);
    RUN_TEST(test_with_nothing_on_its_way_patience_does_not_run_out);
    RUN_TEST(test_what_was_acknowledged_meanwhile_is_not_sent_again);
    RUN_TEST(test_a_number_that_was_not_sent_is_no_acknowledgement);
    RUN_TEST(test_255_items_have_room);
    RUN_TEST(test_beginning_anew_forgets_all);
    RUN_TEST(test_a_bad_link_gets_everything_in_order);
    RUN_TEST(test_it_mentions_a_formation_until_all_of_it_is_acknowledged);
    return UNITY_END();
}
