#include "results.h"

#include <err.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define EXACT(figure, of, aim) .name = figure, .unit = of, .goal = aim
#define OF_HOST(figure, of, aim) EXACT(figure, of, aim), .of_host = true

/* The limits that the project has set itself; a control tick ends within 5 ms at 16 MHz. */
struct figure figures[] = {
    {EXACT("fl_law_cycles_max", "cycles", 1000)},
    {EXACT("fl_law_flash_bytes", "bytes", NAN)},
    {EXACT("heading_error_turn65536", "turn/65536", 1.25)},
    {EXACT("sincos_cycles_max", "cycles", NAN)},
    {EXACT("direction_cycles_max", "cycles", NAN)},
    {EXACT("pose_advance_cycles_max", "cycles", NAN)},
    {EXACT("cpa_4_3_cycles_max", "cycles", NAN)},
    {EXACT("cpa_16_16_cycles_max", "cycles", NAN)},
    {EXACT("cpa_100_16_cycles_max", "cycles", 15000)},
    {EXACT("cpa_100_99_cycles_max", "cycles", 50000)},
    {EXACT("frame_decode_20_cycles_max", "cycles", 1400)},
    {EXACT("frame_encode_20_cycles_max", "cycles", NAN)},
    {EXACT("ring_255_cycles_max", "cycles", NAN)},
    {EXACT("tick_100_cycles_max", "cycles", 80000)},
    {EXACT("tick_quiet_cycles_max", "cycles", NAN)},
    {EXACT("load_4_pct", "%", NAN)},
    {EXACT("load_100_pct", "%", 10)},
    {EXACT("ram_static_bytes", "bytes", NAN)},
    {EXACT("stack_max_bytes", "bytes", NAN)},
    {EXACT("stack_bound_bytes", "bytes", NAN)},
    {EXACT("ram_and_stack_bytes", "bytes", 3072)},
    {EXACT("flash_bytes", "bytes", 24576)},
    {OF_HOST("realtime_4_avr", "x", NAN), .more_is_better = true},
    {OF_HOST("realtime_100_avr", "x", 1.5), .more_is_better = true},
    {OF_HOST("realtime_100_native", "x", 100), .more_is_better = true},
    {OF_HOST("realtime_1000_native", "x", 5), .more_is_better = true},
    {OF_HOST("host_bytes_per_avr_robot", "bytes", 81920)},
    {OF_HOST("view_100_slowdown_pct", "%", 5)},
    {OF_HOST("view_100_stuck_slowdown_pct", "%", 5)},
    {OF_HOST("serve_100_p50_us", "us", NAN)},
    {OF_HOST("serve_100_p99_us", "us", NAN)}, /* measure_serve() has the goal */
    {OF_HOST("serve_100_core_pct", "%", 20)},
};

const size_t figure_count = sizeof figures / sizeof figures[0];

struct figure *figure_of(const char *name)
{
    for (size_t i = 0; i < figure_count; i++)
        if (strcmp(figures[i].name, name) == 0)
            return &figures[i];
    errx(EXIT_FAILURE, "%s is no figure", name);
}

void figure_set(const char *name, double value)
{
    struct figure *figure = figure_of(name);

    figure->known = true;
    figure->value = value;
}

void figure_worst(const char *name, double value)
{
    const struct figure *figure = figure_of(name);

    if (!figure->known || value > figure->value)
        figure_set(name, value);
}

static struct baseline *baseline_of(const char *name, const char *baseline)
{
    struct baseline *b = figure_of(name)->baseline;

    while (b->name != NULL && strcmp(b->name, baseline) != 0)
        b++;
    return b;
}

void figure_worst_baseline(const char *name, const char *baseline, double value)
{
    struct baseline *b = baseline_of(name, baseline);

    if (b->name == NULL || value > b->value)
        *b = (struct baseline){baseline, value};
}

static bool met(const struct figure *f)
{
    return f->more_is_better ? f->value >= f->goal : f->value <= f->goal;
}

int figure_decimals(double value)
{
    return value == floor(value) ? 0 : 2;
}

static void print_line(const struct figure *f, FILE *out)
{
    char goal[32] = "";

    if (!isnan(f->goal))
        snprintf(goal, sizeof goal, "%g %s", f->goal, met(f) ? "met" : "MISSED");
    fprintf(out, "%-26s %11.*f %-10s  %-13s", f->name, figure_decimals(f->value), f->value, f->unit,
            goal);
    for (const struct baseline *b = f->baseline; b < f->baseline + BASELINES_MAX && b->name; b++)
        fprintf(out, "  %6s %9.0f, %5.1f times", b->name, b->value, b->value / f->value);
    fputc('\n', out);
}

void results_print(FILE *out)
{
    fprintf(out, "%-26s %11s %-10s  %-13s  %s\n", "figure", "value", "unit", "goal", "baselines");
    for (size_t i = 0; i < figure_count; i++)
        if (figures[i].known)
            print_line(&figures[i], out);
}

static void write_figure(const struct figure *f, FILE *out)
{
    fprintf(out, "  \"%s\": {\"value\": %.*f, \"unit\": \"%s\", ", f->name,
            figure_decimals(f->value), f->value, f->unit);
    if (isnan(f->goal))
        fputs("\"goal\": null, \"baselines\": {", out);
    else
        fprintf(out, "\"goal\": %g, \"baselines\": {", f->goal);
    for (const struct baseline *b = f->baseline; b < f->baseline + BASELINES_MAX && b->name; b++)
        fprintf(out, "%s\"%s\": %.0f", b == f->baseline ? "" : ", ", b->name, b->value);
    fputs("}}", out);
}

void results_write_json(FILE *out)
{
    fputs("{\n", out);
    for (size_t i = 0; i < figure_count; i++) {
        write_figure(&figures[i], out);
        fputs(i + 1 < figure_count ? ",\n" : "\n", out);
    }
    fputs("}\n", out);
}
