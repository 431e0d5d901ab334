/* fleet.h: virtual robots of one process, in real time. */
#ifndef LIVE_FLEET_H
#define LIVE_FLEET_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct fleet_options {
    const uint16_t *ids;
    size_t count;
    const char *link;     /* endpoint.h */
    const char *firmware; /* the image of ATmega128 robots; NULL: native robots */
    const char *loader;   /* with which they begin; NULL: without one */
    const char *arena;    /* HOST:PORT that the set-points go to (setpoints.h); NULL: nowhere */
    bool blank;           /* robots have no id: `ids` are only for their links */
    bool quiet;           /* only errors on stderr */
};

enum fleet_end {
    FLEET_DONE,
    FLEET_FAILED,  /* a processor crashed, or waiting failed */
    FLEET_REFUSED, /* the options make no sense, or what they ask for cannot be had */
};

/* Opens every robot's link, tells it on stdout, and runs until SIGTERM or SIGINT comes. SIGUSR1
 * switches all robots off and on again. Words in `error` unless it is done. */
enum fleet_end fleet_run(const struct fleet_options *options, char *error, size_t room);

#endif
