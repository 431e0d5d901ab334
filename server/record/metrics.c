#include "metrics.h"

#include "limits.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Robots are swept along this direction, in which formations seldom stand in line: robots in a
 * row across it would all be compared with one another. */
#define SWEEP_X 0.8
#define SWEEP_Y 0.6

/* A robot in the sweep. */
struct mark {
    double along;
    struct scene_point at;
    size_t robot;
};

struct metrics {
    const struct scenario *scenario;
    uint64_t ticks;
    double t, last_event;
    bool complete;
    double complete_since;
    bool led;                /* there has been a leader */
    struct scene_pose about; /* the last one's pose */
    size_t leader;
    uint64_t switches, elections;
    double error, error_peak, error_integral;
    double path_length, min_separation;
    struct sample *before;      /* the tick before */
    struct mark *marks;         /* sorted */
    struct scene_point *vertex; /* of the formation, where they are in this tick */
    bool *held;                 /* by vertex */
    struct metrics_look look;
};

struct metrics *metrics_new(const struct scenario *scenario)
{
    struct metrics *m = calloc(1, sizeof *m);
    size_t largest = scenario_largest(scenario);

    if (m == NULL)
        return NULL;
    if (largest < scenario->robot_count)
        largest = scenario->robot_count; /* what may be drawn */
    m->scenario = scenario;
    m->leader = SERVER_NOBODY;
    m->min_separation = INFINITY;
    m->before = calloc(scenario->robot_count, sizeof *m->before);
    m->marks = calloc(scenario->robot_count, sizeof *m->marks);
    m->look.vertices = m->vertex = calloc(largest, sizeof *m->vertex);
    m->held = calloc(largest + 1, sizeof *m->held);
    if (m->before == NULL || m->marks == NULL || m->vertex == NULL || m->held == NULL) {
        metrics_free(m);
        return NULL;
    }
    for (size_t i = 0; i < scenario->robot_count; i++)
        m->marks[i].robot = i;
    return m;
}

void metrics_free(struct metrics *m)
{
    if (m == NULL)
        return;
    free(m->before);
    free(m->marks);
    free(m->vertex);
    free(m->held);
    free(m);
}

static double squared_distance(struct scene_point a, struct scene_point b)
{
    double dx = a.x - b.x;
    double dy = a.y - b.y;

    return dx * dx + dy * dy;
}

static struct scene_point point_of(const struct sample *robot)
{
    return (struct scene_point){robot->x, robot->y};
}

static void place_vertices(struct metrics *m, const struct scene_pose *about,
                           const struct scenario_formation *formation)
{
    for (size_t j = 0; j < formation->count; j++) {
        double direction = about->theta + formation->psi[j];

        m->vertex[j] = (struct scene_point){about->x + formation->L[j] * cos(direction),
                                            about->y + formation->L[j] * sin(direction)};
    }
}

static double to_closest_vertex(const struct metrics *m, struct scene_point robot, size_t vertices)
{
    double least = INFINITY;

    for (size_t j = 0; j < vertices; j++)
        least = fmin(least, squared_distance(m->vertex[j], robot));
    return sqrt(least);
}

/* Before the first leader: the candidate closest to the reference, ties to the smaller id. */
static struct scene_pose first_candidate(const struct metrics *m, const struct sample *samples,
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
        return (struct scene_pose){reference->x, reference->y, reference->theta};
    return (struct scene_pose){samples[chosen].x, samples[chosen].y, samples[chosen].theta};
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

static struct scene_pose placed_about(const struct metrics *m, const struct sample *samples,
                                      size_t leader, const struct reference_state *reference)
{
    if (leader != SERVER_NOBODY)
        return (struct scene_pose){samples[leader].x, samples[leader].y, samples[leader].theta};
    return m->led ? m->about : first_candidate(m, samples, reference);
}

void metrics_place(struct metrics *m, struct sample *samples, size_t leader,
                   const struct scenario_formation *formation,
                   const struct reference_state *reference)
{
    struct scene_pose about = placed_about(m, samples, leader, reference);
    struct scene_point goal = {reference->x, reference->y};
    double sum = 0;
    size_t alive = 0;

    place_vertices(m, &about, formation);
    for (size_t i = 0; i < m->scenario->robot_count; i++) {
        struct sample *s = &samples[i];

        if (!s->alive)
            s->distance_error = 0;
        else if (i == leader)
            s->distance_error = sqrt(squared_distance(goal, point_of(s)));
        else if (s->vertex != 0 && s->vertex <= formation->count)
            s->distance_error = sqrt(squared_distance(m->vertex[s->vertex - 1], point_of(s)));
        else
            s->distance_error = to_closest_vertex(m, point_of(s), formation->count);
        sum += s->distance_error;
        alive += s->alive;
    }
    m->look.mean_distance_error = alive > 0 ? sum / (double)alive : 0;
    m->look.about = about;
    m->look.vertex_count = formation->count;
    m->look.complete = is_complete(m, samples, formation->count);
}

static void count_errors(struct metrics *m)
{
    m->error = m->look.mean_distance_error;
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
        m->path_length += sqrt(squared_distance(point_of(is), point_of(was)));
    }
}

/* Nearly sorted from the tick before, so insertion is linear. */
static void sort_marks(struct metrics *m, const struct sample *samples)
{
    for (size_t i = 0; i < m->scenario->robot_count; i++) {
        const struct sample *s = &samples[m->marks[i].robot];
        struct mark mark = {
            .along = SWEEP_X * s->x + SWEEP_Y * s->y,
            .at = point_of(s),
            .robot = m->marks[i].robot,
        };
        size_t j = i;

        for (; j > 0 && m->marks[j - 1].along > mark.along; j--)
            m->marks[j] = m->marks[j - 1];
        m->marks[j] = mark;
    }
}

static void measure_separation(struct metrics *m, const struct sample *samples)
{
    size_t count = m->scenario->robot_count;
    double least = m->min_separation * m->min_separation;

    sort_marks(m, samples);
    for (size_t i = 0; i < count; i++) {
        const struct mark *a = &m->marks[i];

        for (const struct mark *b = a + 1; b < m->marks + count; b++) {
            if (b->along - a->along >= m->min_separation)
                break;
            double apart = squared_distance(a->at, b->at);
            if (apart < least) {
                least = apart;
                m->min_separation = sqrt(apart);
            }
        }
    }
}

void metrics_tick(struct metrics *m, double t, struct sample *samples, size_t leader,
                  const struct scenario_formation *formation,
                  const struct reference_state *reference, bool event)
{
    m->t = t;
    m->leader = leader;
    if (event)
        m->last_event = t;
    metrics_place(m, samples, leader, formation, reference);
    if (leader != SERVER_NOBODY) {
        m->led = true;
        m->about = m->look.about;
    }
    count_errors(m);
    count_changes(m, samples);
    measure_separation(m, samples);
    if (m->look.complete && !m->complete)
        m->complete_since = t;
    m->complete = m->look.complete;
    memcpy(m->before, samples, m->scenario->robot_count * sizeof *samples);
    m->ticks++;
}

const struct metrics_look *metrics_look(const struct metrics *m)
{
    return &m->look;
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
