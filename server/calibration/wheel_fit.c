#include "wheel_fit.h"

#include "limits.h"
#include "wiring.h"

#include <cminpack.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What one sight, and one change's lateness, may be expected to be off by. A robot's tick comes at
 * any time of 20 ms after a change was sent, and a radio's delay is not always the same. */
#define PLACE_NOISE 0.0005  /* m */
#define HEADING_NOISE 0.005 /* rad */
#define LATENESS 0.01       /* s */

/* The path is followed in steps no longer than this, s: each is then right to a few um. */
#define STEP 0.01

/* It is over when a round makes it no better than by this part. */
#define TOLERANCE 1e-5
#define ROUNDS_MOST 50

/* What is looked for, in this order; then the lateness of every change. */
enum {
    GAIN,
    DEAD = GAIN + WHEELS,
    TRACK = DEAD + WHEELS, /* beside the nominal one */
    LAG,
    DELAY,
    HEADING,
    AHEAD,
    ASIDE,
    START, /* x, y, theta of the body that is seen */
    LATE = START + 3,
};

#define UNKNOWNS_MAX (LATE + DRIVE_SEGMENTS_MAX + 1)

/* Sights a second that a drive needs. */
#define SIGHTS_PER_S 20

/* What is allowed to come out. */
#define GAIN_LEAST 0.5
#define GAIN_MOST 1.5
#define DEAD_MOST 0.3
#define DEAD_PART_MOST 0.8 /* of drive_measured_at() */
#define TRACK_FACTOR_MOST 2
#define LAG_MOST 0.5
#define RMS_MOST 0.01

struct problem {
    const struct drive_record *record;
    const struct drive_wheels *wheels;
    double unknown[UNKNOWNS_MAX];
    int first;                                 /* of them that is not known */
    struct drive_sight seen[DRIVE_SIGHTS_MAX]; /* as the unknowns would have it */
};

/* ---- the model ------------------------------------------------------------------------- */

struct walk {
    double t, x, y, theta;
    double speed[WHEELS], wanted[WHEELS];
};

static double settled(const double *unknown, int wheel, double wheel_max, int16_t steps)
{
    double part = fabs((double)steps) / PWM_STEPS;
    double dead = unknown[DEAD + wheel];
    /* While it is looked for it may be below 0. */
    double turned = steps == 0 ? 0 : fmax(0, part - dead) / (1 - dead);

    return (steps < 0 ? -1 : 1) * unknown[GAIN + wheel] * wheel_max * turned;
}

/* Equation 1 over a short time, in which a wheel's speed goes on towards what is wanted. */
static void step(struct walk *walk, double track, double lag, double seconds)
{
    double left_over = lag > 0 ? exp(-seconds / lag) : 0;
    double way[WHEELS];

    for (int i = 0; i < WHEELS; i++) {
        double lead = walk->speed[i] - walk->wanted[i];

        way[i] = walk->wanted[i] * seconds + lead * lag * (1 - left_over);
        walk->speed[i] = walk->wanted[i] + lead * left_over;
    }
    double turn = (way[WHEEL_RIGHT] - way[WHEEL_LEFT]) / track;
    double chord = (way[WHEEL_RIGHT] + way[WHEEL_LEFT]) / 2;
    walk->x += chord * cos(walk->theta + turn / 2);
    walk->y += chord * sin(walk->theta + turn / 2);
    walk->theta += turn;
    walk->t += seconds;
}

static void walk_until(struct walk *walk, double track, double lag, double t)
{
    int steps = (int)ceil((t - walk->t) / STEP);
    double seconds = (t - walk->t) / steps;

    for (int i = 0; i < steps; i++)
        step(walk, track, lag, seconds);
}

static struct walk start_of(const double *unknown)
{
    double theta = unknown[START + 2] - unknown[HEADING];

    return (struct walk){
        .x = unknown[START] - unknown[AHEAD] * cos(theta) + unknown[ASIDE] * sin(theta),
        .y = unknown[START + 1] - unknown[AHEAD] * sin(theta) - unknown[ASIDE] * cos(theta),
        .theta = theta,
    };
}

static struct drive_sight body_of(const double *unknown, const struct walk *walk)
{
    double c = cos(walk->theta);
    double s = sin(walk->theta);

    return (struct drive_sight){
        .at = walk->t,
        .x = walk->x + unknown[AHEAD] * c - unknown[ASIDE] * s,
        .y = walk->y + unknown[AHEAD] * s + unknown[ASIDE] * c,
        .theta = walk->theta + unknown[HEADING],
    };
}

/* Of one change, beside the delay. In a trial it is bounded, or it would be an excuse for
 * everything. */
static double lateness(const struct problem *problem, size_t change)
{
    double late = problem->unknown[LATE + change];

    return problem->first == LATE ? LATENESS * tanh(late / LATENESS) : late;
}

