#include "setpoints.h"

#include "limits.h"
#include "wire.h"

#include <string.h>

static const uint8_t header[SETPOINTS_HEADER] = {'M', 'S', 'P', 1};

size_t setpoints_bytes(size_t count)
{
    return SETPOINTS_HEADER + count * SETPOINTS_ENTRY;
}

void setpoints_write(const struct setpoint *setpoints, size_t count, uint8_t *bytes)
{
    memcpy(bytes, header, sizeof header);
    bytes += sizeof header;
    for (size_t i = 0; i < count; i++) {
        put_u16(&bytes, setpoints[i].id);
        put_u16(&bytes, (uint16_t)setpoints[i].left);
        put_u16(&bytes, (uint16_t)setpoints[i].right);
    }
}

bool setpoints_count(const uint8_t *bytes, size_t length, size_t *count)
{
    if (length < sizeof header || memcmp(bytes, header, sizeof header) != 0)
        return false;
    *count = (length - sizeof header) / SETPOINTS_ENTRY;
    return (length - sizeof header) % SETPOINTS_ENTRY == 0;
}

static int16_t within_full_scale(uint16_t bits)
{
    int16_t value = (int16_t)bits;

    return value > PWM_STEPS ? PWM_STEPS : value < -PWM_STEPS ? -PWM_STEPS : value;
}

struct setpoint setpoints_read(const uint8_t *bytes, size_t i)
{
    const uint8_t *at = bytes + setpoints_bytes(i);
    struct setpoint setpoint = {.id = take_u16(&at)};

    setpoint.left = within_full_scale(take_u16(&at));
    setpoint.right = within_full_scale(take_u16(&at));
    return setpoint;
}
