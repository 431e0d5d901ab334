/* setpoints.h: what the motors of one process's robots are set to, on its way to the arena.
 *
 * A datagram is the bytes `MSP` and a version, then six bytes a robot: id, left and right, each 16
 * bits with the low byte first. */
#ifndef LIVE_SETPOINTS_H
#define LIVE_SETPOINTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define SETPOINTS_HEADER 4
#define SETPOINTS_ENTRY 6

struct setpoint {
    uint16_t id;
    int16_t left, right; /* PWM steps, +-PWM_STEPS */
};

/* Bytes of a datagram with the set-points of `count` robots. */
size_t setpoints_bytes(size_t count);

/* Into setpoints_bytes(count) bytes. */
void setpoints_write(const struct setpoint *setpoints, size_t count, uint8_t *bytes);

/* Set-points in a datagram. False when it is none. */
bool setpoints_count(const uint8_t *bytes, size_t length, size_t *count);

/* The i-th of them. Values beyond full scale are full scale. */
struct setpoint setpoints_read(const uint8_t *bytes, size_t i);

#endif
