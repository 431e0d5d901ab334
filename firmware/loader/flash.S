/* flash.S: flash.h. In assembler, for the loader has 2 KiB, and all of a program is checked at every
 * reset: a byte of it takes 29 cycles.
 *
 * In C, with p for what lies in the flash:
 *
 *     flash_crc:    for (crc = 0xFFFFFFFF; count > 0; count--)
 *                       crc = table[(crc ^ p[at++]) & 0xFF] ^ crc >> 8;
 *                   return ~crc;
 */
#include <avr/io.h>

#define FILL  (1 << SPMEN)
#define ERASE ((1 << PGERS) | (1 << SPMEN))
#define WRITE ((1 << PGWRT) | (1 << SPMEN))
#define ALLOW_READING ((1 << RWWSRE) | (1 << SPMEN))
#define READ_FUSES ((1 << BLBSET) | (1 << SPMEN))

.section .text.flash_read, "ax", @progbits
.global flash_read
flash_read:
    movw r26, r24
    movw r30, r20
    out  _SFR_IO_ADDR(RAMPZ), r22
1:  elpm r0, Z+
    st   X+, r0
    subi r18, 1
    sbci r19, 0
    brne 1b
    ret

.section .text.flash_crc, "ax", @progbits
.global flash_crc
flash_crc:
    movw r30, r22
    out  _SFR_IO_ADDR(RAMPZ), r24
    ldi  r22, 0xFF
    mov  r23, r22
    movw r24, r22
1:  wdr
    elpm r0, Z+
    eor  r0, r22
    ldi  r26, 4
    mul  r0, r26
    movw r26, r0
    add  r26, r18
    adc  r27, r19
    ld   r22, X+
    eor  r22, r23
    ld   r23, X+
    eor  r23, r24
    ld   r24, X+
    eor  r24, r25
    ld   r25, X
    subi r20, 1
    sbci r21, 0
    brne 1b
    com  r22
    com  r23
    com  r24
    com  r25
    clr  r1
    ret

.section .text.flash_write, "ax", @progbits
.global flash_write, flash_erase
flash_write:
    movw r26, r20
    rcall flash_erase
    ldi  r20, SPM_PAGESIZE / 2
1:  ld   r0, X+
    ld   r1, X+
    ldi  r18, FILL
    rcall store
    adiw r30, 2
    dec  r20
    brne 1b
    ldi  r18, WRITE
    rjmp store_page

flash_erase:
    ldi  r18, ERASE
    /* What the program began: neither may be under way with the other (data sheet, "EEPROM Write
     * Prevents Writing to SPMCSR"). */
1:  wdr
    sbic _SFR_IO_ADDR(EECR), EEWE
    rjmp 1b

store_page:
    movw r30, r22
    out  _SFR_IO_ADDR(RAMPZ), r24
    rcall store
    ldi  r18, ALLOW_READING
store:
    sts  SPMCSR, r18
    spm
    clr  r1
1:  wdr
    lds  r19, SPMCSR
    sbrc r19, SPMEN
    rjmp 1b
    ret

.section .text.flash_read_fuses, "ax", @progbits
.global flash_read_fuses
flash_read_fuses:
    mov  r30, r24
    clr  r31
    ldi  r24, READ_FUSES
    sts  SPMCSR, r24
    lpm  r24, Z
    ret
