/* charge.h: how long the battery lasts.
 *
 * One that is below battery_warning for CHARGE_TICKS in a row is told of, until it is
 * CHARGE_HYSTERESIS_MV above; one below battery_critical for as long is spent for good. */
#ifndef CHARGE_H
#define CHARGE_H

#include "limits.h"
#include "parameters.h"

#include <stdbool.h>

#define CHARGE_TICKS TICKS_PER_S
#define CHARGE_HYSTERESIS_MV 200

/* How long a leader whose battery is spent waits for another one, ticks. */
#define CHARGE_HANDOVER_TICKS (3 * TICKS_PER_S)

struct charge {
    uint8_t low, critical; /* ticks in a row below each threshold; stop at CHARGE_TICKS */
    bool warns, spent;
    uint8_t spent_for; /* ticks; stops at CHARGE_HANDOVER_TICKS */
};

/* Once a tick. 0 mV have not been measured yet. */
void charge_watch(struct charge *charge, uint16_t millivolts, const struct parameters *parameters);

#endif
