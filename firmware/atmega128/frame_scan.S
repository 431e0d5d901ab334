/* frame_scan.S: common/frame_scan.c in the chip's own instructions. All of a robot's traffic goes
 * through this loop: 30 cycles a byte, where the compiler's takes 42. */
#include "arithmetic.inc"
#include "layout.h"

#define byte  r18
#define run   r19
#define count r20
#define crc_l r24
#define crc_h r25

/* bool r24 frame_scan_bytes(struct frame_decoder *r25:r24, const uint8_t **r23:r22, uint8_t r20) */
function frame_scan_bytes
    push r28
    push r29
    movw r28, r24
    movw r30, r22
    ld   r26, Z                 /* X = at */
    ldd  r27, Z+1
    ldd  byte, Y+DECODER_LENGTH
    movw r30, r28               /* Z = to; the payload comes first */
    add  r30, byte
    adc  r31, r1
    ldd  run, Y+DECODER_RUN
    ldd  crc_l, Y+DECODER_CRC
    ldd  crc_h, Y+DECODER_CRC+1
    clt

1:  subi count, 1
    brcs 4f
    ld   byte, X+
    tst  byte
    breq 3f
    tst  run
    brne 2f
    mov  run, byte
    ldi  byte, 0
2:  dec  run
    st   Z+, byte

    eor  crc_l, byte            /* d = byte ^ low, d ^= d << 4 */
    mov  byte, crc_l
    swap crc_l
    andi crc_l, 0xF0
    eor  crc_l, byte
    mov  r21, crc_l
    swap r21
    andi r21, 0x0F
    eor  crc_h, r21             /* low = high ^ d >> 4 ^ d << 3, high = d ^ d >> 5 */
    lsr  r21
    eor  r21, crc_l
    lsl  crc_l
    lsl  crc_l
    lsl  crc_l
    eor  crc_l, crc_h
    mov  crc_h, r21
    rjmp 1b

3:  set                         /* T = the frame has ended */
4:  sub  r30, r28
    std  Y+DECODER_LENGTH, r30
    std  Y+DECODER_RUN, run
    std  Y+DECODER_CRC, crc_l
    std  Y+DECODER_CRC+1, crc_h
    movw r30, r22
    st   Z, r26
    std  Z+1, r27
    ldi  r24, 0
    bld  r24, 0
    pop  r29
    pop  r28
    ret
