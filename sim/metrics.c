#include "metrics.h"

#include "limits.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct place {
    double x, y, theta;
};

struct metrics {
    const struct scenario *scenario;
    uint64_t ticks;
    double t, last_event;
    bool complete;
    double complete_since;
    bool led;           /* there has been a leader */
    struct place about; /* the last one's pose */
    size_t leader;
    uint64_t switches, elections;
    double error, error_peak, error_integral;
    double path_length, min_separation;
    struct sample *before; /* the tick before */
    size_t *by_x;          /* robots in the order of x */
    bool *held;            /* by vertex */
};

struct metrics *metrics_new(const struct scenario *scenario)
{
    struct metrics *m = calloc(1, sizeof *m);
    size_t largest = 0;

    if (m == NULL)
        return NULL;
    for (size_t i = 0; i < scenario->formation_count; i++)
        if (scenario->formations[i].count > largest)
            largest = scenario->formations[i].count;
    m->scenario = scenario;
    m->leader = SERVER_NOBODY;
    m->min_separation = INFINITY;
    m->before = calloc(scenario->robot_count, sizeof *m->before);
    m->by_x = calloc(scenario->robot_count, sizeof *m->by_x);
    m->held = calloc(largest + 1, sizeof *m->held);
    if (m->before == NULL || m->by_x == NULL || m->held == NULL) {
        metrics_free(m);
        return NULL;
    }
    for (size_t i = 0; i < scenario->robot_count; i++)
        m->by_x[i] = i;
    return m;
}

void metrics_free(struct metrics *m)
{
    if (m == NULL)
        return;
    free(m->before);
    free(m->by_x);
    free(m->held);
    free(m);
}

/* Distance from a robot to vertex `j` (from 0) of a formation about a place. */
static double to_vertex(const struct sample *robot, const struct place *about,
                        const struct scenario_formation *formation, size_t j)
{
    double direction = about->theta + formation->psi[j];

    return hypot(about->x + formation->L[j] * cos(direction) - robot->x,
                 about->y + formation->L[j] * sin(direction) - robot->y);
}

static double to_closest(const struct sample *robot, const struct place *about,
                         const struct scenario_formation *formation)
{
    double least = INFINITY;

    for (size_t j = 0; j < formation->count; j++)
        least = fmin(least, to_vertex(robot, about, formation, j));
    return least;
}

/* Before the first leader: the candidate closest to the reference, ties to the smaller id. */
static struct place first_candidate(const struct metrics *m, const struct sample *samples,
                                    const struct reference_state *reference)
{
    const struct scenario_robot *robots = m->scenario->robots;
    size_t chosen = SERVER_NOBODY;
    double least = INFINITY;

    for (size_t i = 0; i < m->scenario->robot_count; i++) {
        double distance = hypot(samples[i].x - reference->x, samples[i].y - reference->y);

        if (!robots[i].candidate || !samples[i].alive || distance > least ||
            (distance == least && robots[i].id > robots[chosen].id))
            continue;
        least = distance;
        chosen = i;
    }
    if (chosen == SERVER_NOBODY)
        return (struct place){reference->x, reference->y, reference->theta};
    return (struct place){samples[chosen].x, samples[chosen].y, samples[chosen].theta};
}

static void measure_errors(struct metrics *m, struct sample *samples, size_t formation_index,
                           const struct reference_state *reference)
{
    const struct scenario_formation *formation = &m->scenario->formations[formation_index];
    struct place about = m->led ? m->about : first_candidate(m, samples, reference);
    double sum = 0;
    size_t alive = 0;

    for (size_t i = 0; i < m->scenario->robot_count; i++) {
        struct sample *s = &samples[i];

        if (!s->alive)
            s->distance_error = 0;
        else if (i == m->leader)
            s->distance_error = hypot(reference->x - s->x, reference->y - s->y);
        else if (s->vertex != 0 && s->vertex <= formation->count)
            s->distance_error = to_vertex(s, &about, formation, s->vertex - 1u);
        else
            s->distance_error = to_closest(s, &about, formation);
        sum += s->distance_error;
        alive += s->alive;
    }
    m->error = alive > 0 ? sum / (double)alive : 0;
    m->error_peak = fmax(m->error_peak, m->error);
    m->error_integral += m->error * TICK_MS / 1000;
}

