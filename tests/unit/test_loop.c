#include "loop.h"

#include <signal.h>
#include <stddef.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <unistd.h>
#include <unity.h>

#define ORDINARY 20

static struct loop loop;
static struct watch ordinary[ORDINARY], urgent;
static unsigned told, urgent_told;
static unsigned told_before_urgent; /* ordinary ones, after it had become ready */

static void raise_event(const struct watch *watch)
{
    TEST_ASSERT_EQUAL_INT(0, eventfd_write(watch->fd, 1));
}

static void on_ordinary(struct watch *watch, uint32_t events)
{
    eventfd_t value;

    TEST_ASSERT_TRUE(events & EPOLLIN);
    eventfd_read(watch->fd, &value);
    told++;
    if (told == 3)
        raise_event(&urgent);
    else if (told > 3 && urgent_told == 0)
        told_before_urgent++;
}

static void on_urgent(struct watch *watch, uint32_t events)
{
    eventfd_t value;

    (void)events;
    eventfd_read(watch->fd, &value);
    urgent_told++;
}

static void forget_the_rest(struct watch *watch, uint32_t events)
{
    on_ordinary(watch, events);
    for (int i = 0; i < ORDINARY; i++)
        if (&ordinary[i] != watch)
            loop_forget(&loop, &ordinary[i]);
}

static void watch_event(struct watch *watch, bool first, void (*ready)(struct watch *, uint32_t))
{
    *watch = (struct watch){.fd = eventfd(0, EFD_NONBLOCK), .urgent = first, .ready = ready};
    TEST_ASSERT_TRUE(loop_watch(&loop, watch, EPOLLIN));
}

void setUp(void)
{
    told = urgent_told = told_before_urgent = 0;
    TEST_ASSERT_TRUE(loop_open(&loop));
    for (int i = 0; i < ORDINARY; i++)
        watch_event(&ordinary[i], false, on_ordinary);
    watch_event(&urgent, true, on_urgent);
}

void tearDown(void)
{
    for (int i = 0; i < ORDINARY; i++)
        close(ordinary[i].fd);
    close(urgent.fd);
    loop_close(&loop);
}

static void raise_all(void)
{
    for (int i = 0; i < ORDINARY; i++)
        raise_event(&ordinary[i]);
}

static void test_all_that_is_ready_is_told(void)
{
    raise_all();
    raise_event(&urgent);
    TEST_ASSERT_TRUE(loop_wait(&loop));
    TEST_ASSERT_EQUAL_UINT(ORDINARY, told);
}

static void test_an_urgent_one_alone_ends_the_wait(void)
{
    raise_event(&urgent);
    TEST_ASSERT_TRUE(loop_wait(&loop));
    TEST_ASSERT_EQUAL_UINT(1, urgent_told);
    TEST_ASSERT_EQUAL_UINT(0, told);
}

/* It becomes ready while ordinary ones are being told of. */
static void test_an_urgent_one_waits_for_a_few_at_most(void)
{
    raise_all();
    TEST_ASSERT_TRUE(loop_wait(&loop));
    TEST_ASSERT_EQUAL_UINT(1, urgent_told);
    TEST_ASSERT_TRUE(told_before_urgent <= 4);
}

static void test_what_is_forgotten_is_not_told_any_more(void)
{
    for (int i = 0; i < ORDINARY; i++)
        ordinary[i].ready = forget_the_rest;
    raise_all();
    TEST_ASSERT_TRUE(loop_wait(&loop));
    TEST_ASSERT_EQUAL_UINT(1, told);
}

static void test_signals_come_as_events(void)
{
    static const int numbers[] = {SIGUSR1, SIGUSR2, 0};
    int signals = loop_signals(numbers);

    TEST_ASSERT_TRUE(signals >= 0);
    TEST_ASSERT_EQUAL_INT(0, loop_signal(signals));
    raise(SIGUSR2);
    TEST_ASSERT_EQUAL_INT(SIGUSR2, loop_signal(signals));
    TEST_ASSERT_EQUAL_INT(0, loop_signal(signals));
    close(signals);
}

static void test_one_that_is_not_open_may_be_closed(void)
{
    struct loop closed = LOOP_CLOSED;

    loop_close(&closed);
    TEST_ASSERT_EQUAL_INT(-1, closed.ordinary.epoll);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_all_that_is_ready_is_told);
    RUN_TEST(test_an_urgent_one_alone_ends_the_wait);
    RUN_TEST(test_an_urgent_one_waits_for_a_few_at_most);
    RUN_TEST(test_what_is_forgotten_is_not_told_any_more);
    RUN_TEST(test_signals_come_as_events);
    RUN_TEST(test_one_that_is_not_open_may_be_closed);
    return UNITY_END();
}
