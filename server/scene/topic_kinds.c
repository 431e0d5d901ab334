/* topic_kinds.c: the definitions of the topics' types, as ROS 2 has them but for muster_msgs. */
#include "topic.h"

/* How a definition begins that another one needs. */
#define PART(type)                                                                                 \
    "================================================================================\n"           \
    "MSG: " type "\n"

#define TIME                                                                                       \
    PART("builtin_interfaces/Time")                                                                \
    "int32 sec\n"                                                                                  \
    "uint32 nanosec\n"

#define DURATION                                                                                   \
    PART("builtin_interfaces/Duration")                                                            \
    "int32 sec\n"                                                                                  \
    "uint32 nanosec\n"

#define HEADER                                                                                     \
    PART("std_msgs/Header")                                                                        \
    "builtin_interfaces/Time stamp\n"                                                              \
    "string frame_id\n"

#define COLOR                                                                                      \
    PART("std_msgs/ColorRGBA")                                                                     \
    "float32 r\n"                                                                                  \
    "float32 g\n"                                                                                  \
    "float32 b\n"                                                                                  \
    "float32 a\n"

#define POINT                                                                                      \
    PART("geometry_msgs/Point")                                                                    \
    "float64 x\n"                                                                                  \
    "float64 y\n"                                                                                  \
    "float64 z\n"

#define VECTOR                                                                                     \
    PART("geometry_msgs/Vector3")                                                                  \
    "float64 x\n"                                                                                  \
    "float64 y\n"                                                                                  \
    "float64 z\n"

#define QUATERNION                                                                                 \
    PART("geometry_msgs/Quaternion")                                                               \
    "float64 x\n"                                                                                  \
    "float64 y\n"                                                                                  \
    "float64 z\n"                                                                                  \
    "float64 w\n"

#define POSE                                                                                       \
    PART("geometry_msgs/Pose")                                                                     \
    "geometry_msgs/Point position\n"                                                               \
    "geometry_msgs/Quaternion orientation\n"

#define TRANSFORM                                                                                  \
    PART("geometry_msgs/Transform")                                                                \
    "geometry_msgs/Vector3 translation\n"                                                          \
    "geometry_msgs/Quaternion rotation\n"

#define TRANSFORM_STAMPED                                                                          \
    PART("geometry_msgs/TransformStamped")                                                         \
    "std_msgs/Header header\n"                                                                     \
    "string child_frame_id\n"                                                                      \
    "geometry_msgs/Transform transform\n"

#define IMAGE                                                                                      \
    PART("sensor_msgs/CompressedImage")                                                            \
    "std_msgs/Header header\n"                                                                     \
    "string format\n"                                                                              \
    "uint8[] data\n"

#define COORDINATE                                                                                 \
    PART("visualization_msgs/UVCoordinate")                                                        \
    "float32 u\n"                                                                                  \
    "float32 v\n"

#define MESH                                                                                       \
    PART("visualization_msgs/MeshFile")                                                            \
    "string filename\n"                                                                            \
    "uint8[] data\n"

#define ROBOT                                                                                      \
    PART("muster_msgs/Robot")                                                                      \
    "uint8 CANDIDATE=0\n"                                                                          \
    "uint8 LEADER=1\n"                                                                             \
    "uint8 FOLLOWER=2\n"                                                                           \
    "float64 x  # m, true pose\n"                                                                  \
    "float64 y\n"                                                                                  \
    "float64 theta  # rad\n"                                                                       \
    "float64 v  # m/s\n"                                                                           \
    "float64 omega  # rad/s\n"                                                                     \
    "float64 distance_error  # m\n"                                                                \
    "float32 pose_age  # s; NaN: it has no pose\n"                                                 \
    "float32 loss  # part of its link's frames in the last second\n"                               \
    "float32 battery  # V, 0 = unknown\n"                                                          \
    "float32 load  # part of its processor's time; NaN: unknown\n"                                 \
    "uint16 id\n"                                                                                  \
    "uint16 vertex  # 0 = none\n"                                                                  \
    "uint16 term\n"                                                                                \
    "uint16 group  # of a partition\n"                                                             \
    "uint8 role\n"                                                                                 \
    "uint8 state\n"                                                                                \
    "uint8 faults  # a set\n"                                                                      \
    "bool candidate  # may lead\n"                                                                 \
    "bool alive\n"                                                                                 \
    "bool linked  # takes part\n"                                                                  \
    "bool muted  # its beacons are lost\n"                                                         \
    "bool stalled  # its wheels are held\n"

#define VERTEX                                                                                     \
    PART("muster_msgs/Vertex")                                                                     \
    "float64 x  # m\n"                                                                             \
    "float64 y\n"

