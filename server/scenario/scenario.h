/* scenario.h: a scenario file, read and judged.
 *
 * YAML 1.2 by libfyaml, expressions by muParser, both out of sight. What comes out is complete
 * and in range; what is not is refused whole, with one line
 * `file:line:column: error: what, and what is allowed`. */
#ifndef SCENARIO_H
#define SCENARIO_H

#include "event.h"
#include "message.h"
#include "reference.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define SCENARIO_NAME_MAX 100 /* bytes */

/* The longest run, s. */
#define SCENARIO_DURATION_MAX 86400

enum scenario_body { BODY_IDEAL, BODY_SMALL };
enum scenario_allocation {
    ASSIGN_CPA,
    ASSIGN_CPA_LITERAL, /* Algorithm 1 to the letter: whoever is closer is a rival */
    ASSIGN_RIGID,
    ASSIGN_OPTIMAL,
};

struct scenario_robot {
    uint16_t id;
    double x, y, theta; /* m, rad */
    bool candidate;
};

struct scenario_formation {
    char *name;
    size_t count;
    double *L, *psi; /* m, rad; exactly one L is 0 */
};

struct scenario {
    char *name;      /* letters, digits, . _ -; fit for a directory */
    double duration; /* s */
    size_t robot_count;
    struct scenario_robot *robots;
    enum scenario_body body;
    double scatter;                /* how far robots differ from their design: 0, not at all */
    double range, loss, delay;     /* m, probability, s */
    struct trajectory *trajectory; /* reference.h */
    size_t formation_count;
    struct scenario_formation *formations;
    size_t formation; /* the first one's index */
    enum scenario_allocation allocation;
    enum motion_law law;
    double k, k_theta, v_max, omega_max; /* 1/s, 1/s, m/s, rad/s */
    size_t event_count;
    struct event *events; /* in the file's order */
};

/* Reads `path`, then applies the settings, each a `KEY.PATH=VALUE` of `--set`. NULL when it is
 * refused: `error` then holds the one line to print. `vertices_max` is the largest formation
 * that the robots can hold. */
struct scenario *scenario_read(const char *path, const char *const *settings, size_t setting_count,
                               size_t vertices_max, char *error, size_t room);

/* The same from memory; `name` stands for the file in the error. */
struct scenario *scenario_parse(const char *name, const char *text, size_t length,
                                const char *const *settings, size_t setting_count,
                                size_t vertices_max, char *error, size_t room);

/* Vertices of the largest formation. */
size_t scenario_largest(const struct scenario *scenario);

void scenario_free(struct scenario *scenario);

#endif
