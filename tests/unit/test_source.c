#include "source.h"

#include "natnet.h"
#include "natnet_writer.h"
#include "random.h"
#include "socket.h"

#include <arpa/inet.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>
#include <unity.h>

#define PATIENCE_US 20000000
#define SECOND INT64_C(1000000)

static const uint8_t group[] = {239, 255, 77, 1};

/* A protocol that is as simple as can be: messages of four bytes, an `F` with body, number and time
 * in 10 ms; or `B` and `R`: broken, refused; and `E`, which never ends. It asks `?` once a
 * connection. */
struct beads {
    bool asked;
};

static void beads_begin(void *session, const struct capture_options *options)
{
    (void)options;
    ((struct beads *)session)->asked = false;
}

static enum capture_news beads_take(void *session, const uint8_t *bytes, size_t count, size_t *used,
                                    struct capture_frame *frame, char words[CAPTURE_WORDS_MAX])
{
    (void)session;
    bool endless = count > 0 && bytes[0] == 'E';
    *used = endless || count < 4 ? 0 : 4;
    if (*used == 0)
        return CAPTURE_NOTHING;
    *frame = (struct capture_frame){.numbered = true, .number = bytes[2], .count = 1};
    frame->time = bytes[3] * 0.01;
    frame->body[0].id = bytes[1];
    snprintf(words, CAPTURE_WORDS_MAX, "bead %c", bytes[0]);
    switch (bytes[0]) {
    case 'F': return CAPTURE_FRAME;
    case 'B': return CAPTURE_BROKEN;
    case 'R': return CAPTURE_REFUSED;
    default: return CAPTURE_NOTHING;
    }
}

static size_t beads_ask(void *session, int64_t now_us, uint8_t *bytes, size_t room)
{
    struct beads *beads = session;

    (void)now_us;
    (void)room;
    if (beads->asked)
        return 0;
    beads->asked = true;
    bytes[0] = '?';
    return 1;
}

static struct capture_protocol beads(bool stream, uint16_t port, bool asks)
{
    return (struct capture_protocol){
        .name = "beads",
        .stream = stream,
        .port = port,
        .session_bytes = sizeof(struct beads),
        .begin = beads_begin,
        .take = beads_take,
        .ask = asks ? beads_ask : NULL,
    };
}

#define LINES 64
#define FRAMES 1024

static struct loop loop;
static struct source *source;
static struct source_settings settings;
static struct capture_protocol protocol;
static struct natnet_writer writer;
static char error[512];
static char lines[LINES][384];
static size_t line_count, problems;
static struct {
    uint32_t number;
    int32_t id;
    int64_t arrival_us;
} frames[FRAMES];
static size_t frame_count;
static struct watch timer;
static int sockets[8];
static size_t socket_count;

static void take_frame(void *context, const struct capture_frame *frame, int64_t arrival_us)
{
    (void)context;
    TEST_ASSERT_TRUE(frame_count < FRAMES);
    frames[frame_count].number = frame->number;
    frames[frame_count].id = frame->count > 0 ? frame->body[0].id : -1;
    frames[frame_count++].arrival_us = arrival_us;
}

static void say(void *context, bool problem, const char *words)
{
    (void)context;
    TEST_ASSERT_TRUE(line_count < LINES);
    problems += problem;
    snprintf(lines[line_count++], sizeof lines[0], "%s", words);
}

static const struct source_owner owner = {NULL, take_frame, say};

static void tick(struct watch *watch, uint32_t events)
{
    (void)events;
    loop_periods(watch->fd);
    if (source != NULL)
        source_tick(source, loop_now());
}

void setUp(void)
{
    settings = (struct source_settings){.protocol = &natnet_protocol, .server = "127.0.0.1"};
    source = NULL;
    line_count = problems = frame_count = socket_count = 0;
    error[0] = '\0';
    TEST_ASSERT_TRUE(loop_open(&loop));
    timer = (struct watch){.fd = loop_timer(20000), .ready = tick};
    TEST_ASSERT_TRUE(loop_watch(&loop, &timer, EPOLLIN));
}

