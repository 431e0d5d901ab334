/* native.h: the brain on a board made of RAM.
 *
 * It does in one call what the ATmega128's board does in a period: bytes in, the control tick,
 * bytes out, wheel set-points. tests/avr and the fleet tests hold the two together. */
#ifndef NATIVE_H
#define NATIVE_H

#include "brain.h"

#include <stddef.h>

struct native {
    struct brain brain;
    uint8_t *eeprom;  /* PARAMETERS_BYTES, which outlive power */
    uint8_t stored;   /* what is now where a byte was stored last */
    uint16_t battery; /* what the converter has, mV */
};

/* robot->eeprom is there, and stays. */
void native_power_on(struct native *robot);

/* One period: `before` bytes arrive, the control tick, then `after` bytes. */
void native_run(struct native *robot, const uint8_t *bytes, size_t before, size_t after,
                struct brain_output *output);

#endif
