#include "brain.h"

#include <stddef.h>
#include <string.h>

/* Beacons (docs/PROTOCOL.md): everyone at 10 Hz; a leader, and a candidate while nobody leads,
 * at 20 Hz; with the long range those two always, the other candidates every second time. */
#define SLOTS 10
#define SLOTS_PER_BEACON 5
#define FAST_SLOT 2

#define STATUS_TICKS 25

/* From here on a new leader's own way to the reference is no longer worth waiting for, wide; and
 * the old one's patience is nearly over, ticks. */
#define APPROACH_NEAR (NARROW_PER_M / 4)
#define APPROACH_TICKS (CHARGE_HANDOVER_TICKS - TICKS_PER_S / 2)

/* The robot whose pose the vertices are placed about, now. */
struct base {
    uint16_t id;
    struct pose pose;
    struct sincos heading;
    int16_t v, omega;
};

/* Robots' beacons and statuses are spread by their ids. */
static void take_slot(struct brain *brain)
{
    int16_t slot = (int16_t)(brain->clock.now / TICK_MS % SLOTS);

    brain->slot = (uint8_t)((slot + SLOTS + brain->id % SLOTS) % SLOTS);
}

static void take_id(struct brain *brain)
{
    brain->id = brain->keeper.parameters.value[PARAMETER_ID];
    brain->status_wait = brain->id % STATUS_TICKS;
    take_slot(brain);
}

void brain_init(struct brain *brain, const uint8_t eeprom[PARAMETERS_BYTES])
{
    memset(brain, 0, sizeof *brain);
    frame_decoder_init(&brain->decoder);
    keeper_init(&brain->keeper, eeprom);
    brain->state = STATE_BOOT;
    brain->link_age = UINT8_MAX;
    brain->pose_age = UINT8_MAX;
    brain->drive_age = UINT8_MAX;
    election_begin(&brain->election, false);
    take_id(brain);
}

static void set_wheels(struct brain *brain)
{
    const struct message_mission *mission = &brain->mission.parameters;

    wheels_set(&brain->wheels, mission->track, mission->wheel_max, &brain->keeper.parameters);
}

static void begin_mission(struct brain *brain)
{
    brain->neighbours.count = 0;
    election_begin(&brain->election, brain->mission.parameters.candidate);
    allocation_begin(&brain->allocation);
    memset(&brain->stall, 0, sizeof brain->stall);
    brain->has_goal = false;
    brain->about = 0;
    memset(&brain->motion, 0, sizeof brain->motion);
    brain->command = brain->moving = (struct motion_command){0, 0};
    set_wheels(brain);
}

static void hear_time(struct brain *brain, int32_t time)
{
    clock_heard(&brain->clock, time + brain->mission.parameters.latency);
}

static void hear_pose(struct brain *brain, const struct message_pose *message)
{
    brain->posed = true;
    brain->pose = message->pose;
    brain->pose_time = message->time;
    brain->pose_age = 0;
    hear_time(brain, message->time);
}

static void hear_beacon(struct brain *brain, const struct message_beacon *beacon)
{
    if (beacon->id == brain->id || brain->mission.number == 0 ||
        clock_age(&brain->clock, beacon->time) > STATE_AGE_MAX_MS)
        return;
    if (beacon->candidate && brain->mission.parameters.candidate)
        clock_heard_beacon(&brain->clock, beacon->time);
    neighbours_hear(&brain->neighbours, beacon, (uint8_t)(brain->tick + 1), &brain->pose.at);
    election_hear(&brain->election, beacon, brain->id, brain->clock.now + TICK_MS);
}

static void hear_drive(struct brain *brain, const struct message_drive *drive)
{
    brain->drive = *drive;
    brain->drive_age = 0;
}

static void hear_order(struct brain *brain, const struct message *message)
{
    enum mission_change change = mission_take(&brain->mission, message);

    if (change == MISSION_BEGUN)
        begin_mission(brain);
    if (change != MISSION_SAME)
        brain->status_due = true;
}

