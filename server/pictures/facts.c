#include "facts.h"

#include <stdio.h>
#include <string.h>

const struct fact facts[] = {
    {"scenario", "scenario", 0, true},
    {"seed", "seed", 0, true},
    {"robots", "robots", 0, true},
    {"kind of robots", "robot_kind", 0, true},
    {"lasts (s)", "duration", 2, true},
    {"took (s)", "wall_s", 2, false},
    {"times real time", "realtime_factor", 1, false},
    {"why it ended", "end", 0, false},
    {"leader at the end", "final_leader", 0, true},
    {"elections", "elections", 0, true},
    {"allocation", "allocation.method", 0, true},
    {"allocation complete", "allocation.complete", 0, true},
    {"complete after the last event (s)", "allocation.time_to_complete_s", 2, true},
    {"vertex switches", "allocation.switches", 0, true},
    {"mean distance error at the end (m)", "mean_distance_error_m.final", 4, true},
    {"its peak (m)", "mean_distance_error_m.peak", 3, true},
    {"its integral (m s)", "mean_distance_error_m.integral", 2, true},
    {"driven in all (m)", "path_length_m", 1, true},
    {"closest approach (m)", "min_separation_m", 2, true},
    {"frames on the links", "link.frames", 0, false},
    {"bytes on the links", "link.bytes", 0, false},
    {"bytes dropped", "link.dropped", 0, false},
    {"CRC errors", "link.crc_errors", 0, false},
    {"busiest processor (%)", "cpu.load_max_pct", 1, false},
    {"longest control tick (cycles)", "cpu.tick_cycles_max", 0, false},
    {"stack never used (bytes)", "cpu.stack_free_min_bytes", 0, false},
    {"pose to bytes, half of them within (\u00b5s)", "pose_to_bytes_us.p50", 0, false},
    {"99 of 100 within (\u00b5s)", "pose_to_bytes_us.p99", 0, false},
    {"all within (\u00b5s)", "pose_to_bytes_us.max", 0, false},
    {"frames of motion capture", "mocap.frames", 0, false},
    {"skipped for a newer one", "mocap.skipped", 0, false},
    {"links lost", "links_lost", 0, false},
    {NULL, NULL, 0, false},
};

static json_t *find(json_t *summary, const char *path)
{
    const char *dot = strchr(path, '.');

    if (dot == NULL)
        return json_object_get(summary, path);
    json_t *inner = json_object_getn(summary, path, (size_t)(dot - path));
    return find(inner, dot + 1);
}

static bool tell_value(const json_t *value, int decimals, char *words, size_t room)
{
    switch (json_typeof(value)) {
    case JSON_STRING: snprintf(words, room, "%s", json_string_value(value)); return true;
    case JSON_INTEGER: snprintf(words, room, "%lld", json_integer_value(value)); return true;
    case JSON_REAL: snprintf(words, room, "%.*f", decimals, json_real_value(value)); return true;
    case JSON_TRUE: snprintf(words, room, "yes"); return true;
    case JSON_FALSE: snprintf(words, room, "no"); return true;
    case JSON_NULL: snprintf(words, room, "none"); return true;
    default: return false;
    }
}

/* Without summary.json. */
static bool measure(const char *path, const struct archive *archive, double *value)
{
    const struct history *history = &archive->history;

    if (strcmp(path, "robots") == 0)
        *value = (double)history->robots;
    else if (strcmp(path, "duration") == 0)
        *value = archive_end(archive);
    else if (strcmp(path, "mean_distance_error_m.final") == 0)
        *value = history_mean_error(history, history->ticks - 1);
    else if (strcmp(path, "mean_distance_error_m.peak") == 0)
        *value = history_peak_error(history, 0);
    else if (strcmp(path, "mean_distance_error_m.integral") == 0)
        *value = history_error_integral(history, 0);
    else
        return false;
    return true;
}

bool fact_tell(const struct fact *fact, const struct archive *archive, char *words, size_t room)
{
    const json_t *value = find(archive->summary, fact->path);
    double measured;

    if (value != NULL)
        return tell_value(value, fact->decimals, words, room);
    if (archive->summary != NULL)
        return false;
    value = find(archive->about, fact->path);
    if (value != NULL)
        return tell_value(value, fact->decimals, words, room);
    if (!measure(fact->path, archive, &measured))
        return false;
    snprintf(words, room, "%.*f", fact->decimals, measured);
    return true;
}
