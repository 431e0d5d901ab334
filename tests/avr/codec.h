/* codec.h: what codec.avr.c and its verdict agree on. */
#ifndef CODEC_H
#define CODEC_H

/* The answer to what is no message. */
#define REFUSED 0xBD

#endif
