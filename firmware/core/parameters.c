#include "parameters.h"

#include "frame.h"
#include "rom.h"
#include "wire.h"

#include <string.h>

#define COUNT_MAX ((PARAMETERS_BANK_BYTES - PARAMETERS_HEAD_BYTES - FRAME_CRC_BYTES) / 2)

_Static_assert(PARAMETERS_STORED_COUNT <= COUNT_MAX, "the stored parameters fit into a bank");

struct allowed {
    uint16_t low, high, unless_set;
};

#define ALLOWED(symbol, name, unit, per_unit, low, high, unless_set, what) {low, high, unless_set},
static const struct allowed allowed[] ROM = {PARAMETERS_STORED(ALLOWED)};

void parameters_default(struct parameters *parameters)
{
    for (uint8_t i = 0; i < PARAMETERS_STORED_COUNT; i++)
        parameters->value[i] = rom_u16(&allowed[i].unless_set);
}

bool parameters_allow(uint8_t index, uint32_t value)
{
    return index < PARAMETERS_STORED_COUNT && value >= rom_u16(&allowed[index].low) &&
           value <= rom_u16(&allowed[index].high);
}

static uint16_t crc_of(const uint8_t *bytes, uint8_t count)
{
    uint16_t crc = CRC16_INITIAL;

    while (count-- > 0)
        crc = crc16_update(crc, *bytes++);
    return crc;
}

/* False, and nothing of use in *parameters, when the bank is not whole. */
static bool read_bank(struct parameters *parameters, const uint8_t *bank)
{
    uint8_t count = bank[2];
    const uint8_t *in = bank + PARAMETERS_HEAD_BYTES;

    if (bank[0] != PARAMETERS_FORMAT || count > COUNT_MAX)
        return false;
    const uint8_t *end = in + 2 * count;
    if (take_u16(&end) != crc_of(bank, (uint8_t)(PARAMETERS_HEAD_BYTES + 2 * count)))
        return false;
    parameters_default(parameters);
    for (uint8_t i = 0; i < PARAMETERS_STORED_COUNT && i < count; i++) {
        parameters->value[i] = take_u16(&in);
        if (!parameters_allow(i, parameters->value[i]))
            return false;
    }
    return true;
}

struct parameters_source parameters_read(struct parameters *parameters,
                                         const uint8_t eeprom[PARAMETERS_BYTES])
{
    struct parameters_source source = {.bank = 1};
    struct parameters other;
    const uint8_t *second = eeprom + PARAMETERS_BANK_BYTES;
    bool first_whole = read_bank(parameters, eeprom);
    bool second_whole = read_bank(&other, second);

    source.whole = first_whole + second_whole;
    if (source.whole == 0) {
        parameters_default(parameters);
        return source;
    }
    if (!first_whole || (second_whole && (int8_t)(second[1] - eeprom[1]) > 0)) {
        *parameters = other;
        source.sequence = second[1];
        return source;
    }
    source.bank = 0;
    source.sequence = eeprom[1];
    return source;
}

void parameters_record(const struct parameters *parameters, uint8_t sequence,
                       uint8_t record[PARAMETERS_RECORD_BYTES])
{
    uint8_t *out = record;

    put_u8(&out, PARAMETERS_FORMAT);
    put_u8(&out, sequence);
    put_u8(&out, PARAMETERS_STORED_COUNT);
    for (uint8_t i = 0; i < PARAMETERS_STORED_COUNT; i++)
        put_u16(&out, parameters->value[i]);
    put_u16(&out, crc_of(record, PARAMETERS_RECORD_BYTES - FRAME_CRC_BYTES));
}

void parameters_write(uint8_t eeprom[PARAMETERS_BYTES], const struct parameters *parameters)
{
    memset(eeprom, 0xFF, PARAMETERS_BYTES);
    parameters_record(parameters, 0, eeprom);
}
