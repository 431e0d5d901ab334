#define _GNU_SOURCE /* posix_openpt() and what belongs to it */
#include "cable.h"

#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>
#include <unity.h>

#define CHUNK 4096

#define CABLE(watch, member) ((struct cable *)((char *)(watch)-offsetof(struct cable, member)))

static void drop(struct cable *cable, struct watch *end)
{
    const struct linger reset = {.l_onoff = 1, .l_linger = 0};

    if (end->fd < 0)
        return;
    loop_forget(cable->loop, end);
    setsockopt(end->fd, SOL_SOCKET, SO_LINGER, &reset, sizeof reset); /* no matter if it is a pty */
    close(end->fd);
    end->fd = -1;
}

static void drop_server(struct cable *cable)
{
    drop(cable, &cable->server);
    if (cable->slave >= 0)
        close(cable->slave);
    cable->slave = -1;
}

/* What is not taken at once is lost, as on the air. */
static void put(const struct watch *end, const uint8_t *bytes, size_t count)
{
    if (end->fd >= 0 && write(end->fd, bytes, count) < 0)
        return;
}

static size_t draw(struct cable *cable, enum cable_way way, uint8_t *bytes)
{
    size_t count = cable->noise[way] < CHUNK ? cable->noise[way] : CHUNK;

    for (size_t i = 0; i < count; i++) {
        cable->random = cable->random * 1664525 + 1013904223;
        bytes[i] = (uint8_t)(cable->random >> 24);
    }
    return count;
}

/* True while there is more to come. */
static bool make_noise(struct cable *cable, enum cable_way way, struct watch *end)
{
    uint8_t bytes[CHUNK];
    size_t count = draw(cable, way, bytes);

    if (count == 0 || end->fd < 0)
        return false;
    ssize_t taken = write(end->fd, bytes, count);
    if (taken > 0)
        cable->noise[way] -= (size_t)taken;
    return cable->noise[way] > 0;
}

static void listen_to(struct cable *cable, struct watch *end, bool noisy)
{
    TEST_ASSERT_TRUE(loop_watch(cable->loop, end, noisy ? EPOLLIN | EPOLLOUT : EPOLLIN));
}

/* What has come at one end goes to the other. False when the end is gone. */
static bool pass(const struct watch *from, const struct watch *to, uint32_t events)
{
    uint8_t bytes[CHUNK];

    if ((events & ~(uint32_t)EPOLLOUT) == 0)
        return true;
    ssize_t count = read(from->fd, bytes, sizeof bytes);
    if (count > 0)
        put(to, bytes, (size_t)count);
    return count > 0 || (count < 0 && errno == EAGAIN);
}

/* A pty has no end that goes: whoever holds its slave is there. */
static void on_robot(struct watch *watch, uint32_t events)
{
    struct cable *cable = CABLE(watch, robot);

    if (!pass(watch, &cable->server, events)) {
        drop(cable, watch);
        if (cable->kind == CABLE_TCP)
            drop_server(cable);
        return;
    }
    if ((events & EPOLLOUT) != 0)
        listen_to(cable, watch, make_noise(cable, TO_ROBOT, watch));
}

static void dial_robot(struct cable *cable)
{
    struct sockaddr_in address = {
        .sin_family = AF_INET,
        .sin_port = htons(cable->robot_port),
        .sin_addr.s_addr = htonl(INADDR_LOOPBACK),
    };

    drop(cable, &cable->robot);
    cable->robot = (struct watch){
        .fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0),
        .ready = on_robot,
    };
    TEST_ASSERT_TRUE(cable->robot.fd >= 0);
    if (connect(cable->robot.fd, (const struct sockaddr *)&address, sizeof address) != 0) {
        drop(cable, &cable->robot);
        return;
    }
    fcntl(cable->robot.fd, F_SETFL, O_NONBLOCK);
    listen_to(cable, &cable->robot, cable->noise[TO_ROBOT] > 0);
}

static void on_server(struct watch *watch, uint32_t events)
{
    struct cable *cable = CABLE(watch, server);

    if (cable->kind == CABLE_PTY && cable->robot.fd < 0)
        dial_robot(cable);
    if (!pass(watch, &cable->robot, events)) {
        drop_server(cable);
        drop(cable, &cable->robot);
        return;
    }
    if ((events & EPOLLOUT) != 0)
        listen_to(cable, watch, make_noise(cable, TO_SERVER, watch));
}

static void serve_one(struct cable *cable, int fd)
{
    cable->server = (struct watch){.fd = fd, .ready = on_server};
    listen_to(cable, &cable->server, cable->noise[TO_SERVER] > 0);
}

