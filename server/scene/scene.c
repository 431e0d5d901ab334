#include "scene.h"

#include "cdr.h"
#include "message.h"

#include <stdio.h>
#include <string.h>

/* muster_msgs/msg/Fleet, counted from behind CDR's head of 4 bytes; n robots, m vertices:
 *
 *      0  int32 sec, uint32 nanosec            of mission time
 *      8  float64                              mean_distance_error
 *     16  float64 range, loss, delay
 *     40  float64 x, y, theta                  reference
 *     64  float64 x, y, theta                  about
 *     88  uint16 leader, bool complete, bool estopped
 *     92  uint32 n
 *     96  n robots of 80 bytes, as in struct scene_robot
 *     96 + 80 n  uint32 m
 *    104 + 80 n  m times float64 x, y         (without vertices the string follows at once)
 *    104 + 80 n + 16 m  string                 formation: uint32 bytes, the text, 0
 *
 * Robots and vertices lie in memory as they do in the message, and are copied as they are. */
#define HEAD 4
#define ROBOT 80
#define POINT 16

_Static_assert(sizeof(struct scene_robot) == ROBOT, "as on the wire");
_Static_assert(offsetof(struct scene_robot, pose_age) == 48, "as on the wire");
_Static_assert(offsetof(struct scene_robot, id) == 64, "as on the wire");
_Static_assert(offsetof(struct scene_robot, role) == 72, "as on the wire");
_Static_assert(offsetof(struct scene_robot, candidate) == 75, "as on the wire");
_Static_assert(offsetof(struct scene_robot, stalled) == 79, "as on the wire");
_Static_assert(sizeof(struct scene_point) == POINT, "as on the wire");

/* Distances that should equal the range come out a rounding error above it (network.c). */
#define RANGE_TOLERANCE 1e-9

static bool takes_part(const struct scene_robot *robot)
{
    return robot->alive && robot->linked && !robot->muted;
}

/* A candidate that follows says a beacon in five to all. */
static bool is_heard_everywhere(const struct scene_robot *robot)
{
    return robot->candidate || robot->role != ROLE_FOLLOWER;
}

bool scene_hears(const struct scene *scene, size_t sender, size_t receiver)
{
    const struct scene_robot *from = &scene->robots[sender], *to = &scene->robots[receiver];
    double dx = to->x - from->x, dy = to->y - from->y;
    double reach = scene->range * (1 + RANGE_TOLERANCE);

    if (!is_heard_everywhere(from) && dx * dx + dy * dy > reach * reach)
        return false; /* in large fleets most pairs */
    return sender != receiver && takes_part(from) && takes_part(to) && from->group == to->group;
}

size_t scene_size(size_t robots, size_t vertices)
{
    return HEAD + 104 + ROBOT * robots + POINT * vertices + sizeof(uint32_t) + SCENE_NAME_MAX;
}

static void write_pose(struct cdr_writer *cdr, const struct scene_pose *pose)
{
    cdr_f64(cdr, pose->x);
    cdr_f64(cdr, pose->y);
    cdr_f64(cdr, pose->theta);
}

size_t scene_write(const struct scene *scene, uint8_t *bytes, size_t room)
{
    struct cdr_writer cdr = cdr_begin(bytes, room);

    if (room < scene_size(scene->robot_count, scene->vertex_count))
        return 0;
    cdr_time(&cdr, scene->time_ms);
    cdr_f64(&cdr, scene->mean_distance_error);
    cdr_f64(&cdr, scene->range);
    cdr_f64(&cdr, scene->loss);
    cdr_f64(&cdr, scene->delay);
    write_pose(&cdr, &scene->reference);
    write_pose(&cdr, &scene->about);
    cdr_u16(&cdr, scene->leader);
    cdr_bool(&cdr, scene->complete);
    cdr_bool(&cdr, scene->estopped);
    cdr_u32(&cdr, (uint32_t)scene->robot_count);
    cdr_block(&cdr, scene->robots, ROBOT * scene->robot_count, sizeof(double));
    cdr_u32(&cdr, (uint32_t)scene->vertex_count);
    cdr_block(&cdr, scene->vertices, POINT * scene->vertex_count, sizeof(double));
    cdr_string(&cdr, scene->formation);
    return cdr_end(&cdr);
}

static struct scene_pose read_pose(struct cdr_reader *cdr)
{
    double x = cdr_take_f64(cdr), y = cdr_take_f64(cdr), theta = cdr_take_f64(cdr);

    return (struct scene_pose){x, y, theta};
}

