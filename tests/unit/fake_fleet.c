#include "fake_fleet.h"

#include <stdlib.h>
#include <string.h>
#include <unity.h>

#define KNOTS 400
#define KNOT_MS 100
#define KEPT 4096

struct server_config fleet_config;
struct server_robot fleet_robots[FLEET_MAX];
struct server_pose fleet_poses[FLEET_MAX];
struct fake_robot fleet[FLEET_MAX];
struct server *server;
size_t fleet_room;
uint64_t fleet_bytes, fleet_frames;

static const struct polar_vertex four[] = {{0, 0}, {8000, 0}, {8000, 16384}, {-8000, 0}};
static const struct polar_vertex three[] = {{4000, 0}, {4000, 49152}, {0, 0}};
static const struct server_formation formations[] = {{4, 0, four}, {3, 0, three}};

static struct knot knots[KNOTS];
static struct server_report reports[KEPT];
static struct server_order orders[KEPT];
static size_t report_count, order_count;

void fleet_reset(size_t robots)
{
    memset(fleet, 0, sizeof fleet);
    report_count = order_count = 0;
    fleet_bytes = fleet_frames = 0;
    fleet_room = FLEET_ROOM;
    server = NULL;
    for (size_t i = 0; i < FLEET_MAX; i++) {
        fleet_robots[i] = (struct server_robot){(uint16_t)(10 * (i + 1)), i < 2};
        fleet_poses[i] = (struct server_pose){.x = (double)i, .tracked = true};
        fleet_reset_robot(i);
    }
    for (int32_t i = 0; i < KNOTS; i++)
        knots[i] = (struct knot){.time = i * KNOT_MS,
                                 .pose = {{i * KNOT_MS * NARROW_PER_M / 1000, 0}, 0},
                                 .v = NARROW_PER_M};
    fleet_config = (struct server_config){
        .robot_count = robots,
        .robots = fleet_robots,
        .formation_count = 2,
        .formations = formations,
        .drawn_vertices = FLEET_MAX,
        .knot_count = KNOTS,
        .knots = knots,
        .mission = {.version = PROTOCOL_VERSION,
                    .mission = 1,
                    .k = GAIN_ONE,
                    .k_theta = 3 * GAIN_ONE,
                    .v_max = NARROW_PER_M,
                    .omega_max = RATE_ONE,
                    .track = 400,
                    .wheel_max = NARROW_PER_M},
        .range = 1,
        .seed = 1,
    };
}

void fleet_free(void)
{
    free(server);
    server = NULL;
}

void fleet_power_on(void)
{
    void *memory = malloc(server_footprint(&fleet_config));

    TEST_ASSERT_NOT_NULL(memory);
    server = server_init(memory, &fleet_config);
    for (size_t i = 0; i < fleet_config.robot_count; i++)
        server_link(server, i, true);
}

void fleet_start(void)
{
    fleet_power_on();
    fleet_until(0);
    TEST_ASSERT_EQUAL_INT32(0, server_time(server));
}

void fleet_reset_robot(size_t robot)
{
    fleet[robot] = (struct fake_robot){.first = 0};
    frame_decoder_init(&fleet[robot].decoder);
}

/* ---- what robots hear ------------------------------------------------------------------ */

static void take_order(size_t robot, const struct message *message)
{
    enum mission_change change = mission_take(&fleet[robot].mission, message);

    fleet[robot].missions += change == MISSION_BEGUN;
    if (change != MISSION_SAME)
        fleet_status(robot);
}

static void hear(size_t robot)
{
    struct fake_robot *r = &fleet[robot];
    struct message message;

    TEST_ASSERT_TRUE(message_read(&message, r->decoder.payload, r->decoder.length));
    if (r->frames++ == 0)
        r->first = message.type;
    fleet_frames++;
    switch (message.type) {
    case MESSAGE_POSE:
        r->poses++;
        r->pose = message.pose;
        break;
    case MESSAGE_KEEPALIVE:
        r->keepalives++;
        r->told = message.keepalive.time;
        break;
    case MESSAGE_ESTOP: r->estops++; break;
    case MESSAGE_BEACON:
        TEST_ASSERT_TRUE(r->beacons < FLEET_MAX);
        r->beacon[r->beacons++] = message.beacon;
        r->length = r->decoder.length;
        memcpy(r->payload, r->decoder.payload, r->length);
        break;
    default:
        if (!r->deaf)
            take_order(robot, &message);
    }
}

