#include "program.h"

#include "wire.h"

#include <stdio.h>
#include <string.h>

#define FLASH_BYTES 0x20000ul
#define CRC32_POLYNOMIAL 0xEDB88320u /* reflected */

static uint32_t crc32(const uint8_t *bytes, size_t count)
{
    uint32_t crc = UINT32_MAX;

    for (size_t i = 0; i < count; i++) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; bit++)
            crc = crc >> 1 ^ (crc & 1 ? CRC32_POLYNOMIAL : 0);
    }
    return ~crc;
}

static struct seal read_seal(const uint8_t *at)
{
    struct seal seal;

    seal.length = take_u16(&at);
    seal.complement = take_u16(&at);
    seal.crc = (uint32_t)take_i32(&at);
    return seal;
}

static bool is_blank(const uint8_t *flash, size_t from, size_t to)
{
    for (size_t i = from; i < to; i++)
        if (flash[i] != 0xFF)
            return false;
    return true;
}

/* NULL when all is well. */
static const char *judge(const uint8_t *flash, const struct seal *seal)
{
    if (!is_blank(flash, SLOT_BYTES, FLASH_BYTES))
        return "holds more than a program: an update can send no boot loader";
    if (is_blank(flash, SEAL_AT, SLOT_BYTES))
        return "has no seal, without which no robot takes it: `make firmware' makes muster.elf "
               "with "
               "one";
    if ((seal->length ^ seal->complement) != 0xFFFF || seal->length == 0 ||
        seal->length > PROGRAM_BYTES_MAX)
        return "is longer than a robot has room for, or its seal is damaged";
    if (seal->crc != crc32(flash, seal->length) || !is_blank(flash, seal->length, SEAL_AT))
        return "is not what its seal says: damaged, or changed after it was sealed";
    return NULL;
}

bool program_take(struct program *program, const uint8_t *flash, uint32_t baud, char *words,
                  size_t room)
{
    struct seal seal = read_seal(flash + SEAL_AT);
    const char *wrong = judge(flash, &seal);

    if (wrong != NULL) {
        snprintf(words, room, "%s", wrong);
        return false;
    }
    memcpy(program->slot, flash, SLOT_BYTES);
    program->length = seal.length;
    program->crc = seal.crc;
    program->baud = baud;
    return true;
}

static uint16_t code_pages(const struct program *program)
{
    return (uint16_t)((program->length + FLASH_PAGE_BYTES - 1) / FLASH_PAGE_BYTES);
}

uint16_t program_pages(const struct program *program)
{
    return code_pages(program) + 1;
}

uint16_t program_page_at(const struct program *program, uint16_t page)
{
    if (page < code_pages(program))
        return page * FLASH_PAGE_BYTES;
    return SLOT_BYTES - FLASH_PAGE_BYTES;
}
