/* Any bytes as a recording: nothing is read or written out of bounds, a tape of it ends, and what
 * recovery would make of it is a whole file of as many messages. */
#define _GNU_SOURCE /* memfd_create() */
#include "mcap_reader.h"
#include "mcap_writer.h"
#include "tape.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

/* Returns a new file of the records, and how many messages there are. */
static int copy(FILE *file, size_t *messages)
{
    int fd = memfd_create("copy", 0);
    struct mcap_reader *reader = mcap_reader_open(file);
    struct mcap_writer *writer = mcap_writer_open(fd);
    struct mcap_record record;
    enum mcap_news news;

    *messages = 0;
    while ((news = mcap_reader_next(reader, &record)) <= MCAP_CUT) {
        if (news == MCAP_CUT)
            mcap_writer_cut(writer);
        else if (record.opcode == MCAP_MESSAGE)
            *messages += mcap_writer_message(writer, record.id, record.time_ns, record.data,
                                             record.data_count);
        else
            mcap_writer_record(writer, record.opcode, record.contents, record.count);
    }
    assert(mcap_writer_close(writer) == 0);
    if (news == MCAP_REFUSED)
        assert(mcap_reader_words(reader)[0] != '\0');
    mcap_reader_close(reader);
    return fd;
}

static void assert_whole(int fd, size_t messages)
{
    FILE *file = fdopen(fd, "r");
    struct mcap_reader *reader = mcap_reader_open(file);
    struct mcap_record record;
    enum mcap_news news;

    assert(mcap_reader_has_end(reader));
    while ((news = mcap_reader_next(reader, &record)) <= MCAP_CUT)
        messages -= news == MCAP_RECORD && record.opcode == MCAP_MESSAGE;
    assert(messages == 0 && mcap_reader_damaged(reader) == 0);
    assert(news == MCAP_WHOLE || news == MCAP_REFUSED); /* refused: not even a header */
    mcap_reader_close(reader);
    fclose(file);
}

static void play(int fd)
{
    char path[32], error[256] = "";
    struct tape_message message;
    volatile uint8_t sum = 0;

    snprintf(path, sizeof path, "/proc/self/fd/%d", fd);
    struct tape *tape = tape_open(path, error, sizeof error);
    if (tape == NULL) {
        assert(error[0] != '\0');
        return;
    }
    while (tape_next(tape, &message)) {
        assert(message.topic != NULL && message.time_ms >= 0);
        for (size_t i = 0; i < message.count; i++)
            sum = sum ^ message.bytes[i];
    }
    assert(!tape_next(tape, &message));
    assert(memchr(tape_about(tape)->scenario, '\0', TAPE_WORD_MAX) != NULL);
    tape_close(tape);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    int fd = memfd_create("recording", 0);
    FILE *file = fdopen(fd, "r");
    size_t messages;

    assert(write(fd, data, size) == (ssize_t)size);
    play(fd);
    int copied = copy(file, &messages);
    assert_whole(copied, messages);
    fclose(file);
    return 0;
}
