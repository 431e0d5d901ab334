/* avr_image.h: what is inside a struct avr_image (robot.h). */
#ifndef SIM_AVR_IMAGE_H
#define SIM_AVR_IMAGE_H

#include "robot.h"

#include <stdint.h>

struct avr_image {
    uint8_t *flash; /* all of it, as simavr wants it; no core writes there */
    uint32_t f_cpu; /* Hz */
    uint32_t baud;
    uint32_t protocol;        /* PROTOCOL_VERSION of the image */
    uint16_t data_end;        /* where the variables end and the painted stack begins */
    uint16_t tick_cycles_max; /* address of that variable; 0: there is none */
};

#endif
