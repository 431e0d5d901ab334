/* update.h: a job (job.h): gives a robot another program over its link.
 *
 * Who is there is found out first: the program says so by STATUS, the boot loader by its answer to
 * SIGN_ON. A program is asked which one it is and called away; the loader then takes the new one
 * into its stage, page by page, each read back, and the seal last: from there on it is whole, and
 * installed when the robot starts. Until then the old one is, and runs. At the end the program is
 * asked again.
 *
 * Whatever breaks off on the way is taken up where it was: what is in the stage is kept there by
 * the robot without power, and read back rather than sent by a job that begins. */
#ifndef UPDATE_H
#define UPDATE_H

#include "job.h"
#include "program.h"
#include "stk500.h"
#include "talk.h"

struct update_options {
    bool again; /* also to a robot that has it */
    bool force; /* also to one that says it has another id than the site's */
};

/* So long it may take to the next page while the link is up, whatever lies between; and so long to
 * a link that comes up, or to somebody who resets a robot by hand. */
#define UPDATE_PATIENCE_US 15000000
#define UPDATE_LONG_PATIENCE_US 60000000

#define UPDATE_AIM_UNKNOWN 1 /* no page begins there */

enum update_step {
    UPDATE_LOOK, /* who is there? */
    UPDATE_ASK,  /* the program: which one is it? */
    UPDATE_CALL, /* the program, to leave for the loader */

    /* of the loader: */
    UPDATE_ENTER,
    UPDATE_SIGNATURE,
    UPDATE_COMPARE, /* what is there, with what should be */
    UPDATE_WRITE,
    UPDATE_VERIFY, /* what was written */
    UPDATE_LEAVE,
};

struct update {
    struct job job;
    struct update_options options;
    const struct program *program;
    struct stk500 loader;
    struct talk talk;

    enum update_step step;
    uint8_t signature; /* the byte of it that is asked for */
    uint8_t late;      /* answers in a row that did not come */
    uint8_t writes;    /* of this page */
    uint8_t leaves;    /* times the stage was whole and the loader was left */
    uint16_t page;     /* the next one; those before it are in the stage */
    uint16_t aim;      /* where in the slot the loader stands; UPDATE_AIM_UNKNOWN: anywhere */
    uint32_t heard;    /* statuses of the program that were looked at */
    bool begun;        /* time counts */
    bool met;          /* it has said which program it runs: */
    uint32_t runs;     /* this */
    bool told;         /* that it has failed, and what it has */
    bool staged;       /* the whole update was read back from its stage */
    bool in_loader;    /* it was the loader that spoke last */
    int64_t moved_us;  /* when it went on last, were it not for the time of links that were down */
    int64_t down_us;   /* when the link went down last */
    int64_t due_us;    /* when the next SIGN_ON or MESSAGE_LOADER is due */
    bool calls;        /* it is MESSAGE_LOADER's turn */
    char why[JOB_WORDS_MAX]; /* why the link is down; "" while it is up */
};

/* `program` must outlive the job; `robot` is the id by the site, 0: not known. */
void update_begin(struct update *update, const struct program *program, uint16_t robot,
                  const struct update_options *options);

/* Which program the robot has, as far as it is known, for people: what a job that was interrupted
 * leaves behind. */
void update_standing(const struct update *update, char words[JOB_WORDS_MAX]);

#endif
