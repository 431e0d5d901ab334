/* mcap_bytes.h: MCAP's records being put together in memory that grows. That there was none left is
 * noticed once, at the end. */
#ifndef MCAP_BYTES_H
#define MCAP_BYTES_H

#include "mcap.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Zeros are an empty one. */
struct mcap_bytes {
    uint8_t *at;
    size_t count, room;
    bool failed; /* there was no memory: what has been put since is missing */
};

void mcap_bytes_free(struct mcap_bytes *bytes);

/* Room for `count` more, where the caller writes them before he counts them; NULL: no memory. */
uint8_t *mcap_reserve(struct mcap_bytes *bytes, size_t count);

void mcap_put(struct mcap_bytes *bytes, const void *from, size_t count);
void mcap_put_u16(struct mcap_bytes *bytes, uint16_t value);
void mcap_put_u32(struct mcap_bytes *bytes, uint32_t value);
void mcap_put_u64(struct mcap_bytes *bytes, uint64_t value);
void mcap_put_text(struct mcap_bytes *bytes, const char *text);

/* A record: its head, whose length mcap_end() fills in. Returns where its contents begin. */
size_t mcap_begin(struct mcap_bytes *bytes, enum mcap_opcode opcode);
void mcap_end(struct mcap_bytes *bytes, size_t begun);

/* A map or an array, likewise. */
size_t mcap_begin_map(struct mcap_bytes *bytes);
void mcap_end_map(struct mcap_bytes *bytes, size_t begun);

#endif
