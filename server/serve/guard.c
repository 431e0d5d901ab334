#include "guard.h"

#include <math.h>

/* How far a robot is beyond the fence, m; 0 inside. */
static double beyond(const double fence[4], const struct guard_robot *robot)
{
    double x = fmax(0, fmax(fence[0] - robot->x, robot->x - fence[2]));
    double y = fmax(0, fmax(fence[1] - robot->y, robot->y - fence[3]));

    return hypot(x, y);
}

static struct guard_alarm farthest_out(const struct guard_limits *limits,
                                       const struct guard_robot *robots, size_t count)
{
    struct guard_alarm alarm = {.finding = GUARD_GOOD};

    for (size_t i = 0; i < count; i++) {
        double distance = robots[i].placed ? beyond(limits->fence, &robots[i]) : 0;

        if (distance > alarm.distance)
            alarm = (struct guard_alarm){GUARD_FENCE, i, i, distance};
    }
    return alarm;
}

static struct guard_alarm nearest_pair(const struct guard_limits *limits,
                                       const struct guard_robot *robots, size_t count)
{
    struct guard_alarm alarm = {.finding = GUARD_GOOD};
    double least = limits->separation * limits->separation;

    for (size_t i = 0; i < count; i++) {
        for (size_t j = i + 1; robots[i].placed && j < count; j++) {
            double dx = robots[i].x - robots[j].x;
            double dy = robots[i].y - robots[j].y;
            double square = dx * dx + dy * dy;

            if (robots[j].placed && square < least) {
                least = square;
                alarm = (struct guard_alarm){GUARD_SEPARATION, i, j, sqrt(square)};
            }
        }
    }
    return alarm;
}

struct guard_alarm guard_judge(const struct guard_limits *limits, const struct guard_robot *robots,
                               size_t count)
{
    struct guard_alarm alarm = {.finding = GUARD_GOOD};

    if (limits->fenced)
        alarm = farthest_out(limits, robots, count);
    if (alarm.finding == GUARD_GOOD && limits->separation > 0)
        alarm = nearest_pair(limits, robots, count);
    return alarm;
}
