#include "turns.h"

#include <math.h>
#include <stdarg.h>
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

static enum turn say(enum turn turn, char *words, size_t room, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

static enum turn say(enum turn turn, char *words, size_t room, const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(words, room, format, arguments);
    va_end(arguments);
    return turn;
}

enum turn turns_take(struct turns *turns, size_t robot, char *words, size_t room)
{
    struct turns_place *own = &turns->place[robot];
    const struct turns_place *driver = NULL;
    double inside = turns->fenced ? to_fence(turns->fence, own) : INFINITY;

    if (inside < DRIVE_ROOM)
        return say(TURN_NEVER, words, room,
                   "stands %.2f m from the fence, and needs %g m to drive: put it farther in",
                   fmax(0, inside), DRIVE_ROOM);
    for (size_t i = 0; i < turns->count; i++) {
        const struct turns_place *other = &turns->place[i];
        double distance = hypot(other->x - own->x, other->y - own->y);

        if (i == robot || !other->seen)
            continue;
        if (!other->drives && distance < TURNS_CLEAR)
            return say(TURN_NEVER, words, room,
                       "robot %u stands %.2f m from it, and it needs %g m to drive: put them apart",
                       other->id, distance, TURNS_CLEAR);
        if (other->drives && (!turns->together || distance < TURNS_APART))
            driver = other;
    }
    if (driver != NULL)
        return say(TURN_LATER, words, room, "waits for robot %u", driver->id);
    own->drives = true;
    return TURN_TAKEN;
}

void turns_leave(struct turns *turns, size_t robot)
{
    turns->place[robot].drives = false;
}
