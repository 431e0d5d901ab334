// The messages that the page reads, written as ROS 2 does by somebody else's writer.
'use strict';

const { parse } = require('@foxglove/rosmsg');
const { MessageWriter } = require('@foxglove/rosmsg2-serialization');

// As in docs/VIEWING.md and server/scene/scene.h.
const FLEET = `
builtin_interfaces/Time stamp
float64 mean_distance_error
float64 range
float64 loss
float64 delay
muster_msgs/Pose2D reference
muster_msgs/Pose2D about
uint16 leader
bool complete
bool estopped
muster_msgs/Robot[] robots
muster_msgs/Point2D[] vertices
string formation
===
MSG: muster_msgs/Pose2D
float64 x
float64 y
float64 theta
===
MSG: muster_msgs/Point2D
float64 x
float64 y
===
MSG: muster_msgs/Robot
float64 x
float64 y
float64 theta
float64 v
float64 omega
float64 distance_error
float32 pose_age
float32 loss
float32 battery
float32 load
uint16 id
uint16 vertex
uint16 term
uint16 group
uint8 role
uint8 state
uint8 faults
bool candidate
bool alive
bool linked
bool muted
bool stalled
===
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
`;
const LOG = `
builtin_interfaces/Time stamp
uint8 level
string name
string msg
string file
string function
uint32 line
===
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
`;

const writer = definition => new MessageWriter(parse(definition, { ros2: true }));
const write_fleet = writer(FLEET);
const write_log = writer(LOG);

const POSE = { x: 0, y: 0, theta: 0 };
const ROBOT = {
    ...POSE, v: 0, omega: 0, distance_error: 0, pose_age: 0, loss: 0, battery: 0, load: 0, id: 1, vertex: 0,
    term: 0, group: 0, role: 2, state: 3, faults: 0, candidate: false, alive: true, linked: true, muted: false,
    stalled: false,
};

// Of a moment in s, and what is not as usual.
function fleet(time, unusual = {}) {
    const ms = Math.round(time * 1000);
    const sec = Math.floor(ms / 1000);

    return write_fleet.writeMessage({
        stamp: { sec, nanosec: (ms - 1000 * sec) * 1e6 }, mean_distance_error: 0, range: 1, loss: 0, delay: 0,
        reference: POSE, about: POSE, leader: 0, complete: false, estopped: false, vertices: [], formation: 'G',
        ...unusual, robots: (unusual.robots ?? []).map(robot => ({ ...ROBOT, ...robot })),
    });
}

function log(time, robot, word, detail) {
    return write_log.writeMessage({
        stamp: { sec: Math.floor(time), nanosec: Math.round(1e9 * (time - Math.floor(time))) }, level: 20,
        name: `robot_${robot}`, msg: `${word} ${detail}`, file: detail, function: word, line: robot,
    });
}

module.exports = { ROBOT, fleet, log };
