/* visitor.h: one who looks on a run of `muster sim` or `muster serve`, and acts on it. While he
 * waits for an answer or a scene a stage stands still (stage.h): only for what comes soon. */
#ifndef VISITOR_H
#define VISITOR_H

#include "client.h"
#include "process.h"
#include "scene.h"

#define VISITOR_ROBOTS 4

struct visitor {
    struct client client;
    char url[128];
    unsigned asked;
    struct scene scene; /* the newest one that came; before the first one its time is INT32_MIN */
    struct scene_robot robots[VISITOR_ROBOTS];
    struct scene_point vertices[VISITOR_ROBOTS];
};

/* The process has said where its view is. */
void visitor_join(struct visitor *visitor, const struct process *process);
void visitor_leave(struct visitor *visitor);

/* Looks on until a scene is as it is to be. */
void visitor_see(struct visitor *visitor, bool (*seen)(const struct scene *scene));

/* Asks for an act, whose word `request` begins with. The answer, "null" or the words of a refusal,
 * has `expected` in it; NULL: it is not waited for. */
void visitor_ask(struct visitor *visitor, const char *request, const char *expected);

#endif
