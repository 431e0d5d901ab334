#include "receivers.h"

#include "process.h"

#include "kernel_time.h"

#include <arpa/inet.h>
#include <err.h>
#include <poll.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/timerfd.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#define LAST (RECEIVERS - 1)

/* Robots look at their receivers fifty times a second; only the last of these is waited for, so
 * that no other write has anybody to wake. */
#define LOOK_NS 20000000

/* For what is still on its way at the end. */
#define PATIENCE_MS 2000

/* Of both processes. */
struct deliveries {
    _Atomic uint64_t bytes[RECEIVERS];
    int64_t at[DELIVERIES_MAX];
};

static int dial(uint16_t port)
{
    struct sockaddr_in to = {
        .sin_family = AF_INET,
        .sin_port = htons(port),
        .sin_addr.s_addr = htonl(INADDR_LOOPBACK),
    };
    int fd = socket(AF_INET, SOCK_STREAM, 0);

    if (fd < 0 || connect(fd, (const struct sockaddr *)&to, sizeof to) != 0)
        err(EXIT_FAILURE, "receivers: port %u", port);
    return fd;
}

static void drain(int fd, _Atomic uint64_t *bytes)
{
    char buffer[4096];
    ssize_t count;

    while ((count = recv(fd, buffer, sizeof buffer, MSG_DONTWAIT)) > 0)
        *bytes += (uint64_t)count;
}

/* Of deliveries that are found together the kernel tells only when the last one arrived: this
 * process was late, not they. */
static void take_last(int fd, size_t each, struct deliveries *deliveries)
{
    char buffer[4096];
    int64_t at;
    ssize_t count = receive_at(fd, buffer, sizeof buffer, &at);

    if (count <= 0)
        errx(EXIT_FAILURE, "receivers: cut off");
    deliveries->bytes[LAST] += (uint64_t)count;
    size_t done = deliveries->bytes[LAST] / each;
    if (done >= 1 && done <= DELIVERIES_MAX)
        deliveries->at[done - 1] = at;
}

static void receive(const int *fds, size_t each, int control, struct deliveries *deliveries)
{
    struct itimerspec period = {{0, LOOK_NS}, {0, LOOK_NS}};
    int timer = timerfd_create(CLOCK_MONOTONIC, 0);
    struct pollfd waits[] = {{fds[LAST], POLLIN, 0}, {timer, POLLIN, 0}, {control, POLLIN, 0}};
    uint64_t periods;

    if (timer < 0 || timerfd_settime(timer, 0, &period, NULL) != 0)
        err(EXIT_FAILURE, "receivers: timer");
    while (waits[2].revents == 0) {
        if (poll(waits, 3, -1) < 0)
            err(EXIT_FAILURE, "receivers: poll");
        if (waits[0].revents != 0)
            take_last(fds[LAST], each, deliveries);
        if (waits[1].revents == 0 || read(timer, &periods, sizeof periods) < 0)
            continue;
        for (size_t i = 0; i < LAST; i++)
            drain(fds[i], &deliveries->bytes[i]);
    }
    for (size_t i = 0; i < LAST; i++)
        drain(fds[i], &deliveries->bytes[i]);
}

static void be_receivers(uint16_t port, size_t each, receivers_greeting *greet, int control,
                         struct deliveries *deliveries)
{
    int fds[RECEIVERS];

    prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (size_t i = 0; i < RECEIVERS; i++) {
        fds[i] = dial(port);
        if (greet != NULL)
            greet(fds[i], i);
    }
    want_time(fds[LAST]);
    if (write(control, "", 1) != 1)
        err(EXIT_FAILURE, "receivers: control");
    receive(fds, each, control, deliveries);
    _exit(EXIT_SUCCESS);
}

struct receivers receivers_start(uint16_t port, size_t bytes, receivers_greeting *greet)
{
    struct receivers receivers;
    int control[2];

    receivers.deliveries = mmap(NULL, sizeof *receivers.deliveries, PROT_READ | PROT_WRITE,
                                MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (receivers.deliveries == MAP_FAILED ||
        socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, control) != 0 ||
        (receivers.pid = fork()) < 0)
        err(EXIT_FAILURE, "receivers");
    if (receivers.pid == 0) {
        close(control[0]);
        be_receivers(port, bytes, greet, control[1], receivers.deliveries);
    }
    process_give_way(receivers.pid);
    close(control[1]);
    receivers.control = control[0];
    receivers.bytes = bytes;
    if (read(control[0], &(char){0}, 1) != 1)
        errx(EXIT_FAILURE, "there are no receivers");
    return receivers;
}

void receivers_stop(struct receivers *receivers, size_t deliveries)
{
    struct timespec while_ms = {0, 1000000};
    int status;

    for (int ms = 0; ms < PATIENCE_MS; ms++) {
        if (receivers->deliveries->bytes[LAST] == deliveries * receivers->bytes)
            break;
        nanosleep(&while_ms, NULL);
    }
    close(receivers->control);
    if (waitpid(receivers->pid, &status, 0) != receivers->pid || status != 0)
        errx(EXIT_FAILURE, "the receivers did not end well");
    for (size_t i = 0; i < RECEIVERS; i++)
        if (receivers->deliveries->bytes[i] != deliveries * receivers->bytes)
            errx(EXIT_FAILURE, "receiver %zu got %llu bytes of %zu deliveries of %zu", i,
                 (unsigned long long)receivers->deliveries->bytes[i], deliveries, receivers->bytes);
}

int64_t receivers_when(const struct receivers *receivers, size_t i)
{
    return receivers->deliveries->at[i];
}

void receivers_free(struct receivers *receivers)
{
    munmap(receivers->deliveries, sizeof *receivers->deliveries);
}
