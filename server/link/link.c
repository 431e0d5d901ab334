#include "link.h"

#include "adapters.h"
#include "frame.h"
#include "stream.h"

#include <assert.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

/* Between two dials. A link that has lived is dialled again at once. */
#define PAUSE_FIRST_US 200000
#define PAUSE_MAX_US 5000000
#define LIVED_US 5000000

/* The most that is sent ahead of the robot's UART. */
#define BURST_US 40000

/* In one wake-up: a link that is flooded must not keep the others waiting. */
#define READ_MAX 4096

/* Between two ticks. When this process was held up for longer, what robots have said meanwhile is
 * still unread: they were not silent. */
#define LISTENED_MAX_US 200000

#define ADAPTERS_PERIOD_US 1000000

struct link {
    struct stream stream; /* the first: see on_ready() */
    struct links *links;
    struct adapter_caller *caller;
    struct link_view view;
    int64_t due_us;   /* waiting: dialled then; dialling: given up then */
    int64_t pause_us; /* that came last */
    int64_t up_us;
    int64_t silent_us; /* since something was heard, as far as we listened */
    int64_t taken_us;  /* when the robot's UART will have taken all that was sent */
    int write_error;   /* told later, so that down() never comes from inside links_send() */
    uint8_t left[LINK_SEND_MAX]; /* what the kernel did not take */
    size_t left_first, left_end;
};

struct links {
    const struct link_owner *owner;
    struct adapters adapters;
    int64_t adapters_us; /* when to read them again */
    int64_t ticked_us;
    struct adapter_caller *callers;
    size_t count;
    struct link link[];
};

static size_t robot_of(const struct link *link)
{
    return (size_t)(link - link->links->link);
}

static const struct adapter *adapter_of(const struct link *link)
{
    return &link->links->adapters.adapter[link->caller->own];
}

static void say(struct link *link, const char *words)
{
    snprintf(link->view.words, sizeof link->view.words, "%s", words);
}

/* With the adapter that tried: the next one to try may be another. */
static void say_error(struct link *link, int error)
{
    const char *words = link->stream.kind->words(error);

    if (words == NULL)
        words = strerror(error);
    if (link->caller->bluetooth)
        snprintf(link->view.words, sizeof link->view.words, "hci%d: %s",
                 adapter_of(link)->seen.number, words);
    else
        say(link, words);
}

static void write_address(struct link *link)
{
    const struct link_settings *settings = link->stream.settings;
    struct link_view *view = &link->view;

    link_address_write(&settings->address, view->address, sizeof view->address);
    if (settings->address.kind == LINK_RFCOMM) {
        size_t length = strlen(view->address);
        snprintf(view->address + length, sizeof view->address - length, " by hci%d",
                 adapter_of(link)->seen.number);
    }
}

static void back_off(struct link *link, int64_t now_us)
{
    int64_t longer = link->pause_us == 0 ? PAUSE_FIRST_US : 2 * link->pause_us;

    link->pause_us = longer < PAUSE_MAX_US ? longer : PAUSE_MAX_US;
    link->due_us = now_us + link->pause_us;
}

static void hang_up(struct link *link)
{
    loop_forget(link->stream.loop, &link->stream.watch);
    link->stream.kind->hang_up(&link->stream);
}

static void wait_again(struct link *link)
{
    link->view.state = LINK_WAITING;
    link->caller->waits = true;
    link->caller->due_us = link->due_us;
}

static void fail(struct link *link, int error, int64_t now_us)
{
    bool absent = error == EHOSTDOWN || error == ETIMEDOUT;

    hang_up(link);
    say_error(link, error);
    back_off(link, now_us);
    wait_again(link);
    if (link->caller->bluetooth) {
        adapters_end(&link->links->adapters, link->caller, absent ? ADAPTER_ABSENT : ADAPTER_FAILED,
                     now_us);
        write_address(link);
    }
}

