#include "serve_state.h"

#include "limits.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* What can be written without growing: a table that is too long ends early. */
struct page {
    char *text;
    size_t room, used;
};

static void put(struct page *page, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void put(struct page *page, const char *format, ...)
{
    size_t left = page->room - page->used;
    va_list arguments;

    va_start(arguments, format);
    int length = vsnprintf(page->text + page->used, left, format, arguments);
    va_end(arguments);
    if (length > 0)
        page->used += (size_t)length < left ? (size_t)length : left - 1;
}

static int64_t pose_age_ms(const struct serve *s, size_t i)
{
    const struct tracker_view *seen = tracker_look(s->tracker, i);

    return seen->seen ? (loop_now() - seen->measured_us) / 1000 : -1;
}

/* What a person should know of a robot before all else; "" when nothing. */
static const char *trouble(const struct serve *s, size_t i)
{
    const struct server_view *view = server_look(s->core, i);
    const struct link_view *link = links_look(s->links, i);
    const struct tracker_view *seen = tracker_look(s->tracker, i);

    if (link->state != LINK_UP)
        return link->words[0] != '\0' ? link->words : "dialling";
    if (view->stranger)
        return view->id == 0 ? "has no id" : "another robot answers";
    if (view->halted)
        return "halted";
    if (view->version == 0)
        return "has not answered yet";
    if (view->faults & FAULT_ESTOP)
        return "emergency stop";
    if (view->faults & FAULT_REFUSED)
        return "cannot do this mission";
    if (view->faults & FAULT_BATTERY)
        return view->state == STATE_SPENT ? "battery empty: it stands"
                                          : "battery empty: hands over";
    if (!seen->seen)
        return "body never seen";
    if (seen->jumped)
        return "body jumped: back, or key b";
    if (pose_age_ms(s, i) > SERVER_POSE_OLD_MS)
        return "body lost";
    if (view->faults & FAULT_STALL)
        return "stalled";
    if (s->member[i].warned)
        return "battery low";
    return view->acknowledged ? "" : "is told its mission";
}

const char *table_phase(const struct serve *s)
{
    if (s->estopped)
        return "EMERGENCY STOP";
    switch (s->phase) {
    case PHASE_GATHER: return s->options->what == SERVE_CHECK ? "checking" : "gathering";
    case PHASE_RUN: return "running";
    case PHASE_STOP: return "stopping";
    case PHASE_OVER: break;
    }
    return "over";
}

static void put_robot(struct page *page, const struct serve *s, size_t i)
{
    const struct server_view *view = server_look(s->core, i);
    int64_t age = pose_age_ms(s, i);
    char role = view->role == ROLE_LEADER ? 'L' : view->role == ROLE_CANDIDATE ? 'C' : 'F';

    put(page, "%6u  %c  %6u  ", s->scenario->robots[i].id, view->linked ? role : '-', view->vertex);
    if (age < 0)
        put(page, "%8s", "never");
    else if (age < 10000)
        put(page, "%5d ms", (int)age);
    else
        put(page, "%6d s", (int)(age / 1000));
    put(page, "  %6.0f B/s  %5.1f %%  ", s->member[i].rate, 100 * s->member[i].loss);
    if (view->battery > 0)
        put(page, "%5.2f V", view->battery / 1000.0);
    else
        put(page, "%7s", "");
    put(page, "  %.40s\n", trouble(s, i));
}

static void put_head(struct page *page, const struct serve *s)
{
    struct source_count count = source_counts(s->source);

    put(page, "%s: %s, t = %.1f of %g s; %s\n", s->scenario->name, table_phase(s),
        server_time(s->core) < 0 ? 0 : server_time(s->core) / 1000.0, s->scenario->duration,
        source_words(s->source));
    put(page, "pose to bytes %.0f us, 99 of 100 within %.0f us; %llu poses skipped\n",
        histogram_at(&s->delay, 0.5), histogram_at(&s->delay, 0.99),
        (unsigned long long)count.skipped);
    put(page, " robot  role vertex  pose age       link   loss  battery\n");
}

/* Robots in trouble first, where not all fit. */
static void put_robots(struct page *page, const struct serve *s, unsigned lines)
{
    bool all = s->count <= lines;
    size_t shown = 0;

    for (int pass = all ? 1 : 0; pass < 2; pass++) {
        for (size_t i = 0; i < s->count && shown < lines; i++) {
            bool troubled = trouble(s, i)[0] != '\0';

            if (!all && troubled == (pass == 1))
                continue;
            put_robot(page, s, i);
            shown++;
        }
    }
    if (shown < s->count)
        put(page, "        and %zu more\n", s->count - shown);
}

/* A line that wraps would count twice. */
static size_t cut_lines(char *text, size_t length, unsigned columns)
{
    size_t kept = 0, column = 0;

    for (size_t i = 0; i < length; i++) {
        column = text[i] == '\n' ? 0 : column + 1;
        if (column < columns)
            text[kept++] = text[i];
    }
    return kept;
}

void table_draw(struct serve *s)
{
    struct page page = {s->table, s->table_room, 0};
    unsigned lines = console_lines();

    put_head(&page, s);
    put_robots(&page, s, lines > 8 ? lines - 6 : 2);
    put(&page, s->phase == PHASE_GATHER && s->options->what == SERVE_RUN
                   ? "Enter: begin with those that are ready   e: emergency stop   q: leave\n"
                   : "e: emergency stop   b: believe bodies that jumped   q: stop and leave\n");
    console_table(&s->console, s->table, cut_lines(s->table, page.used, console_columns()));
}

void table_line(struct serve *s)
{
    char words[200];
    size_t ready = 0;

    if (s->options->quiet)
        return;
    for (size_t i = 0; i < s->count; i++)
        ready += serve_is_ready(s, i);
    table_missing(s, words, sizeof words);
    console_say(&s->console, "%s, t = %.1f s: %zu of %zu robots ready; %s%s%s", table_phase(s),
                server_time(s->core) < 0 ? 0 : server_time(s->core) / 1000.0, ready, s->count,
                source_words(s->source), words[0] == '\0' ? "" : "; missing: ", words);
}

void table_missing(const struct serve *s, char *words, size_t room)
{
    struct page page = {words, room, 0};

    words[0] = '\0';
    for (size_t i = 0; i < s->count; i++) {
        if (serve_is_ready(s, i))
            continue;
        const char *why = trouble(s, i);
        put(&page, "%srobot %u (%s)", page.used == 0 ? "" : ", ", s->scenario->robots[i].id,
            why[0] == '\0' ? "body not tracked" : why);
    }
}
