/* The paper's simulations at 20 % loss and 50 ms delay, seeds 1 to 10, on simulated chips. */
#include "fleet.h"

#include <unity.h>

void setUp(void)
{
}
void tearDown(void)
{
}

static void completes(const char *file, uint16_t leader)
{
    for (uint64_t seed = 1; seed <= 10; seed++) {
        struct fleet_result r =
            fleet_run(&(struct fleet_run){.file = file,
                                          .settings = {"network.loss=0.2", "network.delay=0.05"},
                                          .robots = SIM_AVR,
                                          .seed = seed});

        TEST_ASSERT_EQUAL_UINT16(leader, r.leader);
        TEST_ASSERT_TRUE(r.summary.metrics.complete);
        TEST_ASSERT_TRUE(r.summary.metrics.error_final <= 0.05);
    }
}

static void leader_fault(void)
{
    completes("paper-sim-leader-fault.yaml", 2);
}

static void formation_change(void)
{
    completes("paper-sim-formation-change.yaml", 1);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(leader_fault);
    RUN_TEST(formation_change);
    return UNITY_END();
}
