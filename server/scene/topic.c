#include "topic.h"

#include "cdr.h"
#include "message.h"

#include <math.h>
#include <string.h>

/* ---- poses ----------------------------------------------------------------------------- */

/* geometry_msgs' Pose and Transform, both. */
struct placing {
    double x, y, z;
    double qx, qy, qz, qw;
};

static struct placing placing(double x, double y, double theta)
{
    return (struct placing){.x = x, .y = y, .qz = sin(theta / 2), .qw = cos(theta / 2)};
}

static void write_placing(struct cdr_writer *cdr, const struct placing *place)
{
    cdr_block(cdr, place, sizeof *place, sizeof(double));
}

/* std_msgs/msg/Header. Whole blocks, here and below: hundreds of markers are written in each tenth
 * of a second of a run that goes a hundred times as fast as time. */
static void write_header(struct cdr_writer *cdr, const struct scene *scene)
{
    cdr_time(cdr, scene->time_ms);
    cdr_block(cdr, "\4\0\0\0map", 8, sizeof(uint32_t)); /* the string "map" */
}

#define FRAME_MAX sizeof "robot_65535"

/* "robot_ID", into the end of `room`: printf takes longer than all the rest. */
static const char *frame_of(uint16_t id, char room[FRAME_MAX])
{
    char *at = room + FRAME_MAX - 1;

    *at = '\0';
    do
        *--at = (char)('0' + id % 10);
    while ((id /= 10) > 0);
    return memcpy(at - 6, "robot_", 6);
}

static void write_transform(struct cdr_writer *cdr, const struct scene *scene, const char *frame,
                            const struct placing *place)
{
    write_header(cdr, scene);
    cdr_string(cdr, frame);
    write_placing(cdr, place);
}

static void write_transforms(struct cdr_writer *cdr, const struct scene *scene)
{
    const struct scene_pose *r = &scene->reference;
    struct placing place = placing(r->x, r->y, r->theta);

    cdr_u32(cdr, (uint32_t)scene->robot_count + 1);
    for (size_t i = 0; i < scene->robot_count; i++) {
        const struct scene_robot *robot = &scene->robots[i];
        struct placing at = placing(robot->x, robot->y, robot->theta);
        char frame[FRAME_MAX];

        write_transform(cdr, scene, frame_of(robot->id, frame), &at);
    }
    write_transform(cdr, scene, "reference", &place);
}

static void write_poses(struct cdr_writer *cdr, const struct scene *scene)
{
    write_header(cdr, scene);
    cdr_u32(cdr, (uint32_t)scene->robot_count);
    for (size_t i = 0; i < scene->robot_count; i++) {
        const struct scene_robot *robot = &scene->robots[i];
        struct placing at = placing(robot->x, robot->y, robot->theta);

        write_placing(cdr, &at);
    }
}

/* ---- markers --------------------------------------------------------------------------- */

enum shape {
    CYLINDER = 3,
    LINE_STRIP = 4,
    LINE_LIST = 5,
    TEXT_VIEW_FACING = 9,
    TRIANGLE_LIST = 11
};
enum action { ADD = 0, DELETE = 2, DELETEALL = 3 };

struct color {
    float r, g, b, a;
};

struct point {
    double x, y, z;
};

struct marker {
    const char *space; /* name space: what an id is one of */
    int32_t id;
    enum shape shape;
    enum action action;
    struct placing place;
    struct point scale;
    struct color color;
};

/* Okabe and Ito's colours: told apart by colour-blind people too. */
static const struct color of_leader = {0.902f, 0.624f, 0.0f, 1};     /* orange */
static const struct color of_candidates = {0.0f, 0.620f, 0.451f, 1}; /* bluish green */
static const struct color of_followers = {0.0f, 0.447f, 0.698f, 1};  /* blue */
static const struct color of_vertices = {0.5f, 0.5f, 0.5f, 0.5f};
static const struct color of_links = {0.337f, 0.706f, 0.914f, 0.6f}; /* sky blue */
static const struct color of_reach = {0.902f, 0.624f, 0.0f, 0.4f};   /* orange */
static const struct color of_the_dead = {0.6f, 0.6f, 0.6f, 0.6f};
static const struct color of_ids = {0.5f, 0.5f, 0.5f, 1}; /* on white and on black */

