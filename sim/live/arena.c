#include "arena.h"

#include "address.h"
#include "cameras.h"
#include "clients.h"
#include "ground.h"
#include "loop.h"
#include "natnet_server.h"

#include <arpa/inet.h>
#include <errno.h>
#include <signal.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#define LINE_MAX_BYTES 80

#define OWNER(watch, member) ((struct arena *)((char *)(watch)-offsetof(struct arena, member)))

struct arena {
    struct loop loop;
    struct watch timer, signals, input;
    struct watch natnet; /* clients ask here; frames to each of them leave from here */
    struct watch robots; /* set-points come here */
    int data;            /* multicast frames leave from here */
    const struct arena_options *options;
    struct ground *ground;
    struct cameras *cameras;
    struct natnet_server server;
    struct clients clients;
    struct sockaddr_in group;
    size_t line_length;
    char line[LINE_MAX_BYTES];
    uint8_t datagram[NATNET_DATAGRAM_MAX];
    bool over;
    char *error;
    size_t room;
};

static bool fail(struct arena *arena, const char *words)
{
    snprintf(arena->error, arena->room, "%s", words);
    return false;
}

static bool fail_by(struct arena *arena, const char *what)
{
    snprintf(arena->error, arena->room, "%s: %s", what, strerror(errno));
    return false;
}

/* ---- while it runs --------------------------------------------------------------------- */

static void send_frame(struct arena *arena, int64_t now_us)
{
    const struct capture_frame *frame = cameras_frame(arena->cameras);
    size_t count =
        natnet_server_frame(&arena->server, frame, arena->datagram, sizeof arena->datagram);

    if (arena->server.multicast) {
        sendto(arena->data, arena->datagram, count, 0, (const struct sockaddr *)&arena->group,
               sizeof arena->group);
        return;
    }
    clients_judge(&arena->clients, now_us);
    for (int i = 0; i < arena->clients.count; i++) {
        const struct sockaddr_in *to = &arena->clients.client[i].address;

        sendto(arena->natnet.fd, arena->datagram, count, 0, (const struct sockaddr *)to,
               sizeof *to);
    }
}

static void on_timer(struct watch *watch, uint32_t events)
{
    struct arena *arena = OWNER(watch, timer);
    uint64_t periods = loop_periods(watch->fd);
    int64_t now_us = loop_now();

    (void)events;
    if (periods == 0)
        return;
    ground_move(arena->ground, now_us);
    cameras_look(arena->cameras, arena->ground, periods, now_us);
    if (!cameras_frozen(arena->cameras))
        send_frame(arena, now_us);
}

static void on_setpoints(struct watch *watch, uint32_t events)
{
    struct arena *arena = OWNER(watch, robots);
    ssize_t length = recv(watch->fd, arena->datagram, sizeof arena->datagram, 0);
    int64_t now_us = loop_now();
    size_t count;

    (void)events;
    if (length < 0 || !setpoints_count(arena->datagram, (size_t)length, &count))
        return;
    for (size_t i = 0; i < count; i++)
        ground_set(arena->ground, setpoints_read(arena->datagram, i), now_us);
}

static void welcome(struct arena *arena, const struct sockaddr_in *from, int64_t now_us)
{
    char text[ADDRESS_TEXT_MAX];

    if (arena->server.multicast || !clients_hear(&arena->clients, from, now_us))
        return;
    address_write(from, text);
    if (!arena->options->quiet)
        fprintf(stderr, "muster arena: frames go to %s\n", text);
}

static void on_request(struct watch *watch, uint32_t events)
{
    struct arena *arena = OWNER(watch, natnet);
    struct sockaddr_in from;
    uint8_t request[512];
    ssize_t length = recvfrom(watch->fd, request, sizeof request, 0, (struct sockaddr *)&from,
                              &(socklen_t){sizeof from});
    int64_t now_us = loop_now();
    bool client;

    (void)events;
    if (length < 0)
        return;
    size_t count = natnet_server_answer(
        &arena->server, cameras_frame(arena->cameras), cameras_time(arena->cameras, now_us),
        request, (size_t)length, arena->datagram, sizeof arena->datagram, &client);
    if (client)
        welcome(arena, &from, now_us);
    if (count > 0)
        sendto(watch->fd, arena->datagram, count, 0, (const struct sockaddr *)&from, sizeof from);
}

