#include "turns.h"

#include <math.h>
#include <stdio.h>

void turns_see(struct turns *turns, size_t robot, double x, double y)
{
    struct turns_place *place = &turns->place[robot];

    if (place->drives)
        return;
    place->seen = true;
    place->x = x;
    place->y = y;
}

static double to_fence(const double fence[4], const struct turns_place *place)
{
    double x = fmin(place->x - fence[0], fence[2] - place->x);
    double y = fmin(place->y - fence[1], fence[3] - place->y);

    return fmin(x, y);
}

static double distance_of(const struct turns *turns, size_t one, size_t other)
{
    const struct turns_place *place = turns->place;

    return hypot(place[one].x - place[other].x, place[one].y - place[other].y);
}

bool turns_is_clear(const struct turns *turns, size_t robot, char *words, size_t room)
{
    for (size_t i = 0; i < turns->count; i++) {
        const struct turns_place *other = &turns->place[i];
        double distance = distance_of(turns, robot, i);

        if (i == robot || !other->seen || other->drives || distance >= TURNS_CLEAR)
            continue;
        snprintf(words, room,
                 "robot %u stands %.2f m from it, and it needs %g m to drive: put them apart",
                 other->id, distance, TURNS_CLEAR);
        return false;
    }
    return true;
}

/* Who has to be waited for; NULL: nobody. */
static const struct turns_place *driver_before(const struct turns *turns, size_t robot)
{
    for (size_t i = 0; i < turns->count; i++)
        if (i != robot && turns->place[i].drives &&
            (!turns->together || distance_of(turns, robot, i) < TURNS_APART))
            return &turns->place[i];
    return NULL;
}

enum turn turns_take(struct turns *turns, size_t robot, char *words, size_t room)
{
    struct turns_place *own = &turns->place[robot];
    double inside = turns->fenced ? to_fence(turns->fence, own) : INFINITY;

    if (inside < DRIVE_ROOM) {
        snprintf(words, room,
                 "stands %.2f m from the fence, and needs %g m to drive: put it farther in",
                 fmax(0, inside), DRIVE_ROOM);
        return TURN_NEVER;
    }
    if (!turns_is_clear(turns, robot, words, room))
        return TURN_NEVER;
    const struct turns_place *driver = driver_before(turns, robot);
    if (driver != NULL) {
        snprintf(words, room, "waits for robot %u", driver->id);
        return TURN_LATER;
    }
    own->drives = true;
    return TURN_TAKEN;
}

void turns_leave(struct turns *turns, size_t robot)
{
    turns->place[robot].drives = false;
}
