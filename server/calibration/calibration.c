#include "calibration.h"

#include "limits.h"
#include "parameter_words.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* A robot that was on a mission has stopped by then, and one that is on has said how it is. */
#define MEET_US 3000000

/* Motion capture that has not seen a robot by then does not know it. */
#define LOOK_US 5000000

/* A robot that has not been seen for so long is not driven. */
#define POSE_OLD_US 300000
#define LOOKED_MOST_US 50000

/* What motors are told is told again this often. A gap of more than the other is no drive any more:
 * at 200 ms the robot stops by itself. */
#define TELL_US (TICK_MS * 1000)
#define TELL_GAP_US 180000

/* From the first telling to the status that says that it drives. */
#define OBEY_US 1200000

/* A trial that went so far astray was not measured right, m, unless it did before. */
#define ASTRAY 0.03

static struct calibration *calibration_of(struct job *job)
{
    return (struct calibration *)job;
}

/* ---- phases and their words ------------------------------------------------------------ */

static void enter(struct calibration *c, enum calibration_phase phase, int64_t now_us)
{
    static const char *const words[] = {
        [CALIBRATION_MEET] = "asks who it is",
        [CALIBRATION_READ] = "reads its parameters",
        [CALIBRATION_LOOK] = "looks for it in motion capture",
        [CALIBRATION_WAIT] = "waits for its turn",
        [CALIBRATION_MEASURE] = "measures its wheels",
        [CALIBRATION_FIT] = "works out its wheels",
        [CALIBRATION_BEFORE] = "drives as it did before",
        [CALIBRATION_SET] = "sets its parameters",
        [CALIBRATION_AFTER] = "drives by them",
        [CALIBRATION_SAVE] = "saves them",
        [CALIBRATION_CHECK] = "reads them again",
        [CALIBRATION_GIVE_BACK] = "sets its old parameters again",
    };
    static const double progress[] = {
        [CALIBRATION_MEET] = 0,     [CALIBRATION_READ] = 0,       [CALIBRATION_LOOK] = 0.02,
        [CALIBRATION_WAIT] = 0.02,  [CALIBRATION_MEASURE] = 0.05, [CALIBRATION_FIT] = 0.6,
        [CALIBRATION_BEFORE] = 0.6, [CALIBRATION_SET] = 0.76,     [CALIBRATION_AFTER] = 0.78,
        [CALIBRATION_SAVE] = 0.95,  [CALIBRATION_CHECK] = 0.97,   [CALIBRATION_GIVE_BACK] = 0.98,
    };

    c->phase = phase;
    c->phase_us = now_us;
    c->next = CALIBRATION_FIRST;
    c->job.progress = progress[phase];
    snprintf(c->job.words, sizeof c->job.words, "%s", words[phase]);
}

static bool drives(const struct calibration *c)
{
    return c->phase == CALIBRATION_MEASURE || c->phase == CALIBRATION_BEFORE ||
           c->phase == CALIBRATION_AFTER;
}

/* Sets or asks for the parameter whose turn it is. */
static void ask_next(struct calibration *c)
{
    uint8_t i = c->next - CALIBRATION_FIRST;

    if (c->phase == CALIBRATION_SET)
        talk_ask(&c->talk, PARAMETER_SET, c->next, c->result.value[i]);
    else if (c->phase == CALIBRATION_GIVE_BACK)
        talk_ask(&c->talk, PARAMETER_SET, c->next, c->old[i]);
    else
        talk_ask(&c->talk, PARAMETER_GET, c->next, 0);
}

static void go_through(struct calibration *c, enum calibration_phase phase, int64_t now_us)
{
    enter(c, phase, now_us);
    ask_next(c);
}

