#include "cameras.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Any will do: the noise is a draw by its number and the frame's. */
#define SEED 1

/* A body is told as the middle of its markers, which are on top of the robot, m. */
#define MARKER_HEIGHT 0.05

struct sight {
    bool lost;
    double jump; /* m */
};

struct cameras {
    struct mocap mocap;
    bool y_up, frozen;
    int64_t began_us;
    struct capture_frame frame;
    struct sight sight[CAPTURE_BODIES_MAX];
};

struct cameras *cameras_new(const struct scenario *scenario, bool y_up, int64_t now_us)
{
    struct cameras *cameras = calloc(1, sizeof *cameras);

    if (cameras == NULL || scenario->robot_count > CAPTURE_BODIES_MAX) {
        free(cameras);
        return NULL;
    }
    cameras->mocap = mocap_of(scenario, SEED);
    cameras->y_up = y_up;
    cameras->began_us = now_us;
    cameras->frame.numbered = true;
    cameras->frame.count = scenario->robot_count;
    for (size_t i = 0; i < scenario->robot_count; i++) {
        struct capture_body *body = &cameras->frame.body[i];

        body->id = scenario->robots[i].id;
        body->turn[3] = 1;
        snprintf(body->name, sizeof body->name, "Robot%d", (int)body->id);
    }
    return cameras;
}

void cameras_free(struct cameras *cameras)
{
    free(cameras);
}

/* From z up to y up: x stays, z becomes y, and y becomes -z. */
static void point_y_up(double vector[3])
{
    double y = vector[1];

    vector[1] = vector[2];
    vector[2] = -y;
}

static void see(struct cameras *cameras, size_t i, const struct body *body)
{
    struct capture_body *seen = &cameras->frame.body[i];
    const struct mocap_sample sample = {.number = cameras->frame.number};
    struct server_pose pose = mocap_pose(&cameras->mocap, &sample, (uint16_t)seen->id, body);

    seen->tracked = !cameras->sight[i].lost;
    /* A lost body repeats its last pose. */
    if (!seen->tracked)
        return;
    seen->at[0] = pose.x + cameras->sight[i].jump;
    seen->at[1] = pose.y;
    seen->at[2] = MARKER_HEIGHT;
    seen->turn[0] = seen->turn[1] = 0;
    seen->turn[2] = sin(pose.theta / 2);
    seen->turn[3] = cos(pose.theta / 2);
    if (cameras->y_up) {
        point_y_up(seen->at);
        point_y_up(seen->turn);
    }
}

void cameras_look(struct cameras *cameras, const struct ground *ground, uint64_t periods,
                  int64_t now_us)
{
    struct capture_frame *frame = &cameras->frame;

    frame->number += (uint32_t)periods;
    frame->time = cameras_time(cameras, now_us);
    for (size_t i = 0; i < frame->count; i++)
        see(cameras, i, ground_look(ground, i));
}

const struct capture_frame *cameras_frame(const struct cameras *cameras)
{
    return &cameras->frame;
}

bool cameras_frozen(const struct cameras *cameras)
{
    return cameras->frozen;
}

double cameras_time(const struct cameras *cameras, int64_t now_us)
{
    return (double)(now_us - cameras->began_us) / 1e6;
}

/* ---- faults ---------------------------------------------------------------------------- */

static bool find_body(const struct cameras *cameras, const char *text, size_t *index)
{
    char *end;
    long id = strtol(text, &end, 10);

    for (size_t i = 0; *end == '\0' && i < cameras->frame.count; i++) {
        if (cameras->frame.body[i].id != id)
            continue;
        *index = i;
        return true;
    }
    return false;
}

static bool read_metres(const char *text, double *metres)
{
    char *end;
    double value = strtod(text, &end);

    if (end == text || *end != '\0' || !isfinite(value))
        return false;
    *metres = value;
    return true;
}

/* What concerns all bodies. */
static bool carry_out(struct cameras *cameras, const char *verb, int64_t now_us)
{
    if (strcmp(verb, "freeze") == 0) {
        cameras->frozen = true;
    } else if (strcmp(verb, "thaw") == 0) {
        cameras->frozen = false;
    } else if (strcmp(verb, "restart") == 0) {
        cameras->frame.number = 0;
        cameras->began_us = now_us;
    } else {
        return false;
    }
    return true;
}

static bool carry_out_on(struct sight *sight, int count, const char *verb, const char *metres)
{
    if (count == 3 && strcmp(verb, "jump") == 0)
        return read_metres(metres, &sight->jump);
    if (count != 2 || (strcmp(verb, "lose") != 0 && strcmp(verb, "find") != 0))
        return false;
    sight->lost = verb[0] == 'l';
    return true;
}

bool cameras_command(struct cameras *cameras, const char *line, int64_t now_us, char *words,
                     size_t room)
{
    char verb[16] = "", id[16] = "", metres[32] = "", rest[2] = "";
    int count = sscanf(line, "%15s %15s %31s %1s", verb, id, metres, rest);
    size_t index;

    if (count == 1 && carry_out(cameras, verb, now_us))
        return true;
    if (count > 1 && find_body(cameras, id, &index) &&
        carry_out_on(&cameras->sight[index], count, verb, metres))
        return true;
    snprintf(words, room,
             "'%s': lose ID, find ID, jump ID METRES, freeze, thaw and restart are allowed, ID "
             "being a robot's of the scenario",
             line);
    return false;
}
