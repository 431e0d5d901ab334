/* scene.h: what people see of a run at one control tick, and its one encoding.
 *
 * A scene is made once a tick by whoever runs the fleet, and written once, as the ROS 2 message
 * muster_msgs/msg/Fleet in little-endian CDR (scene.c has its layout). The same bytes are recorded
 * in run.mcap, published to viewers of Foxglove's kind, and drawn by the page. SI units, mission
 * time. */
#ifndef SCENE_H
#define SCENE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define SCENE_NAME_MAX 64 /* bytes of a formation's name, with its end */

/* 80 bytes of the message each, in this order. */
struct scene_robot {
    double x, y, theta;    /* true pose, m and rad: as in trace.csv, and so are the next three */
    double v, omega;       /* m/s, rad/s */
    double distance_error; /* m */
    float pose_age;        /* s since the pose was measured that the robot has; NAN: has none */
    float loss;            /* part of the frames lost in the last second on its link, 0..1 */
    float battery;         /* V; 0: unknown */
    float load;            /* part of its processor's time in the last second; NAN: unknown */
    uint16_t id;
    uint16_t vertex; /* 0 = none */
    uint16_t term;
    uint16_t group; /* of a partition: beacons pass within a group only */
    uint8_t role;   /* enum role */
    uint8_t state;  /* supervisor state */
    uint8_t faults; /* set of enum fault */
    bool candidate;
    bool alive;   /* as in trace.csv */
    bool linked;  /* takes part */
    bool muted;   /* its beacons are lost */
    bool stalled; /* its wheels are held */
};

struct scene_point {
    double x, y; /* m */
};

struct scene_pose {
    double x, y, theta; /* m, rad */
};

struct scene {
    int32_t time_ms;             /* mission time */
    double mean_distance_error;  /* m, of the live robots */
    double range, loss, delay;   /* of the radio as it now is: m, probability, s */
    struct scene_pose reference; /* where the leader should be */
    struct scene_pose about;     /* what the formation is placed about (metrics.c) */
    uint16_t leader;             /* id, 0 = none */
    bool complete;               /* as in summary.json, at this tick */
    bool estopped;
    size_t robot_count;
    struct scene_robot *robots; /* in the scenario's order */
    size_t vertex_count;
    const struct scene_point *vertices; /* of the formation in force; [k] is vertex k + 1 */
    char formation[SCENE_NAME_MAX];
};

/* A row of events.csv. */
struct scene_event {
    int32_t time_ms;
    uint16_t robot; /* id, 0 = all */
    const char *event, *detail;
};

/* Whether beacons of one robot reach another: both take part, neither is muted, they are of one
 * group, and the sender is leader or candidate or within the range. Losses aside. Indices. */
bool scene_hears(const struct scene *scene, size_t sender, size_t receiver);

/* Bytes that the message may need, with CDR's head of 4: names differ in length. */
size_t scene_size(size_t robots, size_t vertices);

/* Returns the bytes written, 0 when `room` is less than scene_size() says. */
size_t scene_write(const struct scene *scene, uint8_t *bytes, size_t room);

/* Points into memory of the caller's, `robots` and `vertices` long; scene_counts() says how many
 * are needed. False when the bytes are no such message, or do not fit: nothing of it may be used.
 */
bool scene_counts(const uint8_t *bytes, size_t count, size_t *robots, size_t *vertices);
bool scene_read(struct scene *scene, struct scene_robot *robots, size_t robot_room,
                struct scene_point *vertices, size_t vertex_room, const uint8_t *bytes,
                size_t count);

/* rcl_interfaces/msg/Log: name "robot_3" or "fleet", msg "vertex_won 2", file the detail, function
 * the event, line the robot. 0 when it does not fit; SCENE_EVENT_MAX is always enough. */
#define SCENE_EVENT_MAX 1024
size_t scene_event_write(const struct scene_event *event, uint8_t *bytes, size_t room);

/* Words into `words`, at least SCENE_EVENT_MAX bytes; the event points there. */
bool scene_event_read(struct scene_event *event, char *words, const uint8_t *bytes, size_t count);

#endif
