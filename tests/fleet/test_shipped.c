/* Every scenario in scenarios/ is accepted, and those with few robots leave the same files from
 * chips as from native robots: also those that have not been written yet. */
#include "fleet.h"

#include <string.h>
#include <unity.h>

/* In the names of scenarios with a hundred robots, which are too long a run for a test. */
#define LARGE "100"

void setUp(void)
{
}
void tearDown(void)
{
}

static void run_on_chips_and_natively(const char *file)
{
    char chips[128], native[128];

    if (strstr(file, LARGE) != NULL)
        return;
    snprintf(chips, sizeof chips, "%s-avr", file);
    snprintf(native, sizeof native, "%s-native", file);
    fleet_run(&(struct fleet_run){.file = file, .robots = SIM_AVR, .threads = 2, .out = chips});
    fleet_run(&(struct fleet_run){.file = file, .robots = SIM_NATIVE, .out = native});
    fleet_same_files(chips, native);
}

static void chips_and_native_robots_leave_the_same_files(void)
{
    fleet_each_scenario(run_on_chips_and_natively);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(chips_and_native_robots_leave_the_same_files);
    return UNITY_END();
}
