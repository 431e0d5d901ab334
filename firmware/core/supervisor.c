#include "supervisor.h"

#include "rom.h"

enum { ANY_STATE = 0xFF };

/* From `state`, when the conditions in `mask` are exactly those in `value`, go to `next`. The
 * first rule that fits is taken; where none fits, the state stays. */
/* clang-format off */
static const uint8_t rules[][4] ROM = {
    /* state       mask                            value                          next */
    {ANY_STATE,    ESTOPPED,                       ESTOPPED,                      STATE_ESTOP},
    {ANY_STATE,    SPENT,                          SPENT,                         STATE_SPENT},
    {STATE_BOOT,   HAS_ID,                         HAS_ID,                        STATE_IDLE},
    {STATE_IDLE,   HAS_ID,                         0,                             STATE_BOOT},
    {STATE_IDLE,   HAS_MISSION,                    HAS_MISSION,                   STATE_READY},
    {STATE_IDLE,   DRIVEN | LINK_UP,               DRIVEN | LINK_UP,              STATE_TRIAL},
    {STATE_READY,  HAS_ID,                         0,                             STATE_BOOT},
    {STATE_READY,  HAS_MISSION,                    0,                             STATE_IDLE},
    {STATE_READY,  STARTED | DRIVEN | LINK_UP,     DRIVEN | LINK_UP,              STATE_TRIAL},
    {STATE_READY,  STARTED | POSE_FRESH | LINK_UP, STARTED | POSE_FRESH | LINK_UP, STATE_RUN},
    {STATE_RUN,    HAS_MISSION,                    0,                             STATE_IDLE},
    {STATE_RUN,    STARTED,                        0,                             STATE_READY},
    {STATE_RUN,    POSE_FRESH,                     0,                             STATE_HOLD},
    {STATE_RUN,    LINK_UP,                        0,                             STATE_HOLD},
    {STATE_HOLD,   HAS_MISSION,                    0,                             STATE_IDLE},
    {STATE_HOLD,   STARTED,                        0,                             STATE_READY},
    {STATE_HOLD,   POSE_FRESH | LINK_UP,           POSE_FRESH | LINK_UP,          STATE_RUN},
    {STATE_TRIAL,  HAS_ID,                         0,                             STATE_BOOT},
    {STATE_TRIAL,  HAS_MISSION | STARTED,          HAS_MISSION | STARTED,         STATE_READY},
    {STATE_TRIAL,  DRIVEN,                         0,                             STATE_IDLE},
    {STATE_TRIAL,  LINK_UP,                        0,                             STATE_IDLE},
};
/* clang-format on */

enum { RULE_COUNT = sizeof rules / sizeof rules[0] };

enum supervisor_state supervisor_next(enum supervisor_state state, uint8_t conditions)
{
    if (state == STATE_ESTOP)
        return state;
    for (uint8_t i = 0; i < RULE_COUNT; i++) {
        uint8_t from = rom_u8(&rules[i][0]);

        if (from != ANY_STATE && from != state)
            continue;
        if ((conditions & rom_u8(&rules[i][1])) == rom_u8(&rules[i][2]))
            return (enum supervisor_state)rom_u8(&rules[i][3]);
    }
    return state;
}

static bool left_anchor(const struct stall *stall, const struct pose *pose)
{
    struct vec16 moved =
        vec_saturate(pose->at.x - stall->anchor.at.x, pose->at.y - stall->anchor.at.y);
    int16_t turned = (int16_t)(angle_t)(pose->theta - stall->anchor.theta);
    int32_t square = mul16(moved.x, moved.x) + mul16(moved.y, moved.y);

    return square >= (int32_t)STALL_DISTANCE * STALL_DISTANCE || abs32(turned) >= STALL_TURN;
}

void stall_watch(struct stall *stall, const struct pose *pose, int16_t v)
{
    if (left_anchor(stall, pose)) {
        stall->anchor = *pose;
        stall->ticks = 0;
        stall->raised = false;
    } else if (abs32(v) <= STALL_SPEED) {
        stall->ticks = 0;
    } else if (stall->ticks < STALL_TICKS) {
        stall->ticks++;
    } else {
        stall->raised = true;
    }
}
