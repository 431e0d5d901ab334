/* param.h: the job that reads and changes a robot's parameters. */
#ifndef PARAM_H
#define PARAM_H

#include "job.h"
#include "parameter_table.h"
#include "talk.h"

/* What is wanted of one robot. In a set of parameters, param_bit() is one. */
struct param_plan {
    bool any;      /* of whoever answers */
    uint64_t read; /* to be read */
    uint64_t set;  /* stored ones, to be set to `value` */
    uint16_t value[PARAMETERS_STORED_COUNT];
    bool reset; /* first of all, all but the id to their defaults */
    bool save;  /* what is in force then; what is set is read back after it */
};

#define PARAM_ROWS (PARAMETERS_STORED_COUNT + PARAMETERS_END - PARAMETERS_READ_FROM)

/* Rows are the table's lines in their order, stored ones first: a row's index on the link, and an
 * index's row. */
uint8_t param_index(size_t row);
size_t param_row(uint8_t index);

static inline uint64_t param_bit(uint8_t index)
{
    return UINT64_C(1) << param_row(index);
}

#define PARAM_STORED ((UINT64_C(1) << PARAMETERS_STORED_COUNT) - 1)
#define PARAM_ALL ((UINT64_C(1) << PARAM_ROWS) - 1)

/* What a robot said of one. An older firmware does not know all of them. */
struct param_reading {
    bool known;
    uint32_t value;
};

struct param_step {
    uint8_t action; /* enum parameter_action */
    uint8_t index;
    bool after; /* a value that is read once all is done */
};

/* Each parameter twice, set once, and the three that concern all. */
#define PARAM_STEPS_MAX (2 * PARAM_ROWS + PARAMETERS_STORED_COUNT + 3)

struct param_job {
    struct job job;
    struct talk talk;
    struct param_plan plan;
    struct param_reading before[PARAM_ROWS]; /* of what is read, set or reset */
    struct param_reading after[PARAM_ROWS];  /* likewise, where anything is changed */
    struct param_step steps[PARAM_STEPS_MAX];
    size_t step_count, step;
    bool met; /* the robot has answered, and is the right one */
};

/* Done without words: what came out is in `after`, or where nothing was to be changed in
 * `before`. */
void param_begin(struct param_job *job, uint16_t robot, const struct param_plan *plan);

#endif
