#include "account.h"

#include "chart.h"
#include "comparison.h"
#include "facts.h"
#include "limits.h"
#include "markup.h"
#include "page.h"
#include "panel.h"
#include "story.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FEW 8       /* runs that have a line of their own; more have a median */
#define POINTS 600  /* of such a line */
#define SNAPSHOTS 6 /* of the formation along its routes, but for the last */
#define APART 12    /* of the run, between two of them */

/* ---- several runs ---------------------------------------------------------------------- */

/* A dash where the run does not say. */
static void write_cell(FILE *out, const struct fact *fact, const struct archive *archive)
{
    char words[FACT_WORDS_MAX];
    bool told = fact_tell(fact, archive, words, sizeof words);

    page_element(out, "td", "number", told ? words : "\u2013");
}

/* A column for each run, so that many numbers of few runs fit; it scrolls where they are many. */
static void write_comparison(struct archive *const *archives, size_t count, FILE *out)
{
    fputs("<div class=\"scroll compared\"><table>\n<tr><td></td>", out);
    for (size_t i = 0; i < count; i++) {
        fprintf(out, "<th class=\"number\"><a href=\"#run-%zu\">", i + 1);
        markup_text(out, archives[i]->name);
        fputs("</a></th>", out);
    }
    for (const struct fact *fact = facts; fact->words != NULL; fact++) {
        if (!fact->compared)
            continue;
        fputs("</tr>\n<tr>", out);
        page_element(out, "th", "", fact->words);
        for (size_t i = 0; i < count; i++)
            write_cell(out, fact, archives[i]);
    }
    fputs("</tr>\n</table></div>\n", out);
}

static double highest(struct archive *const *archives, size_t count)
{
    double peak = 0.01;

    for (size_t i = 0; i < count; i++)
        peak = fmax(peak, history_peak_error(&archives[i]->history, 0));
    return peak;
}

static void draw_run(const struct chart *chart, const struct history *history, const char *classes)
{
    size_t stride = history->ticks / POINTS + 1;

    chart_begin_line(chart, classes);
    for (size_t tick = 0; tick < history->ticks; tick += stride)
        chart_to(chart, history_time(history, tick), history_mean_error(history, tick));
    chart_end_line(chart);
}

static void draw_median(const struct chart *chart, struct archive *const *archives, size_t count)
{
    double end = archives_end(archives, count);

    chart_begin_line(chart, "mean");
    for (int i = 0; i <= POINTS; i++)
        chart_to(chart, end * i / POINTS, comparison_median(archives, count, end * i / POINTS));
    chart_end_line(chart);
}

static void draw_comparison(struct archive *const *archives, size_t count, FILE *out)
{
    static const char *const classes[FEW] = {"c0", "c1", "c2", "c3", "c4", "c5", "c6", "c7"};
    struct axes axes = {
        .words = "Mean distance error of each run over time",
        .x = "t (s)",
        .y = "mean distance error (m)",
        .x1 = archives_end(archives, count),
        .y1 = 1.05 * highest(archives, count),
        .width = 640,
        .height = 340,
    };
    struct chart chart = chart_open(out, &axes);

    for (size_t i = 0; i < count; i++) {
        draw_run(&chart, &archives[i]->history, count <= FEW ? classes[i] : "fine c0");
        if (count <= FEW)
            chart_key(&chart, classes[i], archives[i]->name);
    }
    if (count > FEW) {
        draw_median(&chart, archives, count);
        chart_key(&chart, "fine c0", "each run");
        chart_key(&chart, "mean", "their median");
    }
    chart_close(&chart);
}

static void write_runs(struct archive *const *archives, size_t count, FILE *out)
{
    fputs("<section>\n<h2>Side by side</h2>\n<figure class=\"lone\">\n", out);
    draw_comparison(archives, count, out);
    page_element(out, "figcaption", "", "Mean distance error of each run over time");
    fputs("\n</figure>\n", out);
    write_comparison(archives, count, out);
    fputs("</section>\n", out);
}

/* ---- one run --------------------------------------------------------------------------- */

static void write_facts(const struct archive *archive, FILE *out)
{
    char words[FACT_WORDS_MAX];

    fputs("<div class=\"scroll\"><table>\n", out);
    for (const struct fact *fact = facts; fact->words != NULL; fact++) {
        if (!fact_tell(fact, archive, words, sizeof words))
            continue;
        fputs("<tr>", out);
        page_element(out, "th", "", fact->words);
        page_element(out, "td", "", words);
        fputs("</tr>\n", out);
    }
    fputs("</table></div>\n", out);
}

/* "vertex_won" and the letter of a role, for people. */
static void write_event(const struct incident *incident, FILE *out)
{
    bool role = strcmp(incident->event, "role") == 0;
    char *event = strdup(incident->event);

    for (char *c = event; c != NULL && *c != '\0'; c++)
        *c = *c == '_' ? ' ' : *c;
    page_element(out, "td", "", event != NULL ? event : incident->event);
    page_element(out, "td", "",
                 !role                        ? incident->detail
                 : incident->detail[0] == 'L' ? "leader"
                 : incident->detail[0] == 'C' ? "candidate"
                                              : "follower");
    free(event);
}

