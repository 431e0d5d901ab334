#include "clients.h"

#include <string.h>
#include <unity.h>

static struct clients clients;

void setUp(void)
{
    memset(&clients, 0, sizeof clients);
}

void tearDown(void)
{
}

static bool hear(uint32_t host, uint16_t port, int64_t now_us)
{
    struct sockaddr_in address = {AF_INET, htons(port), {htonl(host)}, {0}};

    return clients_hear(&clients, &address, now_us);
}

static void test_a_client_is_its_address_and_port(void)
{
    TEST_ASSERT_TRUE(hear(1, 1000, 0));
    TEST_ASSERT_TRUE(hear(2, 1000, 0));
    TEST_ASSERT_TRUE(hear(1, 1001, 0));
    TEST_ASSERT_FALSE(hear(1, 1000, 5));
    TEST_ASSERT_EQUAL_INT(3, clients.count);
}

static void test_who_does_not_ask_again_is_dropped(void)
{
    hear(1, 1, 0);
    hear(2, 2, 0);
    hear(3, 3, 0);
    hear(2, 2, 1);
    clients_judge(&clients, CLIENTS_SILENCE_US - 1);
    TEST_ASSERT_EQUAL_INT(3, clients.count);
    clients_judge(&clients, CLIENTS_SILENCE_US);
    TEST_ASSERT_EQUAL_INT(1, clients.count);
    TEST_ASSERT_EQUAL_UINT(2, ntohs(clients.client[0].address.sin_port));
}

static void test_one_too_many_replaces_the_least_recent(void)
{
    for (uint16_t i = 0; i < CLIENTS_MAX; i++)
        hear(1, i, i == 4 ? 0 : 10);
    TEST_ASSERT_TRUE(hear(1, 100, 11));
    TEST_ASSERT_EQUAL_INT(CLIENTS_MAX, clients.count);
    TEST_ASSERT_EQUAL_UINT(100, ntohs(clients.client[4].address.sin_port));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_client_is_its_address_and_port);
    RUN_TEST(test_who_does_not_ask_again_is_dropped);
    RUN_TEST(test_one_too_many_replaces_the_least_recent);
    return UNITY_END();
}
