#include "rehearsal.h"

#include "limits.h"

#include <math.h>
#include <string.h>

#define PERIOD_US (TICK_MS * INT64_C(1000))

/* ---- the job --------------------------------------------------------------------------- */

static bool works(const struct rehearsal_member *m)
{
    return m->job->state == JOB_WORKING;
}

/* Takes what the job has for the robot, as it is to be asked after every call of the others. */
static void ask(struct rehearsal_member *m, int64_t now_us)
{
    size_t room = m->up ? sizeof m->bytes - m->waiting : 0;

    if (works(m))
        m->waiting += m->job->kind->send(m->job, now_us, m->bytes + m->waiting, room);
}

static void link_up_or_down(struct rehearsal_member *m, int64_t now_us)
{
    bool up = !m->off && !m->cut;

    if (up == m->up)
        return;
    m->up = up;
    m->waiting = 0;
    for (int way = 0; way < 2; way++)
        if (m->radio[way] != NULL)
            radio_clear(m->radio[way]);
    if (!works(m))
        return;
    if (up)
        m->job->kind->linked(m->job, now_us);
    else
        m->job->kind->lost(m->job, m->off ? "it has no power" : "the link is cut", now_us);
    ask(m, now_us);
}

static void hear(struct rehearsal_member *m, const struct robot_period *period, int64_t now_us)
{
    if (!m->up || period->sent == 0 || !works(m))
        return;
    m->job->kind->received(m->job, period->tx, period->sent, now_us);
    ask(m, now_us);
}

static void tell(struct rehearsal_member *m, int64_t now_us)
{
    if (m->job->kind->seen == NULL || !works(m))
        return;
    m->job->kind->seen(m->job, &m->pose);
    ask(m, now_us);
}

/* ---- the robot ------------------------------------------------------------------------- */

/* Bytes that enter the link in this period, in place of which come those that leave it. */
static size_t carry(struct radio_pipe *pipe, int64_t now_us, uint8_t *bytes, size_t count,
                    size_t room)
{
    uint64_t tick = (uint64_t)(now_us / PERIOD_US);

    if (pipe == NULL)
        return count;
    radio_put(pipe, tick, bytes, count);
    return radio_take(pipe, tick, bytes, room);
}

static void run_robot(struct rehearsal_member *m, const struct link_timing *timing, int64_t now_us,
                      struct robot_period *period)
{
    size_t count = m->waiting < timing->slots ? m->waiting : timing->slots;
    uint8_t rx[sizeof m->bytes];

    memcpy(rx, m->bytes, count);
    m->waiting -= count;
    memmove(m->bytes, m->bytes + count, m->waiting);
    count = carry(m->radio[RADIO_DOWN], now_us, rx, count, timing->slots);
    m->robot->kind->run(m->robot, rx, count, period);
    period->sent =
        (uint16_t)carry(m->radio[RADIO_UP], now_us, period->tx, period->sent, sizeof period->tx);
}

/* Where motion capture sees it, `sample` being the newest one when the period ends. */
static void look(struct rehearsal_member *m, const struct mocap *mocap,
                 const struct mocap_sample *sample, int64_t end_us)
{
    struct server_pose seen = mocap_pose(mocap, sample, m->robot->id, &m->body);

    m->pose = (struct job_pose){seen.x, seen.y, seen.theta, end_us - llround(sample->age * 1e6)};
}

/* Its set-points change half-way through the period; the newest sample is younger. */
static void move(struct rehearsal_member *m, const struct link_timing *timing,
                 const struct robot_period *period, int64_t end_us)
{
    static const struct mocap exact = {.rate = TICKS_PER_S};
    const struct mocap *mocap = m->mocap != NULL ? m->mocap : &exact;
    struct mocap_sample sample = mocap_newest(mocap, (uint64_t)(end_us / PERIOD_US));
    double actuation = link_actuation_s(timing);
    bool fixed = m->kind.wheel_max == 0;

    if (!fixed) {
        body_move(&m->kind, &m->body, m->left, m->right, actuation);
        m->left = period->left;
        m->right = period->right;
        body_move(&m->kind, &m->body, m->left, m->right, TICK_MS / 1000.0 - actuation - sample.age);
    }
    look(m, mocap, &sample, end_us);
    if (!fixed)
        body_move(&m->kind, &m->body, m->left, m->right, sample.age);
}

bool rehearsal_tick(struct rehearsal_member *members, size_t count,
                    const struct link_timing *timing, int64_t *now_us, size_t *crashed)
{
    int64_t end_us = *now_us + PERIOD_US;

    for (size_t i = 0; i < count; i++) {
        struct rehearsal_member *m = &members[i];
        struct robot_period period = {0};

        link_up_or_down(m, *now_us);
        ask(m, *now_us);
        if (!m->off)
            run_robot(m, timing, *now_us, &period);
        if (period.crashed) {
            if (crashed != NULL)
                *crashed = i;
            return false;
        }
        move(m, timing, &period, end_us);
        hear(m, &period, end_us);
        tell(m, end_us);
    }
    *now_us = end_us;
    return true;
}

static bool all_have_ended(const struct rehearsal_member *members, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (works(&members[i]))
            return false;
    return true;
}

bool rehearsal_run(struct rehearsal_member *members, size_t count, const struct link_timing *timing,
                   int64_t *now_us, int64_t limit_us)
{
    int64_t until = *now_us + limit_us;

    while (!all_have_ended(members, count))
        if (*now_us >= until || !rehearsal_tick(members, count, timing, now_us, NULL))
            return false;
    return true;
}
