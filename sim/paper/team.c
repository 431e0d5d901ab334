/* team.c: figures of one team in one run: a leader that is lost, a formation that changes. */
#include "figures.h"

#include "limits.h"

#include <math.h>

#define TAKEOVER_MAX 0.7 /* s from the leader's loss to a new one */
#define ERROR_MAX 0.02   /* m, mean, when the last transient is over */
#define CALM 3.0         /* s at the end of a run, in which it has to be */

/* ---- what became of the team ----------------------------------------------------------- */

struct succession {
    size_t died, took_over; /* ticks, or NEVER */
    unsigned first, second; /* ids of the leaders before and after, 0 = none */
    double gap;             /* s without a leader */
    bool recovered;
};

static unsigned id_of(const struct run *run, size_t robot)
{
    return robot == NEVER ? 0 : run->scenario->robots[robot].id;
}

static double time_of(const struct run *run, size_t tick)
{
    return history_time(&run->history, tick);
}

static struct succession fault_of(const struct run *run)
{
    const struct history *history = &run->history;
    size_t leader = history_leader(history, 0);
    struct succession fault = {
        .died = history_death(history),
        .took_over = history_takeover(history, leader),
        .first = id_of(run, leader),
        .gap = INFINITY,
    };

    if (fault.died == NEVER || fault.took_over == NEVER)
        return fault;
    fault.second = id_of(run, history_leader(history, fault.took_over));
    fault.gap = time_of(run, fault.took_over) - time_of(run, fault.died);
    fault.recovered = fault.gap <= TAKEOVER_MAX && run->summary.metrics.complete;
    return fault;
}

static size_t last_tick(const struct run *run)
{
    return run->history.ticks - 1;
}

/* The largest mean distance error when all is over. */
static double settled_error(const struct run *run)
{
    const struct history *history = &run->history;

    return history_peak_error(history, history_tick(history, time_of(run, last_tick(run)) - CALM));
}

static const char *completeness(const struct run *run)
{
    return run->summary.metrics.complete ? "complete" : "not complete";
}

/* ---- tables ---------------------------------------------------------------------------- */

static void tabulate_fault(struct figure *figure, const struct run *run,
                           const struct succession *fault)
{
    static const struct column columns[] = {
        {"first_leader", "first leader"}, {"lost_at_s", "lost at (s)"},
        {"new_leader", "new leader"},     {"leads_at_s", "leads at (s)"},
        {"takeover_s", "take-over (s)"},  {NULL, NULL},
    };
    struct table *table = figure_table(figure, "The loss of the leader", columns);

    table_number(table, fault->first, 0);
    table_number(table, time_of(run, fault->died), 2);
    table_number(table, fault->second, 0);
    table_number(table, time_of(run, fault->took_over), 2);
    table_number(table, fault->gap, 2);
}

static void tabulate_change(struct figure *figure, const struct run *run, size_t changed)
{
    static const struct column columns[] = {
        {"changed_at_s", "changed at (s)"},
        {"error_after_m", "largest mean error after it (m)"},
        {"settled_m", "of the last 3 s (m)"},
        {NULL, NULL},
    };
    struct table *table = figure_table(figure, "The change of the formation", columns);

    table_number(table, time_of(run, changed), 2);
    table_number(table, history_peak_error(&run->history, changed), 2);
    table_number(table, settled_error(run), 4);
}

static void tabulate_allocation(struct figure *figure, const struct run *run)
{
    static const struct column columns[] = {
        {"final_leader", "leader at the end"},
        {"elections", "elections"},
        {"vertices_held", "vertices held"},
        {"switches", "vertex switches"},
        {"time_to_complete_s", "complete after the event (s)"},
        {"path_m", "driven in all (m)"},
        {"min_separation_m", "closest approach (m)"},
        {NULL, NULL},
    };
    const struct metrics_result *m = &run->summary.metrics;
    struct table *table = figure_table(figure, "The allocation", columns);

    table_number(table, id_of(run, history_leader(&run->history, last_tick(run))), 0);
    table_number(table, (double)m->elections, 0);
    table_number(table, (double)history_held(&run->history, last_tick(run)), 0);
    table_number(table, (double)m->switches, 0);
    table_number(table, m->complete ? m->time_to_complete : INFINITY, 2);
    table_number(table, m->path_length, 1);
    table_number(table, m->min_separation, 2);
}

static void tabulate_errors(struct figure *figure, const struct run *run)
{
    static const struct column columns[] = {
        {"peak_m", "peak (m)"},
        {"integral_m_s", "integral (m s)"},
        {"settled_m", "largest of the last 3 s (m)"},
        {"final_m", "at the end (m)"},
        {NULL, NULL},
    };
    const struct metrics_result *m = &run->summary.metrics;
    struct table *table = figure_table(figure, "The mean distance error", columns);

    table_number(table, m->error_peak, 3);
    table_number(table, m->error_integral, 2);
    table_number(table, settled_error(run), 4);
    table_number(table, m->error_final, 4);
}

/* ---- panels ---------------------------------------------------------------------------- */

static void show_snapshot(struct figure *figure, const struct run *run, size_t tick,
                          const char *words)
{
    if (tick == NEVER || tick > last_tick(run))
        return;
    struct panel *panel =
        figure_panel(figure, draw_snapshot, run, "t = %.2f s: %s", time_of(run, tick), words);
    panel_mark(panel, tick, words);
}

static void show_vertices(struct figure *figure, const struct run *run, size_t tick,
                          const char *word)
{
    struct panel *panel =
        figure_panel(figure, draw_vertices, run, "Who leads, and who holds which vertex");

    panel_mark(panel, tick, word);
}

