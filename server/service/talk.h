/* talk.h: what jobs share whose robot runs Muster's program: frames both ways, what it says of
 * itself, a question at a time. Pure, as jobs are.
 *
 * For as long as it is called, the robot's link is up and its mission's time below 0: a robot that
 * was on a mission is halted. */
#ifndef TALK_H
#define TALK_H

#include "job.h"
#include "message.h"
#include "parameter_table.h"

/* How often a question is asked again, and for how long it is asked, while the link is up. */
#define TALK_REPEAT_US 250000
#define TALK_PATIENCE_US 2500000
#define TALK_SAVE_PATIENCE_US 5000000

enum talk_state {
    TALK_FREE,     /* no question has been asked */
    TALK_ASKING,   /* one is under way */
    TALK_ANSWERED, /* `answer` is the answer */
    TALK_SILENT,   /* nobody has answered */
};

struct talk {
    bool any; /* whoever answers will do; set by who begins */

    bool linked;
    bool met;    /* it has said which id it has, */
    uint16_t id; /* this; 0: none */

    /* Its newest status, and how many have come. */
    struct message_status status;
    uint32_t statuses;

    /* Whole frames that came, and those that were broken. */
    uint32_t frames, bad_frames;

    enum talk_state state;
    struct message_ask ask;
    struct message_answer answer;
    uint32_t lost;         /* times that any question had to be repeated */
    int64_t round_trip_us; /* of the last question; 0: it was asked more than once */

    /* talk.c's */
    struct frame_decoder decoder;
    bool in_step;      /* a frame has ended since the link came up */
    bool answers;      /* it has ever answered */
    bool heard;        /* something, since the question was asked */
    bool busy;         /* it has no time for the question yet */
    unsigned sent;     /* times that it has been sent */
    int64_t now_us;    /* until when the time has been counted */
    int64_t sent_us;   /* when it was last sent */
    int64_t waited_us; /* for the answer, while the link was up */
    int64_t kept_us;   /* when it was last said that the link is up */
};

/* The first question is the robot's id: it is under way from here on. */
void talk_begin(struct talk *talk);

/* To be called by the job's functions of these names. */
void talk_linked(struct talk *talk, int64_t now_us);
void talk_lost(struct talk *talk);
void talk_received(struct talk *talk, const uint8_t *bytes, size_t count, int64_t now_us);

/* What is due: the question, and ten times a second word that the link is up. Returns how many
 * bytes; a job puts its own behind them. */
size_t talk_send(struct talk *talk, int64_t now_us, uint8_t *bytes, size_t room);

/* Asks; a question that is still under way is given up. `index` and `value` as in message_ask. */
void talk_ask(struct talk *talk, enum parameter_action action, uint8_t index, uint32_t value);

/* Puts a message's frame behind `used` bytes where there is room for it. Returns how many there are
 * then. */
size_t talk_put(const struct message *message, uint8_t *bytes, size_t used, size_t room);

/* False when there is no use in going on: the robot is silent, or another one than job->robot. The
 * job has failed then, in words. */
bool talk_judge(const struct talk *talk, struct job *job);

/* What an answer says that is not PARAMETER_DONE. */
const char *talk_result_words(uint8_t result);

#endif
