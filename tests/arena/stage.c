#define _GNU_SOURCE /* nftw() */
#include "stage.h"

#include "setpoints.h"

#include <arpa/inet.h>
#include <ftw.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>
#include <unity.h>

/* Nothing that is waited for takes as long, on whatever machine. */
#define PATIENCE_US 60000000

#define CLOCK_US 20000

/* A robot that drives may miss so many ticks of it: busy machines are late. */
#define PAUSE_TICKS 12

/* What a robot makes up for: ten ticks. */
#define HELD_MAX_US 200000

#define TEXT_MAX 65536

void stage_expect(const struct stage *stage, bool so, const char *words)
{
    char held[80];

    if (so)
        return;
    snprintf(held, sizeof held, "this machine held robots up for %d ms",
             (int)(stage->held_us / 1000));
    if (stage->held_us > HELD_MAX_US)
        TEST_IGNORE_MESSAGE(held);
    TEST_FAIL_MESSAGE(words);
}

/* ---- set-points ------------------------------------------------------------------------ */

static void time_tick(struct stage *stage, struct stage_robot *robot)
{
    int64_t now_us = loop_now();

    if (robot->heard_us != 0 && now_us - robot->heard_us > stage->held_us)
        stage->held_us = now_us - robot->heard_us;
    robot->heard_us = now_us;
}

static void count_tick(struct stage *stage, const struct setpoint *setpoint)
{
    for (int i = 0; i < STAGE_ROBOTS; i++) {
        struct stage_robot *robot = &stage->robot[i];

        if (robot->id != setpoint->id)
            continue;
        robot->ticks++;
        time_tick(stage, robot);
        if (setpoint->left != 0 || setpoint->right != 0)
            robot->moved = robot->ticks;
        else
            robot->stood = robot->ticks;
        uint64_t since = robot->moved > robot->marked ? robot->moved : robot->marked;
        if (robot->ticks - since > robot->pause)
            robot->pause = robot->ticks - since;
    }
}

static bool take_setpoints(struct stage *stage)
{
    uint8_t bytes[512];
    const struct sockaddr_in arena = {
        .sin_family = AF_INET,
        .sin_port = htons(stage->robots_port),
        .sin_addr.s_addr = htonl(INADDR_LOOPBACK),
    };
    ssize_t length = recv(stage->tap.fd, bytes, sizeof bytes, MSG_DONTWAIT);
    size_t count;

    if (length < 0)
        return false;
    sendto(stage->tap.fd, bytes, (size_t)length, MSG_DONTWAIT, (const struct sockaddr *)&arena,
           sizeof arena);
    if (!setpoints_count(bytes, (size_t)length, &count))
        return true;
    for (size_t i = 0; i < count; i++) {
        struct setpoint setpoint = setpoints_read(bytes, i);

        count_tick(stage, &setpoint);
    }
    return true;
}

static void on_tap(struct watch *watch, uint32_t events)
{
    struct stage *stage = (struct stage *)((char *)watch - offsetof(struct stage, tap));

    (void)events;
    while (take_setpoints(stage))
        ;
}

static void open_tap(struct stage *stage)
{
    struct sockaddr_in address = {
        .sin_family = AF_INET,
        .sin_addr.s_addr = htonl(INADDR_LOOPBACK),
    };

    stage->tap = (struct watch){
        .fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0),
        .urgent = true,
        .ready = on_tap,
    };
    TEST_ASSERT_TRUE(stage->tap.fd >= 0);
    TEST_ASSERT_EQUAL_INT(0,
                          bind(stage->tap.fd, (const struct sockaddr *)&address, sizeof address));
    TEST_ASSERT_TRUE(loop_watch(&stage->loop, &stage->tap, EPOLLIN));
}

/* ---- waiting --------------------------------------------------------------------------- */

static void on_clock(struct watch *watch, uint32_t events)
{
    (void)events;
    loop_periods(watch->fd);
}

