#include "endpoint.h"

#include "address.h"

#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>
#include <unity.h>

#define DEADLINE_MS 10000

static struct loop loop;
static struct endpoint endpoint, other;
static char directory[32], path[64], where[80], error[256];

void setUp(void)
{
    strcpy(directory, "/tmp/muster-endpoint-XXXXXX");
    TEST_ASSERT_NOT_NULL(mkdtemp(directory));
    snprintf(path, sizeof path, "%s/robot-12", directory);
    snprintf(where, sizeof where, "pty:%s/robot-%%d", directory);
    TEST_ASSERT_TRUE(loop_open(&loop));
    error[0] = '\0';
}

void tearDown(void)
{
    unlink(path);
    rmdir(directory);
    loop_close(&loop);
}

static void open_it(const char *text)
{
    TEST_ASSERT_TRUE_MESSAGE(endpoint_open(&endpoint, &loop, text, 12, true, error, sizeof error),
                             error);
}

static void refuse_it(struct endpoint *refused, const char *text, const char *expected)
{
    TEST_ASSERT_FALSE(endpoint_open(refused, &loop, text, 12, true, error, sizeof error));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(error, expected), error);
    endpoint_close(refused);
}

static void wait_for(int fd)
{
    struct pollfd ready = {.fd = fd, .events = POLLIN};

    TEST_ASSERT_EQUAL_INT(1, poll(&ready, 1, DEADLINE_MS));
}

/* Both ways; 0x03, \r and \n are what a terminal would not leave alone. */
static void exchange(int host)
{
    static const uint8_t down[] = {0x03, '\r', '\n', 0xFF, 0}, up[] = {'\n', 0x04, 0x11, 0};
    uint8_t bytes[16];

    TEST_ASSERT_EQUAL_INT(sizeof down, write(host, down, sizeof down));
    wait_for(endpoint.host);
    TEST_ASSERT_EQUAL_UINT(sizeof down, endpoint_receive(&endpoint, bytes, sizeof bytes));
    TEST_ASSERT_EQUAL_MEMORY(down, bytes, sizeof down);
    endpoint_send(&endpoint, up, sizeof up);
    wait_for(host);
    TEST_ASSERT_EQUAL_INT(sizeof up, read(host, bytes, sizeof bytes));
    TEST_ASSERT_EQUAL_MEMORY(up, bytes, sizeof up);
}

/* ---- ptys ------------------------------------------------------------------------------ */

static int dial_pty(void)
{
    int host = open(path, O_RDWR | O_NOCTTY);

    TEST_ASSERT_TRUE(host >= 0);
    return host;
}

static void test_hosts_of_a_pty_come_and_go(void)
{
    open_it(where);
    TEST_ASSERT_EQUAL_STRING_LEN("tty:", endpoint.link, 4);
    TEST_ASSERT_EQUAL_STRING(path, endpoint.link + 4);
    for (int i = 0; i < 3; i++) {
        int host = dial_pty();

        exchange(host);
        close(host);
        TEST_ASSERT_EQUAL_UINT(0, endpoint_receive(&endpoint, (uint8_t[8]){0}, 8));
    }
    endpoint_close(&endpoint);
    TEST_ASSERT_EQUAL_INT(-1, readlink(path, (char[1]){0}, 1));
}

static void test_a_host_does_not_hear_of_the_past(void)
{
    uint8_t bytes[4096];

    open_it(where);
    for (int i = 0; i < 1000; i++) {
        endpoint_receive(&endpoint, bytes, sizeof bytes);
        endpoint_send(&endpoint, (const uint8_t *)"past", 4);
    }
    int host = dial_pty();
    wait_for(host);
    TEST_ASSERT_EQUAL_INT(4, read(host, bytes, sizeof bytes));
    close(host);
    endpoint_close(&endpoint);
}

static void test_a_killed_robots_link_is_replaced(void)
{
    TEST_ASSERT_EQUAL_INT(0, symlink("/dev/pts/ptmx", path)); /* is there, and is not its own */
    open_it(where);
    int host = dial_pty();
    exchange(host);
    close(host);
    endpoint_close(&endpoint);
}

static void test_nothing_else_is_replaced(void)
{
    TEST_ASSERT_EQUAL_INT(0, symlink("/dev/null", path));
    refuse_it(&endpoint, where, "in the way");
    TEST_ASSERT_EQUAL_INT(0, unlink(path));
    close(open(path, O_CREAT | O_WRONLY, 0600));
    refuse_it(&endpoint, where, "in the way");
    TEST_ASSERT_EQUAL_INT(0, access(path, F_OK));
}