static void count_bad_frame(struct brain *brain)
{
    if (brain->bad_frames < UINT16_MAX)
        brain->bad_frames++;
}

static void hear(struct brain *brain)
{
    struct message message;

    if (!message_read(&message, brain->decoder.payload, brain->decoder.length)) {
        count_bad_frame(brain);
        return;
    }
    brain->link_age = 0;
    switch (message.type) {
    case MESSAGE_POSE: hear_pose(brain, &message.pose); break;
    case MESSAGE_KEEPALIVE: hear_time(brain, message.keepalive.time); break;
    case MESSAGE_BEACON: hear_beacon(brain, &message.beacon); break;
    case MESSAGE_ESTOP: brain->estopped = true; break;
    case MESSAGE_ASK: keeper_hear(&brain->keeper, &message.ask); break;
    case MESSAGE_DRIVE: hear_drive(brain, &message.drive); break;
    case MESSAGE_LOADER: brain->leaves = true; break;
    default: hear_order(brain, &message);
    }
}

/* A programmer such as avrdude knows no MESSAGE_LOADER: it says STK500v2's SIGN_ON,
 *
 *   1B number 00 01 0E 01 sum
 *
 * again and again. What lies between the zeros of two of them is a broken frame, of which the
 * decoder has made this. */
static bool is_programmer(const uint8_t *payload)
{
    uint8_t number = payload[2] ^ 0x1B ^ 0x01 ^ 0x0E ^ 0x01;

    return payload[0] == 0 && payload[1] == 0x01 && payload[3] == 0x1B &&
           (uint8_t)(payload[4] - number) <= 1;
}

void brain_bytes(struct brain *brain, const uint8_t *from, const uint8_t *end)
{
    while (from != end) {
        enum frame_event event = frame_scan(&brain->decoder, &from, end);

        if (event == FRAME_READY)
            hear(brain);
        else if (event == FRAME_BAD && is_programmer(brain->decoder.payload))
            brain->leaves = true;
        else if (event == FRAME_BAD)
            count_bad_frame(brain);
    }
}

static void advance_slot(struct brain *brain, bool jumped)
{
    if (jumped)
        take_slot(brain);
    else if (++brain->slot == SLOTS)
        brain->slot = 0;
}

static void advance_clock(struct brain *brain)
{
    bool jumped = clock_tick(&brain->clock);

    advance_slot(brain, jumped);
    if (jumped) {
        brain->neighbours.count = 0;
        if (brain->election.leader != brain->id)
            brain->election.leader = 0;
    }
}

static uint8_t older(uint8_t *age)
{
    if (*age < UINT8_MAX)
        ++*age;
    return *age;
}

static bool has_started(const struct brain *brain)
{
    return brain->clock.set && brain->clock.now >= 0;
}

static void keep_parameters(struct brain *brain, const struct brain_input *input,
                            struct brain_output *output)
{
    output->store.wanted = false;
    if (!keeper_is_busy(&brain->keeper))
        return;
    struct keeper_view view = {
        .image = input->image,
        .resets = input->resets,
        .stored = input->stored,
        .under_way = brain->mission.number != 0 && has_started(brain),
    };

    if (!keeper_step(&brain->keeper, &view, &output->store))
        return;
    bool other = brain->id != brain->keeper.parameters.value[PARAMETER_ID];
    if (other)
        take_id(brain);
    if (brain->mission.number == 0)
        return;
    if (other)
        begin_mission(brain);
    else
        set_wheels(brain);
}

