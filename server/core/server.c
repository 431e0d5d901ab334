#include "server_state.h"

#include <math.h>
#include <string.h>

/* Where the count-down starts: far from PREPARE_MS, so that robots see the jump
 * (firmware/core/clock.h), and long enough before 0 for the candidates to hear one another and
 * elect. */
#define PREPARE_END_MS (-10000)
#define COUNTDOWN_MS (-500)

#define REPORTS_PER_ROBOT 4

/* ---- memory ---------------------------------------------------------------------------- */

/* Carves arrays out of one block; with no block it only counts. */
struct carver {
    unsigned char *block;
    size_t used;
};

static void *carve(struct carver *carver, size_t count, size_t size)
{
    size_t at = (carver->used + 15) & ~(size_t)15;

    carver->used = at + count * size;
    return carver->block == NULL ? NULL : carver->block + at;
}

static double longest_delay(const struct server_config *config)
{
    double delay = config->delay;

    for (size_t i = 0; i < config->event_count; i++)
        if (config->events[i].action == EVENT_DELAY)
            delay = fmax(delay, config->events[i].value);
    return delay;
}

uint32_t server_ticks_of(double seconds)
{
    return (uint32_t)lround(seconds * TICKS_PER_S);
}

static size_t largest_formation(const struct server_config *config)
{
    size_t largest = config->drawn_vertices;

    for (size_t i = 0; i < config->formation_count; i++)
        if (config->formations[i].count > largest)
            largest = config->formations[i].count;
    return largest;
}

static size_t power_of_two_above(size_t n)
{
    size_t power = 1;

    while (power < n)
        power *= 2;
    return power;
}

static size_t lay_out(struct server *s, const struct server_config *config, void *block)
{
    struct carver carver = {block, 0};
    size_t robots = config->robot_count;
    size_t sides = robots + largest_formation(config) + 1;
    size_t drawn = config->drawn_vertices > 0 ? SERVER_DRAWN_MAX : 0;

    carve(&carver, 1, sizeof *s);
    s->network.station_count = robots;
    s->network.cell_count = power_of_two_above(2 * robots);
    /* Beacons come at 20 Hz at most, and one more for every change of role. */
    s->network.flight_room = robots * (4 + server_ticks_of(longest_delay(config)));
    s->report_room = REPORTS_PER_ROBOT * robots + config->event_count + 1;
    s->order_room = robots + config->event_count;

    s->network.station = carve(&carver, robots, sizeof *s->network.station);
    s->network.cell = carve(&carver, s->network.cell_count, sizeof *s->network.cell);
    s->network.flight = carve(&carver, s->network.flight_room, sizeof *s->network.flight);
    s->member = carve(&carver, robots, sizeof *s->member);
    s->outbox = carve(&carver, robots, sizeof *s->outbox);
    s->event_done = carve(&carver, config->event_count, sizeof *s->event_done);
    s->nodes = carve(&carver, sides, sizeof *s->nodes);
    s->chosen = carve(&carver, sides, sizeof *s->chosen);
    s->followers = carve(&carver, robots, sizeof *s->followers);
    s->vertices = carve(&carver, sides, sizeof *s->vertices);
    s->report = carve(&carver, s->report_room, sizeof *s->report);
    s->order = carve(&carver, s->order_room, sizeof *s->order);
    s->drawn = carve(&carver, drawn, sizeof *s->drawn);
    s->drawn_vertex = carve(&carver, drawn * config->drawn_vertices, sizeof *s->drawn_vertex);
    return carver.used;
}

size_t server_footprint(const struct server_config *config)
{
    struct server layout;

    return lay_out(&layout, config, NULL);
}

struct server *server_init(void *memory, const struct server_config *config)
{
    struct server *s = memory;

    memset(memory, 0, server_footprint(config));
    lay_out(s, config, memory);
    s->config = config;
    s->time = PREPARE_MS;
    s->leader = SERVER_NOBODY;
    s->network.seed = config->seed;
    s->network.range = config->range;
    s->network.loss = config->loss;
    s->network.delay_ticks = server_ticks_of(config->delay);
    for (size_t i = 0; i < config->robot_count; i++) {
        s->network.station[i].id = config->robots[i].id;
        s->member[i].view.role = ROLE_FOLLOWER;
        s->member[i].mission = config->mission.mission - 1;
    }
    server_take_formation(s, config->formation);
    return s;
}

