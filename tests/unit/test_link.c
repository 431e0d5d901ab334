#define _GNU_SOURCE /* posix_openpt() and its kin */

#include "link.h"

#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>
#include <unity.h>

/* Generous: a test that is right ends long before. */
#define DEADLINE_US 20000000

#define ROBOTS_MAX 4

/* What the owner was told. */
struct told {
    int ups, downs;
    uint64_t received;
    uint8_t first[256]; /* of what was received */
    char words[LINK_WORDS_MAX];
};

static struct loop loop;
static struct watch clock_watch;
static struct links *links;
static struct link_settings settings[ROBOTS_MAX];
static struct told told[ROBOTS_MAX];
static int64_t began_us, skipped_us;
static char error[256];
static int opened;    /* files */
static bool mirrored; /* a socket's peer is itself */

/* Linked in place of the originals, which they call (ld --wrap). */
int __wrap_open(const char *path, int flags, ...);
int __real_open(const char *path, int flags, ...);
int __wrap_getpeername(int fd, struct sockaddr *address, socklen_t *length);
int __real_getpeername(int fd, struct sockaddr *address, socklen_t *length);

int __wrap_open(const char *path, int flags, ...)
{
    opened++;
    return __real_open(path, flags);
}

int __wrap_getpeername(int fd, struct sockaddr *address, socklen_t *length)
{
    return mirrored ? getsockname(fd, address, length) : __real_getpeername(fd, address, length);
}

static void on_up(void *context, size_t robot)
{
    ((struct told *)context)[robot].ups++;
}

static void on_down(void *context, size_t robot, const char *words)
{
    struct told *t = &((struct told *)context)[robot];

    t->downs++;
    snprintf(t->words, sizeof t->words, "%s", words);
}

static void on_received(void *context, size_t robot, const uint8_t *bytes, size_t count)
{
    struct told *t = &((struct told *)context)[robot];

    for (size_t i = 0; i < count && t->received + i < sizeof t->first; i++)
        t->first[t->received + i] = bytes[i];
    t->received += count;
}

static const struct link_owner owner = {told, on_up, on_down, on_received};

/* The links' time may run ahead of the clock, by what a test skips. */
static int64_t now(void)
{
    return loop_now() + skipped_us;
}

static void on_clock(struct watch *watch, uint32_t events)
{
    (void)events;
    loop_periods(watch->fd);
    if (links != NULL)
        links_tick(links, now());
}

void setUp(void)
{
    memset(told, 0, sizeof told);
    memset(settings, 0, sizeof settings);
    mirrored = false;
    skipped_us = 0;
    began_us = loop_now();
    TEST_ASSERT_TRUE(loop_open(&loop));
    clock_watch = (struct watch){.fd = loop_timer(5000), .ready = on_clock};
    TEST_ASSERT_TRUE(loop_watch(&loop, &clock_watch, EPOLLIN));
}

void tearDown(void)
{
    if (links != NULL)
        links_close(links);
    links = NULL;
    loop_forget(&loop, &clock_watch);
    close(clock_watch.fd);
    loop_close(&loop);
}

static void address_of(size_t robot, const char *text)
{
    char words[LINK_WORDS_MAX];

    settings[robot].adapter = -1;
    settings[robot].baud = 115200;
    TEST_ASSERT_TRUE_MESSAGE(link_address_read(text, &settings[robot].address, words), words);
}

static void open_links(size_t count)
{
    links = links_open(&loop, settings, count, &owner, error, sizeof error);
    TEST_ASSERT_NOT_NULL_MESSAGE(links, error);
}

static void turn(void)
{
    TEST_ASSERT_TRUE(loop_wait(&loop));
    TEST_ASSERT_TRUE_MESSAGE(loop_now() - began_us < DEADLINE_US, "nothing came of it");
}

static void run_until(const int *count, int least)
{
    while (*count < least)
        turn();
}

static void run_until_received(size_t robot, uint64_t count)
{
    while (told[robot].received < count)
        turn();
}

static void run_until_words(size_t robot, const char *words)
{
    while (strstr(links_look(links, robot)->words, words) == NULL)
        turn();
}

