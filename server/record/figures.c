#include "figures.h"

#include "figures_data.h"
#include "gnuplot.h"

#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LEGEND_MAX GNUPLOT_COLOURS /* robots; more have no legend and share a scale of colours */
#define CROWD 16 /* robots; more are drawn finely and as a formation only at the end */
#define SNAPSHOTS_MAX 12
#define LABELS_MAX 12 /* events with a word beside their line */

/* Viridis without its yellow end, which is faint on white. */
static const unsigned many[] = {0x440154, 0x414487, 0x2A788E, 0x22A884, 0x7AD151};

#define MANY_STEPS (sizeof many / sizeof many[0] - 1)

static unsigned mix(unsigned from, unsigned to, double share)
{
    unsigned colour = 0;

    for (int shift = 0; shift <= 16; shift += 8) {
        double a = from >> shift & 0xFF;
        double b = to >> shift & 0xFF;
        colour |= (unsigned)lround(a + (b - a) * share) << shift;
    }
    return colour;
}

static unsigned colour_of(const struct trace *trace, size_t robot)
{
    if (trace->robots <= LEGEND_MAX)
        return gnuplot_colours[robot];

    double at = (double)robot / (double)(trace->robots - 1) * MANY_STEPS;
    size_t step = at < MANY_STEPS ? (size_t)at : MANY_STEPS - 1;
    return mix(many[step], many[step + 1], at - (double)step);
}

static bool is_crowd(const struct trace *trace)
{
    return trace->robots > CROWD;
}

static const struct sample *sample_at(const struct trace *trace, size_t tick, size_t robot)
{
    return &trace->samples[tick * trace->robots + robot];
}

/* The moments at which the formation is shown. */
struct snapshots {
    size_t count;
    double t[SNAPSHOTS_MAX];
    size_t tick[SNAPSHOTS_MAX]; /* of the trace, the last one before t */
};

static double end_of(const struct trace *trace)
{
    return trace->t[trace->ticks - 1];
}

static void add_snapshot(struct snapshots *snapshots, const struct trace *trace, double t)
{
    double apart = end_of(trace) / 15;
    size_t tick = 0;

    for (size_t i = 0; i < snapshots->count; i++) {
        if (fabs(snapshots->t[i] - t) < apart)
            return;
    }
    if (snapshots->count == SNAPSHOTS_MAX || t < apart || t > end_of(trace))
        return;
    while (tick + 1 < trace->ticks && trace->t[tick + 1] < t)
        tick++;
    snapshots->t[snapshots->count] = t;
    snapshots->tick[snapshots->count++] = tick;
}

/* The end, before and after each event, and between these evenly. */
static void choose_snapshots(struct snapshots *snapshots, const struct trace *trace,
                             const struct marks *marks)
{
    snapshots->count = 1;
    snapshots->t[0] = end_of(trace);
    snapshots->tick[0] = trace->ticks - 1;
    if (is_crowd(trace))
        return;
    for (size_t i = 0; i < marks->count; i++) {
        add_snapshot(snapshots, trace, marks->mark[i].t);
        add_snapshot(snapshots, trace, marks->mark[i].t + end_of(trace) / 12);
    }
    for (int i = 1; i < 6; i++)
        add_snapshot(snapshots, trace, end_of(trace) * i / 6);
}

static void write_routes(FILE *out, const struct trace *trace)
{
    fputs("$routes << END\n", out);
    for (size_t robot = 0; robot < trace->robots; robot++) {
        for (size_t tick = 0; tick < trace->ticks; tick++) {
            const struct sample *sample = sample_at(trace, tick, robot);
            fprintf(out, "%.4f %.4f %u\n", sample->x, sample->y, colour_of(trace, robot));
        }
        fputc('\n', out);
    }
    fputs("END\n", out);
}

static void write_errors(FILE *out, const struct trace *trace)
{
    unsigned veil = is_crowd(trace) ? 0xA0000000u : 0; /* lets the lines below show through */

    fputs("$errors << END\n", out);
    for (size_t robot = 0; robot < trace->robots; robot++) {
        for (size_t tick = 0; tick < trace->ticks; tick++) {
            const struct sample *sample = sample_at(trace, tick, robot);
            if (sample->alive)
                fprintf(out, "%.3f %.4f %u\n", trace->t[tick], sample->error,
                        colour_of(trace, robot) | veil);
            else
                fputc('\n', out);
        }
        fputc('\n', out);
    }
    fputs("END\n", out);
}

static void write_mean(FILE *out, const struct trace *trace)
{
    fputs("$mean << END\n", out);
    for (size_t tick = 0; tick < trace->ticks; tick++) {
        double sum = 0;
        size_t alive = 0;
        for (size_t robot = 0; robot < trace->robots; robot++) {
            const struct sample *sample = sample_at(trace, tick, robot);
            sum += sample->alive ? sample->error : 0;
            alive += sample->alive;
        }
        if (alive > 0)
            fprintf(out, "%.3f %.4f\n", trace->t[tick], sum / (double)alive);
    }
    fputs("END\n", out);
}

