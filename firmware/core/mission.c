#include "mission.h"

#include <stddef.h>
#include <string.h>

static void begin(struct mission *mission, const struct message_mission *parameters)
{
    memset(mission, 0, sizeof *mission);
    mission->number = parameters->mission;
    mission->expected = 1;
    mission->parameters = *parameters;
}

static void take_vertices(struct mission *mission, const struct message_vertices *part)
{
    if (part->total > VERTICES_MAX) {
        mission->refused = true;
        return;
    }
    if (part->first == 0) {
        mission->formation.number = 0;
        mission->formation.leader = 0;
        mission->arriving = part->formation;
        mission->arrived = 0;
    }
    if (part->formation != mission->arriving || part->first != mission->arrived)
        return;

    for (uint8_t i = 0; i < part->count; i++) {
        if (part->vertex[i].distance == 0)
            mission->formation.leader = mission->arrived + 1;
        mission->formation.vertex[mission->arrived++] =
            formation_place(part->vertex[i], part->scale);
    }
    mission->formation.scale = part->scale;
    mission->formation.total = part->total;
    if (mission->arrived == part->total)
        mission->formation.number = part->formation;
}

static void take_knot(struct mission *mission, const struct knot *knot)
{
    if (mission->knots > 0) {
        int32_t span = knot->time - mission->knot[mission->newest].time;

        if (span <= 0 || span > KNOT_SPACING_MAX_MS) {
            mission->refused = true;
            return;
        }
    }
    mission->newest = (uint8_t)(mission->newest + 1) % KNOTS_MAX;
    mission->knot[mission->newest] = *knot;
    if (mission->knots < KNOTS_MAX)
        mission->knots++;
}

enum mission_change mission_take(struct mission *mission, const struct message *message)
{
    uint8_t sequence = 0;

    switch (message->type) {
    case MESSAGE_MISSION:
        if (message->mission.mission == mission->number)
            return MISSION_TOLD; /* sent again: the acknowledgement was lost */
        begin(mission, &message->mission);
        return MISSION_BEGUN;
    case MESSAGE_VERTICES: sequence = message->vertices.sequence; break;
    case MESSAGE_KNOT: sequence = message->knot.sequence; break;
    case MESSAGE_ASSIGN: sequence = message->assign.sequence; break;
    default: return MISSION_SAME;
    }
    if (mission->number == 0)
        return MISSION_SAME;
    if (sequence != mission->expected)
        return MISSION_TOLD;

    mission->expected++;
    if (message->type == MESSAGE_VERTICES)
        take_vertices(mission, &message->vertices);
    else if (message->type == MESSAGE_KNOT)
        take_knot(mission, &message->knot.knot);
    else
        mission->assigned = message->assign.vertex;
    return MISSION_TOLD;
}

bool mission_reference(const struct mission *mission, int32_t time, struct reference *reference)
{
    const struct knot *later = NULL;

    if (mission->knots == 0)
        return false;
    for (uint8_t back = 0; back < mission->knots; back++) {
        const struct knot *knot = &mission->knot[(uint8_t)(mission->newest - back) % KNOTS_MAX];

        if (knot->time <= time) {
            *reference =
                later != NULL ? reference_between(knot, later, time) : reference_after(knot, time);
            return true;
        }
        later = knot;
    }
    *reference = (struct reference){.pose = later->pose};
    return true;
}