static void obey(struct arena *arena)
{
    char words[256];

    arena->line[arena->line_length] = '\0';
    if (arena->line_length > 0 &&
        !cameras_command(arena->cameras, arena->line, loop_now(), words, sizeof words))
        fprintf(stderr, "muster arena: %s\n", words);
    arena->line_length = 0;
}

/* Of a line that is too long the beginning is kept, which is no command. */
static void on_input(struct watch *watch, uint32_t events)
{
    struct arena *arena = OWNER(watch, input);
    char bytes[256];
    ssize_t count = read(watch->fd, bytes, sizeof bytes);

    (void)events;
    if (count <= 0) {
        loop_forget(&arena->loop, watch);
        return;
    }
    for (ssize_t i = 0; i < count; i++) {
        if (bytes[i] == '\n')
            obey(arena);
        else if (arena->line_length < LINE_MAX_BYTES - 1)
            arena->line[arena->line_length++] = bytes[i];
    }
}

static void on_signal(struct watch *watch, uint32_t events)
{
    (void)events;
    OWNER(watch, signals)->over = true;
}

/* ---- opening --------------------------------------------------------------------------- */

static int open_socket(struct arena *arena, uint16_t port, bool shared)
{
    struct sockaddr_in address;
    const int on = 1;

    if (!address_of(arena->options->interface, port, &address, arena->error, arena->room))
        return -1;
    int fd = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (fd < 0 || (shared && setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) != 0) ||
        bind(fd, (const struct sockaddr *)&address, sizeof address) != 0) {
        snprintf(arena->error, arena->room, "cannot have port %u of %s: %s", port,
                 arena->options->interface, strerror(errno));
        close(fd);
        return -1;
    }
    return fd;
}

/* Those who listen on this machine have the data port as well. */
static bool open_group(struct arena *arena)
{
    arena->server.multicast = arena->options->group != NULL;
    if (!arena->server.multicast)
        return true;
    arena->data = open_socket(arena, arena->options->data_port, true);
    if (arena->data < 0)
        return false;
    struct sockaddr_in from = address_bound(arena->data);
    arena->group = from;
    if (inet_pton(AF_INET, arena->options->group, &arena->group.sin_addr) != 1 ||
        !IN_MULTICAST(ntohl(arena->group.sin_addr.s_addr))) {
        snprintf(arena->error, arena->room,
                 "%s is no group; 224.0.0.0 to 239.255.255.255 is allowed", arena->options->group);
        return false;
    }
    memcpy(arena->server.group, &arena->group.sin_addr, sizeof arena->server.group);
    arena->server.data_port = ntohs(from.sin_port);
    return setsockopt(arena->data, IPPROTO_IP, IP_MULTICAST_IF, &from.sin_addr,
                      sizeof from.sin_addr) == 0 ||
           fail_by(arena, "cannot send to the group");
}

static bool open_sockets(struct arena *arena)
{
    arena->natnet = (struct watch){
        .fd = open_socket(arena, arena->options->port, false),
        .ready = on_request,
    };
    if (arena->natnet.fd < 0)
        return false;
    arena->robots = (struct watch){
        .fd = open_socket(arena, arena->options->robots_port, false),
        .urgent = true,
        .ready = on_setpoints,
    };
    if (arena->robots.fd < 0)
        return false;
    if (!open_group(arena))
        return false;
    if (!arena->server.multicast)
        arena->server.data_port = ntohs(address_bound(arena->natnet.fd).sin_port);
    return (loop_watch(&arena->loop, &arena->natnet, EPOLLIN) &&
            loop_watch(&arena->loop, &arena->robots, EPOLLIN)) ||
           fail_by(arena, "cannot wait for datagrams");
}