#define FLEET                                                                                      \
    "builtin_interfaces/Time stamp\n"                                                              \
    "float64 mean_distance_error  # m, of the live robots\n"                                       \
    "float64 range  # m, of followers' beacons\n"                                                  \
    "float64 loss  # probability that one is lost\n"                                               \
    "float64 delay  # s\n"                                                                         \
    "float64 reference_x  # m: where the leader should be\n"                                       \
    "float64 reference_y\n"                                                                        \
    "float64 reference_theta  # rad\n"                                                             \
    "float64 about_x  # m: what the formation is placed about\n"                                   \
    "float64 about_y\n"                                                                            \
    "float64 about_theta  # rad\n"                                                                 \
    "uint16 leader  # id, 0 = none\n"                                                              \
    "bool complete  # everybody in place\n"                                                        \
    "bool estopped\n"                                                                              \
    "muster_msgs/Robot[] robots\n"                                                                 \
    "muster_msgs/Vertex[] vertices\n"                                                              \
    "string formation\n"

#define LOG                                                                                        \
    "byte DEBUG=10\n"                                                                              \
    "byte INFO=20\n"                                                                               \
    "byte WARN=30\n"                                                                               \
    "byte ERROR=40\n"                                                                              \
    "byte FATAL=50\n"                                                                              \
    "builtin_interfaces/Time stamp\n"                                                              \
    "uint8 level\n"                                                                                \
    "string name\n"                                                                                \
    "string msg\n"                                                                                 \
    "string file\n"                                                                                \
    "string function\n"                                                                            \
    "uint32 line\n"

#define MARKER                                                                                     \
    "int32 ARROW=0\n"                                                                              \
    "int32 CUBE=1\n"                                                                               \
    "int32 SPHERE=2\n"                                                                             \
    "int32 CYLINDER=3\n"                                                                           \
    "int32 LINE_STRIP=4\n"                                                                         \
    "int32 LINE_LIST=5\n"                                                                          \
    "int32 CUBE_LIST=6\n"                                                                          \
    "int32 SPHERE_LIST=7\n"                                                                        \
    "int32 POINTS=8\n"                                                                             \
    "int32 TEXT_VIEW_FACING=9\n"                                                                   \
    "int32 MESH_RESOURCE=10\n"                                                                     \
    "int32 TRIANGLE_LIST=11\n"                                                                     \
    "int32 ADD=0\n"                                                                                \
    "int32 MODIFY=0\n"                                                                             \
    "int32 DELETE=2\n"                                                                             \
    "int32 DELETEALL=3\n"                                                                          \
    "std_msgs/Header header\n"                                                                     \
    "string ns\n"                                                                                  \
    "int32 id\n"                                                                                   \
    "int32 type\n"                                                                                 \
    "int32 action\n"                                                                               \
    "geometry_msgs/Pose pose\n"                                                                    \
    "geometry_msgs/Vector3 scale\n"                                                                \
    "std_msgs/ColorRGBA color\n"                                                                   \
    "builtin_interfaces/Duration lifetime\n"                                                       \
    "bool frame_locked\n"                                                                          \
    "geometry_msgs/Point[] points\n"                                                               \
    "std_msgs/ColorRGBA[] colors\n"                                                                \
    "string texture_resource\n"                                                                    \
    "sensor_msgs/CompressedImage texture\n"                                                        \
    "visualization_msgs/UVCoordinate[] uv_coordinates\n"                                           \
    "string text\n"                                                                                \
    "string mesh_resource\n"                                                                       \
    "visualization_msgs/MeshFile mesh_file\n"                                                      \
    "bool mesh_use_embedded_materials\n"

#define MARKER_PARTS HEADER TIME POSE POINT QUATERNION VECTOR COLOR DURATION IMAGE COORDINATE MESH

static const char fleet[] = FLEET TIME ROBOT VERTEX;

static const char event_log[] = LOG TIME;

static const char transforms[] =
    "geometry_msgs/TransformStamped[] transforms\n" TRANSFORM_STAMPED HEADER TIME TRANSFORM VECTOR
        QUATERNION;

static const char poses[] = "std_msgs/Header header\n"
                            "geometry_msgs/Pose[] poses\n" HEADER TIME POSE POINT QUATERNION;

static const char marker[] = MARKER MARKER_PARTS;

static const char markers[] =
    "visualization_msgs/Marker[] markers\n" PART("visualization_msgs/Marker") MARKER MARKER_PARTS;

const struct topic_kind topic_kinds[TOPIC_COUNT] = {
    [TOPIC_FLEET] = {"/muster/fleet", "muster_msgs/msg/Fleet", fleet, 20},
    [TOPIC_EVENTS] = {"/muster/events", "rcl_interfaces/msg/Log", event_log, 0},
    [TOPIC_TF] = {"/tf", "tf2_msgs/msg/TFMessage", transforms, 40},
    [TOPIC_POSES] = {"/muster/poses", "geometry_msgs/msg/PoseArray", poses, 40},
    [TOPIC_MARKERS] = {"/muster/markers", "visualization_msgs/msg/MarkerArray", markers, 100},
    [TOPIC_LINKS] = {"/muster/links", "visualization_msgs/msg/Marker", marker, 100},
    [TOPIC_MEAN_ERROR] = {"/muster/mean_distance_error", "std_msgs/msg/Float64", "float64 data\n",
                          20},
    [TOPIC_LEADER] = {"/muster/leader", "std_msgs/msg/UInt16", "uint16 data\n", 20},
};
