/* formation_rules.h: what every formation must be, whether a file has it or somebody draws it. Each
 * function is false with words about what is wrong and what is allowed. */
#ifndef FORMATION_RULES_H
#define FORMATION_RULES_H

#include "scenario.h"

#define FORMATION_WORDS_MAX 256

/* How far a vertex may be from the leader's, and how its direction may be counted. */
#define FORMATION_L_MAX_M 2000.0
#define FORMATION_PSI_MAX_RAD 10000.0

/* How many vertices there are. */
bool formation_count_judge(size_t count, size_t robots, size_t vertices_max,
                           char words[FORMATION_WORDS_MAX]);

/* Where they are, within the limits above: one is the leader's, and no two are in one place. */
bool formation_judge(const struct scenario_formation *formation, char words[FORMATION_WORDS_MAX]);

#endif
