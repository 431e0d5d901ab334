#include "summary.h"

#include "record.h"

#include <errno.h>
#include <math.h>
#include <string.h>

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

static const char *kind_word(const struct summary *s)
{
    return s->live != NULL ? "real" : s->avr ? "avr" : "native";
}

static double realtime_factor(const struct summary *s)
{
    return s->wall > 0 ? s->duration / s->wall : 0;
}

static void write_live(const struct live_summary *live, FILE *out)
{
    fprintf(out,
            ",\n  \"pose_to_bytes_us\": {\"p50\": %.0f, \"p99\": %.0f, \"max\": %.0f},\n"
            "  \"mocap\": {\"frames\": %llu, \"skipped\": %llu},\n"
            "  \"links_lost\": %u,\n  \"end\": \"%s\"",
            live->delay_p50_us, live->delay_p99_us, live->delay_max_us,
            (unsigned long long)live->frames, (unsigned long long)live->skipped, live->links_lost,
            live->end);
}

static void write_json(const struct summary *s, FILE *out)
{
    const struct metrics_result *m = &s->metrics;

    fprintf(out, "{\n  \"scenario\": \"%s\",\n  \"robots\": %zu,\n  \"robot_kind\": \"%s\",\n",
            s->scenario->name, s->scenario->robot_count, kind_word(s));
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
    fprintf(out,
            "  \"mean_distance_error_m\": {\"final\": %.6f, \"peak\": %.6f, "
            "\"integral\": %.6f},\n",
            m->error_final, m->error_peak, m->error_integral);
    fprintf(out, "  \"path_length_m\": %.4f,\n", m->path_length);
    if (isfinite(m->min_separation))
        fprintf(out, "  \"min_separation_m\": %.4f,\n", m->min_separation);
    else
        fputs("  \"min_separation_m\": null,\n", out);
    fprintf(out,
            "  \"link\": {\"frames\": %llu, \"bytes\": %llu, \"dropped\": %llu, "
            "\"crc_errors\": %llu}",
            (unsigned long long)s->link.frames, (unsigned long long)s->link.bytes,
            (unsigned long long)s->link.dropped, (unsigned long long)s->link.bad_frames);
    if (s->avr)
        fprintf(out,
                ",\n  \"cpu\": {\"load_max_pct\": %.2f, \"tick_cycles_max\": %u, "
                "\"stack_free_min_bytes\": %u}",
                s->load_max_pct, s->tick_cycles_max, s->stack_free_min);
    if (s->live != NULL)
        write_live(s->live, out);
    fputs("\n}\n", out);
}

bool summary_write(const struct summary *summary, const char *dir, char *error, size_t room)
{
    FILE *out = record_create(dir, "summary.json", error, room);

    if (out == NULL)
        return false;
    write_json(summary, out);
    if (record_finish(out))
        return true;
    snprintf(error, room, "cannot write %s/summary.json: %s", dir, strerror(errno));
    return false;
}

void summary_print(const struct summary *s, const char *dir, FILE *out)
{
    const struct metrics_result *m = &s->metrics;

    if (s->live != NULL)
        fprintf(out, "%s: %zu robots, %.2f s; %s\n", s->scenario->name, s->scenario->robot_count,
                s->duration, s->live->end);
    else
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
        fprintf(out,
                "  processors      busiest %.1f %%, longest tick %u cycles, "
                "%u bytes of stack never used\n",
                s->load_max_pct, s->tick_cycles_max, s->stack_free_min);
    if (s->live != NULL)
        fprintf(out,
                "  pose to bytes   %.0f us, 99 of 100 within %.0f us, all within %.0f us; "
                "%u links lost\n",
                s->live->delay_p50_us, s->live->delay_p99_us, s->live->delay_max_us,
                s->live->links_lost);
    fprintf(out, "  files           %s/\n", dir);
}
