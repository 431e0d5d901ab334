/* ticks.h: what tick.avr.c and its verdict agree on. */
#ifndef TICKS_H
#define TICKS_H

#define TICKS 30

#endif
