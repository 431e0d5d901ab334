/* origin.h: whose pages may look. A browser says which page opened a connection (Origin), and under
 * which name it reached us (Host): of other people's pages and names nothing is allowed, for they
 * know the way to this machine's ports as well. */
#ifndef ORIGIN_H
#define ORIGIN_H

#include <stdbool.h>

/* Whether a Host is an address in digits, localhost, or one of two names (NULL: none), with or
 * without a port. A stranger's name that leads here is none of these. */
bool origin_host_is_ours(const char *host, const char *machine, const char *address);

/* Whether a page of this Origin is one that this Host has served. */
bool origin_is_own(const char *origin, const char *host);

/* Whether it is one that shows Foxglove's protocol: of this machine, or a known one. */
bool origin_shows_foxglove(const char *origin);

#endif
