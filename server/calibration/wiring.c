#include "wiring.h"

#include "limits.h"

#include <math.h>
#include <stdio.h>

/* Wheels that have been told to turn do so by then, s after the telling. */
#define UNDER_WAY 0.3

/* Of the speed that it should have, a wheel that turns has this part at the least. */
#define TURNS 0.15

/* What happened while one motor alone was told to turn, taken for a telling of forward: speeds,
 * m/s, summed up over the times that was done. */
struct answer {
    double told;  /* as fast as nominal wheels would be */
    double own;   /* of the wheel whose motor was told */
    double other; /* of the other one */
};

static const struct drive_sight *sight_from(const struct drive_record *record, double t)
{
    for (size_t i = 0; i < record->sight_count; i++)
        if (record->sight[i].at >= t)
            return &record->sight[i];
    return NULL;
}

/* Adds what went on between two sights of a piece in which `steps` drove one motor. */
static void add_piece(struct answer *answer, const struct drive_wheels *wheels, int wheel,
                      int16_t steps, const struct drive_sight *from, const struct drive_sight *to)
{
    double seconds = (to->at - from->at) * (steps < 0 ? -1 : 1);
    double heading = (from->theta + to->theta) / 2;
    double dx = (to->x - from->x) / seconds;
    double dy = (to->y - from->y) / seconds;
    double v = dx * cos(heading) + dy * sin(heading);
    double spread = (to->theta - from->theta) / seconds * wheels->track / 2;

    answer->told += fabs((double)steps) / PWM_STEPS * wheels->wheel_max;
    answer->own += wheel == WHEEL_LEFT ? v - spread : v + spread;
    answer->other += wheel == WHEEL_LEFT ? v + spread : v - spread;
}

static void listen(const struct drive_record *record, const struct drive_wheels *wheels,
                   struct answer answers[WHEELS])
{
    for (size_t i = 0; i + 1 < record->change_count; i++) {
        const struct drive_change *change = &record->change[i];
        int wheel = change->left != 0 ? WHEEL_LEFT : WHEEL_RIGHT;
        const struct drive_sight *from = sight_from(record, change->at + UNDER_WAY);
        const struct drive_sight *to = sight_from(record, record->change[i + 1].at);

        if ((change->left != 0) == (change->right != 0) || from == NULL || to == NULL ||
            to->at <= from->at)
            continue;
        add_piece(&answers[wheel], wheels, wheel, (int16_t)(change->left + change->right), from,
                  to);
    }
}

/* -1 backwards, 0 stands, 1 forwards. */
static int way_of(double speed, double told, double beside)
{
    return fabs(speed) < fmax(TURNS * told, fabs(beside) / 2) ? 0 : speed < 0 ? -1 : 1;
}

/* What is wrong, or NULL. */
static const char *judge(const int own[WHEELS], const int other[WHEELS])
{
    int l = own[WHEEL_LEFT];
    int r = own[WHEEL_RIGHT];
    int swapped_l = other[WHEEL_LEFT];
    int swapped_r = other[WHEEL_RIGHT];

    if (l > 0 && r > 0 && swapped_l == 0 && swapped_r == 0)
        return NULL;
    if (l * swapped_l != 0 || r * swapped_r != 0)
        return "it moves across its heading: set `heading' of its body in the site";
    if (l < 0 && r < 0)
        return "both motors turn backwards: swap the two wires of each of them";
    if (l < 0 || r < 0)
        return l < 0 ? "its left motor turns backwards: swap its two wires"
                     : "its right motor turns backwards: swap its two wires";
    if (swapped_l < 0 && swapped_r < 0)
        return "it drives backwards: turn `heading' of its body in the site by pi or, where that "
               "is right, swap its motors and the two wires of each";
    return "its motors are swapped: put each one's wires in the other one's place";
}

bool wiring_is_right(const struct drive_record *record, const struct drive_wheels *wheels,
                     char words[WHEEL_FIT_WORDS_MAX])
{
    static const char *const names[] = {"left", "right"};
    struct answer answers[WHEELS] = {{0}};
    int own[WHEELS];
    int other[WHEELS];

    listen(record, wheels, answers);
    for (int i = 0; i < WHEELS; i++) {
        const struct answer *answer = &answers[i];

        own[i] = way_of(answer->own, answer->told, answer->other);
        other[i] = way_of(answer->other, answer->told, answer->own);
        if (own[i] != 0 || other[i] != 0)
            continue;
        snprintf(words, WHEEL_FIT_WORDS_MAX,
                 "its %s motor does not turn at %.0f %% of full PWM: look at its wires and its "
                 "supply",
                 names[i], drive_measured_at(wheels) * 100);
        return false;
    }
    const char *wrong = judge(own, other);
    if (wrong != NULL)
        snprintf(words, WHEEL_FIT_WORDS_MAX, "%s", wrong);
    return wrong == NULL;
}
