/* cassette.h: a small recording, its bytes and where its chunks end. */
#ifndef CASSETTE_H
#define CASSETTE_H

#include <stddef.h>
#include <stdint.h>

#define CASSETTE_CHUNKS 3
#define CASSETTE_MESSAGES 4 /* a chunk */
#define CASSETTE_ROOM 8192

struct cassette {
    uint8_t bytes[CASSETTE_ROOM];
    size_t count;
    size_t head;                       /* where the first chunk begins */
    size_t chunk_end[CASSETTE_CHUNKS]; /* without its index */
};

/* Two topics, "/even" and "/odd", take turns; message k has time 20 k ms and is k + 1 bytes long,
 * of value k each. */
void cassette_make(struct cassette *cassette);

/* Into a file, its first `count` bytes. */
void cassette_save(const struct cassette *cassette, const char *path, size_t count);

/* Chunks that are whole in the first `count` bytes. */
size_t cassette_chunks(const struct cassette *cassette, size_t count);

/* Message k is what it was. */
void cassette_assert(size_t k, const uint8_t *bytes, size_t count);

#endif
