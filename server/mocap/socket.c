#include "socket.h"

#include "loop.h"

#include <arpa/inet.h>
#include <errno.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netdb.h>
#include <netinet/tcp.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#define RECEIVE_BYTES (1 << 20)

static bool is_inet(const struct ifaddrs *entry)
{
    return entry->ifa_addr != NULL && entry->ifa_addr->sa_family == AF_INET;
}

static struct in_addr address_of(const struct ifaddrs *entry)
{
    struct sockaddr_in address;

    memcpy(&address, entry->ifa_addr, sizeof address);
    return address.sin_addr;
}

static void tell_interfaces(const struct ifaddrs *list, const char *text, char *error, size_t room)
{
    int used = snprintf(error, room, "%s: no such interface; there are", text);

    for (const struct ifaddrs *entry = list; entry != NULL; entry = entry->ifa_next) {
        if (!is_inet(entry) || used < 0 || (size_t)used >= room)
            continue;
        used += snprintf(error + used, room - (size_t)used, " %s (%s)", entry->ifa_name,
                         inet_ntoa(address_of(entry)));
    }
}

bool socket_interface_find(const char *text, struct socket_interface *interface, char *error,
                           size_t room)
{
    struct ifaddrs *list = NULL;
    struct in_addr wanted = {INADDR_ANY};
    bool by_address = inet_pton(AF_INET, text, &wanted) == 1;
    bool found = false;

    if (getifaddrs(&list) != 0) {
        snprintf(error, room, "interfaces: %s", strerror(errno));
        return false;
    }
    for (const struct ifaddrs *entry = list; entry != NULL && !found; entry = entry->ifa_next) {
        if (!is_inet(entry))
            continue;
        struct in_addr address = address_of(entry);
        found = by_address ? address.s_addr == wanted.s_addr : strcmp(entry->ifa_name, text) == 0;
        *interface = (struct socket_interface){if_nametoindex(entry->ifa_name), address};
    }
    if (!found)
        tell_interfaces(list, text, error, room);
    freeifaddrs(list);
    return found;
}

struct socket_interface socket_interface_towards(const struct sockaddr_in *system)
{
    struct sockaddr_in ours = {.sin_family = AF_INET};
    socklen_t length = sizeof ours;
    int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);

    /* Connecting a UDP socket only asks for the route. */
    if (fd >= 0 && connect(fd, (const struct sockaddr *)system, sizeof *system) == 0)
        getsockname(fd, (struct sockaddr *)&ours, &length);
    if (fd >= 0)
        close(fd);
    return (struct socket_interface){0, ours.sin_addr};
}

const char *socket_words(const struct sockaddr_in *address, char words[SOCKET_WORDS_MAX])
{
    char text[INET_ADDRSTRLEN];

    inet_ntop(AF_INET, &address->sin_addr, text, sizeof text);
    if (address->sin_port == 0)
        snprintf(words, SOCKET_WORDS_MAX, "%s", text);
    else
        snprintf(words, SOCKET_WORDS_MAX, "%s:%u", text, ntohs(address->sin_port));
    return words;
}

static int fail(int fd)
{
    int error = errno;

    close(fd);
    errno = error;
    return -1;
}

static bool set(int fd, int level, int option, int value)
{
    return setsockopt(fd, level, option, &value, sizeof value) == 0;
}

/* With room for some large datagrams, as far as the kernel allows. */
static int datagram_socket(void)
{
    int fd = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);

    if (fd >= 0 &&
        (!set(fd, SOL_SOCKET, SO_TIMESTAMPNS, 1) || !set(fd, SOL_SOCKET, SO_RCVBUF, RECEIVE_BYTES)))
        return fail(fd);
    return fd;
}

static bool bind_to(int fd, uint16_t port)
{
    struct sockaddr_in any = {.sin_family = AF_INET, .sin_port = htons(port)};

    return bind(fd, (struct sockaddr *)&any, sizeof any) == 0;
}

int socket_ask(void)
{
    int fd = datagram_socket();

    if (fd >= 0 && (!set(fd, IPPROTO_IP, IP_RECVERR, 1) || !bind_to(fd, 0)))
        return fail(fd);
    return fd;
}