/* Everything but robots and vertices, of which it says where they lie. */
static bool look_through(struct scene *scene, const uint8_t **robots, const uint8_t **vertices,
                         const uint8_t *bytes, size_t count)
{
    struct cdr_reader cdr = cdr_open(bytes, count);

    memset(scene, 0, sizeof *scene);
    scene->time_ms = cdr_take_time(&cdr);
    scene->mean_distance_error = cdr_take_f64(&cdr);
    scene->range = cdr_take_f64(&cdr);
    scene->loss = cdr_take_f64(&cdr);
    scene->delay = cdr_take_f64(&cdr);
    scene->reference = read_pose(&cdr);
    scene->about = read_pose(&cdr);
    scene->leader = cdr_take_u16(&cdr);
    scene->complete = cdr_take_bool(&cdr);
    scene->estopped = cdr_take_bool(&cdr);
    scene->robot_count = cdr_take_count(&cdr, ROBOT);
    *robots = cdr_take_block(&cdr, ROBOT * scene->robot_count, sizeof(double));
    scene->vertex_count = cdr_take_count(&cdr, POINT);
    *vertices = cdr_take_block(&cdr, POINT * scene->vertex_count, sizeof(double));
    cdr_take_string(&cdr, scene->formation, sizeof scene->formation);
    return !cdr.short_of && cdr.used == count;
}

bool scene_counts(const uint8_t *bytes, size_t count, size_t *robots, size_t *vertices)
{
    struct scene scene;
    const uint8_t *robot_bytes, *vertex_bytes;

    if (!look_through(&scene, &robot_bytes, &vertex_bytes, bytes, count))
        return false;
    *robots = scene.robot_count;
    *vertices = scene.vertex_count;
    return true;
}

/* A bool in memory is 0 or 1. */
static bool read_robot(struct scene_robot *robot, const uint8_t *bytes)
{
    for (size_t i = offsetof(struct scene_robot, candidate); i < ROBOT; i++)
        if (bytes[i] > 1)
            return false;
    memcpy(robot, bytes, ROBOT);
    return true;
}

bool scene_read(struct scene *scene, struct scene_robot *robots, size_t robot_room,
                struct scene_point *vertices, size_t vertex_room, const uint8_t *bytes,
                size_t count)
{
    const uint8_t *robot_bytes, *vertex_bytes;

    if (!look_through(scene, &robot_bytes, &vertex_bytes, bytes, count) ||
        scene->robot_count > robot_room || scene->vertex_count > vertex_room)
        return false;
    for (size_t i = 0; i < scene->robot_count; i++)
        if (!read_robot(&robots[i], robot_bytes + ROBOT * i))
            return false;
    if (scene->vertex_count > 0)
        memcpy(vertices, vertex_bytes, POINT * scene->vertex_count);
    scene->robots = robots;
    scene->vertices = vertices;
    return true;
}

/* rcl_interfaces/msg/Log. */
enum { LEVEL_INFO = 20, LEVEL_WARN = 30 };

/* Both of them, the detail twice, and the rest are within SCENE_EVENT_MAX. */
#define EVENT_WORD_MAX 63
#define DETAIL_MAX 400

static bool is_trouble(const struct scene_event *event)
{
    static const char *const words[] = {"fault", "link_error", "stranger", "estop"};

    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        if (strcmp(event->event, words[i]) == 0)
            return strcmp(event->detail, "none") != 0;
    return false;
}

size_t scene_event_write(const struct scene_event *event, uint8_t *bytes, size_t room)
{
    struct cdr_writer cdr = cdr_begin(bytes, room);
    char name[sizeof "robot_65535"] = "fleet";
    char word[EVENT_WORD_MAX + 1], detail[DETAIL_MAX + 1];
    char message[sizeof word + sizeof detail];

    if (event->robot != 0)
        snprintf(name, sizeof name, "robot_%u", event->robot);
    snprintf(word, sizeof word, "%s", event->event);
    snprintf(detail, sizeof detail, "%s", event->detail);
    snprintf(message, sizeof message, "%s%s%s", word, detail[0] == '\0' ? "" : " ", detail);
    cdr_time(&cdr, event->time_ms);
    cdr_u8(&cdr, is_trouble(event) ? LEVEL_WARN : LEVEL_INFO);
    cdr_string(&cdr, name);
    cdr_string(&cdr, message);
    cdr_string(&cdr, detail); /* file */
    cdr_string(&cdr, word);   /* function */
    cdr_u32(&cdr, event->robot);
    return cdr_end(&cdr);
}

bool scene_event_read(struct scene_event *event, char *words, const uint8_t *bytes, size_t count)
{
    struct cdr_reader cdr = cdr_open(bytes, count);

    if (count > SCENE_EVENT_MAX)
        return false;
    event->time_ms = cdr_take_time(&cdr);
    cdr_take_u8(&cdr);
    cdr_take_string(&cdr, words, SCENE_EVENT_MAX); /* name and message are made of the rest */
    cdr_take_string(&cdr, words, SCENE_EVENT_MAX);
    cdr_take_string(&cdr, words, SCENE_EVENT_MAX);
    char *after = words + strlen(words) + 1;
    cdr_take_string(&cdr, after, SCENE_EVENT_MAX - (size_t)(after - words));
    uint32_t robot = cdr_take_u32(&cdr);
    event->robot = (uint16_t)robot;
    event->event = after;
    event->detail = words;
    return !cdr.short_of && cdr.used == count && robot <= UINT16_MAX;
}