void tearDown(void)
{
    source_close(source);
    loop_forget(&loop, &timer);
    close(timer.fd);
    loop_close(&loop);
    for (size_t i = 0; i < socket_count; i++)
        close(sockets[i]);
}

static int keep(int fd)
{
    TEST_ASSERT_TRUE(fd >= 0);
    TEST_ASSERT_TRUE(socket_count < sizeof sockets / sizeof *sockets);
    sockets[socket_count++] = fd;
    return fd;
}

/* A socket of the system at such an address, on a port of its own. */
static int bound(int type, const char *address, uint16_t *port)
{
    struct sockaddr_in ours = {.sin_family = AF_INET};
    socklen_t length = sizeof ours;
    int fd = keep(socket(AF_INET, type, 0));

    TEST_ASSERT_EQUAL_INT(1, inet_pton(AF_INET, address, &ours.sin_addr));
    TEST_ASSERT_EQUAL_INT(0, bind(fd, (struct sockaddr *)&ours, length));
    TEST_ASSERT_EQUAL_INT(0, getsockname(fd, (struct sockaddr *)&ours, &length));
    *port = ntohs(ours.sin_port);
    return fd;
}

/* A port that is free now. */
static uint16_t free_port(int type)
{
    uint16_t port;

    close(bound(type, "127.0.0.1", &port));
    socket_count--;
    return port;
}

static void open_source(void)
{
    source = source_open(&loop, &settings, &owner, error, sizeof error);
    TEST_ASSERT_NOT_NULL_MESSAGE(source, error);
}

static const char *said(const char *part)
{
    for (size_t i = 0; i < line_count; i++)
        if (strstr(lines[i], part) != NULL)
            return lines[i];
    return NULL;
}

static void wait_for_frames(size_t count)
{
    int64_t deadline_us = loop_now() + PATIENCE_US;

    while (frame_count < count) {
        TEST_ASSERT_TRUE_MESSAGE(loop_now() < deadline_us, source_words(source));
        TEST_ASSERT_TRUE(loop_wait(&loop));
    }
}

static void wait_for_words(const char *part)
{
    int64_t deadline_us = loop_now() + PATIENCE_US;

    while (said(part) == NULL) {
        TEST_ASSERT_TRUE_MESSAGE(loop_now() < deadline_us, part);
        TEST_ASSERT_TRUE(loop_wait(&loop));
    }
}

/* What the source sends next to the system, which is never nothing. */
static size_t heard(int fd, uint8_t *bytes, size_t room, struct sockaddr_in *asker)
{
    int64_t deadline_us = loop_now() + PATIENCE_US;
    socklen_t length = sizeof *asker;
    ssize_t count;

    while ((count = recvfrom(fd, bytes, room, MSG_DONTWAIT, (struct sockaddr *)asker, &length)) <
           0) {
        TEST_ASSERT_TRUE(loop_now() < deadline_us);
        TEST_ASSERT_TRUE(loop_wait(&loop));
    }
    return (size_t)count;
}

static void wait_for_request(int fd, uint8_t id, struct sockaddr_in *asker)
{
    uint8_t bytes[CAPTURE_ASK_MAX];

    do {
        TEST_ASSERT_TRUE(heard(fd, bytes, sizeof bytes, asker) >= 4);
    } while (bytes[0] != id);
}

static void send_to(int fd, const void *bytes, size_t count, const struct sockaddr_in *to)
{
    TEST_ASSERT_EQUAL_INT(count, sendto(fd, bytes, count, 0, (const struct sockaddr *)to,
                                        to != NULL ? sizeof *to : 0));
}

static void send_bead(int fd, const struct sockaddr_in *to, char kind, uint8_t id, uint8_t number)
{
    send_to(fd, (const uint8_t[]){(uint8_t)kind, id, number, 0}, 4, to);
}

static void send_frame(int fd, const struct sockaddr_in *to, int32_t number)
{
    static const struct written_body body = {3, "mu-03", {1, 2, 3}, {0, 0, 0, 1}, true};
    struct written_frame frame = {.number = number, .count = 1, .body = &body};

    natnet_write_frame(&writer, &frame);
    send_to(fd, writer.bytes, writer.count, to);
}

