#include "wiring.h"

#include "limits.h"

#include <math.h>
#include <stdio.h>

/* Wheels that have been told to turn do so by then, s after the telling. */
#define UNDER_WAY 0.3

/* A motor that turns does so at least this fast, of what it should. */
#define TURNS 0.15

/* What robots did when they were told to: sums over the pieces of a drive, each taken for one of
 * forward. Where a body's origin lies on its robot does not matter to any of them. */
struct answer {
    double turn[WHEELS], told[WHEELS]; /* rad/s, one motor alone; and as it should be */
    double ahead, aside;               /* m/s, both alike */
};

static const struct drive_sight *sight_from(const struct drive_record *record, double t)
{
    for (size_t i = 0; i < record->sight_count; i++)
        if (record->sight[i].at >= t)
            return &record->sight[i];
    return NULL;
}

static void add_alone(struct answer *answer, const struct drive_wheels *wheels, int wheel,
                      int16_t steps, double turn)
{
    answer->turn[wheel] += steps < 0 ? -turn : turn;
    answer->told[wheel] += fabs((double)steps) / PWM_STEPS * wheels->wheel_max / wheels->track;
}

static void add_straight(struct answer *answer, int16_t steps, const struct drive_sight *from,
                         const struct drive_sight *to)
{
    double heading = (from->theta + to->theta) / 2;
    double seconds = (to->at - from->at) * (steps < 0 ? -1 : 1);
    double dx = (to->x - from->x) / seconds;
    double dy = (to->y - from->y) / seconds;

    answer->ahead += dx * cos(heading) + dy * sin(heading);
    answer->aside += dy * cos(heading) - dx * sin(heading);
}

static struct answer listen(const struct drive_record *record, const struct drive_wheels *wheels)
{
    struct answer answer = {.ahead = 0};

    for (size_t i = 0; i + 1 < record->change_count; i++) {
        const struct drive_change *change = &record->change[i];
        const struct drive_sight *from = sight_from(record, change->at + UNDER_WAY);
        const struct drive_sight *to = sight_from(record, record->change[i + 1].at);

        if (from == NULL || to == NULL || to->at <= from->at)
            continue;
        double turn = (to->theta - from->theta) / (to->at - from->at);
        if (change->left != 0 && change->right == 0)
            add_alone(&answer, wheels, WHEEL_LEFT, change->left, turn);
        else if (change->left == 0 && change->right != 0)
            add_alone(&answer, wheels, WHEEL_RIGHT, change->right, turn);
        else if (change->left == change->right && change->left != 0)
            add_straight(&answer, change->left, from, to);
    }
    return answer;
}

/* What is wrong with motors that both turn, or NULL. */
static const char *judge(const struct answer *answer)
{
    bool left_right = answer->turn[WHEEL_LEFT] < 0; /* to the right, as it should */
    bool right_left = answer->turn[WHEEL_RIGHT] > 0;
    bool ahead = answer->ahead > 0;

    if (left_right && !right_left)
        return "its right motor turns backwards: swap its two wires";
    if (!left_right && right_left)
        return "its left motor turns backwards: swap its two wires";
    if (fabs(answer->aside) > fabs(answer->ahead))
        return "it moves across its heading: set `heading' of its body in the site";
    if (left_right && ahead)
        return NULL;
    if (left_right)
        return "it drives backwards: turn `heading' of its body in the site by pi or, where that "
               "is right, swap its motors and the two wires of each";
    return ahead ? "its motors are swapped: put each one's wires in the other one's place"
                 : "both motors turn backwards: swap the two wires of each of them";
}

bool wiring_is_right(const struct drive_record *record, const struct drive_wheels *wheels,
                     char words[WHEEL_FIT_WORDS_MAX])
{
    static const char *const names[] = {"left", "right"};
    struct answer answer = listen(record, wheels);

    for (int i = 0; i < WHEELS; i++) {
        if (fabs(answer.turn[i]) > TURNS * answer.told[i])
            continue;
        snprintf(words, WHEEL_FIT_WORDS_MAX,
                 "its %s motor does not turn at %.0f %% of full PWM: look at its wires and its "
                 "supply",
                 names[i], drive_measured_at(wheels) * 100);
        return false;
    }
    const char *wrong = judge(&answer);
    if (wrong != NULL)
        snprintf(words, WHEEL_FIT_WORDS_MAX, "%s", wrong);
    return wrong == NULL;
}
