#include "capture_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SECTION_HEADER 0x0A0D0D0Au
#define INTERFACE 1
#define ENHANCED_PACKET 6
#define ORDER_MAGIC 0x1A2B3C4Du
#define LINK_ETHERNET 1

static uint32_t u32(const uint8_t *bytes)
{
    uint32_t value;

    memcpy(&value, bytes, sizeof value);
    return value;
}

static uint16_t u16_be(const uint8_t *bytes)
{
    return (uint16_t)(bytes[0] << 8 | bytes[1]);
}

bool capture_file_open(struct capture_file *file, const char *path)
{
    FILE *in = fopen(path, "rb");
    long size = -1;

    *file = (struct capture_file){.bytes = NULL};
    if (in == NULL)
        return false;
    if (fseek(in, 0, SEEK_END) == 0)
        size = ftell(in);
    rewind(in);
    if (size >= 28)
        file->bytes = malloc((size_t)size);
    if (file->bytes != NULL)
        file->size = fread(file->bytes, 1, (size_t)size, in);
    fclose(in);
    return file->size >= 28 && u32(file->bytes) == SECTION_HEADER &&
           u32(file->bytes + 8) == ORDER_MAGIC;
}

void capture_file_close(struct capture_file *file)
{
    free(file->bytes);
}

/* The payload of a whole UDP datagram in an Ethernet packet; NULL when it is something else. */
static const uint8_t *udp_in(const uint8_t *packet, size_t size, size_t *count)
{
    if (size < 14 + 20 + 8 || u16_be(packet + 12) != 0x0800)
        return NULL;
    const uint8_t *ip = packet + 14;
    size_t header = 4 * (ip[0] & 15u);
    size_t total = u16_be(ip + 2);
    bool fragment = (u16_be(ip + 6) & 0x3FFF) != 0;

    if (ip[0] >> 4 != 4 || ip[9] != 17 || fragment || header < 20 || total > size - 14 ||
        total < header + 8)
        return NULL;
    size_t length = u16_be(ip + header + 4);
    if (length < 8 || length > total - header)
        return NULL;
    *count = length - 8;
    return ip + header + 8;
}

static const uint8_t *udp_of_block(const struct capture_file *file, const uint8_t *block,
                                   size_t size, size_t *count)
{
    if (size < 32)
        return NULL;
    uint32_t interface = u32(block + 8), captured = u32(block + 20);

    if (interface >= file->interfaces || file->link_types[interface] != LINK_ETHERNET ||
        captured > size - 32 || captured != u32(block + 24))
        return NULL;
    return udp_in(block + 28, captured, count);
}

static void add_interface(struct capture_file *file, const uint8_t *block, size_t size)
{
    if (size < 20 || file->interfaces == sizeof file->link_types / sizeof *file->link_types)
        return;
    memcpy(&file->link_types[file->interfaces++], block + 8, sizeof *file->link_types);
}

const uint8_t *capture_file_next(struct capture_file *file, size_t *count)
{
    while (file->size - file->at >= 12) {
        const uint8_t *block = file->bytes + file->at, *payload = NULL;
        uint32_t type = u32(block), size = u32(block + 4);

        if (size < 12 || size > file->size - file->at)
            return NULL;
        file->at += size;
        if (type == SECTION_HEADER)
            file->interfaces = 0;
        else if (type == INTERFACE)
            add_interface(file, block, size);
        else if (type == ENHANCED_PACKET)
            payload = udp_of_block(file, block, size, count);
        if (payload != NULL)
            return payload;
    }
    return NULL;
}