/* Where every robot is at a tick. */
static void write_spots(FILE *out, const char *name, const struct trace *trace, size_t tick)
{
    fprintf(out, "%s << END\n", name);
    for (size_t robot = 0; robot < trace->robots; robot++) {
        const struct sample *sample = sample_at(trace, tick, robot);
        fprintf(out, "%.4f %.4f %u\n", sample->x, sample->y, colour_of(trace, robot));
    }
    fputs("END\n", out);
}

/* Where robots died. */
static void write_lost(FILE *out, const struct trace *trace)
{
    fputs("$lost << END\n", out);
    for (size_t tick = 1; tick < trace->ticks; tick++) {
        for (size_t robot = 0; robot < trace->robots; robot++) {
            const struct sample *sample = sample_at(trace, tick, robot);
            if (!sample->alive && sample_at(trace, tick - 1, robot)->alive)
                fprintf(out, "%.4f %.4f\n", sample->x, sample->y);
        }
    }
    fputs("END\n", out);
}

static size_t leader_at(const struct trace *trace, size_t tick)
{
    size_t robot = 0;

    while (robot < trace->robots &&
           !(sample_at(trace, tick, robot)->leads && sample_at(trace, tick, robot)->alive))
        robot++;
    return robot;
}

/* Lines from the leader to every other live robot. */
static void write_joins(FILE *out, const struct trace *trace, const struct snapshots *snapshots)
{
    fputs("$joins << END\n", out);
    for (size_t i = 0; i < snapshots->count && !is_crowd(trace); i++) {
        size_t tick = snapshots->tick[i];
        size_t leader = leader_at(trace, tick);
        for (size_t robot = 0; leader < trace->robots && robot < trace->robots; robot++) {
            const struct sample *from = sample_at(trace, tick, leader);
            const struct sample *to = sample_at(trace, tick, robot);
            if (robot != leader && to->alive)
                fprintf(out, "%.4f %.4f\n%.4f %.4f\n\n", from->x, from->y, to->x, to->y);
        }
    }
    fputs("END\n", out);
}

static void write_snapshots(FILE *out, const struct trace *trace, const struct snapshots *snapshots)
{
    fputs("$members << END\n", out);
    for (size_t i = 0; i < snapshots->count; i++) {
        for (size_t robot = 0; robot < trace->robots; robot++) {
            const struct sample *sample = sample_at(trace, snapshots->tick[i], robot);
            if (sample->alive)
                fprintf(out, "%.4f %.4f %u\n", sample->x, sample->y, colour_of(trace, robot));
        }
    }
    fputs("END\n$leaders << END\n", out);
    for (size_t i = 0; i < snapshots->count; i++) {
        size_t tick = snapshots->tick[i];
        size_t leader = leader_at(trace, tick);
        if (leader == trace->robots)
            continue;
        const struct sample *sample = sample_at(trace, tick, leader);
        fprintf(out, "%.4f %.4f \"%.3g s\"\n", sample->x, sample->y, snapshots->t[i]);
    }
    fputs("END\n", out);
}

static void write_data(FILE *out, const struct trace *trace, const struct marks *marks)
{
    struct snapshots snapshots;

    choose_snapshots(&snapshots, trace, marks);
    write_routes(out, trace);
    write_errors(out, trace);
    write_mean(out, trace);
    write_spots(out, "$start", trace, 0);
    write_lost(out, trace);
    write_joins(out, trace, &snapshots);
    write_snapshots(out, trace, &snapshots);
}

static void write_legend(FILE *out, const struct trace *trace)
{
    for (size_t robot = 0; robot < trace->robots && trace->robots <= LEGEND_MAX; robot++)
        fprintf(out, ", keyentry with lines lw 2 lc rgb 0x%06X title 'robot %u'",
                colour_of(trace, robot), trace->id[robot]);
}

static void draw_routes(FILE *out, const struct trace *trace)
{
    bool crowd = is_crowd(trace);

    fputs("unset arrow\nunset label\n"
          "set size ratio -1\n"
          "set offsets graph 0.05, graph 0.05, graph 0.05, graph 0.05\n"
          "set xlabel 'x (m)'\nset ylabel 'y (m)'\n"
          "set key outside right top Left reverse samplen 1.5\n",
          out);
    fprintf(out,
            "plot $joins using 1:2 with lines lw 1 lc rgb 0xB0B0B0 notitle, "
            "$routes using 1:2:3 with lines lw %g lc rgb variable notitle, "
            "$start using 1:2:3 with points pt 4 ps %g lw 1.5 lc rgb variable notitle, "
            "$members using 1:2:3 with points pt 7 ps %g lc rgb variable notitle, "
            "$leaders using 1:2 with points pt 6 ps %g lw 1.5 lc rgb 0x202020 notitle, "
            "$leaders using 1:2:3 with labels offset char 0, char 1.1 tc rgb 0x404040 notitle",
            crowd ? 0.4 : 1.6, crowd ? 0.4 : 1.3, crowd ? 0.5 : 0.8, crowd ? 1.0 : 1.6);
    write_legend(out, trace);
    fprintf(out,
            ", keyentry with points pt 4 ps %g lc rgb 0x606060 title 'start'"
            ", keyentry with points pt 6 ps 1.6 lw 1.5 lc rgb 0x202020 title 'leader'"
            ", $lost using 1:2 with points pt 2 ps 1.6 lw 2.5 lc rgb 0x000000"
            " title (|$lost| > 0 ? 'lost' : '')\n",
            crowd ? 0.8 : 1.3);
}

