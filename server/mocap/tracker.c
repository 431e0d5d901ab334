#include "tracker.h"

#include "limits.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define STRANGERS_MAX 32
#define NOBODY UINT32_MAX

/* The least delayed frame is looked for among those of so long, or up to twice that: clocks drift
 * apart by 0.1 ms in it, and a system that paused is understood after it. */
#define WINDOW_US 5000000

/* Bodies that are told of one by one may be out of order by less. */
#define BACK_US 500000

/* A frame that comes after one of a higher number: this near it was overtaken, farther the system
 * was started anew. */
#define LATE_FRAMES 10

/* Speeds are taken over this long at least, so that noise does not drown them. */
#define SPEED_SPAN_US 40000

/* A robot that is not seen drives on for as long as this, and stops. */
#define BLIND_S 0.5

struct anchor {
    double x, y, theta;
    int64_t at_us;
};

struct tracked {
    struct tracker_view view;
    struct anchor anchor; /* where it was when its speed was taken last */
};

struct tracker {
    struct tracker_settings settings;
    const struct tracker_body *bodies;
    size_t count;
    bool numbered;
    uint32_t number; /* of the last frame */
    bool timed;
    double least_us, before_us; /* our clock less the system's, at the least: in this window and in
                                   the one before */
    int64_t window_us;          /* when this window began */
    double first_us, last_us;   /* by the system's clock since it was set */
    int64_t since_us, until_us; /* the same by ours */
    uint32_t guess[CAPTURE_BODIES_MAX]; /* whose the k-th body of a frame was last */
    bool named;                         /* the system has told a name */
    size_t stranger_count;
    char stranger[STRANGERS_MAX][CAPTURE_NAME_MAX];
    struct tracked robot[];
};

size_t tracker_footprint(size_t count)
{
    return sizeof(struct tracker) + count * sizeof(struct tracked);
}

struct tracker *tracker_init(void *memory, const struct tracker_settings *settings,
                             const struct tracker_body *bodies, size_t count)
{
    struct tracker *tracker = memory;

    memset(memory, 0, tracker_footprint(count));
    tracker->settings = *settings;
    if (tracker->settings.scale == 0)
        tracker->settings.scale = 1;
    tracker->bodies = bodies;
    tracker->count = count;
    return tracker;
}

/* ---- whose body ------------------------------------------------------------------------ */

static bool is_body(const struct tracker_body *wanted, const struct capture_body *body)
{
    if (wanted->id != CAPTURE_ID_NONE && wanted->id != body->id)
        return false;
    if (wanted->name == NULL || body->name[0] == '\0')
        return wanted->id != CAPTURE_ID_NONE;
    return strcmp(wanted->name, body->name) == 0;
}

static void remember_stranger(struct tracker *tracker, const struct capture_body *body)
{
    char name[CAPTURE_NAME_MAX];

    if (body->name[0] != '\0')
        memcpy(name, body->name, sizeof name);
    else
        snprintf(name, sizeof name, "number %d", body->id);
    for (size_t i = 0; i < tracker->stranger_count; i++)
        if (strcmp(tracker->stranger[i], name) == 0)
            return;
    if (tracker->stranger_count < STRANGERS_MAX)
        memcpy(tracker->stranger[tracker->stranger_count++], name, sizeof name);
}

/* Bodies come before their names: who was a stranger as a number may be a robot by name. */
static void hear_name(struct tracker *tracker, const struct capture_body *body)
{
    if (tracker->named || body->name[0] == '\0')
        return;
    tracker->named = true;
    tracker->stranger_count = 0;
}

/* Systems tell of bodies in the same order again and again. */
static uint32_t robot_of(struct tracker *tracker, const struct capture_frame *frame, size_t k)
{
    uint32_t guess = tracker->guess[k];

    if (guess < tracker->count && is_body(&tracker->bodies[guess], &frame->body[k]))
        return guess;
    for (uint32_t i = 0; i < tracker->count; i++) {
        if (is_body(&tracker->bodies[i], &frame->body[k])) {
            tracker->guess[k] = i;
            return i;
        }
    }
    remember_stranger(tracker, &frame->body[k]);
    return NOBODY;
}

/* ---- when ------------------------------------------------------------------------------ */

/* False for a frame that a later one has overtaken. */
static bool in_order(struct tracker *tracker, const struct capture_frame *frame)
{
    if (!frame->numbered)
        return true;
    uint32_t behind = tracker->number - frame->number;
    bool late = tracker->numbered && behind > 0 && behind <= LATE_FRAMES;
    if (late)
        return false;
    tracker->numbered = true;
    tracker->number = frame->number;
    return true;
}

/* A frame that was held up on its way looks like one of a clock that was set back: only a time that
 * runs backwards is taken for that. */
static void judge_clock(struct tracker *tracker, double time_us, int64_t arrival_us)
{
    double difference = (double)arrival_us - time_us;

    if (!tracker->timed || time_us < tracker->last_us - BACK_US) {
        tracker->first_us = time_us;
        tracker->since_us = tracker->window_us = arrival_us;
        tracker->least_us = tracker->before_us = difference;
    } else if (arrival_us - tracker->window_us > WINDOW_US) {
        tracker->window_us = arrival_us;
        tracker->before_us = tracker->least_us;
        tracker->least_us = difference;
    }
    tracker->least_us = fmin(tracker->least_us, difference);
    tracker->timed = true;
    tracker->last_us = time_us;
    tracker->until_us = arrival_us;
}

