/* test_files.c: the page's files over HTTP, and who is not let in. */
#include "viewed.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>
#include <unity.h>

#define MANY 100

static struct viewed viewed;
static struct client client;

void setUp(void)
{
    viewed_open(&viewed, ACT_BIT(ACT_ESTOP));
    client_connect(&client, viewed.url);
}

void tearDown(void)
{
    client_close(&client);
    viewed_close(&viewed);
}

static struct client_answer ask(const char *verb, const char *path, const char *host)
{
    char request[1000];

    snprintf(request, sizeof request, "%s %s HTTP/1.1\r\nHost: %s\r\n\r\n", verb, path, host);
    return client_ask(&client, request);
}

static void assert_header(const struct client_answer *answer, const char *line)
{
    char whole[400];

    snprintf(whole, sizeof whole, "\r\n%s\r\n", line);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(answer->head, whole), answer->head);
}

static void test_the_page_is_served_and_guarded(void)
{
    struct client_answer answer = ask("GET", "/", viewed.host);

    TEST_ASSERT_EQUAL_INT(200, answer.status);
    assert_header(&answer, "content-type: text/html; charset=utf-8");
    assert_header(&answer, "content-security-policy: default-src 'none'; script-src 'self'; "
                           "style-src 'self'; connect-src 'self'; img-src 'self' data:; "
                           "base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
    assert_header(&answer, "x-content-type-options: nosniff");
    assert_header(&answer, "referrer-policy: no-referrer");
    assert_header(&answer, "cache-control: no-store");
    TEST_ASSERT_EQUAL_UINT(strlen(answer.body), answer.count);
    TEST_ASSERT_NOT_NULL(strstr(answer.body, "</html>"));
}

/* Whatever the page refers to is there, with the type that nosniff makes browsers insist on. */
static void assert_files(const char *begin, const char *ending, const char *type)
{
    static char page[65536];
    struct client_answer answer = ask("GET", "/", viewed.host);
    unsigned found = 0;

    snprintf(page, sizeof page, "%.*s", (int)answer.count, answer.body);
    for (const char *at = page; (at = strstr(at, begin)) != NULL;) {
        char path[100] = "/", name[80];

        at += strlen(begin);
        if (sscanf(at, "%79[a-z_.]", name) != 1 || strstr(name, ending) == NULL)
            continue;
        strcat(path, name);
        answer = ask("GET", path, viewed.host);
        TEST_ASSERT_EQUAL_INT_MESSAGE(200, answer.status, path);
        TEST_ASSERT_GREATER_THAN_UINT(0, answer.count);
        assert_header(&answer, type);
        found++;
    }
    TEST_ASSERT_GREATER_THAN_UINT_MESSAGE(0, found, ending);
}

static void test_what_the_page_refers_to_is_there(void)
{
    assert_files("href=\"", ".css", "content-type: text/css; charset=utf-8");
    assert_files("src=\"", ".js", "content-type: text/javascript; charset=utf-8");
}

static void test_a_head_has_no_body(void)
{
    TEST_ASSERT_EQUAL_INT(200, ask("HEAD", "/", viewed.host).status);
    struct client_answer answer = ask("GET", "/index.html", viewed.host);
    TEST_ASSERT_EQUAL_INT(200, answer.status);
    assert_header(&answer, "content-type: text/html; charset=utf-8");
}

static void test_there_is_nothing_else(void)
{
    static const char *const paths[] = {"/x",          "/page.js/",    "/../view.c",
                                        "/page%2ejsx", "//etc/passwd", "/index.htm"};

    for (size_t i = 0; i < sizeof paths / sizeof paths[0]; i++) {
        struct client_answer answer = ask("GET", paths[i], viewed.host);

        TEST_ASSERT_EQUAL_INT_MESSAGE(404, answer.status, paths[i]);
        assert_header(&answer, "x-content-type-options: nosniff");
        client_close(&client);
        client_connect(&client, viewed.url);
    }
}

static void test_only_reading_is_served(void)
{
    static const char *const verbs[] = {"POST", "PUT", "DELETE", "OPTIONS", "PATCH"};

    for (size_t i = 0; i < sizeof verbs / sizeof verbs[0]; i++) {
        struct client_answer answer = ask(verbs[i], "/", viewed.host);

        TEST_ASSERT_TRUE_MESSAGE(answer.status != 200, verbs[i]);
        client_close(&client);
        client_connect(&client, viewed.url);
    }
}

static void test_who_came_by_a_strangers_name_is_refused(void)
{
    static const char *const hosts[] = {"evil.example", "127.0.0.1.evil.example:8765", ""};

    for (size_t i = 0; i < sizeof hosts / sizeof hosts[0]; i++) {
        TEST_ASSERT_EQUAL_INT_MESSAGE(403, ask("GET", "/", hosts[i]).status, hosts[i]);
        client_close(&client);
        client_connect(&client, viewed.url);
    }
    TEST_ASSERT_EQUAL_INT(200, ask("GET", "/", "localhost").status);
}

static void assert_upgrade(int status, const char *host, const char *protocol, const char *origin)
{
    client_close(&client);
    client_connect(&client, viewed.url);
    TEST_ASSERT_EQUAL_INT_MESSAGE(status, client_upgrade(&client, host, protocol, origin),
                                  origin != NULL ? origin : protocol);
}

static void test_pages_of_other_places_do_not_get_to_look(void)
{
    assert_upgrade(101, viewed.host, VIEWED_PAGE, NULL);
    assert_upgrade(101, viewed.host, VIEWED_PAGE, viewed.origin);
    assert_upgrade(403, viewed.host, VIEWED_PAGE, "http://evil.example");
    assert_upgrade(403, viewed.host, VIEWED_PAGE, "http://127.0.0.1:1");
    assert_upgrade(403, viewed.host, VIEWED_PAGE, "null");
    assert_upgrade(403, viewed.host, VIEWED_PAGE, "file://");
    assert_upgrade(403, viewed.host, VIEWED_PAGE, "https://app.foxglove.dev");
    assert_upgrade(403, viewed.host, "foxglove.sdk.v1, " VIEWED_PAGE, "https://app.foxglove.dev");
    assert_upgrade(403, "evil.example", VIEWED_PAGE, "http://evil.example");
    assert_upgrade(101, viewed.host, "foxglove.sdk.v1", "https://app.foxglove.dev");
    assert_upgrade(101, viewed.host, "foxglove.websocket.v1", "http://localhost:8080");
    assert_upgrade(101, viewed.host, "foxglove.websocket.v1", NULL);
    assert_upgrade(403, viewed.host, "foxglove.sdk.v1", "http://evil.example");
    assert_upgrade(403, viewed.host, "foxglove.sdk.v1", "null");
}

static void test_only_the_three_protocols_are_spoken(void)
{
    assert_upgrade(400, viewed.host, NULL, NULL);
    assert_upgrade(0, viewed.host, "http", NULL);
    assert_upgrade(0, viewed.host, "listener", NULL);
    assert_upgrade(0, viewed.host, "muster.view.v2", NULL);
    TEST_ASSERT_EQUAL_UINT(0, view_viewers(viewed.view));
    TEST_ASSERT_FALSE(view_looked_at(viewed.view));
}

static void test_nonsense_and_silence_disturb_nobody(void)
{
    static const char junk[] = "\x16\x03\x01\x02\0\x01\0\x01\xFC\x03\x03 \r\n\r\nGET\0\r\n\r\n";
    struct client others[MANY];

    for (int i = 0; i < MANY; i++) {
        client_connect(&others[i], viewed.url);
        if (i % 4 == 1)
            client_say(&others[i], "GET / HT", 8);
        else if (i % 4 == 2)
            client_say(&others[i], junk, sizeof junk);
        else if (i % 4 == 3)
            client_close(&others[i]);
    }
    /* Where all connections are taken, one is free as soon as somebody leaves. */
    for (int i = 0; i < MANY; i++)
        client_close(&others[i]);
    client_close(&client);
    client_connect(&client, viewed.url);
    TEST_ASSERT_EQUAL_INT(200, ask("GET", "/", viewed.host).status);
}

static void test_signals_stay_the_runs(void)
{
    struct sigaction pipe;
    struct timespec patience = {CLIENT_PATIENCE_S, 0};
    sigset_t set;

    TEST_ASSERT_EQUAL_INT(200, ask("GET", "/", viewed.host).status); /* its thread is there */
    sigaction(SIGPIPE, NULL, &pipe);
    TEST_ASSERT_TRUE(pipe.sa_handler == SIG_DFL);
    sigemptyset(&set);
    sigaddset(&set, SIGUSR1);
    sigprocmask(SIG_BLOCK, &set, NULL);
    kill(getpid(), SIGUSR1);
    TEST_ASSERT_EQUAL_INT(SIGUSR1, sigtimedwait(&set, NULL, &patience));
}

int main(void)
{
    /* Whatever they were for whoever started this. */
    signal(SIGPIPE, SIG_DFL);
    signal(SIGUSR1, SIG_DFL);
    UNITY_BEGIN();
    RUN_TEST(test_the_page_is_served_and_guarded);
    RUN_TEST(test_what_the_page_refers_to_is_there);
    RUN_TEST(test_a_head_has_no_body);
    RUN_TEST(test_there_is_nothing_else);
    RUN_TEST(test_only_reading_is_served);
    RUN_TEST(test_who_came_by_a_strangers_name_is_refused);
    RUN_TEST(test_pages_of_other_places_do_not_get_to_look);
    RUN_TEST(test_only_the_three_protocols_are_spoken);
    RUN_TEST(test_nonsense_and_silence_disturb_nobody);
    RUN_TEST(test_signals_stay_the_runs);
    return UNITY_END();
}