static void test_a_path_is_one_living_robots(void)
{
    open_it(where);
    refuse_it(&other, where, "another robot");
    int host = dial_pty();
    exchange(host);
    close(host);
    endpoint_close(&endpoint);
}

/* ---- TCP ------------------------------------------------------------------------------- */

static int dial_tcp(void)
{
    struct sockaddr_in address;
    int host = socket(AF_INET, SOCK_STREAM, 0);

    TEST_ASSERT_EQUAL_STRING_LEN("tcp:127.0.0.1:", endpoint.link, 14);
    TEST_ASSERT_TRUE(address_read(endpoint.link + 4, &address, error, sizeof error));
    TEST_ASSERT_EQUAL_INT(0, connect(host, (struct sockaddr *)&address, sizeof address));
    TEST_ASSERT_TRUE(loop_wait(&loop));
    return host;
}

static void test_hosts_of_a_port_come_and_go(void)
{
    open_it("tcp:127.0.0.1:0");
    for (int i = 0; i < 3; i++) {
        int host = dial_tcp();

        exchange(host);
        close(host);
        wait_for(endpoint.host);
        TEST_ASSERT_EQUAL_UINT(0, endpoint_receive(&endpoint, (uint8_t[8]){0}, 8));
        TEST_ASSERT_EQUAL_INT(-1, endpoint.host);
        endpoint_send(&endpoint, (const uint8_t *)"lost", 4);
    }
    endpoint_close(&endpoint);
}

static void test_a_new_host_takes_the_place(void)
{
    open_it("tcp:127.0.0.1:0");
    int first = dial_tcp(), second = dial_tcp();

    exchange(second);
    wait_for(first);
    TEST_ASSERT_EQUAL_INT(0, read(first, (uint8_t[8]){0}, 8));
    close(first);
    close(second);
    endpoint_close(&endpoint);
}

static void test_a_host_that_does_not_read_holds_nobody_up(void)
{
    static const uint8_t bytes[4096];

    open_it("tcp:127.0.0.1:0");
    int host = dial_tcp();
    for (int i = 0; i < 10000; i++)
        endpoint_send(&endpoint, bytes, sizeof bytes);
    TEST_ASSERT_TRUE(endpoint.host >= 0);
    close(host);
    endpoint_close(&endpoint);
}

/* ---- refusals -------------------------------------------------------------------------- */

static void test_what_is_no_link_is_refused(void)
{
    static const struct {
        const char *where, *expected;
    } rows[] = {
        {"", "pty:PATH, tcp:HOST:PORT"},
        {"serial:/dev/ttyS0", "pty:PATH, tcp:HOST:PORT"},
        {"pty:", "no path"},
        {"pty:/nowhere/at/all", "cannot make the link"},
        {"tcp:127.0.0.1", "HOST:PORT is allowed"},
        {"tcp::80", "HOST:PORT is allowed"},
        {"tcp:127.0.0.1:65536", "0 to 65535"},
        {"tcp:127.0.0.1:1x", "0 to 65535"},
        {"tcp:127.0.0.1:", "0 to 65535"},
        {"rfcomm:0", "a channel from 1 to 30"},
        {"rfcomm:31", "a channel from 1 to 30"},
        {"rfcomm:@00:11:22:33:44:55", "a channel from 1 to 30"},
        {"rfcomm:1@00:11:22:33:44", "00:11:22:33:44:55"},
        {"rfcomm:1@00:11:22:33:44:5g", "00:11:22:33:44:55"},
    };

    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        refuse_it(&endpoint, rows[i].where, rows[i].expected);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_hosts_of_a_pty_come_and_go);
    RUN_TEST(test_a_host_does_not_hear_of_the_past);
    RUN_TEST(test_a_killed_robots_link_is_replaced);
    RUN_TEST(test_nothing_else_is_replaced);
    RUN_TEST(test_a_path_is_one_living_robots);
    RUN_TEST(test_hosts_of_a_port_come_and_go);
    RUN_TEST(test_a_new_host_takes_the_place);
    RUN_TEST(test_a_host_that_does_not_read_holds_nobody_up);
    RUN_TEST(test_what_is_no_link_is_refused);
    return UNITY_END();
}
