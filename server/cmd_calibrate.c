#include "arguments.h"
#include "by_hand.h"
#include "calibrate_fleet.h"
#include "calibration.h"
#include "commands.h"
#include "console.h"
#include "interrupt.h"
#include "parameter_file.h"
#include "places.h"
#include "scenario.h"
#include "selection.h"
#include "session.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* What a site's robots are taken for where it does not say: the scenarios' `body: small`. */
#define TRACK 0.08
#define WHEEL_MAX 0.6

/* A body that lies otherwise on its robot than this is told of, rad and m. */
#define HEADING_TOLD 0.035
#define ORIGIN_TOLD 0.01

/* What the command line says. */
struct request {
    struct selection selection;
    struct calibrate_fleet_options sim;
    const char *out;
    bool in_sim, by_hand, together, dry_run;
};

enum {
    KEY_SIM = 256,
    KEY_NATIVE,
    KEY_FIRMWARE,
    KEY_SEED,
    KEY_THREADS,
    KEY_OUT,
    KEY_BY_HAND,
    KEY_TOGETHER,
    KEY_DRY_RUN,
};

static const struct argp_option option_table[] = {
    {"together", KEY_TOGETHER, NULL, 0,
     "Robots that are 1.2 m or more apart drive at the same time; else they do so one by one", 0},
    {"dry-run", KEY_DRY_RUN, NULL, 0,
     "Save nothing, and leave the robots with the parameters that they had", 0},
    {"out", KEY_OUT, "FILE", 0, "Write what was measured to a parameter file", 0},
    {"by-hand", KEY_BY_HAND, NULL, 0,
     "Without motion capture: drive one robot, and trim its wheels, key by key", 0},
    {"sim", KEY_SIM, NULL, 0,
     "The file is a scenario: calibrate its robots in virtual time; needs --out", 0},
    {"native", KEY_NATIVE, NULL, 0,
     "With --sim: the brain in this program in place of simulated ATmega128", 0},
    {"firmware", KEY_FIRMWARE, "ELF", 0,
     "With --sim: the robots' image, unless the one with muster", 0},
    {"seed", KEY_SEED, "N", 0, "With --sim: which run of the chances this is (default 1)", 0},
    {"threads", KEY_THREADS, "N", 0,
     "With --sim: N threads instead of one per processor; the results are the same", 0},
    SELECTION_OPTIONS,
    {0},
};

static const char description[] =
    "Measure robots' wheels by motion capture, and give the robots their parameters."
    "\v"
    "Each robot drives for some 30 s within 0.5 m of where it stands: there and back, on the spot, "
    "on one wheel, then a line and an arc by its old and by its new parameters. These are saved in "
    "its EEPROM. With --sim the same is done with a scenario's robots; `muster sim --parameters' "
    "takes the file.\n\n"
    "Keys of --by-hand: arrows or space drive for 1 s; l and r make the left and the right wheel "
    "stronger; + and - change the dead bands; s saves; q leaves.\n\n"
    "Exit status: 0 done with every robot, 1 some failed (it is told which, and why), 2 wrong "
    "usage or a file that is refused.";

/* ---- the command line ------------------------------------------------------------------ */

static void judge(struct argp_state *state)
{
    const struct request *request = state->input;
    bool of_site = request->by_hand || request->together || request->dry_run ||
                   request->selection.robots != NULL;

    if (request->selection.path == NULL)
        argp_error(state, "which site?");
    if (request->in_sim && of_site)
        argp_error(state, "--robots, --together, --dry-run and --by-hand go with a site");
    if (request->in_sim && request->out == NULL)
        argp_error(state, "--sim needs --out FILE");
    if (request->by_hand && request->out != NULL)
        argp_error(state, "--by-hand goes without --out; `muster param get --out' writes the file");
}

