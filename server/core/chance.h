/* chance.h: what is left to chance, without a stream that draws would share.
 *
 * Every draw has a name, and its outcome is a hash of (seed, kind, name): no draw depends on
 * whether, when or by which thread another one was made. */
#ifndef CHANCE_H
#define CHANCE_H

#include <stdint.h>

enum chance_kind {
    CHANCE_LOSS,   /* is a beacon lost? */
    CHANCE_NOISE,  /* what motion capture adds to a pose */
    CHANCE_JITTER, /* how late a radio link is */
    CHANCE_BODY,   /* in what a robot differs from its design */
};

/* The finaliser of SplitMix64: every bit of the result depends on every bit of the argument. */
uint64_t chance_scramble(uint64_t z);

/* 64 bits, each as likely 0 as 1. */
uint64_t chance_draw(uint64_t seed, enum chance_kind kind, uint64_t name);

/* A draw as a number from 0 up to below 1. */
double chance_unit(uint64_t draw);

#endif