/* Something that listens on a port of the kernel's choice, or on `port`. */
static int listen_on(uint16_t *port)
{
    struct sockaddr_in own = {
        .sin_family = AF_INET, .sin_port = htons(*port), .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    socklen_t length = sizeof own;
    int on = 1;
    int fd = socket(AF_INET, SOCK_STREAM, 0);

    setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    TEST_ASSERT_EQUAL_INT(0, bind(fd, (struct sockaddr *)&own, sizeof own));
    TEST_ASSERT_EQUAL_INT(0, listen(fd, 8));
    getsockname(fd, (struct sockaddr *)&own, &length);
    *port = ntohs(own.sin_port);
    return fd;
}

static void tcp_address_of(size_t robot, uint16_t port)
{
    char text[64];

    snprintf(text, sizeof text, "tcp:127.0.0.1:%u", port);
    address_of(robot, text);
}

/* Connects robot 0 by TCP: the robot's end. `listener` stays open. */
static int connect_robot(int *listener)
{
    uint16_t port = 0;

    *listener = listen_on(&port);
    tcp_address_of(0, port);
    open_links(1);
    run_until(&told[0].ups, 1);
    int fd = accept(*listener, NULL, NULL);
    TEST_ASSERT_TRUE(fd >= 0);
    return fd;
}

static void read_exactly(int fd, uint8_t *bytes, size_t count)
{
    for (size_t at = 0; at < count;) {
        struct pollfd wait = {.fd = fd, .events = POLLIN};

        TEST_ASSERT_EQUAL_INT(1, poll(&wait, 1, DEADLINE_US / 1000));
        ssize_t n = read(fd, bytes + at, count - at);
        TEST_ASSERT_TRUE(n > 0);
        at += (size_t)n;
    }
}

static int open_pty(char path[64])
{
    int master = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);

    TEST_ASSERT_TRUE(master >= 0);
    TEST_ASSERT_EQUAL_INT(0, grantpt(master));
    TEST_ASSERT_EQUAL_INT(0, unlockpt(master));
    TEST_ASSERT_EQUAL_INT(0, ptsname_r(master, path, 64));
    return master;
}

static void test_tcp_carries_bytes_both_ways(void)
{
    uint8_t got[5];
    int listener;
    int robot = connect_robot(&listener);
    const struct link_view *view = links_look(links, 0);

    links_send(links, 0, (const uint8_t *)"hello", links_room(links, 0, now()) > 5 ? 5 : 0);
    read_exactly(robot, got, sizeof got);
    TEST_ASSERT_EQUAL_MEMORY("hello", got, 5);
    TEST_ASSERT_EQUAL_INT(3, write(robot, "abc", 3));
    run_until_received(0, 3);
    TEST_ASSERT_EQUAL_MEMORY("abc", told[0].first, 3);
    TEST_ASSERT_EQUAL_INT(LINK_UP, view->state);
    TEST_ASSERT_EQUAL_STRING("", view->words);
    TEST_ASSERT_EQUAL_UINT64(5, view->sent);
    TEST_ASSERT_EQUAL_UINT64(3, view->received);
    TEST_ASSERT_EQUAL_UINT32(1, view->connects);
    TEST_ASSERT_TRUE(view->heard_us > 0);
    TEST_ASSERT_EQUAL_STRING_LEN("tcp:127.0.0.1:", view->address, 14);
    close(robot);
    close(listener);
}

static void test_a_link_that_breaks_is_dialled_again(void)
{
    int listener;
    int robot = connect_robot(&listener);

    for (int times = 1; times <= 3; times++) {
        close(robot);
        run_until(&told[0].ups, times + 1);
        TEST_ASSERT_EQUAL_INT(times, told[0].downs);
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(told[0].words, "closed"), told[0].words);
        robot = accept(listener, NULL, NULL);
    }
    close(robot);
    close(listener);
}

static void test_close_tells_of_links_that_are_up_once(void)
{
    int listener;
    int robot = connect_robot(&listener);
    uint8_t byte;

    links_close(links);
    links = NULL;
    TEST_ASSERT_EQUAL_INT(1, told[0].ups);
    TEST_ASSERT_EQUAL_INT(1, told[0].downs);
    TEST_ASSERT_EQUAL_INT(0, read(robot, &byte, 1));
    close(robot);
    close(listener);
}

static void test_a_robot_that_comes_late(void)
{
    uint16_t port = 0;

    close(listen_on(&port));
    tcp_address_of(0, port);
    open_links(1);
    run_until_words(0, "nothing listens");
    TEST_ASSERT_EQUAL_INT(0, told[0].ups + told[0].downs);
    TEST_ASSERT_EQUAL_UINT(0, links_room(links, 0, now()));
    int listener = listen_on(&port);
    run_until(&told[0].ups, 1);
    close(listener);
}