void stage_until(struct stage *stage, bool (*done)(struct stage *stage, const void *context),
                 const void *context, const char *words)
{
    int64_t deadline_us = loop_now() + PATIENCE_US;

    while (!done(stage, context)) {
        stage_expect(stage, loop_now() < deadline_us, words);
        TEST_ASSERT_TRUE(loop_wait(&stage->loop));
    }
}

struct stage_robot *stage_robot(struct stage *stage, unsigned id)
{
    return &stage->robot[id - 1];
}

static bool have_ticked(struct stage *stage, const void *context)
{
    const uint64_t *until = context;

    for (int i = 0; i < STAGE_ROBOTS; i++)
        if (!process_ended(&stage->robot[i].process) && stage->robot[i].ticks < until[i])
            return false;
    return true;
}

void stage_ticks(struct stage *stage, unsigned ticks)
{
    uint64_t until[STAGE_ROBOTS];

    for (int i = 0; i < STAGE_ROBOTS; i++)
        until[i] = stage->robot[i].ticks + ticks;
    stage_until(stage, have_ticked, until, "robots do not tick");
}

void stage_mark(struct stage *stage)
{
    on_tap(&stage->tap, 0);
    for (int i = 0; i < STAGE_ROBOTS; i++) {
        stage->robot[i].marked = stage->robot[i].ticks;
        stage->robot[i].pause = 0;
    }
    stage->server.heard = stage->server.length;
}

static bool has_said(struct stage *stage, const void *words)
{
    bool said = process_said(&stage->server, words) != NULL;

    stage_expect(stage, said || stage->server.output.watched, words);
    return said;
}

void stage_says(struct stage *stage, const char *words)
{
    stage_until(stage, has_said, words, words);
}

static bool is_past_safety(struct stage *stage, const void *context)
{
    const unsigned *id = context;
    const struct stage_robot *robot = stage_robot(stage, *id);

    return robot->ticks > robot->marked + 2 * SAFE_TICKS;
}

void stage_stands(struct stage *stage, unsigned id)
{
    const struct stage_robot *robot = stage_robot(stage, id);
    char words[80];

    stage_until(stage, is_past_safety, &id, "the robot does not tick");
    snprintf(words, sizeof words, "robot %u drove for %d ticks", id,
             (int)(robot->moved - robot->marked));
    stage_expect(stage, robot->moved <= robot->marked + SAFE_TICKS, words);
}

struct driving {
    const struct stage_robot *robot;
    unsigned ticks;
};

static bool is_driving(struct stage *stage, const void *context)
{
    const struct driving *driving = context;
    const struct stage_robot *robot = driving->robot;
    uint64_t since = robot->stood > robot->marked ? robot->stood : robot->marked;

    (void)stage;
    return robot->ticks >= since + driving->ticks;
}

void stage_drives_for(struct stage *stage, unsigned id, unsigned ticks)
{
    struct driving driving = {stage_robot(stage, id), ticks};
    char words[80];

    snprintf(words, sizeof words, "robot %u does not drive for %u ticks", id, ticks);
    stage_until(stage, is_driving, &driving, words);
}

void stage_drives(struct stage *stage, unsigned id)
{
    stage_drives_for(stage, id, 1);
}

void stage_drove_on(struct stage *stage, unsigned id)
{
    const struct stage_robot *robot = stage_robot(stage, id);
    char words[80];

    snprintf(words, sizeof words, "robot %u stood for %d ticks", id, (int)robot->pause);
    stage_expect(stage, robot->pause <= PAUSE_TICKS, words);
}

/* ---- files ----------------------------------------------------------------------------- */

static void write_file(const struct stage *stage, const char *name, const char *text)
{
    char path[128];

    snprintf(path, sizeof path, "%s/%s", stage->directory, name);
    FILE *file = fopen(path, "w");
    TEST_ASSERT_NOT_NULL_MESSAGE(file, path);
    fputs(text, file);
    TEST_ASSERT_EQUAL_INT(0, fclose(file));
}