/* Up to its points. */
static void begin_marker(struct cdr_writer *cdr, const struct scene *scene,
                         const struct marker *marker)
{
    int32_t what[] = {marker->id, marker->shape, marker->action};
    static const uint32_t lifetime[2]; /* until it is replaced */

    write_header(cdr, scene);
    cdr_string(cdr, marker->space);
    cdr_block(cdr, what, sizeof what, sizeof what[0]);
    write_placing(cdr, &marker->place);
    cdr_block(cdr, &marker->scale, sizeof marker->scale, sizeof(double));
    cdr_block(cdr, &marker->color, sizeof marker->color, sizeof(float));
    cdr_block(cdr, lifetime, sizeof lifetime, sizeof lifetime[0]);
    cdr_bool(cdr, false); /* frame_locked */
}

/* From behind its colours. An empty string is its length, 1, and a 0 with its gap. */
static void end_marker(struct cdr_writer *cdr, const char *text)
{
    static const uint32_t before[] = {
        1, 0,             /* texture_resource */
        0, 0, 1, 0, 1, 0, /* texture: stamp, frame_id, format, */
        0, 0,             /* data; uv_coordinates */
    };
    static const uint32_t after[] = {
        1, 0,    /* mesh_resource */
        1, 0, 0, /* mesh_file: filename, data */
    };

    cdr_block(cdr, before, sizeof before, sizeof before[0]);
    cdr_string(cdr, text);
    cdr_block(cdr, after, sizeof after, sizeof after[0]);
    cdr_bool(cdr, false); /* mesh_use_embedded_materials */
}

static void write_marker(struct cdr_writer *cdr, const struct scene *scene,
                         const struct marker *marker, const struct point *points, size_t count,
                         const char *text)
{
    begin_marker(cdr, scene, marker);
    cdr_u32(cdr, (uint32_t)count);
    cdr_block(cdr, points, count * sizeof points[0], sizeof(double));
    cdr_u32(cdr, 0); /* colors: of each point */
    end_marker(cdr, text);
}

/* A third of the way from vertex 1 to the one next to it, m: formations are of centimetres or of
 * dozens of metres. */
static double body_length(const struct scene *scene)
{
    double nearest = INFINITY;

    for (size_t k = 1; k < scene->vertex_count; k++)
        nearest = fmin(nearest, hypot(scene->vertices[k].x - scene->vertices[0].x,
                                      scene->vertices[k].y - scene->vertices[0].y));
    return isfinite(nearest) ? fmin(fmax(nearest / 3, 0.05), 1) : 0.3;
}

static struct color color_of(const struct scene_robot *robot)
{
    if (!robot->alive)
        return of_the_dead;
    return robot->role == ROLE_LEADER      ? of_leader
           : robot->role == ROLE_CANDIDATE ? of_candidates
                                           : of_followers;
}

/* The head of an arrow. */
#define BODY_POINTS 6

static void write_body(struct cdr_writer *cdr, const struct scene *scene,
                       const struct scene_robot *robot, double length)
{
    struct point nose = {0.6 * length, 0, 0}, notch = {-0.2 * length, 0, 0};
    struct point left = {-0.4 * length, 0.4 * length, 0};
    struct point right = {-0.4 * length, -0.4 * length, 0};
    struct point points[BODY_POINTS] = {nose, left, notch, nose, notch, right};
    struct marker marker = {
        .space = "bodies",
        .id = robot->id,
        .shape = TRIANGLE_LIST,
        .place = placing(robot->x, robot->y, robot->theta),
        .scale = {1, 1, 1},
        .color = color_of(robot),
    };

    write_marker(cdr, scene, &marker, points, BODY_POINTS, "");
}

