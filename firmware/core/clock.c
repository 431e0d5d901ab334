#include "clock.h"

#include "limits.h"

/* A difference that no delay explains: the server counts from another start. */
#define JUMP_MS 1000

/* One millisecond a second: ten times the error of a bad crystal. */
#define LEAK_TICKS TICKS_PER_S

void clock_heard(struct clock *clock, int32_t time)
{
    clock->stamp = time;
    clock->heard = true;
}

void clock_heard_beacon(struct clock *clock, uint16_t time)
{
    int16_t ahead = (int16_t)(uint16_t)(time - (uint16_t)clock->now);

    if (!clock->set || ahead <= TICK_MS || ahead > JUMP_MS)
        return;
    int32_t stamp = clock->now + ahead;
    if (!clock->heard || (clock->stamp < stamp && stamp - clock->stamp < JUMP_MS))
        clock_heard(clock, stamp);
}

bool clock_tick(struct clock *clock)
{
    bool jumped = false;

    clock->now += TICK_MS;
    if (++clock->leak >= LEAK_TICKS) {
        clock->leak = 0;
        clock->now--;
    }
    if (clock->heard) {
        int32_t ahead = clock->stamp - clock->now;

        jumped = !clock->set || ahead > JUMP_MS || ahead < -JUMP_MS;
        if (jumped || ahead > 0)
            clock->now = clock->stamp;
        clock->set = true;
        clock->heard = false;
    }
    return jumped;
}

uint16_t clock_age(const struct clock *clock, uint16_t time)
{
    int16_t age = (int16_t)(uint16_t)((uint16_t)clock->now - time);

    /* Half the range of the stamp is past; a state from "the future" is one just measured. */
    return age >= 0 ? (uint16_t)age : age > -JUMP_MS ? 0 : UINT16_MAX;
}