static void supervise(struct brain *brain)
{
    bool pose_fresh = older(&brain->pose_age) <= POSE_STALE_TICKS;
    bool link_up = older(&brain->link_age) <= LINK_LOST_TICKS;
    bool driven = older(&brain->drive_age) <= DRIVE_TICKS;
    bool mission = brain->mission.number != 0 && !brain->mission.refused;
    bool spent = brain->charge.spent && brain->election.role != ROLE_LEADER;
    uint8_t conditions = (brain->id != 0 ? HAS_ID : 0) | (mission ? HAS_MISSION : 0) |
                         (has_started(brain) ? STARTED : 0) | (pose_fresh ? POSE_FRESH : 0) |
                         (link_up ? LINK_UP : 0) | (brain->estopped ? ESTOPPED : 0) |
                         (driven ? DRIVEN : 0) | (spent ? SPENT : 0);
    uint8_t faults =
        (brain->id == 0 ? FAULT_NO_ID : 0) | (pose_fresh ? 0 : FAULT_POSE_STALE) |
        (link_up ? 0 : FAULT_LINK_LOST) | (brain->stall.raised ? FAULT_STALL : 0) |
        (brain->estopped ? FAULT_ESTOP : 0) | (brain->mission.refused ? FAULT_REFUSED : 0) |
        (brain->charge.spent ? FAULT_BATTERY : 0) | (brain->charge.warns ? WARN_BATTERY : 0);
    uint8_t state = supervisor_next((enum supervisor_state)brain->state, conditions);

    if (brain->state != state || brain->faults != faults)
        brain->status_due = true;
    brain->state = state;
    brain->faults = faults;
}

/* The moment for which everything is computed: when the set-points take effect. */
static int32_t action_time(const struct brain *brain)
{
    return brain->clock.now + ACTUATION_MS;
}

static void own_pose(const struct brain *brain, struct pose *own)
{
    int32_t age = action_time(brain) - brain->pose_time;

    *own = brain->pose;
    pose_advance(own, brain->moving.v, brain->moving.omega,
                 (int16_t)clamp32(age, STATE_AGE_MAX_MS));
}

static bool closest_candidate(const struct brain *brain, const struct pose *own,
                              const struct reference *reference)
{
    struct vec32 mine = vec_sub(own->at, reference->pose.at);

    for (uint8_t i = 0; i < brain->neighbours.count; i++) {
        const struct neighbour *n = &brain->neighbours.entry[i];

        if (!n->candidate || n->fault || (uint8_t)(brain->tick - n->heard) > ELECTION_FRESH_TICKS)
            continue;
        struct vec32 at;
        neighbour_position(n, (uint16_t)action_time(brain), &at);
        at = vec_sub(at, reference->pose.at);
        int8_t order = vec_compare(&at, &mine);
        if (order < 0 || (order == 0 && n->id < brain->id))
            return false;
    }
    return true;
}

/* The last leader followed, where it leads on though it has reported a fault. */
static const struct neighbour *outgoing_leader(const struct brain *brain)
{
    const struct neighbour *last = neighbours_find(&brain->neighbours, brain->about);

    return last != NULL && last->role == ROLE_LEADER && last->fault ? last : NULL;
}

/* Whoever replaces a leader that leads on goes to the reference first: the formation then stays
 * where it is when it changes its leader. */
static bool has_approached(struct brain *brain, const struct pose *own,
                           const struct reference *reference)
{
    struct vec32 near_by = {APPROACH_NEAR, 0};
    struct vec32 way = vec_sub(reference->pose.at, own->at);

    if (outgoing_leader(brain) == NULL || vec_compare(&way, &near_by) < 0 ||
        brain->approach == APPROACH_TICKS)
        return true;
    brain->approach++;
    return false;
}

/* What keeps it from leading. A leader whose battery is spent leads on until another one does, but
 * does not wait for ever. */
static uint8_t hindrances(const struct brain *brain)
{
    uint8_t minor = WARN_BATTERY;

    if (brain->election.role == ROLE_LEADER && brain->charge.spent_for < CHARGE_HANDOVER_TICKS)
        minor |= FAULT_BATTERY;
    return brain->faults & (uint8_t)~minor;
}

