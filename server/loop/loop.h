/* loop.h: one thread that waits for many descriptors, over epoll. */
#ifndef LOOP_H
#define LOOP_H

#include <stdbool.h>
#include <stdint.h>

#define LOOP_BATCH 64

/* A descriptor and what to do when something happens to it. Part of what its owner remembers. */
struct watch {
    int fd;
    bool urgent; /* before all that is not, also where that is being told of already */
    void (*ready)(struct watch *watch, uint32_t events); /* EPOLLIN, ... */
    bool watched;                                        /* loop.c's */
};

/* What has happened to some descriptors. */
struct loop_set {
    int epoll;
    int count;
    struct watch *batch[LOOP_BATCH];
};

struct loop {
    struct loop_set urgent; /* itself one of the ordinary ones, so that one wait is for both */
    struct loop_set ordinary;
};

/* One that is not open yet: to close it does nothing. */
#define LOOP_CLOSED                                                                                \
    {                                                                                              \
        .urgent.epoll = -1, .ordinary.epoll = -1                                                   \
    }

/* False, with errno, when the system has none. */
bool loop_open(struct loop *loop);
void loop_close(struct loop *loop);

/* Watches, from now on, for these events (EPOLLIN, ...; level-triggered) and for errors. To be
 * called again to change them. False with errno. */
bool loop_watch(struct loop *loop, struct watch *watch, uint32_t events);

/* To be called before the descriptor is closed, from anywhere: what has happened to it and has not
 * been told yet is not told any more. */
void loop_forget(struct loop *loop, struct watch *watch);

/* Waits until something happens, and tells of it. False with errno when waiting failed; a signal is
 * no failure. */
bool loop_wait(struct loop *loop);

/* CLOCK_MONOTONIC in us: goes on evenly whatever is done to the date. */
int64_t loop_now(void);

/* A timer that becomes readable every `period_us`, first after one period. A descriptor, or -1 with
 * errno. Reading it gives the number of periods that have passed since the last time. */
int loop_timer(int64_t period_us);

/* Holds these signals back (0 ends the list), and gives a descriptor that becomes readable when one
 * comes; -1 with errno. For programs of one thread. */
int loop_signals(const int numbers[]);

/* The next of them; 0 when there is none. */
int loop_signal(int signals);

/* Periods passed on a loop_timer() that is ready. */
uint64_t loop_periods(int timer);

#endif
