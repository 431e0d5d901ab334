#define _GNU_SOURCE /* strcasestr */

#include "client.h"

#include <arpa/inet.h>
#include <errno.h>
#include <netinet/tcp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/socket.h>
#include <unistd.h>
#include <unity.h>

#define LAST 0x80
#define MASKED 0x80
#define PING 9
#define PIECE 65536

void client_connect(struct client *client, const char *url)
{
    struct sockaddr_in at = {.sin_family = AF_INET, .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    struct timeval patience = {.tv_sec = CLIENT_PATIENCE_S};
    unsigned port;
    int on = 1;

    TEST_ASSERT_EQUAL_INT(1, sscanf(url, "http://127.0.0.1:%u/", &port));
    at.sin_port = htons((uint16_t)port);
    *client = (struct client){.fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)};
    TEST_ASSERT_GREATER_OR_EQUAL_INT(0, client->fd);
    setsockopt(client->fd, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    setsockopt(client->fd, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
    setsockopt(client->fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    TEST_ASSERT_EQUAL_INT(0, connect(client->fd, (struct sockaddr *)&at, sizeof at));
}

void client_close(struct client *client)
{
    if (client->fd > 0)
        close(client->fd);
    free(client->bytes);
    *client = (struct client){.fd = -1};
}

void client_say(struct client *client, const char *bytes, size_t count)
{
    send(client->fd, bytes, count, MSG_NOSIGNAL); /* to one who is gone, at times */
}

static void drop_taken(struct client *client)
{
    if (client->taken > 0)
        memmove(client->bytes, client->bytes + client->taken, client->count - client->taken);
    client->count -= client->taken;
    client->taken = 0;
}

/* False: there is no more. */
static bool receive_more(struct client *client)
{
    if (client->room < client->count + PIECE + 1) {
        client->room = 2 * client->room + PIECE + 1;
        client->bytes = realloc(client->bytes, client->room);
        TEST_ASSERT_NOT_NULL(client->bytes);
    }
    ssize_t count = recv(client->fd, client->bytes + client->count, PIECE, 0);
    TEST_ASSERT_TRUE_MESSAGE(count >= 0 || errno == ECONNRESET, "the view says nothing");
    if (count <= 0)
        return false;
    client->count += (size_t)count;
    client->bytes[client->count] = '\0';
    return true;
}

/* ---- HTTP ------------------------------------------------------------------------------ */

static size_t content_length(const char *head)
{
    const char *line = strcasestr(head, "content-length:");

    return line != NULL ? strtoul(line + strlen("content-length:"), NULL, 10) : 0;
}

static struct client_answer take_answer(struct client *client, bool body)
{
    struct client_answer answer = {0};
    char *end = NULL;

    drop_taken(client);
    while (client->count == 0 || (end = strstr((char *)client->bytes, "\r\n\r\n")) == NULL)
        if (!receive_more(client))
            return answer;
    size_t head = (size_t)(end + 4 - (char *)client->bytes);
    end[2] = '\0';
    size_t count = body ? content_length((char *)client->bytes) : 0;
    while (client->count < head + count)
        if (!receive_more(client))
            return answer;
    client->taken = head + count;
    answer.head = (char *)client->bytes;
    answer.body = answer.head + head;
    answer.count = count;
    TEST_ASSERT_EQUAL_INT(1, sscanf(answer.head, "HTTP/1.%*d %d", &answer.status));
    return answer;
}

struct client_answer client_ask(struct client *client, const char *request)
{
    client_say(client, request, strlen(request));
    return take_answer(client, strncmp(request, "HEAD", 4) != 0);
}

static void add_header(char *request, size_t room, const char *name, const char *value)
{
    size_t length = strlen(request);

    if (value != NULL)
        snprintf(request + length, room - length, "%s: %s\r\n", name, value);
}

int client_upgrade(struct client *client, const char *host, const char *protocol,
                   const char *origin)
{
    char request[2000] = "GET / HTTP/1.1\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
                         "Sec-WebSocket-Version: 13\r\n"
                         "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n";

    add_header(request, sizeof request, "Host", host);
    add_header(request, sizeof request, "Sec-WebSocket-Protocol", protocol);
    add_header(request, sizeof request, "Origin", origin);
    strcat(request, "\r\n");
    client_say(client, request, strlen(request));
    return take_answer(client, false).status;
}

/* ---- frames ---------------------------------------------------------------------------- */

void client_send(struct client *client, enum client_opcode opcode, bool last, const void *bytes,
                 size_t count)
{
    static const uint8_t mask[4] = {0x12, 0x34, 0x56, 0x78};
    uint8_t *frame = malloc(count + 14);
    size_t head = 2;

    TEST_ASSERT_NOT_NULL(frame);
    frame[0] = (uint8_t)(opcode | (last ? LAST : 0));
    frame[1] = (uint8_t)(MASKED | (count < 126 ? count : count <= UINT16_MAX ? 126 : 127));
    for (int bits = count < 126 ? 0 : count <= UINT16_MAX ? 16 : 64; bits > 0; bits -= 8)
        frame[head++] = (uint8_t)((uint64_t)count >> (bits - 8));
    memcpy(frame + head, mask, sizeof mask);
    head += sizeof mask;
    for (size_t i = 0; i < count; i++)
        frame[head + i] = ((const uint8_t *)bytes)[i] ^ mask[i % 4];
    client_say(client, (char *)frame, head + count);
    free(frame);
}

void client_send_text(struct client *client, const char *text)
{
    client_send(client, CLIENT_TEXT, true, text, strlen(text));
}

/* Bytes of a frame's head, and of what follows; 0: more is needed to tell. */
static size_t frame_head(const struct client *client, size_t *count)
{
    size_t wide = client->count < 2                 ? 0
                  : (client->bytes[1] & 127) == 126 ? 2
                  : (client->bytes[1] & 127) == 127 ? 8
                                                    : 0;

    if (client->count < 2 + wide)
        return 0;
    *count = wide == 0 ? client->bytes[1] & 127 : 0;
    for (size_t i = 0; i < wide; i++)
        *count = *count << 8 | client->bytes[2 + i];
    return 2 + wide;
}

struct client_message client_receive(struct client *client)
{
    size_t head, count = 0;

    drop_taken(client);
    while ((head = frame_head(client, &count)) == 0 || client->count < head + count)
        if (!receive_more(client))
            return (struct client_message){.opcode = CLIENT_GONE};
    TEST_ASSERT_TRUE_MESSAGE(client->bytes[0] & LAST, "in pieces");
    enum client_opcode opcode = client->bytes[0] & 15;
    client->taken = head + count;
    if (opcode == PING)
        return client_receive(client);
    return (struct client_message){opcode, client->bytes + head, count};
}
