#include "poses.h"
#include "decimal.h"
#include "rotation.h"

#include <math.h>
#include <string.h>

#define LINE_LENGTH_MAX 512
#define FIELDS 11

struct session {
    unsigned line; /* lines read */
    double time;   /* of the frame that is being read */
    size_t count;
    struct capture_body body[CAPTURE_BODIES_MAX];
};

/* A line's field; a quoted one without its quotes, its double quotes still double. */
struct field {
    const char *text;
    size_t length;
    bool quoted;
};

static void begin(void *memory, const struct capture_options *options)
{
    struct session *session = memory;

    (void)options;
    session->line = 0;
    session->time = 0;
    session->count = 0;
}

/* Takes a field off the line; false where its quotes do not match. */
static bool split_field(const char **at, const char *end, struct field *field)
{
    const char *stop = *at;

    field->quoted = stop < end && *stop == '"';
    field->text = stop + field->quoted;
    if (field->quoted) {
        for (stop++; stop < end && (*stop != '"' || (stop + 1 < end && stop[1] == '"')); stop++)
            stop += *stop == '"';
        if (stop >= end)
            return false;
    } else {
        while (stop < end && *stop != ',' && *stop != '"')
            stop++;
    }
    field->length = (size_t)(stop - field->text);
    *at = stop + field->quoted;
    return *at == end || **at == ',';
}

/* What is wrong with the line's form, or NULL. */
static const char *split(const char *at, const char *end, struct field fields[FIELDS])
{
    for (int i = 0; i < FIELDS; i++) {
        if (!split_field(&at, end, &fields[i]))
            return "quotes that do not match";
        bool last = i == FIELDS - 1;
        if (last != (at == end))
            return "11 fields are allowed: " POSES_HEADER;
        at += !last;
    }
    return NULL;
}

static bool read_name(const struct field *field, char name[CAPTURE_NAME_MAX])
{
    size_t length = 0;

    for (size_t i = 0; i < field->length; i++) {
        if ((unsigned char)field->text[i] < ' ' || length == CAPTURE_NAME_MAX - 1)
            return false;
        name[length++] = field->text[i];
        i += field->quoted && field->text[i] == '"';
    }
    name[length] = '\0';
    return true;
}

static bool read_id(const struct field *field, int32_t *id)
{
    int64_t value = CAPTURE_ID_NONE;
    bool good = field->length == 0 || decimal_read_whole(field->text, field->length,
                                                         CAPTURE_ID_NONE + 1, INT32_MAX, &value);

    *id = (int32_t)value;
    return good;
}

static const char *read_body(const struct field fields[FIELDS], struct capture_body *body)
{
    double value[7];

    if (!read_name(&fields[1], body->name))
        return "body: a name of at most 63 bytes is allowed";
    if (!read_id(&fields[2], &body->id))
        return "id: a whole number is allowed, or nothing";
    for (int i = 0; i < 7; i++)
        if (!decimal_read(fields[3 + i].text, fields[3 + i].length, &value[i]))
            return "x to qw: decimal numbers are allowed";

    const struct field *tracked = &fields[10];
    if (tracked->length != 1 || (tracked->text[0] != '0' && tracked->text[0] != '1'))
        return "tracked: 0 or 1 is allowed";
    body->tracked = tracked->text[0] == '1';
    memcpy(body->at, value, sizeof body->at);
    memcpy(body->turn, value + 3, sizeof body->turn);
    if (body->tracked && !rotation_of_quaternion(value + 3, body->turn))
        return "qx to qw: a unit quaternion is allowed";
    return NULL;
}

static enum capture_news finish(struct session *session, struct capture_frame *frame)
{
    if (session->count == 0)
        return CAPTURE_NOTHING;
    frame->numbered = false;
    frame->number = 0;
    frame->time = session->time;
    frame->latency = 0;
    frame->count = session->count;
    memcpy(frame->body, session->body, session->count * sizeof frame->body[0]);
    session->count = 0;
    return CAPTURE_FRAME;
}

