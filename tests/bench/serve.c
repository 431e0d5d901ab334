/* serve.c: `muster serve` with a hundred robots, and the same fan-out without it. */
#include "awake.h"
#include "benchmarks.h"
#include "directory.h"
#include "fanout.h"
#include "process.h"
#include "receivers.h"
#include "results.h"
#include "yaml.h"

#include <arpa/inet.h>
#include <err.h>
#include <math.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#define ROUNDS 5 /* of which the best counts, for each way by itself */
#define SECONDS 6
#define SECONDS_MAX 300

#define SCENARIO BENCH_FOLDER "/serve-100.yaml"
#define FOLDER BENCH_RUNS "/serve"
#define SITE FOLDER "/site.yaml"
#define SUMMARY FOLDER "/summary.json"

#define FRAMES_MIN (100 * SECONDS) /* of 120 a second */

#define P99_GOAL 1.5 /* times the floor */

#define PRIORITY 20 /* of 1 to 99: interrupts' threads, at 50, come first */

/* Robots, and the arena in which they move. */
struct stage {
    struct process arena, robots;
    struct sockaddr_in cameras;
    unsigned short robots_port;
};

static void start_arena(struct stage *stage)
{
    static const char *const command[] = {
        BENCH_MUSTER,  "arena", SCENARIO,        "--unicast", "--port",  "0",
        "--data-port", "0",     "--robots-port", "0",         "--quiet", NULL,
    };
    unsigned short port;

    stage->arena = process_start(command);
    process_give_way(stage->arena.pid);
    if (fscanf(stage->arena.out,
               "arena: natnet 127.0.0.1:%hu, data %*s (unicast), robots 127.0.0.1:%hu", &port,
               &stage->robots_port) != 2)
        errx(EXIT_FAILURE, "muster arena does not say where it is");
    stage->cameras = (struct sockaddr_in){
        .sin_family = AF_INET,
        .sin_port = htons(port),
        .sin_addr.s_addr = htonl(INADDR_LOOPBACK),
    };
}

static void start_robots(struct stage *stage)
{
    char arena[32];
    const char *const command[] = {
        BENCH_MUSTER, "robot",           "--robots", "native", "--id",    "1..100",
        "--link",     "tcp:127.0.0.1:0", "--arena",  arena,    "--quiet", NULL,
    };

    snprintf(arena, sizeof arena, "127.0.0.1:%hu", stage->robots_port);
    stage->robots = process_start(command);
    process_give_way(stage->robots.pid);
}

/* Where everything is, as the server is told. */
static void write_site(const struct stage *stage)
{
    FILE *site = fopen(SITE, "w");

    if (site == NULL)
        err(EXIT_FAILURE, SITE);
    fprintf(site,
            "schema: 1\nname: serve-100\n"
            "mocap: {protocol: natnet, server: 127.0.0.1, port: %u, unicast: true}\nrobots:\n",
            ntohs(stage->cameras.sin_port));
    for (int i = 0; i < RECEIVERS; i++) {
        unsigned id;
        char link[64];
        if (fscanf(stage->robots.out, " robot %u: %63s", &id, link) != 2)
            errx(EXIT_FAILURE, "muster robot does not say where its robots are");
        fprintf(site, "  - {id: %u, link: \"%s\"}\n", id, link);
    }
    if (fclose(site) != 0)
        err(EXIT_FAILURE, SITE);
}

/* A number of the run's summary, at `part` of the mapping at `key`. */
static double summary_number(const struct node *summary, const char *key, const char *part)
{
    const struct node *node = tree_find(summary, key);

    if (node != NULL && part != NULL)
        node = tree_find(node, part);
    if (node == NULL || node->kind != NODE_SCALAR)
        errx(EXIT_FAILURE, SUMMARY ": no %s", key);
    return atof(node->text);
}

/* A run that was disturbed measures something else. */
static void judge(const struct node *summary)
{
    double frames = summary_number(summary, "mocap", "frames");

    if (summary_number(summary, "duration", NULL) < SECONDS ||
        summary_number(summary, "links_lost", NULL) > 0 || frames < FRAMES_MIN)
        errx(EXIT_FAILURE, SUMMARY ": robots or poses were missing");
}

