/* stack.h: how deep the stack has been. */
#ifndef STACK_H
#define STACK_H

#include <stdint.h>

/* Bytes between the variables and the stack that were never used. All of them are painted at
 * reset; each call looks at a few more, so the answer lags by up to a second of ticks. */
uint16_t stack_free(void);

#endif
