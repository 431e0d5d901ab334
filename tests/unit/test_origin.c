#include "origin.h"

#include <stddef.h>
#include <unity.h>

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_our_own_names_are_ours(void)
{
    static const char *const ours[] = {
        "127.0.0.1", "127.0.0.1:8765", "192.168.1.20:80", "[::1]:8765",     "[::1]",
        "localhost", "LocalHost:8765", "lab-pc:8765",     "lab-pc.local:1", "lab.example.org:8765",
    };

    for (size_t i = 0; i < sizeof ours / sizeof ours[0]; i++)
        TEST_ASSERT_TRUE_MESSAGE(origin_host_is_ours(ours[i], "lab-pc", "lab.example.org"),
                                 ours[i]);
}

static void test_strangers_names_are_not(void)
{
    static const char *const strangers[] = {
        "",
        ":8765",
        "evil.example",
        "evil.example:8765",
        "127.0.0.1.evil.example",
        "localhost.evil.example:8765",
        "lab-pc.evil.example",
        "lab-pc.local.evil.example",
        "xlab-pc",
        "[::1",
        "[]",
        "[evil.example]:1",
        "127.0.0.1:80x",
        "localhost@evil.example",
    };

    for (size_t i = 0; i < sizeof strangers / sizeof strangers[0]; i++)
        TEST_ASSERT_FALSE_MESSAGE(origin_host_is_ours(strangers[i], "lab-pc", ""), strangers[i]);
    TEST_ASSERT_FALSE(origin_host_is_ours("lab-pc", "", ""));
    TEST_ASSERT_FALSE(origin_host_is_ours(".local", "", ""));
}

static void test_a_page_is_its_own_servers_only(void)
{
    TEST_ASSERT_TRUE(origin_is_own("http://127.0.0.1:8765", "127.0.0.1:8765"));
    TEST_ASSERT_TRUE(origin_is_own("http://Lab-PC:8765", "lab-pc:8765"));
    TEST_ASSERT_FALSE(origin_is_own("http://127.0.0.1:8766", "127.0.0.1:8765"));
    TEST_ASSERT_FALSE(origin_is_own("http://localhost:8765", "127.0.0.1:8765"));
    TEST_ASSERT_FALSE(origin_is_own("https://127.0.0.1:8765", "127.0.0.1:8765"));
    TEST_ASSERT_FALSE(origin_is_own("null", "127.0.0.1:8765"));
    TEST_ASSERT_FALSE(origin_is_own("http://127.0.0.1:8765.evil.example", "127.0.0.1:8765"));
}

static void test_foxglove_is_shown_by_known_pages(void)
{
    static const char *const shown[] = {
        "https://app.foxglove.dev",
        "https://studio.foxglove.dev",
        "https://lichtblick-suite.github.io",
        "file://",
        "http://localhost:8080",
        "https://localhost",
        "http://127.0.0.1:3000",
        "http://[::1]:3000",
    };
    static const char *const not_shown[] = {
        "null",
        "http://app.foxglove.dev",
        "https://app.foxglove.dev.evil.example",
        "https://evil.example",
        "http://localhost.evil.example",
        "http://192.168.1.20:8080",
        "ftp://localhost",
        "file://x",
    };

    for (size_t i = 0; i < sizeof shown / sizeof shown[0]; i++)
        TEST_ASSERT_TRUE_MESSAGE(origin_shows_foxglove(shown[i]), shown[i]);
    for (size_t i = 0; i < sizeof not_shown / sizeof not_shown[0]; i++)
        TEST_ASSERT_FALSE_MESSAGE(origin_shows_foxglove(not_shown[i]), not_shown[i]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_our_own_names_are_ours);
    RUN_TEST(test_strangers_names_are_not);
    RUN_TEST(test_a_page_is_its_own_servers_only);
    RUN_TEST(test_foxglove_is_shown_by_known_pages);
    return UNITY_END();
}
