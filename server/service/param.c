#include "param.h"

#include "parameter_words.h"

#include <stdio.h>

uint8_t param_index(size_t row)
{
    return (uint8_t)(row < PARAMETERS_STORED_COUNT
                         ? row
                         : row - PARAMETERS_STORED_COUNT + PARAMETERS_READ_FROM);
}

size_t param_row(uint8_t index)
{
    return index < PARAMETERS_STORED_COUNT
               ? index
               : (size_t)index - PARAMETERS_READ_FROM + PARAMETERS_STORED_COUNT;
}

/* ---- the steps ------------------------------------------------------------------------- */

static void add(struct param_job *job, enum parameter_action action, uint8_t index, bool after)
{
    job->steps[job->step_count++] = (struct param_step){(uint8_t)action, index, after};
}

static void add_all(struct param_job *job, enum parameter_action action, uint64_t rows, bool after)
{
    for (size_t row = 0; row < PARAM_ROWS; row++)
        if (rows >> row & 1)
            add(job, action, param_index(row), after);
}

/* Its id comes last: until then it is the robot that it was. */
static void add_steps(struct param_job *job)
{
    const struct param_plan *plan = &job->plan;
    uint64_t id = param_bit(PARAMETER_ID);
    uint64_t rows = plan->read | plan->set | (plan->reset ? PARAM_STORED & ~id : 0);

    add_all(job, PARAMETER_GET, rows, false);
    if (plan->reset)
        add(job, PARAMETER_RESET, 0, false);
    add_all(job, PARAMETER_SET, plan->set & ~id, false);
    add_all(job, PARAMETER_SET, plan->set & id, false);
    if (plan->save)
        add(job, PARAMETER_SAVE, 0, false);
    if (plan->reset || plan->save || plan->set != 0)
        add_all(job, PARAMETER_GET, rows, true);
}

/* ---- the answers ----------------------------------------------------------------------- */

/* What is to be in force at the end; false of those that nothing was done to. */
static bool is_changed(const struct param_plan *plan, uint8_t index, uint16_t *value)
{
    bool set = plan->set & param_bit(index);

    if (!parameter_is_stored(index) || (!set && (!plan->reset || index == PARAMETER_ID)))
        return false;
    *value = set ? plan->value[index] : parameter_line(index)->unless_set;
    return true;
}

static void take_reading(struct param_job *job, const struct param_step *step)
{
    const struct message_answer *answer = &job->talk.answer;
    size_t row = param_row(step->index);
    struct param_reading reading = {answer->result == PARAMETER_DONE, answer->value};
    uint16_t wanted;

    if (answer->result != PARAMETER_DONE && answer->result != PARAMETER_UNKNOWN) {
        job_failed(&job->job, "cannot read %s: %s", parameter_line(step->index)->name,
                   talk_result_words(answer->result));
        return;
    }
    (step->after ? job->after : job->before)[row] = reading;
    if (step->after && reading.known && is_changed(&job->plan, step->index, &wanted) &&
        reading.value != wanted) {
        char words[PARAMETER_WORDS_MAX];

        job_failed(&job->job, "%s is %s though it was set: was the robot reset meanwhile?",
                   parameter_line(step->index)->name,
                   parameter_words(step->index, reading.value, words));
    }
}

static void take_answer(struct param_job *job)
{
    const struct param_step *step = &job->steps[job->step];
    uint8_t result = job->talk.answer.result;

    if (step->action == PARAMETER_GET) {
        take_reading(job, step);
    } else if (result != PARAMETER_DONE) {
        const char *what = step->action == PARAMETER_SET     ? "cannot set "
                           : step->action == PARAMETER_RESET ? "cannot reset"
                                                             : "cannot save";
        job_failed(&job->job, "%s%s: %s", what,
                   step->action == PARAMETER_SET ? parameter_line(step->index)->name : "",
                   talk_result_words(result));
    } else if (step->action == PARAMETER_SET && step->index == PARAMETER_ID) {
        job->job.robot = job->plan.value[PARAMETER_ID];
    }
}

static void ask(struct param_job *job)
{
    static const char *const words[] = {"is read", "is set", "is saved", "is reset"};
    const struct param_step *step = &job->steps[job->step];
    uint32_t value = step->action == PARAMETER_SET ? job->plan.value[step->index] : 0;

    snprintf(job->job.words, sizeof job->job.words, "%s", words[step->action]);
    talk_ask(&job->talk, (enum parameter_action)step->action, step->index, value);
}

/* The first answer is talk.h's own: who is there. */
static void go_on(struct param_job *job)
{
    if (job->met)
        take_answer(job);
    if (job->job.state != JOB_WORKING)
        return;
    job->step += job->met;
    job->met = true;
    job->talk.any |= (job->plan.set & param_bit(PARAMETER_ID)) != 0; /* it is read at the end */
    job->job.progress = (double)job->step / (double)job->step_count;
    if (job->step < job->step_count)
        ask(job);
    else
        job_done(&job->job, "%s", "");
}

/* ---- the job --------------------------------------------------------------------------- */

static void linked(struct job *job, int64_t now_us)
{
    talk_linked(&((struct param_job *)job)->talk, now_us);
}

static void lost(struct job *job, const char *words, int64_t now_us)
{
    (void)words;
    (void)now_us;
    talk_lost(&((struct param_job *)job)->talk);
}

static void received(struct job *job, const uint8_t *bytes, size_t count, int64_t now_us)
{
    talk_received(&((struct param_job *)job)->talk, bytes, count, now_us);
}

static size_t send(struct job *job, int64_t now_us, uint8_t *bytes, size_t room)
{
    struct param_job *self = (struct param_job *)job;

    if (!talk_judge(&self->talk, job))
        return 0;
    if (self->talk.state == TALK_ANSWERED)
        go_on(self);
    return job->state == JOB_WORKING ? talk_send(&self->talk, now_us, bytes, room) : 0;
}

static const struct job_kind kind = {linked, lost, received, NULL, send};

void param_begin(struct param_job *job, uint16_t robot, const struct param_plan *plan)
{
    *job = (struct param_job){
        .job = {.kind = &kind, .robot = robot, .words = "waits for its link"},
        .plan = *plan,
    };
    talk_begin(&job->talk);
    job->talk.any = plan->any;
    add_steps(job);
}
