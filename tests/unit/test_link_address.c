#include "link.h"

#include <string.h>
#include <unity.h>

static struct link_address address;
static char words[LINK_WORDS_MAX];

void setUp(void)
{
    words[0] = '\0';
}

void tearDown(void)
{
}

static void assert_read(enum link_kind kind, const char *text)
{
    TEST_ASSERT_TRUE_MESSAGE(link_address_read(text, &address, words), words);
    TEST_ASSERT_EQUAL_INT(kind, address.kind);
}

static void assert_refused(const char *reason, const char *text)
{
    TEST_ASSERT_FALSE_MESSAGE(link_address_read(text, &address, words), text);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, reason), words);
}

static void test_rfcomm(void)
{
    static const uint8_t bytes[6] = {0x00, 0x1A, 0x7D, 0xDA, 0x71, 0xFF};

    assert_read(LINK_RFCOMM, "rfcomm:00:1A:7d:DA:71:fF");
    TEST_ASSERT_EQUAL_MEMORY(bytes, address.bluetooth, sizeof bytes);
    TEST_ASSERT_EQUAL_UINT8(0, address.channel);
    TEST_ASSERT_EQUAL_STRING("", address.name);
    assert_read(LINK_RFCOMM, "rfcomm:00:1A:7D:DA:71:FF/3");
    TEST_ASSERT_EQUAL_UINT8(3, address.channel);
    assert_read(LINK_RFCOMM, "rfcomm:00:1A:7D:DA:71:FF/30");
    TEST_ASSERT_EQUAL_UINT8(30, address.channel);
}

static void test_no_rfcomm(void)
{
    static const char *const texts[] = {
        "rfcomm:",
        "rfcomm:00:1A:7D:DA:71",
        "rfcomm:00:1A:7D:DA:71:F",
        "rfcomm:00:1A:7D:DA:71:FF:00",
        "rfcomm:00:1A:7D:DA:71:GG",
        "rfcomm:0:1A:7D:DA:71:FF",
        "rfcomm:00-1A-7D-DA-71-FF",
        "rfcomm:00:1A:7D:DA:71:FF ",
    };

    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
        assert_refused("six pairs", texts[i]);
    assert_refused("1 to 30", "rfcomm:00:1A:7D:DA:71:FF/");
    assert_refused("1 to 30", "rfcomm:00:1A:7D:DA:71:FF/0");
    assert_refused("1 to 30", "rfcomm:00:1A:7D:DA:71:FF/31");
    assert_refused("1 to 30", "rfcomm:00:1A:7D:DA:71:FF/-1");
    assert_refused("1 to 30", "rfcomm:00:1A:7D:DA:71:FF/3x");
}

static void test_tty(void)
{
    char text[256] = "tty:/";

    assert_read(LINK_TTY, "tty:/dev/ttyUSB0");
    TEST_ASSERT_EQUAL_STRING("/dev/ttyUSB0", address.name);
    assert_refused("absolute", "tty:ttyUSB0");
    assert_refused("absolute", "tty:");
    memset(text + 5, 'a', 106);
    assert_read(LINK_TTY, text);
    text[111] = 'a';
    assert_refused("107", text);
}

static void test_tcp(void)
{
    assert_read(LINK_TCP, "tcp:192.168.0.7:5000");
    TEST_ASSERT_EQUAL_STRING("192.168.0.7", address.name);
    TEST_ASSERT_EQUAL_UINT16(5000, address.port);
    assert_read(LINK_TCP, "tcp:robot7.lan:65535");
    TEST_ASSERT_EQUAL_UINT16(65535, address.port);
    assert_read(LINK_TCP, "tcp:[::1]:1");
    TEST_ASSERT_EQUAL_STRING("::1", address.name);
}

static void test_no_tcp(void)
{
    assert_refused("host and a port", "tcp:");
    assert_refused("host and a port", "tcp:5000");
    assert_refused("host and a port", "tcp::5000");
    assert_refused("host and a port", "tcp:::1:5000");
    assert_refused("host and a port", "tcp:[]:5000");
    assert_refused("65535", "tcp:robot7:0");
    assert_refused("65535", "tcp:robot7:65536");
    assert_refused("65535", "tcp:robot7:");
    assert_refused("65535", "tcp:robot7:+80");
    assert_refused("65535", "tcp:robot7: 80");
}

static void test_other_words(void)
{
    assert_refused("rfcomm:", "");
    assert_refused("rfcomm:", "/dev/ttyUSB0");
    assert_refused("rfcomm:", "TTY:/dev/ttyUSB0");
    assert_refused("rfcomm:", "udp:robot7:80");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_rfcomm);
    RUN_TEST(test_no_rfcomm);
    RUN_TEST(test_tty);
    RUN_TEST(test_tcp);
    RUN_TEST(test_no_tcp);
    RUN_TEST(test_other_words);
    return UNITY_END();
}
