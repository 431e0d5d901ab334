#include "fleet.h"

#include "address.h"
#include "endpoint.h"
#include "limits.h"
#include "loop.h"
#include "robot.h"
#include "setpoints.h"
#include "uart.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

/* Ticks that are made up for when the process was held up; those before them are skipped. */
#define CATCH_UP_MAX 10

/* What is read of one robot's link at a tick, so that a flood holds up nobody else. */
#define READ_BYTES 4096
#define READS_MAX 8

struct member {
    struct sim_robot *robot;
    struct endpoint endpoint;
    struct uart uart;
    bool booting;
};

struct fleet {
    struct watch timer, signals;
    struct loop loop;
    const struct fleet_options *options;
    struct avr_image *image, *loader;
    uint16_t slots; /* bytes that a UART takes in a tick */
    size_t count;   /* members that exist */
    struct member *member;
    int arena;
    struct setpoint *setpoints;
    uint8_t *datagram;
    uint64_t skipped; /* ticks */
    enum fleet_end end;
    bool over;
    char *error;
    size_t room;
};

static bool fail(struct fleet *fleet, const char *words)
{
    snprintf(fleet->error, fleet->room, "%s", words);
    return false;
}

static bool fail_by(struct fleet *fleet, const char *what)
{
    snprintf(fleet->error, fleet->room, "%s: %s", what, strerror(errno));
    return false;
}

/* ---- one tick -------------------------------------------------------------------------- */

static void listen_to_host(struct member *member)
{
    uint8_t bytes[READ_BYTES];

    for (int i = 0; i < READS_MAX; i++) {
        size_t count = endpoint_receive(&member->endpoint, bytes, sizeof bytes);

        uart_put(&member->uart, bytes, count);
        if (count == 0)
            return;
    }
}

static struct setpoint run_robot(struct fleet *fleet, struct member *member)
{
    struct robot_period period = {0};
    uint8_t rx[UART_ROOM];

    if (!member->booting) {
        size_t slots = fleet->slots < sizeof rx ? fleet->slots : sizeof rx;
        size_t count = uart_take(&member->uart, rx, slots);

        member->robot->kind->run(member->robot, rx, count, &period);
        endpoint_send(&member->endpoint, period.tx, period.sent);
    }
    member->booting = false;
    if (period.crashed) {
        snprintf(fleet->error, fleet->room, "the processor of robot %u crashed", member->robot->id);
        fleet->end = FLEET_FAILED;
        fleet->over = true;
    }
    return (struct setpoint){member->robot->id, period.left, period.right};
}

static void tick(struct fleet *fleet)
{
    for (size_t i = 0; i < fleet->count; i++)
        fleet->setpoints[i] = run_robot(fleet, &fleet->member[i]);
    if (fleet->arena < 0)
        return;
    setpoints_write(fleet->setpoints, fleet->count, fleet->datagram);
    /* An arena that is not there hears nothing. */
    send(fleet->arena, fleet->datagram, setpoints_bytes(fleet->count), 0);
}

static void on_timer(struct watch *watch, uint32_t events)
{
    struct fleet *fleet = (struct fleet *)watch;
    uint64_t ticks = loop_periods(watch->fd);

    (void)events;
    if (ticks > CATCH_UP_MAX) {
        fleet->skipped += ticks - CATCH_UP_MAX;
        ticks = CATCH_UP_MAX;
    }
    for (size_t i = 0; i < fleet->count; i++)
        listen_to_host(&fleet->member[i]);
    for (; ticks > 0 && !fleet->over; ticks--)
        tick(fleet);
}

/* ---- power ----------------------------------------------------------------------------- */

static bool power_on(struct member *member)
{
    member->booting = true;
    return member->robot->kind->power_on(member->robot);
}

static void reboot(struct fleet *fleet)
{
    for (size_t i = 0; i < fleet->count; i++) {
        struct member *member = &fleet->member[i];

        member->robot->kind->power_off(member->robot);
        member->uart.count = 0;
        if (power_on(member))
            continue;
        fail(fleet, "no memory for the robots");
        fleet->end = FLEET_FAILED;
        fleet->over = true;
    }
}

static void on_signal(struct watch *watch, uint32_t events)
{
    struct fleet *fleet = (struct fleet *)((char *)watch - offsetof(struct fleet, signals));
    int signal = loop_signal(watch->fd);

    (void)events;
    if (signal == SIGUSR1)
        reboot(fleet);
    else if (signal != 0)
        fleet->over = true;
}

/* ---- building -------------------------------------------------------------------------- */

static bool open_arena(struct fleet *fleet)
{
    struct sockaddr_in address;

    if (fleet->options->arena == NULL)
        return true;
    if (!address_read(fleet->options->arena, &address, fleet->error, fleet->room))
        return false;
    fleet->arena = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    return (fleet->arena >= 0 &&
            connect(fleet->arena, (const struct sockaddr *)&address, sizeof address) == 0) ||
           fail_by(fleet, "cannot send to the arena");
}

static bool open_loop(struct fleet *fleet)
{
    static const int numbers[] = {SIGTERM, SIGINT, SIGUSR1, 0};

    if (!loop_open(&fleet->loop))
        return fail_by(fleet, "cannot wait for anything");
    fleet->signals = (struct watch){
        .fd = loop_signals(numbers),
        .urgent = true,
        .ready = on_signal,
    };
    return (fleet->signals.fd >= 0 && loop_watch(&fleet->loop, &fleet->signals, EPOLLIN)) ||
           fail_by(fleet, "cannot wait for signals");
}

