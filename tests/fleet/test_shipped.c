/* test_shipped.c FILE: one of scenarios/ is accepted, and leaves the same files from chips as from
 * native robots. */
#include "fleet.h"

#include <unity.h>

static const char *file;

void setUp(void)
{
}
void tearDown(void)
{
}

static void it_is_accepted(void)
{
    fleet_check(file);
}

static void chips_and_native_robots_leave_the_same_files(void)
{
    fleet_run(&(struct fleet_run){.file = file, .robots = SIM_AVR, .threads = 2, .out = "avr"});
    fleet_run(
        &(struct fleet_run){.file = file, .robots = SIM_NATIVE, .threads = 2, .out = "native"});
    fleet_same_files("avr", "native");
}

int main(int argc, char **argv)
{
    (void)argc;
    file = argv[1];
    UNITY_BEGIN();
    RUN_TEST(it_is_accepted);
    RUN_TEST(chips_and_native_robots_leave_the_same_files);
    return UNITY_END();
}
