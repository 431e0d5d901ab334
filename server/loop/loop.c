#include "loop.h"

#include <errno.h>
#include <signal.h>
#include <stddef.h>
#include <sys/epoll.h>
#include <sys/signalfd.h>
#include <sys/timerfd.h>
#include <time.h>
#include <unistd.h>

bool loop_open(struct loop *loop)
{
    *loop = (struct loop){.epoll = epoll_create1(EPOLL_CLOEXEC)};
    return loop->epoll >= 0;
}

void loop_close(struct loop *loop)
{
    close(loop->epoll);
}

bool loop_watch(struct loop *loop, struct watch *watch, uint32_t events)
{
    struct epoll_event event = {.events = events, .data.ptr = watch};
    int change = watch->watched ? EPOLL_CTL_MOD : EPOLL_CTL_ADD;

    if (epoll_ctl(loop->epoll, change, watch->fd, &event) != 0)
        return false;
    watch->watched = true;
    return true;
}

void loop_forget(struct loop *loop, struct watch *watch)
{
    if (!watch->watched)
        return;
    epoll_ctl(loop->epoll, EPOLL_CTL_DEL, watch->fd, NULL);
    watch->watched = false;
    for (int i = 0; i < loop->batch_count; i++)
        if (loop->batch[i] == watch)
            loop->batch[i] = NULL;
}

bool loop_wait(struct loop *loop)
{
    struct epoll_event events[LOOP_BATCH];
    int count = epoll_wait(loop->epoll, events, LOOP_BATCH, -1);

    if (count < 0)
        return errno == EINTR;
    for (int i = 0; i < count; i++)
        loop->batch[i] = events[i].data.ptr;
    loop->batch_count = count;
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < count; i++) {
            struct watch *watch = loop->batch[i];

            if (watch == NULL || watch->urgent != (pass == 0))
                continue;
            loop->batch[i] = NULL;
            watch->ready(watch, events[i].events);
        }
    }
    loop->batch_count = 0;
    return true;
}

int64_t loop_now(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec * INT64_C(1000000) + now.tv_nsec / 1000;
}

int loop_timer(int64_t period_us)
{
    struct timespec period = {period_us / 1000000, period_us % 1000000 * 1000};
    struct itimerspec spec = {period, period};
    int fd = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);

    if (fd >= 0 && timerfd_settime(fd, 0, &spec, NULL) != 0) {
        close(fd);
        return -1;
    }
    return fd;
}

int loop_signals(const int numbers[])
{
    sigset_t set;

    sigemptyset(&set);
    for (size_t i = 0; numbers[i] != 0; i++)
        sigaddset(&set, numbers[i]);
    if (sigprocmask(SIG_BLOCK, &set, NULL) != 0)
        return -1;
    return signalfd(-1, &set, SFD_NONBLOCK | SFD_CLOEXEC);
}

int loop_signal(int signals)
{
    struct signalfd_siginfo signal;

    return read(signals, &signal, sizeof signal) == sizeof signal ? (int)signal.ssi_signo : 0;
}

uint64_t loop_periods(int timer)
{
    uint64_t periods = 0;

    if (read(timer, &periods, sizeof periods) != sizeof periods)
        return 0;
    return periods;
}