static error_t parse_option(int key, char *value, struct argp_state *state)
{
    struct request *request = state->input;
    struct calibrate_fleet_options *sim = &request->sim;

    switch (key) {
    case KEY_SIM: request->in_sim = true; break;
    case KEY_NATIVE: sim->robots = SIM_NATIVE; break;
    case KEY_FIRMWARE: sim->firmware = value; break;
    case KEY_SEED: sim->seed = argument_number(state, "--seed", value, 0, UINT64_MAX); break;
    case KEY_THREADS:
        sim->threads = (unsigned)argument_number(state, "--threads", value, 1, THREADS_MAX);
        break;
    case KEY_OUT: request->out = value; break;
    case KEY_BY_HAND: request->by_hand = true; break;
    case KEY_TOGETHER: request->together = true; break;
    case KEY_DRY_RUN: request->dry_run = true; break;
    case ARGP_KEY_ARG:
        if (request->selection.path != NULL)
            argp_error(state, "%s: one file at a time", value);
        request->selection.path = value;
        break;
    case ARGP_KEY_END: judge(state); break;
    default: return selection_option(&request->selection, key, value);
    }
    return 0;
}

/* ---- what came out --------------------------------------------------------------------- */

static void print_row(const struct calibration *c)
{
    const struct calibration_result *result = &c->result;
    double value[CALIBRATION_PARAMETERS];

    for (uint8_t i = 0; i < CALIBRATION_PARAMETERS; i++)
        value[i] = parameter_of((uint8_t)(CALIBRATION_FIRST + i), result->value[i]);
    printf("%5u  %6.4f  %6.4f  %6.4f  %6.4f  %8.4f  %6.3f  %6.3f  %5.3f\n", c->job.robot, value[0],
           value[1], value[2], value[3], value[4], value[5], result->before, result->after);
}

static void print_table(const struct calibration *calibrations, size_t count)
{
    bool headed = false;

    for (size_t i = 0; i < count; i++) {
        if (calibrations[i].job.state != JOB_DONE)
            continue;
        if (!headed)
            printf("            gain          dead band                       error, m\n"
                   "robot    left   right    left   right  track, m  lag, s  before  after\n");
        headed = true;
        print_row(&calibrations[i]);
    }
}

/* How the body in motion capture lies on the robot, where that is worth a look. */
static void print_bodies(const struct calibration *calibrations, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const struct calibration *c = &calibrations[i];
        const struct wheel_fit *fit = &c->result.fit;

        if (c->job.state != JOB_DONE)
            continue;
        if (fabs(fit->heading) > HEADING_TOLD)
            printf("robot %u: its body's heading is %.1f degrees to the left of the robot's: "
                   "subtract %.3f from `heading' in the site\n",
                   c->job.robot, fit->heading * 180 / M_PI, fit->heading);
        if (hypot(fit->ahead, fit->aside) > ORIGIN_TOLD)
            printf("robot %u: its body's origin lies %.3f m before and %.3f m left of the middle "
                   "between the wheels\n",
                   c->job.robot, fit->ahead, fit->aside);
    }
}

static bool write_file(const char *path, const struct calibration *calibrations, size_t count)
{
    struct parameter_entry *entries = calloc(count, sizeof *entries);
    char error[512] = "not enough memory";
    bool good =
        entries != NULL &&
        parameter_file_write(path, entries, calibration_entries(calibrations, count, entries),
                             error, sizeof error);

    free(entries);
    if (!good)
        fprintf(stderr, "muster calibrate: %s\n", error);
    return good;
}

static int tell(const struct request *request, const struct calibration *calibrations, size_t count,
                int status)
{
    print_table(calibrations, count);
    print_bodies(calibrations, count);
    if (request->out != NULL && !write_file(request->out, calibrations, count))
        return STATUS_FAILED;
    return status;
}

static int tell_end(enum session_end end, const char *error)
{
    if (end == SESSION_FAILED)
        fprintf(stderr, "muster calibrate: %s\n", error);
    else if (end == SESSION_INTERRUPTED)
        fprintf(stderr, "muster calibrate: interrupted\n");
    return end == SESSION_DONE ? STATUS_DONE : STATUS_FAILED;
}

