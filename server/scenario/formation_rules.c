#include "formation_rules.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#define VERTEX_SPACING_M 0.010

static bool say(char words[FORMATION_WORDS_MAX], const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static bool say(char words[FORMATION_WORDS_MAX], const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(words, FORMATION_WORDS_MAX, format, arguments);
    va_end(arguments);
    return false;
}

bool formation_count_judge(size_t count, size_t robots, size_t vertices_max,
                           char words[FORMATION_WORDS_MAX])
{
    if (count == 0)
        return say(words, "no vertex; the leader's at least is needed");
    if (count > robots)
        return say(words, "more vertices than robots: %zu for %zu; as many or fewer are allowed",
                   count, robots);
    if (count > vertices_max)
        return say(words, "%zu vertices; the robots have room for %zu", count, vertices_max);
    return true;
}

static bool judge_leader(const struct scenario_formation *formation,
                         char words[FORMATION_WORDS_MAX])
{
    size_t first = 0;

    for (size_t i = 0; i < formation->count; i++) {
        if (formation->L[i] != 0)
            continue;
        if (first != 0)
            return say(words, "vertices %zu and %zu both have L = 0; one, the leader's, is allowed",
                       first, i + 1);
        first = i + 1;
    }
    return first != 0 || say(words, "no vertex has L = 0; exactly one, the leader's, does");
}

static double distance(const struct scenario_formation *formation, size_t a, size_t b)
{
    double ax = formation->L[a] * cos(formation->psi[a]);
    double ay = formation->L[a] * sin(formation->psi[a]);
    double bx = formation->L[b] * cos(formation->psi[b]);
    double by = formation->L[b] * sin(formation->psi[b]);

    return hypot(ax - bx, ay - by);
}

static bool judge_spacing(const struct scenario_formation *formation,
                          char words[FORMATION_WORDS_MAX])
{
    for (size_t b = 1; b < formation->count; b++) {
        for (size_t a = 0; a < b; a++) {
            if (distance(formation, a, b) <= VERTEX_SPACING_M)
                return say(words,
                           "vertices %zu and %zu of %.60s are in one place; more than %g mm "
                           "apart is allowed",
                           a + 1, b + 1, formation->name, 1000 * VERTEX_SPACING_M);
        }
    }
    return true;
}

bool formation_judge(const struct scenario_formation *formation, char words[FORMATION_WORDS_MAX])
{
    return judge_leader(formation, words) && judge_spacing(formation, words);
}
