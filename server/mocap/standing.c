#include "source_state.h"

#include <arpa/inet.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define PATIENCE_US 2000000 /* for a first frame, or answer, before it is complained of */
#define RATE_US 1000000     /* over which frames are counted for the rate */

__attribute__((format(printf, 3, 0))) static void say(struct source *source, bool problem,
                                                      const char *format, va_list arguments)
{
    char line[SOURCE_WORDS_MAX];
    size_t name = strlen(source->settings->protocol->name) + 2;

    snprintf(line, sizeof line, "%s: ", source->settings->protocol->name);
    vsnprintf(line + name, sizeof line - name, format, arguments);
    if (problem && strcmp(source->said, line) == 0)
        return;
    if (problem)
        snprintf(source->said, sizeof source->said, "%s", line);
    snprintf(source->words, sizeof source->words, "%s", line);
    source->owner->say(source->owner->context, problem, line);
}

void standing_say(struct source *source, const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    say(source, false, format, arguments);
    va_end(arguments);
}

void standing_complain(struct source *source, const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    say(source, true, format, arguments);
    va_end(arguments);
}

void standing_set(struct source *source, enum standing standing, int64_t now_us)
{
    source->standing = standing;
    source->standing_us = now_us;
    source->complained = false;
}

/* ", joined 239.255.42.99 on 10.0.0.2", or nothing where no group is. */
static const char *joined(const struct source *source, char words[SOURCE_WORDS_MAX])
{
    char group[SOCKET_WORDS_MAX], ours[SOCKET_WORDS_MAX];
    struct sockaddr_in interface = {.sin_family = AF_INET, .sin_addr = source->interface.address};
    bool known = interface.sin_addr.s_addr != INADDR_ANY;

    words[0] = '\0';
    if (source->group.sin_family != 0)
        snprintf(words, SOURCE_WORDS_MAX, ", joined %s on %s", socket_words(&source->group, group),
                 known ? socket_words(&interface, ours) : "the default interface");
    return words;
}

static double seconds(int64_t us)
{
    return (double)us / 1e6;
}

void standing_frame(struct source *source, int64_t now_us)
{
    char group[SOURCE_WORDS_MAX];

    source->frame_us = now_us;
    source->amiss[0] = '\0';
    source->stranger.sin_family = 0;
    if (source->standing == STANDING_FLOWING)
        return;
    if (source->standing == STANDING_SILENT)
        standing_say(source, "frames come again, after %.1f s",
                     seconds(now_us - source->standing_us));
    else
        standing_say(source, "first frame after %.1f s%s", seconds(now_us - source->opened_us),
                     joined(source, group));
    source->backoff_us = 0;
    source->said[0] = '\0';
    source->rate_us = now_us;
    source->rate_frames = source->frames + source->newest.skipped;
    source->rate = 0;
    standing_set(source, STANDING_FLOWING, now_us);
}

static void complain_of_no_answer(struct source *source)
{
    char system[SOCKET_WORDS_MAX];

    if (source->kind == SOURCE_ASKED)
        standing_complain(source,
                          "%s does not answer: is it that address, is its streaming on, does a "
                          "firewall hold UDP back?",
                          socket_words(&source->system, system));
    else if (source->kind == SOURCE_LISTENED)
        standing_complain(source,
                          "nothing has come to UDP port %u: is the system's streaming on, and to "
                          "this machine, does a firewall hold it back?",
                          ntohs(source->group.sin_port));
}

static bool streams_otherwise(struct source *source, const struct natnet_streaming *streaming)
{
    bool unicast = source->settings->options.unicast;
    struct in_addr group;

    memcpy(&group, streaming->group, sizeof group);
    if (!streaming->told)
        return false;
    if (unicast && streaming->multicast) {
        standing_complain(source,
                          "no frames: the system streams to a multicast group, and is asked "
                          "for unicast; one of the two has to change");
        return true;
    }
    if (!unicast && !streaming->multicast) {
        standing_complain(source, "no frames: the system streams unicast, and a multicast group is "
                                  "listened to; one of the two has to change");
        return true;
    }
    if (unicast || group.s_addr == source->group.sin_addr.s_addr)
        return false;
    standing_complain(source, "no frames: the system streams to group %s", inet_ntoa(group));
    return true;
}

/* The likeliest reason first. */
static void complain_of_no_frames(struct source *source)
{
    struct natnet_streaming streaming = {.told = false};
    char words[SOURCE_WORDS_MAX], strange[SOCKET_WORDS_MAX], system[SOCKET_WORDS_MAX];

    if (source->amiss[0] != '\0') {
        standing_complain(source, "no frames: what comes is not understood: %s", source->amiss);
        return;
    }
    if (source->stranger.sin_family != 0) {
        source->stranger.sin_port = 0;
        standing_complain(source, "no frames from %s, but datagrams from %s",
                          socket_words(&source->system, system),
                          socket_words(&source->stranger, strange));
        return;
    }
    if (source->settings->protocol == &natnet_protocol && source->kind == SOURCE_ASKED)
        streaming = natnet_streaming(source->session);
    if (streams_otherwise(source, &streaming))
        return;
    if (source->group.sin_addr.s_addr != INADDR_ANY)
        standing_complain(source,
                          "no frames%s: is that the interface to the cameras' network, is the "
                          "streaming of rigid bodies on, does a firewall hold UDP back?",
                          joined(source, words));
    else
        standing_complain(source, "connected, but no frames: is the streaming of rigid bodies on, "
                                  "does a firewall hold UDP back?");
}

static void count_rate(struct source *source, int64_t now_us)
{
    uint64_t frames = source->frames + source->newest.skipped;
    char system[SOCKET_WORDS_MAX] = "";
    int64_t past_us = now_us - source->rate_us;

    if (past_us < RATE_US)
        return;
    source->rate = (double)(frames - source->rate_frames) / seconds(past_us);
    source->rate_frames = frames;
    source->rate_us = now_us;
    if (source->system.sin_family != 0)
        socket_words(&source->system, system);
    snprintf(source->words, sizeof source->words, "%s%s%s%s%s, %.0f Hz",
             source->settings->protocol->name, system[0] != '\0' ? " from " : "", system,
             source->told[0] != '\0' ? ", " : "", source->told, source->rate);
}

static void judge_flow(struct source *source, int64_t now_us)
{
    count_rate(source, now_us);
    if (now_us - source->frame_us < SOURCE_SILENCE_US || source->kind == SOURCE_FILE)
        return;
    standing_set(source, STANDING_SILENT, source->frame_us);
    if (source->amiss[0] != '\0')
        standing_complain(source, "no frames for %.0f s; what comes is not understood: %s",
                          seconds(SOURCE_SILENCE_US), source->amiss);
    else
        standing_complain(source, "no frames for %.0f s", seconds(SOURCE_SILENCE_US));
}

void standing_judge(struct source *source, int64_t now_us)
{
    bool patient = source->complained || now_us - source->standing_us < PATIENCE_US;

    if (source->standing == STANDING_FLOWING)
        judge_flow(source, now_us);
    else if (source->standing == STANDING_SILENT && source->kind != SOURCE_STREAM && !patient)
        complain_of_no_frames(source);
    else if (source->standing == STANDING_ANSWERED && !patient)
        complain_of_no_frames(source);
    else if (source->standing == STANDING_NOTHING && !patient && source->amiss[0] != '\0')
        complain_of_no_frames(source);
    else if (source->standing == STANDING_NOTHING && !patient && source->said[0] == '\0')
        complain_of_no_answer(source);
    source->complained = source->complained || !patient;
}