static const char *read_file(const struct stage *stage, const char *name, char text[TEXT_MAX])
{
    char path[128];

    snprintf(path, sizeof path, "%s/run/%s", stage->directory, name);
    FILE *file = fopen(path, "r");
    TEST_ASSERT_NOT_NULL_MESSAGE(file, path);
    text[fread(text, 1, TEXT_MAX - 1, file)] = '\0';
    fclose(file);
    return text;
}

double stage_summary(const struct stage *stage, const char *section, const char *key)
{
    char text[TEXT_MAX];
    const char *at = strstr(read_file(stage, "summary.json", text), section);

    TEST_ASSERT_NOT_NULL_MESSAGE(at, section);
    at = strstr(at, key);
    TEST_ASSERT_NOT_NULL_MESSAGE(at, key);
    at = strchr(at, ':');
    TEST_ASSERT_NOT_NULL(at);
    return strtod(at + 1, NULL);
}

bool stage_logged(const struct stage *stage, const char *words)
{
    char text[TEXT_MAX];

    return strstr(read_file(stage, "events.csv", text), words) != NULL;
}

void stage_is_complete(const struct stage *stage, double error)
{
    char text[TEXT_MAX];

    stage_expect(stage,
                 strstr(read_file(stage, "summary.json", text), "\"complete\": true") != NULL,
                 "not every vertex is held");
    stage_expect(stage, stage_summary(stage, "\"mean_distance_error_m\"", "\"final\"") <= error,
                 "robots are far from their vertices");
}

/* The robots begin where the formation has them. */
static void write_scenario(const struct stage *stage)
{
    char text[1024];

    snprintf(text, sizeof text,
             "schema: 1\n"
             "name: straight\n"
             "duration: %g\n"
             "robots:\n"
             "  - {id: 1, pose: [0, 0, 0], candidate: true}\n"
             "  - {id: 2, pose: [-1, 0, 0], candidate: true}\n"
             "  - {id: 3, pose: [-1, 1, 0]}\n"
             "  - {id: 4, pose: [-1, -1, 0]}\n"
             "network: {range: 10}\n"
             "trajectory: {start: [0, 0, 0], v: 0.3, omega: 0}\n"
             "formations:\n"
             "  arrow: {L: [0, 1, 1.41421356, 1.41421356], psi: [0, pi, 3*pi/4, -3*pi/4]}\n"
             "formation: arrow\n",
             stage->plan->duration);
    write_file(stage, "scenario.yaml", text);
}

static void write_site(struct stage *stage)
{
    const struct stage_plan *plan = stage->plan;
    char text[2048];
    int used = snprintf(text, sizeof text,
                        "schema: 1\n"
                        "name: stage\n"
                        "mocap: {protocol: natnet, server: 127.0.0.1, port: %u, unicast: true%s}\n"
                        "%s"
                        "robots:\n",
                        stage->natnet_port, plan->mocap != NULL ? plan->mocap : "",
                        plan->site != NULL ? plan->site : "");

    for (unsigned id = 1; id <= STAGE_ROBOTS; id++) {
        const struct stage_robot *robot = stage_robot(stage, id);

        used += snprintf(text + used, sizeof text - (size_t)used, "  - {id: %u, link: \"%s\"}\n",
                         id, plan->cable == CABLE_NONE ? robot->link : robot->cable.link);
    }
    write_file(stage, "site.yaml", text);
}

/* ---- beginning ------------------------------------------------------------------------- */

static const char *scenario_path(const struct stage *stage, char path[128])
{
    snprintf(path, 128, "%s/scenario.yaml", stage->directory);
    return stage->plan->scenario != NULL ? stage->plan->scenario : path;
}

struct saying {
    const struct process *process;
    const char *words;
};

static bool has_line(struct stage *stage, const void *context)
{
    const struct saying *saying = context;
    const char *at = process_said(saying->process, saying->words);

    (void)stage;
    return at != NULL && strchr(at, '\n') != NULL;
}

