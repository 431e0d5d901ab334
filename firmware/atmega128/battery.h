/* battery.h: the battery's voltage. Nothing here waits for the converter. */
#ifndef BATTERY_H
#define BATTERY_H

#include <stdint.h>

/* Starts the first conversion. */
void battery_init(void);

/* Fetches a conversion that is ready and starts the next; to be called once a tick. Returns the
 * voltage in mV, 0 before the first conversion has ended. */
uint16_t battery_poll(void);

#endif
