#define _GNU_SOURCE /* asprintf() */

#include "recording.h"

#include "mcap_writer.h"
#include "topic.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <time.h>
#include <unistd.h>

/* A chunk is of so much mission time, and by that alone the files of a run are the same every time.
 * Where it takes longer than a second on the wall, in a run at less than half of real time, it is
 * cut then. */
#define CHUNK_MS 500
#define CHUNK_WALL_NS INT64_C(1000000000)

#define NS_PER_MS UINT64_C(1000000)

struct recording {
    char *path;
    int fd;
    struct mcap_writer *writer;
    int32_t chunk_end_ms; /* mission time: from here on another one */
    int64_t chunk_due_ns; /* on the wall: as late as that it is handed over */
    int32_t due_ms[TOPIC_COUNT];
    uint8_t *message;
    size_t room;
    bool short_of_memory;
};

static int64_t wall_ns(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

/* Channels and schemas have numbers from 1 on. */
static uint16_t number(enum topic topic)
{
    return (uint16_t)(topic + 1);
}

static void write_head(struct mcap_writer *writer, const struct recording_about *about)
{
    char seed[24], duration[32];
    const char *const pairs[] = {
        "scenario", about->scenario, "robots", about->robots, "seed",
        seed,       "duration",      duration, "version",     MUSTER_VERSION,
    };

    snprintf(seed, sizeof seed, "%" PRIu64, about->seed);
    snprintf(duration, sizeof duration, "%.12g", about->duration);
    mcap_writer_header(writer, "ros2", "muster " MUSTER_VERSION);
    mcap_writer_metadata(writer, "muster", pairs, sizeof pairs / sizeof pairs[0] / 2);
    for (enum topic i = 0; i < TOPIC_COUNT; i++) {
        const struct topic_kind *kind = &topic_kinds[i];

        mcap_writer_schema(writer, number(i), kind->type, "ros2msg", kind->definition);
        mcap_writer_channel(writer, number(i), number(i), kind->name, "cdr");
    }
    mcap_writer_cut(writer);
}

static void destroy(struct recording *recording)
{
    if (recording->fd >= 0)
        close(recording->fd);
    free(recording->message);
    free(recording->path);
    free(recording);
}

/* While it is locked nobody makes it whole. */
static bool open_file(struct recording *recording, const char *dir, char *error, size_t room)
{
    if (asprintf(&recording->path, "%s/run.mcap", dir) < 0) {
        recording->path = NULL;
        snprintf(error, room, "no memory");
        return false;
    }
    recording->fd = open(recording->path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (recording->fd < 0) {
        snprintf(error, room, "cannot write %s: %s", recording->path, strerror(errno));
        return false;
    }
    flock(recording->fd, LOCK_EX | LOCK_NB);
    recording->writer = mcap_writer_open(recording->fd);
    if (recording->writer == NULL)
        snprintf(error, room, "no memory");
    return recording->writer != NULL;
}

struct recording *recording_open(const char *dir, const struct recording_about *about, char *error,
                                 size_t room)
{
    struct recording *recording = calloc(1, sizeof *recording);

    if (recording == NULL) {
        snprintf(error, room, "no memory");
        return NULL;
    }
    recording->fd = -1;
    if (!open_file(recording, dir, error, room)) {
        destroy(recording);
        return NULL;
    }
    write_head(recording->writer, about);
    return recording;
}

/* Ends the chunk where the next message is to be in another one. */
static void turn(struct recording *recording, int32_t time_ms)
{
    int64_t now_ns = wall_ns();

    if (time_ms < recording->chunk_end_ms && now_ns < recording->chunk_due_ns)
        return;
    mcap_writer_cut(recording->writer);
    recording->chunk_end_ms = time_ms - time_ms % CHUNK_MS + CHUNK_MS;
    recording->chunk_due_ns = now_ns + CHUNK_WALL_NS;
}

static void put(struct recording *recording, enum topic topic, int32_t time_ms,
                const uint8_t *bytes, size_t count)
{
    mcap_writer_message(recording->writer, number(topic), (uint64_t)time_ms * NS_PER_MS, bytes,
                        count);
}

static bool make_room(struct recording *recording, const struct scene *scene)
{
    size_t room = topic_room(scene);

    if (room <= recording->room)
        return true;
    uint8_t *message = realloc(recording->message, room);
    if (message == NULL) {
        recording->short_of_memory = true;
        return false;
    }
    recording->message = message;
    recording->room = room;
    return true;
}

static void put_when_due(struct recording *recording, enum topic topic, const struct scene *scene)
{
    if (topic_kinds[topic].period_ms == 0 || scene->time_ms < recording->due_ms[topic])
        return;
    recording->due_ms[topic] = scene->time_ms + topic_kinds[topic].period_ms;
    size_t count = topic_write(topic, scene, recording->message, recording->room);
    put(recording, topic, scene->time_ms, recording->message, count);
}

void recording_scene(struct recording *recording, const struct scene *scene, const uint8_t *fleet,
                     size_t count)
{
    if (scene->time_ms < 0)
        return;
    turn(recording, scene->time_ms);
    put(recording, TOPIC_FLEET, scene->time_ms, fleet, count);
    if (!make_room(recording, scene))
        return;
    for (enum topic i = 0; i < TOPIC_COUNT; i++)
        if (i != TOPIC_FLEET)
            put_when_due(recording, i, scene);
}

void recording_event(struct recording *recording, int32_t time_ms, const uint8_t *log, size_t count)
{
    int32_t log_ms = time_ms > 0 ? time_ms : 0;

    turn(recording, log_ms);
    put(recording, TOPIC_EVENTS, log_ms, log, count);
}

void recording_flush(struct recording *recording)
{
    mcap_writer_cut(recording->writer);
    recording->chunk_due_ns = wall_ns() + CHUNK_WALL_NS;
}

bool recording_close(struct recording *recording, char *error, size_t room)
{
    int wrong = mcap_writer_close(recording->writer);

    if (close(recording->fd) != 0 && wrong == 0)
        wrong = errno;
    recording->fd = -1;
    if (wrong == 0 && recording->short_of_memory)
        wrong = ENOMEM;
    if (wrong != 0)
        snprintf(error, room, "cannot write %s: %s", recording->path, strerror(wrong));
    destroy(recording);
    return wrong == 0;
}
