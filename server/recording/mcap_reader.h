/* mcap_reader.h: reads an MCAP file from its beginning, as far as it is good. Its bytes are
 * believed in nothing: lengths are those that there is room for, CRCs have to agree.
 *
 * A chunk whose contents are not what was written is left out; behind a record whose length cannot
 * be, or that is not there to its end, nothing is read. Attachments, indexes and what a later MCAP
 * may bring are passed over. */
#ifndef MCAP_READER_H
#define MCAP_READER_H

#include "mcap.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

struct mcap_reader;

/* Chunks that say they would be larger are taken for damaged. */
#define MCAP_CHUNK_MAX (64 << 20)

struct mcap_text {
    const char *at; /* no NUL behind it */
    size_t length;
};

/* Points into memory that is good until the next call. */
struct mcap_record {
    enum mcap_opcode opcode; /* HEADER (which is the first), SCHEMA, CHANNEL, METADATA, MESSAGE */
    const uint8_t *contents;
    size_t count;
    uint16_t id;                  /* CHANNEL's own, MESSAGE's channel */
    struct mcap_text name, value; /* HEADER: profile, library; CHANNEL: topic, encoding; METADATA:
                                     its name and map, for mcap_pair() */
    uint64_t time_ns;             /* MESSAGE */
    const uint8_t *data;          /* MESSAGE: in CDR */
    size_t data_count;
};

enum mcap_news {
    MCAP_RECORD,
    MCAP_CUT,     /* a chunk is over */
    MCAP_WHOLE,   /* the end, with index and footer */
    MCAP_TORN,    /* it ends here, without them */
    MCAP_REFUSED, /* it is none, or goes on in a way that is not read here */
    MCAP_FAILED,  /* no memory, or the file cannot be read */
};

/* From the file's beginning; it stays the caller's. What is added to it later is not seen. NULL: no
 * memory, or it is no file that can be gone back in. */
struct mcap_reader *mcap_reader_open(FILE *file);

/* After anything but MCAP_RECORD and MCAP_CUT it is over. */
enum mcap_news mcap_reader_next(struct mcap_reader *reader, struct mcap_record *record);

/* Of MCAP_REFUSED and MCAP_FAILED, why; begins with a verb, the file being its subject. */
const char *mcap_reader_words(const struct mcap_reader *reader);

/* Whether the file ends as a whole one does, by its last bytes alone. */
bool mcap_reader_has_end(const struct mcap_reader *reader);

/* Chunks that have been left out so far. */
size_t mcap_reader_damaged(const struct mcap_reader *reader);

/* Takes the next key and value off a METADATA's map. False at its end. */
bool mcap_pair(struct mcap_text *map, struct mcap_text *key, struct mcap_text *value);

void mcap_reader_close(struct mcap_reader *reader);

#endif
