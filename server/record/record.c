#include "record.h"

#include "message.h"
#include "progress.h"

#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* What a program that is killed loses of the CSV files, at the most. */
#define FLUSH_NS INT64_C(1000000000)

struct record {
    const char *dir;
    FILE *trace, *events;
    struct recording *recording; /* NULL without a trace */
    int64_t flush_due_ns;
    struct audience audience; /* without functions: nobody */
    uint8_t *bytes;           /* of the scene written last */
    size_t room;
    bool short_of_memory; /* a scene has not been recorded */
};

FILE *record_create(const char *dir, const char *name, char *error, size_t room)
{
    size_t length = strlen(dir) + strlen(name) + 2;
    char *path = malloc(length);

    if (path == NULL) {
        snprintf(error, room, "no memory");
        return NULL;
    }
    snprintf(path, length, "%s/%s", dir, name);
    FILE *file = fopen(path, "w");
    if (file == NULL)
        snprintf(error, room, "cannot write %s: %s", path, strerror(errno));
    free(path);
    return file;
}

static bool open_files(struct record *record, const struct recording_about *about, bool trace,
                       char *error, size_t room)
{
    record->events = record_create(record->dir, "events.csv", error, room);
    if (record->events == NULL)
        return false;
    fputs("t,robot,event,detail\n", record->events);
    if (!trace)
        return true;
    record->trace = record_create(record->dir, "trace.csv", error, room);
    if (record->trace == NULL)
        return false;
    fputs("t,robot,x,y,theta,v,omega,role,vertex,distance_error,alive\n", record->trace);
    record->recording = recording_open(record->dir, about, error, room);
    return record->recording != NULL;
}

struct record *record_open(const char *dir, const struct recording_about *about, bool trace,
                           const struct audience *audience, char *error, size_t room)
{
    struct record *record = calloc(1, sizeof *record);

    if (record == NULL) {
        snprintf(error, room, "no memory");
        return NULL;
    }
    record->dir = dir;
    if (audience != NULL)
        record->audience = *audience;
    if (open_files(record, about, trace, error, room))
        return record;
    record_finish(record->trace);
    record_finish(record->events);
    free(record);
    return NULL;
}

static void flush_files(struct record *record)
{
    fflush(record->events);
    if (record->trace != NULL)
        fflush(record->trace);
}

/* ---- scenes ---------------------------------------------------------------------------- */

bool record_wants_scenes(const struct record *record)
{
    return record->trace != NULL || record->audience.scene != NULL;
}

static char role_letter(uint32_t role)
{
    return role == ROLE_LEADER ? 'L' : role == ROLE_CANDIDATE ? 'C' : 'F';
}

static void write_trace(struct record *record, const struct scene *scene)
{
    if (record->trace == NULL)
        return;
    for (size_t i = 0; i < scene->robot_count; i++) {
        const struct scene_robot *r = &scene->robots[i];

        fprintf(record->trace, "%.2f,%u,%.6f,%.6f,%.6f,%.6f,%.6f,%c,%u,%.6f,%d\n",
                scene->time_ms / 1000.0, r->id, r->x, r->y, r->theta, r->v, r->omega,
                role_letter(r->role), r->vertex, r->distance_error, r->alive);
    }
}

/* The scene's bytes, how many in `count`; 0 of them where there is no memory. */
static size_t encode(struct record *record, const struct scene *scene)
{
    size_t size = scene_size(scene->robot_count, scene->vertex_count);

    if (size > record->room) {
        uint8_t *grown = realloc(record->bytes, size);

        if (grown == NULL)
            return 0;
        record->bytes = grown;
        record->room = size;
    }
    return scene_write(scene, record->bytes, record->room);
}

static void show(struct record *record, int32_t time_ms, size_t count)
{
    if (record->audience.scene != NULL && count > 0)
        record->audience.scene(record->audience.context, time_ms, record->bytes, count);
}

void record_show(struct record *record, const struct scene *scene)
{
    if (record->audience.scene != NULL)
        show(record, scene->time_ms, encode(record, scene));
}

static void flush_in_time(struct record *record)
{
    int64_t now_ns = wall_ns();

    if (now_ns < record->flush_due_ns)
        return;
    flush_files(record);
    record->flush_due_ns = now_ns + FLUSH_NS;
}

void record_scene(struct record *record, const struct scene *scene)
{
    write_trace(record, scene);
    if (record_wants_scenes(record)) {
        size_t count = encode(record, scene);

        if (count == 0)
            record->short_of_memory = true;
        else if (record->recording != NULL)
            recording_scene(record->recording, scene, record->bytes, count);
        show(record, scene->time_ms, count);
    }
    flush_in_time(record);
}

/* ---- events ---------------------------------------------------------------------------- */