static bool open_loop(struct arena *arena)
{
    static const int numbers[] = {SIGTERM, SIGINT, 0};

    if (!loop_open(&arena->loop))
        return fail_by(arena, "cannot wait for anything");
    arena->signals = (struct watch){
        .fd = loop_signals(numbers),
        .urgent = true,
        .ready = on_signal,
    };
    arena->timer = (struct watch){
        .fd = loop_timer(1000000 / arena->options->rate),
        .ready = on_timer,
    };
    /* In the background the terminal's lines are the shell's: reading them must not stop us. */
    signal(SIGTTIN, SIG_IGN);
    arena->input = (struct watch){.fd = STDIN_FILENO, .ready = on_input};
    /* An input that cannot be waited for, such as /dev/null, has no commands. */
    loop_watch(&arena->loop, &arena->input, EPOLLIN);
    return (arena->signals.fd >= 0 && loop_watch(&arena->loop, &arena->signals, EPOLLIN) &&
            arena->timer.fd >= 0 && loop_watch(&arena->loop, &arena->timer, EPOLLIN)) ||
           fail_by(arena, "cannot wait for signals and the time");
}

static bool build(struct arena *arena)
{
    const struct arena_options *options = arena->options;
    int64_t now_us = loop_now();

    memcpy(arena->server.version, options->version, sizeof arena->server.version);
    if (options->scenario->robot_count > CAPTURE_BODIES_MAX) {
        snprintf(arena->error, arena->room, "%zu robots; a frame holds %d",
                 options->scenario->robot_count, CAPTURE_BODIES_MAX);
        return false;
    }
    arena->ground = ground_new(options->scenario, now_us);
    arena->cameras = cameras_new(options->scenario, options->y_up, now_us);
    if (arena->ground == NULL || arena->cameras == NULL)
        return fail(arena, "no memory for the robots");
    cameras_look(arena->cameras, arena->ground, 0, now_us);
    return open_loop(arena) && open_sockets(arena);
}

static void close_fd(int fd)
{
    if (fd >= 0)
        close(fd);
}

static void demolish(struct arena *arena)
{
    close_fd(arena->timer.fd);
    close_fd(arena->signals.fd);
    close_fd(arena->natnet.fd);
    close_fd(arena->robots.fd);
    close_fd(arena->data);
    loop_close(&arena->loop);
    ground_free(arena->ground);
    cameras_free(arena->cameras);
    free(arena);
}

/* ---- the run --------------------------------------------------------------------------- */

static void tell_addresses(const struct arena *arena)
{
    char natnet[ADDRESS_TEXT_MAX], data[ADDRESS_TEXT_MAX], robots[ADDRESS_TEXT_MAX];
    struct sockaddr_in at = address_bound(arena->natnet.fd);

    address_write(&at, natnet);
    address_write(arena->server.multicast ? &arena->group : &at, data);
    at = address_bound(arena->robots.fd);
    address_write(&at, robots);
    printf("arena: natnet %s, data %s (%s), robots %s\n", natnet, data,
           arena->server.multicast ? "multicast" : "unicast", robots);
    fflush(stdout);
}

enum arena_end arena_run(const struct arena_options *options, char *error, size_t room)
{
    struct arena *arena = calloc(1, sizeof *arena);
    enum arena_end end = ARENA_REFUSED;

    if (arena == NULL) {
        snprintf(error, room, "no memory");
        return ARENA_FAILED;
    }
    arena->options = options;
    arena->error = error;
    arena->room = room;
    arena->timer.fd = arena->signals.fd = arena->natnet.fd = arena->robots.fd = -1;
    arena->data = -1;
    arena->loop = (struct loop)LOOP_CLOSED;
    if (build(arena)) {
        end = ARENA_DONE;
        tell_addresses(arena);
        while (end == ARENA_DONE && !arena->over)
            if (!loop_wait(&arena->loop)) {
                fail_by(arena, "waiting failed");
                end = ARENA_FAILED;
            }
    }
    demolish(arena);
    return end;
}
