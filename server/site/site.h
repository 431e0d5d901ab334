/* site.h: a site file, read and judged: where motion capture and the robots are.
 *
 * As strict as a scenario: what is not right is refused whole, with one line
 * `file:line:column: error: what, and what is allowed`. */
#ifndef SITE_H
#define SITE_H

#include "link.h"
#include "source.h"
#include "tracker.h"

struct site_robot {
    uint16_t id;
    char *name;     /* of its body in motion capture; NULL: only the number counts */
    int32_t body;   /* its number there, or CAPTURE_ID_NONE: only the name counts */
    double heading; /* rad, from the body's forward axis to the robot's */
    struct link_settings link;
};

struct site {
    char *name;     /* letters, digits, . _ - */
    char *scenario; /* path, relative to the site file's folder resolved; NULL: told elsewhere */
    struct source_settings mocap;
    struct tracker_settings tracker;
    size_t robot_count;
    struct site_robot *robots;
    double range, loss, delay; /* NAN: the scenario's */
    double track, wheel_max;   /* of the robots' bodies, m and m/s; NAN: the scenario's */
    double latency; /* s, least from a pose's measurement to the control tick that uses it;
                       NAN: by the kind of links */
    double poses;   /* a second, at most, to one robot; NAN: 60 by radio, else all */
    bool fenced;
    double fence[4];   /* x_min, y_min, x_max, y_max, m */
    double separation; /* m; centres nearer than this stop the fleet; 0: no matter how near */
    double battery;    /* V, less is warned of; 0: never */
    double patience;   /* s for which a start waits for robots that are missing */
};

/* NULL when it is refused: `error` then holds the one line to print. `settings` as in
 * scenario_read(); a path in one of them is not relative to the site file. */
struct site *site_read(const char *path, const char *const *settings, size_t setting_count,
                       char *error, size_t room);

struct site *site_parse(const char *name, const char *text, size_t length,
                        const char *const *settings, size_t setting_count, char *error,
                        size_t room);

void site_free(struct site *site);

#endif
