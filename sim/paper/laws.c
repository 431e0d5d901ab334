#include "laws.h"

#include "figures.h"
#include "limits.h"
#include "message.h"

#include <math.h>
#include <string.h>

#define SHOWN 6 /* s; later the laws differ no more */
#define SCALE_FIRST 0.25
#define SCALE_LAST 16.0
#define SCALE_STEP 1.25
#define BISECTIONS 10 /* from a step of SCALE_STEP to less than a gain's last bit on the wire */

struct law_result law_result_of(const struct run *run)
{
    const struct history *history = &run->history;
    struct law_result result = {.path = run->summary.metrics.path_length};

    for (size_t tick = 0; tick < history->ticks; tick++) {
        const struct glimpse *g = history_at(history, tick, 0);
        double omega = g->omega;

        result.peak = fmax(result.peak, fabs(omega));
        result.turning += omega * omega / TICKS_PER_S;
        if ((double)g->error > LAW_SETTLED)
            result.settling =
                tick + 1 < history->ticks ? history_time(history, tick + 1) : INFINITY;
    }
    return result;
}

static void set_gains(struct run *run, double scale)
{
    run_set(run, "motion.k=%.4f", scale);
    run_set(run, "motion.k_theta=%.4f", 3 * scale);
}

/* A search for one law's gains. */
struct search {
    const struct run *task;
    const struct paper_options *options;
    const volatile bool *stop;
    char *error;
    size_t room;
    enum sim_end end;
};

static enum sim_end try_run(const struct search *search, struct run *run)
{
    if (!run_prepare(run, search->options, search->error, search->room))
        return SIM_REFUSED;
    return run_carry_out(run, search->options, NULL, search->stop, search->error, search->room);
}

/* When the law settles with its gains scaled; 0 when the search has to end. */
static double try_scale(struct search *search, double scale)
{
    struct run run = *search->task;

    run.native = true;
    strcpy(run.name, "gains");
    set_gains(&run, scale);
    search->end = try_run(search, &run);
    double settling = search->end == SIM_DONE ? law_result_of(&run).settling : 0;
    run_forget(&run);
    return settling;
}

/* The smallest scale that settles by `target`, found between two steps of a ladder. */
static double find_scale(struct search *search, double target)
{
    double high = SCALE_FIRST;

    while (high < SCALE_LAST && try_scale(search, high) > target)
        high *= SCALE_STEP;
    double low = high / SCALE_STEP;
    for (int i = 0; i < BISECTIONS && search->end == SIM_DONE; i++) {
        double middle = sqrt(low * high);

        if (try_scale(search, middle) > target)
            low = middle;
        else
            high = middle;
    }
    return high;
}

enum sim_end laws_match(struct runs *runs, const struct paper_options *options,
                        const volatile bool *stop, char *error, size_t room)
{
    struct search search = {&runs->law[STRAIGHT][LAW_FL], options, stop, error, room, SIM_DONE};
    double target = try_scale(&search, 1);

    for (int law = 0; law < LAW_COUNT && search.end == SIM_DONE; law++) {
        search.task = &runs->law[STRAIGHT][law];
        double scale = law == LAW_FL ? 1 : find_scale(&search, target);

        for (int task = 0; task < TASK_COUNT; task++)
            set_gains(&runs->law[task][law], scale);
    }
    return search.end;
}

/* ---- figure 1 -------------------------------------------------------------------------- */

static const char *const task_words[TASK_COUNT] = {
    [STRAIGHT] = "straight",
    [STRAIGHT_TURNED] = "straight, turned away",
    [CURVE] = "curve",
    [CURVE_TURNED] = "curve, turned away",
};

