/* law_inputs.h: what the motion law is measured with, the same on the chip and on the host. */
#ifndef LAW_INPUTS_H
#define LAW_INPUTS_H

#include "motion.h"

struct law_input {
    struct pose own;
    struct motion_goal goal;
    struct message_mission mission; /* gains and limits */
};

/* Of the inputs 0, 1, ... the first are LAW_NEAR ordinary ones: a goal within 1 m that moves at up
 * to 1 m/s, gains of everyday use; nothing saturates. The others are all that users can have: a
 * goal up to 100 m away, any gain, speeds to the end of their range, u close to zero, on the axes
 * and on the diagonals. */
#define LAW_NEAR 2000
#define LAW_INPUTS 12000

/* The next input. `state` is random.h's and starts at LAW_SEED; `index` counts from 0. */
#define LAW_SEED 1
void law_input(struct law_input *input, uint16_t index, uint32_t *state);

#endif