static void test_a_dial_that_meets_itself(void)
{
    uint16_t port = 0;
    int listener = listen_on(&port);

    mirrored = true;
    tcp_address_of(0, port);
    open_links(1);
    run_until_words(0, "nothing listens");
    TEST_ASSERT_EQUAL_INT(0, told[0].ups);
    mirrored = false;
    run_until(&told[0].ups, 1);
    close(listener);
}

/* A listener whose queue is full lets a dial hang. */
static void test_one_robot_that_does_not_answer_holds_up_none(void)
{
    uint16_t port = 0;
    uint16_t full_port = 0;
    int listener = listen_on(&port);
    int full = listen_on(&full_port);
    struct sockaddr_in to = {.sin_family = AF_INET,
                             .sin_port = htons(full_port),
                             .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    int queue[2];

    TEST_ASSERT_EQUAL_INT(0, listen(full, 0));
    for (size_t i = 0; i < 2; i++) {
        queue[i] = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0);
        connect(queue[i], (struct sockaddr *)&to, sizeof to);
    }
    tcp_address_of(0, full_port);
    tcp_address_of(1, port);
    open_links(2);
    run_until(&told[1].ups, 1);
    TEST_ASSERT_EQUAL_INT(LINK_DIALLING, links_look(links, 0)->state);
    skipped_us += 3000000;
    run_until_words(0, "no answer");
    TEST_ASSERT_EQUAL_INT(0, told[0].ups);
    close(queue[0]);
    close(queue[1]);
    close(full);
    close(listener);
}

/* Ticks ten times a second for so long. */
static int64_t tick_for(int64_t t, int64_t us)
{
    for (int64_t end = t + us; t < end;)
        links_tick(links, t += 100000);
    return t;
}

static void test_silence_drops_a_link(void)
{
    int listener;
    int robot = connect_robot(&listener);

    int64_t t = tick_for(now(), LINK_SILENCE_US - 500000);
    TEST_ASSERT_EQUAL_INT(0, told[0].downs);
    tick_for(t, 1000000);
    TEST_ASSERT_EQUAL_INT(1, told[0].downs);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(told[0].words, "nothing heard"), told[0].words);
    close(robot);
    close(listener);
}

/* It is we who did not listen. */
static void test_who_was_held_up_takes_nobody_for_silent(void)
{
    int listener;
    int robot = connect_robot(&listener);

    for (int i = 1; i <= 5; i++)
        links_tick(links, now() + i * 10 * LINK_SILENCE_US);
    TEST_ASSERT_EQUAL_INT(0, told[0].downs);
    close(robot);
    close(listener);
}

static void test_pace(void)
{
    static const uint8_t bytes[LINK_SEND_MAX];
    int listener;
    int robot = connect_robot(&listener);
    int64_t t = now() + 1000000;

    TEST_ASSERT_EQUAL_UINT(460, links_room(links, 0, t)); /* 40 ms at 11,520 bytes a second */
    links_send(links, 0, bytes, 460);
    TEST_ASSERT_EQUAL_UINT(0, links_room(links, 0, t));
    TEST_ASSERT_UINT_WITHIN(1, 115, links_room(links, 0, t + 10000));
    links_send(links, 0, bytes, 100);
    TEST_ASSERT_UINT_WITHIN(1, 130, links_room(links, 0, t + 20000));
    TEST_ASSERT_EQUAL_UINT(460, links_room(links, 0, t + 1000000));
    close(robot);
    close(listener);
}

static void test_a_slow_uart_has_room_for_one_frame(void)
{
    uint16_t port = 0;
    int listener = listen_on(&port);

    tcp_address_of(0, port);
    settings[0].baud = 9600;
    open_links(1);
    run_until(&told[0].ups, 1);
    TEST_ASSERT_EQUAL_UINT(60, links_room(links, 0, now()));
    close(listener);
}