static int64_t measured_at(struct tracker *tracker, const struct capture_frame *frame,
                           int64_t arrival_us)
{
    double latency = frame->latency > 0 ? frame->latency : tracker->settings.latency;
    int64_t latency_us = llround(latency * 1e6);

    if (isnan(frame->time))
        return arrival_us - latency_us;
    judge_clock(tracker, frame->time * 1e6, arrival_us);
    double offset_us = fmin(tracker->least_us, tracker->before_us);
    return llround(frame->time * 1e6 + offset_us) - latency_us;
}

/* ---- where ----------------------------------------------------------------------------- */

static void pose_of(const struct tracker_settings *settings, const struct tracker_body *wanted,
                    const struct capture_body *body, struct anchor *pose)
{
    const double *q = body->turn;
    /* Where the body's own x axis points. */
    double forward[3] = {
        1 - 2 * (q[1] * q[1] + q[2] * q[2]),
        2 * (q[0] * q[1] + q[3] * q[2]),
        2 * (q[0] * q[2] - q[3] * q[1]),
    };
    bool y_up = settings->up == UP_Y;

    /* With y up, a quarter turn about x brings it to z: y is -z. */
    pose->x = settings->scale * body->at[0];
    pose->y = settings->scale * (y_up ? -body->at[2] : body->at[1]);
    pose->theta =
        remainder(atan2(y_up ? -forward[2] : forward[1], forward[0]) + wanted->heading, 2 * M_PI);
}

/* What the wire can carry (common/fixed.h); false for what is no number. */
static bool on_the_map(const struct anchor *pose)
{
    return fabs(pose->x) <= POSITION_MAX_M && fabs(pose->y) <= POSITION_MAX_M &&
           isfinite(pose->theta);
}

static bool believable(const struct tracker *tracker, const struct tracked *robot,
                       const struct anchor *pose, double *jump)
{
    double unseen = fmin(BLIND_S, (double)(pose->at_us - robot->view.measured_us) / 1e6);

    *jump = hypot(pose->x - robot->view.x, pose->y - robot->view.y);
    return tracker->settings.jump == 0 || !robot->view.seen ||
           *jump <= tracker->settings.jump + fabs(robot->view.v) * fmax(0, unseen);
}

static void take_speed(struct tracked *robot, const struct anchor *pose)
{
    const struct anchor *before = &robot->anchor;
    int64_t span = pose->at_us - before->at_us;

    if (span < SPEED_SPAN_US && before->at_us != 0)
        return;
    double dx = pose->x - before->x;
    double dy = pose->y - before->y;
    double s = (double)span / 1e6;
    bool known = before->at_us != 0 && s < BLIND_S;
    robot->view.v = known ? (dx * cos(pose->theta) + dy * sin(pose->theta)) / s : 0;
    robot->view.omega = known ? remainder(pose->theta - before->theta, 2 * M_PI) / s : 0;
    robot->anchor = *pose;
}

static bool take_body(struct tracker *tracker, const struct capture_body *body, uint32_t i,
                      int64_t measured_us)
{
    struct tracked *robot = &tracker->robot[i];
    struct tracker_view *view = &robot->view;
    struct anchor pose = {.at_us = measured_us};

    view->tracked = false;
    if (!body->tracked)
        return false;
    pose_of(&tracker->settings, &tracker->bodies[i], body, &pose);
    if (!on_the_map(&pose))
        return false;
    view->jumped = !believable(tracker, robot, &pose, &view->jump);
    if (view->jumped)
        return false;
    take_speed(robot, &pose);
    view->seen = view->tracked = view->fresh = true;
    view->x = pose.x;
    view->y = pose.y;
    view->theta = pose.theta;
    view->measured_us = measured_us;
    view->frames++;
    return true;
}

size_t tracker_take(struct tracker *tracker, const struct capture_frame *frame, int64_t arrival_us)
{
    size_t news = 0;

    for (size_t i = 0; i < tracker->count; i++)
        tracker->robot[i].view.fresh = false;
    if (!in_order(tracker, frame))
        return 0;
    int64_t measured_us = measured_at(tracker, frame, arrival_us);
    for (size_t k = 0; k < frame->count; k++) {
        hear_name(tracker, &frame->body[k]);
        uint32_t i = robot_of(tracker, frame, k);

        if (i != NOBODY)
            news += take_body(tracker, &frame->body[k], i, measured_us);
    }
    return news;
}

/* ---- looking in ------------------------------------------------------------------------ */

const struct tracker_view *tracker_look(const struct tracker *tracker, size_t robot)
{
    return &tracker->robot[robot].view;
}

double tracker_clock_rate(const struct tracker *tracker)
{
    double ours = (double)(tracker->until_us - tracker->since_us);

    return ours < 1e6 ? NAN : (tracker->last_us - tracker->first_us) / ours;
}

void tracker_believe(struct tracker *tracker)
{
    for (size_t i = 0; i < tracker->count; i++) {
        if (tracker->robot[i].view.jumped) {
            tracker->robot[i].view.seen = false;
            tracker->robot[i].anchor.at_us = 0;
        }
    }
}

const char *tracker_stranger(const struct tracker *tracker, size_t i)
{
    return i < tracker->stranger_count ? tracker->stranger[i] : NULL;
}
