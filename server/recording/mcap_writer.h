/* mcap_writer.h: writes an MCAP file: messages in chunks compressed by zstd, an index of them, and
 * CRCs of everything.
 *
 * What is given is the same file, byte for byte. A chunk is handed to the system at once when it is
 * cut, in one piece with its index. */
#ifndef MCAP_WRITER_H
#define MCAP_WRITER_H

#include "mcap_bytes.h"

struct mcap_writer;

/* Bytes of messages after which a chunk is cut in any case. */
#define MCAP_CHUNK_BYTES (4 << 20)

/* Into a file that is empty, from its beginning; it stays the caller's. NULL: no memory. */
struct mcap_writer *mcap_writer_open(int fd);

/* The contents of a Header, which comes first, a Schema, a Channel or a Metadata. A schema or
 * channel whose id there is already is left out. */
void mcap_writer_record(struct mcap_writer *writer, enum mcap_opcode opcode,
                        const uint8_t *contents, size_t count);

void mcap_writer_header(struct mcap_writer *writer, const char *profile, const char *library);
void mcap_writer_schema(struct mcap_writer *writer, uint16_t id, const char *name,
                        const char *encoding, const char *definition);

/* Of profile ros2: what publishers offer is not known, and that is said. */
void mcap_writer_channel(struct mcap_writer *writer, uint16_t id, uint16_t schema,
                         const char *topic, const char *encoding);

/* `pairs`: as many keys with a value behind each. */
void mcap_writer_metadata(struct mcap_writer *writer, const char *name, const char *const pairs[],
                          size_t count);

/* False when there is no such channel. */
bool mcap_writer_message(struct mcap_writer *writer, uint16_t channel, uint64_t time_ns,
                         const uint8_t *bytes, size_t count);

/* Hands over all that has been given: a chunk ends here. */
void mcap_writer_cut(struct mcap_writer *writer);

/* Hands over the rest, index and footer, and ends. 0, or the errno of the first thing that could
 * not be done: nothing behind it has been written. */
int mcap_writer_close(struct mcap_writer *writer);

#endif
