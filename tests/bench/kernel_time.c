#include "kernel_time.h"

#include <err.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>

static int64_t ns_of(struct timespec time)
{
    return (int64_t)time.tv_sec * 1000000000 + time.tv_nsec;
}

int64_t real_ns(void)
{
    struct timespec now;

    clock_gettime(CLOCK_REALTIME, &now);
    return ns_of(now);
}

void want_time(int fd)
{
    if (setsockopt(fd, SOL_SOCKET, SO_TIMESTAMPNS, &(int){1}, sizeof(int)) != 0)
        err(EXIT_FAILURE, "times of arrival");
}

ssize_t receive_at(int fd, void *bytes, size_t room, int64_t *at)
{
    union {
        struct cmsghdr header;
        char room[CMSG_SPACE(sizeof(struct timespec))];
    } control;
    struct iovec part = {bytes, room};
    struct msghdr message = {
        .msg_iov = &part,
        .msg_iovlen = 1,
        .msg_control = &control,
        .msg_controllen = sizeof control,
    };
    ssize_t count = recvmsg(fd, &message, 0);
    struct cmsghdr *header = count < 0 ? NULL : CMSG_FIRSTHDR(&message);

    if (header != NULL && header->cmsg_type == SCM_TIMESTAMPNS) {
        struct timespec time;
        memcpy(&time, CMSG_DATA(header), sizeof time);
        *at = ns_of(time);
    } else if (count > 0) {
        errx(EXIT_FAILURE, "the kernel tells no times of arrival");
    }
    return count;
}
