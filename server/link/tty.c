#include "stream.h"

#include <asm/termbits.h> /* termios2, for any baud rate; <termios.h> has the other termios */
#include <errno.h>
#include <fcntl.h>
#include <stddef.h>
#include <sys/epoll.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

/* Major numbers of ptys' slaves (Linux, Documentation/admin-guide/devices.txt). */
#define PTY_MAJOR_FIRST 136
#define PTY_MAJOR_LAST 143

static bool is_pty(int fd)
{
    struct stat status;

    return fstat(fd, &status) == 0 && major(status.st_rdev) >= PTY_MAJOR_FIRST &&
           major(status.st_rdev) <= PTY_MAJOR_LAST;
}

/* Raw, 8N1, no flow control, at any rate that the device can make within 3 %: more would be another
 * rate to the robot's UART. */
static bool set_line(int fd, uint32_t baud)
{
    struct termios2 line = {
        .c_cflag = CS8 | CREAD | CLOCAL | BOTHER, .c_ispeed = baud, .c_ospeed = baud};

    line.c_cc[VMIN] = 1;
    if (ioctl(fd, TCSETS2, &line) != 0 || ioctl(fd, TCGETS2, &line) != 0)
        return false;
    int64_t error = (int64_t)line.c_ospeed - baud;
    if (error > baud * 3 / 100 || error < -(int64_t)baud * 3 / 100) {
        errno = EINVAL;
        return false;
    }
    return true;
}

/* A pty keeps TIOCEXCL as long as its master lives, and could not be dialled again. */
static enum stream_step dial(struct stream *stream)
{
    int fd = open(stream->settings->address.name, O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);

    stream->watch.fd = fd;
    if (fd < 0 || !set_line(fd, stream->settings->baud) ||
        (!is_pty(fd) && ioctl(fd, TIOCEXCL) != 0))
        return STREAM_FAILED;
    return STREAM_CONNECTED;
}

/* What has not been sent goes: close() would wait for it, for up to half a minute. */
static void hang_up(struct stream *stream)
{
    if (stream->watch.fd >= 0)
        ioctl(stream->watch.fd, TCFLSH, TCOFLUSH);
    stream_close(stream);
}

static const char *words(int error)
{
    switch (error) {
    case ENOENT: return "no such device (yet): is it plugged in?";
    case EACCES:
    case EPERM: return "no permission: is the user in the group of this device (dialout)?";
    case EBUSY: return "another program has this device";
    case ENOTTY: return "this is no tty";
    case EINVAL: return "this device cannot do this baud rate";
    case ENXIO:
    case ENODEV: return "there is no device behind this path";
    case EIO: return "the other end is gone";
    default: return NULL;
    }
}

const struct stream_kind stream_tty = {
    .dial = dial,
    .hang_up = hang_up,
    .words = words,
};
