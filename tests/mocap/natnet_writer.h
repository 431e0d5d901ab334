/* natnet_writer.h: the other end of server/mocap/natnet.h: what a system of a version sends. */
#ifndef NATNET_WRITER_H
#define NATNET_WRITER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct natnet_writer {
    uint8_t major, minor;
    size_t count;
    uint8_t bytes[65536];
};

struct written_body {
    int32_t id;
    const char *name;
    float at[3], turn[4];
    bool tracked;
};

struct written_frame {
    int32_t number;
    double time;
    uint64_t exposed, sent; /* of the system's clock, 1 MHz */
    bool models_changed;
    bool crowded; /* something in every section, not only bodies */
    bool precise; /* the optional stamp of 4.1 */
    size_t count;
    const struct written_body *body;
};

/* Each makes a whole datagram in `bytes`, instead of the one before. */
void natnet_write_server(struct natnet_writer *writer, bool multicast, uint16_t data_port,
                         const uint8_t group[4]);
void natnet_write_models(struct natnet_writer *writer, const struct written_body *bodies,
                         size_t count, bool crowded);
void natnet_write_frame(struct natnet_writer *writer, const struct written_frame *frame);

/* An empty message, or one of `count` zero bytes. */
void natnet_write_message(struct natnet_writer *writer, uint16_t id, size_t count);

#endif
