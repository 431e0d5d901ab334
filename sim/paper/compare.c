/* compare.c: figures that set the allocations beside one another. */
#include "figures.h"

#include <math.h>

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

/* The cells from "allocation" to "driven in all". */
static void tabulate_results(struct table *table, const struct run *run, int scheme)
{
    const struct metrics_result *m = &run->summary.metrics;

    table_words(table, "%s", scheme_words[scheme]);
    table_number(table, leader_of(run), 0);
    table_number(table, (double)held_by(run), 0);
    table_words(table, "%s", m->complete ? "yes" : "no");
    table_number(table, (double)m->switches, 0);
    table_number(table, m->error_integral, 2);
    table_number(table, path_of(run), path_of(run) < 1000 ? 1 : 0);
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
    panel_add(panel, &runs[RIGID].history, scheme_words[RIGID]);
    panel_add(panel, &runs[OPTIMAL].history, scheme_words[OPTIMAL]);
    panel_mark(panel, event_of(&runs[CPA]), event);
}

/* The three differ by less than a hundredth. */
static bool all_alike(double a, double b, double c)
{
    return fmax(a, fmax(b, c)) < 1.01 * fmin(a, fmin(b, c));
}

static double integral_after(const struct run *run)
{
    return history_error_integral(&run->history, event_of(run));
}

static void judge_means(struct figure *figure, const struct run *fault, const struct run *change)
{
    bool least = is_least(integral_of(&fault[CPA]), integral_of(&fault[RIGID]),
                          integral_of(&fault[OPTIMAL])) &&
                 is_least(integral_of(&change[CPA]), integral_of(&change[RIGID]),
                          integral_of(&change[OPTIMAL]));
    double cpa = integral_after(&change[CPA]);
    double rigid = integral_after(&change[RIGID]);
    double optimal = integral_after(&change[OPTIMAL]);

    figure_find(
        figure,
        "With CPA the mean distance error is smaller than with rigid and with optimal allocation.",
        least ? HOLDS : FAILS,
        "Its integrals, cpa, optimal, rigid: leader fault %.2f, %.2f, %.2f m s, of these %.2f, "
        "%.2f, %.2f after the loss; formation change %.2f, %.2f, %.2f m s, of these %.2f, %.2f, "
        "%.2f after the change.%s A robot's error counts to the vertex that it holds at the "
        "moment, which favours those who choose the closest.",
        integral_of(&fault[CPA]), integral_of(&fault[OPTIMAL]), integral_of(&fault[RIGID]),
        integral_after(&fault[CPA]), integral_after(&fault[OPTIMAL]), integral_after(&fault[RIGID]),
        integral_of(&change[CPA]), integral_of(&change[OPTIMAL]), integral_of(&change[RIGID]), cpa,
        optimal, rigid,
        all_alike(cpa, optimal, rigid)
            ? " The change itself costs all three the same, for G2 lies symmetric to G1; the "
              "difference is made while the robots first form up."
            : "");
}

static void judge_paths(struct figure *figure, const struct run *fault, const struct run *change)
{
    bool least =
        is_least(path_of(&fault[CPA]), path_of(&fault[RIGID]), path_of(&fault[OPTIMAL])) &&
        is_least(path_of(&change[CPA]), path_of(&change[RIGID]), path_of(&change[OPTIMAL]));

    figure_find(
        figure, "It reduces the whole cost.", least ? HOLDS : FAILS,
        "Driven in all, cpa, optimal, rigid: %.1f, %.1f, %.1f m with the leader fault, %.1f, "
        "%.1f, %.1f m with the formation change. The optimum is that of the distances at the "
        "moment of assigning, not of what is then driven.",
        path_of(&fault[CPA]), path_of(&fault[OPTIMAL]), path_of(&fault[RIGID]),
        path_of(&change[CPA]), path_of(&change[OPTIMAL]), path_of(&change[RIGID]));
}

static void tabulate_schemes(struct table *table, const struct run *runs, const char *scenario)
{
    for (int scheme = 0; scheme < SCHEME_COUNT; scheme++) {
        table_words(table, "%s", scenario);
        tabulate_results(table, &runs[scheme], scheme);
        table_number(table, integral_after(&runs[scheme]), 2);
    }
}

