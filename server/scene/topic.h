/* topic.h: what a run says to the tools of ROS 2: names, types, and their messages made of scenes.
 *
 * run.mcap and Foxglove's WebSocket have the same topics. */
#ifndef TOPIC_H
#define TOPIC_H

#include "scene.h"

enum topic {
    TOPIC_FLEET,   /* /muster/fleet, muster_msgs/msg/Fleet: every tick, all of it */
    TOPIC_EVENTS,  /* /muster/events, rcl_interfaces/msg/Log: events.csv */
    TOPIC_TF,      /* /tf, tf2_msgs/msg/TFMessage: map to robot_ID, and to reference */
    TOPIC_POSES,   /* /muster/poses, geometry_msgs/msg/PoseArray, in the scenario's order */
    TOPIC_MARKERS, /* /muster/markers, visualization_msgs/msg/MarkerArray: bodies, ids, vertices */
    TOPIC_LINKS,   /* /muster/links, visualization_msgs/msg/Marker: who hears whom, lines */
    TOPIC_MEAN_ERROR, /* /muster/mean_distance_error, std_msgs/msg/Float64 */
    TOPIC_LEADER,     /* /muster/leader, std_msgs/msg/UInt16: its id, 0 = none */
    TOPIC_COUNT,
};

struct topic_kind {
    const char *name, *type;
    const char *definition; /* ros2msg, with all that it is made of */
    int32_t period_ms;      /* from one message of a recording to the next; 0: when it happens */
};

/* Indexed by enum topic. */
extern const struct topic_kind topic_kinds[TOPIC_COUNT];

/* Enough for any message of this scene. */
size_t topic_room(const struct scene *scene);

/* Any topic but TOPIC_EVENTS (scene_event_write). Returns the bytes, 0 when they do not fit. */
size_t topic_write(enum topic topic, const struct scene *scene, uint8_t *bytes, size_t room);

#endif
