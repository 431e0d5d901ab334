/* endpoint_kinds.h: how endpoint.c opens each kind. `rest` is what follows the kind's name and its
 * colon. False with words in `error`; what was opened by then is endpoint_close()'s. */
#ifndef LIVE_ENDPOINT_KINDS_H
#define LIVE_ENDPOINT_KINDS_H

#include "endpoint.h"

bool endpoint_open_pty(struct endpoint *endpoint, const char *rest, char *error, size_t room);
bool endpoint_open_tcp(struct endpoint *endpoint, const char *rest, char *error, size_t room);
bool endpoint_open_rfcomm(struct endpoint *endpoint, const char *rest, char *error, size_t room);

#endif
