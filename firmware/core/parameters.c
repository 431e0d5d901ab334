#include "parameters.h"

#include "frame.h"
#include "limits.h"
#include "wire.h"

static uint16_t record_crc(const uint8_t *record)
{
    uint16_t crc = CRC16_INITIAL;

    for (uint8_t i = 0; i < PARAMETERS_BYTES - FRAME_CRC_BYTES; i++)
        crc = crc16_update(crc, record[i]);
    return crc;
}

void parameters_write(uint8_t record[PARAMETERS_BYTES], const struct parameters *parameters)
{
    uint8_t *out = record;

    put_u8(&out, PARAMETERS_VERSION);
    put_u16(&out, parameters->id);
    put_u16(&out, record_crc(record));
}

bool parameters_read(struct parameters *parameters, const uint8_t record[PARAMETERS_BYTES])
{
    const uint8_t *in = record;
    uint8_t version = take_u8(&in);
    uint16_t id = take_u16(&in);
    uint16_t crc = take_u16(&in);
    bool valid =
        version == PARAMETERS_VERSION && crc == record_crc(record) && id != 0 && id <= ROBOT_ID_MAX;

    parameters->id = valid ? id : 0;
    return valid;
}
