/* place.h: where a view is to be found. */
#ifndef PLACE_H
#define PLACE_H

#include "view.h"

#define PLACE_HOST_MAX 256

/* A socket that listens there. -1 and words in `error`. */
int place_listen(const struct view_options *options, char *error, size_t room);

/* "127.0.0.1:8765": where a socket listens, as others on this machine reach it. */
void place_name(int listener, char *name, size_t room);

#endif