static void write_events(const struct archive *archive, FILE *out)
{
    fputs("<div class=\"scroll events\" tabindex=\"0\" role=\"region\" aria-label=\"Events\">"
          "<table>\n<tr><th>t (s)</th><th>robot</th><th>event</th><th></th></tr>\n",
          out);
    for (size_t i = 0; i < archive->incident_count; i++) {
        const struct incident *incident = &archive->incidents[i];

        fprintf(out, "<tr><td class=\"number\">%.2f</td><td class=\"number\">",
                incident->time_ms / 1000.0);
        if (incident->robot != 0)
            fprintf(out, "%u", incident->robot);
        fputs("</td>", out);
        write_event(incident, out);
        fputs("</tr>\n", out);
    }
    fputs("</table></div>\n", out);
}

static void write_panel(const struct panel *panel, const char *classes, FILE *out)
{
    fprintf(out, "<figure class=\"%s\">\n", classes);
    panel->draw(out, panel);
    page_element(out, "figcaption", "", panel->caption);
    fputs("\n</figure>\n", out);
}

/* Shows the formation once more, unless that is too close to where it is shown already. */
static void add_snapshot(struct panel *panel, double t)
{
    const struct history *history = panel->run[0];
    double end = history_time(history, history->ticks - 1), apart = end / APART;

    for (size_t i = 0; i < panel->moments; i++)
        if (fabs(history_time(history, panel->tick[i]) - t) < apart)
            return;
    if (t >= 0 && t < end - apart && panel->moments < SNAPSHOTS)
        panel_mark(panel, history_tick(history, t), "");
}

static void write_routes(const struct archive *archive, const struct story *stories, size_t count,
                         FILE *out)
{
    struct panel panel = {.draw = draw_routes,
                          .caption = "Routes from above, with the team at some moments"};
    double end = archive_end(archive);

    panel_add(&panel, &archive->history, NULL);
    for (size_t i = 0; i < count; i++) {
        add_snapshot(&panel, stories[i].t - TICK_MS / 1000.0);
        add_snapshot(&panel, stories[i].t + end / APART);
    }
    for (int i = 1; i < 4; i++)
        add_snapshot(&panel, end * i / 4);
    write_panel(&panel, "tall", out);
}

static void write_graph(panel_draw *draw, const struct archive *archive,
                        const struct story *stories, size_t count, const char *caption, FILE *out)
{
    struct panel panel = {.draw = draw};

    snprintf(panel.caption, sizeof panel.caption, "%s", caption);
    panel_add(&panel, &archive->history, NULL);
    for (size_t i = 0; i < count; i++)
        panel_mark(&panel, history_tick(&archive->history, stories[i].t), stories[i].words);
    write_panel(&panel, "", out);
}

static void write_figures(const struct archive *archive, FILE *out)
{
    struct story stories[PANEL_MOMENTS];
    size_t count = stories_tell(archive, stories, PANEL_MOMENTS);

    if (count > PANEL_MOMENTS)
        count = PANEL_MOMENTS;
    fputs("<div class=\"panels\">\n", out);
    write_routes(archive, stories, count, out);
    write_graph(draw_vertices, archive, stories, count, "Who leads, and who holds which vertex",
                out);
    write_graph(draw_errors, archive, stories, count,
                "Distance of every robot to its vertex, the leader\u2019s to the reference", out);
    fputs("</div>\n", out);
}

/* What has to be known of the run before its numbers are believed. */
static void write_doubts(const struct archive *archive, FILE *out)
{
    if (archive->cut)
        page_element(out, "p", "finding fails",
                     "Its recording is cut short: the program that wrote it was killed. What "
                     "follows goes as far as the recording does.");
    if (archive->summary == NULL)
        page_element(out, "p", "finding untold",
                     "It has no summary.json; these numbers are measured in the recording.");
}

static void write_run(const struct archive *archive, FILE *out)
{
    if (strcmp(archive->path, archive->name) != 0)
        page_element(out, "p", "soft", archive->path);
    write_doubts(archive, out);
    write_figures(archive, out);
    fputs("<div class=\"beside\">\n", out);
    write_facts(archive, out);
    write_events(archive, out);
    fputs("</div>\n", out);
}

static void write_sections(struct archive *const *archives, size_t count, FILE *out)
{
    for (size_t i = 0; i < count; i++) {
        fprintf(out, "<section id=\"run-%zu\">\n", i + 1);
        page_element(out, "h2", "", archives[i]->name);
        write_run(archives[i], out);
        fputs("</section>\n", out);
    }
}

void account_write(struct archive *const *archives, size_t count, FILE *out)
{
    char title[32];

    snprintf(title, sizeof title, "%zu runs", count);
    page_open(out, count == 1 ? archives[0]->name : title);
    page_element(out, "h1", "", count == 1 ? archives[0]->name : title);
    fputc('\n', out);
    if (count == 1) {
        write_run(archives[0], out);
    } else {
        write_runs(archives, count, out);
        write_sections(archives, count, out);
    }
    page_close(out);
}
