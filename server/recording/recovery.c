#include "recovery.h"

#include "mcap_reader.h"
#include "mcap_writer.h"
#include "tape.h"

#include <errno.h>
#include <fcntl.h>
#include <libgen.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#define PATH_ROOM 4096

struct work {
    FILE *file;
    const char *in;
    struct recovery *recovery;
    char *error;
    size_t room;
};

static enum recovery_end refuse(const struct work *work, const char *words)
{
    snprintf(work->error, work->room, "%s %s", work->in, words);
    return RECOVERY_REFUSED;
}

static enum recovery_end fail(const struct work *work, const char *path, int wrong)
{
    snprintf(work->error, work->room, "cannot write %s: %s", path, strerror(wrong));
    return RECOVERY_FAILED;
}

/* Without a writer it is only counted. */
static void take(struct mcap_writer *writer, const struct mcap_record *record,
                 struct recovery *recovery)
{
    double seconds = (double)record->time_ns / 1e9;

    if (record->opcode != MCAP_MESSAGE) {
        if (writer != NULL)
            mcap_writer_record(writer, record->opcode, record->contents, record->count);
        return;
    }
    if (writer != NULL &&
        !mcap_writer_message(writer, record->id, record->time_ns, record->data, record->data_count))
        return;
    recovery->messages++;
    if (seconds > recovery->seconds)
        recovery->seconds = seconds;
}

static enum recovery_end copy_records(const struct work *work, struct mcap_reader *reader,
                                      struct mcap_writer *writer)
{
    struct recovery *recovery = work->recovery;
    struct mcap_record record;
    enum mcap_news news;

    *recovery = (struct recovery){0};
    while ((news = mcap_reader_next(reader, &record)) <= MCAP_CUT) {
        if (news == MCAP_RECORD)
            take(writer, &record, recovery);
        else if (writer != NULL)
            mcap_writer_cut(writer);
    }
    recovery->damaged = mcap_reader_damaged(reader);
    recovery->whole = news == MCAP_WHOLE && recovery->damaged == 0;
    if (news == MCAP_WHOLE || news == MCAP_TORN)
        return RECOVERY_DONE;
    refuse(work, mcap_reader_words(reader));
    return news == MCAP_REFUSED ? RECOVERY_REFUSED : RECOVERY_FAILED;
}

static enum recovery_end copy(const struct work *work, struct mcap_writer *writer)
{
    struct mcap_reader *reader = mcap_reader_open(work->file);

    if (reader == NULL)
        return refuse(work, "cannot be read");
    enum recovery_end end = copy_records(work, reader, writer);
    mcap_reader_close(reader);
    return end;
}

/* The name of a file that has just been renamed is on the disk when its folder is. */
static void sync_folder(const char *path)
{
    char copy[PATH_ROOM];

    snprintf(copy, sizeof copy, "%s", path);
    int fd = open(dirname(copy), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd < 0)
        return;
    fsync(fd);
    close(fd);
}

static enum recovery_end write_file(const struct work *work, const char *path, int fd)
{
    struct mcap_writer *writer = mcap_writer_open(fd);

    if (writer == NULL)
        return fail(work, path, ENOMEM);
    enum recovery_end end = copy(work, writer);
    int wrong = mcap_writer_close(writer);
    if (end == RECOVERY_DONE && wrong == 0 && fsync(fd) != 0)
        wrong = errno;
    return end == RECOVERY_DONE && wrong != 0 ? fail(work, path, wrong) : end;
}

/* A device would no longer be one. */
static bool is_no_file(const char *path)
{
    struct stat status;

    return stat(path, &status) == 0 && !S_ISREG(status.st_mode);
}

/* Writes it beside `out`, then in its place. */
static enum recovery_end replace(const struct work *work, const char *out)
{
    char beside[PATH_ROOM + sizeof ".part"];

    if (is_no_file(out))
        return fail(work, out, EEXIST);
    snprintf(beside, sizeof beside, "%s.part", out);
    int fd = open(beside, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (fd < 0)
        return fail(work, beside, errno);
    enum recovery_end end = write_file(work, beside, fd);
    if (close(fd) != 0 && end == RECOVERY_DONE)
        end = fail(work, beside, errno);
    if (end == RECOVERY_DONE && rename(beside, out) != 0)
        end = fail(work, out, errno);
    if (end == RECOVERY_DONE)
        sync_folder(out);
    else
        unlink(beside);
    return end;
}

static enum recovery_end recover(const struct work *work, const char *out)
{
    if (flock(fileno(work->file), LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        return refuse(work, "is being written just now");
    if (out != NULL)
        return replace(work, out);
    enum recovery_end end = copy(work, NULL);
    return end != RECOVERY_DONE || work->recovery->whole ? end : replace(work, work->in);
}

enum recovery_end recovery_run(const char *path, const char *out, struct recovery *recovery,
                               char *error, size_t room)
{
    char in[PATH_ROOM];
    struct work work = {.in = in, .recovery = recovery, .error = error, .room = room};

    if (!tape_path(in, sizeof in, path)) {
        snprintf(error, room, "%s: the path is too long", path);
        return RECOVERY_REFUSED;
    }
    work.file = fopen(in, "re");
    if (work.file == NULL) {
        snprintf(error, room, "cannot read %s: %s", in, strerror(errno));
        return RECOVERY_REFUSED;
    }
    enum recovery_end end = recover(&work, out);
    fclose(work.file);
    return end;
}
