/* start.S: the two ways into the loader (common/flash_map.h), one word each. */
#include <avr/io.h>

.section .vectors, "ax", @progbits
.global loader_entries
loader_entries:
    rjmp by_reset
    rjmp by_program

by_reset:
    ldi  r24, 0
    rjmp begin
by_program:
    ldi  r24, 1
begin:
    cli
    clr  r1
    /* Above the stack lies the mark of a restart (loader.c). */
    ldi  r28, lo8(RAMEND - 2)
    ldi  r29, hi8(RAMEND - 2)
    out  _SFR_IO_ADDR(SPH), r29
    out  _SFR_IO_ADDR(SPL), r28
    rjmp loader
