/* event.h: what a scenario does to a fleet while it runs. */
#ifndef EVENT_H
#define EVENT_H

#include <stdbool.h>
#include <stdint.h>

enum event_action {
    EVENT_KILL,   /* power off: still and silent */
    EVENT_REVIVE, /* power on again where it stands; also ends a stall */
    EVENT_STALL,  /* the wheels stop, the radio goes on */
    EVENT_MUTE,   /* its beacons are lost both ways; pose and keep-alive still arrive */
    EVENT_UNMUTE,
    EVENT_FORMATION, /* another formation */
    EVENT_LOSS,      /* beacons lost, probability */
    EVENT_DELAY,     /* beacons late, s */
    EVENT_RANGE,     /* the followers' range, m */
    EVENT_ESTOP,     /* everyone stops and stays stopped */
    EVENT_PARTITION, /* beacons pass within a group only */
    EVENT_HEAL,
    EVENT_DRAIN, /* its battery falls below what any robot runs on; REVIVE puts in a full one */
};

#define EVENT_LEADER 0 /* as a robot: whoever leads */

/* What a condition may look at: mission time in s, the leader's pose in m and rad as motion
 * capture sees it. Without a live leader no condition holds. */
struct event_view {
    double t, x, y, theta;
};

struct event {
    enum event_action action;
    int64_t at_tick; /* first control tick at which it may happen; conditions: 0 */
    bool (*when)(const void *condition, const struct event_view *view); /* NULL: at once */
    const void *condition;
    uint16_t robot;         /* kill, revive, stall, drain, mute, unmute: an id or EVENT_LEADER */
    uint16_t formation;     /* index into the configuration's formations */
    double value;           /* loss, delay, range */
    const uint16_t *groups; /* partition: one group number per robot, in configuration order */
};

#endif
