/* cursor.h: reads a message field by field and never beyond its end.
 *
 * A read beyond the end fails, gives 0, and so does every later one: a decoder reads on and asks
 * once, cursor_good(), before it believes anything. */
#ifndef CURSOR_H
#define CURSOR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct cursor {
    const uint8_t *at;
    size_t left;
    bool failed;
};

struct cursor cursor_over(const void *bytes, size_t count);

/* Nothing has been read beyond the end, and nothing has failed by cursor_fail(). */
bool cursor_good(const struct cursor *cursor);

/* What has been read makes no sense: all that follows fails. */
void cursor_fail(struct cursor *cursor);

/* The next `count` bytes, or NULL where there are not so many. */
const uint8_t *cursor_bytes(struct cursor *cursor, size_t count);

void cursor_skip(struct cursor *cursor, size_t count);

/* `count` things of at least `size` bytes each could be there; else fails. To be asked before a
 * loop over a count that was read. `size` is not 0. */
bool cursor_holds(struct cursor *cursor, uint64_t count, size_t size);

/* As cursor_skip() over `count` things of `size` bytes; no product of the two is too large. */
void cursor_skip_all(struct cursor *cursor, uint64_t count, size_t size);

/* The next `count` bytes as a cursor of their own, and goes on behind them. Fails both where there
 * are not so many. */
struct cursor cursor_part(struct cursor *cursor, size_t count);

/* Of all text: control characters become question marks.
 *
 * A string with its NUL, which has to come within `room` bytes, into `text` of as many. */
void cursor_string(struct cursor *cursor, char *text, size_t room);

/* A string with its NUL, of any length: what `room` does not hold is cut off, and nothing is kept
 * where `room` is 0. */
void cursor_string_cut(struct cursor *cursor, char *text, size_t room);

/* Text in a field of `width` bytes: up to its first NUL, and cut off to `room`. */
void cursor_text(struct cursor *cursor, size_t width, char *text, size_t room);

uint8_t cursor_u8(struct cursor *cursor);

uint16_t cursor_u16_le(struct cursor *cursor);
uint32_t cursor_u32_le(struct cursor *cursor);
uint64_t cursor_u64_le(struct cursor *cursor);
int16_t cursor_i16_le(struct cursor *cursor);
int32_t cursor_i32_le(struct cursor *cursor);
float cursor_f32_le(struct cursor *cursor);
double cursor_f64_le(struct cursor *cursor);

uint16_t cursor_u16_be(struct cursor *cursor);
uint32_t cursor_u32_be(struct cursor *cursor);
uint64_t cursor_u64_be(struct cursor *cursor);
int16_t cursor_i16_be(struct cursor *cursor);
int32_t cursor_i32_be(struct cursor *cursor);
float cursor_f32_be(struct cursor *cursor);
double cursor_f64_be(struct cursor *cursor);

#endif