/* The 50 Hz begin when everything is there. */
static bool start_timer(struct fleet *fleet)
{
    fleet->timer = (struct watch){.fd = loop_timer(TICK_MS * 1000), .ready = on_timer};
    return (fleet->timer.fd >= 0 && loop_watch(&fleet->loop, &fleet->timer, EPOLLIN)) ||
           fail_by(fleet, "cannot tick");
}

static struct sim_robot *new_robot(struct fleet *fleet, uint16_t id)
{
    if (fleet->loader != NULL)
        return robot_avr_with_loader(id, fleet->image, fleet->loader);
    return fleet->image != NULL ? robot_avr_new(id, fleet->image) : robot_native_new(id);
}

static bool add_member(struct fleet *fleet, uint16_t id)
{
    const struct fleet_options *options = fleet->options;
    struct member *member = &fleet->member[fleet->count];

    member->robot = new_robot(fleet, options->blank ? 0 : id);
    if (member->robot == NULL)
        return fail(fleet, "no memory for the robots");
    fleet->count++;
    char words[256];
    if (!endpoint_open(&member->endpoint, &fleet->loop, options->link, id, options->quiet, words,
                       sizeof words)) {
        snprintf(fleet->error, fleet->room, "robot %u: %s", id, words);
        return false;
    }
    return power_on(member) || fail(fleet, "no memory for the robots");
}

static bool open_images(struct fleet *fleet)
{
    const struct fleet_options *options = fleet->options;

    fleet->slots = link_timing_of(NATIVE_BAUD).slots;
    if (options->firmware == NULL)
        return true;
    fleet->image = avr_image_open(options->firmware, fleet->error, fleet->room);
    if (fleet->image == NULL)
        return false;
    fleet->slots = link_timing_of(avr_image_baud(fleet->image)).slots;
    if (options->loader == NULL)
        return true;
    fleet->loader = avr_image_open(options->loader, fleet->error, fleet->room);
    if (fleet->loader == NULL)
        return false;

    const char *wrong = robot_loader_refuses(fleet->image, fleet->loader);
    if (wrong != NULL)
        snprintf(fleet->error, fleet->room, "%s %s %s; --loader none runs it without",
                 options->firmware, wrong, options->loader);
    return wrong == NULL;
}

static bool build(struct fleet *fleet)
{
    const struct fleet_options *options = fleet->options;

    if (!open_images(fleet))
        return false;
    fleet->member = calloc(options->count, sizeof *fleet->member);
    fleet->setpoints = calloc(options->count, sizeof *fleet->setpoints);
    fleet->datagram = malloc(setpoints_bytes(options->count));
    if (fleet->member == NULL || fleet->setpoints == NULL || fleet->datagram == NULL)
        return fail(fleet, "no memory for the robots");
    if (!open_arena(fleet) || !open_loop(fleet))
        return false;
    for (size_t i = 0; i < options->count; i++)
        if (!add_member(fleet, options->ids[i]))
            return false;
    return start_timer(fleet);
}

static void close_fd(int fd)
{
    if (fd >= 0)
        close(fd);
}

static void demolish(struct fleet *fleet)
{
    for (size_t i = 0; i < fleet->count; i++) {
        endpoint_close(&fleet->member[i].endpoint);
        fleet->member[i].robot->kind->destroy(fleet->member[i].robot);
    }
    close_fd(fleet->timer.fd);
    close_fd(fleet->signals.fd);
    loop_close(&fleet->loop);
    close_fd(fleet->arena);
    if (fleet->image != NULL)
        avr_image_close(fleet->image);
    if (fleet->loader != NULL)
        avr_image_close(fleet->loader);
    free(fleet->member);
    free(fleet->setpoints);
    free(fleet->datagram);
}

/* ---- the run --------------------------------------------------------------------------- */

static void tell_links(const struct fleet *fleet)
{
    for (size_t i = 0; i < fleet->count; i++)
        printf("robot %u: %s\n", fleet->options->ids[i], fleet->member[i].endpoint.link);
    fflush(stdout);
}

static void tell_losses(const struct fleet *fleet)
{
    if (fleet->options->quiet)
        return;
    if (fleet->skipped > 0)
        fprintf(stderr, "muster robot: too slow: %llu ticks were skipped\n",
                (unsigned long long)fleet->skipped);
    for (size_t i = 0; i < fleet->count; i++)
        if (fleet->member[i].uart.lost > 0)
            fprintf(stderr, "muster robot: robot %u: %llu bytes came faster than its UART\n",
                    fleet->options->ids[i], (unsigned long long)fleet->member[i].uart.lost);
}

enum fleet_end fleet_run(const struct fleet_options *options, char *error, size_t room)
{
    struct fleet fleet = {
        .timer.fd = -1,
        .signals.fd = -1,
        .loop = LOOP_CLOSED,
        .options = options,
        .arena = -1,
        .end = FLEET_DONE,
        .error = error,
        .room = room,
    };

    if (build(&fleet)) {
        tell_links(&fleet);
        while (!fleet.over) {
            if (loop_wait(&fleet.loop))
                continue;
            fail_by(&fleet, "waiting failed");
            fleet.end = FLEET_FAILED;
            fleet.over = true;
        }
        tell_losses(&fleet);
    } else {
        fleet.end = FLEET_REFUSED;
    }
    demolish(&fleet);
    return fleet.end;
}
