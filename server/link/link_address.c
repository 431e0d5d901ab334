#include "stream.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CHANNEL_MAX 30

static bool refuse(char words[LINK_WORDS_MAX], const char *what)
{
    snprintf(words, LINK_WORDS_MAX, "%s", what);
    return false;
}

/* A decimal number of 1 to `most`, and nothing else: no sign, no space. */
static bool read_number(const char *text, unsigned long most, unsigned long *number)
{
    size_t digits = strspn(text, "0123456789");

    if (digits == 0 || text[digits] != '\0')
        return false;
    *number = strtoul(text, NULL, 10);
    return *number >= 1 && *number <= most;
}

static int hex_digit(char c)
{
    static const char digits[] = "0123456789abcdef0123456789ABCDEF";
    const char *found = c == '\0' ? NULL : strchr(digits, c);

    return found == NULL ? -1 : (int)((found - digits) % 16);
}

/* Six pairs with colons between them; where they end, or NULL. */
static const char *read_bluetooth(const char *text, uint8_t bytes[6])
{
    for (size_t i = 0; i < 6; i++, text += 2) {
        if (i > 0 && *text++ != ':')
            return NULL;
        int high = hex_digit(text[0]);
        int low = high < 0 ? -1 : hex_digit(text[1]);
        if (low < 0)
            return NULL;
        bytes[i] = (uint8_t)(high << 4 | low);
    }
    return text;
}

static bool read_rfcomm(const char *text, struct link_address *address, char words[LINK_WORDS_MAX])
{
    const char *rest = read_bluetooth(text, address->bluetooth);
    unsigned long channel = 0;

    address->kind = LINK_RFCOMM;
    if (rest == NULL || (*rest != '\0' && *rest != '/'))
        return refuse(words,
                      "rfcomm: takes six pairs of hexadecimal digits and may take a channel: "
                      "rfcomm:00:11:22:33:44:55 or rfcomm:00:11:22:33:44:55/3");
    if (*rest == '/' && !read_number(rest + 1, CHANNEL_MAX, &channel))
        return refuse(words, "an RFCOMM channel is a number from 1 to 30");
    address->channel = (uint8_t)channel;
    return true;
}

static bool read_tty(const char *text, struct link_address *address, char words[LINK_WORDS_MAX])
{
    address->kind = LINK_TTY;
    if (text[0] != '/')
        return refuse(words, "tty: takes an absolute path: tty:/dev/ttyUSB0");
    if (strlen(text) >= sizeof address->name)
        return refuse(words, "the path of a tty has at most 107 characters");
    strcpy(address->name, text);
    return true;
}

static bool read_tcp(const char *text, struct link_address *address, char words[LINK_WORDS_MAX])
{
    const char *colon = strrchr(text, ':');
    size_t length = colon == NULL ? 0 : (size_t)(colon - text);
    bool bracketed = length > 2 && text[0] == '[' && colon[-1] == ']';
    unsigned long port;

    address->kind = LINK_TCP;
    if (length == 0 || (!bracketed && strcspn(text, ":[]") < length))
        return refuse(words, "tcp: takes a host and a port: tcp:192.168.0.7:5000, "
                             "tcp:robot7.lan:5000 or tcp:[fd00::7]:5000");
    if (!read_number(colon + 1, UINT16_MAX, &port))
        return refuse(words, "a TCP port is a number from 1 to 65535");
    if (bracketed) {
        text++;
        length -= 2;
    }
    if (length >= sizeof address->name)
        return refuse(words, "the name of a host has at most 107 characters");
    memcpy(address->name, text, length);
    address->port = (uint16_t)port;
    return true;
}

bool link_address_read(const char *text, struct link_address *address, char words[LINK_WORDS_MAX])
{
    static const struct {
        const char *prefix;
        bool (*read)(const char *rest, struct link_address *address, char words[LINK_WORDS_MAX]);
    } kinds[] = {{"rfcomm:", read_rfcomm}, {"tty:", read_tty}, {"tcp:", read_tcp}};

    memset(address, 0, sizeof *address);
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        size_t length = strlen(kinds[i].prefix);
        if (strncmp(text, kinds[i].prefix, length) == 0)
            return kinds[i].read(text + length, address, words);
    }
    return refuse(words,
                  "an address is rfcomm:00:11:22:33:44:55, tty:/dev/ttyUSB0 or tcp:HOST:PORT");
}

void link_address_write(const struct link_address *address, char *text, size_t room)
{
    const uint8_t *b = address->bluetooth;
    const char *name = address->name;

    switch (address->kind) {
    case LINK_RFCOMM:
        snprintf(text, room, "rfcomm:%02X:%02X:%02X:%02X:%02X:%02X", b[0], b[1], b[2], b[3], b[4],
                 b[5]);
        return;
    case LINK_TTY: snprintf(text, room, "tty:%s", name); return;
    case LINK_TCP:
        snprintf(text, room, strchr(name, ':') != NULL ? "tcp:[%s]:%u" : "tcp:%s:%u", name,
                 address->port);
        return;
    }
}