static void draw_marks(FILE *out, const struct marks *marks)
{
    for (size_t i = 0; i < marks->count; i++) {
        const struct mark *mark = &marks->mark[i];
        fprintf(out, "set arrow from %.3f, graph 0 to %.3f, graph 1 nohead dt 3 lc rgb 0x707070\n",
                mark->t, mark->t);
        if (marks->count > LABELS_MAX)
            continue;
        fprintf(out, "set label '%s", mark->word);
        if (mark->robot != 0)
            fprintf(out, " %u", mark->robot);
        fprintf(out,
                "' at %.3f, graph 0.98 right rotate by 90 offset char 0.8, 0"
                " tc rgb 0x404040\n",
                mark->t);
    }
}

static void draw_errors(FILE *out, const struct trace *trace, const struct marks *marks)
{
    fputs("set size noratio\nset offsets 0, 0, graph 0.05, 0\n"
          "set xlabel 't (s)'\nset ylabel 'distance error (m)'\n"
          "set key inside right top Left reverse samplen 1.5 opaque\n",
          out);
    draw_marks(out, marks);
    fprintf(out,
            "plot [0:%.3f] [0:*] $errors using 1:2:3 with lines lw %g lc rgb variable notitle, "
            "$mean using 1:2 with lines lw 3 lc rgb 0x000000 title 'mean'",
            fmax(end_of(trace), 1e-3), is_crowd(trace) ? 0.6 : 1.2);
    write_legend(out, trace);
    fputc('\n', out);
}

/* A picture's size in pixels. */
struct canvas {
    int width, height;
};

/* As large as the routes need at one scale for x and y, with room for axes and legend. */
static struct canvas canvas_of_routes(const struct trace *trace)
{
    double left = INFINITY, right = -INFINITY, low = INFINITY, high = -INFINITY;

    for (size_t i = 0; i < trace->ticks * trace->robots; i++) {
        left = fmin(left, trace->samples[i].x);
        right = fmax(right, trace->samples[i].x);
        low = fmin(low, trace->samples[i].y);
        high = fmax(high, trace->samples[i].y);
    }
    double width = fmax(right - left, 1e-3);
    double height = fmax(high - low, 1e-3);
    double scale = fmin(720 / width, 640 / height);
    return (struct canvas){(int)fmax(width * scale, 240) + 220,
                           (int)fmax(height * scale, 240) + 100};
}

static void write_script(FILE *out, const struct trace *trace, const struct marks *marks)
{
    static const struct {
        const char *terminal, *font, *suffix;
    } formats[] = {{"svg", "sans,13", "svg"}, {"pngcairo", "sans,11", "png"}};
    struct canvas canvas = canvas_of_routes(trace);

    write_data(out, trace, marks);
    fputs("set grid lc rgb 0xE4E4E4 lt 1\nset border 3\nset tics nomirror\n", out);
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++) {
        const char *terminal = formats[i].terminal;
        const char *font = formats[i].font;
        fprintf(out, "set terminal %s size %d,%d font '%s' background rgb 'white'\n", terminal,
                canvas.width, canvas.height, font);
        fprintf(out, "set output 'routes.%s'\n", formats[i].suffix);
        draw_routes(out, trace);
        fprintf(out, "set terminal %s size 900,560 font '%s' background rgb 'white'\n", terminal,
                font);
        fprintf(out, "set output 'distance_error.%s'\n", formats[i].suffix);
        draw_errors(out, trace, marks);
    }
    fputs("set output\n", out);
}

static int complain(const char *dir, const char *reason)
{
    fprintf(stderr, "No figures in %s: %s\n", dir, reason);
    return -1;
}

static int draw(const char *dir, const struct trace *trace, const struct marks *marks)
{
    FILE *script = tmpfile();
    char reason[256];

    if (script == NULL)
        return complain(dir, strerror(errno));
    write_script(script, trace, marks);
    bool drawn = gnuplot_run(dir, script, reason, sizeof reason);
    fclose(script);
    return drawn ? 0 : complain(dir, reason);
}

int figures_write(const char *dir)
{
    struct trace trace;
    struct marks marks;

    if (!trace_read(&trace, dir))
        return complain(dir, "trace.csv cannot be read");
    marks_read(&marks, dir);
    int result = draw(dir, &trace, &marks);
    trace_free(&trace);
    return result;
}