/* A NatNet 3.0 system that has been asked and has answered. */
static int answering_system(bool multicast, uint16_t data_port, struct sockaddr_in *asker)
{
    int fd = bound(SOCK_DGRAM, "127.0.0.1", &settings.port);

    open_source();
    wait_for_request(fd, 0, asker);
    writer.major = 3;
    writer.minor = 0;
    natnet_write_server(&writer, multicast, data_port, group);
    send_to(fd, writer.bytes, writer.count, asker);
    return fd;
}

static struct sockaddr_in loopback(uint16_t port)
{
    return (struct sockaddr_in){
        .sin_family = AF_INET, .sin_addr.s_addr = htonl(INADDR_LOOPBACK), .sin_port = htons(port)};
}

/* A source that listens to beads, and a socket that sends them. */
static int listening_source(struct sockaddr_in *to)
{
    uint16_t port = free_port(SOCK_DGRAM), ours;

    protocol = beads(false, port, false);
    settings.protocol = &protocol;
    settings.server = NULL;
    open_source();
    *to = loopback(port);
    return bound(SOCK_DGRAM, "127.0.0.1", &ours);
}

static void test_unicast(void)
{
    struct sockaddr_in asker;

    settings.options.unicast = true;
    int fd = answering_system(false, 1511, &asker);
    wait_for_request(fd, 4, &asker);
    wait_for_request(fd, 10, &asker);
    int64_t before_us = loop_now();
    send_frame(fd, &asker, 7);
    wait_for_frames(1);
    TEST_ASSERT_EQUAL_UINT(7, frames[0].number);
    TEST_ASSERT_TRUE(frames[0].arrival_us >= before_us - 1000);
    TEST_ASSERT_TRUE(frames[0].arrival_us <= loop_now());
    TEST_ASSERT_NOT_NULL(said("Motive 2.1, NatNet 3.0"));
    TEST_ASSERT_NOT_NULL(said("first frame after"));
    TEST_ASSERT_EQUAL_UINT(0, problems);
}

static void test_multicast(void)
{
    struct sockaddr_in asker, to = {.sin_family = AF_INET};
    struct in_addr ours = {htonl(INADDR_LOOPBACK)};

    to.sin_port = htons(free_port(SOCK_DGRAM));
    memcpy(&to.sin_addr, group, sizeof group);
    settings.interface = "lo";
    int fd = answering_system(true, ntohs(to.sin_port), &asker);
    TEST_ASSERT_EQUAL_INT(0, setsockopt(fd, IPPROTO_IP, IP_MULTICAST_IF, &ours, sizeof ours));
    wait_for_request(fd, 4, &asker);
    for (int32_t i = 0; frame_count == 0; i++) { /* until it has joined */
        send_frame(fd, &to, i);
        TEST_ASSERT_TRUE(loop_wait(&loop));
    }
    const char *words = said("first frame after");
    TEST_ASSERT_NOT_NULL(words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "joined 239.255.77.1:"), words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, " on 127.0.0.1"), words);
}

/* What others here have joined is not ours to hear. */
static void test_another_group_on_the_same_port(void)
{
    struct sockaddr_in asker, to = {.sin_family = AF_INET};
    struct in_addr ours = {htonl(INADDR_LOOPBACK)};
    struct ip_mreq other = {.imr_interface = ours};
    uint16_t port;

    to.sin_port = htons(free_port(SOCK_DGRAM));
    settings.interface = "127.0.0.1";
    int fd = answering_system(true, ntohs(to.sin_port), &asker);
    int listener = bound(SOCK_DGRAM, "0.0.0.0", &port);
    inet_pton(AF_INET, "239.255.77.2", &other.imr_multiaddr);
    TEST_ASSERT_EQUAL_INT(
        0, setsockopt(listener, IPPROTO_IP, IP_ADD_MEMBERSHIP, &other, sizeof other));
    TEST_ASSERT_EQUAL_INT(0, setsockopt(fd, IPPROTO_IP, IP_MULTICAST_IF, &ours, sizeof ours));
    for (int32_t i = 0; frame_count == 0; i++) {
        memcpy(&to.sin_addr, &other.imr_multiaddr, sizeof to.sin_addr);
        send_frame(fd, &to, 1000 + i);
        memcpy(&to.sin_addr, group, sizeof group);
        send_frame(fd, &to, i);
        TEST_ASSERT_TRUE(loop_wait(&loop));
    }
    TEST_ASSERT_TRUE(frames[0].number < 1000);
    TEST_ASSERT_NULL(said("again"));
}

