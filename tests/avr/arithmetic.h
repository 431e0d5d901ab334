/* arithmetic.h: every function of fixed.h, formation.h and trajectory.h over inputs of all sizes,
 * compiled for the chip and for the host. What the results hash to has to be the same on both. */
#ifndef ARITHMETIC_H
#define ARITHMETIC_H

#include "formation.h"
#include "random.h"
#include "trajectory.h"

#define ARITHMETIC_ROUNDS 2000

struct trial {
    uint32_t state; /* of the random inputs */
    uint32_t hash;  /* of the results */
};

static inline void keep(struct trial *trial, int32_t result)
{
    uint32_t mixed = trial->hash ^ (uint32_t)result;

    trial->hash = (mixed << 8 | mixed >> 24) * 0x9E3779B1;
}

/* Two draws never stand in one expression: C leaves their order open. */

static inline uint16_t draw_bits(struct trial *trial)
{
    return (uint16_t)(random_next(&trial->state) >> 8);
}

/* Any number; the edges come up often. */
static inline int16_t draw16(struct trial *trial)
{
    static const int16_t edges[] = {0,    1,     -1,    2,     255,    256,
                                    -256, 16383, 16384, 32767, -32767, -32768};
    uint8_t pick = draw_bits(trial) % 64;

    if (pick < sizeof edges / sizeof edges[0])
        return edges[pick];
    return (int16_t)draw_bits(trial) >> pick % 15;
}

/* No -32,768. */
static inline int16_t draw_narrow(struct trial *trial)
{
    return saturate16(draw16(trial));
}

static inline int32_t draw32(struct trial *trial)
{
    uint8_t shift = draw_bits(trial) % 31;

    return (int32_t)random_next(&trial->state) >> shift;
}

static inline int16_t draw_ms(struct trial *trial)
{
    return (int16_t)(draw_bits(trial) % 2001) - 1000;
}

static inline struct vec16 draw_vec16(struct trial *trial)
{
    int16_t x = draw_narrow(trial);

    return (struct vec16){x, draw_narrow(trial)};
}

static inline struct vec32 draw_vec32(struct trial *trial)
{
    int32_t x = draw32(trial);

    return (struct vec32){x, draw32(trial)};
}

static inline struct pose draw_pose(struct trial *trial)
{
    struct vec32 at = draw_vec32(trial);

    return (struct pose){{at.x >> 8, at.y >> 8}, draw_bits(trial)};
}

static inline struct knot draw_knot(struct trial *trial, int32_t time)
{
    struct pose pose = draw_pose(trial);
    int16_t v = draw_narrow(trial);

    return (struct knot){time, pose, v, draw_narrow(trial)};
}

static inline void keep_vec16(struct trial *trial, struct vec16 v)
{
    keep(trial, v.x);
    keep(trial, v.y);
}

static inline void keep_vec32(struct trial *trial, struct vec32 v)
{
    keep(trial, v.x);
    keep(trial, v.y);
}

static inline void keep_pose(struct trial *trial, struct pose pose)
{
    keep_vec32(trial, pose.at);
    keep(trial, pose.theta);
}

static inline void keep_reference(struct trial *trial, struct reference r)
{
    keep_pose(trial, r.pose);
    keep(trial, r.v);
    keep(trial, r.omega);
    keep(trial, r.v_dot);
    keep(trial, r.omega_dot);
}

static inline void try_products(struct trial *trial)
{
    int16_t a = draw16(trial), b = draw_narrow(trial);

    keep(trial, mul16(a, b));
    keep(trial, mul_q15(a, b));
}

static inline void try_limits(struct trial *trial)
{
    int32_t value = draw32(trial) / 2, limit = abs32(draw32(trial) / 2);

    keep(trial, saturate16(value));
    keep(trial, clamp32(value, limit));
    keep_vec32(trial, vec_sub((struct vec32){value, limit}, (struct vec32){limit, value}));
}

static inline void try_sincos(struct trial *trial)
{
    struct sincos s = sincos_of((angle_t)draw16(trial));

    keep(trial, s.sin);
    keep(trial, s.cos);
}

static inline void try_direction(struct trial *trial)
{
    struct vec16 v = draw_vec16(trial);
    struct course course = course_of(v, draw_vec16(trial));

    keep(trial, course.angle);
    keep(trial, course.turn);
}

static inline void try_saturate(struct trial *trial)
{
    struct vec32 v = draw_vec32(trial);

    keep_vec16(trial, vec_saturate(v.x, v.y));
}

static inline void try_compare(struct trial *trial)
{
    struct vec32 a = draw_vec32(trial);
    struct vec32 b = draw_vec32(trial);

    keep(trial, vec_compare(&a, &b));
}

static inline void try_rotate(struct trial *trial)
{
    struct vec16 v = draw_vec16(trial);
    struct sincos by = sincos_of(draw_bits(trial));

    keep(trial, vec_along(v, by));
    v = (struct vec16){v.x / 2, v.y / 2};
    keep_vec16(trial, vec_rotate(v, by));
    keep_vec16(trial, vec_rotate_back(v, by));
}

static inline void try_over_time(struct trial *trial)
{
    int16_t value = draw_narrow(trial), ms = draw_ms(trial);

    keep(trial, angle_of_rate(value, ms));
    keep(trial, distance_of_speed(value, ms));
}

static inline void try_advance(struct trial *trial)
{
    struct pose from = draw_pose(trial);
    int16_t speed = draw_narrow(trial), rate = draw_narrow(trial);

    pose_advance(&from, speed, rate, draw_ms(trial));
    keep_pose(trial, from);
}

static inline void try_formation(struct trial *trial)
{
    int32_t distance = draw32(trial) >> 8;
    struct polar_vertex vertex = {distance, draw_bits(trial)};
    uint8_t scale = formation_scale(abs32(vertex.distance));
    struct vec16 at = formation_place(vertex, scale);

    keep(trial, scale);
    keep_vec16(trial, at);
    keep_vec16(trial, formation_place(vertex, scale / 2));
    keep_vec32(trial, formation_offset(at, scale, sincos_of(draw_bits(trial))));
}

static inline void try_reference(struct trial *trial)
{
    struct knot from = draw_knot(trial, draw_bits(trial));
    int16_t span = 1 + draw_bits(trial) % KNOT_SPACING_MAX_MS;
    struct knot to = draw_knot(trial, from.time + span);
    int16_t since = draw_bits(trial) % (span + 1);

    keep_reference(trial, reference_between(&from, &to, from.time + since));
    keep_reference(trial, reference_after(&from, from.time + 2 * since));
}

static void (*const arithmetic[])(struct trial *) = {
    try_products, try_limits,    try_sincos,  try_direction, try_saturate,  try_compare,
    try_rotate,   try_over_time, try_advance, try_formation, try_reference,
};

#define ARITHMETIC_FUNCTIONS (sizeof arithmetic / sizeof arithmetic[0])

/* What the results of one of them hash to. */
static inline uint32_t arithmetic_hash(uint8_t function)
{
    struct trial trial = {.state = 1u + function, .hash = 0};

    for (uint16_t i = 0; i < ARITHMETIC_ROUNDS; i++)
        arithmetic[function](&trial);
    return trial.hash;
}

#endif