/* The robot stands: what its motors were told last ends by itself. */
static void fail(struct calibration *c, int64_t now_us, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static void fail(struct calibration *c, int64_t now_us, const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(c->trouble, sizeof c->trouble, format, arguments);
    va_end(arguments);
    turns_leave(c->turns, c->place);
    if (c->changed)
        go_through(c, CALIBRATION_GIVE_BACK, now_us);
    else
        job_failed(&c->job, "%s", c->trouble);
}

/* ---- before it drives ------------------------------------------------------------------ */

const char *calibration_refusal(const struct talk *talk)
{
    if (talk->statuses == 0)
        return "";
    switch (talk->status.state) {
    case STATE_ESTOP: return "is in emergency stop: switch it off and on";
    case STATE_SPENT: return "has an empty battery: charge it, and switch it off and on";
    case STATE_IDLE:
    case STATE_READY:
    case STATE_TRIAL: return NULL;
    default: return "";
    }
}

static void meet(struct calibration *c, int64_t now_us)
{
    const char *words = calibration_refusal(&c->talk);

    if (words == NULL)
        go_through(c, CALIBRATION_READ, now_us);
    else if (words[0] != '\0')
        fail(c, now_us, "%s", words);
    else if (now_us - c->phase_us > MEET_US)
        fail(c, now_us, "%s",
             c->talk.statuses == 0 ? "answers, and says nothing of how it is"
                                   : "is on a mission, and does not end it");
}

/* When this process was held up for longer, what was seen meanwhile has still to come. */
static void watch(struct calibration *c, int64_t now_us)
{
    int64_t looked_us = now_us - c->now_us;

    c->now_us = now_us;
    c->blind_us += looked_us < LOOKED_MOST_US ? looked_us : LOOKED_MOST_US;
}

static bool is_seen(const struct calibration *c)
{
    return c->pose.at_us != 0 && c->blind_us <= POSE_OLD_US;
}

static void look(struct calibration *c, int64_t now_us)
{
    if (is_seen(c))
        enter(c, CALIBRATION_WAIT, now_us);
    else if (now_us - c->phase_us > LOOK_US)
        fail(c, now_us, "motion capture does not see its body");
}

/* ---- driving --------------------------------------------------------------------------- */

static void begin_drive(struct calibration *c, enum calibration_phase phase, int64_t now_us)
{
    enter(c, phase, now_us);
    c->begun_us = 0;
    c->statuses = c->talk.statuses;
    c->record.change_count = c->record.sight_count = 0;
}

/* In m: what the motion law takes the robot's for. */
static double track_of(const struct calibration *c, uint16_t value)
{
    return value == 0 ? c->settings->wheels.track : parameter_of(PARAMETER_TRACK, value);
}

static void begin_trial(struct calibration *c, enum calibration_phase phase, uint16_t track,
                        int64_t now_us)
{
    drive_plan_trial(&c->plan, &c->settings->wheels, track_of(c, track));
    begin_drive(c, phase, now_us);
}

static void wait_for_turn(struct calibration *c, int64_t now_us)
{
    char words[JOB_WORDS_MAX];

    if (!is_seen(c)) {
        enter(c, CALIBRATION_LOOK, now_us);
        return;
    }
    switch (turns_take(c->turns, c->place, words, sizeof words)) {
    case TURN_NEVER: fail(c, now_us, "%s", words); return;
    case TURN_LATER: memcpy(c->job.words, words, sizeof words); return;
    case TURN_TAKEN: break;
    }
    c->home_x = c->pose.x;
    c->home_y = c->pose.y;
    drive_plan_measure(&c->plan, &c->settings->wheels);
    begin_drive(c, CALIBRATION_MEASURE, now_us);
}

static void set_out(struct calibration *c, int64_t now_us)
{
    if (!is_seen(c)) {
        if (now_us - c->phase_us > LOOK_US)
            fail(c, now_us, "motion capture has lost its body");
        return;
    }
    c->begun_us = c->told_us = now_us;
    c->turns->place[c->place].moves = true;
}

/* By what it was told last. */
static bool turns_wheels(const struct calibration *c)
{
    size_t count = c->record.change_count;

    return count > 0 &&
           (c->record.change[count - 1].left != 0 || c->record.change[count - 1].right != 0);
}

/* False when it must not go on. */
static bool may_drive(struct calibration *c, int64_t now_us)
{
    double away = hypot(c->pose.x - c->home_x, c->pose.y - c->home_y);
    bool told = now_us - c->begun_us > OBEY_US && c->talk.statuses > c->statuses + 1;
    const char *refusal = calibration_refusal(&c->talk);
    char words[JOB_WORDS_MAX];

    if (!is_seen(c))
        fail(c, now_us, "stopped: motion capture has lost its body");
    else if (away > DRIVE_ROOM)
        fail(c, now_us, "stopped: it was %.2f m from where it began, and %g m are its room", away,
             DRIVE_ROOM);
    else if (!turns_is_clear(c->turns, c->place, words, sizeof words))
        fail(c, now_us, "stopped: %.140s", words);
    else if (turns_wheels(c) && now_us - c->told_us > TELL_GAP_US)
        fail(c, now_us, "stopped: its link took nothing for %.2f s; drive fewer robots at a time",
             (double)(now_us - c->told_us) / 1e6);
    else if (refusal != NULL && refusal[0] != '\0')
        fail(c, now_us, "stopped by itself: it %s", refusal);
    else if (told && c->talk.status.state != STATE_TRIAL)
        fail(c, now_us, "does not let itself be driven: is its firmware older?");
    return c->job.state == JOB_WORKING && drives(c);
}

/* ---- what comes of it ------------------------------------------------------------------ */

static bool take_values(struct calibration *c, char *words, size_t room)
{
    const struct wheel_fit *fit = &c->result.fit;
    const double measured[CALIBRATION_PARAMETERS] = {
        fit->gain[WHEEL_LEFT],
        fit->gain[WHEEL_RIGHT],
        fit->dead[WHEEL_LEFT],
        fit->dead[WHEEL_RIGHT],
        fit->track,
        fit->lag,
    };

    for (uint8_t i = 0; i < CALIBRATION_PARAMETERS; i++)
        if (!parameter_round((uint8_t)(CALIBRATION_FIRST + i), measured[i], &c->result.value[i],
                             words, room))
            return false;
    return true;
}

static void judge_measure(struct calibration *c, int64_t now_us)
{
    char words[WHEEL_FIT_WORDS_MAX];

    if (!wheel_fit(&c->record, &c->settings->wheels, &c->result.fit, words) ||
        !take_values(c, words, sizeof words)) {
        fail(c, now_us, "%s", words);
        return;
    }
    begin_trial(c, CALIBRATION_BEFORE, c->old[PARAMETER_TRACK - CALIBRATION_FIRST], now_us);
}

static double error_of(const struct calibration *c, uint16_t track)
{
    return wheel_fit_trial_error(&c->record, &c->settings->wheels, track_of(c, track),
                                 &c->result.fit);
}

static void judge_after(struct calibration *c, int64_t now_us)
{
    struct calibration_result *result = &c->result;

    result->after = error_of(c, result->value[PARAMETER_TRACK - CALIBRATION_FIRST]);
    turns_leave(c->turns, c->place);
    if (!(result->after <= fmax(ASTRAY, result->before)))
        fail(c, now_us, "drove %.3f m astray after it, and %.3f m before: something is loose",
             result->after, result->before);
    else if (!c->settings->save)
        go_through(c, CALIBRATION_GIVE_BACK, now_us);
    else {
        enter(c, CALIBRATION_SAVE, now_us);
        talk_ask(&c->talk, PARAMETER_SAVE, 0, 0);
    }
}

static void end_drive(struct calibration *c, int64_t now_us)
{
    c->turns->place[c->place].moves = false;
    if (c->phase == CALIBRATION_MEASURE) {
        enter(c, CALIBRATION_FIT, now_us);
    } else if (c->phase == CALIBRATION_BEFORE) {
        c->result.before = error_of(c, c->old[PARAMETER_TRACK - CALIBRATION_FIRST]);
        c->changed = true;
        go_through(c, CALIBRATION_SET, now_us);
    } else {
        judge_after(c, now_us);
    }
}

/* Says what the motors are to do, where that is due. */
static size_t tell_motors(struct calibration *c, int64_t now_us, uint8_t *bytes, size_t used,
                          size_t room)
{
    double t = (double)(now_us - c->begun_us) / 1e6;
    const struct drive_segment *now = drive_at(&c->plan, t);

    if (now == NULL) {
        end_drive(c, now_us);
        return used;
    }
    const struct drive_change *last = &c->record.change[c->record.change_count];
    bool same =
        c->record.change_count > 0 && last[-1].left == now->left && last[-1].right == now->right;
    if (same && now_us - c->told_us < TELL_US)
        return used;
    const struct message message = {
        .type = MESSAGE_DRIVE,
        .drive = {now->left, now->right, c->plan.corrected},
    };
    size_t with = talk_put(&message, bytes, used, room);
    if (with > used) {
        drive_record_sent(&c->record, t, now->left, now->right);
        c->told_us = now_us;
    }
    return with;
}

/* ---- parameters ------------------------------------------------------------------------ */

/* All six have been read, set or compared. */
static void end_of_six(struct calibration *c, int64_t now_us)
{
    struct calibration_result *result = &c->result;

    switch (c->phase) {
    case CALIBRATION_READ: enter(c, CALIBRATION_LOOK, now_us); break;
    case CALIBRATION_SET:
        begin_trial(c, CALIBRATION_AFTER, result->value[PARAMETER_TRACK - CALIBRATION_FIRST],
                    now_us);
        break;
    case CALIBRATION_CHECK:
        job_done(&c->job, "before %.3f m, after %.3f m", result->before, result->after);
        break;
    default:
        if (c->trouble[0] != '\0')
            job_failed(&c->job, "%s", c->trouble);
        else
            job_done(&c->job, "before %.3f m, after %.3f m, not saved", result->before,
                     result->after);
    }
}

/* The old ones are in its EEPROM all the same. */
static void end_with_new_ones(struct calibration *c)
{
    char words[JOB_WORDS_MAX];

    snprintf(words, sizeof words, "%s", c->trouble[0] != '\0' ? c->trouble : c->job.words);
    job_failed(&c->job, "%.90s; switch it off and on for its old parameters", words);
}

static void take_answer(struct calibration *c, int64_t now_us)
{
    const struct message_answer *answer = &c->talk.answer;
    uint8_t i = c->next - CALIBRATION_FIRST;
    uint16_t value = (uint16_t)answer->value;

    if (answer->result != PARAMETER_DONE) {
        if (c->phase == CALIBRATION_GIVE_BACK)
            end_with_new_ones(c);
        else
            fail(c, now_us, "%s", talk_result_words(answer->result));
        return;
    }
    if (c->phase == CALIBRATION_SAVE) {
        c->changed = false;
        go_through(c, CALIBRATION_CHECK, now_us);
        return;
    }
    if (c->phase == CALIBRATION_READ)
        c->old[i] = value;
    if (c->phase == CALIBRATION_CHECK && value != c->result.value[i]) {
        job_failed(&c->job, "has other parameters than it was given and has saved");
        return;
    }
    if (c->next++ < CALIBRATION_LAST)
        ask_next(c);
    else
        end_of_six(c, now_us);
}

/* ---- the job --------------------------------------------------------------------------- */

static void linked(struct job *job, int64_t now_us)
{
    struct calibration *c = calibration_of(job);

    talk_linked(&c->talk, now_us);
    if (c->phase == CALIBRATION_MEET)
        c->phase_us = now_us;
}

static void lost(struct job *job, const char *words, int64_t now_us)
{
    struct calibration *c = calibration_of(job);

    talk_lost(&c->talk);
    if (drives(c))
        fail(c, now_us, "stopped: %s", words);
}

static void received(struct job *job, const uint8_t *bytes, size_t count, int64_t now_us)
{
    talk_received(&calibration_of(job)->talk, bytes, count, now_us);
}

static void seen(struct job *job, const struct job_pose *pose)
{
    struct calibration *c = calibration_of(job);

    c->pose = *pose;
    c->blind_us = 0;
    turns_see(c->turns, c->place, pose->x, pose->y);
    if (drives(c) && c->begun_us != 0 && pose->at_us >= c->begun_us)
        drive_record_seen(&c->record, (double)(pose->at_us - c->begun_us) / 1e6, pose->x, pose->y,
                          pose->theta);
}

static void advance(struct calibration *c, int64_t now_us)
{
    switch (c->phase) {
    case CALIBRATION_MEET: meet(c, now_us); break;
    case CALIBRATION_LOOK: look(c, now_us); break;
    case CALIBRATION_WAIT: wait_for_turn(c, now_us); break;
    case CALIBRATION_FIT:
        if (turns_are_quiet(c->turns, c->place))
            judge_measure(c, now_us);
        break;
    case CALIBRATION_MEASURE:
    case CALIBRATION_BEFORE:
    case CALIBRATION_AFTER: break;
    default: take_answer(c, now_us);
    }
}

static size_t send(struct job *job, int64_t now_us, uint8_t *bytes, size_t room)
{
    struct calibration *c = calibration_of(job);
    size_t used = talk_send(&c->talk, now_us, bytes, room);

    watch(c, now_us);
    if (!talk_judge(&c->talk, job)) {
        turns_leave(c->turns, c->place);
        if (c->changed)
            end_with_new_ones(c);
        return used;
    }
    if (c->talk.state != TALK_ANSWERED)
        return used;
    advance(c, now_us);
    if (drives(c) && c->begun_us == 0)
        set_out(c, now_us);
    if (drives(c) && c->begun_us != 0 && may_drive(c, now_us))
        used = tell_motors(c, now_us, bytes, used, room);
    return used;
}

void calibration_begin(struct calibration *calibration, uint16_t robot,
                       const struct calibration_settings *settings, struct turns *turns,
                       size_t place)
{
    static const struct job_kind kind = {linked, lost, received, seen, send};

    *calibration = (struct calibration){
        .job = {.kind = &kind, .robot = robot},
        .settings = settings,
        .turns = turns,
        .place = place,
    };
    talk_begin(&calibration->talk);
    enter(calibration, CALIBRATION_MEET, 0);
}

void calibration_stop(struct calibration *calibration, const char *words, int64_t now_us)
{
    if (calibration->job.state == JOB_WORKING && calibration->phase < CALIBRATION_SAVE)
        fail(calibration, now_us, "%s", words);
}

size_t calibration_entries(const struct calibration *calibrations, size_t count,
                           struct parameter_entry *entries)
{
    size_t done = 0;

    for (size_t i = 0; i < count; i++) {
        const struct calibration *c = &calibrations[i];
        struct parameter_entry *entry = &entries[done];

        if (c->job.state != JOB_DONE)
            continue;
        done++;
        parameters_default(&entry->parameters);
        entry->parameters.value[PARAMETER_ID] = c->job.robot;
        entry->given = 1u << PARAMETER_ID;
        for (uint8_t k = 0; k < CALIBRATION_PARAMETERS; k++) {
            entry->parameters.value[CALIBRATION_FIRST + k] = c->result.value[k];
            entry->given |= 1u << (CALIBRATION_FIRST + k);
        }
    }
    return done;
}
