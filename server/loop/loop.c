#include "loop.h"

#include <errno.h>
#include <signal.h>
#include <stddef.h>
#include <sys/epoll.h>
#include <sys/signalfd.h>
#include <sys/timerfd.h>
#include <time.h>
#include <unistd.h>

/* Ordinary ones that are told of before urgent ones are looked for again. */
#define TURNS 4

static bool add(struct loop_set *set, int fd, uint32_t events, int change, struct watch *watch)
{
    struct epoll_event event = {.events = events, .data.ptr = watch};

    return epoll_ctl(set->epoll, change, fd, &event) == 0;
}

bool loop_open(struct loop *loop)
{
    *loop = (struct loop){
        .urgent.epoll = epoll_create1(EPOLL_CLOEXEC),
        .ordinary.epoll = epoll_create1(EPOLL_CLOEXEC),
    };
    if (loop->urgent.epoll >= 0 && loop->ordinary.epoll >= 0 &&
        add(&loop->ordinary, loop->urgent.epoll, EPOLLIN, EPOLL_CTL_ADD, NULL))
        return true;
    int error = errno;
    loop_close(loop);
    errno = error;
    return false;
}

void loop_close(struct loop *loop)
{
    if (loop->urgent.epoll >= 0)
        close(loop->urgent.epoll);
    if (loop->ordinary.epoll >= 0)
        close(loop->ordinary.epoll);
    loop->urgent.epoll = loop->ordinary.epoll = -1;
}

static struct loop_set *set_of(struct loop *loop, const struct watch *watch)
{
    return watch->urgent ? &loop->urgent : &loop->ordinary;
}

bool loop_watch(struct loop *loop, struct watch *watch, uint32_t events)
{
    int change = watch->watched ? EPOLL_CTL_MOD : EPOLL_CTL_ADD;

    if (!add(set_of(loop, watch), watch->fd, events, change, watch))
        return false;
    watch->watched = true;
    return true;
}

void loop_forget(struct loop *loop, struct watch *watch)
{
    struct loop_set *set = set_of(loop, watch);

    if (!watch->watched)
        return;
    epoll_ctl(set->epoll, EPOLL_CTL_DEL, watch->fd, NULL);
    watch->watched = false;
    for (int i = 0; i < set->count; i++)
        if (set->batch[i] == watch)
            set->batch[i] = NULL;
}

/* What is ready; events[i] is batch[i]'s. False with errno. */
static bool collect(struct loop_set *set, int timeout, uint32_t events[LOOP_BATCH])
{
    struct epoll_event ready[LOOP_BATCH];
    int count = epoll_wait(set->epoll, ready, LOOP_BATCH, timeout);

    set->count = count > 0 ? count : 0;
    for (int i = 0; i < count; i++) {
        set->batch[i] = ready[i].data.ptr;
        events[i] = ready[i].events;
    }
    return count >= 0 || errno == EINTR;
}

static void tell(struct loop_set *set, int i, uint32_t events)
{
    struct watch *watch = set->batch[i];

    set->batch[i] = NULL;
    if (watch != NULL)
        watch->ready(watch, events);
}

static bool tell_urgent(struct loop *loop)
{
    uint32_t events[LOOP_BATCH];

    if (!collect(&loop->urgent, 0, events))
        return false;
    for (int i = 0; i < loop->urgent.count; i++)
        tell(&loop->urgent, i, events[i]);
    loop->urgent.count = 0;
    return true;
}

bool loop_wait(struct loop *loop)
{
    uint32_t events[LOOP_BATCH];
    bool good = collect(&loop->ordinary, -1, events);

    for (int i = 0; good && i < loop->ordinary.count; i++) {
        if (i % TURNS == 0)
            good = tell_urgent(loop);
        tell(&loop->ordinary, i, events[i]);
    }
    loop->ordinary.count = 0;
    return good;
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
