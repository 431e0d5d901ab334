/* Somebody sets the date while robots drive: nothing depends on it. */
#include "stage.h"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>
#include <unity.h>

#define SECOND 50

static struct stage stage;
static char date[] = "/tmp/muster-date-XXXXXX";
static int file = -1;

void setUp(void)
{
}

void tearDown(void)
{
    stage_close(&stage);
    if (file >= 0) {
        close(file);
        unlink(date);
    }
}

static void set_date(int64_t offset_s)
{
    TEST_ASSERT_EQUAL_INT(sizeof offset_s, pwrite(file, &offset_s, sizeof offset_s, 0));
}

static void step(int64_t offset_s)
{
    stage_mark(&stage);
    set_date(offset_s);
    stage_ticks(&stage, SECOND);
    for (unsigned id = 1; id <= STAGE_ROBOTS; id++)
        stage_drove_on(&stage, id);
}

static void nothing_depends_on_the_date(void)
{
    static const struct stage_plan plan = {
        .duration = 8,
        .cable = CABLE_TCP,
        .preload = STAGE_DATE_LIBRARY,
    };

    file = mkstemp(date);
    TEST_ASSERT_TRUE(file >= 0);
    set_date(0);
    setenv("STAGE_DATE", date, 1);
    setenv("ASAN_OPTIONS", "verify_asan_link_order=0", 1); /* a preloaded library comes first */
    stage_open(&stage, &plan);
    stage_begin(&stage);
    stage_ticks(&stage, SECOND);
    step(3600);
    step(-3600);
    step(0);
    stage_server_ends(&stage, 0);
    stage_is_complete(&stage, 0.01);
    stage_expect(&stage, stage_summary(&stage, "\"mean_distance_error_m\"", "\"peak\"") <= 0.15,
                 "robots have left their vertices");
    stage_expect(&stage, stage_summary(&stage, "\"pose_to_bytes_us\"", "\"max\"") < 1e6,
                 "poses were late");
    stage_end(&stage);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(nothing_depends_on_the_date);
    return stage_verdict();
}