void fleet_listen(size_t robot)
{
    struct fake_robot *r = &fleet[robot];
    uint8_t bytes[1024];
    size_t count = server_take(server, robot, bytes, fleet_room);

    TEST_ASSERT_TRUE(count <= fleet_room);
    fleet_bytes += count;
    r->frames = r->poses = r->keepalives = r->estops = r->beacons = 0;
    for (size_t i = 0; i < count; i++) {
        switch (frame_decode(&r->decoder, bytes[i])) {
        case FRAME_READY: hear(robot); break;
        case FRAME_BAD: r->bad++; break;
        case FRAME_PENDING: break;
        }
    }
}

void fleet_see(size_t robot)
{
    struct server_pose pose = fleet_poses[robot];

    pose.age_ms -= TICK_MS;
    server_see(server, robot, &pose);
}

void fleet_tick(void)
{
    struct server_report report;
    struct server_order order;

    for (size_t i = 0; i < fleet_config.robot_count; i++)
        if (!fleet[i].unseen)
            fleet_see(i);
    server_tick(server);
    while (server_next_report(server, &report)) {
        TEST_ASSERT_TRUE(report_count < KEPT);
        reports[report_count++] = report;
    }
    while (server_next_order(server, &order)) {
        TEST_ASSERT_TRUE(order_count < KEPT);
        orders[order_count++] = order;
    }
    for (size_t i = 0; i < fleet_config.robot_count; i++)
        fleet_listen(i);
}

void fleet_ticks(unsigned count)
{
    for (unsigned i = 0; i < count; i++)
        fleet_tick();
}

void fleet_until(int32_t time)
{
    for (unsigned tick = 0; server_time(server) < time; tick++) {
        TEST_ASSERT_TRUE_MESSAGE(tick < 10000, "that time does not come");
        fleet_tick();
    }
}

/* ---- what robots say ------------------------------------------------------------------- */

void fleet_say_payload(size_t robot, const uint8_t *payload, uint8_t length)
{
    uint8_t frame[FRAME_BYTES_MAX];
    uint8_t bytes = frame_encode(frame, payload, length);

    fleet_bytes += bytes;
    fleet_frames++;
    server_receive(server, robot, frame, bytes);
}

void fleet_say(size_t robot, const struct message *message)
{
    uint8_t payload[FRAME_PAYLOAD_MAX];

    fleet_say_payload(robot, payload, message_write(payload, message));
}

void fleet_beacon(size_t robot, enum role role, uint16_t term)
{
    struct message message = {
        .type = MESSAGE_BEACON,
        .beacon = {.id = fleet_robots[robot].id,
                   .role = role,
                   .candidate = fleet_robots[robot].candidate,
                   .term = term},
    };

    fleet_say(robot, &message);
}

void fleet_status(size_t robot)
{
    const struct fake_robot *r = &fleet[robot];
    struct message message = {
        .type = MESSAGE_STATUS,
        .status = {.id = r->says_id != 0 ? r->says_id : fleet_robots[robot].id,
                   .version = PROTOCOL_VERSION,
                   .mission = r->mission.number,
                   .expected = r->mission.expected,
                   .state = r->state,
                   .faults = r->faults,
                   .bad_frames = r->bad_frames},
    };

    fleet_say(robot, &message);
}

/* ---- what came of it ------------------------------------------------------------------- */

unsigned fleet_reported(enum server_report_kind kind, uint16_t id, uint32_t value)
{
    unsigned count = 0;

    for (size_t i = 0; i < report_count; i++)
        count += reports[i].kind == kind && reports[i].robot == id && reports[i].value == value;
    return count;
}

unsigned fleet_ordered(enum event_action action, size_t robot)
{
    unsigned count = 0;

    for (size_t i = 0; i < order_count; i++)
        count += orders[i].action == action && orders[i].robot == robot;
    return count;
}

bool fleet_hears(size_t receiver, size_t sender)
{
    for (unsigned i = 0; i < fleet[receiver].beacons; i++)
        if (fleet[receiver].beacon[i].id == fleet_robots[sender].id)
            return true;
    return false;
}
