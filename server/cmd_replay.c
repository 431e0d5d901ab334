#include "arguments.h"
#include "commands.h"
#include "interrupt.h"
#include "progress.h"
#include "tape.h"
#include "topic.h"
#include "view.h"

#include <argp.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>

#define NS_PER_MS INT64_C(1000000)
#define END_STAYS_MS 1000
#define LOOK_MS 500 /* after so long at most it looks whether it is to end */

/* What the command line says. */
struct request {
    const char *run;
    struct view_options view;
};

struct replay {
    const char *run;
    const volatile bool *stop;
    struct view *view;
    size_t scenes;
    int32_t end_ms;
};

enum {
    KEY_VIEW = 256,
};

static const struct argp_option option_table[] = {
    {"view", KEY_VIEW, "WHERE", OPTION_ARG_OPTIONAL,
     "Have the page at [ADDRESS:]PORT, 127.0.0.1:8765 unless given", 0},
    {0},
};

static const char description[] =
    "Show the recording of a run in the page that `--view' shows runs in."
    "\v"
    "RUN is a run's folder, or an MCAP file, also one that was cut short. The page plays it at any "
    "speed, back and forth; Foxglove and its kind, at the same port, get it in real time, again "
    "and "
    "again. It stays until Ctrl-C.\n\n"
    "Exit status: 0 it was ended so, 1 the page could not be had, 2 wrong usage, or what is no "
    "recording.";

static error_t parse_option(int key, char *value, struct argp_state *state)
{
    struct request *request = state->input;

    switch (key) {
    case KEY_VIEW: argument_view(state, value, &request->view); break;
    case ARGP_KEY_ARG:
        if (request->run != NULL)
            argp_error(state, "%s: one run at a time", value);
        request->run = value;
        break;
    case ARGP_KEY_NO_ARGS: argp_error(state, "which run?"); break;
    default: return ARGP_ERR_UNKNOWN;
    }
    return 0;
}

static bool is_of(const struct tape_message *message, enum topic topic)
{
    return strcmp(message->topic, topic_kinds[topic].name) == 0;
}

static bool is_scene(const struct tape_message *message)
{
    size_t robots, vertices;

    return is_of(message, TOPIC_FLEET) &&
           scene_counts(message->bytes, message->count, &robots, &vertices);
}

static void show_event(struct view *view, const struct tape_message *message)
{
    struct scene_event event;
    char words[SCENE_EVENT_MAX];

    if (scene_event_read(&event, words, message->bytes, message->count))
        view_event(view, event.time_ms, message->bytes, message->count);
}

/* Gives the page all there is. */
static void show_all(struct replay *replay, struct tape *tape)
{
    struct tape_message message;

    while (!*replay->stop && tape_next(tape, &message)) {
        if (is_of(&message, TOPIC_EVENTS))
            show_event(replay->view, &message);
        if (!is_scene(&message))
            continue;
        view_scene(replay->view, message.time_ms, message.bytes, message.count);
        replay->scenes++;
        replay->end_ms = message.time_ms;
    }
}

static void wait_until(const struct replay *replay, int64_t due_ns)
{
    int64_t left_ns;

    while (!*replay->stop && (left_ns = due_ns - wall_ns()) > 0)
        poll(NULL, 0, left_ns < LOOK_MS * NS_PER_MS ? (int)(left_ns / NS_PER_MS) + 1 : LOOK_MS);
}

/* Plays it once to Foxglove's viewers, and leaves them a look at its end. */
static bool play(const struct replay *replay)
{
    struct tape_message message;
    char error[256];
    struct tape *tape = tape_open(replay->run, error, sizeof error);
    int64_t begun_ns = wall_ns();

    if (tape == NULL)
        return false;
    while (!*replay->stop && tape_next(tape, &message)) {
        if (!is_scene(&message))
            continue;
        wait_until(replay, begun_ns + message.time_ms * NS_PER_MS);
        view_play(replay->view, message.bytes, message.count);
    }
    tape_close(tape);
    wait_until(replay, begun_ns + (replay->end_ms + END_STAYS_MS) * NS_PER_MS);
    return true;
}

static void stay(const struct replay *replay)
{
    while (!*replay->stop && replay->end_ms > 0 && play(replay))
        continue;
    while (!*replay->stop)
        poll(NULL, 0, LOOK_MS);
}

static void show_status(const struct replay *replay, bool all)
{
    view_status(replay->view, &(struct view_status){
                                  .phase = all ? "recorded" : "loading",
                                  .over = all,
                                  .speed = 1,
                              });
}

static int show(struct replay *replay, struct tape *tape)
{
    fprintf(stderr, "view: %s\n", view_url(replay->view));
    show_status(replay, false);
    show_all(replay, tape);
    if (replay->scenes == 0 && !*replay->stop) {
        fprintf(stderr, "muster replay: nothing was recorded in %s\n", replay->run);
        return STATUS_USAGE;
    }
    show_status(replay, true);
    if (!tape_about(tape)->whole)
        fprintf(stderr,
                "muster replay: %s was cut short, at t = %.2f s; `muster recover' makes it whole\n",
                replay->run, replay->end_ms / 1000.0);
    stay(replay);
    return STATUS_DONE;
}

static int show_in_view(const struct request *request, struct tape *tape)
{
    const struct tape_about *about = tape_about(tape);
    struct view_about view = {
        .kind = "replay",
        .title = about->scenario[0] != '\0' ? about->scenario : "recording",
        .duration = about->duration,
    };
    struct replay replay = {.run = request->run, .stop = interrupt_catch()};
    char error[256];

    replay.view = view_open(&request->view, &view, error, sizeof error);
    if (replay.view == NULL) {
        fprintf(stderr, "muster replay: %s\n", error);
        return STATUS_FAILED;
    }
    int status = show(&replay, tape);
    view_close(replay.view);
    return status;
}

int cmd_replay(int argc, char **argv)
{
    static const struct argp argp = {option_table, parse_option, "RUN", description,
                                     NULL,         NULL,         NULL};
    struct request request = {0};
    char error[512];

    argp_parse(&argp, argc, argv, 0, NULL, &request);
    struct tape *tape = tape_open(request.run, error, sizeof error);
    if (tape == NULL) {
        fprintf(stderr, "muster replay: %s\n", error);
        return STATUS_USAGE;
    }
    int status = show_in_view(&request, tape);
    tape_close(tape);
    return status;
}
