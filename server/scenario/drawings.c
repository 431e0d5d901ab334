#include "drawings.h"

#include "plan.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct drawings {
    const struct scenario *scenario;
    struct scenario_formation drawn[SERVER_DRAWN_MAX]; /* by the server's places; none: no name */
};

struct drawings *drawings_new(const struct scenario *scenario)
{
    struct drawings *drawings = calloc(1, sizeof *drawings);

    if (drawings != NULL)
        drawings->scenario = scenario;
    return drawings;
}

static void forget(struct scenario_formation *drawn)
{
    free(drawn->name);
    free(drawn->L);
    free(drawn->psi);
    *drawn = (struct scenario_formation){0};
}

void drawings_free(struct drawings *drawings)
{
    if (drawings == NULL)
        return;
    for (size_t i = 0; i < SERVER_DRAWN_MAX; i++)
        forget(&drawings->drawn[i]);
    free(drawings);
}

/* ---- may it be drawn ------------------------------------------------------------------- */

static bool judge_range(const struct scenario_formation *formation, char words[FORMATION_WORDS_MAX])
{
    for (size_t i = 0; i < formation->count; i++) {
        if (fabs(formation->L[i]) <= FORMATION_L_MAX_M &&
            fabs(formation->psi[i]) <= FORMATION_PSI_MAX_RAD)
            continue;
        snprintf(words, FORMATION_WORDS_MAX,
                 "vertex %zu: L is %g m and psi %g rad; within %g m and %g rad is allowed", i + 1,
                 formation->L[i], formation->psi[i], FORMATION_L_MAX_M, FORMATION_PSI_MAX_RAD);
        return false;
    }
    return true;
}

static bool judge_name(const struct drawings *drawings, const char *name,
                       char words[FORMATION_WORDS_MAX])
{
    uint16_t index;

    if (!drawings_find(drawings, name, &index) || index >= drawings->scenario->formation_count)
        return true;
    snprintf(words, FORMATION_WORDS_MAX,
             "the scenario has a formation %.60s; any other name is allowed", name);
    return false;
}

static bool judge(const struct drawings *drawings, const struct scenario_formation *formation,
                  char words[FORMATION_WORDS_MAX])
{
    return judge_name(drawings, formation->name, words) &&
           formation_count_judge(formation->count, drawings->scenario->robot_count,
                                 DRAWING_VERTICES_MAX, words) &&
           judge_range(formation, words) && formation_judge(formation, words);
}

/* ---- drawing --------------------------------------------------------------------------- */

static bool copy(struct scenario_formation *to, const struct scenario_formation *from)
{
    size_t bytes = from->count * sizeof *from->L;

    to->name = strdup(from->name);
    to->count = from->count;
    to->L = malloc(bytes);
    to->psi = malloc(bytes);
    if (to->name == NULL || to->L == NULL || to->psi == NULL) {
        forget(to);
        return false;
    }
    memcpy(to->L, from->L, bytes);
    memcpy(to->psi, from->psi, bytes);
    return true;
}

static uint16_t hand_over(struct server *server, const struct scenario_formation *formation)
{
    struct polar_vertex vertices[DRAWING_VERTICES_MAX];
    struct server_formation drawn = plan_formation(formation, vertices);

    return server_draw(server, &drawn);
}

bool drawings_draw(struct drawings *drawings, struct server *server,
                   const struct scenario_formation *formation, char words[FORMATION_WORDS_MAX])
{
    size_t fixed = drawings->scenario->formation_count;
    struct scenario_formation drawn;
    uint16_t index;

    if (!judge(drawings, formation, words))
        return false;
    if (!copy(&drawn, formation)) {
        snprintf(words, FORMATION_WORDS_MAX, "no memory");
        return false;
    }
    if (drawings_find(drawings, formation->name, &index))
        forget(&drawings->drawn[index - fixed]);
    index = hand_over(server, formation);
    forget(&drawings->drawn[index - fixed]);
    drawings->drawn[index - fixed] = drawn;
    return true;
}

/* ---- looking ----------------------------------------------------------------------------- */

const struct scenario_formation *drawings_look(const struct drawings *drawings, size_t index)
{
    size_t fixed = drawings->scenario->formation_count;

    return index < fixed ? &drawings->scenario->formations[index] : &drawings->drawn[index - fixed];
}

bool drawings_find(const struct drawings *drawings, const char *name, uint16_t *index)
{
    size_t count = drawings->scenario->formation_count + SERVER_DRAWN_MAX;

    for (size_t i = 0; i < count; i++) {
        const char *other = drawings_look(drawings, i)->name;

        if (other == NULL || strcmp(other, name) != 0)
            continue;
        *index = (uint16_t)i;
        return true;
    }
    return false;
}

size_t drawings_names(const struct drawings *drawings, const char **names, size_t room)
{
    size_t count = drawings->scenario->formation_count + SERVER_DRAWN_MAX;
    size_t used = 0;

    for (size_t i = 0; i < count && used < room; i++)
        if (drawings_look(drawings, i)->name != NULL)
            names[used++] = drawings_look(drawings, i)->name;
    return used;
}
