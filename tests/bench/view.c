/* view.c: what it costs a simulation that somebody looks on, or has stopped doing so without going.
 */
#include "view.h"

#include "benchmarks.h"
#include "fleet.h"
#include "process.h"
#include "results.h"

#include <arpa/inet.h>
#include <err.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#define ROUNDS 20 /* of which the fastest counts, for each by itself */
#define SECONDS_MAX 600

static const struct fleet hundred = {NULL, FLEET_HUNDRED, "duration=3", SIM_AVR, 2};

enum onlooker {
    NOBODY,
    READER, /* takes all that there is */
    STUCK,  /* takes nothing, and stays */
    ONLOOKERS,
};

static int dial(const char *url, enum onlooker onlooker)
{
    struct sockaddr_in at = {.sin_family = AF_INET, .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    int fd = socket(AF_INET, SOCK_STREAM, 0);
    int little = 4096; /* so that not even the kernel takes much */

    at.sin_port = htons((uint16_t)atoi(strrchr(url, ':') + 1));
    if (onlooker == STUCK)
        setsockopt(fd, SOL_SOCKET, SO_RCVBUF, &little, sizeof little);
    if (fd < 0 || connect(fd, (struct sockaddr *)&at, sizeof at) != 0)
        err(EXIT_FAILURE, "%s", url);
    return fd;
}

static void look(const char *url, enum onlooker onlooker)
{
    static const char request[] = "GET / HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\n"
                                  "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
                                  "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n"
                                  "Sec-WebSocket-Protocol: muster.view.v1\r\n\r\n";
    static char bytes[65536];
    int fd = dial(url, onlooker);

    if (write(fd, request, sizeof request - 1) != sizeof request - 1)
        err(EXIT_FAILURE, "%s", url);
    while (onlooker == READER && read(fd, bytes, sizeof bytes) > 0)
        ;
    pause();
}

/* Returns when it looks. */
static pid_t begin(const struct view *view, enum onlooker onlooker)
{
    pid_t pid = fork();

    if (pid < 0)
        err(EXIT_FAILURE, "an onlooker");
    if (pid == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        look(view_url(view), onlooker);
        _exit(EXIT_FAILURE);
    }
    while (view_viewers(view) == 0)
        usleep(1000);
    return pid;
}

/* Of a run, in s: how long it took, and how much of the processors. */
struct cost {
    double wall, cpu;
};

static struct cost run(struct view *view)
{
    double before = process_cpu(0);
    struct summary summary = fleet_run(&hundred, false, view);

    return (struct cost){summary.wall, process_cpu(0) - before};
}

static struct cost run_before(enum onlooker onlooker)
{
    const struct view_options options = {.port = 0};
    const struct view_about about = {"sim", "bench", 3, 0};
    char error[300] = "";

    if (onlooker == NOBODY)
        return run(NULL);
    struct view *view = view_open(&options, &about, error, sizeof error);
    if (view == NULL)
        errx(EXIT_FAILURE, "%s", error);
    pid_t pid = begin(view, onlooker);
    struct cost cost = run(view);
    bool stayed = view_viewers(view) == 1;
    kill(pid, SIGKILL);
    waitpid(pid, NULL, 0);
    view_close(view);
    if (onlooker == READER && !stayed)
        errx(EXIT_FAILURE, "the onlooker went");
    return cost;
}

static void keep_best(struct cost *best, struct cost cost)
{
    best->wall = fmin(best->wall, cost.wall);
    best->cpu = fmin(best->cpu, cost.cpu);
}

static void tell(const char *whom, struct cost cost)
{
    fprintf(stderr, "%s: 3 s of 100 chips in %.3f s, of processors %.3f s\n", whom, cost.wall,
            cost.cpu);
}

/* One after the other in each round: what else the machine does is shared by all. Where that is
 * much, the processors' time says more. */
void measure_view(void)
{
    struct cost best[ONLOOKERS];

    alarm(SECONDS_MAX);
    for (enum onlooker onlooker = 0; onlooker < ONLOOKERS; onlooker++)
        best[onlooker] = (struct cost){INFINITY, INFINITY};
    for (int i = 0; i < ROUNDS; i++)
        for (enum onlooker onlooker = 0; onlooker < ONLOOKERS; onlooker++)
            keep_best(&best[onlooker], run_before(onlooker));
    alarm(0);
    tell("nobody looks on", best[NOBODY]);
    tell("somebody looks on", best[READER]);
    tell("somebody is stuck", best[STUCK]);
    figure_set("view_100_slowdown_pct", 100 * (best[READER].wall / best[NOBODY].wall - 1));
    figure_set("view_100_stuck_slowdown_pct", 100 * (best[STUCK].wall / best[NOBODY].wall - 1));
}
