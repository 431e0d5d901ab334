#include "slots.h"

#include "flash.h"
#include "flash_map.h"

#define SLOT_START 0ul
#define SEAL_PAGE (SEAL_AT - SEAL_AT % FLASH_PAGE_BYTES)

#define CRC_POLYNOMIAL 0xEDB88320 /* reflected */

/* In RAM, of which there is enough. */
static uint32_t crc_table[256];

static void fill_crc_table(void)
{
    uint8_t byte = 0;

    do {
        uint32_t crc = byte;

        for (uint8_t bit = 0; bit < 8; bit++)
            crc = crc & 1 ? crc >> 1 ^ CRC_POLYNOMIAL : crc >> 1;
        crc_table[byte] = crc;
    } while (++byte != 0);
}

static bool whole(uint32_t start, const struct seal *seal)
{
    uint16_t length = seal->length;

    return length > 0 && length <= PROGRAM_BYTES_MAX && seal->complement == (uint16_t)~length &&
           flash_crc(start, length, crc_table) == seal->crc;
}

static void copy_page(uint16_t at)
{
    uint8_t page[FLASH_PAGE_BYTES];

    stage_read(page, at, sizeof page);
    flash_write(SLOT_START + at, page);
}

/* The seal goes last: until it is there, slot and stage differ, and all is done again. */
static void install(uint16_t length)
{
    for (uint16_t at = 0; at < length; at += FLASH_PAGE_BYTES)
        copy_page(at);
    copy_page(SEAL_PAGE);
}

bool slots_settle(void)
{
    struct seal slot, stage;

    fill_crc_table();
    flash_read(&slot, SLOT_START + SEAL_AT, sizeof slot);
    flash_read(&stage, STAGE_START + SEAL_AT, sizeof stage);

    bool ready = whole(SLOT_START, &slot);
    if ((ready && slot.length == stage.length && slot.crc == stage.crc) ||
        !whole(STAGE_START, &stage))
        return ready;
    install(stage.length);
    return whole(SLOT_START, &stage);
}

void slots_start(void)
{
    ((void (*)(void))SLOT_START)();
    __builtin_unreachable();
}

void stage_break(void)
{
    flash_erase(STAGE_START + SEAL_PAGE);
}

void stage_write(uint16_t at, const uint8_t *page)
{
    flash_write(STAGE_START + at, page);
}

void stage_read(uint8_t *bytes, uint16_t at, uint16_t count)
{
    flash_read(bytes, STAGE_START + at, count);
}
