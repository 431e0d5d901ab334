/* mcap.h: MCAP's records (mcap.dev/spec): an opcode, the length of what follows as u64, and that.
 * Numbers are little-endian; a string or a map has its length in bytes as u32 before it. */
#ifndef MCAP_H
#define MCAP_H

#define MCAP_MAGIC "\x89MCAP0\r\n" /* begins and ends a file */
#define MCAP_MAGIC_BYTES 8

#define MCAP_HEAD_BYTES 9 /* of a record: opcode and length */

/* Footer and magic, at the end of a whole file. */
#define MCAP_FOOTER_BYTES 20
#define MCAP_END_BYTES (MCAP_HEAD_BYTES + MCAP_FOOTER_BYTES + MCAP_MAGIC_BYTES)

enum mcap_opcode {
    MCAP_HEADER = 0x01,
    MCAP_FOOTER = 0x02,
    MCAP_SCHEMA = 0x03,
    MCAP_CHANNEL = 0x04,
    MCAP_MESSAGE = 0x05,
    MCAP_CHUNK = 0x06,
    MCAP_MESSAGE_INDEX = 0x07,
    MCAP_CHUNK_INDEX = 0x08,
    MCAP_STATISTICS = 0x0B,
    MCAP_METADATA = 0x0C,
    MCAP_METADATA_INDEX = 0x0D,
    MCAP_SUMMARY_OFFSET = 0x0E,
    MCAP_DATA_END = 0x0F,
};

#endif