/* The kernel takes less and less while nobody reads; what it leaves is sent later, in order. */
static void test_nothing_is_lost_in_a_full_link(void)
{
    uint8_t bytes[LINK_SEND_MAX];
    uint8_t got[LINK_SEND_MAX];
    int listener;
    int robot = connect_robot(&listener);
    int64_t t = now();
    uint64_t sent = 0;

    for (size_t room; (room = links_room(links, 0, t += 50000)) > 0; sent += room) {
        for (size_t i = 0; i < room; i++)
            bytes[i] = (uint8_t)((sent + i) % 251);
        links_send(links, 0, bytes, room);
    }
    TEST_ASSERT_EQUAL_UINT64(sent, links_look(links, 0)->sent);
    fcntl(robot, F_SETFL, O_NONBLOCK);
    for (uint64_t at = 0; at < sent;) {
        ssize_t n = read(robot, got, sizeof got);
        if (n < 0) {
            TEST_ASSERT_EQUAL_INT(EAGAIN, errno);
            turn();
        }
        for (ssize_t i = 0; i < n; i++)
            TEST_ASSERT_EQUAL_UINT8((at + (uint64_t)i) % 251, got[i]);
        at += n > 0 ? (uint64_t)n : 0;
    }
    TEST_ASSERT_TRUE(links_room(links, 0, t + 50000) > 0);
    close(robot);
    close(listener);
}

/* The robot is gone and its end says so: no signal, and down() comes from the loop. */
static void test_sending_into_a_broken_link(void)
{
    struct linger at_once = {.l_onoff = 1};
    int listener;
    int robot = connect_robot(&listener);

    setsockopt(robot, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
    close(robot);
    for (int i = 0; i < 3; i++)
        links_send(links, 0, (const uint8_t *)"x", 1);
    TEST_ASSERT_EQUAL_INT(0, told[0].downs);
    TEST_ASSERT_EQUAL_UINT(0, links_room(links, 0, now()));
    run_until(&told[0].downs, 1);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(told[0].words, "broke"), told[0].words);
    close(listener);
}

static void feed_noise(int fd, size_t robot, uint64_t total)
{
    uint8_t noise[8192];
    uint32_t state = 1;
    uint64_t fed = 0;

    fcntl(fd, F_SETFL, O_NONBLOCK);
    while (told[robot].received < total) {
        for (size_t i = 0; i < sizeof noise; i++)
            noise[i] = (uint8_t)((state = state * 1664525u + 1013904223u) >> 24);
        size_t count = total - fed < sizeof noise ? (size_t)(total - fed) : sizeof noise;
        ssize_t n = count > 0 ? write(fd, noise, count) : 0;
        fed += n > 0 ? (uint64_t)n : 0;
        turn();
    }
}

static void test_noise_is_handed_on(void)
{
    char path[64], text[80];
    int master = open_pty(path);
    int listener;
    int robot = connect_robot(&listener);

    feed_noise(robot, 0, 10000000);
    TEST_ASSERT_EQUAL_UINT64(10000000, links_look(links, 0)->received);
    links_close(links);
    snprintf(text, sizeof text, "tty:%s", path);
    address_of(0, text);
    told[0] = (struct told){0};
    open_links(1);
    run_until(&told[0].ups, 1);
    feed_noise(master, 0, 10000000);
    TEST_ASSERT_EQUAL_INT(0, told[0].downs);
    close(master);
    close(robot);
    close(listener);
}

/* No byte is anything but itself: no newline, ^C or XON is made something of. */
static void test_a_pty_is_raw(void)
{
    char path[64], text[80];
    uint8_t bytes[256], got[256];
    int master = open_pty(path);

    for (size_t i = 0; i < sizeof bytes; i++)
        bytes[i] = (uint8_t)i;
    snprintf(text, sizeof text, "tty:%s", path);
    address_of(0, text);
    settings[0].baud = 250000; /* none of POSIX's rates */
    open_links(1);
    run_until(&told[0].ups, 1);
    links_send(links, 0, bytes, sizeof bytes);
    read_exactly(master, got, sizeof got);
    TEST_ASSERT_EQUAL_MEMORY(bytes, got, sizeof bytes);
    TEST_ASSERT_EQUAL_INT(256, write(master, bytes, sizeof bytes));
    run_until_received(0, sizeof bytes);
    TEST_ASSERT_EQUAL_UINT64(sizeof bytes, told[0].received);
    TEST_ASSERT_EQUAL_MEMORY(bytes, told[0].first, sizeof bytes);
    close(master);
}

/* Whoever is not root could not open it a second time. */
static void test_a_pty_is_not_locked(void)
{
    char path[64], text[80];
    int master = open_pty(path);
    int exclusive = 1;

    snprintf(text, sizeof text, "tty:%s", path);
    address_of(0, text);
    open_links(1);
    run_until(&told[0].ups, 1);
    int slave = open(path, O_RDWR | O_NOCTTY);
    TEST_ASSERT_EQUAL_INT(0, ioctl(slave, TIOCGEXCL, &exclusive));
    TEST_ASSERT_FALSE(exclusive);
    close(slave);
    close(master);
}