/* Where the body would have been seen at the moments when it was. */
static void follow(struct problem *problem)
{
    const struct drive_record *record = problem->record;
    const double *unknown = problem->unknown;
    double track = unknown[TRACK] * problem->wheels->track;
    double lag = fabs(unknown[LAG]);
    struct walk walk = start_of(unknown);
    size_t next = 0;

    for (size_t i = 0; i < record->sight_count; i++) {
        double t = record->sight[i].at;

        for (; next < record->change_count; next++) {
            const struct drive_change *change = &record->change[next];
            double effect = change->at + unknown[DELAY] + lateness(problem, next);

            if (effect > t)
                break;
            walk_until(&walk, track, lag, fmax(walk.t, effect));
            walk.wanted[WHEEL_LEFT] =
                settled(unknown, WHEEL_LEFT, problem->wheels->wheel_max, change->left);
            walk.wanted[WHEEL_RIGHT] =
                settled(unknown, WHEEL_RIGHT, problem->wheels->wheel_max, change->right);
        }
        walk_until(&walk, track, lag, fmax(walk.t, t));
        problem->seen[i] = body_of(unknown, &walk);
    }
}

/* ---- least squares --------------------------------------------------------------------- */

static int residuals(void *context, int count, int free_count, const double *guess,
                     double *residual, int flag)
{
    struct problem *problem = context;
    const struct drive_record *record = problem->record;

    (void)count;
    (void)flag;
    memcpy(problem->unknown + problem->first, guess, (size_t)free_count * sizeof *guess);
    follow(problem);
    for (size_t i = 0; i < record->sight_count; i++) {
        *residual++ = (problem->seen[i].x - record->sight[i].x) / PLACE_NOISE;
        *residual++ = (problem->seen[i].y - record->sight[i].y) / PLACE_NOISE;
        *residual++ = (problem->seen[i].theta - record->sight[i].theta) / HEADING_NOISE;
    }
    for (size_t i = 0; i < record->change_count; i++)
        *residual++ = problem->unknown[LATE + i] / LATENESS;
    return 0;
}

/* Finds the unknowns from `first` up to before `end`, and what would have been seen. False where
 * there is no memory. */
static bool solve(struct problem *problem, size_t end)
{
    size_t m = 3 * problem->record->sight_count + problem->record->change_count;
    size_t n = end - (size_t)problem->first;
    double *memory = malloc((m * n + 2 * m + 6 * n) * sizeof *memory);
    int pivots[UNKNOWNS_MAX];
    int calls;

    if (memory == NULL)
        return false;
    double *jacobian = memory;
    double *residual = jacobian + m * n;
    double *work = residual + m;
    double *guess = work + m;
    double *scratch = guess + n;
    memcpy(guess, problem->unknown + problem->first, n * sizeof *guess);
    lmdif(residuals, problem, (int)m, (int)n, guess, residual, TOLERANCE, TOLERANCE, 0,
          ROUNDS_MOST * (int)(n + 1), 1e-10, scratch, 1, 10, 0, &calls, jacobian, (int)m, pivots,
          scratch + n, scratch + 2 * n, scratch + 3 * n, scratch + 4 * n, work);
    memcpy(problem->unknown + problem->first, guess, n * sizeof *guess);
    follow(problem);
    free(memory);
    return true;
}

/* What of a delay that all changes have in common has been taken for lateness of each. The first
 * one changes nothing. */
static double mean_lateness(const struct problem *problem)
{
    size_t count = problem->record->change_count;
    double sum = 0;

    for (size_t i = 1; i < count; i++)
        sum += problem->unknown[LATE + i];
    return count > 1 ? sum / (double)(count - 1) : 0;
}

static double rms_of(const struct problem *problem)
{
    const struct drive_record *record = problem->record;
    double sum = 0;

    for (size_t i = 0; i < record->sight_count; i++)
        sum += pow(problem->seen[i].x - record->sight[i].x, 2) +
               pow(problem->seen[i].y - record->sight[i].y, 2);
    return sqrt(sum / (double)record->sight_count);
}

/* ---- verdicts -------------------------------------------------------------------------- */