/* `words` are said already. */
static void lose(struct link *link, int64_t now_us)
{
    const struct link_owner *owner = link->links->owner;

    hang_up(link);
    if (now_us - link->up_us > LIVED_US) {
        link->pause_us = 0;
        link->due_us = now_us;
    } else {
        back_off(link, now_us);
    }
    wait_again(link);
    if (link->caller->bluetooth)
        adapters_lose(&link->links->adapters, link->caller);
    owner->down(owner->context, robot_of(link), link->view.words);
}

static void rise(struct link *link, int64_t now_us)
{
    const struct link_owner *owner = link->links->owner;
    const struct stream_kind *kind = link->stream.kind;

    if (!loop_watch(link->stream.loop, &link->stream.watch, EPOLLIN)) {
        fail(link, errno, now_us);
        return;
    }
    const char *amiss = kind->settle != NULL ? kind->settle(&link->stream) : NULL;
    if (link->caller->bluetooth)
        adapters_end(&link->links->adapters, link->caller, ADAPTER_CONNECTED, now_us);
    link->view.state = LINK_UP;
    link->view.connects++;
    link->up_us = now_us;
    link->silent_us = 0;
    link->write_error = 0;
    link->left_first = link->left_end = 0;
    say(link, amiss != NULL ? amiss : "");
    owner->up(owner->context, robot_of(link));
}

static void advance(struct link *link, enum stream_step step, int64_t now_us)
{
    struct stream *stream = &link->stream;

    if (step == STREAM_CONNECTED)
        rise(link, now_us);
    else if (step == STREAM_FAILED || !loop_watch(stream->loop, &stream->watch, stream->awaited))
        fail(link, errno, now_us);
}

static void dial(struct link *link, int64_t now_us)
{
    struct links *links = link->links;
    const struct stream_kind *kind = link->stream.kind;

    link->view.state = LINK_DIALLING;
    link->caller->waits = false;
    link->due_us = now_us + kind->patience_us;
    if (link->caller->bluetooth) {
        memcpy(link->stream.adapter, adapter_of(link)->seen.address, sizeof link->stream.adapter);
        write_address(link);
        adapters_begin(&links->adapters, link->caller, now_us);
    }
    advance(link, kind->dial(&link->stream), now_us);
}

static ssize_t write_some(struct link *link, const uint8_t *bytes, size_t count)
{
    int fd = link->stream.watch.fd;
    ssize_t taken = link->stream.kind->is_socket ? send(fd, bytes, count, MSG_NOSIGNAL)
                                                 : write(fd, bytes, count);

    if (taken >= 0)
        return taken;
    if (errno != EAGAIN && errno != EINTR)
        link->write_error = errno;
    return 0;
}

static void write_left(struct link *link)
{
    size_t count = link->left_end - link->left_first;

    link->left_first += (size_t)write_some(link, link->left + link->left_first, count);
    if (link->left_first == link->left_end &&
        !loop_watch(link->stream.loop, &link->stream.watch, EPOLLIN))
        link->write_error = errno;
}

/* A broken RFCOMM link tells its error once, to whoever asks first: here or in write_some(). A tty
 * that is at its end is gone. */
static void end(struct link *link, int read_error, int64_t now_us)
{
    int error = link->write_error;

    if (error == 0)
        error = read_error;
    if (error == 0)
        error = link->stream.kind->is_socket ? stream_error(&link->stream) : EIO;
    if (error == 0)
        say(link, "the robot's side closed the link");
    else
        say_error(link, error);
    lose(link, now_us);
}

static void read_some(struct link *link, uint32_t events, int64_t now_us)
{
    const struct link_owner *owner = link->links->owner;
    uint8_t bytes[READ_MAX];
    ssize_t count = read(link->stream.watch.fd, bytes, sizeof bytes);

    if (count > 0) {
        link->view.received += (uint64_t)count;
        link->view.heard_us = now_us;
        link->silent_us = 0;
        owner->received(owner->context, robot_of(link), bytes, (size_t)count);
        return;
    }
    bool nothing = count < 0 && (errno == EAGAIN || errno == EINTR);
    if (nothing && (events & (EPOLLHUP | EPOLLERR)) == 0)
        return;
    end(link, count == 0 || nothing ? 0 : errno, now_us);
}