static void on_listener(struct watch *watch, uint32_t events)
{
    struct cable *cable = CABLE(watch, listener);
    int fd = accept4(watch->fd, NULL, NULL, SOCK_NONBLOCK | SOCK_CLOEXEC);

    (void)events;
    if (fd < 0)
        return;
    drop_server(cable);
    dial_robot(cable);
    if (cable->robot.fd < 0) {
        close(fd);
        return;
    }
    serve_one(cable, fd);
}

/* Port 0: any, and the same one again later. */
static void open_listener(struct cable *cable, uint16_t port)
{
    struct sockaddr_in address = {
        .sin_family = AF_INET,
        .sin_port = htons(port),
        .sin_addr.s_addr = htonl(INADDR_LOOPBACK),
    };
    socklen_t length = sizeof address;
    const int on = 1;
    int fd = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);

    TEST_ASSERT_TRUE(fd >= 0);
    setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    TEST_ASSERT_EQUAL_INT(0, bind(fd, (const struct sockaddr *)&address, sizeof address));
    TEST_ASSERT_EQUAL_INT(0, listen(fd, 4));
    TEST_ASSERT_EQUAL_INT(0, getsockname(fd, (struct sockaddr *)&address, &length));
    snprintf(cable->link, sizeof cable->link, "tcp:127.0.0.1:%u", ntohs(address.sin_port));
    cable->listener = (struct watch){.fd = fd, .ready = on_listener};
    TEST_ASSERT_TRUE(loop_watch(cable->loop, &cable->listener, EPOLLIN));
}

/* The slave stays open here, so that the server may come and go. */
static void open_pty(struct cable *cable)
{
    int fd = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    struct termios raw;
    char name[64];

    TEST_ASSERT_TRUE(fd >= 0 && grantpt(fd) == 0 && unlockpt(fd) == 0);
    TEST_ASSERT_EQUAL_INT(0, ptsname_r(fd, name, sizeof name));
    cable->slave = open(name, O_RDWR | O_NOCTTY | O_CLOEXEC);
    TEST_ASSERT_TRUE(cable->slave >= 0 && tcgetattr(cable->slave, &raw) == 0);
    cfmakeraw(&raw);
    TEST_ASSERT_EQUAL_INT(0, tcsetattr(cable->slave, TCSANOW, &raw));
    unlink(cable->path);
    TEST_ASSERT_EQUAL_INT(0, symlink(name, cable->path));
    serve_one(cable, fd);
}

void cable_open(struct cable *cable, struct loop *loop, enum cable_kind kind, const char *directory,
                unsigned id, uint16_t robot_port)
{
    *cable = (struct cable){
        .kind = kind,
        .loop = loop,
        .listener.fd = -1,
        .server.fd = -1,
        .robot.fd = -1,
        .slave = -1,
        .robot_port = robot_port,
        .random = id,
    };
    snprintf(cable->path, sizeof cable->path, "%s/%s-%u", directory,
             kind == CABLE_NONE ? "robot" : "cable", id);
    snprintf(cable->link, sizeof cable->link, "tty:%s", cable->path);
    cable_plug(cable);
}

void cable_pull(struct cable *cable)
{
    drop(cable, &cable->listener);
    drop_server(cable);
    drop(cable, &cable->robot);
    if (cable->kind == CABLE_PTY)
        unlink(cable->path);
}

void cable_plug(struct cable *cable)
{
    unsigned port = 0;

    if (cable->kind == CABLE_TCP) {
        sscanf(cable->link, "tcp:127.0.0.1:%u", &port);
        open_listener(cable, (uint16_t)port);
    } else if (cable->kind == CABLE_PTY) {
        open_pty(cable);
    }
}

static void on_intruder(struct watch *watch, uint32_t events)
{
    struct cable *cable = CABLE(watch, robot);

    (void)events;
    if (!make_noise(cable, TO_ROBOT, watch))
        drop(cable, watch);
}

/* Only writes: what the robot says is the server's. */
static void intrude(struct cable *cable)
{
    cable->robot = (struct watch){
        .fd = open(cable->path, O_WRONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC),
        .ready = on_intruder,
    };
    TEST_ASSERT_TRUE_MESSAGE(cable->robot.fd >= 0, cable->path);
    TEST_ASSERT_TRUE(loop_watch(cable->loop, &cable->robot, EPOLLOUT));
}

void cable_noise(struct cable *cable, enum cable_way way, size_t bytes)
{
    struct watch *end = way == TO_ROBOT ? &cable->robot : &cable->server;

    cable->noise[way] = bytes;
    if (cable->kind == CABLE_NONE) {
        intrude(cable);
        return;
    }
    TEST_ASSERT_TRUE(end->fd >= 0);
    listen_to(cable, end, true);
}

void cable_close(struct cable *cable)
{
    if (cable->loop != NULL)
        cable_pull(cable);
    *cable = (struct cable){.kind = CABLE_NONE};
}