static void test_a_drain_tells_the_newest(void)
{
    struct sockaddr_in asker;

    settings.options.unicast = true;
    int fd = answering_system(false, 1511, &asker);
    wait_for_request(fd, 4, &asker);
    for (int32_t i = 1; i <= 50; i++)
        send_frame(fd, &asker, i);
    wait_for_frames(1);
    TEST_ASSERT_EQUAL_UINT(1, frame_count);
    TEST_ASSERT_EQUAL_UINT(50, frames[0].number);
    TEST_ASSERT_EQUAL_UINT(1, source_counts(source).frames);
    TEST_ASSERT_EQUAL_UINT(49, source_counts(source).skipped);
}

static void test_a_recording_misses_no_frame(void)
{
    struct sockaddr_in asker;

    settings.options.unicast = true;
    settings.every = true;
    int fd = answering_system(false, 1511, &asker);
    wait_for_request(fd, 4, &asker);
    for (int32_t i = 1; i <= 50; i++)
        send_frame(fd, &asker, i);
    wait_for_frames(50);
    for (uint32_t i = 0; i < 50; i++)
        TEST_ASSERT_EQUAL_UINT(i + 1, frames[i].number);
    TEST_ASSERT_EQUAL_UINT(0, source_counts(source).skipped);
}

static void test_no_body_is_lost_in_a_drain(void)
{
    struct sockaddr_in to;
    int fd = listening_source(&to);

    for (uint8_t i = 1; i <= 9; i++)
        send_bead(fd, &to, 'F', i, 1);
    wait_for_frames(9);
    for (int32_t i = 0; i < 9; i++)
        TEST_ASSERT_EQUAL_INT(i + 1, frames[i].id);
}

static void test_a_flood_does_not_keep_all_else_waiting(void)
{
    struct sockaddr_in to;
    int fd = listening_source(&to);
    struct source_count count;
    size_t sent = 0;

    while (sent < 600) {
        send_bead(fd, &to, 'F', 1, 1);
        sent++;
    }
    int64_t deadline_us = loop_now() + PATIENCE_US;
    do {
        uint64_t before = source_counts(source).frames + source_counts(source).skipped;
        TEST_ASSERT_TRUE(loop_wait(&loop));
        count = source_counts(source);
        TEST_ASSERT_TRUE(count.frames + count.skipped - before <= 256);
        TEST_ASSERT_TRUE(loop_now() < deadline_us);
    } while (count.frames + count.skipped == 0);
}

static void test_a_system_started_anew(void)
{
    struct sockaddr_in to;
    int fd = listening_source(&to);

    send_bead(fd, &to, 'F', 1, 200);
    wait_for_frames(1);
    send_bead(fd, &to, 'F', 1, 198); /* overtaken */
    send_bead(fd, &to, 'F', 2, 201);
    wait_for_frames(2);
    TEST_ASSERT_EQUAL_UINT(201, frames[1].number);
    TEST_ASSERT_NULL(said("started anew"));
    send_bead(fd, &to, 'F', 1, 3);
    wait_for_frames(3);
    TEST_ASSERT_NOT_NULL(said("started anew"));
}

static void test_silence_and_coming_back(void)
{
    struct sockaddr_in to;
    int fd = listening_source(&to);

    send_bead(fd, &to, 'F', 1, 1);
    wait_for_frames(1);
    source_tick(source, loop_now() + SECOND / 2);
    TEST_ASSERT_EQUAL_UINT(0, problems);
    source_tick(source, loop_now() + SECOND);
    TEST_ASSERT_EQUAL_UINT(1, problems);
    TEST_ASSERT_NOT_NULL(said("no frames for 1 s"));
    send_bead(fd, &to, 'F', 1, 2);
    wait_for_frames(2);
    TEST_ASSERT_NOT_NULL(said("frames come again"));
}

