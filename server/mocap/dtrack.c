/* ART's DTrack, by UDP in lines of text; usually to port 5000.
 *
 * `fr` is the frame's number, `ts` its time in s since midnight (UTC), `ts2` since 1970 in s and us
 * with the latency in us, `6d` the bodies that are tracked: their number, then for each
 * [id quality][x y z and three angles][matrix], in mm, the matrix column by column (DTrack2 user
 * manual, B.2.3; DTrackParser.cpp of github.com/ar-tracking/DTrackSDK). Ids count from 0. Bodies
 * have no names. What other lines say is of no concern. */
#include "capture.h"
#include "decimal.h"
#include "rotation.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define UNIT 0.001

struct session {
    bool warned; /* that there are no bodies in the output */
};

/* What is left of a line. */
struct line {
    const char *at, *end;
};

static void begin(void *memory, const struct capture_options *options)
{
    (void)options;
    memset(memory, 0, sizeof(struct session));
}

static void skip_spaces(struct line *line)
{
    while (line->at < line->end && *line->at == ' ')
        line->at++;
}

/* The next word, up to a space or a bracket; 0 when there is none. */
static size_t word(struct line *line, const char **text)
{
    skip_spaces(line);
    *text = line->at;
    while (line->at < line->end && strchr(" []", *line->at) == NULL)
        line->at++;
    return (size_t)(line->at - *text);
}

static bool read_number(struct line *line, double *value)
{
    const char *text;
    size_t length = word(line, &text);

    return decimal_read(text, length, value);
}

static bool read_whole(struct line *line, int64_t high, int64_t *value)
{
    const char *text;
    size_t length = word(line, &text);

    return decimal_read_whole(text, length, 0, high, value);
}

static bool read_bracket(struct line *line, char bracket)
{
    skip_spaces(line);
    if (line->at == line->end || *line->at != bracket)
        return false;
    line->at++;
    return true;
}

/* Numbers in brackets, as many as `value` is to have. */
static bool read_block(struct line *line, double *value, size_t count)
{
    bool good = read_bracket(line, '[');

    for (size_t i = 0; i < count; i++)
        good = good && read_number(line, &value[i]);
    return good && read_bracket(line, ']');
}

static bool read_body(struct line *line, struct capture_body *body)
{
    double place[6], columns[9], quality;
    int64_t id;
    bool good = read_bracket(line, '[') && read_whole(line, INT32_MAX, &id) &&
                read_number(line, &quality) && read_bracket(line, ']') &&
                read_block(line, place, 6) && read_block(line, columns, 9);

    if (!good)
        return false;
    body->name[0] = '\0';
    body->id = (int32_t)id;
    for (int i = 0; i < 3; i++)
        body->at[i] = UNIT * place[i];
    body->tracked = rotation_of_columns(columns, body->turn) && quality > 0;
    return true;
}

static bool read_bodies(struct line *line, struct capture_frame *frame)
{
    int64_t count;

    if (!read_whole(line, CAPTURE_BODIES_MAX, &count))
        return false;
    frame->count = (size_t)count;
    for (size_t i = 0; i < frame->count; i++)
        if (!read_body(line, &frame->body[i]))
            return false;
    skip_spaces(line);
    return line->at == line->end;
}

static bool read_frame_number(struct line *line, struct capture_frame *frame)
{
    int64_t number;

    if (!read_whole(line, UINT32_MAX, &number))
        return false;
    frame->numbered = true;
    frame->number = (uint32_t)number;
    return true;
}

static bool read_long_time(struct line *line, struct capture_frame *frame)
{
    int64_t seconds, microseconds, latency;

    if (!read_whole(line, UINT32_MAX, &seconds) || !read_whole(line, 999999, &microseconds) ||
        !read_whole(line, UINT32_MAX, &latency))
        return false;
    frame->time = (double)seconds + (double)microseconds / 1e6;
    frame->latency = (double)latency / 1e6;
    return true;
}

static bool read_time(struct line *line, struct capture_frame *frame)
{
    double time;

    if (!read_number(line, &time))
        return false;
    frame->time = time < 0 ? NAN : time; /* -1: the controller's clock is not set */
    return true;
}

static bool is(const char *text, size_t length, const char *wanted)
{
    return length == strlen(wanted) && memcmp(text, wanted, length) == 0;
}

static bool read_line(struct line line, struct capture_frame *frame, bool *bodies)
{
    const char *key;
    size_t length = word(&line, &key);

    if (is(key, length, "fr"))
        return read_frame_number(&line, frame);
    if (is(key, length, "ts"))
        return read_time(&line, frame);
    if (is(key, length, "ts2"))
        return read_long_time(&line, frame);
    if (!is(key, length, "6d"))
        return true;
    *bodies = true;
    return read_bodies(&line, frame);
}

/* The datagram's end: a NUL ends it too. */
static const char *end_of(const char *text, size_t count)
{
    const char *end = memchr(text, '\0', count);

    return end != NULL ? end : text + count;
}

static enum capture_news broken(unsigned number, char words[CAPTURE_WORDS_MAX])
{
    snprintf(words, CAPTURE_WORDS_MAX, "line %u of a datagram is no output of DTrack's", number);
    return CAPTURE_BROKEN;
}

static enum capture_news no_bodies(struct session *session, char words[CAPTURE_WORDS_MAX])
{
    if (session->warned)
        return CAPTURE_NOTHING;
    session->warned = true;
    snprintf(words, CAPTURE_WORDS_MAX,
             "DTrack sends no bodies: switch on `6d' in the settings of its output");
    return CAPTURE_TOLD;
}

static enum capture_news take(void *memory, const uint8_t *bytes, size_t count, size_t *used,
                              struct capture_frame *frame, char words[CAPTURE_WORDS_MAX])
{
    const char *at = (const char *)bytes;
    const char *end = count > 0 ? end_of(at, count) : at;
    bool bodies = false;

    *used = count;
    frame->numbered = false;
    frame->number = 0;
    frame->time = NAN;
    frame->latency = 0;
    frame->count = 0;
    for (unsigned number = 1; at < end; number++) {
        const char *stop = memchr(at, '\n', (size_t)(end - at));
        const char *next = stop != NULL ? stop + 1 : end;
        struct line line = {at, stop != NULL ? stop : end};

        if (line.end > line.at && line.end[-1] == '\r')
            line.end--;
        if (!read_line(line, frame, &bodies))
            return broken(number, words);
        at = next;
    }
    if (!frame->numbered)
        return broken(1, words);
    return bodies ? CAPTURE_FRAME : no_bodies(memory, words);
}

const struct capture_protocol dtrack_protocol = {
    .name = "dtrack",
    .stream = false,
    .port = 5000,
    .unit = UNIT,
    .session_bytes = sizeof(struct session),
    .begin = begin,
    .take = take,
    .ask = NULL,
};
