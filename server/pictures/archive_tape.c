/* archive_tape.c: run.mcap, of which the scenes and the events are all that is needed. */
#include "archive_files.h"

#include "tape.h"
#include "topic.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TICKS_FIRST 1024
#define SAME 1e-3 /* m: a vertex that is no farther off is where it was */

struct reader {
    struct archive *archive;
    struct scene_robot *robots;
    struct scene_point *vertices;
    size_t vertex_room;
    const char *trouble; /* why no more can be read; NULL: all is well */
};

static bool fail(struct reader *reader, const char *trouble)
{
    reader->trouble = trouble;
    return false;
}

/* ---- shapes ---------------------------------------------------------------------------- */

/* A vertex by the axes of what the formation is placed about. */
static struct scene_point seen_from(const struct scene_pose *about, const struct scene_point *at)
{
    double dx = at->x - about->x, dy = at->y - about->y;

    return (struct scene_point){cos(about->theta) * dx + sin(about->theta) * dy,
                                cos(about->theta) * dy - sin(about->theta) * dx};
}

static bool is_shape(const struct shape *shape, const struct scene *scene)
{
    if (shape->count != scene->vertex_count || strcmp(shape->name, scene->formation) != 0)
        return false;
    for (size_t j = 0; j < shape->count; j++) {
        struct scene_point at = seen_from(&scene->about, &scene->vertices[j]);
        if (hypot(at.x - shape->vertices[j].x, at.y - shape->vertices[j].y) > SAME)
            return false;
    }
    return true;
}

/* The index of the scene's formation, the newest one first: another may have been drawn by a name
 * that there was. */
static bool find_shape(struct reader *reader, const struct scene *scene, uint8_t *index)
{
    struct history *history = &reader->archive->history;

    for (size_t i = history->shapes; i-- > 0;) {
        if (!is_shape(&history->shape[i], scene))
            continue;
        *index = (uint8_t)i;
        return true;
    }
    struct shape *shape = history_add_shape(history, scene->formation, scene->vertex_count);
    if (shape == NULL)
        return fail(reader, "it has more formations than can be kept");
    for (size_t j = 0; j < shape->count; j++)
        shape->vertices[j] = seen_from(&scene->about, &scene->vertices[j]);
    *index = (uint8_t)(history->shapes - 1);
    return true;
}

/* ---- scenes ---------------------------------------------------------------------------- */

static bool make_room(struct reader *reader, size_t robots, size_t vertices)
{
    struct history *history = &reader->archive->history;

    if (history->robots == 0) {
        reader->robots = calloc(robots, sizeof *reader->robots);
        if (reader->robots == NULL || !history_begin(history, robots, TICKS_FIRST))
            return fail(reader, "no memory");
    }
    if (vertices <= reader->vertex_room)
        return true;
    struct scene_point *more = realloc(reader->vertices, vertices * sizeof *more);
    if (more == NULL)
        return fail(reader, "no memory");
    reader->vertices = more;
    reader->vertex_room = vertices;
    return true;
}

static bool is_finite(const struct scene_robot *robot)
{
    return isfinite(robot->x) && isfinite(robot->y) && isfinite(robot->theta) &&
           isfinite(robot->distance_error);
}

static bool keep_scene(struct reader *reader, const struct scene *scene)
{
    struct history *history = &reader->archive->history;
    struct moment moment = {
        .time_ms = scene->time_ms, .reference = scene->reference, .about = scene->about};

    if (!find_shape(reader, scene, &moment.formation))
        return false;
    struct glimpse *glimpses = history_add(history);
    if (glimpses == NULL)
        return fail(reader, "no memory");
    history->moments[history->ticks - 1] = moment;
    for (size_t i = 0; i < history->robots; i++) {
        const struct scene_robot *robot = &scene->robots[i];

        if (!is_finite(robot))
            return fail(reader, "a robot in it is nowhere");
        history->id[i] = robot->id;
        glimpses[i] = (struct glimpse){
            .x = (float)robot->x,
            .y = (float)robot->y,
            .theta = (float)robot->theta,
            .omega = (float)robot->omega,
            .error = (float)robot->distance_error,
            .vertex = robot->vertex,
            .role = robot->role,
            .alive = robot->alive,
        };
    }
    return true;
}

static bool take_scene(struct reader *reader, const struct tape_message *message)
{
    struct scene scene;
    size_t robots, vertices;

    if (!scene_counts(message->bytes, message->count, &robots, &vertices) || robots == 0)
        return fail(reader, "a scene in it is none");
    if (!make_room(reader, robots, vertices))
        return false;
    if (robots != reader->archive->history.robots)
        return fail(reader, "it is not about the same robots from its beginning to its end");
    if (!scene_read(&scene, reader->robots, robots, reader->vertices, reader->vertex_room,
                    message->bytes, message->count))
        return fail(reader, "a scene in it is none");
    return keep_scene(reader, &scene);
}

static bool take_event(struct reader *reader, const struct tape_message *message)
{
    char words[SCENE_EVENT_MAX];
    struct scene_event event;

    if (!scene_event_read(&event, words, message->bytes, message->count))
        return fail(reader, "an event in it is none");
    return archive_add(reader->archive, event.time_ms, event.robot, event.event, event.detail) ||
           fail(reader, "no memory");
}

static bool take(struct reader *reader, const struct tape_message *message)
{
    if (strcmp(message->topic, topic_kinds[TOPIC_FLEET].name) == 0)
        return take_scene(reader, message);
    if (strcmp(message->topic, topic_kinds[TOPIC_EVENTS].name) == 0)
        return take_event(reader, message);
    return true;
}

static void note_about(struct archive *archive, const struct tape_about *about)
{
    char seed[24];

    archive->cut = !about->whole;
    if (about->scenario[0] == '\0')
        return;
    snprintf(seed, sizeof seed, "%llu", (unsigned long long)about->seed);
    archive->about = json_pack("{s:s, s:s, s:s}", "scenario", about->scenario, "robot_kind",
                               about->robots, "seed", seed);
}

bool archive_read_tape(struct archive *archive, char *error, size_t room)
{
    struct reader reader = {.archive = archive};
    struct tape *tape = tape_open(archive->path, error, room);
    struct tape_message message;

    if (tape == NULL)
        return false;
    while (tape_next(tape, &message) && take(&reader, &message))
        continue;
    note_about(archive, tape_about(tape));
    tape_close(tape);
    free(reader.robots);
    free(reader.vertices);
    if (reader.trouble == NULL && archive->history.ticks == 0)
        reader.trouble = "nothing was recorded before the run ended";
    if (reader.trouble != NULL)
        snprintf(error, room, "%s: %s", archive->path, reader.trouble);
    return reader.trouble == NULL;
}
