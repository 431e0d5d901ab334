#include "talk.h"

#include "limits.h"

#include <string.h>

#define KEEP_US 100000

/* Between two calls. When they came later, what the robot has said meanwhile is still unread. */
#define LISTENED_MAX_US 200000

void talk_begin(struct talk *talk)
{
    *talk = (struct talk){.state = TALK_FREE};
    talk_ask(talk, PARAMETER_GET, PARAMETER_ID, 0);
}

void talk_linked(struct talk *talk, int64_t now_us)
{
    talk->linked = true;
    talk->in_step = false;
    talk->now_us = now_us;
    talk->kept_us = now_us - KEEP_US;
    frame_decoder_init(&talk->decoder);
    /* Answers to who asked before may still be on their way. */
    if (!talk->answers)
        talk->ask.tag = (uint8_t)(now_us / 1000);
}

void talk_lost(struct talk *talk)
{
    talk->linked = false;
}

void talk_ask(struct talk *talk, enum parameter_action action, uint8_t index, uint32_t value)
{
    talk->ask = (struct message_ask){
        .tag = (uint8_t)(talk->ask.tag + 1),
        .action = (uint8_t)action,
        .index = index,
        .value = value,
    };
    talk->state = TALK_ASKING;
    talk->heard = talk->busy = false;
    talk->sent = 0;
    talk->waited_us = 0;
    talk->round_trip_us = 0;
}

static int64_t patience_us(const struct talk *talk)
{
    return talk->ask.action == PARAMETER_SAVE ? TALK_SAVE_PATIENCE_US : TALK_PATIENCE_US;
}

/* ---- from the robot -------------------------------------------------------------------- */

static void meet(struct talk *talk, uint16_t id)
{
    talk->met = true;
    talk->id = id;
    talk->heard = true;
}

static void hear_answer(struct talk *talk, const struct message_answer *answer, int64_t now_us)
{
    bool one = talk->ask.action == PARAMETER_GET || talk->ask.action == PARAMETER_SET;

    meet(talk, answer->id);
    if (talk->state != TALK_ASKING || answer->tag != talk->ask.tag || talk->sent == 0)
        return;
    /* To somebody else's question, by chance with the same tag. */
    if (one && answer->index != talk->ask.index) {
        talk->ask.tag++;
        return;
    }
    talk->answers = true;
    talk->answer = *answer;
    talk->busy = answer->result == PARAMETER_BUSY;
    if (talk->busy)
        return;
    talk->state = TALK_ANSWERED;
    if (talk->sent == 1)
        talk->round_trip_us = now_us - talk->sent_us;
}

static void hear(struct talk *talk, int64_t now_us)
{
    struct message message;

    if (!message_read(&message, talk->decoder.payload, talk->decoder.length)) {
        talk->bad_frames++;
        return;
    }
    talk->frames++;
    if (message.type == MESSAGE_STATUS) {
        meet(talk, message.status.id);
        talk->status = message.status;
        talk->statuses++;
    } else if (message.type == MESSAGE_ANSWER) {
        hear_answer(talk, &message.answer, now_us);
    }
}

void talk_received(struct talk *talk, const uint8_t *bytes, size_t count, int64_t now_us)
{
    const uint8_t *next = bytes;

    while (next != bytes + count) {
        enum frame_event event = frame_scan(&talk->decoder, &next, bytes + count);

        if (event == FRAME_READY)
            hear(talk, now_us);
        else if (event == FRAME_BAD && talk->in_step)
            talk->bad_frames++;
        /* Of the first one, nobody may have heard the beginning. */
        talk->in_step |= event != FRAME_PENDING;
    }
}

/* ---- to the robot ---------------------------------------------------------------------- */

size_t talk_put(const struct message *message, uint8_t *bytes, size_t used, size_t room)
{
    uint8_t payload[FRAME_PAYLOAD_MAX], frame[FRAME_BYTES_MAX];
    size_t length = frame_encode(frame, payload, message_write(payload, message));

    if (room - used < length)
        return used;
    memcpy(bytes + used, frame, length);
    return used + length;
}

static size_t send_question(struct talk *talk, int64_t now_us, uint8_t *bytes, size_t room)
{
    const struct message message = {.type = MESSAGE_ASK, .ask = talk->ask};

    if (talk->state != TALK_ASKING || (talk->sent > 0 && now_us - talk->sent_us < TALK_REPEAT_US))
        return 0;
    size_t used = talk_put(&message, bytes, 0, room);
    if (used == 0)
        return 0;
    talk->lost += talk->sent > 0;
    talk->sent++;
    talk->sent_us = now_us;
    return used;
}

static void wait_longer(struct talk *talk, int64_t now_us)
{
    int64_t listened_us = now_us - talk->now_us;

    if (talk->linked && talk->state == TALK_ASKING)
        talk->waited_us += listened_us < LISTENED_MAX_US ? listened_us : LISTENED_MAX_US;
    if (talk->state == TALK_ASKING && talk->waited_us > patience_us(talk))
        talk->state = talk->busy ? TALK_ANSWERED : TALK_SILENT;
    talk->now_us = now_us;
}

size_t talk_send(struct talk *talk, int64_t now_us, uint8_t *bytes, size_t room)
{
    static const struct message halt = {.type = MESSAGE_KEEPALIVE, .keepalive.time = PREPARE_MS};

    wait_longer(talk, now_us);
    if (!talk->linked)
        return 0;
    size_t used = send_question(talk, now_us, bytes, room);
    if (now_us - talk->kept_us < KEEP_US)
        return used;
    size_t kept = talk_put(&halt, bytes, used, room);
    if (kept > used)
        talk->kept_us = now_us;
    return kept;
}

/* ---- words ----------------------------------------------------------------------------- */

bool talk_judge(const struct talk *talk, struct job *job)
{
    bool other = talk->met && !talk->any && talk->id != job->robot;

    if (talk->state == TALK_SILENT && talk->answers)
        job_failed(job, "does not answer any more");
    else if (talk->state == TALK_SILENT && talk->heard)
        job_failed(job, "its firmware is older and cannot be asked: `muster flash' brings a newer");
    else if (talk->state == TALK_SILENT)
        job_failed(job,
                   "does not answer: is it on, and is its firmware Muster's? `muster flash' finds "
                   "one that waits in its boot loader");
    else if (other && talk->id == 0)
        job_failed(job, "has no id: `muster id' gives it the site's");
    else if (other)
        job_failed(job,
                   "robot %u answers there: mend the site file, or let `muster id --force' make it "
                   "robot %u",
                   talk->id, job->robot);
    return job->state == JOB_WORKING;
}

const char *talk_result_words(uint8_t result)
{
    switch (result) {
    case PARAMETER_DONE: return "done";
    case PARAMETER_UNKNOWN: return "its firmware is older and does not know it";
    case PARAMETER_READ_ONLY: return "it is only to be read";
    case PARAMETER_RANGE: return "its firmware does not allow that value";
    case PARAMETER_BUSY: return "it is on a mission";
    case PARAMETER_BROKEN: return "its EEPROM does not hold what is written to it";
    }
    return "it gives an answer that this muster does not know";
}
