/* keeper.h: keeps a robot's parameters: those in force, which MESSAGE_ASK reads and changes, and
 * those in the EEPROM, which PARAMETER_SAVE writes, a byte a tick. */
#ifndef KEEPER_H
#define KEEPER_H

#include "message.h"
#include "parameters.h"

/* A byte for the EEPROM. */
struct store {
    bool wanted;
    uint8_t at, byte;
};

struct keeper {
    struct parameters parameters; /* in force */
    struct parameters_source source;
    bool kept;   /* `record` is in the bank that counts */
    bool asked;  /* `ask` has not been dealt with */
    bool due;    /* `answer` has not been sent; whoever sends it says so here */
    bool saving; /* for `saver`, and `stored` bytes of it are */
    uint8_t stored;
    struct message_ask ask, saver;
    struct message_answer answer;
    uint8_t record[PARAMETERS_RECORD_BYTES];
};

/* What it looks at. */
struct keeper_view {
    uint32_t image; /* and resets: the readings that the board has */
    uint16_t resets;
    uint8_t stored; /* what the EEPROM holds where the last byte was to be stored */
    bool under_way; /* a mission is: the id stays */
};

/* A robot that has just been switched on. */
void keeper_init(struct keeper *keeper, const uint8_t eeprom[PARAMETERS_BYTES]);

/* A later one takes the place of one that has not been dealt with. */
void keeper_hear(struct keeper *keeper, const struct message_ask *ask);

/* Whether keeper_step() has anything to do. */
static inline bool keeper_is_busy(const struct keeper *keeper)
{
    return keeper->asked || keeper->saving;
}

/* Once a tick, while it is busy. True when parameters were changed. */
bool keeper_step(struct keeper *keeper, const struct keeper_view *view, struct store *store);

#endif
