#include "fanout.h"

#include "kernel_time.h"
#include "process.h"
#include "receivers.h"

#include <err.h>
#include <math.h>
#include <netinet/tcp.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#define BROKER "/usr/sbin/mosquitto" /* Debian's */
#define BROKER_START_MS 5000

#define SECOND_NS 1000000000

/* Of NatNet: what a message begins with. */
#define NATNET_FRAME 7
#define NATNET_KEEP_ALIVE 10
#define NATNET_DATAGRAM_MAX 65536

/* ---- poses ----------------------------------------------------------------------------- */

struct poses {
    int fd;
    int64_t asked; /* real_ns() */
};

static struct poses poses_open(const struct fanout *fanout)
{
    struct poses poses = {.fd = socket(AF_INET, SOCK_DGRAM, 0)};
    const struct sockaddr *cameras = (const struct sockaddr *)&fanout->cameras;
    struct timeval patience = {.tv_sec = 2};

    if (poses.fd < 0 || connect(poses.fd, cameras, sizeof fanout->cameras) != 0 ||
        setsockopt(poses.fd, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience) != 0)
        err(EXIT_FAILURE, "poses");
    want_time(poses.fd);
    return poses;
}

/* Waits for the next frame; returns when it arrived. */
static int64_t poses_next(struct poses *poses)
{
    static const uint8_t keep_alive[] = {NATNET_KEEP_ALIVE, 0, 0, 0};
    uint8_t datagram[NATNET_DATAGRAM_MAX];
    int64_t at;

    do {
        if (real_ns() - poses->asked > SECOND_NS) {
            poses->asked = real_ns();
            send(poses->fd, keep_alive, sizeof keep_alive, 0);
        }
        if (receive_at(poses->fd, datagram, sizeof datagram, &at) < 0)
            err(EXIT_FAILURE, "no poses");
    } while (datagram[0] != NATNET_FRAME);
    return at;
}

/* ---- times ----------------------------------------------------------------------------- */

static int by_size(const void *a, const void *b)
{
    int64_t left = *(const int64_t *)a;
    int64_t right = *(const int64_t *)b;

    return (left > right) - (left < right);
}

/* Sorts them. */
static struct fanout_times times_of(int64_t *ns, size_t count)
{
    qsort(ns, count, sizeof *ns, by_size);
    return (struct fanout_times){
        .p50 = (double)ns[(size_t)ceil(0.50 * (double)count) - 1] / 1000,
        .p99 = (double)ns[(size_t)ceil(0.99 * (double)count) - 1] / 1000,
    };
}

static bool goes_on(const struct fanout *fanout, int64_t began, size_t done)
{
    return done < DELIVERIES_MAX && (double)(real_ns() - began) < fanout->seconds * SECOND_NS;
}

static void send_all(int fd, const void *bytes, size_t count)
{
    if (send(fd, bytes, count, MSG_NOSIGNAL) != (ssize_t)count)
        err(EXIT_FAILURE, "sending");
}

/* ---- bare writes ----------------------------------------------------------------------- */

/* A port of 127.0.0.1 that is free, and a socket that listens there. */
static int listen_anywhere(uint16_t *port)
{
    struct sockaddr_in at = {.sin_family = AF_INET, .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    int fd = socket(AF_INET, SOCK_STREAM, 0);

    if (fd < 0 || bind(fd, (struct sockaddr *)&at, sizeof at) != 0 || listen(fd, RECEIVERS) != 0 ||
        getsockname(fd, (struct sockaddr *)&at, &(socklen_t){sizeof at}) != 0)
        err(EXIT_FAILURE, "a port");
    *port = ntohs(at.sin_port);
    return fd;
}

static void without_delay(int fd)
{
    if (setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &(int){1}, sizeof(int)) != 0)
        err(EXIT_FAILURE, "a link");
}

struct fanout_times fanout_bare(const struct fanout *fanout)
{
    static int64_t took[DELIVERIES_MAX];
    char bytes[FANOUT_BYTES_MAX] = {0};
    int fds[RECEIVERS];
    uint16_t port;
    size_t count = 0;
    int listener = listen_anywhere(&port);
    struct receivers receivers = receivers_start(port, fanout->bytes, NULL);
    struct poses poses = poses_open(fanout);

    for (size_t i = 0; i < RECEIVERS; i++) {
        fds[i] = accept(listener, NULL, NULL);
        without_delay(fds[i]);
    }
    for (int64_t began = real_ns(); goes_on(fanout, began, count); count++) {
        poses_next(&poses);
        int64_t from = real_ns();
        for (size_t i = 0; i < RECEIVERS; i++)
            send_all(fds[i], bytes, fanout->bytes);
        took[count] = real_ns() - from;
    }
    receivers_stop(&receivers, count);
    receivers_free(&receivers);
    for (size_t i = 0; i < RECEIVERS; i++)
        close(fds[i]);
    close(listener);
    close(poses.fd);
    return times_of(took, count);
}

/* ---- mosquitto ------------------------------------------------------------------------- */

/* MQTT 3.1.1, the little of it that is needed: messages of QoS 0 to topics r00 to r99. Spoken by
 * hand so that nothing but the broker stands between a write and the sockets of the receivers. */
#define TOPIC_BYTES 3
#define PUBLISH_HEADER_BYTES (2 + 2 + TOPIC_BYTES)
#define PUBLISH_BYTES_MAX (PUBLISH_HEADER_BYTES + FANOUT_BYTES_MAX)

