#include "diagnosis.h"

#include "parameter_words.h"

#include <stdarg.h>
#include <string.h>

/* A robot that gets no pose for so long stands. */
#define POSE_STALE_MS 300.0

/* Of questions, and of frames; less is what a radio loses. */
#define LOST_MAX 0.02

/* Of the time from a control tick to its set-points, the rest being for interrupts. */
#define TICK_MAX 0.95

/* Deeper than the deepest that was seen. */
#define STACK_LEAST 32

/* Images that are none. */
#define IMAGE_UNSEALED 0xFFFFFFFFu
#define IMAGE_NATIVE 0

/* The reset causes of a status (PROTOCOL.md). */
enum {
    RESET_POWER_ON = 1,
    RESET_EXTERNAL = 2,
    RESET_BROWN_OUT = 4,
    RESET_WATCHDOG = 8,
    RESET_JTAG = 16
};

static void blame(struct diagnosis *diagnosis, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static void blame(struct diagnosis *diagnosis, const char *format, ...)
{
    va_list arguments;

    if (diagnosis->count == DIAGNOSIS_FINDINGS_MAX)
        return;
    va_start(arguments, format);
    vsnprintf(diagnosis->words[diagnosis->count++], JOB_WORDS_MAX, format, arguments);
    va_end(arguments);
}

static uint32_t reading(const struct doctor_job *job, uint8_t index)
{
    return job->reading[param_row(index)].value;
}

static bool knows(const struct doctor_job *job, uint8_t index)
{
    return job->reading[param_row(index)].known;
}

/* Native robots measure neither stack nor tick. */
static bool is_chip(const struct doctor_job *job)
{
    return job->talk.status.tick_cycles != 0;
}

static double tick_ms(const struct doctor_job *job, const struct diagnosis_image *image)
{
    return job->talk.status.tick_cycles * 8e3 / image->f_cpu;
}

static double lost_part(const struct doctor_job *job)
{
    uint32_t all = job->asks + job->talk.lost;

    return all == 0 ? 0 : (double)job->talk.lost / all;
}

static double trip_ms(const struct doctor_job *job, double part)
{
    if (job->trips == 0)
        return 0;
    return job->trip_us[(size_t)(part * (job->trips - 1))] / 1e3;
}

/* Gains, dead bands, track and lag as they were made. */
static bool is_calibrated(const struct doctor_job *job)
{
    for (uint8_t i = PARAMETER_LEFT_GAIN; i <= PARAMETER_MOTOR_LAG; i++)
        if (knows(job, i) && reading(job, i) != parameter_line(i)->unless_set)
            return true;
    return false;
}

static const char *cause_of(uint8_t flags)
{
    return flags & RESET_POWER_ON    ? "power-on"
           : flags & RESET_BROWN_OUT ? "brown-out"
           : flags & RESET_WATCHDOG  ? "watchdog"
           : flags & RESET_EXTERNAL  ? "reset pin"
           : flags & RESET_JTAG      ? "JTAG"
                                     : "an update";
}

/* ---- findings -------------------------------------------------------------------------- */

static void judge_id(struct diagnosis *diagnosis, const struct doctor_job *job)
{
    const struct talk *talk = &job->talk;

    if (talk->id == 0)
        blame(diagnosis, "has no id: `muster id' gives it the site's");
    else if (talk->id != job->job.robot)
        blame(diagnosis, "says it is robot %u: mend the site file, or `muster id --force'",
              talk->id);
    if (talk->statuses > 0 && talk->status.version != PROTOCOL_VERSION)
        blame(diagnosis, "speaks version %u of the protocol, this is version %d: `muster flash'",
              talk->status.version, PROTOCOL_VERSION);
}

static bool has_image(const struct doctor_job *job)
{
    return job->job.state == JOB_DONE && knows(job, PARAMETER_IMAGE) &&
           reading(job, PARAMETER_IMAGE) != IMAGE_NATIVE;
}

/* The image that most of them run; IMAGE_NATIVE where nobody says. */
static uint32_t common_image(const struct doctor_job *jobs, size_t count)
{
    uint32_t common = IMAGE_NATIVE;
    size_t most = 0;

    for (size_t i = 0; i < count; i++) {
        size_t same = 0;

        for (size_t k = 0; k < count && has_image(&jobs[i]); k++)
            same += has_image(&jobs[k]) &&
                    reading(&jobs[k], PARAMETER_IMAGE) == reading(&jobs[i], PARAMETER_IMAGE);
        if (same > most) {
            most = same;
            common = reading(&jobs[i], PARAMETER_IMAGE);
        }
    }
    return common;
}

static void judge_image(struct diagnosis *diagnosis, const struct doctor_job *job, uint32_t wanted,
                        bool built)
{
    uint32_t image = reading(job, PARAMETER_IMAGE);

    if (!has_image(job) || image == wanted)
        return;
    if (image == IMAGE_UNSEALED)
        blame(diagnosis, "its program has no seal, so nobody knows which it is: `muster flash'");
    else if (built)
        blame(diagnosis, "runs program %08X, with muster came %08X: `muster flash'", image, wanted);
    else
        blame(diagnosis, "runs program %08X, the others %08X: `muster flash'", image, wanted);
}

static void judge_battery(struct diagnosis *diagnosis, const struct doctor_job *job)
{
    uint16_t battery = job->talk.status.battery;
    uint32_t warning = reading(job, PARAMETER_BATTERY_WARNING);
    uint32_t critical = reading(job, PARAMETER_BATTERY_CRITICAL);

    if (job->talk.status.faults & FAULT_BATTERY)
        blame(diagnosis, "has stopped for its battery (%.2f V): charge it, then switch it on again",
              battery / 1e3);
    else if (battery != 0 && battery < critical)
        blame(diagnosis, "battery at %.2f V, below its battery_critical of %.2f V: charge it",
              battery / 1e3, critical / 1e3);
    else if (battery != 0 && battery < warning)
        blame(diagnosis, "battery at %.2f V, below its battery_warning of %.2f V: charge it",
              battery / 1e3, warning / 1e3);
}

static void judge_memory(struct diagnosis *diagnosis, const struct doctor_job *job)
{
    if (knows(job, PARAMETER_EEPROM) && reading(job, PARAMETER_EEPROM) == 0 && job->talk.id != 0)
        blame(diagnosis, "its EEPROM holds no whole copy of its parameters: `muster param save'");
    if (knows(job, PARAMETER_UNSAVED) && reading(job, PARAMETER_UNSAVED) != 0)
        blame(diagnosis, "has values that are not saved: `muster param save' keeps them, a power "
                         "cycle brings the old ones back");
}

static void judge_processor(struct diagnosis *diagnosis, const struct doctor_job *job,
                            const struct diagnosis_image *image)
{
    const struct message_status *status = &job->talk.status;
    uint32_t resets = reading(job, PARAMETER_RESETS);

    if (status->state == STATE_ESTOP)
        blame(diagnosis, "is in emergency stop: switch it off and on");
    if (resets > 0 && status->reset_cause & RESET_BROWN_OUT)
        blame(diagnosis,
              "%u resets since power-on, the last by brown-out: look at its battery and "
              "wires",
              resets);
    else if (resets > 0 && status->reset_cause & RESET_WATCHDOG)
        blame(diagnosis, "%u resets since power-on, the last by the watchdog: its program hung",
              resets);
    if (!is_chip(job))
        return;
    if (tick_ms(job, image) > TICK_MAX * ACTUATION_MS)
        blame(diagnosis, "a control tick took %.2f ms of %d", tick_ms(job, image), ACTUATION_MS);
    if (status->stack_free < STACK_LEAST)
        blame(diagnosis, "only %u bytes of its memory have never been used", status->stack_free);
}

static void judge_link(struct diagnosis *diagnosis, const struct doctor_job *job)
{
    const struct talk *talk = &job->talk;
    unsigned bad = (unsigned)(talk->status.bad_frames - job->first.bad_frames);
    unsigned overruns = (unsigned)(talk->status.overruns - job->first.overruns);

    if (talk->statuses == 0)
        blame(diagnosis, "answers and sends no status: `muster flash' brings it this firmware");
    if (lost_part(job) > LOST_MAX)
        blame(diagnosis, "%.0f %% of the questions were lost: is it in reach, the air free?",
              100 * lost_part(job));
    if (talk->bad_frames > LOST_MAX * talk->frames || bad > LOST_MAX * job->asks)
        blame(diagnosis, "frames come broken, %u here and %u there: baud rate, cable, reach?",
              talk->bad_frames, bad);
    if (overruns > 0)
        blame(diagnosis, "its receiver lost %u bytes meanwhile: is its clock right for this rate?",
              overruns);
    if (trip_ms(job, 1) > POSE_STALE_MS)
        blame(diagnosis, "an answer took %.0f ms; without a pose for %.0f ms a robot stands",
              trip_ms(job, 1), POSE_STALE_MS);
}

void diagnosis_make(struct diagnosis *diagnosis, const struct doctor_job *jobs, size_t count,
                    size_t i, const struct diagnosis_image *image)
{
    const struct doctor_job *job = &jobs[i];

    diagnosis->count = 0;
    if (job->job.state != JOB_DONE) {
        blame(diagnosis, "%s", job->job.words);
        return;
    }
    judge_id(diagnosis, job);
    judge_link(diagnosis, job);
    judge_processor(diagnosis, job, image);
    judge_battery(diagnosis, job);
    judge_memory(diagnosis, job);
    judge_image(diagnosis, job, image->known ? image->crc : common_image(jobs, count),
                image->known);
}

/* ---- printing -------------------------------------------------------------------------- */

static void print_figures(FILE *out, const struct doctor_job *job,
                          const struct diagnosis_image *image)
{
    const struct message_status *status = &job->talk.status;
    char words[PARAMETER_WORDS_MAX];

    fprintf(out, "%5u  %5.0f /%4.0f  %5.1f %%  %4u /%4u  %4u", job->job.robot, trip_ms(job, 0.5),
            trip_ms(job, 1), 100 * lost_part(job), job->talk.bad_frames, status->bad_frames,
            status->overruns);
    if (is_chip(job))
        fprintf(out, "  %4.2f, %3.0f %%  %5u", tick_ms(job, image),
                100 * tick_ms(job, image) / ACTUATION_MS, status->stack_free);
    else
        fprintf(out, "  %11s  %5s", "-", "-");
    fprintf(out, "  %3u, %-12s  %u of 2  %5.2f V  ", reading(job, PARAMETER_RESETS),
            is_chip(job) ? cause_of(status->reset_cause) : "-", reading(job, PARAMETER_EEPROM),
            status->battery / 1e3);
    fprintf(out, "%8s  %s\n",
            has_image(job) ? parameter_words(PARAMETER_IMAGE, reading(job, PARAMETER_IMAGE), words)
                           : "-",
            is_calibrated(job) ? "yes" : "no");
}

bool diagnosis_print(FILE *out, const struct doctor_job *jobs, size_t count,
                     const struct diagnosis_image *image)
{
    bool good = true;

    fputs("robot   answer ms   lost   bad frames  lost   tick of 5 ms  stack  resets, last       "
          "EEPROM  battery     image  calibrated\n"
          "        p50 / max           here/there  bytes\n",
          out);
    for (size_t i = 0; i < count; i++)
        if (jobs[i].job.state == JOB_DONE)
            print_figures(out, &jobs[i], image);
    for (size_t i = 0; i < count; i++) {
        struct diagnosis diagnosis;

        diagnosis_make(&diagnosis, jobs, count, i, image);
        good &= diagnosis.count == 0;
        if (diagnosis.count == 0)
            fprintf(out, "  good  robot %u\n", jobs[i].job.robot);
        for (size_t k = 0; k < diagnosis.count; k++)
            fprintf(out, "  BAD   robot %u: %s\n", jobs[i].job.robot, diagnosis.words[k]);
    }
    fputs(good ? "All good.\n" : "Not all is good.\n", out);
    return good;
}
