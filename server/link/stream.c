#include "stream.h"

#include <errno.h>
#include <sys/socket.h>
#include <unistd.h>

int stream_error(const struct stream *stream)
{
    int error = 0;
    socklen_t length = sizeof error;

    if (getsockopt(stream->watch.fd, SOL_SOCKET, SO_ERROR, &error, &length) != 0)
        return errno;
    return error;
}

enum stream_step stream_connected(const struct stream *stream)
{
    int error = stream_error(stream);

    if (error == 0)
        return STREAM_CONNECTED;
    errno = error;
    return STREAM_FAILED;
}

void stream_close(struct stream *stream)
{
    if (stream->watch.fd >= 0)
        close(stream->watch.fd);
    stream->watch.fd = -1;
}
