/* arithmetic.h: every arithmetic function of multiply.h, fixed.h, formation.h, trajectory.h,
 * motion.h, wheels.h, sweep.h, lookout.h and rival.h over inputs of all sizes, compiled for the
 * chip and for the host. What the results hash to, thousand by thousand, has to be the same on
 * both. */
#ifndef ARITHMETIC_H
#define ARITHMETIC_H

#include "formation.h"
#include "motion.h"
#include "rival.h"
#include "sweep.h"
#include "trajectory.h"
#include "wheels.h"

/* What is tried. PAIR names a function of two numbers and how each is drawn; GROUP the trial below
 * of functions that take more. */
#define ARITHMETIC(PAIR, GROUP)                                                                    \
    PAIR(mul8, draw_bits, draw_bits)                                                               \
    PAIR(mul16, draw16, draw16)                                                                    \
    PAIR(mul16_unsigned, draw16, draw16)                                                           \
    PAIR(mul16_mixed, draw16, draw16)                                                              \
    PAIR(mul16_8_high, draw16, draw_bits)                                                          \
    PAIR(mul24_high, draw24, draw_bits)                                                            \
    PAIR(mul_q15, draw16, draw_narrow)                                                             \
    PAIR(mul_rate, draw16, draw16)                                                                 \
    PAIR(minus16, draw16, draw16)                                                                  \
    PAIR(angle_of_rate, draw_narrow, draw_ms)                                                      \
    PAIR(distance_of_speed, draw_narrow, draw_ms)                                                  \
    GROUP(square16)                                                                                \
    GROUP(limits)                                                                                  \
    GROUP(sums)                                                                                    \
    GROUP(sincos)                                                                                  \
    GROUP(direction)                                                                               \
    GROUP(add_scaled)                                                                              \
    GROUP(saturate)                                                                                \
    GROUP(between)                                                                                 \
    GROUP(sweep)                                                                                   \
    GROUP(rival)                                                                                   \
    GROUP(compare)                                                                                 \
    GROUP(rotate)                                                                                  \
    GROUP(advance)                                                                                 \
    GROUP(scale)                                                                                   \
    GROUP(place)                                                                                   \
    GROUP(offset)                                                                                  \
    GROUP(reference_between)                                                                       \
    GROUP(reference_after)                                                                         \
    GROUP(motion_fl)                                                                               \
    GROUP(motion_kanayama)                                                                         \
    GROUP(motion_pid)                                                                              \
    GROUP(wheels)

/* 100,000 rounds of each, in blocks of which each has a hash; a chip does a portion of blocks. */
#define ROUNDS_PER_BLOCK 1000
#define BLOCKS_PER_PORTION 20
#define PORTIONS 5

/* Where a chip's EEPROM says which function and which portion it does. */
enum { EEPROM_FUNCTION, EEPROM_PORTION };

struct trial {
    uint16_t x, y;      /* of the random inputs */
    uint16_t low, high; /* of the hash of the results */
};

/* As cheap for the chip as can be, and no two results lead to the same hash. */
static inline void keep(struct trial *trial, int32_t result)
{
    uint16_t low = trial->low ^ (uint16_t)result;
    uint16_t high = trial->high ^ (uint16_t)((uint32_t)result >> 16);

    trial->high = low;
    trial->low = high + (uint16_t)(low * 0x9E37u);
}

/* 16 random bits (xorshift of period 2^32 - 1). Two draws never stand in one expression: C leaves
 * their order open. */
static inline uint16_t draw_bits(struct trial *trial)
{
    uint16_t t = trial->x ^ (uint16_t)(trial->x << 5);

    trial->x = trial->y;
    trial->y = (trial->y ^ (trial->y >> 1)) ^ (t ^ (t >> 3));
    return trial->y;
}

/* 0..below - 1. */
static inline uint16_t draw_below(struct trial *trial, uint16_t below)
{
    return (uint16_t)((uint32_t)draw_bits(trial) * below >> 16);
}

/* Any number; the edges come up often. */
static inline int16_t draw16(struct trial *trial)
{
    static const int16_t edges[16] = {0,     1,     -1,     2,     -2,     255,   256,    -256,
                                      16383, 16384, -16384, 32766, -32766, 32767, -32767, -32768};
    uint8_t pick = (uint8_t)draw_bits(trial);

    if (pick < 40)
        return edges[pick & 15];
    return (int16_t)draw_bits(trial) >> (pick & 15);
}