void figure_of_schemes(struct figure *figure, const struct runs *runs)
{
    static const struct column columns[] = {
        {"scenario", "scenario"},
        {"allocation", "allocation"},
        {"final_leader", "leader"},
        {"vertices_held", "held"},
        {"complete", "complete"},
        {"switches", "switches"},
        {"error_integral_m_s", "error integral (m s)"},
        {"path_m", "driven in all (m)"},
        {"error_integral_after_m_s", "error integral after the event"},
        {NULL, NULL},
    };
    struct table *table = figure_table(figure, "Three allocations", columns);

    show_means(figure, runs->fault, "leader fault", "leader lost");
    show_means(figure, runs->change, "formation change", "formation changes");
    tabulate_schemes(table, runs->fault, "leader fault");
    tabulate_schemes(table, runs->change, "formation change");
    judge_means(figure, runs->fault, runs->change);
    judge_paths(figure, runs->fault, runs->change);
}

/* ---- figure 11: a hundred -------------------------------------------------------------- */

#define NEAR_OPTIMAL 1.05 /* times the optimum's way */
#define FAR_BELOW 0.5     /* times the fixed ids' way */

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

/* Readings that disagree settle nothing. */
static enum verdict verdict_of_readings(bool one, bool other)
{
    if (one != other)
        return UNTOLD;
    return one ? HOLDS : FAILS;
}

static double cost_over_rigid(const struct run *runs)
{
    return path_of(&runs[CPA]) / path_of(&runs[RIGID]);
}

static void judge_hundred(struct figure *figure, const struct runs *runs)
{
    const struct run *printed = runs->hundred[AS_PRINTED][RANGE_3];
    const struct run *along = runs->hundred[V_ALONG][RANGE_3];
    const struct run *mirrored = runs->hundred[V_MIRRORED][RANGE_3];

    figure_find(figure, "A hundred robots form up by CPA at less cost than by fixed ids.",
                verdict_of_readings(is_cheaper(printed), is_cheaper(mirrored)),
                "It depends on what the formation is. Cost of cpa at a range of 3 m, over that of "
                "fixed ids: %.2f as printed, %.2f in a V with the ids along, %.2f in a V with the "
                "ids mirrored. Only the last shows what the paper's figure shows, and print does "
                "not say that it is meant.",
                cost_over_rigid(printed), cost_over_rigid(along), cost_over_rigid(mirrored));
}

static void judge_as_printed(struct figure *figure, const struct run *runs)
{
    figure_find(
        figure, "As printed, L = 1.004 (i - 50) and psi = +-37 pi / 70: cheaper than fixed ids.",
        is_cheaper(runs) ? HOLDS : FAILS,
        "cpa drives %.0f m, fixed ids %.0f m, the optimum %.0f m. A negative L turns the arm of "
        "the smaller ids over, so all vertices lie on one side of the leader and half of the "
        "robots have to cross to it whoever takes which: fixed ids are within %.1f %% of the "
        "optimum, so there is next to nothing to gain. By CPA the robots that come later pass "
        "along a row of taken vertices; %zu of 99 are held at the end. The mean distance error is "
        "smaller all the same, %.0f against %.0f m s, for it counts to the vertex that is held at "
        "the moment.",
        path_of(&runs[CPA]), path_of(&runs[RIGID]), path_of(&runs[OPTIMAL]),
        100 * (path_of(&runs[RIGID]) / path_of(&runs[OPTIMAL]) - 1), held_by(&runs[CPA]),
        integral_of(&runs[CPA]), integral_of(&runs[RIGID]));
}

static void judge_v_along(struct figure *figure, const struct run *runs)
{
    figure_find(figure, "As a V with the ids running along: cheaper than fixed ids.",
                is_cheaper(runs) ? HOLDS : FAILS,
                "cpa drives %.0f m, fixed ids %.0f m, the optimum %.0f m: everyone's own vertex "
                "is also the closest one, and the three come to the same.",
                path_of(&runs[CPA]), path_of(&runs[RIGID]), path_of(&runs[OPTIMAL]));
}

