#include "origin.h"

#include <arpa/inet.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#define HOST_MAX 256

/* "HOST", "HOST:PORT" or "[ADDRESS]:PORT" without the port and brackets. */
static bool take_host(const char *text, char host[HOST_MAX])
{
    const char *begin = text[0] == '[' ? text + 1 : text;
    size_t length = strcspn(begin, text[0] == '[' ? "]" : ":");
    const char *rest = begin + length + (text[0] == '[' && begin[length] == ']');

    if (length == 0 || length >= HOST_MAX || (text[0] == '[' && begin[length] != ']'))
        return false;
    if (*rest == ':')
        rest += 1 + strspn(rest + 1, "0123456789");
    snprintf(host, HOST_MAX, "%.*s", (int)length, begin);
    return *rest == '\0';
}

static bool is_address(const char *host)
{
    struct in6_addr place;

    return inet_pton(AF_INET, host, &place) == 1 || inet_pton(AF_INET6, host, &place) == 1;
}

static bool same(const char *host, const char *name)
{
    return name != NULL && strcasecmp(host, name) == 0;
}

/* As it is called in the network of those who have no name server. */
static bool same_local(const char *host, const char *name)
{
    size_t length = name != NULL ? strlen(name) : 0;

    return length > 0 && strncasecmp(host, name, length) == 0 &&
           strcasecmp(host + length, ".local") == 0;
}

bool origin_host_is_ours(const char *text, const char *machine, const char *address)
{
    char host[HOST_MAX];

    return take_host(text, host) &&
           (is_address(host) || same(host, "localhost") || same(host, machine) ||
            same_local(host, machine) || same(host, address));
}

bool origin_is_own(const char *origin, const char *host)
{
    static const char scheme[] = "http://";
    size_t length = sizeof scheme - 1;

    return strncasecmp(origin, scheme, length) == 0 && strcasecmp(origin + length, host) == 0;
}

static bool is_of_this_machine(const char *origin)
{
    static const char *const schemes[] = {"http://", "https://"};
    char host[HOST_MAX];

    for (int i = 0; i < 2; i++) {
        size_t length = strlen(schemes[i]);

        if (strncasecmp(origin, schemes[i], length) == 0 && take_host(origin + length, host))
            return same(host, "localhost") || same(host, "127.0.0.1") || same(host, "::1");
    }
    return false;
}

bool origin_shows_foxglove(const char *origin)
{
    static const char *const known[] = {"https://app.foxglove.dev", "https://studio.foxglove.dev",
                                        "https://lichtblick-suite.github.io", "file://"};

    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (strcasecmp(origin, known[i]) == 0)
            return true;
    return is_of_this_machine(origin);
}
