/* compare.c: figures that set the allocations beside one another. */
#include "figures.h"

#include <math.h>

static const struct column columns[] = {
    {"scenario", "scenario"},
    {"range_m", "range (m)"},
    {"allocation", "allocation"},
    {"final_leader", "leader"},
    {"vertices_held", "vertices held"},
    {"complete", "complete"},
    {"switches", "switches"},
    {"error_integral_m_s", "error, integral (m s)"},
    {"error_integral_after_m_s", "of it after the event"},
    {"path_m", "driven in all (m)"},
    {NULL, NULL},
};

static double path_of(const struct run *run)
{
    return run->summary.metrics.path_length;
}

static double integral_of(const struct run *run)
{
    return run->summary.metrics.error_integral;
}

static size_t held_by(const struct run *run)
{
    return history_held(&run->history, run->history.ticks - 1);
}

static unsigned leader_of(const struct run *run)
{
    size_t leader = run->summary.metrics.leader;

    return leader == SERVER_NOBODY ? 0 : run->scenario->robots[leader].id;
}

static size_t event_of(const struct run *run)
{
    size_t died = history_death(&run->history);

    return died != NEVER ? died : history_reformation(&run->history);
}

static void tabulate_run(struct table *table, const struct run *run, const char *scenario,
                         int scheme)
{
    const struct metrics_result *m = &run->summary.metrics;
    size_t event = event_of(run);

    table_words(table, "%s", scenario);
    table_number(table, run->scenario->range, 0);
    table_words(table, "%s", scheme_words[scheme]);
    table_number(table, leader_of(run), 0);
    table_number(table, (double)held_by(run), 0);
    table_words(table, "%s", m->complete ? "yes" : "no");
    table_number(table, (double)m->switches, 0);
    table_number(table, m->error_integral, 2);
    if (event == NEVER)
        table_words(table, "-");
    else
        table_number(table, history_error_integral(&run->history, event), 2);
    table_number(table, path_of(run), 1);
}

static bool is_least(double cpa, double rigid, double optimal)
{
    return cpa < rigid && cpa < optimal;
}

/* ---- figure 10: four robots ------------------------------------------------------------ */

static void show_means(struct figure *figure, const struct run *runs, const char *scenario,
                       const char *event)
{
    struct panel *panel =
        figure_panel(figure, draw_mean_errors, &runs[CPA], "Mean distance error, %s", scenario);

    panel->word[0] = scheme_words[CPA];
    panel_add(panel, &runs[RIGID], scheme_words[RIGID]);
    panel_add(panel, &runs[OPTIMAL], scheme_words[OPTIMAL]);
    panel_mark(panel, event_of(&runs[CPA]), event);
}

static void judge_means(struct figure *figure, const struct run *fault, const struct run *change)
{
    bool least = is_least(integral_of(&fault[CPA]), integral_of(&fault[RIGID]),
                          integral_of(&fault[OPTIMAL])) &&
                 is_least(integral_of(&change[CPA]), integral_of(&change[RIGID]),
                          integral_of(&change[OPTIMAL]));
    size_t changed = event_of(&change[CPA]);

    figure_find(figure, "With CPA the mean distance error is smaller than with rigid and with optimal "
                        "allocation.",
                least ? HOLDS : FAILS,
                "Integrals over the whole run, cpa, optimal, rigid: %.2f, %.2f, %.2f m s with the "
                "leader fault, %.2f, %.2f, %.2f m s with the formation change. After the change "
                "itself they are %.2f, %.2f and %.2f: G2 as printed lies to G1 so that all three "
                "come to the same, and the difference is made while the robots first form up. A "
                "robot's error counts to the vertex that it holds at that moment, which favours "
                "those who choose the closest.",
                integral_of(&fault[CPA]), integral_of(&fault[OPTIMAL]), integral_of(&fault[RIGID]),
                integral_of(&change[CPA]), integral_of(&change[OPTIMAL]),
                integral_of(&change[RIGID]),
                history_error_integral(&change[CPA].history, changed),
                history_error_integral(&change[OPTIMAL].history, changed),
                history_error_integral(&change[RIGID].history, changed));
}

