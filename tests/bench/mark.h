/* mark.h: how a benchmark's image speaks to the host.
 *
 * It writes bytes to the chip's debug register; the host (marks.h) sees each of them in the very
 * cycle of the write. A measured call lies between MARK_BEGIN and MARK_END, what it brought out
 * follows. The first call that an image measures is that of an empty function, and the host takes
 * its length off all others: a figure is from a function's first instruction through its RET. The
 * second one is of known length. */
#ifndef MARK_H
#define MARK_H

#define MARK_BEGIN 0xB0
#define MARK_END 0xE0
#define MARK_DONE 0xD0 /* all has been measured */

#define KNOWN_CYCLES 1000

#ifdef __AVR__
#include <avr/io.h>
#include <stddef.h>
#include <stdint.h>

static inline void mark(uint8_t byte)
{
    OCDR = byte;
}

/* Always called, and calls through the pointer: the way to `run` costs the same for all. */
__attribute__((noinline, noclone)) static void measure(void (*run)(void))
{
    mark(MARK_BEGIN);
    run();
    mark(MARK_END);
}

static void nothing(void)
{
}

static void pass_known_time(void)
{
    __builtin_avr_delay_cycles(KNOWN_CYCLES);
}

static inline void calibrate(void)
{
    measure(nothing);
    measure(pass_known_time);
}

static inline void tell(const void *result, size_t size)
{
    const uint8_t *bytes = result;

    while (size-- > 0)
        mark(*bytes++);
}
#endif

#endif
