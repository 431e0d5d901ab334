/* Ten megabytes of noise into every port: nothing stalls or grows, robots drive on or stand, and
 * afterwards all is as before. */
#include "stage.h"

#include <arpa/inet.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>
#include <unity.h>

#define SECOND 50
#define NOISE 10000000
#define DATAGRAM 1400
#define DATAGRAMS (NOISE / DATAGRAM)

/* More than buffers that were not used before take. */
#define MEMORY_MORE (8 << 20)

static struct stage stage;
static uint32_t chance;

void setUp(void)
{
    chance = 1;
}

void tearDown(void)
{
    stage_close(&stage);
}

static void fill(uint8_t *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        chance = chance * 1664525 + 1013904223;
        bytes[i] = (uint8_t)(chance >> 24);
    }
}

/* One datagram; every other one begins as one that is understood does. */
static void shout(int fd, uint16_t port, int number)
{
    static const uint8_t setpoints[] = {'M', 'S', 'P', 1};
    static const uint8_t natnet[] = {7, 0, (DATAGRAM - 4) % 256,
                                     (DATAGRAM - 4) / 256}; /* a frame */
    const struct sockaddr_in to = {
        .sin_family = AF_INET,
        .sin_port = htons(port),
        .sin_addr.s_addr = htonl(INADDR_LOOPBACK),
    };
    uint8_t bytes[DATAGRAM];

    fill(bytes, sizeof bytes);
    if (number % 4 == 1)
        memcpy(bytes, setpoints, sizeof setpoints);
    if (number % 4 == 3)
        memcpy(bytes, natnet, sizeof natnet);
    sendto(fd, bytes, sizeof bytes, MSG_DONTWAIT, (const struct sockaddr *)&to, sizeof to);
}

/* In some four seconds of the robots' time. */
static void shout_at(const uint16_t *ports, size_t count)
{
    int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);

    TEST_ASSERT_TRUE(fd >= 0);
    for (int sent = 0; sent < DATAGRAMS;) {
        for (int i = 0; i < DATAGRAMS / (4 * SECOND) + 1; i++, sent++)
            for (size_t k = 0; k < count; k++)
                shout(fd, ports[k], sent);
        stage_ticks(&stage, 1);
    }
    close(fd);
}

static bool is_quiet(struct stage *of, const void *context)
{
    (void)context;
    for (int i = 0; i < STAGE_ROBOTS; i++)
        if (of->robot[i].cable.noise[TO_SERVER] > 0 || of->robot[i].cable.noise[TO_ROBOT] > 0)
            return false;
    return true;
}

static void make_noise(enum cable_way way)
{
    for (unsigned id = 1; id <= STAGE_ROBOTS; id++)
        cable_noise(&stage_robot(&stage, id)->cable, way, NOISE);
}

static void begin(const struct stage_plan *plan)
{
    stage_open(&stage, plan);
    stage_begin(&stage);
    stage_ticks(&stage, SECOND);
    stage_mark(&stage);
}

/* What is still on its way is noise for a while. */
static void the_fleet_drives_again(void)
{
    stage_mark(&stage);
    for (unsigned id = 1; id <= STAGE_ROBOTS; id++)
        stage_drives_for(&stage, id, SECOND);
    stage_mark(&stage);
    stage_ticks(&stage, SECOND);
    for (unsigned id = 1; id <= STAGE_ROBOTS; id++)
        stage_drove_on(&stage, id);
}

static void finish(size_t memory)
{
    TEST_ASSERT_TRUE(process_memory(&stage.server) < memory + MEMORY_MORE);
    process_signal(&stage.server, SIGTERM);
    stage_server_ends(&stage, 0);
    stage_is_complete(&stage, 0.3);
    stage_end(&stage);
}

/* What the server and the arena hear: robots do not notice. */
static void noise_in_the_network_stops_nobody(void)
{
    static const struct stage_plan plan = {.duration = 60, .cable = CABLE_TCP};

    begin(&plan);
    size_t memory = process_memory(&stage.server);
    const uint16_t ports[] = {stage_frames_port(&stage), stage.natnet_port, stage.robots_port};
    shout_at(ports, sizeof ports / sizeof ports[0]);
    for (unsigned id = 1; id <= STAGE_ROBOTS; id++)
        stage_drove_on(&stage, id);
    the_fleet_drives_again();
    finish(memory);
}

static void noise_from_the_robots_is_counted(void)
{
    static const struct stage_plan plan = {.duration = 60, .cable = CABLE_PTY};

    begin(&plan);
    size_t memory = process_memory(&stage.server);
    make_noise(TO_SERVER);
    stage_until(&stage, is_quiet, NULL, "noise is not taken");
    the_fleet_drives_again();
    finish(memory);
    TEST_ASSERT_TRUE(stage_summary(&stage, "\"link\"", "\"crc_errors\"") > 100);
}

/* Its UART is full of it. What comes between is not enough to drive by, or it is: no matter. */
static void robots_bear_noise(const struct stage_plan *plan)
{
    begin(plan);
    size_t memory = process_memory(&stage.server);
    make_noise(TO_ROBOT);
    stage_until(&stage, is_quiet, NULL, "noise is not taken");
    the_fleet_drives_again();
    stage_ticks(&stage, 2 * SECOND); /* they have been far apart */
    finish(memory);
    TEST_ASSERT_TRUE(stage_logged(&stage, "link_error"));
}

static void noise_to_the_robots_leaves_them_safe(void)
{
    static const struct stage_plan plan = {.duration = 60, .cable = CABLE_TCP};

    robots_bear_noise(&plan);
}

static void noise_in_the_ptys_of_chips_leaves_them_safe(void)
{
    static const struct stage_plan plan = {.duration = 60, .cable = CABLE_NONE, .avr = true};

    robots_bear_noise(&plan);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(noise_in_the_network_stops_nobody);
    RUN_TEST(noise_from_the_robots_is_counted);
    RUN_TEST(noise_to_the_robots_leaves_them_safe);
    RUN_TEST(noise_in_the_ptys_of_chips_leaves_them_safe);
    return stage_verdict();
}
