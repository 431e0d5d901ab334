/* cdr.h: OMG's Common Data Representation as ROS 2 uses it: little-endian, each value aligned to
 * its size from behind the head of 4 bytes. Writing past the room and reading past the end are
 * noticed once, at the end. */
#ifndef CDR_H
#define CDR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct cdr_writer {
    uint8_t *bytes;
    size_t room, used;
    bool full; /* something did not fit */
};

struct cdr_writer cdr_begin(uint8_t *bytes, size_t room); /* writes the head */
void cdr_u8(struct cdr_writer *cdr, uint8_t value);
void cdr_u16(struct cdr_writer *cdr, uint16_t value);
void cdr_u32(struct cdr_writer *cdr, uint32_t value);
void cdr_i32(struct cdr_writer *cdr, int32_t value);
void cdr_f64(struct cdr_writer *cdr, double value);
void cdr_bool(struct cdr_writer *cdr, bool value);
void cdr_string(struct cdr_writer *cdr, const char *text); /* what is no UTF-8 becomes '?' */
void cdr_time(struct cdr_writer *cdr, int32_t time_ms);    /* builtin_interfaces/Time */

/* Values that lie in memory as they do in the message. */
void cdr_block(struct cdr_writer *cdr, const void *block, size_t count, size_t align);

size_t cdr_end(const struct cdr_writer *cdr); /* bytes; 0: did not fit */

struct cdr_reader {
    const uint8_t *bytes;
    size_t count, used;
    bool short_of; /* something was missing or out of bounds; values read since are 0 */
};

struct cdr_reader cdr_open(const uint8_t *bytes, size_t count);
uint8_t cdr_take_u8(struct cdr_reader *cdr);
uint16_t cdr_take_u16(struct cdr_reader *cdr);
uint32_t cdr_take_u32(struct cdr_reader *cdr);
int32_t cdr_take_i32(struct cdr_reader *cdr);
double cdr_take_f64(struct cdr_reader *cdr);
bool cdr_take_bool(struct cdr_reader *cdr);
int32_t cdr_take_time(struct cdr_reader *cdr); /* ms */

/* Elements of a sequence, each of at least `size` bytes: never more than can follow. */
size_t cdr_take_count(struct cdr_reader *cdr, size_t size);

/* Points into the message. NULL when it is not all there. */
const uint8_t *cdr_take_block(struct cdr_reader *cdr, size_t count, size_t align);

/* Copies a string of less than `room` bytes. */
void cdr_take_string(struct cdr_reader *cdr, char *text, size_t room);

#endif
