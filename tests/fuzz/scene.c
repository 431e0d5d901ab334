/* scene.c: any bytes as a scene and as an event: nothing is read or written out of bounds, and what
 * has been written once is written again as it was. */
#include "scene.h"
#include "topic.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

static uint8_t *written(const struct scene *scene, size_t size)
{
    size_t room = scene_size(scene->robot_count, scene->vertex_count);
    uint8_t *bytes = malloc(room);

    assert(bytes != NULL && scene_write(scene, bytes, room) == size);
    return bytes;
}

/* Gaps are 0, parts of milliseconds gone and names UTF-8 when it has been written once. */
static void write_twice(struct scene scene, size_t size)
{
    uint8_t *once = written(&scene, size);

    assert(scene_read(&scene, scene.robots, scene.robot_count, (struct scene_point *)scene.vertices,
                      scene.vertex_count, once, size));
    uint8_t *twice = written(&scene, size);
    assert(memcmp(once, twice, size) == 0);
    free(twice);
    free(once);
}

static void write_topics(const struct scene *scene)
{
    size_t room = topic_room(scene);
    uint8_t *bytes = malloc(room);

    assert(bytes != NULL);
    for (enum topic topic = 0; topic < TOPIC_COUNT; topic++)
        assert((topic_write(topic, scene, bytes, room) > 0) == (topic != TOPIC_EVENTS));
    free(bytes);
}

static void look_at_scene(const uint8_t *data, size_t size)
{
    size_t robot_count, vertex_count;
    struct scene scene;

    if (!scene_counts(data, size, &robot_count, &vertex_count))
        return;
    struct scene_robot *robots = malloc(robot_count * sizeof *robots + 1);
    struct scene_point *vertices = malloc(vertex_count * sizeof *vertices + 1);
    assert(robots != NULL && vertices != NULL);
    if (scene_read(&scene, robots, robot_count, vertices, vertex_count, data, size)) {
        assert(scene.robot_count == robot_count && scene.vertex_count == vertex_count);
        write_twice(scene, size);
        write_topics(&scene);
    }
    free(vertices);
    free(robots);
}

static void look_at_event(const uint8_t *data, size_t size)
{
    char *words = malloc(SCENE_EVENT_MAX), *again = malloc(SCENE_EVENT_MAX);
    uint8_t bytes[SCENE_EVENT_MAX];
    struct scene_event event, read;

    assert(words != NULL && again != NULL);
    if (scene_event_read(&event, words, data, size)) {
        size_t count = scene_event_write(&event, bytes, sizeof bytes);

        assert(count > 0 && scene_event_read(&read, again, bytes, count));
        assert(read.time_ms == event.time_ms && read.robot == event.robot);
        assert(strlen(read.event) <= strlen(event.event));
        assert(strlen(read.detail) <= strlen(event.detail));
    }
    free(again);
    free(words);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    look_at_scene(data, size);
    look_at_event(data, size);
    return 0;
}