/* ---- in virtual time ------------------------------------------------------------------- */

static int tell_simulated(const struct request *request, const struct calibration *calibrations,
                          size_t count)
{
    int status = STATUS_DONE;

    for (size_t i = 0; i < count; i++) {
        const struct job *job = &calibrations[i].job;

        if (job->state == JOB_DONE)
            continue;
        fprintf(stderr, "robot %u: %s\n", job->robot, job->words);
        status = STATUS_FAILED;
    }
    return tell(request, calibrations, count, status);
}

static int simulate(struct request *request, const struct scenario *scenario)
{
    size_t count = scenario->robot_count;
    struct calibration *calibrations = calloc(count, sizeof *calibrations);
    char error[512] = "";
    int status = STATUS_FAILED;

    if (calibrations == NULL) {
        fprintf(stderr, "muster calibrate: not enough memory\n");
        return STATUS_FAILED;
    }
    request->sim.quiet = request->selection.quiet;
    switch (calibrate_fleet(scenario, &request->sim, interrupt_catch(), calibrations, error,
                            sizeof error)) {
    case SIM_DONE: status = tell_simulated(request, calibrations, count); break;
    case SIM_INTERRUPTED: fprintf(stderr, "muster calibrate: interrupted\n"); break;
    case SIM_REFUSED: status = STATUS_USAGE; /* fall through */
    case SIM_FAILED: fprintf(stderr, "muster calibrate: %s\n", error); break;
    }
    free(calibrations);
    return status;
}

static int work_in_sim(struct request *request)
{
    const struct selection *selection = &request->selection;
    char error[1024];

    if (!argument_firmware_exists("calibrate", request->sim.robots, request->sim.firmware))
        return STATUS_USAGE;
    struct scenario *scenario =
        scenario_read(selection->path, selection->settings, selection->setting_count, VERTICES_MAX,
                      error, sizeof error);
    if (scenario == NULL) {
        fprintf(stderr, "%s\n", error);
        return STATUS_USAGE;
    }
    int status = simulate(request, scenario);
    scenario_free(scenario);
    return status;
}

/* ---- by motion capture ----------------------------------------------------------------- */

struct fleet {
    struct turns turns;
    struct calibration *calibrations;
    size_t count;
};

static void on_seen(void *context, size_t robot, const struct job_pose *pose)
{
    struct fleet *fleet = context;

    turns_see(&fleet->turns, robot, pose->x, pose->y);
}

static void on_stop(void *context, const char *words, int64_t now_us)
{
    struct fleet *fleet = context;

    for (size_t i = 0; i < fleet->count; i++)
        calibration_stop(&fleet->calibrations[i], words, now_us);
}

static double or_else(double value, double otherwise)
{
    return isnan(value) ? otherwise : value;
}

static int measure(const struct request *request, struct fleet *fleet, struct job **jobs)
{
    const struct selection *selection = &request->selection;
    const struct site *site = selection->site;
    const struct calibration_settings settings = {
        .wheels = {or_else(site->track, TRACK), or_else(site->wheel_max, WHEEL_MAX)},
        .save = !request->dry_run,
    };
    const struct session_options options = {
        .poses = true,
        .patience = SESSION_PATIENCE_S,
        .quiet = selection->quiet,
        .watcher = {.context = fleet, .seen = on_seen, .stop = on_stop},
    };
    char error[512] = "";

    for (size_t i = 0; i < site->robot_count; i++)
        fleet->turns.place[i].id = site->robots[i].id;
    for (size_t i = 0; i < fleet->count; i++) {
        size_t place = selection->chosen[i];

        calibration_begin(&fleet->calibrations[i], site->robots[place].id, &settings, &fleet->turns,
                          place);
        jobs[i] = &fleet->calibrations[i].job;
    }
    enum session_end end =
        session_run(site, selection->chosen, jobs, fleet->count, &options, error, sizeof error);
    return tell(request, fleet->calibrations, fleet->count, tell_end(end, error));
}