static void write_id(struct cdr_writer *cdr, const struct scene *scene,
                     const struct scene_robot *robot, double length)
{
    char frame[FRAME_MAX];
    struct marker marker = {
        .space = "ids",
        .id = robot->id,
        .shape = TEXT_VIEW_FACING,
        .place = placing(robot->x, robot->y, 0),
        .scale = {0, 0, 0.6 * length},
        .color = of_ids,
    };

    marker.place.z = length;
    write_marker(cdr, scene, &marker, NULL, 0, frame_of(robot->id, frame) + strlen("robot_"));
}

static void write_vertex(struct cdr_writer *cdr, const struct scene *scene, size_t k, double length)
{
    struct marker marker = {
        .space = "vertices",
        .id = (int32_t)k + 1,
        .shape = CYLINDER,
        .place = placing(scene->vertices[k].x, scene->vertices[k].y, 0),
        .scale = {length, length, 0.02 * length},
        .color = of_vertices,
    };

    marker.place.z = -0.02 * length; /* below the bodies */
    write_marker(cdr, scene, &marker, NULL, 0, "");
}

/* More circles than these hide what they surround. */
#define RANGES_MAX 16
#define RANGE_POINTS 49

static void write_range(struct cdr_writer *cdr, const struct scene *scene,
                        const struct scene_robot *robot, const struct point *circle, double length)
{
    bool shown = robot->alive && robot->role == ROLE_FOLLOWER && scene->range > 0;
    struct marker marker = {
        .space = "range",
        .id = robot->id,
        .shape = LINE_STRIP,
        .action = shown ? ADD : DELETE,
        .place = placing(robot->x, robot->y, 0),
        .scale = {0.02 * length, 0, 0},
        .color = of_links,
    };

    write_marker(cdr, scene, &marker, circle, shown ? RANGE_POINTS : 0, "");
}

static void write_ranges(struct cdr_writer *cdr, const struct scene *scene, double length)
{
    struct point circle[RANGE_POINTS];

    for (size_t i = 0; i < RANGE_POINTS; i++) {
        double angle = 2 * M_PI * (double)i / (RANGE_POINTS - 1);

        circle[i] = (struct point){scene->range * cos(angle), scene->range * sin(angle), 0};
    }
    for (size_t i = 0; i < scene->robot_count; i++)
        write_range(cdr, scene, &scene->robots[i], circle, length);
}

static size_t ranges(const struct scene *scene)
{
    return scene->robot_count <= RANGES_MAX ? scene->robot_count : 0;
}

static void write_markers(struct cdr_writer *cdr, const struct scene *scene)
{
    /* The last message may have had more vertices. Viewers that delete more than what is of this
     * name space find it again below. */
    static const struct marker no_vertices = {
        .space = "vertices", .action = DELETEALL, .place = {.qw = 1}};
    double length = body_length(scene);

    cdr_u32(cdr, (uint32_t)(1 + scene->vertex_count + 2 * scene->robot_count + ranges(scene)));
    write_marker(cdr, scene, &no_vertices, NULL, 0, "");
    for (size_t k = 0; k < scene->vertex_count; k++)
        write_vertex(cdr, scene, k, length);
    for (size_t i = 0; i < scene->robot_count; i++)
        write_body(cdr, scene, &scene->robots[i], length);
    for (size_t i = 0; i < scene->robot_count; i++)
        write_id(cdr, scene, &scene->robots[i], length);
    if (ranges(scene) > 0)
        write_ranges(cdr, scene, length);
}

/* ---- links ----------------------------------------------------------------------------- */

/* All that 100 robots can have. */
#define LINKS_MAX 5000

static size_t most_links(const struct scene *scene)
{
    size_t n = scene->robot_count;

    return n > 100 ? LINKS_MAX : n * n / 2;
}

static size_t draw_link(struct cdr_writer *cdr, const struct scene *scene, size_t i, size_t j)
{
    struct point ends[2] = {{scene->robots[i].x, scene->robots[i].y, 0},
                            {scene->robots[j].x, scene->robots[j].y, 0}};

    cdr_block(cdr, ends, sizeof ends, sizeof(double));
    return 1;
}

static bool leads(const struct scene *scene, size_t i)
{
    return scene->robots[i].role == ROLE_LEADER;
}

