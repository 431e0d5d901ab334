#include "record.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct record {
    const char *dir;
    FILE *trace, *events;
};

static FILE *create(const char *dir, const char *name, char *error, size_t room)
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
    record->events = create(dir, "events.csv", error, room);
    if (record->events != NULL && trace)
        record->trace = create(dir, "trace.csv", error, room);
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

        fprintf(record->trace, "%.2f,%u,%.6f,%.6f,%.6f,%.6f,%.6f,%c,%u,%.6f,%d\n",
                time_ms / 1000.0, scenario->robots[i].id, s->x, s->y, s->theta, s->v, s->omega,
                role_letter(s->role), s->vertex, s->distance_error, s->alive);
    }
}

static const char *event_word(uint32_t action)
{
    static const char *const words[] = {
        [EVENT_KILL] = "kill",           [EVENT_REVIVE] = "revive",
        [EVENT_STALL] = "stall",         [EVENT_MUTE] = "mute",
        [EVENT_UNMUTE] = "unmute",       [EVENT_FORMATION] = "formation",
        [EVENT_LOSS] = "loss",           [EVENT_DELAY] = "delay",
        [EVENT_RANGE] = "range",         [EVENT_ESTOP] = "estop",
        [EVENT_PARTITION] = "partition", [EVENT_HEAL] = "heal",
    };

    return words[action];
}

static void print_faults(FILE *out, uint32_t faults)
{
    static const char *const words[] = {"no id",  "pose stale",     "link lost",
                                        "stall",  "emergency stop", "mission refused"};
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
    case REPORT_START:
        fprintf(out, "%.2f,%u,start,every robot has acknowledged the mission\n", t,
                report->robot);
        break;
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
        fprintf(out, "%.2f,%u,restart,lost its mission and is given it again\n", t,
                report->robot);
        break;
    case REPORT_EVENT:
        fprintf(out, "%.2f,%u,%s,\n", t, report->robot, event_word(report->value));
        break;
    }
}

static bool close_file(FILE *file)
{
    bool good = file == NULL || ferror(file) == 0;

    return (file == NULL || fclose(file) == 0) && good;
}

bool record_close(struct record *record, char *error, size_t room)
{
    bool trace = close_file(record->trace);
    bool events = close_file(record->events);

    if (!trace || !events)
        snprintf(error, room, "cannot write to %s: %s", record->dir, strerror(errno));
    free(record);
    return trace && events;
}

static const char *allocation_word(const struct scenario *scenario)
{
    static const char *const words[] = {
        [ASSIGN_CPA] = "cpa",
        [ASSIGN_CPA_LITERAL] = "cpa-literal",
        [ASSIGN_RIGID] = "rigid",
        [ASSIGN_OPTIMAL] = "optimal",
    };

    return words[scenario->allocation];
}

static double realtime_factor(const struct summary *s)
{
    return s->wall > 0 ? s->duration / s->wall : 0;
}

