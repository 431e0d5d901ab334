#include "pace.h"

#include "limits.h"

#define LATE_MAX_NS 100000000

void pace_begin(struct pace *pace, double speed, int64_t now_ns)
{
    *pace = (struct pace){.speed = speed, .due_ns = now_ns};
}

void pace_set_speed(struct pace *pace, double speed, int64_t now_ns)
{
    pace->speed = speed;
    pace->due_ns = now_ns;
}

void pace_pause(struct pace *pace, bool paused, int64_t now_ns)
{
    pace->paused = paused;
    pace->step = false;
    pace->due_ns = now_ns;
}

void pace_step(struct pace *pace)
{
    pace->step = true;
}

int64_t pace_wait_ns(const struct pace *pace, int64_t now_ns)
{
    if (pace->paused)
        return pace->step ? 0 : PACE_NEVER;
    if (pace->speed == 0 || pace->due_ns <= now_ns)
        return 0;
    return pace->due_ns - now_ns;
}

void pace_tick(struct pace *pace, int64_t now_ns)
{
    pace->step = false;
    if (pace->speed == 0)
        return;
    pace->due_ns += (int64_t)(TICK_MS * 1e6 / pace->speed);
    if (now_ns - pace->due_ns > LATE_MAX_NS)
        pace->due_ns = now_ns - LATE_MAX_NS;
}
