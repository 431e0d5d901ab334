#include "doctor.h"

#include <stdio.h>
#include <stdlib.h>

static int by_length(const void *a, const void *b)
{
    uint32_t first = *(const uint32_t *)a, second = *(const uint32_t *)b;

    return (first > second) - (first < second);
}

static void end(struct doctor_job *self)
{
    qsort(self->trip_us, self->trips, sizeof self->trip_us[0], by_length);
    job_done(&self->job, "%s", "");
}

static void take_answer(struct doctor_job *self, int64_t now_us)
{
    const struct talk *talk = &self->talk;

    if (self->began_us == 0) {
        self->began_us = now_us;
        self->talk.lost = 0; /* it may just have been switched on */
    } else if (self->row < PARAM_ROWS) {
        self->reading[self->row++] = (struct param_reading){
            talk->answer.result == PARAMETER_DONE,
            talk->answer.value,
        };
    }
    self->asks++;
    if (talk->round_trip_us > 0 && self->trips < DOCTOR_ASKS_MAX)
        self->trip_us[self->trips++] = (uint32_t)talk->round_trip_us;
    self->talk.state = TALK_FREE;
}

/* Every parameter once, then the id again and again. */
static void ask(struct doctor_job *self, int64_t now_us)
{
    uint8_t index = self->row < PARAM_ROWS ? param_index(self->row) : PARAMETER_ID;

    self->asked_us = now_us;
    talk_ask(&self->talk, PARAMETER_GET, index, 0);
}

static void go_on(struct doctor_job *self, int64_t now_us)
{
    int64_t looked_us = now_us - self->began_us;

    if (self->talk.state == TALK_ANSWERED)
        take_answer(self, now_us);
    if (self->talk.state != TALK_FREE)
        return;
    self->job.progress = (double)looked_us / (double)self->look_us;
    if (looked_us >= self->look_us && self->row == PARAM_ROWS)
        end(self);
    else if (now_us - self->asked_us >= DOCTOR_ASK_US)
        ask(self, now_us);
}

/* ---- the job --------------------------------------------------------------------------- */

static void linked(struct job *job, int64_t now_us)
{
    talk_linked(&((struct doctor_job *)job)->talk, now_us);
    snprintf(job->words, sizeof job->words, "is asked");
}

static void lost(struct job *job, const char *words, int64_t now_us)
{
    (void)words;
    (void)now_us;
    talk_lost(&((struct doctor_job *)job)->talk);
}

static void received(struct job *job, const uint8_t *bytes, size_t count, int64_t now_us)
{
    struct doctor_job *self = (struct doctor_job *)job;

    talk_received(&self->talk, bytes, count, now_us);
    if (self->talk.statuses == 1)
        self->first = self->talk.status;
}

static size_t send(struct job *job, int64_t now_us, uint8_t *bytes, size_t room)
{
    struct doctor_job *self = (struct doctor_job *)job;

    if (!talk_judge(&self->talk, job))
        return 0;
    go_on(self, now_us);
    return talk_send(&self->talk, now_us, bytes, room);
}

static const struct job_kind kind = {linked, lost, received, NULL, send};

void doctor_begin(struct doctor_job *job, uint16_t robot, double seconds)
{
    *job = (struct doctor_job){
        .job = {.kind = &kind, .robot = robot, .words = "waits for its link"},
        .look_us = (int64_t)(seconds * 1e6),
    };
    talk_begin(&job->talk);
    job->talk.any = true;
}
