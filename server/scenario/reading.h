/* reading.h: what the readers of a scenario's sections share. Each is a field's reader (fields.h)
 * into a struct reading, and relies on the sections before it in scenario.c's table. */
#ifndef SCENARIO_READING_H
#define SCENARIO_READING_H

#include "fields.h"
#include "formation_rules.h"
#include "scenario.h"

/* Headings and angles, rad: whatever counts turns of them in 1/65,536 fits into 32 bits. */
#define ANGLE_MAX_RAD FORMATION_PSI_MAX_RAD

struct reading {
    struct scenario *scenario;
    size_t vertices_max;
    uint16_t *position_of; /* by id, counted from 1; 0: no such robot. ROBOT_ID_MAX + 1 of them */
};

/* A site's too (site.h), as the next two functions. */
extern const struct limits range_limits, loss_limits, delay_limits;

/* A field's reader: the schema is 1. */
bool schema_read(struct refusal *refusal, const struct node *node, const struct field *field,
                 void *into);

/* A name that a directory can have, as a copy. */
bool name_read(struct refusal *refusal, const struct node *node, char **out);

bool robots_read(struct refusal *refusal, const struct node *node, const struct field *field,
                 void *reading);
bool formations_read(struct refusal *refusal, const struct node *node, const struct field *field,
                     void *reading);
bool events_read(struct refusal *refusal, const struct node *node, const struct field *field,
                 void *reading);

/* [x, y, theta] in m and rad. `index` as in number_read(). */
bool pose_read(struct refusal *refusal, const struct node *node, size_t index, double pose[3]);

/* The index of the formation that a node names. */
bool formation_find(struct refusal *refusal, const struct node *node,
                    const struct scenario *scenario, size_t *out);

#endif