/* The mean of what a robot gets with a pose, told from what passed both ways. */
static size_t bytes_of(const struct node *summary)
{
    double bytes = summary_number(summary, "link", "bytes");
    double poses = summary_number(summary, "mocap", "frames") * RECEIVERS;

    return (size_t)fmin(ceil(bytes / poses), FANOUT_BYTES_MAX);
}

static struct fanout_times serve(size_t *bytes)
{
    static const char *const command[] = {
        BENCH_MUSTER, "serve", SITE,         "--scenario", SCENARIO,
        "--out",      FOLDER,  "--no-trace", "--quiet",    NULL,
    };
    char error[300];
    struct refusal refusal = {error, sizeof error};
    struct process process = process_start(command);
    double cpu = process_wait(&process);
    struct node *summary = yaml_read_file(SUMMARY, &refusal);

    if (summary == NULL)
        errx(EXIT_FAILURE, "%s", error);
    judge(summary);
    struct fanout_times times = {
        .p50 = summary_number(summary, "pose_to_bytes_us", "p50"),
        .p99 = summary_number(summary, "pose_to_bytes_us", "p99"),
        .core = cpu / summary_number(summary, "wall_s", NULL),
    };
    *bytes = bytes_of(summary);
    tree_free(summary);
    return times;
}

static void keep_best(struct fanout_times *best, struct fanout_times times)
{
    best->p50 = fmin(best->p50, times.p50);
    best->p99 = fmin(best->p99, times.p99);
    best->core = fmin(best->core, times.core);
}

/* The three ways, one after the other. */
struct ways {
    struct fanout_times serve, bare, mosquitto;
};

static void take_round(struct ways *best)
{
    struct stage stage;
    struct fanout fanout = {.seconds = SECONDS};

    start_arena(&stage);
    start_robots(&stage);
    write_site(&stage);
    keep_best(&best->serve, serve(&fanout.bytes));
    fanout.cameras = stage.cameras;
    keep_best(&best->bare, fanout_bare(&fanout));
    keep_best(&best->mosquitto, fanout_mosquitto(&fanout, FOLDER));
    process_stop(&stage.robots);
    process_stop(&stage.arena);
}

static void tell(const struct ways *best)
{
    figure_set("serve_100_p50_us", round(best->serve.p50));
    figure_worst_baseline("serve_100_p50_us", "floor", best->bare.p50);
    figure_worst_baseline("serve_100_p50_us", "mosquitto", best->mosquitto.p50);
    figure_set("serve_100_p99_us", round(best->serve.p99));
    figure_worst_baseline("serve_100_p99_us", "floor", best->bare.p99);
    figure_worst_baseline("serve_100_p99_us", "mosquitto", best->mosquitto.p99);
    figure_of("serve_100_p99_us")->goal = round(P99_GOAL * best->bare.p99);
    figure_set("serve_100_core_pct", 100 * best->serve.core);
    figure_worst_baseline("serve_100_core_pct", "mosquitto", 100 * best->mosquitto.core);
}

/* Where it is allowed, other work of the machine keeps none of the three waiting. */
static void take_priority(bool taken)
{
    struct sched_param priority = {.sched_priority = taken ? PRIORITY : 0};

    if (sched_setscheduler(0, taken ? SCHED_FIFO : SCHED_OTHER, &priority) != 0 && taken)
        warn("no real-time priority, other work will show in the times");
}

void measure_serve(void)
{
    static const struct fanout_times nothing = {INFINITY, INFINITY, INFINITY};
    struct ways best = {nothing, nothing, nothing};
    char error[300];

    if (!directory_prepare(FOLDER, error, sizeof error))
        errx(EXIT_FAILURE, "%s", error);
    /* Whatever hangs, this ends; what it has started ends with it. */
    alarm(SECONDS_MAX);
    int awake = awake_hold();
    take_priority(true);
    for (int i = 0; i < ROUNDS; i++)
        take_round(&best);
    take_priority(false);
    if (awake >= 0)
        close(awake);
    alarm(0);
    tell(&best);
}