/* True when the role changed: others want to know at once. */
static bool elect(struct brain *brain, const struct pose *own)
{
    uint8_t before = brain->election.role;
    bool chosen = false;
    struct reference reference;
    struct election_view view = {
        .own = brain->id,
        .now = brain->clock.now,
        .candidate = brain->mission.number != 0 && brain->mission.parameters.candidate,
    };

    if (view.candidate && brain->election.role != ROLE_FOLLOWER) {
        view.able = hindrances(brain) == 0 && brain->clock.now >= ELECTION_START_MS &&
                    mission_reference(&brain->mission, action_time(brain), &reference);
        chosen = view.able && election_ripe(&brain->election) &&
                 closest_candidate(brain, own, &reference);
        view.closest = chosen && has_approached(brain, own, &reference);
    }
    if (!chosen || view.closest)
        brain->approach = 0;
    election_step(&brain->election, &view);
    return brain->election.role != before;
}

static void base_of(const struct brain *brain, const struct neighbour *neighbour, struct base *base)
{
    neighbour_pose(neighbour, (uint16_t)action_time(brain), &base->pose);
    base->id = neighbour->id;
    base->heading = sincos_of(base->pose.theta);
    base->v = neighbour_speed(neighbour);
    base->omega = neighbour->omega;
}

/* The leader, also one that is to be replaced; while there is none, for a follower the closest
 * candidate it hears (section 3.1), for a candidate the last leader's course, as long as that is
 * remembered. */
static bool find_base(const struct brain *brain, const struct pose *own, struct base *base)
{
    const struct neighbour *chosen = NULL;
    struct vec32 nearest = {0, 0};

    if (brain->election.leader != 0) {
        chosen = neighbours_find(&brain->neighbours, brain->election.leader);
    } else if (brain->mission.parameters.candidate) {
        chosen = neighbours_find(&brain->neighbours, brain->about);
    } else if ((chosen = outgoing_leader(brain)) == NULL) {
        for (uint8_t i = 0; i < brain->neighbours.count; i++) {
            const struct neighbour *n = &brain->neighbours.entry[i];
            struct vec32 offset = vec_sub(n->pose.at, own->at);

            if (n->candidate && !n->fault &&
                (chosen == NULL || vec_compare(&offset, &nearest) < 0)) {
                nearest = offset;
                chosen = n;
            }
        }
    }
    if (chosen == NULL)
        return false;
    base_of(brain, chosen, base);
    return true;
}

/* Holds the place where it stands about the base: what a spare does that found no vertex. */
static void keep_place(struct brain *brain, struct place place)
{
    brain->goal = place.at;
    brain->goal_scale = place.scale;
    brain->has_goal = true;
}

static void compete(struct brain *brain, const struct base *base, const struct pose *own)
{
    struct allocation_view view = {
        .formation = &brain->mission.formation,
        .neighbours = &brain->neighbours,
        .id = brain->id,
        .leader = base->id,
        .literal = brain->mission.parameters.allocation == ALLOCATION_CPA_LITERAL,
        .origin = base->pose.at,
        .heading = base->heading,
        .own = own->at,
        .now = (uint16_t)action_time(brain),
    };
    bool held = brain->allocation.held != 0;

    allocation_pass(&brain->allocation, &view);
    if (brain->allocation.held == 0 && (held || !brain->has_goal))
        keep_place(brain, allocation_place(&view));
}

/* Chooses the vertex to hold and puts the goal there. */
static void allocate(struct brain *brain, const struct base *base, const struct pose *own)
{
    const struct formation *formation = &brain->mission.formation;

    if (formation->number == 0)
        return; /* another one is arriving: the goal stays where it is */
    allocation_under(&brain->allocation,
                     brain->election.leader != 0 ? brain->election.leader
                                                 : brain->allocation.leader,
                     formation->number);
    if (brain->mission.parameters.allocation == ALLOCATION_ASSIGNED)
        brain->allocation.held =
            brain->mission.assigned <= formation->total ? brain->mission.assigned : 0;
    else
        compete(brain, base, own);

    if (brain->allocation.held != 0) {
        brain->goal = formation->vertex[brain->allocation.held - 1];
        brain->goal_scale = formation->scale;
        brain->has_goal = true;
    }
}