static void tabulate(struct figure *figure, const struct runs *runs)
{
    static const struct column columns[] = {
        {"task", "task"},
        {"law", "law"},
        {"k", "k (1/s)"},
        {"k_theta", "k_theta (1/s)"},
        {"settling_s", "settled (s)"},
        {"path_m", "path (m)"},
        {"omega_peak_rad_s", "peak |\u03c9| (rad/s)"},
        {"omega_squared_integral", "\u222b\u03c9\u00b2dt (rad\u00b2/s)"},
        {NULL, NULL},
    };
    struct table *table = figure_table(figure, "Three laws on the same tasks", columns);

    for (int task = 0; task < TASK_COUNT; task++) {
        for (int law = 0; law < LAW_COUNT; law++) {
            const struct run *run = &runs->law[task][law];
            struct law_result result = law_result_of(run);

            table_words(table, "%s", task_words[task]);
            table_words(table, "%s", law_words[law]);
            table_number(table, run->scenario->k, 2);
            table_number(table, run->scenario->k_theta, 2);
            if (isfinite(result.settling))
                table_number(table, result.settling, 2);
            else
                table_words(table, "never");
            table_number(table, result.path, 2);
            table_number(table, result.peak, 2);
            table_number(table, result.turning, 2);
        }
    }
}

/* A law's results, summed up over the tasks. */
struct law_total {
    int settled;
    double path, turning, error_last;
};

static struct law_total total_of(const struct runs *runs, int law)
{
    struct law_total total = {0};

    for (int task = 0; task < TASK_COUNT; task++) {
        struct law_result result = law_result_of(&runs->law[task][law]);

        total.settled += isfinite(result.settling);
        total.path += result.path;
        total.turning += result.turning;
        total.error_last = fmax(total.error_last, runs->law[task][law].summary.metrics.error_final);
    }
    return total;
}

static const char *least_turning(const struct law_total total[LAW_COUNT])
{
    int least = LAW_FL;

    for (int law = 0; law < LAW_COUNT; law++)
        if (total[law].turning < total[least].turning)
            least = law;
    return law_words[least];
}

/* Of those that settle in every task. */
static const char *shortest_way(const struct law_total total[LAW_COUNT])
{
    int least = LAW_FL;

    for (int law = 0; law < LAW_COUNT; law++)
        if (total[law].settled == TASK_COUNT && total[law].path < total[least].path)
            least = law;
    return law_words[least];
}

static void judge(struct figure *figure, const struct runs *runs)
{
    struct law_total total[LAW_COUNT];

    for (int law = 0; law < LAW_COUNT; law++)
        total[law] = total_of(runs, law);
    const struct law_total *fl = &total[LAW_FL];
    const struct law_total *kanayama = &total[LAW_KANAYAMA];
    const struct law_total *pid = &total[LAW_PID];

    figure_find(figure, "The feedback-linearising law suits the robots better than the usual ones.",
                UNTOLD,
                "The paper cites its law without printing it, and prints neither gains nor tasks "
                "of this comparison. As implemented here, over the four tasks: fl settles in %d "
                "of %d, drives %.2f m and turns for %.1f rad\u00b2/s; kanayama settles in %d, "
                "drives %.2f m and turns for %.1f; pid settles in %d, drives %.2f m and turns for "
                "%.1f. Least turning: %s. Shortest way of those that always settle: %s. pid knows "
                "nothing of the goal's motion and is up to %.3f m behind at the end.",
                fl->settled, TASK_COUNT, fl->path, fl->turning, kanayama->settled, kanayama->path,
                kanayama->turning, pid->settled, pid->path, pid->turning, least_turning(total),
                shortest_way(total), pid->error_last);
}

static void show_task(struct figure *figure, const struct runs *runs, enum task task,
                      panel_draw *draw, const char *what)
{
    struct panel *panel =
        figure_panel(figure, draw, &runs->law[task][LAW_FL], "%s: %s", task_words[task], what);

    panel->word[0] = law_words[LAW_FL];
    for (int law = LAW_FL + 1; law < LAW_COUNT; law++)
        panel_add(panel, &runs->law[task][law].history, law_words[law]);
    panel->until = SHOWN * TICKS_PER_S;
}

void figure_of_laws(struct figure *figure, const struct runs *runs)
{
    for (int task = 0; task < TASK_COUNT; task++) {
        show_task(figure, runs, task, draw_lone_routes, "routes");
        show_task(figure, runs, task, draw_angular_velocities, "angular velocity");
    }
    tabulate(figure, runs);
    judge(figure, runs);
}
