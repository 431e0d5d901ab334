#include "serve_state.h"

#include <stdio.h>
#include <sys/epoll.h>

void acts_tell(struct serve *s)
{
    struct view_status status = {
        .phase = table_phase(s),
        .over = s->phase == PHASE_OVER,
        .speed = 1,
    };

    if (s->options->view != NULL)
        onlookers_status(s->options->view, &s->steer, status);
}

/* What the core cannot do by itself, or not in good order. */
static bool do_other(struct serve *s, const struct act *act, char words[STEER_WORDS_MAX])
{
    const char *refusal = NULL;

    if (act->kind == ACT_ESTOP)
        serve_estop(s);
    else if (act->kind == ACT_END)
        serve_leave(s, "one who looks on");
    else if (act->kind == ACT_BEGIN)
        refusal = serve_begin(s);
    else
        refusal = "real robots have no such act";
    if (refusal != NULL)
        snprintf(words, STEER_WORDS_MAX, "%s", refusal);
    return refusal == NULL;
}

static bool carry_out(struct serve *s, const struct act *act, char words[STEER_WORDS_MAX])
{
    bool own = act->kind == ACT_ESTOP || act->kind == ACT_DRAIN;

    /* Robots that have been stopped are not to be set off again. */
    if (s->phase >= PHASE_STOP && act->kind != ACT_ESTOP) {
        snprintf(words, STEER_WORDS_MAX, "the run is over");
        return false;
    }
    enum steer_end end = own ? STEER_OTHER : steer(&s->steer, act, words);
    if (end == STEER_OTHER)
        return do_other(s, act, words);
    if (end == STEER_DONE && act->kind == ACT_DRAW)
        record_note(s->record, server_time(s->core), 0, "draw", act->name);
    return end == STEER_DONE;
}

static void on_acts(struct watch *watch, uint32_t events)
{
    struct serve *s = (struct serve *)((char *)watch - offsetof(struct serve, acts));
    struct act act;
    char words[STEER_WORDS_MAX];

    (void)events;
    while (view_next_act(s->options->view, &act)) {
        bool done = carry_out(s, &act, words);

        tick_drain(s);
        view_answer(s->options->view, &act, done ? NULL : words);
    }
    acts_tell(s);
}

bool acts_watch(struct serve *s)
{
    s->acts = (struct watch){.fd = view_descriptor(s->options->view), .ready = on_acts};
    acts_tell(s);
    return loop_watch(&s->loop, &s->acts, EPOLLIN);
}
