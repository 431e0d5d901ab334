#include "source_state.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/timerfd.h>
#include <time.h>
#include <unistd.h>

#define FRAMES_MAX 256   /* told in one go, where the file's are closer than that */
#define PAUSE_MAX_S 3600 /* between two frames; a longer one is cut */
#define AGAIN_US 10000   /* from the last frame to the first one of the next round */

static bool read_more(struct source *source)
{
    ssize_t count = read(source->replay.file, source->stream + source->waiting,
                         sizeof source->stream - source->waiting);

    if (count > 0)
        source->waiting += (size_t)count;
    return count > 0;
}

/* Decodes up to the next frame, into the blank one. With nothing more to read, the protocol is
 * given 0 bytes, for the frame whose end it could not know. */
static enum capture_news next_frame(struct source *source, char words[CAPTURE_WORDS_MAX])
{
    const struct capture_protocol *protocol = source->settings->protocol;
    struct capture_frame *blank = newest_blank(&source->newest);
    bool more = true;

    for (;;) {
        size_t used = 0;
        enum capture_news news = protocol->take(source->session, source->stream,
                                                more ? source->waiting : 0, &used, blank, words);
        source->waiting -= used;
        memmove(source->stream, source->stream + used, source->waiting);
        if (news != CAPTURE_NOTHING && news != CAPTURE_TOLD)
            return news;
        if (!more)
            return CAPTURE_NOTHING;
        if (used == 0)
            more = read_more(source);
    }
}

static void rewind_file(struct source *source)
{
    lseek(source->replay.file, 0, SEEK_SET);
    source->waiting = 0;
    source->numbered = false;
    source->settings->protocol->begin(source->session, &source->settings->options);
}

static int64_t due_at(struct source *source, int64_t earliest_us)
{
    struct replay *replay = &source->replay;
    double time = newest_blank(&source->newest)->time;

    if (!replay->begun || isnan(time)) {
        replay->begun = true;
        replay->first_s = isnan(time) ? 0 : time;
        replay->first_us = earliest_us;
        return earliest_us;
    }
    double pause = time - replay->first_s - (double)(replay->due_us - replay->first_us) / 1e6;
    if (pause > PAUSE_MAX_S || pause < 0) { /* the pace counts from here on */
        replay->first_s = time;
        replay->first_us = replay->due_us + (pause < 0 ? 0 : PAUSE_MAX_S * INT64_C(1000000));
        return replay->first_us;
    }
    return replay->first_us + (int64_t)((time - replay->first_s) * 1e6);
}

static void end(struct source *source, enum capture_news news, const char *words)
{
    loop_forget(source->loop, &source->timer.watch);
    standing_set(source, STANDING_ENDED, loop_now());
    if (news == CAPTURE_BROKEN || news == CAPTURE_REFUSED) {
        source->broken++;
        standing_complain(source, "%s: %s", source->settings->file, words);
    } else if (source->frames == 0) {
        standing_complain(source, "%s: no poses are in it", source->settings->file);
    } else {
        standing_say(source, "%s has come to its end", source->settings->file);
    }
}

/* Gets the next frame ready, of the next round where it is to be repeated. */
static void prepare(struct source *source, int64_t now_us)
{
    struct replay *replay = &source->replay;
    char words[CAPTURE_WORDS_MAX] = "";
    enum capture_news news = next_frame(source, words);
    int64_t earliest_us = now_us;

    if (news == CAPTURE_NOTHING && source->settings->repeat && replay->begun) {
        rewind_file(source);
        replay->begun = false;
        earliest_us = replay->due_us + AGAIN_US;
        news = next_frame(source, words);
    }
    replay->pending = news == CAPTURE_FRAME;
    if (replay->pending) {
        replay->due_us = due_at(source, earliest_us);
        return;
    }
    intake_flush(source);
    end(source, news, words);
}

static void set_timer(struct source *source)
{
    int64_t due_us = source->replay.due_us;
    struct itimerspec when = {
        .it_value = {due_us / 1000000, due_us % 1000000 * 1000},
    };

    if (source->replay.pending)
        timerfd_settime(source->timer.watch.fd, TFD_TIMER_ABSTIME, &when, NULL);
}

static void timer_ready(struct watch *watch, uint32_t events)
{
    struct source *source = ((struct channel *)watch)->source;
    struct replay *replay = &source->replay;
    int64_t now_us = loop_now();

    (void)events;
    loop_periods(watch->fd);
    for (int i = 0; i < FRAMES_MAX && replay->pending && replay->due_us <= now_us; i++) {
        intake_frame(source, replay->due_us);
        prepare(source, now_us);
    }
    intake_flush(source);
    set_timer(source);
}

bool replay_open(struct source *source, char *error, size_t room)
{
    struct replay *replay = &source->replay;
    struct channel *timer = &source->timer;

    replay->file = open(source->settings->file, O_RDONLY | O_CLOEXEC);
    if (replay->file < 0) {
        snprintf(error, room, "%s: %s", source->settings->file, strerror(errno));
        return false;
    }
    timer->watch.fd = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);
    timer->watch.ready = timer_ready;
    if (timer->watch.fd < 0 || !loop_watch(source->loop, &timer->watch, EPOLLIN)) {
        snprintf(error, room, "no timer: %s", strerror(errno));
        return false;
    }
    source->settings->protocol->begin(source->session, &source->settings->options);
    prepare(source, loop_now());
    set_timer(source);
    return true;
}

void replay_close(struct source *source)
{
    if (source->replay.file >= 0)
        close(source->replay.file);
    source->replay.file = -1;
}