static void test_nothing_comes(void)
{
    struct sockaddr_in to;
    int fd = listening_source(&to);

    source_tick(source, loop_now() + 3 * SECOND);
    TEST_ASSERT_NOT_NULL(said("nothing has come to UDP port"));
    source_tick(source, loop_now() + 4 * SECOND);
    TEST_ASSERT_EQUAL_UINT(1, problems); /* said once */
    send_bead(fd, &to, 'F', 1, 1);
    wait_for_frames(1);
}

static void test_what_comes_is_not_understood(void)
{
    struct sockaddr_in to;
    int fd = listening_source(&to);

    send_bead(fd, &to, 'B', 1, 1);
    while (source_counts(source).broken == 0)
        TEST_ASSERT_TRUE(loop_wait(&loop));
    source_tick(source, loop_now() + 3 * SECOND);
    TEST_ASSERT_NOT_NULL(said("not understood: bead B"));
}

static void test_refusal(void)
{
    struct sockaddr_in to;
    int fd = listening_source(&to);

    send_bead(fd, &to, 'R', 1, 1);
    wait_for_words("bead R");
    TEST_ASSERT_EQUAL_UINT(1, problems);
    TEST_ASSERT_EQUAL_STRING("beads: bead R", source_words(source));
}

static void test_connected_but_no_frames(void)
{
    struct sockaddr_in asker;

    settings.options.unicast = true;
    answering_system(false, 1511, &asker);
    wait_for_words("NatNet 3.0");
    source_tick(source, loop_now() + 3 * SECOND);
    TEST_ASSERT_NOT_NULL(said("connected, but no frames"));
}

static void test_unicast_and_multicast_differ(void)
{
    struct sockaddr_in asker;

    settings.options.unicast = true;
    answering_system(true, 1511, &asker);
    wait_for_words("NatNet 3.0");
    source_tick(source, loop_now() + 3 * SECOND);
    TEST_ASSERT_NOT_NULL(said("streams to a multicast group"));
}

static void test_strangers_are_not_believed(void)
{
    struct sockaddr_in asker;
    uint16_t port;

    settings.options.unicast = true;
    int fd = answering_system(false, 1511, &asker);
    wait_for_words("NatNet 3.0");
    int stranger = bound(SOCK_DGRAM, "127.0.0.2", &port);
    send_frame(stranger, &asker, 1);
    source_tick(source, loop_now());
    TEST_ASSERT_TRUE(loop_wait(&loop));
    source_tick(source, loop_now() + 3 * SECOND);
    TEST_ASSERT_NOT_NULL(said("but datagrams from 127.0.0.2"));
    send_frame(fd, &asker, 2);
    wait_for_frames(1);
    TEST_ASSERT_EQUAL_UINT(2, frames[0].number);
}

static void test_noise(void)
{
    struct sockaddr_in asker;
    uint32_t random = 1;
    uint8_t bytes[512];

    settings.options.unicast = true;
    int fd = answering_system(false, 1511, &asker);
    wait_for_words("NatNet 3.0");
    for (int i = 0; i < 20000; i++) {
        for (size_t j = 0; j < sizeof bytes; j++)
            bytes[j] = (uint8_t)random_next(&random);
        if (i % 2 == 0)
            memcpy(bytes, (const uint8_t[]){7, 0, 252, 1}, 4); /* a frame, by its header */
        send_to(fd, bytes, sizeof bytes, &asker);
        if (i % 100 == 0) {
            TEST_ASSERT_TRUE(loop_wait(&loop));
        }
    }
    TEST_ASSERT_EQUAL_UINT(0, frame_count);
    TEST_ASSERT_TRUE(source_counts(source).broken > 0);
    for (int32_t i = 0; frame_count == 0; i++) { /* until there is room for it */
        send_frame(fd, &asker, i);
        TEST_ASSERT_TRUE(loop_wait(&loop));
    }
}

