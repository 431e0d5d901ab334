#include "snapshot.h"

#include <stdio.h>

static void take_robot(struct scene_robot *robot, const struct snapshot_of *of, size_t i)
{
    const struct sample *sample = &of->samples[i];
    const struct server_view *view = server_look(of->server, i);
    struct server_station station = server_station(of->server, i);

    robot->id = of->scenario->robots[i].id;
    robot->candidate = of->scenario->robots[i].candidate;
    robot->x = sample->x;
    robot->y = sample->y;
    robot->theta = sample->theta;
    robot->v = sample->v;
    robot->omega = sample->omega;
    robot->distance_error = sample->distance_error;
    robot->role = sample->role;
    robot->vertex = sample->vertex;
    robot->alive = sample->alive;
    robot->term = view->term;
    robot->state = view->state;
    robot->faults = view->faults;
    robot->linked = view->linked;
    robot->battery = (float)(view->battery / 1000.0);
    robot->pose_age = (float)station.pose_age;
    robot->group = station.group;
    robot->muted = station.muted;
}

void snapshot_take(struct scene *scene, const struct snapshot_of *of)
{
    const struct metrics_look *look = metrics_look(of->metrics);
    const struct reference_state *reference = of->reference;
    struct server_radio radio = server_radio(of->server);
    size_t leader = server_leader(of->server);
    /* In the tick in which it dies the core has not looked for another yet. */
    bool led = leader != SERVER_NOBODY && of->samples[leader].alive;

    scene->time_ms = server_time(of->server);
    scene->mean_distance_error = look->mean_distance_error;
    scene->range = radio.range;
    scene->loss = radio.loss;
    scene->delay = radio.delay;
    scene->reference = (struct scene_pose){reference->x, reference->y, reference->theta};
    scene->about = look->about;
    scene->leader = led ? of->scenario->robots[leader].id : 0;
    scene->complete = look->complete;
    scene->estopped = server_estopped(of->server);
    scene->robot_count = of->scenario->robot_count;
    scene->vertex_count = look->vertex_count;
    scene->vertices = look->vertices;
    snprintf(scene->formation, sizeof scene->formation, "%s", of->formation->name);
    for (size_t i = 0; i < scene->robot_count; i++)
        take_robot(&scene->robots[i], of, i);
}