static void topic_of(size_t receiver, uint8_t *topic)
{
    char text[16];

    snprintf(text, sizeof text, "r%02zu", receiver);
    memcpy(topic, text, TOPIC_BYTES);
}

static void await(int fd, const uint8_t *answer, size_t count)
{
    uint8_t got[8];

    if (recv(fd, got, count, MSG_WAITALL) != (ssize_t)count || memcmp(got, answer, count) != 0)
        errx(EXIT_FAILURE, "mosquitto does not answer as it should");
}

static void log_in(int fd)
{
    static const uint8_t connect[] = {0x10, 12, 0, 4, 'M', 'Q', 'T', 'T', 4, 2, 0, 0, 0, 0};
    static const uint8_t accepted[] = {0x20, 2, 0, 0};

    without_delay(fd);
    send_all(fd, connect, sizeof connect);
    await(fd, accepted, sizeof accepted);
}

static void subscribe(int fd, size_t receiver)
{
    static const uint8_t subscribed[] = {0x90, 3, 0, 1, 0};
    uint8_t request[] = {0x82, 5 + TOPIC_BYTES, 0, 1, 0, TOPIC_BYTES, 0, 0, 0, 0};

    log_in(fd);
    topic_of(receiver, &request[6]);
    send_all(fd, request, sizeof request);
    await(fd, subscribed, sizeof subscribed);
}

/* One message for each receiver; how long all of them are. */
static size_t write_messages(uint8_t *bytes, size_t payload)
{
    uint8_t *at = bytes;

    for (size_t i = 0; i < RECEIVERS; i++) {
        memset(at, 0, PUBLISH_HEADER_BYTES + payload);
        at[0] = 0x30;
        at[1] = (uint8_t)(2 + TOPIC_BYTES + payload);
        at[3] = TOPIC_BYTES;
        topic_of(i, &at[4]);
        at += PUBLISH_HEADER_BYTES + payload;
    }
    return (size_t)(at - bytes);
}

static struct process start_broker(const char *folder, uint16_t port)
{
    char path[4096];
    const char *const command[] = {BROKER, "-c", path, NULL};

    if (access(BROKER, X_OK) != 0)
        err(EXIT_FAILURE, "%s (Debian: mosquitto; make bench installs it)", BROKER);
    snprintf(path, sizeof path, "%s/mosquitto.conf", folder);
    FILE *file = fopen(path, "w");
    if (file == NULL)
        err(EXIT_FAILURE, "%s", path);
    fprintf(file,
            "listener %u 127.0.0.1\nallow_anonymous true\nset_tcp_nodelay true\n"
            "persistence false\nlog_dest none\n",
            port);
    if (fclose(file) != 0)
        err(EXIT_FAILURE, "%s", path);
    return process_start(command);
}

/* A connection to the broker, as soon as it takes one. */
static int dial_broker(uint16_t port)
{
    struct sockaddr_in to = {
        .sin_family = AF_INET,
        .sin_port = htons(port),
        .sin_addr.s_addr = htonl(INADDR_LOOPBACK),
    };
    struct timespec while_ms = {0, 1000000};

    for (int ms = 0; ms < BROKER_START_MS; ms++) {
        int fd = socket(AF_INET, SOCK_STREAM, 0);
        if (fd >= 0 && connect(fd, (const struct sockaddr *)&to, sizeof to) == 0)
            return fd;
        close(fd);
        nanosleep(&while_ms, NULL);
    }
    errx(EXIT_FAILURE, "mosquitto does not start");
}

/* Publishes for every pose until the time is up; the number of them and when each arrived. */
static size_t publish(const struct fanout *fanout, int broker, int64_t *arrived)
{
    static uint8_t messages[RECEIVERS * PUBLISH_BYTES_MAX];
    size_t bytes = write_messages(messages, fanout->bytes);
    struct poses poses = poses_open(fanout);
    size_t count = 0;

    for (int64_t began = real_ns(); goes_on(fanout, began, count); count++) {
        arrived[count] = poses_next(&poses);
        send_all(broker, messages, bytes);
    }
    close(poses.fd);
    return count;
}

/* From when poses arrived to how long it then took; returns how many of them are known. */
static size_t deliveries_took(const struct receivers *receivers, int64_t *ns, size_t count)
{
    size_t known = 0;

    for (size_t i = 0; i < count; i++) {
        int64_t at = receivers_when(receivers, i);
        if (at != 0)
            ns[known++] = at - ns[i];
    }
    if (known < count * 9 / 10)
        errx(EXIT_FAILURE, "the receivers were too late too often: the machine is too busy");
    return known;
}

struct fanout_times fanout_mosquitto(const struct fanout *fanout, const char *folder)
{
    static int64_t took[DELIVERIES_MAX];
    uint16_t port;

    /* The broker cannot be told to take any port that is free. */
    close(listen_anywhere(&port));
    struct process broker = start_broker(folder, port);
    int fd = dial_broker(port);
    log_in(fd);
    struct receivers receivers =
        receivers_start(port, PUBLISH_HEADER_BYTES + fanout->bytes, subscribe);

    int64_t began = real_ns();
    double cpu = -process_cpu(broker.pid) - process_cpu(0);
    size_t count = publish(fanout, fd, took);
    cpu += process_cpu(broker.pid) + process_cpu(0);
    double wall = (double)(real_ns() - began) / SECOND_NS;

    receivers_stop(&receivers, count);
    count = deliveries_took(&receivers, took, count);
    receivers_free(&receivers);
    close(fd);
    process_stop(&broker);
    struct fanout_times times = times_of(took, count);
    times.core = cpu / wall;
    return times;
}