/* What follows these words in what a process says; the line is whole. */
static const char *wait_for(struct stage *stage, const struct process *process, const char *words)
{
    struct saying saying = {process, words};

    stage_until(stage, has_line, &saying, words);
    return process_said(process, words) + strlen(words);
}

/* One that was there before is found at its old ports again. */
void stage_start_arena(struct stage *stage)
{
    char path[128], natnet_port[16], robots_port[16];
    const char *argv[] = {STAGE_MUSTER,  "arena",  scenario_path(stage, path),
                          "--unicast",   "--port", natnet_port,
                          "--data-port", "0",      "--robots-port",
                          robots_port,   NULL};
    unsigned natnet, robots;

    snprintf(natnet_port, sizeof natnet_port, "%u", stage->natnet_port);
    snprintf(robots_port, sizeof robots_port, "%u", stage->robots_port);
    stage->arena.heard = stage->arena.length;
    process_start(&stage->arena, &stage->loop, argv, NULL);
    const char *rest = wait_for(stage, &stage->arena, "arena: natnet 127.0.0.1:");
    TEST_ASSERT_EQUAL_INT(1, sscanf(rest, "%u", &natnet));
    rest = wait_for(stage, &stage->arena, "robots 127.0.0.1:");
    TEST_ASSERT_EQUAL_INT(1, sscanf(rest, "%u", &robots));
    stage->natnet_port = (uint16_t)natnet;
    stage->robots_port = (uint16_t)robots;
}

/* A robot that was there before is found at its old port again. */
static void robot_place(const struct stage *stage, const struct stage_robot *robot, char place[128])
{
    if (stage->plan->cable == CABLE_NONE)
        snprintf(place, 128, "pty:%s/robot-%%d", stage->directory);
    else if (robot->link[0] != '\0')
        snprintf(place, 128, "%s", robot->link);
    else
        snprintf(place, 128, "tcp:127.0.0.1:0");
}

void stage_start_robot(struct stage *stage, unsigned id)
{
    struct stage_robot *robot = stage_robot(stage, id);
    char number[16], place[128], tap[32], ready[32];
    struct sockaddr_in at;
    socklen_t length = sizeof at;

    getsockname(stage->tap.fd, (struct sockaddr *)&at, &length);
    snprintf(number, sizeof number, "%u", robot->id);
    snprintf(tap, sizeof tap, "127.0.0.1:%u", ntohs(at.sin_port));
    robot_place(stage, robot, place);
    const char *argv[] = {
        STAGE_MUSTER, "robot",        "--id", number,     "--link",
        place,        "--arena",      tap,    "--robots", stage->plan->avr ? "avr" : "native",
        "--firmware", STAGE_FIRMWARE, NULL};
    robot->process.heard = robot->process.length;
    robot->heard_us = 0;
    process_start(&robot->process, &stage->loop, argv, NULL);
    snprintf(ready, sizeof ready, "robot %s: t", number);
    const char *link = wait_for(stage, &robot->process, ready);
    TEST_ASSERT_EQUAL_INT(1, sscanf(link - 1, "%127s", robot->link));
}

static uint16_t port_of(const char *link)
{
    unsigned port = 0;

    sscanf(link, "tcp:127.0.0.1:%u", &port);
    return (uint16_t)port;
}

/* Where an absent robot would be, nobody listens: what a cable leads to is then port 0. */
static void start_robots(struct stage *stage)
{
    const struct stage_plan *plan = stage->plan;

    for (unsigned id = 1; id <= STAGE_ROBOTS; id++) {
        struct stage_robot *robot = stage_robot(stage, id);

        robot->id = (uint16_t)(plan->answers[id - 1] != 0 ? plan->answers[id - 1] : id);
        if (!plan->absent[id - 1])
            stage_start_robot(stage, id);
        cable_open(&robot->cable, &stage->loop, plan->cable, stage->directory, id,
                   port_of(robot->link));
        if (plan->absent[id - 1])
            cable_pull(&robot->cable);
    }
}