/* A path that appears, whose pty goes, and that leads to another one then. */
static void test_a_path_may_come_late_and_come_back(void)
{
    char folder[] = "/tmp/muster-link-XXXXXX";
    char path[64], name[96], text[128];

    TEST_ASSERT_NOT_NULL(mkdtemp(folder));
    snprintf(name, sizeof name, "%s/robot", folder);
    snprintf(text, sizeof text, "tty:%s", name);
    address_of(0, text);
    open_links(1);
    run_until_words(0, "no such device");
    for (int times = 1; times <= 2; times++) {
        int master = open_pty(path);
        TEST_ASSERT_EQUAL_INT(0, symlink(path, name));
        run_until(&told[0].ups, times);
        close(master);
        run_until(&told[0].downs, times);
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(told[0].words, "gone"), told[0].words);
        unlink(name);
    }
    rmdir(folder);
}

/* At once, then 0.2, 0.4, 0.8, 1.6, 3.2 and 5 s after the last time. */
static void test_pauses_grow(void)
{
    static const int64_t dials_ms[] = {0, 200, 600, 1400, 3000, 6200, 11200, 16200};
    size_t count = sizeof dials_ms / sizeof dials_ms[0];
    size_t next = 0;

    address_of(0, "tty:/dev/there-is-no-such-tty");
    open_links(1);
    for (int64_t ms = 0; ms <= dials_ms[count - 1]; ms++) {
        opened = 0;
        links_tick(links, began_us + ms * 1000);
        TEST_ASSERT_EQUAL_INT(ms == dials_ms[next], opened);
        next += ms == dials_ms[next];
    }
    TEST_ASSERT_EQUAL_UINT(count, next);
}

static void test_a_link_that_has_lived_is_dialled_at_once(void)
{
    char path[64], text[80];
    int master = open_pty(path);
    int64_t t = began_us;

    snprintf(text, sizeof text, "tty:%s", path);
    address_of(0, text);
    open_links(1);
    links_tick(links, t);
    TEST_ASSERT_EQUAL_INT(1, told[0].ups);
    links_tick(links, t += 4000000); /* has lived, unheard because we did not listen */
    t = tick_for(t, LINK_SILENCE_US - 100000);
    TEST_ASSERT_EQUAL_INT(1, told[0].downs);
    links_tick(links, t += 1000);
    TEST_ASSERT_EQUAL_INT(2, told[0].ups);
    t = tick_for(t, LINK_SILENCE_US + 100000); /* has not */
    TEST_ASSERT_EQUAL_INT(2, told[0].downs);
    links_tick(links, t += 100000);
    TEST_ASSERT_EQUAL_INT(2, told[0].ups);
    links_tick(links, t += 100000);
    TEST_ASSERT_EQUAL_INT(3, told[0].ups);
    close(master);
}

static void test_a_file_is_no_tty(void)
{
    address_of(0, "tty:/dev/null");
    open_links(1);
    run_until_words(0, "no tty");
}

static void test_a_host_that_nobody_knows(void)
{
    address_of(0, "tcp:[::1::2]:80");
    TEST_ASSERT_NULL(links_open(&loop, settings, 1, &owner, error, sizeof error));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(error, "::1::2"), error);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_tcp_carries_bytes_both_ways);
    RUN_TEST(test_a_link_that_breaks_is_dialled_again);
    RUN_TEST(test_close_tells_of_links_that_are_up_once);
    RUN_TEST(test_a_robot_that_comes_late);
    RUN_TEST(test_a_dial_that_meets_itself);
    RUN_TEST(test_one_robot_that_does_not_answer_holds_up_none);
    RUN_TEST(test_silence_drops_a_link);
    RUN_TEST(test_who_was_held_up_takes_nobody_for_silent);
    RUN_TEST(test_pace);
    RUN_TEST(test_a_slow_uart_has_room_for_one_frame);
    RUN_TEST(test_nothing_is_lost_in_a_full_link);
    RUN_TEST(test_sending_into_a_broken_link);
    RUN_TEST(test_noise_is_handed_on);
    RUN_TEST(test_a_pty_is_raw);
    RUN_TEST(test_a_pty_is_not_locked);
    RUN_TEST(test_a_path_may_come_late_and_come_back);
    RUN_TEST(test_pauses_grow);
    RUN_TEST(test_a_link_that_has_lived_is_dialled_at_once);
    RUN_TEST(test_a_file_is_no_tty);
    RUN_TEST(test_a_host_that_nobody_knows);
    return UNITY_END();
}