static void on_ready(struct watch *watch, uint32_t events)
{
    struct link *link = (struct link *)watch;
    int64_t now_us = loop_now();

    if (link->view.state == LINK_DIALLING) {
        advance(link, link->stream.kind->go_on(&link->stream, events, now_us), now_us);
        return;
    }
    if ((events & EPOLLOUT) != 0)
        write_left(link);
    if ((events & ~(uint32_t)EPOLLOUT) != 0)
        read_some(link, events, now_us);
    else if (link->write_error != 0)
        end(link, 0, now_us);
}

static const struct stream_kind *kind_of(enum link_kind kind)
{
    switch (kind) {
    case LINK_RFCOMM: return &stream_rfcomm;
    case LINK_TTY: return &stream_tty;
    case LINK_TCP: break;
    }
    return &stream_tcp;
}

static struct links *allocate(size_t count)
{
    struct links *links = calloc(1, sizeof *links + count * sizeof links->link[0]);

    if (links == NULL)
        return NULL;
    links->callers = calloc(count > 0 ? count : 1, sizeof *links->callers);
    if (links->callers == NULL) {
        free(links);
        return NULL;
    }
    return links;
}

static void begin(struct links *links, size_t robot, struct loop *loop,
                  const struct link_settings *settings)
{
    struct link *link = &links->link[robot];

    assert(settings->baud >= 10);
    link->links = links;
    link->caller = &links->callers[robot];
    link->caller->bluetooth = settings->address.kind == LINK_RFCOMM;
    link->caller->wanted = settings->adapter;
    link->caller->waits = true;
    link->stream.loop = loop;
    link->stream.settings = settings;
    link->stream.kind = kind_of(settings->address.kind);
    link->stream.watch.fd = -1;
    link->stream.watch.ready = on_ready;
    say(link, "no answer yet");
}

static bool prepare(struct links *links, char *error, size_t room)
{
    struct adapters *adapters = &links->adapters;
    struct link_adapter list[LINK_ADAPTERS_MAX];

    adapters_refresh(adapters, list, adapters_read(list), links->callers, 0);
    if (!adapters_spread(adapters, links->callers, links->count, error, room))
        return false;
    for (size_t i = 0; i < links->count; i++) {
        struct stream *stream = &links->link[i].stream;

        write_address(&links->link[i]);
        if (stream->kind->prepare != NULL && !stream->kind->prepare(stream, error, room))
            return false;
    }
    return true;
}

static void release(struct links *links)
{
    for (size_t i = 0; i < links->count; i++) {
        struct stream *stream = &links->link[i].stream;

        if (stream->kind->release != NULL)
            stream->kind->release(stream);
    }
    free(links->callers);
    free(links);
}

struct links *links_open(struct loop *loop, const struct link_settings *settings, size_t count,
                         const struct link_owner *owner, char *error, size_t room)
{
    struct links *links = allocate(count);

    if (links == NULL) {
        snprintf(error, room, "no memory for %zu links", count);
        return NULL;
    }
    links->owner = owner;
    links->count = count;
    for (size_t i = 0; i < count; i++)
        begin(links, i, loop, &settings[i]);
    if (!prepare(links, error, room)) {
        release(links);
        return NULL;
    }
    return links;
}

static void watch_over(struct link *link, int64_t listened_us, int64_t now_us)
{
    link->silent_us += listened_us;
    if (link->write_error != 0) {
        end(link, 0, now_us);
    } else if (link->silent_us > LINK_SILENCE_US) {
        snprintf(link->view.words, sizeof link->view.words,
                 "nothing heard for %d s: is the robot on, at this baud rate, and in reach?",
                 LINK_SILENCE_US / 1000000);
        lose(link, now_us);
    }
}

static void hurry(struct link *link, int64_t now_us)
{
    if (now_us >= link->due_us)
        fail(link, ETIMEDOUT, now_us);
    else if (link->stream.kind->go_on != NULL)
        advance(link, link->stream.kind->go_on(&link->stream, 0, now_us), now_us);
}