static size_t seconds_after(const struct run *run, size_t tick, double seconds)
{
    return tick == NEVER ? NEVER : history_tick(&run->history, time_of(run, tick) + seconds);
}

/* The tick before something happened. */
static size_t before(size_t tick)
{
    return tick == NEVER || tick == 0 ? tick : tick - 1;
}

/* ---- a leader is lost ------------------------------------------------------------------ */

void figure_of_fault_routes(struct figure *figure, const struct run *run)
{
    struct succession fault = fault_of(run);
    struct panel *panel =
        figure_panel(figure, draw_routes, run,
                     "Routes, with the team before the loss, at the take-over and at the end");

    panel_mark(panel, before(fault.died), "");
    panel_mark(panel, fault.took_over, "");
    show_vertices(figure, run, fault.died, "leader lost");
    tabulate_fault(figure, run, &fault);
    figure_find(figure,
                "When the leader is lost, another candidate leads, and the formation goes on.",
                fault.recovered ? HOLDS : FAILS,
                "Robot %u leads from the start and is lost at %.2f s. Robot %u leads %.2f s "
                "later, and at %.0f s the formation of those that live is %s.",
                fault.first, time_of(run, fault.died), fault.second, fault.gap,
                time_of(run, last_tick(run)), completeness(run));
}

void figure_of_fault_roles(struct figure *figure, const struct run *run)
{
    struct succession fault = fault_of(run);
    const struct metrics_result *m = &run->summary.metrics;

    show_snapshot(figure, run, before(fault.died), "the moment before the loss");
    show_snapshot(figure, run, before(fault.took_over), "nobody leads");
    show_snapshot(figure, run, seconds_after(run, fault.took_over, 1),
                  "a second with the new leader");
    show_snapshot(figure, run, last_tick(run), "the end");
    tabulate_allocation(figure, run);
    figure_find(figure,
                "The robots take the vertices by competing with their neighbours, also about the "
                "new leader.",
                m->complete ? HOLDS : FAILS,
                "%zu live followers hold %zu different vertices at the end; the allocation is %s, "
                "after %llu vertex switches in all.",
                run->history.robots - (fault.died == NEVER ? 1 : 2),
                history_held(&run->history, last_tick(run)), completeness(run),
                (unsigned long long)m->switches);
}

static void judge_errors(struct figure *figure, const struct run *run, const char *claim)
{
    figure_find(
        figure, claim, settled_error(run) <= ERROR_MAX ? HOLDS : FAILS,
        "The mean distance error rises to %.2f m and stays below %.4f m in the last %.0f s; %.2f "
        "m are allowed.",
        run->summary.metrics.error_peak, settled_error(run), CALM, ERROR_MAX);
}

static void show_errors(struct figure *figure, const struct run *run, size_t tick, const char *word)
{
    struct panel *panel =
        figure_panel(figure, draw_errors, run,
                     "Distance of every robot to its vertex, the leader's to the reference");

    panel->wide = true;
    panel_mark(panel, tick, word);
    tabulate_errors(figure, run);
}

void figure_of_fault_errors(struct figure *figure, const struct run *run)
{
    show_errors(figure, run, history_death(&run->history), "leader lost");
    judge_errors(figure, run, "The distance errors go back to zero after the leader's loss.");
}

/* ---- the formation changes ------------------------------------------------------------- */

void figure_of_change_routes(struct figure *figure, const struct run *run)
{
    size_t changed = history_reformation(&run->history);
    const struct metrics_result *m = &run->summary.metrics;
    struct panel *panel =
        figure_panel(figure, draw_routes, run,
                     "Routes, with the team before the change, 2 s later and at the end");

    panel_mark(panel, before(changed), "");
    panel_mark(panel, seconds_after(run, changed, 2), "");
    show_vertices(figure, run, changed, "formation changes");
    tabulate_change(figure, run, changed);
    figure_find(figure, "The team goes over from one formation to another by the same competition.",
                changed != NEVER && m->complete ? HOLDS : FAILS,
                "The formation changes at %.2f s. The allocation is %s%s; %zu vertices are held "
                "at the end, after %llu vertex switches in all.",
                time_of(run, changed), completeness(run),
                m->complete && m->time_to_complete == 0 ? " at once and stays so" : "",
                history_held(&run->history, last_tick(run)), (unsigned long long)m->switches);
}

void figure_of_change_vertices(struct figure *figure, const struct run *run)
{
    size_t changed = history_reformation(&run->history);
    const struct metrics_result *m = &run->summary.metrics;

    show_snapshot(figure, run, before(changed), "the moment before the change");
    show_snapshot(figure, run, seconds_after(run, changed, 0.5), "half a second after it");
    show_snapshot(figure, run, seconds_after(run, changed, 2), "2 s after it");
    show_snapshot(figure, run, last_tick(run), "the end");
    tabulate_allocation(figure, run);
    figure_find(figure, "Every vertex of the new formation is taken by one robot.",
                m->complete ? HOLDS : FAILS,
                "%zu vertices are held at the end; the allocation is %s %.2f s after the change.",
                history_held(&run->history, last_tick(run)), completeness(run),
                m->complete ? m->time_to_complete : INFINITY);
}

void figure_of_change(struct figure *figure, const struct run *run)
{
    figure_of_change_routes(figure, run);
    figure_of_change_vertices(figure, run);
}

void figure_of_change_errors(struct figure *figure, const struct run *run)
{
    show_errors(figure, run, history_reformation(&run->history), "formation changes");
    judge_errors(figure, run, "The distance errors go back to zero after the change.");
}