static void judge_paths(struct figure *figure, const struct run *fault, const struct run *change)
{
    bool least =
        is_least(path_of(&fault[CPA]), path_of(&fault[RIGID]), path_of(&fault[OPTIMAL])) &&
        is_least(path_of(&change[CPA]), path_of(&change[RIGID]), path_of(&change[OPTIMAL]));

    figure_find(figure, "It reduces the whole cost.", least ? HOLDS : FAILS,
                "Driven in all, cpa, optimal, rigid: %.1f, %.1f, %.1f m with the leader fault, %.1f, "
                "%.1f, %.1f m with the formation change. The optimum is that of the distances at "
                "the moment of assigning, not of what is then driven.",
                path_of(&fault[CPA]), path_of(&fault[OPTIMAL]), path_of(&fault[RIGID]),
                path_of(&change[CPA]), path_of(&change[OPTIMAL]), path_of(&change[RIGID]));
}

void figure_of_schemes(struct figure *figure, const struct runs *runs)
{
    struct table *table = figure_table(figure, "Three allocations", columns);

    show_means(figure, runs->fault, "leader fault", "leader lost");
    show_means(figure, runs->change, "formation change", "formation changes");
    for (int scheme = 0; scheme < SCHEME_COUNT; scheme++)
        tabulate_run(table, &runs->fault[scheme], "leader fault", scheme);
    for (int scheme = 0; scheme < SCHEME_COUNT; scheme++)
        tabulate_run(table, &runs->change[scheme], "formation change", scheme);
    judge_means(figure, runs->fault, runs->change);
    judge_paths(figure, runs->fault, runs->change);
}

/* ---- figure 11: a hundred -------------------------------------------------------------- */

#define NEAR_OPTIMAL 1.05 /* times the optimum's way */
#define FAR_BELOW 0.5     /* times the fixed ids' way */
#define NEAR_COMPLETE 97  /* vertices held at 60 s with a range of 1 m */

static const char *const reading_words[READING_COUNT] = {
    [AS_PRINTED] = "as printed",
    [V_ALONG] = "V, ids along",
    [V_MIRRORED] = "V, ids mirrored",
};

/* Cheaper than by fixed ids, at this range. */
static bool is_cheaper(const struct run *runs)
{
    return path_of(&runs[CPA]) < 0.99 * path_of(&runs[RIGID]);
}

static bool is_figure_11(const struct run *runs)
{
    return runs[CPA].summary.metrics.complete && leader_of(&runs[CPA]) == 50 &&
           path_of(&runs[CPA]) <= NEAR_OPTIMAL * path_of(&runs[OPTIMAL]) &&
           path_of(&runs[CPA]) <= FAR_BELOW * path_of(&runs[RIGID]);
}

static const char cheaper[] = "A hundred robots form up by CPA at less cost than by fixed ids.";

static void judge_hundred(struct figure *figure, const struct runs *runs)
{
    const struct run *printed = runs->hundred[AS_PRINTED][RANGE_3];
    const struct run *mirrored = runs->hundred[V_MIRRORED][RANGE_3];
    bool one = is_cheaper(printed) && is_cheaper(mirrored);
    bool none = !is_cheaper(printed) && !is_cheaper(mirrored);

    figure_find(figure, cheaper, one ? HOLDS : none ? FAILS : UNTOLD,
                "It depends on what the formation is. Cost of cpa at a range of 3 m, over that of "
                "fixed ids: %.2f as printed, %.2f in a V with the ids along, %.2f in a V with the "
                "ids mirrored. Only the last shows what the paper's figure shows, and print does "
                "not say that it is meant.",
                path_of(&printed[CPA]) / path_of(&printed[RIGID]),
                path_of(&runs->hundred[V_ALONG][RANGE_3][CPA]) /
                    path_of(&runs->hundred[V_ALONG][RANGE_3][RIGID]),
                path_of(&mirrored[CPA]) / path_of(&mirrored[RIGID]));
}

static void judge_as_printed(struct figure *figure, const struct run *runs)
{
    figure_find(figure, "As printed, L = 1.004 (i - 50) and psi = +-37 pi / 70: cheaper than fixed ids.",
                is_cheaper(runs) ? HOLDS : FAILS,
                "cpa drives %.0f m, fixed ids %.0f m, the optimum %.0f m. A negative L turns the arm "
                "of the smaller ids over, so all vertices lie on one side of the leader and half of "
                "the robots have to cross to it whoever takes which: fixed ids are within %.1f %% "
                "of the optimum, so there is next to nothing to gain. By CPA the robots that come "
                "later pass along a row of taken vertices; %zu of 99 are held at the end. The mean "
                "distance error is smaller all the same, %.0f against %.0f m s, for it counts to the "
                "vertex that is held at the moment.",
                path_of(&runs[CPA]), path_of(&runs[RIGID]), path_of(&runs[OPTIMAL]),
                100 * (path_of(&runs[RIGID]) / path_of(&runs[OPTIMAL]) - 1), held_by(&runs[CPA]),
                integral_of(&runs[CPA]), integral_of(&runs[RIGID]));
}

