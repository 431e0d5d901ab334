#include "serve_state.h"

#include "adapters.h"
#include "limits.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <sys/utsname.h>

/* Fewer poses a second than this leave robots to guess for longer than a control tick. */
#define RATE_LEAST 30.0

/* Crystals differ by a hundredth of that; delays that vary show over a few seconds. */
#define CLOCK_ERROR_MAX 0.01

struct verdict {
    FILE *out;
    bool good;
};

static void blame(struct verdict *verdict, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static void blame(struct verdict *verdict, const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    fputs("  BAD   ", verdict->out);
    vfprintf(verdict->out, format, arguments);
    fputc('\n', verdict->out);
    va_end(arguments);
    verdict->good = false;
}

static void judge_answer(struct verdict *verdict, const struct serve *s, size_t i)
{
    const struct server_view *view = server_look(s->core, i);
    const struct link_view *link = links_look(s->links, i);
    unsigned id = s->scenario->robots[i].id;
    size_t largest = scenario_largest(s->scenario);

    if (link->state != LINK_UP)
        blame(verdict, "robot %u: %s: %s", id, link->address,
              link->words[0] == '\0' ? "no answer yet" : link->words);
    else if (view->stranger && view->id == 0)
        blame(verdict, "robot %u: %s answers, and has no id (`muster id' gives it one)", id,
              link->address);
    else if (view->stranger)
        blame(verdict, "robot %u: %s is robot %u", id, link->address, view->id);
    else if (view->version == 0)
        blame(verdict, "robot %u: %s is connected and silent: baud rate? firmware?", id,
              link->address);
    else if (view->version != PROTOCOL_VERSION)
        blame(verdict, "robot %u: speaks version %u of the protocol, this is version %d", id,
              view->version, PROTOCOL_VERSION);
    else if (view->vertices_max < largest)
        blame(verdict, "robot %u: holds %u vertices; the scenario has a formation of %zu", id,
              view->vertices_max, largest);
    else if (view->faults & (FAULT_REFUSED | FAULT_ESTOP))
        blame(verdict, "robot %u: %s", id,
              view->faults & FAULT_ESTOP ? "is in emergency stop: switch it off and on"
                                         : "cannot do this mission");
    else if (view->faults & FAULT_BATTERY)
        blame(verdict, "robot %u: its battery is empty (%.2f V): charge it, switch it off and on",
              id, view->battery / 1000.0);
    else if (!view->acknowledged)
        blame(verdict, "robot %u: has not acknowledged its mission (%.1f %% of frames lost)", id,
              100 * s->member[i].loss);
    else if (view->battery > 0 && view->battery < s->site->battery * 1000)
        blame(verdict, "robot %u: battery at %.2f V, less than %.2f V", id, view->battery / 1000.0,
              s->site->battery);
    else if (view->faults & WARN_BATTERY)
        blame(verdict, "robot %u: battery at %.2f V, less than its battery_warning", id,
              view->battery / 1000.0);
    else
        fprintf(verdict->out, "  good  robot %u: %s, battery %.2f V, %.0f B/s, %.1f %% lost\n", id,
                link->address, view->battery / 1000.0, s->member[i].rate, 100 * s->member[i].loss);
}

static void judge_body(struct verdict *verdict, const struct serve *s, size_t i)
{
    const struct tracker_view *seen = tracker_look(s->tracker, i);
    const struct tracker_body *body = &s->bodies[i];
    const char *name = body->name != NULL ? body->name : "its body";
    unsigned id = s->scenario->robots[i].id;
    double rate = (double)seen->frames / s->options->seconds;
    int64_t age_ms = (s->tick_us - seen->measured_us) / 1000;

    if (!seen->seen)
        blame(verdict, "robot %u: %s was never seen", id, name);
    else if (seen->jumped)
        blame(verdict, "robot %u: %s jumped by %.2f m", id, name, seen->jump);
    else if (age_ms > SERVER_POSE_OLD_MS)
        blame(verdict, "robot %u: %s was seen last %.1f s ago", id, name, (double)age_ms / 1000);
    else if (rate < RATE_LEAST)
        blame(verdict, "robot %u: %s is seen %.0f times a second; %.0f are wanted", id, name, rate,
              RATE_LEAST);
    else
        fprintf(verdict->out,
                "  good  robot %u: %s at (%.3f, %.3f) m, %.0f deg, %.0f times a second\n", id, name,
                seen->x, seen->y, seen->theta * 57.29577951308232, rate);
}

static void judge_places(struct verdict *verdict, struct serve *s)
{
    char words[ALARM_WORDS_MAX];

    if (tick_alarm(s, words))
        blame(verdict, "%s", words);
    if (!s->site->fenced)
        fputs("  note  there is no fence in the site file\n", verdict->out);
}

static bool has_radio(const struct serve *s)
{
    for (size_t i = 0; i < s->count; i++)
        if (s->link_settings[i].address.kind == LINK_RFCOMM)
            return true;
    return false;
}

static void judge_adapters(struct verdict *verdict, const struct serve *s)
{
    struct link_adapter adapters[LINK_ADAPTERS_MAX];
    size_t count = links_adapters(s->links, adapters);
    struct utsname kernel;

    fputs("adapters\n", verdict->out);
    for (size_t i = 0; i < count; i++) {
        const uint8_t *a = adapters[i].address;

        if (!adapters[i].up)
            blame(verdict, "hci%d is down: bluetoothctl power on, or hciconfig hci%d up",
                  adapters[i].number, adapters[i].number);
        else
            fprintf(verdict->out, "  good  hci%d, %02X:%02X:%02X:%02X:%02X:%02X: %zu robots\n",
                    adapters[i].number, a[0], a[1], a[2], a[3], a[4], a[5], adapters[i].robots);
    }
    const char *warning = uname(&kernel) == 0 ? adapters_warn(kernel.release) : NULL;
    if (warning != NULL)
        blame(verdict, "%s", warning);
}

static void judge_clock(struct verdict *verdict, const struct serve *s)
{
    double rate = tracker_clock_rate(s->tracker);

    if (isnan(rate))
        fputs("  note  the system tells no time: poses count from their arrival\n", verdict->out);
    else if (fabs(rate - 1) > CLOCK_ERROR_MAX)
        blame(verdict, "the system's clock goes %.1f %% off ours: is it a recording?",
              100 * (rate - 1));
    else
        fprintf(verdict->out, "  good  its clock keeps pace with ours, %+.2f %%\n",
                100 * (rate - 1));
}

bool verdict_print(struct serve *s, FILE *out)
{
    struct verdict verdict = {out, true};

    fprintf(out, "mocap\n  %s  %s\n", source_counts(s->source).frames > 0 ? "good" : "BAD ",
            source_words(s->source));
    verdict.good = source_counts(s->source).frames > 0;
    judge_clock(&verdict, s);
    for (size_t i = 0; tracker_stranger(s->tracker, i) != NULL; i++)
        fprintf(out, "  note  %s is tracked and no robot's\n", tracker_stranger(s->tracker, i));
    fputs("bodies\n", out);
    for (size_t i = 0; i < s->count; i++)
        judge_body(&verdict, s, i);
    judge_places(&verdict, s);
    if (has_radio(s))
        judge_adapters(&verdict, s);
    fputs("robots\n", out);
    for (size_t i = 0; i < s->count; i++)
        judge_answer(&verdict, s, i);
    fputs(verdict.good ? "All good.\n" : "Not ready.\n", out);
    return verdict.good;
}