/* ---- reports and orders ---------------------------------------------------------------- */

void server_add_report(struct server *s, enum server_report_kind kind, size_t robot, uint32_t value,
                       uint32_t was)
{
    if (s->report_count == s->report_room)
        return;
    size_t place = (s->report_first + s->report_count++) % s->report_room;
    s->report[place] = (struct server_report){
        .kind = kind,
        .robot = robot == SERVER_NOBODY ? 0 : s->config->robots[robot].id,
        .value = value,
        .was = was,
    };
}

bool server_next_report(struct server *s, struct server_report *next)
{
    if (s->report_count == 0)
        return false;
    *next = s->report[s->report_first];
    s->report_first = (s->report_first + 1) % s->report_room;
    s->report_count--;
    return true;
}

void server_add_order(struct server *s, enum event_action action, size_t robot)
{
    if (s->order_count == s->order_room)
        return;
    size_t place = (s->order_first + s->order_count++) % s->order_room;
    s->order[place] = (struct server_order){action, robot};
}

bool server_next_order(struct server *s, struct server_order *next)
{
    if (s->order_count == 0)
        return false;
    *next = s->order[s->order_first];
    s->order_first = (s->order_first + 1) % s->order_room;
    s->order_count--;
    return true;
}

/* ---- links and time -------------------------------------------------------------------- */

/* Whether a robot takes part: all that is known of it begins anew. */
static void take_part(struct server *s, size_t robot, struct server_view view)
{
    struct member *m = &s->member[robot];
    bool up = view.linked;

    m->view = view;
    m->view.term = m->view.vertex = 0;
    m->view.role = up && s->config->robots[robot].candidate ? ROLE_CANDIDATE : ROLE_FOLLOWER;
    m->known = false;
    m->bad_frames = 0;
    s->network.station[robot].linked = up;
    s->assign_due = true;
    outbox_clear(&s->outbox[robot]);
    downlink_begin(s, robot);
}

void server_link(struct server *s, size_t robot, bool up)
{
    struct member *m = &s->member[robot];

    if (m->wired == up)
        return;
    m->wired = up;
    m->met = false;
    frame_decoder_init(&m->decoder);
    take_part(s, robot,
              (struct server_view){
                  .linked = up && !m->view.halted,
                  .halted = m->view.halted,
              });
}

static void halt(struct server *s, size_t robot, bool halted)
{
    struct server_view view = s->member[robot].view;

    if (view.halted == halted)
        return;
    view.halted = halted;
    view.linked = s->member[robot].wired && !halted && !view.stranger;
    take_part(s, robot, view);
}

void server_halt(struct server *s, size_t robot)
{
    for (size_t i = 0; i < s->config->robot_count; i++)
        if (robot == SERVER_NOBODY || robot == i)
            halt(s, i, true);
}

void server_resume(struct server *s, size_t robot)
{
    halt(s, robot, false);
}

void server_estop(struct server *s)
{
    if (!s->estopped)
        s->estop_tick = s->tick;
    s->estopped = true;
}

void server_meet(struct server *s, size_t robot, uint16_t id)
{
    struct server_view view = s->member[robot].view;
    bool before = view.stranger;

    view.stranger = id != s->config->robots[robot].id;
    view.linked = !view.stranger && !view.halted;
    if (view.stranger && (!before || id != view.id))
        server_add_report(s, REPORT_STRANGER, robot, id, 0);
    view.id = s->member[robot].view.id = id;
    if (view.stranger != before)
        take_part(s, robot, view);
}

void server_begin(struct server *s)
{
    s->begun = true;
}

size_t server_waits_for(const struct server *s)
{
    for (size_t i = 0; i < s->config->robot_count; i++)
        if (s->member[i].view.linked && !upload_done(&s->member[i].upload))
            return i;
    return SERVER_NOBODY;
}

