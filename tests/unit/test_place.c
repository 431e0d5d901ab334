#include "place.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>
#include <unity.h>

static char error[300];

void setUp(void)
{
    error[0] = '\0';
}

void tearDown(void)
{
}

static void assert_place(const char *text, const char *address, uint16_t port)
{
    struct view_options options;
    char place[100];

    snprintf(place, sizeof place, "%s", text);
    TEST_ASSERT_TRUE_MESSAGE(view_place(&options, place, error, sizeof error), text);
    TEST_ASSERT_EQUAL_UINT(port, options.port);
    if (address == NULL) {
        TEST_ASSERT_NULL(options.address);
    } else {
        TEST_ASSERT_EQUAL_STRING(address, options.address);
    }
}

static void test_places_as_people_write_them(void)
{
    assert_place("8080", NULL, 8080);
    assert_place("0", NULL, 0);
    assert_place("65535", NULL, 65535);
    assert_place("192.168.1.20", "192.168.1.20", VIEW_PORT);
    assert_place("192.168.1.20:80", "192.168.1.20", 80);
    assert_place("lab-pc", "lab-pc", VIEW_PORT);
    assert_place("::1", "::1", VIEW_PORT);
    assert_place("::", "::", VIEW_PORT);
    assert_place("[::1]", "::1", VIEW_PORT);
    assert_place("[fe80::1]:81", "fe80::1", 81);
}

static void test_what_is_no_place_is_said_to_be_none(void)
{
    static const char *const texts[] = {
        "",     "65536",   "123456", ":8080", "host:",  "host:x", "h:-1",
        "[::1", "[::1]80", "[]:80",  "h:1 ",  "[::1]:", "h:65536"};

    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        struct view_options options;
        char place[100];

        snprintf(place, sizeof place, "%s", texts[i]);
        TEST_ASSERT_FALSE_MESSAGE(view_place(&options, place, error, sizeof error), texts[i]);
        TEST_ASSERT_NOT_NULL(strstr(error, "[ADDRESS]:PORT is allowed"));
    }
}

static int listen_at(const char *address, uint16_t port)
{
    struct view_options options = {address, port};

    return place_listen(&options, error, sizeof error);
}

static void test_a_port_that_is_taken_is_told_of(void)
{
    char name[PLACE_HOST_MAX];
    unsigned port;
    int first = listen_at(NULL, 0);

    TEST_ASSERT_GREATER_OR_EQUAL_INT(0, first);
    place_name(first, name, sizeof name);
    TEST_ASSERT_EQUAL_INT(1, sscanf(name, "127.0.0.1:%u", &port));
    TEST_ASSERT_EQUAL_INT(-1, listen_at(NULL, (uint16_t)port));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(error, "is taken, by another muster perhaps"), error);
    close(first);
}

static void test_an_address_of_another_machine_is_told_of(void)
{
    TEST_ASSERT_EQUAL_INT(-1, listen_at("192.0.2.1", 0));
    TEST_ASSERT_EQUAL_STRING("192.0.2.1 is no address of this machine", error);
    TEST_ASSERT_EQUAL_INT(-1, listen_at("no..such", 0));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(error, "no address of no..such"), error);
}

static void test_who_listens_everywhere_is_named_by_the_machine(void)
{
    char name[PLACE_HOST_MAX], machine[PLACE_HOST_MAX];
    int listener = listen_at("0.0.0.0", 0);

    TEST_ASSERT_GREATER_OR_EQUAL_INT(0, listener);
    gethostname(machine, sizeof machine);
    place_name(listener, name, sizeof name);
    TEST_ASSERT_EQUAL_INT(0, strncmp(name, machine, strlen(machine)));
    close(listener);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_places_as_people_write_them);
    RUN_TEST(test_what_is_no_place_is_said_to_be_none);
    RUN_TEST(test_a_port_that_is_taken_is_told_of);
    RUN_TEST(test_an_address_of_another_machine_is_told_of);
    RUN_TEST(test_who_listens_everywhere_is_named_by_the_machine);
    return UNITY_END();
}