static void count_changes(struct metrics *m, const struct sample *samples)
{
    for (size_t i = 0; i < m->scenario->robot_count; i++) {
        const struct sample *was = &m->before[i];
        const struct sample *is = &samples[i];
        bool leads = is->alive && is->role == ROLE_LEADER;
        bool led = m->ticks > 0 && was->alive && was->role == ROLE_LEADER;

        m->elections += leads && !led;
        if (m->ticks == 0)
            continue;
        m->switches += is->alive && was->alive && !leads && !led && was->vertex != 0 &&
                       is->vertex != was->vertex;
        m->path_length += hypot(is->x - was->x, is->y - was->y);
    }
}

static bool is_complete(struct metrics *m, const struct sample *samples, size_t vertices)
{
    size_t leaders = 0, followers = 0, held = 0;

    memset(m->held, 0, (vertices + 1) * sizeof *m->held);
    for (size_t i = 0; i < m->scenario->robot_count; i++) {
        const struct sample *s = &samples[i];

        if (!s->alive)
            continue;
        if (s->role == ROLE_LEADER) {
            leaders++;
            continue;
        }
        followers++;
        if (s->vertex != 0 && s->vertex <= vertices && !m->held[s->vertex]) {
            m->held[s->vertex] = true;
            held++;
        }
    }
    return leaders == 1 && held == (followers < vertices - 1 ? followers : vertices - 1);
}

static void measure_separation(struct metrics *m, const struct sample *samples)
{
    size_t count = m->scenario->robot_count;

    /* Nearly sorted from the tick before, so insertion is linear. */
    for (size_t i = 1; i < count; i++) {
        size_t robot = m->by_x[i];
        size_t j = i;

        for (; j > 0 && samples[m->by_x[j - 1]].x > samples[robot].x; j--)
            m->by_x[j] = m->by_x[j - 1];
        m->by_x[j] = robot;
    }
    for (size_t i = 0; i < count; i++) {
        const struct sample *a = &samples[m->by_x[i]];

        for (size_t j = i + 1; j < count; j++) {
            const struct sample *b = &samples[m->by_x[j]];

            if (b->x - a->x >= m->min_separation)
                break;
            m->min_separation = fmin(m->min_separation, hypot(b->x - a->x, b->y - a->y));
        }
    }
}

void metrics_tick(struct metrics *m, double t, struct sample *samples, size_t leader,
                  size_t formation, const struct reference_state *reference, bool event)
{
    m->t = t;
    m->leader = leader;
    if (leader != SERVER_NOBODY) {
        m->led = true;
        m->about = (struct place){samples[leader].x, samples[leader].y, samples[leader].theta};
    }
    if (event)
        m->last_event = t;
    measure_errors(m, samples, formation, reference);
    count_changes(m, samples);
    measure_separation(m, samples);

    bool complete = is_complete(m, samples, m->scenario->formations[formation].count);
    if (complete && !m->complete)
        m->complete_since = t;
    m->complete = complete;
    memcpy(m->before, samples, m->scenario->robot_count * sizeof *samples);
    m->ticks++;
}

struct metrics_result metrics_result(const struct metrics *m)
{
    return (struct metrics_result){
        .leader = m->leader,
        .complete = m->complete,
        .time_to_complete = m->complete ? fmax(0, m->complete_since - m->last_event) : -1,
        .switches = m->switches,
        .elections = m->elections,
        .error_final = m->error,
        .error_peak = m->error_peak,
        .error_integral = m->error_integral,
        .path_length = m->path_length,
        .min_separation = m->min_separation,
    };
}