static void start_server(struct stage *stage)
{
    char site[128], scenario[128], run[128];
    const struct process_options options = {stage->plan->preload, stage->plan->output};

    snprintf(site, sizeof site, "%s/site.yaml", stage->directory);
    snprintf(run, sizeof run, "%s/run", stage->directory);
    const char *argv[] = {STAGE_MUSTER,
                          "serve",
                          site,
                          "--scenario",
                          scenario_path(stage, scenario),
                          "--out",
                          run,
                          stage->plan->looked_at ? "--view=0" : NULL,
                          NULL};
    process_start(&stage->server, &stage->loop, argv, &options);
}

void stage_open(struct stage *stage, const struct stage_plan *plan)
{
    *stage = (struct stage){.open = true, .plan = plan, .directory = "/tmp/muster-arena-XXXXXX"};
    signal(SIGPIPE, SIG_IGN);
    TEST_ASSERT_NOT_NULL(mkdtemp(stage->directory));
    TEST_ASSERT_TRUE(loop_open(&stage->loop));
    stage->clock = (struct watch){.fd = loop_timer(CLOCK_US), .ready = on_clock};
    TEST_ASSERT_TRUE(loop_watch(&stage->loop, &stage->clock, EPOLLIN));
    open_tap(stage);
    if (plan->scenario == NULL)
        write_scenario(stage);
    stage_start_arena(stage);
    start_robots(stage);
    write_site(stage);
    start_server(stage);
}

void stage_begin(struct stage *stage)
{
    stage_says(stage, "leads");
}

uint16_t stage_frames_port(const struct stage *stage)
{
    unsigned port = 0;
    const char *at = process_said(&stage->arena, "frames go to ");

    TEST_ASSERT_NOT_NULL(at);
    TEST_ASSERT_EQUAL_INT(1, sscanf(at, "frames go to 127.0.0.1:%u", &port));
    return (uint16_t)port;
}

/* ---- end ------------------------------------------------------------------------------- */

static bool has_ended(struct stage *stage, const void *context)
{
    (void)stage;
    return process_ended(*(struct process *const *)context);
}

static void ends_with(struct stage *stage, struct process *process, int status)
{
    stage_until(stage, has_ended, &process, process->name);
    TEST_ASSERT_EQUAL_INT_MESSAGE(status, process->status, process->name);
}

void stage_server_ends(struct stage *stage, int status)
{
    ends_with(stage, &stage->server, status);
}

static void end(struct stage *stage, struct process *process)
{
    if (process_ended(process))
        return;
    process_signal(process, SIGTERM);
    ends_with(stage, process, 0);
}

void stage_end(struct stage *stage)
{
    for (int i = 0; i < STAGE_ROBOTS; i++)
        end(stage, &stage->robot[i].process);
    end(stage, &stage->arena);
}

static void say(const struct process *process)
{
    if (process->said != NULL)
        printf("---- %s\n%s", process->name, process->said);
}

static int remove_one(const char *path, const struct stat *about, int kind, struct FTW *place)
{
    (void)about;
    (void)kind;
    (void)place;
    return remove(path);
}

void stage_close(struct stage *stage)
{
    if (!stage->open)
        return;
    if (Unity.CurrentTestFailed) {
        printf("The files of this run are in %s\n", stage->directory);
        say(&stage->server);
        say(&stage->arena);
    }
    for (int i = 0; i < STAGE_ROBOTS; i++) {
        if (Unity.CurrentTestFailed)
            say(&stage->robot[i].process);
        cable_close(&stage->robot[i].cable);
        process_close(&stage->robot[i].process);
    }
    process_close(&stage->server);
    process_close(&stage->arena);
    close(stage->tap.fd);
    close(stage->clock.fd);
    loop_close(&stage->loop);
    if (!Unity.CurrentTestFailed)
        nftw(stage->directory, remove_one, 8, FTW_DEPTH | FTW_PHYS);
    stage->open = false;
}

int stage_verdict(void)
{
    int failures = UNITY_END();

    return failures == 0 && Unity.TestIgnores > 0 ? STAGE_SKIPPED : failures;
}