static void test_nobody_listens_there(void)
{
    settings.port = free_port(SOCK_DGRAM);
    open_source();
    wait_for_words("nothing listens at 127.0.0.1:");
    source_tick(source, loop_now() + 3 * SECOND);
    TEST_ASSERT_EQUAL_UINT(1, problems); /* why there is no answer has been said */
}

static void test_a_port_that_is_taken(void)
{
    uint16_t port;
    int fd = bound(SOCK_DGRAM, "0.0.0.0", &port);

    protocol = beads(false, port, false);
    settings.protocol = &protocol;
    settings.server = NULL;
    open_source();
    TEST_ASSERT_NOT_NULL(said(strerror(EADDRINUSE)));
    source_tick(source, loop_now() + SECOND);
    TEST_ASSERT_EQUAL_UINT(1, line_count);
    close(fd);
    socket_count--;
    source_tick(source, loop_now() + 10 * SECOND);
    struct sockaddr_in to = loopback(port);
    fd = bound(SOCK_DGRAM, "127.0.0.1", &port);
    send_bead(fd, &to, 'F', 1, 1);
    wait_for_frames(1);
}

static int listening_server(void)
{
    uint16_t port;
    int fd = bound(SOCK_STREAM | SOCK_NONBLOCK, "127.0.0.1", &port);

    TEST_ASSERT_EQUAL_INT(0, listen(fd, 1));
    protocol = beads(true, port, true);
    settings.protocol = &protocol;
    return fd;
}

static int accepted(int server)
{
    struct sockaddr_in nobody;
    uint8_t byte = 0;
    int64_t deadline_us = loop_now() + PATIENCE_US;
    int fd;

    while ((fd = accept(server, NULL, NULL)) < 0) {
        TEST_ASSERT_TRUE(loop_now() < deadline_us);
        TEST_ASSERT_TRUE(loop_wait(&loop));
    }
    keep(fd);
    TEST_ASSERT_EQUAL_UINT(1, heard(fd, &byte, 1, &nobody));
    TEST_ASSERT_EQUAL_UINT8('?', byte);
    return fd;
}

static void test_a_stream(void)
{
    int server = listening_server();

    open_source();
    int fd = accepted(server);
    send_to(fd, "F\1", 2, NULL);
    TEST_ASSERT_TRUE(loop_wait(&loop));
    TEST_ASSERT_EQUAL_UINT(0, frame_count);
    send_to(fd, "\1\0F\2\1", 5, NULL);
    wait_for_frames(1);
    send_to(fd, "\0", 1, NULL);
    wait_for_frames(2);
    TEST_ASSERT_EQUAL_INT(1, frames[0].id);
    TEST_ASSERT_EQUAL_INT(2, frames[1].id);
    TEST_ASSERT_NOT_NULL(said("connected to 127.0.0.1:"));
}

static void test_a_stream_is_opened_anew(void)
{
    int server = listening_server();

    open_source();
    int fd = accepted(server);
    send_bead(fd, NULL, 'F', 1, 1);
    wait_for_frames(1);
    send_bead(fd, NULL, 'B', 1, 1);
    wait_for_words("bead B");
    TEST_ASSERT_NULL(said("no frames")); /* it did not take silence to see it */
    int again = accepted(server);
    send_bead(again, NULL, 'F', 1, 2);
    wait_for_frames(2);
    shutdown(again, SHUT_RDWR);
    wait_for_words("closed the connection");
    fd = accepted(server);
    send_bead(fd, NULL, 'F', 1, 3);
    wait_for_frames(3);
}

static void test_a_message_without_an_end(void)
{
    static const uint8_t some[CAPTURE_MESSAGE_MAX / 4];
    int server = listening_server();

    open_source();
    int fd = accepted(server);
    send_to(fd, "E", 1, NULL);
    for (int i = 0; i < 4; i++)
        send_to(fd, some, sizeof some, NULL);
    wait_for_words("without an end");
    fd = accepted(server);
    send_bead(fd, NULL, 'F', 1, 1);
    wait_for_frames(1);
}

