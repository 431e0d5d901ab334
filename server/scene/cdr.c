#include "cdr.h"

#include <string.h>

_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "numbers are copied as they are");

/* Plain CDR, little-endian, and two bytes of options that nobody uses. */
static const uint8_t head[4] = {0, 1, 0, 0};

struct cdr_writer cdr_begin(uint8_t *bytes, size_t room)
{
    struct cdr_writer cdr = {.bytes = bytes, .room = room, .full = room < sizeof head};

    if (!cdr.full) {
        memcpy(bytes, head, sizeof head);
        cdr.used = sizeof head;
    }
    return cdr;
}

/* `align` is 1, 2, 4 or 8. */
static size_t gap(size_t used, size_t align)
{
    return (sizeof head - used) & (align - 1);
}

void cdr_block(struct cdr_writer *cdr, const void *block, size_t count, size_t align)
{
    if (cdr->full || count == 0)
        return;
    size_t before = gap(cdr->used, align);
    if (before > cdr->room - cdr->used || count > cdr->room - cdr->used - before) {
        cdr->full = true;
        return;
    }
    while (before-- > 0)
        cdr->bytes[cdr->used++] = 0;
    memcpy(cdr->bytes + cdr->used, block, count);
    cdr->used += count;
}

void cdr_u8(struct cdr_writer *cdr, uint8_t value)
{
    cdr_block(cdr, &value, sizeof value, sizeof value);
}

void cdr_u16(struct cdr_writer *cdr, uint16_t value)
{
    cdr_block(cdr, &value, sizeof value, sizeof value);
}

void cdr_u32(struct cdr_writer *cdr, uint32_t value)
{
    cdr_block(cdr, &value, sizeof value, sizeof value);
}

void cdr_i32(struct cdr_writer *cdr, int32_t value)
{
    cdr_block(cdr, &value, sizeof value, sizeof value);
}

void cdr_f64(struct cdr_writer *cdr, double value)
{
    cdr_block(cdr, &value, sizeof value, sizeof value);
}

void cdr_bool(struct cdr_writer *cdr, bool value)
{
    cdr_u8(cdr, value);
}

/* Bytes of the well-formed UTF-8 character at `text`, which ends with a 0; 0: there is none
 * (Unicode's table 3-7). */
static size_t character(const uint8_t *text)
{
    uint8_t first = text[0];
    size_t more = first < 0x80 ? 0 : first < 0xC2 ? 9 : first < 0xE0 ? 1 : first < 0xF0 ? 2 : 3;
    uint8_t least = first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
    uint8_t most = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;

    if (more == 9 || first > 0xF4)
        return 0;
    for (size_t i = 1; i <= more; i++) {
        if (text[i] < least || text[i] > most)
            return 0;
        least = 0x80;
        most = 0xBF;
    }
    return 1 + more;
}

/* Readers of strings stop at what is no UTF-8. */
static void mend(uint8_t *text)
{
    while (*text != '\0') {
        size_t count = character(text);

        if (count == 0)
            *text = '?';
        text += count > 0 ? count : 1;
    }
}

void cdr_string(struct cdr_writer *cdr, const char *text)
{
    size_t count = strlen(text) + 1;

    cdr_u32(cdr, (uint32_t)count);
    cdr_block(cdr, text, count, 1);
    if (!cdr->full)
        mend(cdr->bytes + cdr->used - count);
}

void cdr_time(struct cdr_writer *cdr, int32_t time_ms)
{
    int32_t ms = time_ms % 1000;
    int32_t before = ms < 0; /* the fraction counts upwards also before 0 */

    cdr_i32(cdr, time_ms / 1000 - before);
    cdr_u32(cdr, (uint32_t)(ms + 1000 * before) * 1000000u);
}

size_t cdr_end(const struct cdr_writer *cdr)
{
    return cdr->full ? 0 : cdr->used;
}

struct cdr_reader cdr_open(const uint8_t *bytes, size_t count)
{
    struct cdr_reader cdr = {.bytes = bytes, .count = count};

    cdr.short_of = count < sizeof head || memcmp(bytes, head, 2) != 0;
    cdr.used = cdr.short_of ? 0 : sizeof head;
    return cdr;
}

const uint8_t *cdr_take_block(struct cdr_reader *cdr, size_t count, size_t align)
{
    if (cdr->short_of)
        return NULL;
    size_t before = count > 0 ? gap(cdr->used, align) : 0;
    if (before > cdr->count - cdr->used || count > cdr->count - cdr->used - before) {
        cdr->short_of = true;
        return NULL;
    }
    cdr->used += before + count;
    return cdr->bytes + cdr->used - count;
}

static void take(struct cdr_reader *cdr, void *value, size_t size)
{
    const uint8_t *bytes = cdr_take_block(cdr, size, size);

    if (bytes != NULL)
        memcpy(value, bytes, size);
}

uint8_t cdr_take_u8(struct cdr_reader *cdr)
{
    uint8_t value = 0;

    take(cdr, &value, sizeof value);
    return value;
}

uint16_t cdr_take_u16(struct cdr_reader *cdr)
{
    uint16_t value = 0;

    take(cdr, &value, sizeof value);
    return value;
}

uint32_t cdr_take_u32(struct cdr_reader *cdr)
{
    uint32_t value = 0;

    take(cdr, &value, sizeof value);
    return value;
}

int32_t cdr_take_i32(struct cdr_reader *cdr)
{
    int32_t value = 0;

    take(cdr, &value, sizeof value);
    return value;
}

double cdr_take_f64(struct cdr_reader *cdr)
{
    double value = 0;

    take(cdr, &value, sizeof value);
    return value;
}

bool cdr_take_bool(struct cdr_reader *cdr)
{
    uint8_t value = cdr_take_u8(cdr);

    if (value > 1)
        cdr->short_of = true;
    return value == 1;
}

size_t cdr_take_count(struct cdr_reader *cdr, size_t size)
{
    uint32_t count = cdr_take_u32(cdr);

    if (count > (cdr->count - cdr->used) / size)
        cdr->short_of = true;
    return cdr->short_of ? 0 : count;
}

int32_t cdr_take_time(struct cdr_reader *cdr)
{
    int32_t s = cdr_take_i32(cdr);
    uint32_t ns = cdr_take_u32(cdr);
    int64_t ms = (int64_t)s * 1000 + ns / 1000000;

    if (ns >= 1000000000u || ms < INT32_MIN || ms > INT32_MAX)
        cdr->short_of = true;
    return cdr->short_of ? 0 : (int32_t)ms;
}

void cdr_take_string(struct cdr_reader *cdr, char *text, size_t room)
{
    size_t count = cdr_take_count(cdr, 1);
    const uint8_t *bytes = cdr_take_block(cdr, count, 1);

    text[0] = '\0';
    if (bytes == NULL)
        return;
    if (count == 0 || count > room || memchr(bytes, '\0', count) != bytes + count - 1) {
        cdr->short_of = true;
        return;
    }
    memcpy(text, bytes, count);
}