/* NULL when the line is good. `next` is set, and the line left, when it begins another frame. */
static const char *read_line(struct session *session, const char *at, const char *end, bool *next)
{
    struct field fields[FIELDS];
    double time;
    const char *wrong;

    if (session->line == 0)
        return (size_t)(end - at) == strlen(POSES_HEADER) &&
                       memcmp(at, POSES_HEADER, strlen(POSES_HEADER)) == 0
                   ? NULL
                   : "the first line has to be " POSES_HEADER;
    if ((wrong = split(at, end, fields)) != NULL)
        return wrong;
    if (!decimal_read(fields[0].text, fields[0].length, &time) || time < session->time)
        return "t: a number of seconds is allowed, no less than in the line before";
    *next = session->count > 0 && time != session->time;
    if (*next)
        return NULL;
    if (session->count == CAPTURE_BODIES_MAX)
        return "more than 512 bodies at one time";
    session->time = time;
    wrong = read_body(fields, &session->body[session->count]);
    session->count += wrong == NULL;
    return wrong;
}

static enum capture_news broken(const struct session *session, const char *wrong,
                                char words[CAPTURE_WORDS_MAX])
{
    snprintf(words, CAPTURE_WORDS_MAX, "line %u: %s", session->line + 1, wrong);
    return CAPTURE_BROKEN;
}

static enum capture_news take(void *memory, const uint8_t *bytes, size_t count, size_t *used,
                              struct capture_frame *frame, char words[CAPTURE_WORDS_MAX])
{
    struct session *session = memory;

    *used = 0;
    if (count == 0)
        return finish(session, frame);
    while (*used < count) {
        const char *at = (const char *)bytes + *used;
        const char *stop = memchr(at, '\n', count - *used);
        bool next = false;

        if ((stop != NULL ? (size_t)(stop - at) : count - *used) > LINE_LENGTH_MAX)
            return broken(session, "it is too long", words);
        if (stop == NULL)
            return CAPTURE_NOTHING;
        const char *end = stop > at && stop[-1] == '\r' ? stop - 1 : stop;
        const char *wrong = read_line(session, at, end, &next);
        if (wrong != NULL)
            return broken(session, wrong, words);
        if (next)
            return finish(session, frame);
        session->line++;
        *used += (size_t)(stop + 1 - at);
    }
    return CAPTURE_NOTHING;
}

const struct capture_protocol poses_protocol = {
    .name = "poses",
    .stream = true,
    .port = 0,
    .unit = 1,
    .session_bytes = sizeof(struct session),
    .begin = begin,
    .take = take,
    .ask = NULL,
};

void poses_write_header(FILE *out)
{
    fputs(POSES_HEADER "\n", out);
}

static void write_name(FILE *out, const char *name)
{
    bool quoted = strpbrk(name, ",\"") != NULL;

    if (quoted)
        fputc('"', out);
    for (; *name != '\0'; name++) {
        if (*name == '"')
            fputc('"', out);
        fputc((unsigned char)*name < ' ' ? '_' : *name, out);
    }
    if (quoted)
        fputc('"', out);
}

/* A body that is lost may have any numbers; nan could not be read again. */
static void write_numbers(FILE *out, const double *value, int count)
{
    for (int i = 0; i < count; i++)
        fprintf(out, ",%.9g", isfinite(value[i]) ? value[i] : 0);
}

void poses_write_frame(FILE *out, int64_t t_us, const struct capture_frame *frame)
{
    for (size_t i = 0; i < frame->count; i++) {
        const struct capture_body *body = &frame->body[i];

        fprintf(out, "%.6f,", (double)t_us / 1e6);
        write_name(out, body->name);
        if (body->id == CAPTURE_ID_NONE)
            fputc(',', out);
        else
            fprintf(out, ",%ld", (long)body->id);
        write_numbers(out, body->at, 3);
        write_numbers(out, body->turn, 4);
        fprintf(out, ",%d\n", body->tracked);
    }
}

int64_t poses_clock_next(struct poses_clock *clock, const struct capture_frame *frame,
                         int64_t arrival_us)
{
    int64_t step_us = arrival_us - clock->arrival_us;
    double step = frame->time - clock->time;

    /* Never so where one of the times is none. */
    if (step >= 0 && fabs(step - (double)step_us / 1e6) <= 1)
        step_us = llround(step * 1e6);
    if (clock->begun)
        clock->t_us += step_us > 1 ? step_us : 1;
    clock->begun = true;
    clock->time = frame->time;
    clock->arrival_us = arrival_us;
    return clock->t_us;
}