static int work_at_site(struct request *request)
{
    const struct site *site = request->selection.site;
    size_t count = request->selection.count;
    struct fleet fleet = {
        .turns =
            {
                .together = request->together,
                .fenced = site->fenced,
                .fence = {site->fence[0], site->fence[1], site->fence[2], site->fence[3]},
                .count = site->robot_count,
                .place = calloc(site->robot_count, sizeof *fleet.turns.place),
            },
        .calibrations = calloc(count, sizeof *fleet.calibrations),
        .count = count,
    };
    struct job **jobs = calloc(count, sizeof *jobs);
    int status = STATUS_FAILED;

    if (fleet.turns.place == NULL || fleet.calibrations == NULL || jobs == NULL)
        fprintf(stderr, "muster calibrate: not enough memory\n");
    else
        status = measure(request, &fleet, jobs);
    free(jobs);
    free(fleet.calibrations);
    free(fleet.turns.place);
    return status;
}

/* ---- by hand --------------------------------------------------------------------------- */

static void print_line(const char *words)
{
    fprintf(stderr, "%s\n", words);
}

/* An arrow comes as three bytes, ESC [ A and so on. */
static int next_key(void)
{
    static const int arrows[] = {BY_HAND_FORWARD, BY_HAND_BACK, BY_HAND_RIGHT, BY_HAND_LEFT};
    int key = console_key();

    if (key != '\033' || console_key() != '[')
        return key;
    key = console_key();
    return key >= 'A' && key <= 'D' ? arrows[key - 'A'] : key;
}

static bool on_typed(void *context, int64_t now_us)
{
    int key = next_key();

    if (key > 0)
        by_hand_press(context, key, now_us);
    else if (key < 0)
        by_hand_press(context, 'q', now_us);
    return key >= 0;
}

static int work_by_hand(const struct request *request)
{
    const struct selection *selection = &request->selection;
    struct by_hand hand;
    struct console console;
    struct job *job = &hand.job;
    const struct session_options options = {
        .patience = SESSION_PATIENCE_S,
        .quiet = true, /* lines of ours in place of bars */
        .watcher = {.context = &hand, .typed = on_typed},
    };
    char error[512] = "";

    if (selection->count != 1) {
        fprintf(stderr, "muster calibrate: one robot at a time by hand: --robots ID\n");
        return STATUS_USAGE;
    }
    by_hand_begin(&hand, selection->site->robots[selection->chosen[0]].id, print_line);
    console_open(&console, true);
    enum session_end end =
        session_run(selection->site, selection->chosen, &job, 1, &options, error, sizeof error);
    console_close(&console);
    if (end == SESSION_DONE)
        print_line(job->words);
    return tell_end(end, error);
}

/* ---- the command ----------------------------------------------------------------------- */

int cmd_calibrate(int argc, char **argv)
{
    static const struct argp argp = {option_table, parse_option, "SITE.yaml", description,
                                     NULL,         NULL,         NULL};
    char firmware[PLACE_MAX];
    struct request request = {
        .sim =
            {
                .robots = SIM_AVR,
                .firmware = place_firmware(firmware),
                .seed = 1,
                .threads = argument_threads_default(),
            },
    };
    int status = STATUS_USAGE;

    if (!selection_begin(&request.selection, "calibrate", argc))
        return STATUS_FAILED;
    argp_parse(&argp, argc, argv, 0, NULL, &request);
    if (request.in_sim)
        status = work_in_sim(&request);
    else if (selection_open(&request.selection, "calibrate"))
        status = request.by_hand ? work_by_hand(&request) : work_at_site(&request);
    selection_end(&request.selection);
    return status;
}
