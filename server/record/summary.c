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
    fprintf(out, "  files           %s/\n", dir);
}
