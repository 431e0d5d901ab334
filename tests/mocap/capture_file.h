/* capture_file.h: the UDP datagrams of a pcapng file. */
#ifndef CAPTURE_FILE_H
#define CAPTURE_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct capture_file {
    uint8_t *bytes;
    size_t size, at;
    uint16_t link_types[8]; /* of the interfaces of the section */
    size_t interfaces;
};

/* False when it cannot be read or is none in this machine's order of bytes. */
bool capture_file_open(struct capture_file *file, const char *path);
void capture_file_close(struct capture_file *file);

/* The next whole UDP datagram over IPv4 and Ethernet, or NULL at the end. All else is passed over.
 */
const uint8_t *capture_file_next(struct capture_file *file, size_t *count);

#endif
