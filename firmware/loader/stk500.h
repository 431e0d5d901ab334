/* stk500.h: as much of Atmel's STK500v2 (application note AVR068) as a programmer needs to bring
 * another program. To it the stage is the whole flash of the chip. */
#ifndef STK500_H
#define STK500_H

#include <stdbool.h>
#include <stdint.h>

#define STK500_FOR_EVER UINT16_MAX

/* Waits `window` ms for a programmer and serves it until it leaves the chip, or has been silent for
 * `silence` ms. False when none came. USART0 is off when it returns. */
bool stk500_serve(uint16_t window, uint16_t silence);

#endif