/* No -32,768. */
static inline int16_t draw_narrow(struct trial *trial)
{
    return saturate16(draw16(trial));
}

static inline int16_t draw_positive(struct trial *trial)
{
    return (draw16(trial) & INT16_MAX) | 1;
}

/* Sizes in steps of a byte cost no shifting. */
static inline int32_t draw32(struct trial *trial)
{
    int32_t high = draw16(trial);
    uint16_t low = draw_bits(trial);

    switch (low & 3) {
    case 0: return high;
    case 1: return high * 256 + (low >> 8);
    default: return high * 65536 + low;
    }
}

static inline int32_t draw24(struct trial *trial)
{
    return draw32(trial) >> 8;
}

static inline int16_t draw_ms(struct trial *trial)
{
    return (int16_t)draw_below(trial, 2001) - 1000;
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

/* Where a robot is, and where it should be: mostly near by. */
struct errand {
    struct pose own;
    struct motion_goal goal;
};

static inline struct errand draw_errand(struct trial *trial)
{
    struct errand errand = {.own = draw_pose(trial)};
    struct vec32 error = draw_vec32(trial);

    errand.goal.at = vec_add(errand.own.at, (struct vec32){error.x >> 8, error.y >> 8});
    errand.goal.velocity = draw_vec16(trial);
    errand.goal.acceleration = draw_vec16(trial);
    return errand;
}

/* A mission's gains and limits. */
static inline struct message_mission draw_mission(struct trial *trial)
{
    struct message_mission mission = {.k = (uint16_t)draw16(trial)};

    mission.k_theta = (uint16_t)draw16(trial);
    mission.v_max = draw_positive(trial);
    mission.omega_max = draw_positive(trial);
    mission.track = draw_positive(trial);
    mission.wheel_max = draw_positive(trial);
    return mission;
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

static inline void keep_command(struct trial *trial, struct motion_command command)
{
    keep(trial, command.v);
    keep(trial, command.omega);
}

static inline void try_square16(struct trial *trial)
{
    keep(trial, (int32_t)square16(draw16(trial)));
}

static inline void try_limits(struct trial *trial)
{
    int32_t value = draw32(trial), limit = abs32(draw32(trial) / 2);

    keep(trial, saturate16(value));
    keep(trial, no_minimum((int16_t)value));
    keep(trial, clamp32(value, limit));
    keep(trial, limit);
}

static inline void try_sums(struct trial *trial)
{
    struct vec32 a = draw_vec32(trial), b = draw_vec32(trial);

    a = (struct vec32){a.x >> 1, a.y >> 1};
    b = (struct vec32){b.x >> 1, b.y >> 1};
    keep_vec32(trial, vec_add(a, b));
    keep_vec32(trial, vec_sub(a, b));
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
    keep(trial, direction_of(v));
}

static inline void try_add_scaled(struct trial *trial)
{
    struct vec16 a = draw_vec16(trial);
    uint16_t gain = (uint16_t)draw16(trial);

    keep_vec16(trial, vec_add_scaled(a, gain, draw_vec16(trial)));
}

static inline void try_saturate(struct trial *trial)
{
    struct vec32 v = draw_vec32(trial);

    keep_vec16(trial, vec_saturate(v.x, v.y));
}

/* One whose differences from another are narrow. */
static inline struct vec16 draw_place(struct trial *trial)
{
    struct vec16 v = draw_vec16(trial);

    return (struct vec16){v.x / 2, v.y / 2};
}

static inline void try_between(struct trial *trial)
{
    struct vec16 a = draw_place(trial), b = draw_place(trial);

    keep(trial, (int32_t)vec_square_between(a, b));
    keep_vec16(trial, vec_scale(a, (uint8_t)draw_bits(trial)));
}

static inline void try_sweep(struct trial *trial)
{
    struct vec16 vertex[8];
    uint8_t skip = (uint8_t)draw_bits(trial);
    struct sweep sweep = {.vertex = vertex, .skip = &skip, .at = draw_place(trial), .bytes = 1};

    for (uint8_t i = 0; i < 8; i++)
        vertex[i] = draw_place(trial);
    if (skip & 1)
        sweep.by = (uint8_t)draw_bits(trial);
    sweep_vertices(&sweep);
    keep(trial, sweep.closest);
    keep(trial, (int32_t)sweep.square);
}

static inline void try_rival(struct trial *trial)
{
    uint8_t scale = draw_bits(trial) % 12;
    struct lookout lookout = {.origin = draw_pose(trial).at};
    struct neighbour neighbour = {.id = 1};

    lookout.heading = sincos_of(draw_bits(trial));
    lookout.now = draw_bits(trial);
    lookout.reach = (uint32_t)INT16_MAX << scale;
    lookout.byte = scale >= 8;
    lookout.by = scale % 8 == 0 ? 0 : (uint8_t)(256u >> scale % 8);
    neighbour.time = lookout.now - draw_bits(trial) % 1200;
    neighbour.pose.at.x = lookout.origin.x + draw_narrow(trial) * ((int32_t)1 << scale);
    neighbour.pose.at.y = lookout.origin.y + draw_narrow(trial) * ((int32_t)1 << scale);
    neighbour.drift = draw_vec16(trial);
    struct vec32 offset = vec_sub(neighbour.pose.at, lookout.origin);
    uint32_t length = street_length(offset);
    keep(trial, (int32_t)length);
    if (length <= lookout.reach)
        keep_vec16(trial, lookout_see(&lookout, offset));
    keep(trial, (int32_t)rival_square(&lookout, &neighbour, draw_place(trial)));
}

static inline void try_compare(struct trial *trial)
{
    struct vec32 a = draw_vec32(trial), b = draw_vec32(trial);

    keep(trial, vec_compare(&a, &b));
}

static inline void try_rotate(struct trial *trial)
{
    struct vec16 v = draw_vec16(trial), half = {v.x >> 1, v.y >> 1};
    struct sincos by = sincos_of(draw_bits(trial));

    keep(trial, vec_along(v, by));
    keep_vec16(trial, vec_rotate(half, by));
    keep_vec16(trial, vec_rotate_back(half, by));
}

static inline void try_advance(struct trial *trial)
{
    struct pose pose = draw_pose(trial);
    int16_t speed = draw_narrow(trial), rate = draw_narrow(trial);

    pose_advance(&pose, speed, rate, draw_ms(trial));
    keep_pose(trial, pose);
}

static inline void try_scale(struct trial *trial)
{
    keep(trial, formation_scale(abs32(draw24(trial))));
}

static inline void try_place(struct trial *trial)
{
    int32_t distance = draw24(trial);
    struct polar_vertex vertex = {distance, draw_bits(trial)};

    keep_vec16(trial, formation_place(vertex, (uint8_t)draw_below(trial, FORMATION_SCALE_MAX + 1)));
}

static inline void try_offset(struct trial *trial)
{
    struct vec16 v = draw_vec16(trial), goal = {v.x >> 1, v.y >> 1};
    struct sincos heading = sincos_of(draw_bits(trial));
    uint8_t scale = (uint8_t)draw_below(trial, FORMATION_SCALE_MAX + 1);

    keep_vec32(trial, formation_offset(goal, scale, heading));
}

static inline void try_reference_between(struct trial *trial)
{
    struct knot from = draw_knot(trial, draw_bits(trial));
    int16_t span = (int16_t)(1 + draw_below(trial, KNOT_SPACING_MAX_MS));
    struct knot to = draw_knot(trial, from.time + span);
    int16_t since = (int16_t)draw_below(trial, (uint16_t)span + 1);

    keep_reference(trial, reference_between(&from, &to, from.time + since));
}

static inline void try_reference_after(struct trial *trial)
{
    struct knot at = draw_knot(trial, draw_bits(trial));
    int32_t since = draw_below(trial, 3 * KNOT_SPACING_MAX_MS / 2);

    keep_reference(trial, reference_after(&at, at.time + since));
}

static inline void try_motion_fl(struct trial *trial)
{
    struct message_mission mission = draw_mission(trial);
    struct errand errand = draw_errand(trial);

    keep_command(trial, motion_fl(&mission, &errand.goal, &errand.own));
}

static inline void try_motion_kanayama(struct trial *trial)
{
    struct message_mission mission = draw_mission(trial);
    struct errand errand = draw_errand(trial);

    keep_command(trial, motion_kanayama(&mission, &errand.goal, &errand.own));
}

/* As motion_step() carries it out, for it remembers. */
static inline void try_motion_pid(struct trial *trial)
{
    struct message_mission mission = draw_mission(trial);
    struct errand errand = draw_errand(trial);
    struct vec32 integral = draw_vec32(trial);
    struct motion_memory memory = {{integral.x >> 8, integral.y >> 8}, {draw_narrow(trial), 0}};

    mission.law = LAW_PID;
    keep_command(trial, motion_step(&mission, &memory, &errand.goal, &errand.own));
    keep_vec32(trial, memory.integral);
    keep_command(trial, memory.last);
}

static inline void keep_steps(struct trial *trial, struct wheel_steps steps)
{
    keep(trial, steps.left);
    keep(trial, steps.right);
}

static inline struct parameters draw_parameters(struct trial *trial)
{
    struct parameters parameters = {{0}};
    uint16_t *value = parameters.value;

    value[PARAMETER_LEFT_GAIN] = 8192 + draw_below(trial, 16385);
    value[PARAMETER_RIGHT_GAIN] = 8192 + draw_below(trial, 16385);
    value[PARAMETER_LEFT_DEAD_BAND] = draw_below(trial, 4916);
    value[PARAMETER_RIGHT_DEAD_BAND] = draw_below(trial, 4916);
    if (draw_below(trial, 2) != 0)
        value[PARAMETER_TRACK] = draw_below(trial, 8001);
    value[PARAMETER_MOTOR_LAG] = draw_below(trial, 501);
    return parameters;
}

static inline void try_wheels(struct trial *trial)
{
    struct message_mission mission = draw_mission(trial);
    struct parameters parameters = draw_parameters(trial);
    struct motion_command command = {draw_narrow(trial), 0};
    struct motion_command moving = {draw_narrow(trial), 0};
    struct wheels wheels;

    wheels_set(&wheels, mission.track, mission.wheel_max, &parameters);
    keep(trial, wheels.share);
    command.omega = draw_narrow(trial);
    moving.omega = draw_narrow(trial);
    wheels_follow(&wheels, &moving, &command);
    keep_command(trial, moving);
    keep_steps(trial, wheels_turn(&wheels, &command));
    keep_command(trial, command);
    int16_t left = (int16_t)draw_below(trial, 2 * PWM_STEPS + 1) - PWM_STEPS;
    int16_t right = (int16_t)draw_below(trial, 2 * PWM_STEPS + 1) - PWM_STEPS;
    wheels_set(&wheels, mission.track, PWM_STEPS, &parameters);
    keep_steps(trial, wheels_correct(&wheels, left, right));
}

#define TRY_PAIR(function, draw_a, draw_b)                                                         \
    static inline void try_##function(struct trial *trial)                                         \
    {                                                                                              \
        int32_t a = draw_a(trial), b = draw_b(trial);                                              \
        keep(trial, (int32_t)function(a, b));                                                      \
    }
#define WRITTEN_ABOVE(function)
ARITHMETIC(TRY_PAIR, WRITTEN_ABOVE)

#define ENTRY_OF_PAIR(function, draw_a, draw_b) {#function, try_##function},
#define ENTRY_OF_GROUP(function) {#function, try_##function},
static const struct {
    const char *name;
    void (*try)(struct trial *trial);
} arithmetic[] = {ARITHMETIC(ENTRY_OF_PAIR, ENTRY_OF_GROUP)};

#define ARITHMETIC_FUNCTIONS (sizeof arithmetic / sizeof arithmetic[0])

/* What the results of a block hash to. */
static inline uint32_t arithmetic_hash(uint8_t function, uint8_t block)
{
    struct trial trial = {.x = function + 1u, .y = (block + 1u) * 0x9E37u};

    for (uint16_t i = 0; i < ROUNDS_PER_BLOCK; i++)
        arithmetic[function].try(&trial);
    return trial.low | (uint32_t)trial.high << 16;
}

#endif
