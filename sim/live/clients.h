/* clients.h: who gets frames by unicast. Pure; a zeroed struct has none. */
#ifndef LIVE_CLIENTS_H
#define LIVE_CLIENTS_H

#include <netinet/in.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define CLIENTS_MAX 8

/* A client that has not asked for frames for so long is gone. */
#define CLIENTS_SILENCE_US 10000000

struct client {
    struct sockaddr_in address;
    int64_t heard_us;
};

struct clients {
    int count;
    struct client client[CLIENTS_MAX];
};

/* A client asks. True when it is new; where there are too many, it takes the place of the one that
 * has asked least recently. */
bool clients_hear(struct clients *clients, const struct sockaddr_in *address, int64_t now_us);

/* Drops those that are gone. */
void clients_judge(struct clients *clients, int64_t now_us);

#endif
