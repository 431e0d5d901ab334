#include "clients.h"

static struct client *find(struct clients *clients, const struct sockaddr_in *address)
{
    for (int i = 0; i < clients->count; i++) {
        struct client *client = &clients->client[i];

        if (client->address.sin_addr.s_addr == address->sin_addr.s_addr &&
            client->address.sin_port == address->sin_port)
            return client;
    }
    return NULL;
}

static struct client *place_for_one(struct clients *clients)
{
    struct client *oldest = &clients->client[0];

    if (clients->count < CLIENTS_MAX)
        return &clients->client[clients->count++];
    for (int i = 1; i < CLIENTS_MAX; i++)
        if (clients->client[i].heard_us < oldest->heard_us)
            oldest = &clients->client[i];
    return oldest;
}

bool clients_hear(struct clients *clients, const struct sockaddr_in *address, int64_t now_us)
{
    struct client *known = find(clients, address);
    struct client *client = known != NULL ? known : place_for_one(clients);

    *client = (struct client){*address, now_us};
    return known == NULL;
}

void clients_judge(struct clients *clients, int64_t now_us)
{
    int kept = 0;

    for (int i = 0; i < clients->count; i++)
        if (now_us - clients->client[i].heard_us < CLIENTS_SILENCE_US)
            clients->client[kept++] = clients->client[i];
    clients->count = kept;
}
