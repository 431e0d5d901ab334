/* A lost packet is not a lost leader: an hour at 20 % loss, native robots. DESIGN computes what to
 * expect; this holds it to less than one false take-over an hour. */
#include "fleet.h"

#include <unity.h>

void setUp(void)
{
}
void tearDown(void)
{
}

static void an_hour_at_20_percent_loss(void)
{
    static const char text[] =
        "schema: 1\nname: hour\nduration: 3600\nrobots:\n"
        "  - {id: 1, pose: [0, 0, 0], candidate: true}\n"
        "  - {id: 2, pose: [-1, 1, 0], candidate: true}\n"
        "  - {id: 3, pose: [-1, -1, 0]}\n"
        "network: {range: 1.5, loss: 0.2}\n"
        "trajectory: {start: [0, 0, 0], v: 0.2, omega: 0.1}\n"
        "formations:\n  V: {L: [0, 1, 1], psi: [0, 3*pi/4, -3*pi/4]}\nformation: V\n";
    uint64_t elections = 0;

    for (uint64_t seed = 1; seed <= 2; seed++) {
        struct fleet_result r =
            fleet_run(&(struct fleet_run){.text = text, .robots = SIM_NATIVE, .seed = seed});
        elections += r.summary.metrics.elections - 1;
    }
    TEST_ASSERT_TRUE(elections < 2);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(an_hour_at_20_percent_loss);
    return UNITY_END();
}