/* A row. A comma or a line's end in the detail would shift the columns. */
static void write_row(struct record *record, const struct scene_event *event)
{
    fprintf(record->events, "%.2f,%u,%s,", event->time_ms / 1000.0, event->robot, event->event);
    for (const char *c = event->detail; *c != '\0'; c++)
        fputc(*c == ',' ? ';' : (unsigned char)*c < ' ' ? ' ' : *c, record->events);
    fputc('\n', record->events);
}

/* To the recording and the audience. */
static void show_event(struct record *record, struct scene_event event)
{
    uint8_t bytes[SCENE_EVENT_MAX];

    if (record->recording == NULL && record->audience.event == NULL)
        return;
    if (event.time_ms < AUDIENCE_BEGIN_MS)
        event.time_ms = AUDIENCE_BEGIN_MS;
    size_t count = scene_event_write(&event, bytes, sizeof bytes);
    if (count > 0 && record->recording != NULL)
        recording_event(record->recording, event.time_ms, bytes, count);
    if (count > 0 && record->audience.event != NULL)
        record->audience.event(record->audience.context, event.time_ms, bytes, count);
}

void record_note(struct record *record, int32_t time_ms, uint16_t id, const char *event,
                 const char *detail)
{
    struct scene_event row = {time_ms, id, event, detail};

    write_row(record, &row);
    show_event(record, row);
}

static void note(struct record *record, int32_t time_ms, uint16_t id, const char *event,
                 const char *format, ...) __attribute__((format(printf, 5, 6)));

static void note(struct record *record, int32_t time_ms, uint16_t id, const char *event,
                 const char *format, ...)
{
    char detail[256];
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(detail, sizeof detail, format, arguments);
    va_end(arguments);
    record_note(record, time_ms, id, event, detail);
}

static const char *event_word(uint32_t action)
{
    static const char *const words[] = {
        [EVENT_KILL] = "kill",   [EVENT_REVIVE] = "revive",       [EVENT_STALL] = "stall",
        [EVENT_MUTE] = "mute",   [EVENT_UNMUTE] = "unmute",       [EVENT_FORMATION] = "formation",
        [EVENT_LOSS] = "loss",   [EVENT_DELAY] = "delay",         [EVENT_RANGE] = "range",
        [EVENT_ESTOP] = "estop", [EVENT_PARTITION] = "partition", [EVENT_HEAL] = "heal",
        [EVENT_DRAIN] = "drain",
    };

    return words[action];
}

static void name_faults(char *words, size_t room, uint32_t faults)
{
    static const char *const names[] = {
        "no id",          "pose stale",      "link lost",        "stall",
        "emergency stop", "mission refused", "battery critical", "battery low"};
    size_t used = 0;

    snprintf(words, room, "none");
    for (size_t bit = 0; bit < sizeof names / sizeof names[0]; bit++)
        if (faults & 1u << bit)
            used += (size_t)snprintf(words + used, room - used, "%s%s", used > 0 ? " + " : "",
                                     names[bit]);
}

void record_event(struct record *record, int32_t time_ms, const struct server_report *report)
{
    uint16_t id = report->robot;
    char faults[160]; /* all of their names */

    switch (report->kind) {
    case REPORT_START: record_note(record, time_ms, id, "start", "the mission begins"); break;
    case REPORT_ROLE: note(record, time_ms, id, "role", "%c", role_letter(report->value)); break;
    case REPORT_ELECTION: note(record, time_ms, id, "election", "term %u", report->value); break;
    case REPORT_VERTEX:
        if (report->was != 0)
            note(record, time_ms, id, "vertex_lost", "%u", report->was);
        if (report->value != 0)
            note(record, time_ms, id, "vertex_won", "%u", report->value);
        break;
    case REPORT_FAULT:
        name_faults(faults, sizeof faults, report->value);
        record_note(record, time_ms, id, "fault", faults);
        break;
    case REPORT_LINK:
        note(record, time_ms, id, "link_error", "%u bad frames", report->value);
        break;
    case REPORT_RESTART:
        record_note(record, time_ms, id, "restart", "lost its mission and is given it again");
        break;
    case REPORT_STRANGER:
        note(record, time_ms, id, "stranger", "says that it is robot %u", report->value);
        break;
    case REPORT_EVENT: record_note(record, time_ms, id, event_word(report->value), ""); break;
    }
}

void record_flush(struct record *record)
{
    flush_files(record);
    if (record->recording != NULL)
        recording_flush(record->recording);
}

bool record_finish(FILE *file)
{
    bool good = file == NULL || ferror(file) == 0;

    return (file == NULL || fclose(file) == 0) && good;
}

bool record_close(struct record *record, char *error, size_t room)
{
    bool good = record_finish(record->trace);

    good &= record_finish(record->events);
    if (!good)
        snprintf(error, room, "cannot write to %s: %s", record->dir, strerror(errno));
    if (record->short_of_memory)
        snprintf(error, room, "not everything is in %s/run.mcap: no memory", record->dir);
    if (record->recording != NULL)
        good &= recording_close(record->recording, error, room);
    good &= !record->short_of_memory;
    free(record->bytes);
    free(record);
    return good;
}
