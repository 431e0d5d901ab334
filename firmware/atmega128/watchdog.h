/* watchdog.h: resets the chip when the main loop has stopped. */
#ifndef WATCHDOG_H
#define WATCHDOG_H

#include <stdint.h>

/* Keeps what caused the last reset. From now on another one follows unless watchdog_kick() comes
 * at least every 250 ms. To be called early: where the fuse WDTON is programmed, the watchdog runs
 * from reset, with 16 ms. */
void watchdog_start(void);

void watchdog_kick(void);

/* No reset comes of it any more, unless the fuse WDTON is programmed. */
void watchdog_stop(void);

/* Resets since the chip was powered, or since the boot loader was at work. */
uint16_t watchdog_resets(void);

/* MCUCSR as it was at reset: PORF 1, EXTRF 2, BORF 4, WDRF 8, JTRF 16. */
uint8_t watchdog_reset_cause(void);

#endif