/* From leaders to all whom they reach. Returns how many. */
static size_t draw_reach(struct cdr_writer *cdr, const struct scene *scene)
{
    size_t count = 0;

    for (size_t i = 0; i < scene->robot_count; i++)
        for (size_t j = 0; leads(scene, i) && j < scene->robot_count; j++)
            if (!(leads(scene, j) && j < i) && scene_hears(scene, i, j) &&
                count < most_links(scene))
                count += draw_link(cdr, scene, i, j);
    return count;
}

/* Between others that hear one another. */
static size_t draw_pairs(struct cdr_writer *cdr, const struct scene *scene, size_t most)
{
    size_t count = 0;

    for (size_t i = 0; i < scene->robot_count; i++)
        for (size_t j = i + 1; !leads(scene, i) && j < scene->robot_count && count < most; j++)
            if (!leads(scene, j) && scene_hears(scene, i, j) && scene_hears(scene, j, i))
                count += draw_link(cdr, scene, i, j);
    return count;
}

static void write_colors(struct cdr_writer *cdr, const struct color *color, size_t count)
{
    for (size_t i = 0; i < count; i++)
        cdr_block(cdr, color, sizeof *color, sizeof(float));
}

static bool any_link(const struct scene *scene)
{
    for (size_t i = 0; i < scene->robot_count; i++)
        for (size_t j = 0; j < scene->robot_count; j++)
            if (scene_hears(scene, i, j) && (leads(scene, i) || scene_hears(scene, j, i)))
                return true;
    return false;
}

static void write_links(struct cdr_writer *cdr, const struct scene *scene)
{
    struct marker marker = {
        .space = "links",
        .shape = LINE_LIST,
        .action = any_link(scene) ? ADD : DELETE, /* RViz takes no lines for a mistake */
        .place = {.qw = 1},
        .scale = {0.03 * body_length(scene), 0, 0},
        .color = of_links,
    };

    begin_marker(cdr, scene, &marker);
    cdr_u32(cdr, 0);
    size_t at = cdr->used;
    size_t reach = draw_reach(cdr, scene);
    size_t pairs = draw_pairs(cdr, scene, most_links(scene) - reach);
    uint32_t points = (uint32_t)(2 * (reach + pairs));
    if (!cdr->full)
        memcpy(cdr->bytes + at - sizeof points, &points, sizeof points);
    cdr_u32(cdr, points);
    write_colors(cdr, &of_reach, 2 * reach);
    write_colors(cdr, &of_links, 2 * pairs);
    end_marker(cdr, "");
}

/* ---- any of them ----------------------------------------------------------------------- */

/* A marker without points at its most. */
#define MARKER_ROOM 256

/* Fleet, transforms and poses have less of each robot than its markers. */
size_t topic_room(const struct scene *scene)
{
    size_t markers = 1 + scene->vertex_count + 2 * scene->robot_count + ranges(scene);
    size_t points = BODY_POINTS * scene->robot_count + RANGE_POINTS * ranges(scene);
    size_t drawn = 16 + MARKER_ROOM * markers + sizeof(struct point) * points;
    size_t end = sizeof(struct point) + sizeof(struct color);
    size_t links = MARKER_ROOM + 2 * end * most_links(scene);

    return drawn > links ? drawn : links;
}

size_t topic_write(enum topic topic, const struct scene *scene, uint8_t *bytes, size_t room)
{
    struct cdr_writer cdr = cdr_begin(bytes, room);

    switch (topic) {
    case TOPIC_FLEET: return scene_write(scene, bytes, room);
    case TOPIC_TF: write_transforms(&cdr, scene); break;
    case TOPIC_POSES: write_poses(&cdr, scene); break;
    case TOPIC_MARKERS: write_markers(&cdr, scene); break;
    case TOPIC_LINKS: write_links(&cdr, scene); break;
    case TOPIC_MEAN_ERROR: cdr_f64(&cdr, scene->mean_distance_error); break;
    case TOPIC_LEADER: cdr_u16(&cdr, scene->leader); break;
    case TOPIC_EVENTS:
    case TOPIC_COUNT: return 0;
    }
    return cdr_end(&cdr);
}