static bool anyone_has_acknowledged(const struct server *s)
{
    for (size_t i = 0; i < s->config->robot_count; i++)
        if (s->member[i].view.linked && upload_done(&s->member[i].upload))
            return true;
    return false;
}

static bool may_start(const struct server *s)
{
    if (s->time <= PREPARE_MS + TICK_MS || !anyone_has_acknowledged(s))
        return false;
    return s->config->waits ? s->begun : server_waits_for(s) == SERVER_NOBODY;
}

static void advance_time(struct server *s)
{
    s->tick++;
    s->time += TICK_MS;
    if (!s->started) {
        if (may_start(s)) {
            s->started = true;
            s->time = COUNTDOWN_MS;
        } else if (s->time >= PREPARE_END_MS) {
            s->time = PREPARE_MS;
        }
    } else if (s->time == 0) {
        server_add_report(s, REPORT_START, SERVER_NOBODY, 0, 0);
    }
    while (s->knot + 1 < s->config->knot_count && s->config->knots[s->knot + 1].time <= s->time)
        s->knot++;
}

static void find_leader(struct server *s)
{
    size_t leader = SERVER_NOBODY;

    for (size_t i = 0; i < s->config->robot_count; i++) {
        const struct server_view *view = &s->member[i].view;

        if (!view->linked || !s->member[i].known || view->role != ROLE_LEADER)
            continue;
        if (leader == SERVER_NOBODY || view->term > s->member[leader].view.term ||
            (view->term == s->member[leader].view.term &&
             s->config->robots[i].id < s->config->robots[leader].id))
            leader = i;
    }
    if (leader != s->leader)
        s->assign_due = true;
    s->leader = leader;
}

void server_see(struct server *s, size_t robot, const struct server_pose *pose)
{
    s->member[robot].pose = *pose;
    s->member[robot].pose_due = pose->tracked;
}

static void place_station(struct station *station, struct server_pose *pose)
{
    pose->age_ms += TICK_MS;
    if (pose->age_ms > SERVER_POSE_OLD_MS) {
        pose->tracked = false;
        pose->age_ms = SERVER_POSE_OLD_MS; /* and no older, so that it never wraps */
    }
    station->x = pose->x;
    station->y = pose->y;
    station->tracked = pose->tracked;
}

void server_tick(struct server *s)
{
    advance_time(s);
    for (size_t i = 0; i < s->config->robot_count; i++)
        place_station(&s->network.station[i], &s->member[i].pose);
    find_leader(s);
    events_run(s);
    host_allocate(s);
    network_deliver(&s->network, s->tick, s->outbox);
    for (size_t i = 0; i < s->config->robot_count; i++)
        if (s->member[i].view.linked)
            downlink_tick(s, i);
}

/* ---- looking in ------------------------------------------------------------------------ */

int32_t server_time(const struct server *s)
{
    return s->time;
}

size_t server_leader(const struct server *s)
{
    return s->leader;
}

uint16_t server_formation(const struct server *s)
{
    return s->formation;
}

struct server_radio server_radio(const struct server *s)
{
    return (struct server_radio){
        .range = s->network.range,
        .loss = s->network.loss,
        .delay = (double)s->network.delay_ticks / TICKS_PER_S,
    };
}

struct server_station server_station(const struct server *s, size_t robot)
{
    const struct station *station = &s->network.station[robot];
    const struct server_pose *pose = &s->member[robot].pose;

    return (struct server_station){
        .muted = station->muted,
        .group = station->group,
        .pose_age = pose->tracked ? fmax(0, pose->age_ms / 1000.0) : (double)NAN,
    };
}

bool server_estopped(const struct server *s)
{
    return s->estopped;
}

const struct server_view *server_look(const struct server *s, size_t robot)
{
    return &s->member[robot].view;
}

struct server_counters server_count(const struct server *s)
{
    struct server_counters counters = {
        .frames = s->received_frames,
        .bytes = s->received_bytes,
        .dropped = s->network.dropped,
        .bad_frames = s->bad_frames,
    };

    for (size_t i = 0; i < s->config->robot_count; i++) {
        counters.frames += s->outbox[i].frames;
        counters.bytes += s->member[i].bytes;
        counters.dropped += s->outbox[i].dropped;
    }
    return counters;
}