static void test_a_stream_that_nobody_answers(void)
{
    protocol = beads(true, free_port(SOCK_STREAM), true);
    settings.protocol = &protocol;
    open_source();
    wait_for_words(strerror(ECONNREFUSED));
    source_tick(source, loop_now() + SECOND);
    TEST_ASSERT_EQUAL_UINT(1, problems); /* said once */
}

static void test_a_stream_that_takes_too_long(void)
{
    listening_server();
    open_source();
    source_tick(source, loop_now() + 2 * SECOND);
    TEST_ASSERT_EQUAL_UINT(0, problems);
    source_tick(source, loop_now() + 4 * SECOND);
    TEST_ASSERT_NOT_NULL(said(strerror(ETIMEDOUT)));
}

static const char *written_file(const char *bytes, size_t count)
{
    static char path[64];

    snprintf(path, sizeof path, "/tmp/test_source.XXXXXX");
    int fd = mkstemp(path);
    TEST_ASSERT_TRUE(fd >= 0);
    TEST_ASSERT_EQUAL_INT(count, write(fd, bytes, count));
    close(fd);
    protocol = beads(true, 0, false);
    settings.protocol = &protocol;
    settings.server = NULL;
    return path;
}

static void test_a_file_keeps_its_own_time(void)
{
    static const char bytes[] = "F\1\1\5F\1\2\7F\1\3\12";
    const char *path = written_file(bytes, sizeof bytes - 1);

    settings.file = path;
    int64_t start_us = loop_now();
    open_source();
    wait_for_words("has come to its end");
    unlink(path);
    TEST_ASSERT_TRUE(loop_now() - start_us >= 50000);
    TEST_ASSERT_TRUE(frame_count > 0);
    TEST_ASSERT_EQUAL_UINT(3, frames[frame_count - 1].number);
    if (frame_count == 3) { /* or a slow machine has skipped some */
        TEST_ASSERT_EQUAL_INT64(20000, frames[1].arrival_us - frames[0].arrival_us);
        TEST_ASSERT_EQUAL_INT64(30000, frames[2].arrival_us - frames[1].arrival_us);
    }
    TEST_ASSERT_EQUAL_UINT(0, problems);
}

static void test_recorded_poses(void)
{
    static const char bytes[] = "t,body,id,x,y,z,qx,qy,qz,qw,tracked\n"
                                "0.5,A,1,0,0,0,0,0,0,1,1\n"
                                "0.5,B,2,0,0,0,0,0,0,1,1\n"
                                "0.525,A,1,0,0,0,0,0,0,1,1\n"
                                "0.525,B,2,0,0,0,0,0,0,1,0\n"
                                "0.6,A,1,0,0,0";
    const char *path = written_file(bytes, sizeof bytes - 1);

    settings.protocol = &poses_protocol;
    settings.file = path;
    open_source();
    wait_for_words("has come to its end");
    unlink(path);
    TEST_ASSERT_EQUAL_UINT(2, frame_count + source_counts(source).skipped);
    if (frame_count == 2) {
        TEST_ASSERT_EQUAL_INT64(25000, frames[1].arrival_us - frames[0].arrival_us);
    }
    TEST_ASSERT_EQUAL_UINT(0, problems);
}

static void test_a_file_again_and_again(void)
{
    static const char bytes[] = "F\1\1\0F\1\2\1";
    const char *path = written_file(bytes, sizeof bytes - 1);

    settings.file = path;
    settings.repeat = true;
    open_source();
    wait_for_frames(7);
    unlink(path);
    TEST_ASSERT_NULL(said("has come to its end"));
    TEST_ASSERT_NULL(said("started anew"));
    TEST_ASSERT_EQUAL_UINT(0, problems);
}

static void test_files_that_are_none(void)
{
    const char *path = written_file("", 0);

    settings.file = path;
    open_source();
    wait_for_words("no poses are in it");
    unlink(path);
    source_close(source);
    source = source_open(&loop, &settings, &owner, error, sizeof error);
    TEST_ASSERT_NULL(source);
    TEST_ASSERT_NOT_NULL(strstr(error, strerror(ENOENT)));
}