/* The goal of a robot that keeps a place about a base that moves at (v, omega): equation 2 and
 * its derivatives, v and omega held. */
static void goal_about(const struct brain *brain, const struct base *base, struct motion_goal *goal)
{
    struct vec32 offset = formation_offset(brain->goal, brain->goal_scale, base->heading);
    struct vec16 unit = vec_rotate(brain->goal, base->heading);
    int32_t scale = (int32_t)1 << brain->goal_scale;
    struct vec32 velocity = {
        mul_q15(base->v, base->heading.cos) - mul_rate(base->omega, unit.y) * scale,
        mul_q15(base->v, base->heading.sin) + mul_rate(base->omega, unit.x) * scale,
    };

    goal->at = vec_add(base->pose.at, offset);
    goal->velocity = vec_saturate(velocity.x, velocity.y);
    goal->acceleration = vec_saturate(-mul_rate(base->omega, goal->velocity.y),
                                      mul_rate(base->omega, goal->velocity.x));
}

/* The leader's own goal: the reference. */
static void goal_on(const struct reference *reference, struct motion_goal *goal)
{
    struct sincos heading = sincos_of(reference->pose.theta);
    int16_t across = saturate16(mul_rate(reference->omega, reference->v));

    goal->at = reference->pose.at;
    goal->velocity.x = mul_q15(reference->v, heading.cos);
    goal->velocity.y = mul_q15(reference->v, heading.sin);
    goal->acceleration = vec_saturate(
        (int32_t)mul_q15(reference->v_dot, heading.cos) - mul_q15(across, heading.sin),
        (int32_t)mul_q15(reference->v_dot, heading.sin) + mul_q15(across, heading.cos));
}

static void drive_to(struct brain *brain, const struct motion_goal *goal, const struct pose *own)
{
    brain->command = motion_step(&brain->mission.parameters, &brain->motion, goal, own);
}

static void drive_on_reference(struct brain *brain, const struct pose *own)
{
    struct reference reference;

    if (brain->state != STATE_RUN ||
        !mission_reference(&brain->mission, action_time(brain), &reference))
        return;
    struct motion_goal goal;
    goal_on(&reference, &goal);
    drive_to(brain, &goal, own);
}

static void lead(struct brain *brain, const struct pose *own)
{
    brain->allocation.held = brain->mission.formation.leader;
    brain->allocation.formation = brain->mission.formation.number;
    drive_on_reference(brain, own);
}

static void approach(struct brain *brain, const struct pose *own)
{
    brain->allocation.held = 0;
    drive_on_reference(brain, own);
}

static void follow(struct brain *brain, const struct pose *own, bool beacon_due)
{
    struct base base;

    if (!find_base(brain, own, &base))
        return;
    brain->about = base.id;
    if (beacon_due || !brain->has_goal || brain->allocation.unfinished)
        allocate(brain, &base, own);
    if (brain->state != STATE_RUN || !brain->has_goal)
        return;
    struct motion_goal goal;
    goal_about(brain, &base, &goal);
    drive_to(brain, &goal, own);
}

static void send(struct brain_output *output, const uint8_t *payload, uint8_t length)
{
    output->length += frame_encode(&output->frames[output->length], payload, length);
}

static void send_beacon(const struct brain *brain, struct brain_output *output)
{
    bool candidate = brain->mission.parameters.candidate;
    bool electing = brain->election.role != ROLE_FOLLOWER;
    uint8_t payload[BEACON_BYTES];
    struct message_beacon beacon = {
        .id = brain->id,
        .time = (uint16_t)brain->pose_time,
        .pose = brain->pose,
        .v = brain->command.v,
        .omega = brain->command.omega,
        .role = brain->election.role,
        .candidate = candidate,
        .fault = (brain->faults & (uint8_t)~WARN_BATTERY) != 0,
        .to_all = electing || (candidate && brain->slot == 0),
        .term = brain->election.term,
        .leader_age = election_leader_age(&brain->election, brain->id, brain->pose_time),
        .vertex = brain->allocation.held,
        .formation = brain->allocation.formation,
    };

    send(output, payload, message_write_beacon(payload, &beacon));
}

