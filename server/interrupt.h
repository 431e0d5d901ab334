/* interrupt.h: SIGINT and SIGTERM, as a request to end in good order. */
#ifndef INTERRUPT_H
#define INTERRUPT_H

#include <stdbool.h>

/* From now on the first signal sets what is returned; a second one ends the program at once. */
const volatile bool *interrupt_catch(void);

#endif