static void judge_v_mirrored(struct figure *figure, const struct run *runs)
{
    figure_find(
        figure,
        "As a V with the ids mirrored: far cheaper than fixed ids and hardly dearer than the "
        "optimum.",
        is_figure_11(runs) ? HOLDS : FAILS,
        "At a range of 3 m robot %u leads, the formation is %s, and cpa drives %.0f m: %.3f times "
        "the optimum's %.0f m and %.3f times the %.0f m of fixed ids, which send everyone over to "
        "the other side.",
        leader_of(&runs[CPA]), runs[CPA].summary.metrics.complete ? "complete" : "not complete",
        path_of(&runs[CPA]), path_of(&runs[CPA]) / path_of(&runs[OPTIMAL]), path_of(&runs[OPTIMAL]),
        path_of(&runs[CPA]) / path_of(&runs[RIGID]), path_of(&runs[RIGID]));
}

static void judge_short_range(struct figure *figure, const struct run *runs)
{
    size_t held = held_by(&runs[CPA]);

    figure_find(
        figure, "The same V is complete with a range of 1 m, as in the simulations of four robots.",
        held == 99 ? HOLDS : FAILS,
        "%zu of 99 vertices are held at %.0f s. Neighbours in the V stand 1.004 m apart and do "
        "not hear each other, so a hole closes only when a robot that has lost its own comes past.",
        held, history_time(&runs[CPA].history, runs[CPA].history.ticks - 1));
}

static void show_routes(struct figure *figure, const struct run *run, int reading, const char *how)
{
    figure_panel(figure, draw_routes, run, "%s: routes with %s", reading_words[reading], how)
        ->wide = true;
}

static void show_reading(struct figure *figure, const struct runs *runs, int reading)
{
    const struct run *near = runs->hundred[reading][RANGE_1];
    const struct run *far = runs->hundred[reading][RANGE_3];
    struct panel *panel = figure_panel(figure, draw_mean_errors, &near[CPA],
                                       "%s: mean distance error", reading_words[reading]);

    panel->word[0] = "cpa, 1 m";
    panel_add(panel, &far[CPA].history, "cpa, 3 m");
    panel_add(panel, &far[RIGID].history, "rigid");
    panel_add(panel, &far[OPTIMAL].history, "optimal");
}

static void tabulate_reading(struct table *table, const struct runs *runs, int reading)
{
    for (int reach = 0; reach < REACH_COUNT; reach++) {
        for (int scheme = 0; scheme < SCHEME_COUNT; scheme++) {
            const struct run *run = &runs->hundred[reading][reach][scheme];

            table_words(table, "%s", reading_words[reading]);
            table_number(table, run->scenario->range, 0);
            tabulate_results(table, run, scheme);
        }
    }
}

void figure_of_hundred(struct figure *figure, const struct runs *runs)
{
    static const struct column columns[] = {
        {"formation", "formation"},      {"range_m", "range (m)"},
        {"allocation", "allocation"},    {"final_leader", "leader"},
        {"vertices_held", "held"},       {"complete", "complete"},
        {"switches", "switches"},        {"error_integral_m_s", "error integral (m s)"},
        {"path_m", "driven in all (m)"}, {NULL, NULL},
    };
    struct table *table = figure_table(figure, "A hundred robots, 11 candidates", columns);

    for (int reading = 0; reading < READING_COUNT; reading++)
        show_routes(figure, &runs->hundred[reading][RANGE_3][CPA], reading, "cpa, range 3 m");
    show_routes(figure, &runs->hundred[V_MIRRORED][RANGE_3][RIGID], V_MIRRORED, "fixed ids");
    for (int reading = 0; reading < READING_COUNT; reading++) {
        show_reading(figure, runs, reading);
        tabulate_reading(table, runs, reading);
    }
    judge_hundred(figure, runs);
    judge_as_printed(figure, runs->hundred[AS_PRINTED][RANGE_3]);
    judge_v_along(figure, runs->hundred[V_ALONG][RANGE_3]);
    judge_v_mirrored(figure, runs->hundred[V_MIRRORED][RANGE_3]);
    judge_short_range(figure, runs->hundred[V_MIRRORED][RANGE_1]);
}
