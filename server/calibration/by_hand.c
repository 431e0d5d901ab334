#include "by_hand.h"

#include "calibration.h"
#include "limits.h"
#include "parameter_words.h"

#include <stdarg.h>
#include <stdio.h>

#define DRIVE_US 1000000
#define TELL_US (TICK_MS * 1000)

/* Wheels turn at this part of full PWM. */
#define SPEED (PWM_STEPS * 2 / 5)

/* One press changes a gain, or both dead bands, by this much: of 1, and of full PWM. */
#define TRIM 0.005

#define BIT(index) (1u << (index))
#define TRIMS                                                                                      \
    (BIT(PARAMETER_LEFT_GAIN) | BIT(PARAMETER_RIGHT_GAIN) | BIT(PARAMETER_LEFT_DEAD_BAND) |        \
     BIT(PARAMETER_RIGHT_DEAD_BAND))

static struct by_hand *by_hand_of(struct job *job)
{
    return (struct by_hand *)job;
}

static void say(const struct by_hand *hand, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static void say(const struct by_hand *hand, const char *format, ...)
{
    char words[JOB_WORDS_MAX];
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(words, sizeof words, format, arguments);
    va_end(arguments);
    hand->say(words);
}

/* ---- keys ------------------------------------------------------------------------------ */

static void say_keys(const struct by_hand *hand)
{
    say(hand, "arrows or space drive for 1 s; l, r: left, right wheel stronger; +, -: dead band; "
              "s saves; q leaves");
}

static void drive(struct by_hand *hand, const char *where, int left, int right, int64_t now_us)
{
    say(hand, "%s for 1 s", where);
    hand->left = left;
    hand->right = right;
    hand->until_us = now_us + DRIVE_US;
}

static void trim(struct by_hand *hand, uint8_t index, double by)
{
    char words[JOB_WORDS_MAX];
    uint16_t value;

    if (!parameter_round(index, parameter_of(index, hand->value[index]) + by, &value, words,
                         sizeof words)) {
        say(hand, "%s", words);
        return;
    }
    hand->value[index] = value;
    hand->due |= (uint16_t)BIT(index);
}

static void end(struct by_hand *hand)
{
    if (hand->unsaved || hand->due != 0)
        job_done(&hand->job, "not saved: what was changed lasts until it is switched off");
    else
        job_done(&hand->job, "left as it is saved");
}

void by_hand_press(struct by_hand *hand, int key, int64_t now_us)
{
    if (hand->job.state != JOB_WORKING)
        return;
    if (key == '\n')
        return;
    if (key == 'q') {
        end(hand);
        return;
    }
    if (!hand->ready) {
        say(hand, "its parameters are still being read");
        return;
    }
    switch (key) {
    case ' ':
    case BY_HAND_FORWARD: drive(hand, "forward", 1, 1, now_us); break;
    case BY_HAND_BACK: drive(hand, "back", -1, -1, now_us); break;
    case BY_HAND_LEFT: drive(hand, "left, on the spot", -1, 1, now_us); break;
    case BY_HAND_RIGHT: drive(hand, "right, on the spot", 1, -1, now_us); break;
    /* A wheel that is taken for a slower one is given more. */
    case 'l': trim(hand, PARAMETER_LEFT_GAIN, -TRIM); break;
    case 'r': trim(hand, PARAMETER_RIGHT_GAIN, -TRIM); break;
    case '+':
    case '-':
        trim(hand, PARAMETER_LEFT_DEAD_BAND, key == '+' ? TRIM : -TRIM);
        trim(hand, PARAMETER_RIGHT_DEAD_BAND, key == '+' ? TRIM : -TRIM);
        break;
    case 's': hand->save_due = true; break;
    default: say_keys(hand);
    }
}

/* ---- parameters ------------------------------------------------------------------------ */

static uint8_t lowest(uint16_t bits)
{
    uint8_t index = 0;

    while ((bits >> index & 1) == 0)
        index++;
    return index;
}

static void say_value(const struct by_hand *hand, uint8_t index)
{
    char words[PARAMETER_WORDS_MAX];

    say(hand, "%s %s", parameter_line(index)->name,
        parameter_words(index, hand->value[index], words));
}

static void take_answer(struct by_hand *hand)
{
    const struct message_answer *answer = &hand->talk.answer;
    const struct message_ask *ask = &hand->talk.ask;

    if (answer->result != PARAMETER_DONE) {
        job_failed(&hand->job, "%s", talk_result_words(answer->result));
    } else if (ask->action == PARAMETER_SET) {
        hand->unsaved = true;
        say_value(hand, ask->index);
    } else if (ask->action == PARAMETER_SAVE) {
        hand->unsaved = false;
        say(hand, "saved");
    } else if (BIT(ask->index) & TRIMS) {
        hand->value[ask->index] = (uint16_t)answer->value;
        hand->known |= (uint16_t)BIT(ask->index);
        say_value(hand, ask->index);
    }
}

static void ask_next(struct by_hand *hand)
{
    uint16_t unknown = TRIMS & (uint16_t)~hand->known;

    hand->talk.state = TALK_FREE;
    if (unknown != 0) {
        talk_ask(&hand->talk, PARAMETER_GET, lowest(unknown), 0);
    } else if (hand->due != 0) {
        uint8_t index = lowest(hand->due);

        hand->due &= (uint16_t)~BIT(index);
        talk_ask(&hand->talk, PARAMETER_SET, index, hand->value[index]);
    } else if (hand->save_due) {
        hand->save_due = false;
        talk_ask(&hand->talk, PARAMETER_SAVE, 0, 0);
    }
    if (unknown == 0 && !hand->ready)
        say_keys(hand);
    hand->ready = unknown == 0;
}

/* ---- the job --------------------------------------------------------------------------- */

static void linked(struct job *job, int64_t now_us)
{
    talk_linked(&by_hand_of(job)->talk, now_us);
}

static void lost(struct job *job, const char *words, int64_t now_us)
{
    struct by_hand *hand = by_hand_of(job);

    talk_lost(&hand->talk);
    hand->until_us = now_us;
    say(hand, "%s", words);
}

static void received(struct job *job, const uint8_t *bytes, size_t count, int64_t now_us)
{
    talk_received(&by_hand_of(job)->talk, bytes, count, now_us);
}

static size_t tell_motors(struct by_hand *hand, int64_t now_us, uint8_t *bytes, size_t used,
                          size_t room)
{
    bool over = now_us >= hand->until_us;
    const struct message message = {
        .type = MESSAGE_DRIVE,
        .drive =
            {
                .left = (int16_t)(over ? 0 : hand->left * SPEED),
                .right = (int16_t)(over ? 0 : hand->right * SPEED),
                .corrected = true,
            },
    };

    if (hand->until_us == 0 || now_us - hand->told_us < TELL_US)
        return used;
    size_t with = talk_put(&message, bytes, used, room);
    if (with > used)
        hand->told_us = now_us;
    if (with > used && over)
        hand->until_us = 0;
    return with;
}

static size_t send(struct job *job, int64_t now_us, uint8_t *bytes, size_t room)
{
    struct by_hand *hand = by_hand_of(job);
    size_t used = talk_send(&hand->talk, now_us, bytes, room);

    if (!talk_judge(&hand->talk, job))
        return used;
    if (hand->talk.state == TALK_ANSWERED)
        take_answer(hand);
    if (hand->talk.state != TALK_ASKING && job->state == JOB_WORKING)
        ask_next(hand);
    const char *words = calibration_refusal(&hand->talk);
    if (words != NULL && words[0] != '\0')
        job_failed(job, "%s", words);
    return tell_motors(hand, now_us, bytes, used, room);
}

void by_hand_begin(struct by_hand *hand, uint16_t robot, void (*say)(const char *words))
{
    static const struct job_kind kind = {linked, lost, received, NULL, send};

    *hand = (struct by_hand){.job = {.kind = &kind, .robot = robot}, .say = say};
    talk_begin(&hand->talk);
}