static bool refuse(char words[WHEEL_FIT_WORDS_MAX], const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static bool refuse(char words[WHEEL_FIT_WORDS_MAX], const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(words, WHEEL_FIT_WORDS_MAX, format, arguments);
    va_end(arguments);
    return false;
}

static bool is_seen_enough(const struct drive_record *record, char words[WHEEL_FIT_WORDS_MAX])
{
    size_t count = record->sight_count;
    double seconds = count > 0 ? record->sight[count - 1].at - record->sight[0].at : 0;

    if (count >= 2 * SIGHTS_PER_S && (double)count >= SIGHTS_PER_S * seconds)
        return true;
    return refuse(words, "motion capture saw it only %zu times in %.0f s; %d a second are needed",
                  count, seconds, SIGHTS_PER_S);
}

static bool is_plausible(const struct wheel_fit *fit, const struct drive_wheels *wheels,
                         char words[WHEEL_FIT_WORDS_MAX])
{
    static const char *const names[] = {"left", "right"};
    double dead_most = fmin(DEAD_MOST, DEAD_PART_MOST * drive_measured_at(wheels));

    if (!(fit->rms <= RMS_MOST))
        return refuse(words,
                      "no two wheels drive as it did, %.0f mm off in the mean: does one slip, or "
                      "touch something?",
                      fit->rms * 1000);
    for (int i = 0; i < WHEELS; i++) {
        if (fit->gain[i] < GAIN_LEAST || fit->gain[i] > GAIN_MOST)
            return refuse(
                words,
                "its %s wheel is %.2f times as fast as `wheels.max' %g m/s says, and %g to "
                "%g are allowed",
                names[i], fit->gain[i], wheels->wheel_max, GAIN_LEAST, GAIN_MOST);
        if (fit->dead[i] > dead_most)
            return refuse(words,
                          "its %s wheel turns only from %.2f of full PWM on, and %.2f is allowed",
                          names[i], fit->dead[i], dead_most);
    }
    if (fit->track > TRACK_FACTOR_MOST * wheels->track ||
        fit->track < wheels->track / TRACK_FACTOR_MOST)
        return refuse(words, "its wheels are %.3f m apart, where `wheels.track' says %g m",
                      fit->track, wheels->track);
    if (fit->lag > LAG_MOST)
        return refuse(words, "its wheels take %.2f s to follow, and %g s are allowed", fit->lag,
                      LAG_MOST);
    return true;
}

/* ---- what others call ------------------------------------------------------------------ */

bool wheel_fit(const struct drive_record *record, const struct drive_wheels *wheels,
               struct wheel_fit *fit, char words[WHEEL_FIT_WORDS_MAX])
{
    const struct drive_sight *first = &record->sight[0];
    struct problem problem = {
        .record = record,
        .wheels = wheels,
        .unknown =
            {
                [GAIN + WHEEL_LEFT] = 1,
                [GAIN + WHEEL_RIGHT] = 1,
                [DEAD + WHEEL_LEFT] = 0.02,
                [DEAD + WHEEL_RIGHT] = 0.02,
                [TRACK] = 1,
                [LAG] = 0.05,
                [DELAY] = 0.03,
                [START] = first->x,
                [START + 1] = first->y,
                [START + 2] = first->theta,
            },
        .first = GAIN,
    };
    const double *unknown = problem.unknown;

    if (!is_seen_enough(record, words) || !wiring_is_right(record, wheels, words))
        return false;
    /* First as if every change came alike: from far off, lateness is an excuse for all. */
    if (!solve(&problem, LATE) || !solve(&problem, LATE + record->change_count))
        return refuse(words, "no memory");
    *fit = (struct wheel_fit){
        .gain = {unknown[GAIN + WHEEL_LEFT], unknown[GAIN + WHEEL_RIGHT]},
        .dead = {fmax(0, unknown[DEAD + WHEEL_LEFT]), fmax(0, unknown[DEAD + WHEEL_RIGHT])},
        .track = unknown[TRACK] * wheels->track,
        .lag = fabs(unknown[LAG]),
        .delay = unknown[DELAY] + mean_lateness(&problem),
        .heading = unknown[HEADING],
        .ahead = unknown[AHEAD],
        .aside = unknown[ASIDE],
        .rms = rms_of(&problem),
    };
    return is_plausible(fit, wheels, words);
}

/* Where the body stood before the first change can have taken effect. */
static void start_from(const struct drive_record *record, double *unknown)
{
    double until = record->change_count > 1 ? record->change[1].at : 0;
    size_t count = 0;

    for (size_t i = 0; i < record->sight_count && (i == 0 || record->sight[i].at < until); i++) {
        unknown[START] += record->sight[i].x;
        unknown[START + 1] += record->sight[i].y;
        unknown[START + 2] += record->sight[i].theta;
        count++;
    }
    for (int i = 0; i < 3; i++)
        unknown[START + i] /= (double)count;
}

double wheel_fit_trial_error(const struct drive_record *record, const struct drive_wheels *wheels,
                             double track, const struct wheel_fit *fit)
{
    struct problem problem = {
        .record = record,
        .wheels = wheels,
        .unknown =
            {
                [GAIN + WHEEL_LEFT] = 1,
                [GAIN + WHEEL_RIGHT] = 1,
                [TRACK] = track / wheels->track,
                [LAG] = fit->lag,
                [DELAY] = fit->delay,
                [HEADING] = fit->heading,
                [AHEAD] = fit->ahead,
                [ASIDE] = fit->aside,
            },
        .first = LATE,
    };
    double most = NAN;

    if (record->sight_count == 0)
        return most;
    start_from(record, problem.unknown);
    if (!solve(&problem, LATE + record->change_count))
        return most;
    for (size_t i = 0; i < record->sight_count; i++)
        most = fmax(most, hypot(problem.seen[i].x - record->sight[i].x,
                                problem.seen[i].y - record->sight[i].y));
    return most;
}