int socket_listen(uint16_t port)
{
    int fd = datagram_socket();

    if (fd >= 0 && !bind_to(fd, port))
        return fail(fd);
    return fd;
}

int socket_join(struct in_addr group, uint16_t port, const struct socket_interface *interface)
{
    struct ip_mreqn request = {group, interface->address, (int)interface->index};
    int fd = datagram_socket();

    if (fd < 0)
        return -1;
    /* Without IP_MULTICAST_ALL = 0 it would hear every group that anybody here has joined. */
    if (!set(fd, SOL_SOCKET, SO_REUSEADDR, 1) || !set(fd, IPPROTO_IP, IP_MULTICAST_ALL, 0) ||
        !bind_to(fd, port) ||
        setsockopt(fd, IPPROTO_IP, IP_ADD_MEMBERSHIP, &request, sizeof request) != 0)
        return fail(fd);
    return fd;
}

/* A system that is gone without a word is noticed within some seconds. */
static bool probe(int fd)
{
    return set(fd, SOL_SOCKET, SO_KEEPALIVE, 1) && set(fd, IPPROTO_TCP, TCP_KEEPIDLE, 2) &&
           set(fd, IPPROTO_TCP, TCP_KEEPINTVL, 1) && set(fd, IPPROTO_TCP, TCP_KEEPCNT, 3);
}

int socket_connect(const struct sockaddr_in *address)
{
    int fd = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);

    if (fd < 0)
        return -1;
    if (!probe(fd))
        return fail(fd);
    if (connect(fd, (const struct sockaddr *)address, sizeof *address) != 0 && errno != EINPROGRESS)
        return fail(fd);
    return fd;
}

int socket_error(int fd)
{
    int error = 0;
    socklen_t length = sizeof error;

    if (getsockopt(fd, SOL_SOCKET, SO_ERROR, &error, &length) != 0)
        return errno;
    return error;
}

static int64_t date_now_us(void)
{
    struct timespec now;

    clock_gettime(CLOCK_REALTIME, &now);
    return now.tv_sec * INT64_C(1000000) + now.tv_nsec / 1000;
}

/* The kernel stamps with the date, which somebody may have changed since: only the age counts. The
 * date is read first, so that whatever comes between makes an arrival late and never early: the
 * least delayed frame is what all others are judged by. */
static int64_t arrival_of(struct msghdr *message, int64_t since_us)
{
    int64_t date_us = date_now_us();
    int64_t now_us = loop_now();

    for (struct cmsghdr *part = CMSG_FIRSTHDR(message); part != NULL;
         part = CMSG_NXTHDR(message, part)) {
        struct timespec stamp;

        if (part->cmsg_level != SOL_SOCKET || part->cmsg_type != SO_TIMESTAMPNS)
            continue;
        memcpy(&stamp, CMSG_DATA(part), sizeof stamp);
        int64_t stamp_us = stamp.tv_sec * INT64_C(1000000) + stamp.tv_nsec / 1000;
        int64_t arrival_us = now_us - (date_us - stamp_us);
        if (arrival_us >= since_us && arrival_us <= now_us)
            return arrival_us;
    }
    return now_us;
}

/* Takes what the network has told of datagrams that were sent: their errno has been told already.
 */
static void drop_errors(int fd)
{
    char control[512];
    struct msghdr message = {.msg_control = control, .msg_controllen = sizeof control};

    while (recvmsg(fd, &message, MSG_ERRQUEUE | MSG_DONTWAIT) >= 0)
        message.msg_controllen = sizeof control;
}

ssize_t socket_receive(int fd, void *bytes, size_t room, struct sockaddr_in *from, int64_t since_us,
                       int64_t *arrival_us)
{
    _Alignas(struct cmsghdr) char control[128];
    struct iovec space = {bytes, room};
    struct msghdr message = {
        .msg_name = from,
        .msg_namelen = sizeof *from,
        .msg_iov = &space,
        .msg_iovlen = 1,
        .msg_control = control,
        .msg_controllen = sizeof control,
    };
    ssize_t count = recvmsg(fd, &message, MSG_DONTWAIT);

    if (count < 0) {
        int error = errno;
        drop_errors(fd);
        errno = error;
        return -1;
    }
    *arrival_us = arrival_of(&message, since_us);
    return count;
}
