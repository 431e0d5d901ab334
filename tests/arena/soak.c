/* soak SECONDS SEED: four simulated chips and a server for a long time, with a fault at random
 * every few seconds. Whom it befalls stands in time, all drive again, and memory stays as it is. */
#include "stage.h"

#include <arpa/inet.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <unistd.h>
#include <unity.h>

#define SECOND 50
#define NOISE_MAX 300000
#define DATAGRAMS 200

/* What was used for the first time since it began, and no more. */
#define MEMORY_MORE (4 << 20)

/* No pose is on its way for longer, us. */
#define STALL_US 500000

enum fault {
    FAULT_PULL,
    FAULT_KILL,
    FAULT_REBOOT,
    FAULT_LOSE,
    FAULT_JUMP,
    FAULT_FREEZE,
    FAULT_RESTART,
    FAULT_NOISE_TO_SERVER,
    FAULT_NOISE_TO_ROBOT,
    FAULT_NOISE_IN_NETWORK,
    FAULTS,
};

static const char *const words[FAULTS] = {
    "pulled",       "killed",     "rebooted",        "body lost",      "body jumped",
    "mocap frozen", "mocap anew", "noise to server", "noise to robot", "noise in network",
};

static struct stage stage;
static double seconds;
static unsigned counts[FAULTS];

void setUp(void)
{
}

void tearDown(void)
{
    stage_close(&stage);
}

static unsigned one_of(unsigned count)
{
    return (unsigned)(rand() / (RAND_MAX + 1.0) * count);
}

static void tell_arena(const char *verb, unsigned id, const char *rest)
{
    char line[64];

    snprintf(line, sizeof line, "%s %u%s", verb, id, rest);
    process_tell(&stage.arena, line);
}

static void shout(void)
{
    const uint16_t ports[] = {stage_frames_port(&stage), stage.natnet_port, stage.robots_port};
    int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    uint8_t bytes[1000];

    for (int i = 0; i < DATAGRAMS; i++) {
        struct sockaddr_in to = {
            .sin_family = AF_INET,
            .sin_port = htons(ports[i % 3]),
            .sin_addr.s_addr = htonl(INADDR_LOOPBACK),
        };

        for (size_t k = 0; k < sizeof bytes; k++)
            bytes[k] = (uint8_t)one_of(256);
        sendto(fd, bytes, sizeof bytes, MSG_DONTWAIT, (const struct sockaddr *)&to, sizeof to);
    }
    close(fd);
}

static void restart_robot(unsigned id)
{
    process_signal(&stage_robot(&stage, id)->process, SIGKILL);
    stage_ticks(&stage, SECOND);
    TEST_ASSERT_TRUE(process_ended(&stage_robot(&stage, id)->process));
    stage_start_robot(&stage, id);
}

/* Whom it befalls stands within 500 ms; and what was done is undone. */
static void stop_one(enum fault fault, unsigned id)
{
    struct cable *cable = &stage_robot(&stage, id)->cable;

    if (fault == FAULT_PULL)
        cable_pull(cable);
    else if (fault == FAULT_LOSE)
        tell_arena("lose", id, "");
    else
        tell_arena("jump", id, " 0.9");
    stage_stands(&stage, id);
    if (fault == FAULT_PULL)
        cable_plug(cable);
    else if (fault == FAULT_LOSE)
        tell_arena("find", id, "");
    else
        tell_arena("jump", id, " 0");
}

static void stop_all(void)
{
    process_tell(&stage.arena, "freeze");
    for (unsigned id = 1; id <= STAGE_ROBOTS; id++)
        stage_stands(&stage, id);
    process_tell(&stage.arena, "thaw");
}

static void befall(enum fault fault, unsigned id)
{
    struct cable *cable = &stage_robot(&stage, id)->cable;

    switch (fault) {
    case FAULT_PULL:
    case FAULT_LOSE:
    case FAULT_JUMP: stop_one(fault, id); break;
    case FAULT_KILL: restart_robot(id); break;
    case FAULT_REBOOT: process_signal(&stage_robot(&stage, id)->process, SIGUSR1); break;
    case FAULT_FREEZE: stop_all(); break;
    case FAULT_RESTART: process_tell(&stage.arena, "restart"); break;
    case FAULT_NOISE_TO_SERVER: cable_noise(cable, TO_SERVER, NOISE_MAX); break;
    case FAULT_NOISE_TO_ROBOT: cable_noise(cable, TO_ROBOT, one_of(NOISE_MAX)); break;
    case FAULT_NOISE_IN_NETWORK: shout(); break;
    case FAULTS: break;
    }
}

/* What befalls a follower is nothing to the others. */
static void judge_others(enum fault fault, unsigned id)
{
    bool everybodys = fault == FAULT_FREEZE;

    for (unsigned other = 1; !everybodys && id > 2 && other <= STAGE_ROBOTS; other++)
        if (other != id)
            stage_drove_on(&stage, other);
}

static void one_round(void)
{
    enum fault fault = one_of(FAULTS);
    unsigned id = 1 + one_of(STAGE_ROBOTS);

    printf("robot %u: %s\n", id, words[fault]);
    counts[fault]++;
    stage_mark(&stage);
    befall(fault, id);
    stage_ticks(&stage, SECOND);
    judge_others(fault, id);
    for (unsigned other = 1; other <= STAGE_ROBOTS; other++)
        stage_drives_for(&stage, other, SECOND);
}

static void report(double begun, size_t memory, size_t most)
{
    for (int i = 0; i < FAULTS; i++)
        printf("%4u %s\n", counts[i], words[i]);
    printf("%.0f s; the server's memory: %zu KiB after %.0f s, %zu KiB at the most\n", seconds,
           memory >> 10, begun, most >> 10);
    printf("pose to bytes %.0f us at the most; %.0f links lost; %.0f CRC errors\n",
           stage_summary(&stage, "\"pose_to_bytes_us\"", "\"max\""),
           stage_summary(&stage, "\"links_lost\"", "\"links_lost\""),
           stage_summary(&stage, "\"link\"", "\"crc_errors\""));
}

static void faults_at_random_leave_nothing_behind(void)
{
    struct stage_plan plan = {.duration = 2 * seconds + 60, .cable = CABLE_PTY, .avr = true};
    int64_t begin_us = loop_now();
    double begun = seconds / 5, now = 0;
    size_t memory = 0, most = 0;

    stage_open(&stage, &plan);
    stage_begin(&stage);
    stage_ticks(&stage, 4 * SECOND);
    for (; now < seconds; now = (double)(loop_now() - begin_us) / 1e6) {
        size_t bytes = process_memory(&stage.server);

        memory = now < begun || memory == 0 ? bytes : memory;
        most = bytes > most ? bytes : most;
        one_round();
    }
    process_signal(&stage.server, SIGTERM);
    stage_server_ends(&stage, 0);
    report(begun, memory, most);
    TEST_ASSERT_TRUE(most <= memory + MEMORY_MORE);
    TEST_ASSERT_TRUE(stage_summary(&stage, "\"pose_to_bytes_us\"", "\"max\"") < STALL_US);
    stage_end(&stage);
}

int main(int argc, char **argv)
{
    seconds = argc > 1 ? atof(argv[1]) : 60;
    srand(argc > 2 ? (unsigned)atoi(argv[2]) : 1);
    setbuf(stdout, NULL);
    UNITY_BEGIN();
    RUN_TEST(faults_at_random_leave_nothing_behind);
    return UNITY_END();
}
