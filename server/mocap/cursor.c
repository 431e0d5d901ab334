#include "cursor.h"

#include <string.h>

struct cursor cursor_over(const void *bytes, size_t count)
{
    return (struct cursor){.at = bytes, .left = count};
}

bool cursor_good(const struct cursor *cursor)
{
    return !cursor->failed;
}

void cursor_fail(struct cursor *cursor)
{
    cursor->failed = true;
    cursor->left = 0;
}

const uint8_t *cursor_bytes(struct cursor *cursor, size_t count)
{
    const uint8_t *bytes = cursor->at;

    if (cursor->failed || count > cursor->left) {
        cursor_fail(cursor);
        return NULL;
    }
    if (count > 0)
        cursor->at += count;
    cursor->left -= count;
    return bytes;
}

void cursor_skip(struct cursor *cursor, size_t count)
{
    cursor_bytes(cursor, count);
}

bool cursor_holds(struct cursor *cursor, uint64_t count, size_t size)
{
    if (count > cursor->left / size)
        cursor_fail(cursor);
    return !cursor->failed;
}

void cursor_skip_all(struct cursor *cursor, uint64_t count, size_t size)
{
    if (cursor_holds(cursor, count, size))
        cursor_skip(cursor, (size_t)count * size);
}

struct cursor cursor_part(struct cursor *cursor, size_t count)
{
    const uint8_t *bytes = cursor_bytes(cursor, count);

    if (cursor->failed)
        return *cursor;
    return cursor_over(bytes, count);
}

/* People will see it, on a terminal perhaps: a control character becomes a question mark. */
static void keep(char *text, size_t room, const uint8_t *bytes, size_t length)
{
    if (room == 0)
        return;
    if (length > room - 1)
        length = room - 1;
    for (size_t i = 0; i < length; i++)
        text[i] = bytes[i] < ' ' || bytes[i] == 0x7F ? '?' : (char)bytes[i];
    text[length] = '\0';
}

static size_t length_in(const uint8_t *bytes, size_t width)
{
    const uint8_t *end = width > 0 ? memchr(bytes, 0, width) : NULL;

    return end != NULL ? (size_t)(end - bytes) : width;
}

void cursor_string(struct cursor *cursor, char *text, size_t room)
{
    if (length_in(cursor->at, cursor->left) >= room)
        cursor_fail(cursor);
    cursor_string_cut(cursor, text, room);
}

void cursor_string_cut(struct cursor *cursor, char *text, size_t room)
{
    size_t length = length_in(cursor->at, cursor->left);
    const uint8_t *bytes = cursor_bytes(cursor, length + 1);

    keep(text, room, bytes, bytes != NULL ? length : 0);
}

void cursor_text(struct cursor *cursor, size_t width, char *text, size_t room)
{
    const uint8_t *bytes = cursor_bytes(cursor, width);

    keep(text, room, bytes, bytes != NULL ? length_in(bytes, width) : 0);
}

static uint64_t little(struct cursor *cursor, size_t width)
{
    const uint8_t *bytes = cursor_bytes(cursor, width);
    uint64_t value = 0;

    for (size_t i = 0; bytes != NULL && i < width; i++)
        value |= (uint64_t)bytes[i] << 8 * i;
    return value;
}

static uint64_t big(struct cursor *cursor, size_t width)
{
    const uint8_t *bytes = cursor_bytes(cursor, width);
    uint64_t value = 0;

    for (size_t i = 0; bytes != NULL && i < width; i++)
        value = value << 8 | bytes[i];
    return value;
}

static float as_f32(uint64_t value)
{
    uint32_t bits = (uint32_t)value;
    float number;

    memcpy(&number, &bits, sizeof number);
    return number;
}

static double as_f64(uint64_t value)
{
    double number;

    memcpy(&number, &value, sizeof number);
    return number;
}

uint8_t cursor_u8(struct cursor *cursor)
{
    return (uint8_t)little(cursor, 1);
}

uint16_t cursor_u16_le(struct cursor *cursor)
{
    return (uint16_t)little(cursor, 2);
}

uint32_t cursor_u32_le(struct cursor *cursor)
{
    return (uint32_t)little(cursor, 4);
}

uint64_t cursor_u64_le(struct cursor *cursor)
{
    return little(cursor, 8);
}

int16_t cursor_i16_le(struct cursor *cursor)
{
    return (int16_t)little(cursor, 2);
}

int32_t cursor_i32_le(struct cursor *cursor)
{
    return (int32_t)little(cursor, 4);
}

float cursor_f32_le(struct cursor *cursor)
{
    return as_f32(little(cursor, 4));
}

double cursor_f64_le(struct cursor *cursor)
{
    return as_f64(little(cursor, 8));
}

uint16_t cursor_u16_be(struct cursor *cursor)
{
    return (uint16_t)big(cursor, 2);
}

uint32_t cursor_u32_be(struct cursor *cursor)
{
    return (uint32_t)big(cursor, 4);
}

uint64_t cursor_u64_be(struct cursor *cursor)
{
    return big(cursor, 8);
}

int16_t cursor_i16_be(struct cursor *cursor)
{
    return (int16_t)big(cursor, 2);
}

int32_t cursor_i32_be(struct cursor *cursor)
{
    return (int32_t)big(cursor, 4);
}

float cursor_f32_be(struct cursor *cursor)
{
    return as_f32(big(cursor, 4));
}

double cursor_f64_be(struct cursor *cursor)
{
    return as_f64(big(cursor, 8));
}
