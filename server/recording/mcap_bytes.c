#include "mcap_bytes.h"

#include <stdlib.h>
#include <string.h>

#define ROOM_MIN 256

_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "numbers are copied as they are");

void mcap_bytes_free(struct mcap_bytes *bytes)
{
    free(bytes->at);
    *bytes = (struct mcap_bytes){0};
}

static bool grow(struct mcap_bytes *bytes, size_t least)
{
    size_t room = bytes->room < ROOM_MIN ? ROOM_MIN : bytes->room;

    while (room < least)
        room *= 2;
    uint8_t *at = realloc(bytes->at, room);
    if (at == NULL)
        return false;
    bytes->at = at;
    bytes->room = room;
    return true;
}

uint8_t *mcap_reserve(struct mcap_bytes *bytes, size_t count)
{
    size_t least = bytes->count + count;

    if (bytes->failed || (least > bytes->room && !grow(bytes, least))) {
        bytes->failed = true;
        return NULL;
    }
    return bytes->at + bytes->count;
}

void mcap_put(struct mcap_bytes *bytes, const void *from, size_t count)
{
    uint8_t *at = mcap_reserve(bytes, count);

    if (at == NULL || count == 0)
        return;
    memcpy(at, from, count);
    bytes->count += count;
}

void mcap_put_u16(struct mcap_bytes *bytes, uint16_t value)
{
    mcap_put(bytes, &value, sizeof value);
}

void mcap_put_u32(struct mcap_bytes *bytes, uint32_t value)
{
    mcap_put(bytes, &value, sizeof value);
}

void mcap_put_u64(struct mcap_bytes *bytes, uint64_t value)
{
    mcap_put(bytes, &value, sizeof value);
}

void mcap_put_text(struct mcap_bytes *bytes, const char *text)
{
    size_t length = strlen(text);

    mcap_put_u32(bytes, (uint32_t)length);
    mcap_put(bytes, text, length);
}

size_t mcap_begin(struct mcap_bytes *bytes, enum mcap_opcode opcode)
{
    uint8_t byte = (uint8_t)opcode;

    mcap_put(bytes, &byte, 1);
    mcap_put_u64(bytes, 0);
    return bytes->count;
}

void mcap_end(struct mcap_bytes *bytes, size_t begun)
{
    uint64_t length = bytes->count - begun;

    if (!bytes->failed)
        memcpy(bytes->at + begun - sizeof length, &length, sizeof length);
}

size_t mcap_begin_map(struct mcap_bytes *bytes)
{
    mcap_put_u32(bytes, 0);
    return bytes->count;
}

void mcap_end_map(struct mcap_bytes *bytes, size_t begun)
{
    uint32_t length = (uint32_t)(bytes->count - begun);

    if (!bytes->failed)
        memcpy(bytes->at + begun - sizeof length, &length, sizeof length);
}