static void send_status(struct brain *brain, const struct brain_input *input,
                        struct brain_output *output)
{
    uint8_t payload[STATUS_BYTES];
    struct message_status status = {
        .id = brain->id,
        .version = PROTOCOL_VERSION,
        .mission = brain->mission.number,
        .expected = brain->mission.expected,
        .state = brain->state,
        .faults = brain->faults,
        .reset_cause = input->reset_cause,
        .battery = input->battery,
        .bad_frames = brain->bad_frames,
        .overruns = input->overruns,
        .tick_cycles = input->tick_cycles,
        .stack_free = input->stack_free,
        .vertices_max = VERTICES_MAX,
    };

    brain->status_due = false;
    brain->status_wait = STATUS_TICKS - 1;
    send(output, payload, message_write_status(payload, &status));
}

static void send_answer(struct brain *brain, struct brain_output *output)
{
    uint8_t payload[ANSWER_BYTES];

    brain->keeper.due = false;
    send(output, payload, message_write_answer(payload, &brain->keeper.answer));
}

static bool beacon_due(const struct brain *brain)
{
    uint8_t phase = brain->slot % SLOTS_PER_BEACON;

    return phase == 0 || (brain->election.role != ROLE_FOLLOWER && phase == FAST_SLOT);
}

/* The last MESSAGE_DRIVE. */
static struct wheel_steps try_wheels(const struct brain *brain)
{
    const struct message_drive *drive = &brain->drive;
    struct wheels wheels;

    if (!drive->corrected)
        return (struct wheel_steps){drive->left, drive->right};
    wheels_set(&wheels, 0, PWM_STEPS, &brain->keeper.parameters);
    return wheels_correct(&wheels, drive->left, drive->right);
}

static struct wheel_steps turn_wheels(struct brain *brain)
{
    if (brain->state == STATE_RUN)
        return wheels_turn(&brain->wheels, &brain->command);
    if (brain->state == STATE_TRIAL)
        return try_wheels(brain);
    return (struct wheel_steps){0, 0};
}

/* Whether to leave for the boot loader: never with its wheels turning. */
static bool may_leave(struct brain *brain)
{
    bool asked = brain->leaves;

    brain->leaves = false;
    return asked && brain->state != STATE_RUN && brain->state != STATE_TRIAL;
}

void brain_step(struct brain *brain, const struct brain_input *input, struct brain_output *output)
{
    output->length = 0;
    brain->tick++;
    advance_clock(brain);
    keep_parameters(brain, input, output);
    charge_watch(&brain->charge, input->battery, &brain->keeper.parameters);
    supervise(brain);
    neighbours_expire(&brain->neighbours, brain->tick);

    struct pose own;
    bool ready = brain->id != 0 && brain->mission.number != 0 && brain->posed;
    bool due = false;

    wheels_follow(&brain->wheels, &brain->moving, &brain->command);
    own_pose(brain, &own);
    brain->command = (struct motion_command){0, 0};
    if (ready) {
        bool changed = elect(brain, &own);

        due = beacon_due(brain) || changed;
        if (brain->state == STATE_SPENT)
            brain->allocation.held = 0;
        else if (brain->election.role == ROLE_LEADER)
            lead(brain, &own);
        else if (brain->approach > 0)
            approach(brain, &own);
        else
            follow(brain, &own, due);
    }
    struct wheel_steps steps = turn_wheels(brain);
    output->left = steps.left;
    output->right = steps.right;
    if (ready)
        stall_watch(&brain->stall, &brain->pose, brain->command.v);
    output->leave = may_leave(brain);
    if (due)
        send_beacon(brain, output);
    if (brain->status_wait-- == 0 || brain->status_due)
        send_status(brain, input, output);
    else if (brain->keeper.due)
        send_answer(brain, output);
}
