#include "record.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

struct record {
    const char *dir;
    FILE *trace, *events;
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

struct record *record_open(const char *dir, bool trace, char *error, size_t room)
{
    struct record *record = calloc(1, sizeof *record);

    if (record == NULL) {
        snprintf(error, room, "no memory");
        return NULL;
    }
    record->dir = dir;
    record->events = record_create(dir, "events.csv", error, room);
    if (record->events != NULL && trace)
        record->trace = record_create(dir, "trace.csv", error, room);
    if (record->events == NULL || (trace && record->trace == NULL)) {
        if (record->events != NULL)
            fclose(record->events);
        free(record);
        return NULL;
    }
    fputs("t,robot,event,detail\n", record->events);
    if (record->trace != NULL)
        fputs("t,robot,x,y,theta,v,omega,role,vertex,distance_error,alive\n", record->trace);
    return record;
}

static char role_letter(uint32_t role)
{
    return role == ROLE_LEADER ? 'L' : role == ROLE_CANDIDATE ? 'C' : 'F';
}

void record_trace(struct record *record, int32_t time_ms, const struct scenario *scenario,
                  const struct sample *samples)
{
    if (record->trace == NULL)
        return;
    for (size_t i = 0; i < scenario->robot_count; i++) {
        const struct sample *s = &samples[i];

        fprintf(record->trace, "%.2f,%u,%.6f,%.6f,%.6f,%.6f,%.6f,%c,%u,%.6f,%d\n", time_ms / 1000.0,
                scenario->robots[i].id, s->x, s->y, s->theta, s->v, s->omega, role_letter(s->role),
                s->vertex, s->distance_error, s->alive);
    }
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

static void print_faults(FILE *out, uint32_t faults)
{
    static const char *const words[] = {
        "no id",          "pose stale",      "link lost",        "stall",
        "emergency stop", "mission refused", "battery critical", "battery low"};
    const char *separator = "";

    if (faults == 0)
        fputs("none", out);
    for (size_t bit = 0; bit < sizeof words / sizeof words[0]; bit++) {
        if (faults & 1u << bit) {
            fprintf(out, "%s%s", separator, words[bit]);
            separator = " + ";
        }
    }
    fputc('\n', out);
}

void record_event(struct record *record, int32_t time_ms, const struct server_report *report)
{
    FILE *out = record->events;
    double t = time_ms / 1000.0;

    switch (report->kind) {
    case REPORT_START: fprintf(out, "%.2f,%u,start,the mission begins\n", t, report->robot); break;
    case REPORT_ROLE:
        fprintf(out, "%.2f,%u,role,%c\n", t, report->robot, role_letter(report->value));
        break;
    case REPORT_ELECTION:
        fprintf(out, "%.2f,%u,election,term %u\n", t, report->robot, report->value);
        break;
    case REPORT_VERTEX:
        if (report->was != 0)
            fprintf(out, "%.2f,%u,vertex_lost,%u\n", t, report->robot, report->was);
        if (report->value != 0)
            fprintf(out, "%.2f,%u,vertex_won,%u\n", t, report->robot, report->value);
        break;
    case REPORT_FAULT:
        fprintf(out, "%.2f,%u,fault,", t, report->robot);
        print_faults(out, report->value);
        break;
    case REPORT_LINK:
        fprintf(out, "%.2f,%u,link_error,%u bad frames\n", t, report->robot, report->value);
        break;
    case REPORT_RESTART:
        fprintf(out, "%.2f,%u,restart,lost its mission and is given it again\n", t, report->robot);
        break;
    case REPORT_STRANGER:
        fprintf(out, "%.2f,%u,stranger,says that it is robot %u\n", t, report->robot,
                report->value);
        break;
    case REPORT_EVENT:
        fprintf(out, "%.2f,%u,%s,\n", t, report->robot, event_word(report->value));
        break;
    }
}

/* A comma or a line's end in it would shift the columns. */
void record_note(struct record *record, int32_t time_ms, uint16_t id, const char *event,
                 const char *detail)
{
    fprintf(record->events, "%.2f,%u,%s,", time_ms / 1000.0, id, event);
    for (const char *c = detail; *c != '\0'; c++)
        fputc(*c == ',' ? ';' : (unsigned char)*c < ' ' ? ' ' : *c, record->events);
    fputc('\n', record->events);
}

void record_flush(struct record *record)
{
    fflush(record->events);
    if (record->trace != NULL)
        fflush(record->trace);
}

bool record_finish(FILE *file)
{
    bool good = file == NULL || ferror(file) == 0;

    return (file == NULL || fclose(file) == 0) && good;
}

bool record_close(struct record *record, char *error, size_t room)
{
    bool trace = record_finish(record->trace);
    bool events = record_finish(record->events);

    if (!trace || !events)
        snprintf(error, room, "cannot write to %s: %s", record->dir, strerror(errno));
    free(record);
    return trace && events;
}
