#include "parameters.h"

#include "frame.h"
#include "limits.h"

static uint16_t record_crc(const uint8_t *record)
{
    uint16_t crc = CRC16_INITIAL;

    for (uint8_t i = 0; i < PARAMETERS_BYTES - FRAME_CRC_BYTES; i++)
        crc = crc16_update(crc, record[i]);
    return crc;
}

void parameters_write(uint8_t record[PARAMETERS_BYTES], const struct parameters *parameters)
{
    struct writer out = {record, PARAMETERS_BYTES, true};

    write_u8(&out, PARAMETERS_VERSION);
    write_u16(&out, parameters->id);
    write_u16(&out, record_crc(record));
}

bool parameters_read(struct parameters *parameters, const uint8_t record[PARAMETERS_BYTES])
{
    struct reader in = {record, PARAMETERS_BYTES, true};
    uint8_t version = read_u8(&in);
    uint16_t id = read_u16(&in);
    uint16_t crc = read_u16(&in);
    bool valid =
        version == PARAMETERS_VERSION && crc == record_crc(record) && id != 0 && id <= ROBOT_ID_MAX;

    parameters->id = valid ? id : 0;
    return valid;
}