static void read_adapters(struct links *links, int64_t now_us)
{
    struct link_adapter list[LINK_ADAPTERS_MAX];

    if (now_us < links->adapters_us)
        return;
    links->adapters_us = now_us + ADAPTERS_PERIOD_US;
    adapters_refresh(&links->adapters, list, adapters_read(list), links->callers, links->count);
    for (size_t i = 0; i < links->count; i++) {
        struct link *link = &links->link[i];

        if (!link->caller->bluetooth || !link->caller->waits)
            continue;
        write_address(link);
        if (!adapter_of(link)->seen.up)
            say_error(link, ENETDOWN);
    }
}

static void dial_bluetooth(struct links *links, int64_t now_us)
{
    read_adapters(links, now_us);
    for (size_t i = 0; i < links->count; i++) {
        size_t next = adapters_next(&links->adapters, links->callers, links->count, now_us);

        if (next == links->count)
            return;
        dial(&links->link[next], now_us);
    }
}

void links_tick(struct links *links, int64_t now_us)
{
    bool bluetooth = false;
    int64_t listened_us = now_us - links->ticked_us;

    if (listened_us > LISTENED_MAX_US)
        listened_us = LISTENED_MAX_US;
    links->ticked_us = now_us;
    for (size_t i = 0; i < links->count; i++) {
        struct link *link = &links->link[i];

        if (link->view.state == LINK_UP)
            watch_over(link, listened_us, now_us);
        else if (link->view.state == LINK_DIALLING)
            hurry(link, now_us);
        else if (link->caller->bluetooth)
            bluetooth = true;
        else if (now_us >= link->due_us)
            dial(link, now_us);
    }
    if (bluetooth)
        dial_bluetooth(links, now_us);
}

/* What may be ahead of the UART: BURST_US, but any frame at least. */
static int64_t burst_us(uint32_t baud)
{
    int64_t frame_us = FRAME_BYTES_MAX * INT64_C(10000000) / baud + 1;

    return frame_us > BURST_US ? frame_us : BURST_US;
}

size_t links_room(struct links *links, size_t robot, int64_t now_us)
{
    struct link *link = &links->link[robot];
    uint32_t baud = link->stream.settings->baud;

    if (link->view.state != LINK_UP || link->write_error != 0 || link->left_first < link->left_end)
        return 0;
    if (link->taken_us < now_us)
        link->taken_us = now_us;
    int64_t free_us = burst_us(baud) - (link->taken_us - now_us);
    if (free_us <= 0)
        return 0;
    int64_t bytes = free_us * baud / 10000000;
    return bytes < LINK_SEND_MAX ? (size_t)bytes : LINK_SEND_MAX;
}

void links_send(struct links *links, size_t robot, const uint8_t *bytes, size_t count)
{
    struct link *link = &links->link[robot];

    assert(count <= LINK_SEND_MAX);
    if (count == 0 || link->view.state != LINK_UP || link->left_first < link->left_end)
        return;
    size_t taken = (size_t)write_some(link, bytes, count);
    if (link->write_error != 0)
        return;
    link->view.sent += count;
    link->taken_us += (int64_t)count * 10000000 / link->stream.settings->baud + 1;
    if (taken == count)
        return;
    link->left_first = 0;
    link->left_end = count - taken;
    memcpy(link->left, bytes + taken, link->left_end);
    if (!loop_watch(link->stream.loop, &link->stream.watch, EPOLLIN | EPOLLOUT))
        link->write_error = errno;
}

const struct link_view *links_look(const struct links *links, size_t robot)
{
    return &links->link[robot].view;
}

size_t links_adapters(const struct links *links, struct link_adapter adapters[LINK_ADAPTERS_MAX])
{
    if (links == NULL)
        return adapters_read(adapters);
    for (size_t i = 0; i < links->adapters.count; i++)
        adapters[i] = links->adapters.adapter[i].seen;
    return links->adapters.count;
}

void links_close(struct links *links)
{
    const struct link_owner *owner = links->owner;

    for (size_t i = 0; i < links->count; i++) {
        struct link *link = &links->link[i];
        bool up = link->view.state == LINK_UP;

        hang_up(link);
        link->view.state = LINK_WAITING;
        say(link, "closed");
        if (up)
            owner->down(owner->context, i, link->view.words);
    }
    release(links);
}
