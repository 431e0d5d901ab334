/* drawings.h: the formations of a run: those of its scenario, and those drawn while it goes on. */
#ifndef DRAWINGS_H
#define DRAWINGS_H

#include "formation_rules.h"
#include "scenario.h"
#include "server.h"

struct drawings;

/* NULL when there is no memory. The scenario must outlive it. */
struct drawings *drawings_new(const struct scenario *scenario);
void drawings_free(struct drawings *drawings);

/* What the server core is given. False with words when the formation is not one that a scenario may
 * have, or its name is that of one of the scenario's. One that was drawn under this name before
 * is gone, and so is the oldest where there are more than SERVER_DRAWN_MAX. */
bool drawings_draw(struct drawings *drawings, struct server *server,
                   const struct scenario_formation *formation, char words[FORMATION_WORDS_MAX]);

/* By the server's index. */
const struct scenario_formation *drawings_look(const struct drawings *drawings, size_t index);

/* The index of the one that has this name; false when none has. */
bool drawings_find(const struct drawings *drawings, const char *name, uint16_t *index);

/* All there are, the scenario's first, by name. Writes up to `room` and returns how many. */
size_t drawings_names(const struct drawings *drawings, const char **names, size_t room);

#endif
