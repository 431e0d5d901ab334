/* snapshot.h: the scene of a tick, out of what the server core and the metrics know of it. */
#ifndef SNAPSHOT_H
#define SNAPSHOT_H

#include "metrics.h"
#include "scene.h"

struct snapshot_of {
    const struct scenario *scenario;
    const struct server *server;
    const struct metrics *metrics; /* that have measured `samples` */
    const struct sample *samples;
    const struct scenario_formation *formation; /* in force */
    const struct reference_state *reference;
};

/* Fills in the scene, whose `robots` have room for all of the scenario's. What only those know who
 * keep the robots is left as it was: loss, load and whether the wheels are held. It points into the
 * metrics: good until they measure again. */
void snapshot_take(struct scene *scene, const struct snapshot_of *of);

#endif
