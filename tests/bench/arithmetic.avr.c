/* What control ticks are made of, one by one. Of direction_of() the results count too. */
#include "arithmetic_inputs.h"
#include "mark.h"

static struct vec16 vector;
static struct pose pose;
static struct sincos sincos;
static angle_t direction;

static void run_direction(void)
{
    direction = direction_of(vector);
}

static void run_sincos(void)
{
    sincos = sincos_of((angle_t)vector.x);
}

static void run_pose_advance(void)
{
    pose_advance(&pose, vector.x, vector.y, 1000);
}

int main(void)
{
    uint32_t state = ARITHMETIC_SEED;

    calibrate();
    for (uint16_t i = 0; i < ARITHMETIC_INPUTS; i++) {
        vector = arithmetic_vector(i, &state);
        measure(run_direction);
        tell(&direction, sizeof direction);
        measure(run_sincos);
        measure(run_pose_advance);
    }
    mark(MARK_DONE);
    for (;;)
        ;
}
