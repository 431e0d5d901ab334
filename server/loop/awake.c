#include "awake.h"

#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <unistd.h>

int awake_hold(void)
{
    const int32_t latency_us = 0;
    int fd = open("/dev/cpu_dma_latency", O_WRONLY | O_CLOEXEC);

    if (fd < 0 || write(fd, &latency_us, sizeof latency_us) == sizeof latency_us)
        return fd;
    int error = errno;
    close(fd);
    errno = error;
    return -1;
}