static void write_json(const struct summary *s, FILE *out)
{
    const struct metrics_result *m = &s->metrics;

    fprintf(out, "{\n  \"scenario\": \"%s\",\n  \"robots\": %zu,\n  \"robot_kind\": \"%s\",\n",
            s->scenario->name, s->scenario->robot_count, s->avr ? "avr" : "native");
    fprintf(out, "  \"seed\": %llu,\n  \"duration\": %.2f,\n", (unsigned long long)s->seed,
            s->duration);
    fprintf(out, "  \"wall_s\": %.3f,\n  \"realtime_factor\": %.2f,\n", s->wall,
            realtime_factor(s));
    if (m->leader == SERVER_NOBODY)
        fputs("  \"final_leader\": null,\n", out);
    else
        fprintf(out, "  \"final_leader\": %u,\n", s->scenario->robots[m->leader].id);
    fprintf(out, "  \"elections\": %llu,\n", (unsigned long long)m->elections);
    fprintf(out, "  \"allocation\": {\"method\": \"%s\", \"complete\": %s, ",
            allocation_word(s->scenario), m->complete ? "true" : "false");
    if (m->complete)
        fprintf(out, "\"time_to_complete_s\": %.2f, ", m->time_to_complete);
    else
        fputs("\"time_to_complete_s\": null, ", out);
    fprintf(out, "\"switches\": %llu},\n", (unsigned long long)m->switches);
    fprintf(out, "  \"mean_distance_error_m\": {\"final\": %.6f, \"peak\": %.6f, "
                 "\"integral\": %.6f},\n",
            m->error_final, m->error_peak, m->error_integral);
    fprintf(out, "  \"path_length_m\": %.4f,\n", m->path_length);
    if (isfinite(m->min_separation))
        fprintf(out, "  \"min_separation_m\": %.4f,\n", m->min_separation);
    else
        fputs("  \"min_separation_m\": null,\n", out);
    fprintf(out, "  \"link\": {\"frames\": %llu, \"bytes\": %llu, \"dropped\": %llu, "
                 "\"crc_errors\": %llu}",
            (unsigned long long)s->link.frames, (unsigned long long)s->link.bytes,
            (unsigned long long)s->link.dropped, (unsigned long long)s->link.bad_frames);
    if (s->avr)
        fprintf(out, ",\n  \"cpu\": {\"load_max_pct\": %.2f, \"tick_cycles_max\": %u, "
                     "\"stack_free_min_bytes\": %u}",
                s->load_max_pct, s->tick_cycles_max, s->stack_free_min);
    fputs("\n}\n", out);
}

bool summary_write(const struct summary *summary, const char *dir, char *error, size_t room)
{
    FILE *out = create(dir, "summary.json", error, room);

    if (out == NULL)
        return false;
    write_json(summary, out);
    if (close_file(out))
        return true;
    snprintf(error, room, "cannot write %s/summary.json: %s", dir, strerror(errno));
    return false;
}

void summary_print(const struct summary *s, const char *dir, FILE *out)
{
    const struct metrics_result *m = &s->metrics;

    fprintf(out, "%s: %zu %s robots, %.2f s simulated in %.2f s (%.1f times real time)\n",
            s->scenario->name, s->scenario->robot_count, s->avr ? "ATmega128" : "native",
            s->duration, s->wall, realtime_factor(s));
    if (m->leader == SERVER_NOBODY)
        fputs("  leader          none at the end\n", out);
    else
        fprintf(out, "  leader          robot %u at the end, %llu election%s\n",
                s->scenario->robots[m->leader].id, (unsigned long long)m->elections,
                m->elections == 1 ? "" : "s");
    fprintf(out, "  allocation      %s, ", allocation_word(s->scenario));
    if (m->complete)
        fprintf(out, "complete %.2f s after the last event, ", m->time_to_complete);
    else
        fputs("not complete, ", out);
    fprintf(out, "%llu vertex switches\n", (unsigned long long)m->switches);
    fprintf(out, "  distance error  mean %.4f m at the end, peak %.3f m, integral %.2f m s\n",
            m->error_final, m->error_peak, m->error_integral);
    fprintf(out, "  paths           %.1f m in all", m->path_length);
    if (isfinite(m->min_separation))
        fprintf(out, ", closest approach %.2f m", m->min_separation);
    fprintf(out, "\n  links           %llu frames, %llu bytes, %llu dropped, %llu CRC errors\n",
            (unsigned long long)s->link.frames, (unsigned long long)s->link.bytes,
            (unsigned long long)s->link.dropped, (unsigned long long)s->link.bad_frames);
    if (s->avr)
        fprintf(out, "  processors      busiest %.1f %%, longest tick %u cycles, "
                     "%u bytes of stack never used\n",
                s->load_max_pct, s->tick_cycles_max, s->stack_free_min);
    fprintf(out, "  files           %s/\n", dir);
}
