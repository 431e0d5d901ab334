/* receivers.h: a process that receives as a hundred robots do, and tells when the last one has got
 * its bytes. The same for bare writes and for a broker's. */
#ifndef RECEIVERS_H
#define RECEIVERS_H

#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

#define RECEIVERS 100

/* Deliveries that are kept. */
#define DELIVERIES_MAX 4096

struct receivers {
    pid_t pid;
    int control;  /* closed: it is to end */
    size_t bytes; /* in a delivery */
    struct deliveries *deliveries;
};

/* What a receiver says to whoever it has connected to, and waits to be told. NULL: nothing. */
typedef void receivers_greeting(int fd, size_t receiver);

/* Connects them all to a port of 127.0.0.1; each gets `bytes` in a delivery. */
struct receivers receivers_start(uint16_t port, size_t bytes, receivers_greeting *greet);

/* Ends them when they have got `deliveries` each; one that has not ends this program, with words.
 */
void receivers_stop(struct receivers *receivers, size_t deliveries);

/* When delivery number `i`, from 0, had reached the socket of the last receiver, by the kernel's
 * CLOCK_REALTIME, ns; 0: it was found together with the next one. Until receivers_free(). */
int64_t receivers_when(const struct receivers *receivers, size_t i);
void receivers_free(struct receivers *receivers);

#endif
