#include "fights.h"

#define STEP 88 /* between ranks, in the formation's units */
#define FAR (75 * (int32_t)NARROW_PER_M)
#define NEAR 40 /* the first one */

const struct fight_size fight_sizes[FIGHT_SIZES] = {{4, 3}, {16, 16}, {100, 16}, {100, 99}};
const struct fight_size fight_in_tick = {100, NEIGHBOURS_MAX};

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
    uint32_t drawn = chance(&fight, 1000);

    fight.scale = 2 + drawn % 2;
    fight.now = (uint16_t)(drawn >> 16);
    fight.base.at.x = (int32_t)(chance(&fight, 1001) % 800000) - 400000;
    fight.base.at.y = (int32_t)(chance(&fight, 1002) % 800000) - 400000;
    fight.base.theta = fight.order == FIGHT_TIED ? 0 : (angle_t)chance(&fight, 1003);
    fight.about.x = within(chance(&fight, 1004), 2000);
    fight.about.y = within(chance(&fight, 1005), 2000);
    fight.own.at = place_in_world(&fight, fight.about);
    fight.own.theta = (angle_t)chance(&fight, 1006);
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
    struct sincos towards = sincos_of((angle_t)chance(fight, rank));
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
           (fight->taboo == FIGHT_HALF && chance(fight, 200 + vertex) & 1);
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
        return (struct vec16){claimed.x + within(chance(fight, 400 + index), reach),
                              claimed.y + within(chance(fight, 500 + index), reach)};
    }
}

struct message_beacon fight_beacon(const struct fight *fight, uint8_t index)
{
    uint8_t claimable = fight->size.vertices - 1;
    uint32_t drawn = chance(fight, 300 + index);
    uint8_t rank = fight->claims == FIGHT_NEAREST ? index % claimable
                   : fight->claims == FIGHT_ONE   ? 0
                                                  : drawn % claimable;
    uint16_t age = fight->old ? 900 : drawn >> 8 & 63;
    struct vec16 claimed;
    uint16_t vertex = fight_vertex(fight, rank, &claimed);
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
