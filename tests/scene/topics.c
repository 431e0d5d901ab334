/* topics.c FILE: a scene's messages on every topic for topics.py, a line each: topic, type, the
 * definition and the message in hexadecimal, and for those that are no scene seen from another side
 * the values that are in it, in their order, as JSON. */
#include "message.h"
#include "topic.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ROBOTS 5

static struct scene_robot robots[ROBOTS];

static void set_robots(void)
{
    for (uint16_t i = 0; i < ROBOTS; i++)
        robots[i] = (struct scene_robot){
            .x = 1.1 * i,
            .y = -0.3 * i * i,
            .theta = 0.7 * i - 3,
            .v = 0.01 * i,
            .omega = -0.02 * i,
            .distance_error = 1.0 / (i + 1),
            .pose_age = 0.004f * i,
            .loss = 0.1f * i,
            .battery = 7.4f - i,
            .load = 0.25f,
            .id = (uint16_t)(i == 4 ? 65534 : i + 1),
            .vertex = i,
            .term = (uint16_t)(2 * i),
            .group = 1,
            .role = i == 1   ? ROLE_LEADER
                    : i == 2 ? ROLE_CANDIDATE
                             : ROLE_FOLLOWER,
            .state = 6,
            .faults = (uint8_t)(1u << i),
            .candidate = i < 3,
            .alive = i != 3,
            .linked = true,
            .muted = i == 3,
            .stalled = i == 4,
        };
}

static void print_hex(FILE *out, const void *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++)
        fprintf(out, "%02x", ((const uint8_t *)bytes)[i]);
}

static void print_message(FILE *out, enum topic topic, const uint8_t *bytes, size_t count)
{
    const struct topic_kind *kind = &topic_kinds[topic];

    assert(count > 0);
    fprintf(out, "%s\t%s\t", kind->name, kind->type);
    print_hex(out, kind->definition, strlen(kind->definition));
    fputc('\t', out);
    print_hex(out, bytes, count);
    fputc('\t', out);
}

static void print_robot(FILE *out, const struct scene_robot *r)
{
    fprintf(out, ", %.17g, %.17g, %.17g, %.17g, %.17g, %.17g", r->x, r->y, r->theta, r->v, r->omega,
            r->distance_error);
    fprintf(out, ", %.17g, %.17g, %.17g, %.17g", r->pose_age, r->loss, r->battery, r->load);
    fprintf(out, ", %u, %u, %u, %u, %u, %u, %u", r->id, r->vertex, r->term, r->group, r->role,
            r->state, r->faults);
    fprintf(out, ", %d, %d, %d, %d, %d", r->candidate, r->alive, r->linked, r->muted, r->stalled);
}

static void print_scene(FILE *out, const struct scene *s)
{
    fprintf(out, "[%d, %d", s->time_ms / 1000, s->time_ms % 1000 * 1000000);
    fprintf(out, ", %.17g, %.17g, %.17g, %.17g", s->mean_distance_error, s->range, s->loss,
            s->delay);
    fprintf(out, ", %.17g, %.17g, %.17g", s->reference.x, s->reference.y, s->reference.theta);
    fprintf(out, ", %.17g, %.17g, %.17g", s->about.x, s->about.y, s->about.theta);
    fprintf(out, ", %u, %d, %d", s->leader, s->complete, s->estopped);
    for (size_t i = 0; i < s->robot_count; i++)
        print_robot(out, &s->robots[i]);
    for (size_t k = 0; k < s->vertex_count; k++)
        fprintf(out, ", %.17g, %.17g", s->vertices[k].x, s->vertices[k].y);
    fprintf(out, ", \"%s\"]", s->formation);
}

static void print_topics(FILE *out, const struct scene *scene)
{
    size_t room = topic_room(scene);
    uint8_t *bytes = malloc(room);

    assert(bytes != NULL);
    for (enum topic topic = 0; topic < TOPIC_COUNT; topic++) {
        if (topic == TOPIC_EVENTS)
            continue;
        print_message(out, topic, bytes, topic_write(topic, scene, bytes, room));
        if (topic == TOPIC_FLEET)
            print_scene(out, scene);
        fputc('\n', out);
    }
    free(bytes);
}

static void print_event(FILE *out)
{
    struct scene_event event = {4020, 3, "vertex_won", "2"};
    uint8_t bytes[SCENE_EVENT_MAX];

    print_message(out, TOPIC_EVENTS, bytes, scene_event_write(&event, bytes, sizeof bytes));
    fputs("[4, 20000000, 20, \"robot_3\", \"vertex_won 2\", \"2\", \"vertex_won\", 3]\n", out);
}

int main(int argc, char **argv)
{
    static const struct scene_point vertices[] = {{0.5, 0.25}, {-1.5, 0.125}, {1e-3, 2.75}};
    FILE *out = argc == 2 ? fopen(argv[1], "w") : NULL;
    struct scene scene = {
        .time_ms = 12340,
        .mean_distance_error = 0.0625,
        .range = 2.5,
        .loss = 0.1,
        .delay = 0.04,
        .reference = {1.25, -0.5, 2},
        .about = {1, 2, -3},
        .leader = 2,
        .complete = true,
        .robot_count = ROBOTS,
        .robots = robots,
        .vertex_count = 3,
        .vertices = vertices,
        .formation = "Rautenförmig",
    };

    assert(out != NULL);
    set_robots();
    print_topics(out, &scene);
    scene.robot_count = scene.vertex_count = 0;
    print_topics(out, &scene);
    print_event(out);
    return fclose(out) == 0 ? 0 : 1;
}
