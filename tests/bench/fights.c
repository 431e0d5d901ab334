#include "fights.h"

#define STEP 118 /* from rank to rank, in the formation's units */
#define NEAR 40 /* the first one */
#define ABOUT_REACH 2000
#define BASE_REACH (100 * (int32_t)NARROW_PER_M)
#define FAR (75 * (int32_t)NARROW_PER_M)

const struct fight_size fight_sizes[FIGHT_SIZES] = {{4, 3}, {16, 16}, {100, 16}, {100, 99}};
const struct fight_size fight_in_tick = {100, NEIGHBOURS_MAX};

/* Names of draws; those of many are followed by an index. */
enum {
    DRAW_VERTEX = 0,
    DRAW_TABOO = 200,
    DRAW_NEIGHBOUR = 300,
    DRAW_STAND_X = 400,
    DRAW_STAND_Y = 500,
    DRAW_SCALE_AND_TIME = 1000,
    DRAW_BASE_X,
    DRAW_BASE_Y,
    DRAW_BASE_THETA,
    DRAW_ABOUT_X,
    DRAW_ABOUT_Y,
    DRAW_OWN_THETA,
};

/* The draw called `name`: a hash of it and of the fight, so that vertices and neighbours come in
 * any order; of products and bytes, for the chip makes all of them. */
static uint32_t chance(const struct fight *fight, uint16_t name)
{
    uint32_t bits = (fight->seed + name) * 2654435761ul;

    bits ^= bits >> 16;
    bits *= 73244475ul;
    return bits ^ bits >> 16;
}

static int16_t within(uint32_t drawn, int16_t limit)
{
    return (int16_t)(drawn % (2 * (uint16_t)limit + 1u)) - limit;
}

static struct vec32 place_in_world(const struct fight *fight, struct vec16 place)
{
    return vec_add(fight->base.at,
                   formation_offset(place, fight->scale, sincos_of(fight->base.theta)));
}

struct fight fight_begin(struct fight_size size, uint16_t number)
{
    struct fight fight = {
        .size = size,
        .seed = (number * 256ul + size.neighbours) * 2048ul,
        .order = (enum fight_order)(number % 4),
        .claims = (enum fight_claims)(number / 4 % 3),
        .stance = (enum fight_stance)(number / 12 % 4),
        .taboo = (enum fight_taboo)(number / 48 % 3),
        .far = number / 144 % 2,
        .old = number / 288 % 2,
    };
    uint32_t drawn = chance(&fight, DRAW_SCALE_AND_TIME);

    fight.scale = 2 + drawn % 2;
    fight.now = (uint16_t)(drawn >> 16);
    fight.base.at.x = (int32_t)(chance(&fight, DRAW_BASE_X) % (2 * BASE_REACH)) - BASE_REACH;
    fight.base.at.y = (int32_t)(chance(&fight, DRAW_BASE_Y) % (2 * BASE_REACH)) - BASE_REACH;
    fight.base.theta = fight.order == FIGHT_TIED ? 0 : (angle_t)chance(&fight, DRAW_BASE_THETA);
    fight.about.x = within(chance(&fight, DRAW_ABOUT_X), ABOUT_REACH);
    fight.about.y = within(chance(&fight, DRAW_ABOUT_Y), ABOUT_REACH);
    fight.own.at = place_in_world(&fight, fight.about);
    fight.own.theta = (angle_t)chance(&fight, DRAW_OWN_THETA);
    if (fight.far)
        fight.own.at.x += FAR;
    struct vec16 place;
    fight.leader = fight_vertex(&fight, size.vertices - 1, &place);
    return fight;
}

static uint16_t number_of(const struct fight *fight, uint8_t rank)
{
    uint16_t count = fight->size.vertices;

    switch (fight->order) {
    case FIGHT_APPROACHING: return count - rank;
    case FIGHT_RECEDING: return rank + 1u;
    default: return rank * 37u % count + 1u; /* 37 shares no factor with any count */
    }
}

uint16_t fight_vertex(const struct fight *fight, uint8_t rank, struct vec16 *place)
{
    struct sincos towards = sincos_of((angle_t)chance(fight, DRAW_VERTEX + rank));
    int16_t distance = fight->order == FIGHT_TIED ? STEP * 20 : NEAR + STEP * rank;

    *place = (struct vec16){0, 0};
    if (rank < fight->size.vertices - 1) {
        place->x = (int16_t)(fight->about.x + mul_q15(distance, towards.cos));
        place->y = (int16_t)(fight->about.y + mul_q15(distance, towards.sin));
    }
    return number_of(fight, rank);
}

bool fight_is_taboo(const struct fight *fight, uint16_t vertex)
{
    return fight->taboo == FIGHT_FULL ||
           (fight->taboo == FIGHT_HALF && chance(fight, DRAW_TABOO + vertex) & 1);
}

/* Where a neighbour stands when the pass takes place, in the leader's frame. */
static struct vec16 stand(const struct fight *fight, uint8_t index, struct vec16 claimed)
{
    int16_t dx = claimed.x - fight->about.x;
    int16_t dy = claimed.y - fight->about.y;
    int16_t reach = (int16_t)((dx < 0 ? -dx : dx) + (dy < 0 ? -dy : dy));

    switch (fight->stance) {
    case FIGHT_ON_VERTEX: return claimed;
    case FIGHT_BESIDE: return fight->about;
    case FIGHT_BEYOND: return (struct vec16){claimed.x + dx + dx / 8, claimed.y + dy + dy / 8};
    default:
        return (struct vec16){claimed.x + within(chance(fight, DRAW_STAND_X + index), reach),
                              claimed.y + within(chance(fight, DRAW_STAND_Y + index), reach)};
    }
}

/* The rank of the vertex that a neighbour holds: any but the leader's, which is the last. */
static uint8_t claim(const struct fight *fight, uint8_t index, uint32_t drawn)
{
    uint8_t count = fight->size.vertices - 1;

    switch (fight->claims) {
    case FIGHT_NEAREST: return index % count;
    case FIGHT_ONE: return 0;
    default: return drawn % count;
    }
}

struct message_beacon fight_beacon(const struct fight *fight, uint8_t index)
{
    uint32_t drawn = chance(fight, DRAW_NEIGHBOUR + index);
    uint16_t age = fight->old ? 900 : drawn >> 8 & 63;
    struct vec16 claimed;
    uint16_t vertex = fight_vertex(fight, claim(fight, index, drawn), &claimed);
    struct message_beacon beacon = {
        .id = 1u + index,
        .time = fight->now - age,
        .role = ROLE_FOLLOWER,
        .formation = 1,
        .vertex = vertex,
        .v = fight->old ? 4 * NARROW_PER_M : NARROW_PER_M / 2,
        .pose = {place_in_world(fight, stand(fight, index, claimed)), (angle_t)drawn},
    };

    /* Back from where it stands to where it was. */
    pose_advance(&beacon.pose, (int16_t)-beacon.v, 0, (int16_t)age);
    return beacon;
}