static void assert_refused(const char *part)
{
    source = source_open(&loop, &settings, &owner, error, sizeof error);
    TEST_ASSERT_NULL(source);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(error, part), error);
}

static void test_settings_that_make_no_sense(void)
{
    settings.interface = "no-such";
    assert_refused("lo (127.0.0.1)");
    settings.interface = "192.0.2.1";
    assert_refused("192.0.2.1: no such interface");
    settings.interface = NULL;
    settings.group = "10.0.0.1";
    assert_refused("no multicast group");
    settings.group = NULL;
    settings.server = NULL;
    assert_refused("version");
    settings.file = "some.csv";
    assert_refused("not from a file");
    settings.file = NULL;
    protocol = beads(true, 0, false);
    settings.protocol = &protocol;
    assert_refused("needs a file");
    protocol = beads(true, 3883, true);
    assert_refused("needs the host name");
    settings.server = "no.such.host.invalid";
    assert_refused("no address of no.such.host.invalid");
}

static void test_arrival_is_never_before_there_was_nothing(void)
{
    uint16_t port;
    int64_t arrival_us = 0, since_us;
    struct sockaddr_in from;
    uint8_t bytes[8];
    int listening = keep(socket_ask());
    struct sockaddr_in to = {.sin_family = AF_INET};
    socklen_t length = sizeof to;
    int fd = bound(SOCK_DGRAM, "127.0.0.1", &port);

    TEST_ASSERT_EQUAL_INT(0, getsockname(listening, (struct sockaddr *)&to, &length));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    int64_t before_us = loop_now();
    send_bead(fd, &to, 'F', 1, 1);
    int64_t after_us = loop_now();
    send_bead(fd, &to, 'F', 1, 2);
    TEST_ASSERT_EQUAL_INT(4, socket_receive(listening, bytes, sizeof bytes, &from, 0, &arrival_us));
    TEST_ASSERT_TRUE(arrival_us >= before_us - 2 && arrival_us <= after_us + 1000);
    while ((since_us = loop_now()) < after_us + 5000)
        ;
    TEST_ASSERT_EQUAL_INT(
        4, socket_receive(listening, bytes, sizeof bytes, &from, since_us, &arrival_us));
    TEST_ASSERT_TRUE(arrival_us >= since_us); /* as if the date had been set back */
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_unicast);
    RUN_TEST(test_multicast);
    RUN_TEST(test_another_group_on_the_same_port);
    RUN_TEST(test_a_drain_tells_the_newest);
    RUN_TEST(test_a_recording_misses_no_frame);
    RUN_TEST(test_no_body_is_lost_in_a_drain);
    RUN_TEST(test_a_flood_does_not_keep_all_else_waiting);
    RUN_TEST(test_a_system_started_anew);
    RUN_TEST(test_silence_and_coming_back);
    RUN_TEST(test_nothing_comes);
    RUN_TEST(test_what_comes_is_not_understood);
    RUN_TEST(test_refusal);
    RUN_TEST(test_connected_but_no_frames);
    RUN_TEST(test_unicast_and_multicast_differ);
    RUN_TEST(test_strangers_are_not_believed);
    RUN_TEST(test_noise);
    RUN_TEST(test_nobody_listens_there);
    RUN_TEST(test_a_port_that_is_taken);
    RUN_TEST(test_a_stream);
    RUN_TEST(test_a_stream_is_opened_anew);
    RUN_TEST(test_a_message_without_an_end);
    RUN_TEST(test_a_stream_that_nobody_answers);
    RUN_TEST(test_a_stream_that_takes_too_long);
    RUN_TEST(test_a_file_keeps_its_own_time);
    RUN_TEST(test_recorded_poses);
    RUN_TEST(test_a_file_again_and_again);
    RUN_TEST(test_files_that_are_none);
    RUN_TEST(test_settings_that_make_no_sense);
    RUN_TEST(test_arrival_is_never_before_there_was_nothing);
    return UNITY_END();
}
