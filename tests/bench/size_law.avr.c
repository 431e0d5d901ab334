/* Linked twice, with the motion law and without: the law's share of an image. */
#include "motion.h"

#include <avr/io.h>

#ifdef WITH_LAW
static struct message_mission mission;
static struct motion_goal goal;
static struct pose own;

static struct motion_command command(void)
{
    return motion_fl(&mission, &goal, &own);
}
#else
static struct motion_command command(void)
{
    return (struct motion_command){0, 0};
}
#endif

int main(void)
{
    struct motion_command c = command();

    for (;;)
        OCDR = (uint8_t)(c.v ^ c.omega);
}
