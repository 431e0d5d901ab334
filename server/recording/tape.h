/* tape.h: a recording read again, from its first message to its last, also one that was cut short.
 */
#ifndef TAPE_H
#define TAPE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct tape;

#define TAPE_WORD_MAX 128

struct tape_about {
    char scenario[TAPE_WORD_MAX], robots[TAPE_WORD_MAX]; /* recording.h; "" when it does not say */
    uint64_t seed;
    double duration;
    bool whole; /* has its footer; else it ends where the writer was killed */
};

struct tape_message {
    const char *topic; /* its name */
    int32_t time_ms;
    const uint8_t *bytes; /* good until the next call */
    size_t count;
};

/* The file of a run's folder, or `path` itself when it is none. False when that does not fit. */
bool tape_path(char *file, size_t room, const char *path);

/* `path` is a run's folder or an MCAP file. NULL and words in `error` when there is none or it is
 * no recording of ours. */
struct tape *tape_open(const char *path, char *error, size_t room);
const struct tape_about *tape_about(const struct tape *tape);

/* The next message in the file's order. False at its end, or where nothing good follows. */
bool tape_next(struct tape *tape, struct tape_message *message);
void tape_close(struct tape *tape);

#endif