static void judge_v_along(struct figure *figure, const struct run *runs)
{
    figure_find(figure, "As a V with the ids running along: cheaper than fixed ids.",
                is_cheaper(runs) ? HOLDS : FAILS,
                "cpa drives %.0f m, fixed ids %.0f m, the optimum %.0f m: everyone's own vertex is "
                "also the closest one, and the three come to the same.",
                path_of(&runs[CPA]), path_of(&runs[RIGID]), path_of(&runs[OPTIMAL]));
}

static void judge_v_mirrored(struct figure *figure, const struct run *runs)
{
    figure_find(figure, "As a V with the ids mirrored: far cheaper than fixed ids and hardly dearer than "
                        "the optimum.",
                is_figure_11(runs) ? HOLDS : FAILS,
                "At a range of 3 m robot %u leads, the formation is %s, and cpa drives %.0f m: %.3f "
                "times the optimum's %.0f m and %.3f times the %.0f m of fixed ids, which send "
                "everyone over to the other side.",
                leader_of(&runs[CPA]), runs[CPA].summary.metrics.complete ? "complete" : "not complete",
                path_of(&runs[CPA]), path_of(&runs[CPA]) / path_of(&runs[OPTIMAL]),
                path_of(&runs[OPTIMAL]), path_of(&runs[CPA]) / path_of(&runs[RIGID]),
                path_of(&runs[RIGID]));
}

static void judge_short_range(struct figure *figure, const struct run *runs)
{
    size_t held = held_by(&runs[CPA]);

    figure_find(figure, "A range of 1 m is enough for it.", held == 99 ? HOLDS : FAILS,
                "%zu of 99 vertices are held at %.0f s (%d are asked for of this project). Neighbours "
                "in the V stand 1.004 m apart and do not hear each other, so a hole is filled only "
                "when somebody who holds nothing passes by.",
                held, history_time(runs[CPA].history.ticks - 1), NEAR_COMPLETE);
}

static void show_reading(struct figure *figure, const struct runs *runs, int reading)
{
    const struct run *near = runs->hundred[reading][RANGE_1];
    const struct run *far = runs->hundred[reading][RANGE_3];
    struct panel *panel = figure_panel(figure, draw_routes, &far[CPA],
                                       "%s: routes with cpa, range 3 m", reading_words[reading]);

    panel->wide = true;
    panel = figure_panel(figure, draw_mean_errors, &near[CPA], "%s: mean distance error",
                         reading_words[reading]);
    panel->word[0] = "cpa, 1 m";
    panel_add(panel, &far[CPA], "cpa, 3 m");
    panel_add(panel, &far[RIGID], "rigid");
    panel_add(panel, &far[OPTIMAL], "optimal");
}

void figure_of_hundred(struct figure *figure, const struct runs *runs)
{
    struct table *table = figure_table(figure, "A hundred robots, 11 candidates", columns);

    for (int reading = 0; reading < READING_COUNT; reading++)
        show_reading(figure, runs, reading);
    figure_panel(figure, draw_routes, &runs->hundred[V_MIRRORED][RANGE_3][RIGID],
                 "%s: routes with fixed ids", reading_words[V_MIRRORED]);
    for (int reading = 0; reading < READING_COUNT; reading++)
        for (int reach = 0; reach < REACH_COUNT; reach++)
            for (int scheme = 0; scheme < SCHEME_COUNT; scheme++)
                tabulate_run(table, &runs->hundred[reading][reach][scheme], reading_words[reading],
                             scheme);
    judge_hundred(figure, runs);
    judge_as_printed(figure, runs->hundred[AS_PRINTED][RANGE_3]);
    judge_v_along(figure, runs->hundred[V_ALONG][RANGE_3]);
    judge_v_mirrored(figure, runs->hundred[V_MIRRORED][RANGE_3]);
    judge_short_range(figure, runs->hundred[V_MIRRORED][RANGE_1]);
}
