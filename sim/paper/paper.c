#include "paper.h"

#include "figures.h"
#include "laws.h"
#include "progress.h"
#include "record.h"
#include "report.h"
#include "runs.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A simulated chip takes about as long as that many native robots. */
#define CHIP_COST 100

struct paper {
    const struct paper_options *options;
    const volatile bool *stop;
    struct runs runs;
    size_t wanted, done;     /* runs */
    double whole_cost, cost; /* of all, and of those that are done */
    struct run *run;         /* under way */
    struct progress progress;
    char *error;
    size_t room;
};

bool paper_has_figure(int number)
{
    for (size_t i = 0; i < FIGURE_COUNT; i++)
        if (figure_number(i) == number)
            return true;
    return false;
}

static bool is_wanted(const struct paper *paper, int figure)
{
    return paper->options->only == 0 || paper->options->only == figure;
}

static bool is_needed(const struct paper *paper, const struct run *run)
{
    return paper->options->only == 0 || run->figures >> paper->options->only & 1;
}

/* ---- running --------------------------------------------------------------------------- */

/* How long a run takes, in some unit. */
static double cost_of(const struct paper *paper, const struct run *run)
{
    bool chips = run_robots(run, paper->options) == SIM_AVR;

    return (double)run->scenario->robot_count * run->scenario->duration * (chips ? CHIP_COST : 1);
}

static bool prepare(struct paper *paper)
{
    for (size_t i = 0; i < RUN_COUNT; i++) {
        struct run *run = &paper->runs.all[i];

        if (!is_needed(paper, run))
            continue;
        if (!run_prepare(run, paper->options, paper->error, paper->room))
            return false;
        paper->wanted++;
        paper->whole_cost += cost_of(paper, run);
    }
    return true;
}

static void show_progress(void *context, double t)
{
    struct paper *paper = context;
    double duration = paper->run->scenario->duration;
    double cost = paper->cost + cost_of(paper, paper->run) * (duration > 0 ? t / duration : 1);

    progress_show(&paper->progress, cost / paper->whole_cost, "%zu of %zu: %s", paper->done + 1,
                  paper->wanted, paper->run->name);
}

static void tell(struct paper *paper)
{
    const struct run *run = paper->run;

    if (paper->options->quiet)
        return;
    progress_end(&paper->progress);
    printf("%2zu of %zu  %-40s %3zu %-9s  %2.0f s in %5.1f s\n", paper->done, paper->wanted,
           run->name, run->scenario->robot_count, run->summary.avr ? "ATmega128" : "native",
           run->summary.duration, run->summary.wall);
    fflush(stdout);
}

static enum sim_end run_all(struct paper *paper)
{
    const struct run_watch watch = {show_progress, paper};

    for (size_t i = 0; i < RUN_COUNT; i++) {
        paper->run = &paper->runs.all[i];
        if (!is_needed(paper, paper->run))
            continue;
        enum sim_end end = run_carry_out(paper->run, paper->options, &watch, paper->stop,
                                         paper->error, paper->room);
        if (end != SIM_DONE)
            return end;
        paper->done++;
        paper->cost += cost_of(paper, paper->run);
        tell(paper);
    }
    return SIM_DONE;
}

static enum sim_end run_needed(struct paper *paper)
{
    runs_plan(&paper->runs);
    if (is_wanted(paper, 1)) {
        enum sim_end end =
            laws_match(&paper->runs, paper->options, paper->stop, paper->error, paper->room);
        if (end != SIM_DONE)
            return end;
    }
    return prepare(paper) ? run_all(paper) : SIM_REFUSED;
}

/* ---- writing --------------------------------------------------------------------------- */

static const struct {
    const char *name;
    void (*write)(const struct report *report, FILE *out);
} files[] = {
    {"report.html", report_html},
    {"summary.json", report_json},
    {"paper.md", report_markdown},
};

#define FILE_COUNT (sizeof files / sizeof files[0])

/* An earlier report must not be taken for that of a run which came to nothing. */
static void remove_old(const struct paper *paper)
{
    char path[512];

    for (size_t i = 0; i < FILE_COUNT; i++) {
        snprintf(path, sizeof path, "%s/%s", paper->options->out, files[i].name);
        remove(path);
    }
}

static bool write_file(const struct paper *paper, const struct report *report, size_t i)
{
    FILE *out = record_create(paper->options->out, files[i].name, paper->error, paper->room);

    if (out == NULL)
        return false;
    files[i].write(report, out);
    if (record_finish(out))
        return true;
    snprintf(paper->error, paper->room, "cannot write %s/%s: %s", paper->options->out,
             files[i].name, strerror(errno));
    return false;
}

static bool write_report(const struct paper *paper)
{
    struct figure *figures = calloc(FIGURE_COUNT, sizeof *figures);
    struct report report = {
        .avr = paper->options->robots == SIM_AVR,
        .wall = progress_elapsed(&paper->progress),
        .runs = &paper->runs,
        .figures = figures,
    };
    bool good = figures != NULL;

    if (figures == NULL)
        snprintf(paper->error, paper->room, "no memory");
    for (size_t i = 0; good && i < FIGURE_COUNT; i++)
        if (is_wanted(paper, figure_number(i)))
            figure_fill(&figures[report.count++], i, &paper->runs);
    for (size_t i = 0; good && i < FILE_COUNT; i++)
        good = write_file(paper, &report, i);
    free(figures);
    return good;
}

enum sim_end paper_write(const struct paper_options *options, const volatile bool *stop,
                         char *error, size_t room)
{
    struct paper paper = {.options = options, .stop = stop, .error = error, .room = room};

    remove_old(&paper);
    progress_begin(&paper.progress, options->quiet);
    enum sim_end end = run_needed(&paper);
    progress_end(&paper.progress);
    if (end == SIM_DONE && !write_report(&paper))
        end = SIM_FAILED;
    runs_free(&paper.runs);
    return end;
}
