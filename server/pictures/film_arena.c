/* film_arena.c: the arena from above, in pixels about the place where the camera is at first. */
#include "film_scene.h"

#include "keyframes.h"
#include "message.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define ERROR 0.3      /* pixels that anything may be off */
#define ERROR_TURN 1.5 /* degrees */
#define GRID 40.0      /* pixels between lines, at least */

/* ---- motion ---------------------------------------------------------------------------- */

/* To a tenth of a pixel. */
static double tenth(double pixels)
{
    return round(pixels * 10) / 10 + 0.0; /* never -0 */
}

static double pixel_x(const struct film *film, double x)
{
    return (x - film->x0) * film->scale;
}

static double pixel_y(const struct film *film, double y)
{
    return (film->y0 - y) * film->scale;
}

typedef struct scene_pose motion(const struct film *film, size_t tick, size_t which);

/* What is shown of a motion, over some ticks. */
struct way {
    size_t count;
    struct keyframes_point *points; /* pixels, or degrees that turn on */
    size_t *picked;
    size_t keys;
};

static bool way_open(struct film *film, struct way *way, size_t first, size_t last)
{
    way->count = last - first + 1;
    way->points = calloc(way->count, sizeof *way->points);
    way->picked = calloc(way->count, sizeof *way->picked);
    for (size_t i = 0; i < way->count && way->points != NULL; i++)
        way->points[i].t = history_time(film->history, first + i);
    film->failed |= way->points == NULL || way->picked == NULL;
    return !film->failed;
}

static void way_close(struct way *way)
{
    free(way->points);
    free(way->picked);
}

static const struct keyframes_point *way_key(const struct way *way, size_t i)
{
    return &way->points[way->picked[i]];
}

static void way_thin(struct film *film, struct way *way, double error)
{
    way->keys = keyframes_pick(way->points, way->count, error, way->picked);
    film->failed |= way->keys == 0;
}

/* In pixels. */
static bool way_of(struct film *film, struct way *way, motion *move, size_t which, size_t first,
                   size_t last)
{
    if (!way_open(film, way, first, last))
        return false;
    for (size_t i = 0; i < way->count; i++) {
        struct scene_pose pose = move(film, first + i, which);
        way->points[i].at[0] = pixel_x(film, pose.x);
        way->points[i].at[1] = pixel_y(film, pose.y);
    }
    way_thin(film, way, ERROR);
    return true;
}

/* In degrees, clockwise, never by more than half a turn at once. */
static bool turns_of(struct film *film, struct way *way, motion *move, size_t which)
{
    double turned = 0;

    if (!way_open(film, way, film->first, film->last))
        return false;
    for (size_t i = 0; i < way->count; i++) {
        double degrees = -move(film, film->first + i, which).theta * 180 / M_PI;
        turned += remainder(degrees - turned, 360);
        way->points[i].at[0] = turned;
    }
    way_thin(film, way, ERROR_TURN);
    return true;
}

static bool is_still(const struct way *way)
{
    const struct keyframes_point *from = way_key(way, 0), *to = way_key(way, way->keys - 1);

    return way->keys <= 2 && tenth(from->at[0]) == tenth(to->at[0]) &&
           tenth(from->at[1]) == tenth(to->at[1]);
}

/* The element's own transform is that of the last moment, for who does not see it move. */
static void write_transform(struct film *film, const struct way *way, const char *type,
                            const char *format)
{
    const struct keyframes_point *end = &way->points[way->count - 1];
    char element[64];
    struct track track;

    fprintf(film->out, " transform=\"%s(", type);
    fprintf(film->out, format, tenth(end->at[0]), tenth(end->at[1]));
    fputs(")\">", film->out);
    if (!film->moves || is_still(way) || !film_track(film, &track))
        return;
    for (size_t i = 0; i < way->keys; i++) {
        const struct keyframes_point *key = way_key(way, i);
        track_key(&track, key->t, format, tenth(key->at[0]), tenth(key->at[1]));
    }
    snprintf(element, sizeof element, "animateTransform attributeName=\"transform\" type=\"%s\"",
             type);
    track_close(&track, film->out, element);
}

/* Ends the tag that is open, so that it goes where `move` says. */
static void write_way(struct film *film, motion *move, size_t which)
{
    struct way way = {0};

    if (way_of(film, &way, move, which, film->first, film->last))
        write_transform(film, &way, "translate", "%g %g");
    way_close(&way);
}

static void write_turns(struct film *film, motion *move, size_t which)
{
    struct way way = {0};

    if (turns_of(film, &way, move, which))
        write_transform(film, &way, "rotate", "%g");
    way_close(&way);
}

static struct scene_pose robot_pose(const struct film *film, size_t tick, size_t robot)
{
    const struct glimpse *g = history_at(film->history, tick, robot);

    return (struct scene_pose){g->x, g->y, g->theta};
}

static struct scene_pose about_pose(const struct film *film, size_t tick, size_t which)
{
    (void)which;
    return film->history->moments[tick].about;
}

/* Of the arena before the camera: the other way, from the middle of the picture. */
static struct scene_pose arena_pose(const struct film *film, size_t tick, size_t which)
{
    const struct scene_point *camera = film_camera_at(film, tick);

    (void)which;
    return (struct scene_pose){film->x0 + film->width / 2 / film->scale - (camera->x - film->x0),
                               film->y0 - film->height / 2 / film->scale - (camera->y - film->y0),
                               0};
}

/* ---- what changes at once -------------------------------------------------------------- */

/* What a thing is at a tick, as the value of an attribute. */
typedef const char *state(const struct film *film, size_t tick, size_t which);

/* An attribute of the element that is open; its changes are written inside of it. */
static void write_state(const struct film *film, const char *attribute, state *say, size_t which)
{
    fprintf(film->out, " %s=\"%s\"", attribute, say(film, film->last, which));
}

static bool changes(const struct film *film, state *say, size_t which)
{
    for (size_t tick = film->first; tick < film->last; tick++)
        if (strcmp(say(film, tick, which), say(film, film->last, which)) != 0)
            return true;
    return false;
}

static void write_changes(struct film *film, const char *attribute, state *say, size_t which)
{
    const char *before = "";
    char element[64];
    struct track track;

    if (!film->moves || !changes(film, say, which) || !film_track(film, &track))
        return;
    for (size_t tick = film->first; tick <= film->last; tick++) {
        const char *now = say(film, tick, which);
        if (strcmp(before, now) != 0)
            track_key(&track, history_time(film->history, tick), "%s", now);
        before = now;
    }
    snprintf(element, sizeof element, "animate attributeName=\"%s\" calcMode=\"discrete\"",
             attribute);
    track_close(&track, film->out, element);
}

/* The class of a robot: how it is drawn. */
static const char *robot_state(const struct film *film, size_t tick, size_t robot)
{
    static const char *const classes[] = {
        [ROLE_CANDIDATE] = "C", [ROLE_LEADER] = "L", [ROLE_FOLLOWER] = "F"};
    const struct glimpse *g = history_at(film->history, tick, robot);

    return g->alive ? classes[g->role] : "X";
}

static const char *vertex_state(const struct film *film, size_t tick, size_t vertex)
{
    for (size_t i = 0; i < film->history->robots; i++) {
        const struct glimpse *g = history_at(film->history, tick, i);
        if (g->alive && g->vertex == vertex + 1)
            return "vertex held";
    }
    return "vertex";
}

static const char *shape_state(const struct film *film, size_t tick, size_t shape)
{
    return film->history->moments[tick].formation == shape ? "visible" : "hidden";
}

/* ---- drawing --------------------------------------------------------------------------- */

double film_grid_step(const struct film *film)
{
    static const double steps[] = {0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100};
    size_t i = 0;

    while (i + 1 < sizeof steps / sizeof steps[0] && steps[i] * film->scale < GRID)
        i++;
    return steps[i];
}

/* Lines along one axis, through all that the camera sees. */
static void draw_lines(const struct film *film, double low, double high, double from, double to,
                       bool upright)
{
    double step = film_grid_step(film);

    for (double i = ceil(low / step); i * step <= high; i++) {
        if (upright)
            fprintf(film->out, "M%g,%gV%g", tenth(pixel_x(film, i * step)),
                    tenth(pixel_y(film, from)), tenth(pixel_y(film, to)));
        else
            fprintf(film->out, "M%g,%gH%g", tenth(pixel_x(film, from)),
                    tenth(pixel_y(film, i * step)), tenth(pixel_x(film, to)));
    }
}

static void draw_grid(const struct film *film)
{
    double x0 = INFINITY, x1 = -INFINITY, y0 = INFINITY, y1 = -INFINITY;
    double half_width = film->width / 2 / film->scale, half_height = film->height / 2 / film->scale;

    for (size_t tick = film->first; tick <= film->last; tick++) {
        const struct scene_point *camera = film_camera_at(film, tick);
        x0 = fmin(x0, camera->x - half_width);
        x1 = fmax(x1, camera->x + half_width);
        y0 = fmin(y0, camera->y - half_height);
        y1 = fmax(y1, camera->y + half_height);
    }
    fputs("<path id=\"grid\" class=\"grid\" d=\"", film->out);
    draw_lines(film, x0, x1, y0, y1, true);
    draw_lines(film, y0, y1, x0, x1, false);
    fputs("\"/>\n", film->out);
}

/* A trail while a robot's state is one, which grows as the robot drives. */
static void draw_trail(struct film *film, const struct way *way, const char *class)
{
    double length = 0, x = 0, y = 0;
    struct track track;

    fprintf(film->out, "<path class=\"trail %s\" d=\"M", class);
    for (size_t i = 0; i < way->keys; i++) {
        const struct keyframes_point *key = way_key(way, i);
        length += i == 0 ? 0 : hypot(tenth(key->at[0]) - x, tenth(key->at[1]) - y);
        x = tenth(key->at[0]);
        y = tenth(key->at[1]);
        fprintf(film->out, "%g,%g ", x, y);
    }
    if (!film->moves || length == 0 || !film_track(film, &track)) {
        fputs("\"/>\n", film->out);
        return;
    }
    double whole = ceil(length);
    fprintf(film->out, "\" stroke-dasharray=\"%g\">", whole);
    track_key(&track, way_key(way, 0)->t, "%g", whole);
    length = 0;
    for (size_t i = 1; i < way->keys; i++) {
        const struct keyframes_point *from = way_key(way, i - 1), *to = way_key(way, i);
        length +=
            hypot(tenth(to->at[0]) - tenth(from->at[0]), tenth(to->at[1]) - tenth(from->at[1]));
        track_key(&track, to->t, "%g", tenth(whole - length));
    }
    track_close(&track, film->out, "animate attributeName=\"stroke-dashoffset\"");
    fputs("</path>\n", film->out);
}

static void draw_trails(struct film *film, size_t robot)
{
    size_t from = film->first;

    for (size_t tick = film->first + 1; tick <= film->last; tick++) {
        const char *class = robot_state(film, from, robot);
        struct way way = {0};

        if (tick < film->last && strcmp(robot_state(film, tick, robot), class) == 0)
            continue;
        if (class[0] != 'X' && way_of(film, &way, robot_pose, robot, from, tick))
            draw_trail(film, &way, class);
        way_close(&way);
        from = tick;
    }
}

static void draw_vertex(struct film *film, const struct scene_point *at, size_t vertex,
                        double radius)
{
    double x = tenth(at->x * film->scale), y = tenth(-at->y * film->scale);

    if (x == 0 && y == 0)
        return; /* the leader's own */
    fprintf(film->out, "<path class=\"spoke\" d=\"M0,0L%g,%g\"/><circle", x, y);
    write_state(film, "class", vertex_state, vertex);
    fprintf(film->out, " cx=\"%g\" cy=\"%g\" r=\"%g\">", x, y, radius);
    write_changes(film, "class", vertex_state, vertex);
    fputs("</circle>\n", film->out);
}

static void draw_shape(struct film *film, size_t shape)
{
    const struct shape *s = &film->history->shape[shape];

    if (s->count == 0)
        return;
    fputs("<g", film->out);
    write_state(film, "visibility", shape_state, shape);
    fputs(">", film->out);
    write_changes(film, "visibility", shape_state, shape);
    for (size_t j = 0; j < s->count; j++)
        draw_vertex(film, &s->vertices[j], j, film->crowd ? 6 : 16);
    fputs("</g>\n", film->out);
}

static void draw_formation(struct film *film)
{
    fputs("<g", film->out);
    write_way(film, about_pose, 0);
    fputs("<g", film->out);
    write_turns(film, about_pose, 0);
    for (size_t shape = 0; shape < film->history->shapes; shape++)
        draw_shape(film, shape);
    fputs("</g></g>\n", film->out);
}

static void draw_robot(struct film *film, size_t robot)
{
    double size = film->size;

    fputs("<g", film->out);
    write_state(film, "class", robot_state, robot);
    write_way(film, robot_pose, robot);
    write_changes(film, "class", robot_state, robot);
    fprintf(film->out, "<circle class=\"halo\" r=\"%g\"/><g", 17 * size);
    write_turns(film, robot_pose, robot);
    fprintf(film->out,
            "<use href=\"#body\"/></g><path class=\"cross\" d=\"M%g,%gl%g,%gm0,%gl%g,%g\"/>",
            -9 * size, -9 * size, 18 * size, 18 * size, -18 * size, -18 * size, 18 * size);
    if (!film->crowd)
        fprintf(film->out, "<text class=\"id\" y=\"-21\">%u</text>", film->history->id[robot]);
    fputs("</g>\n", film->out);
}

void film_arena_defs(struct film *film)
{
    fputs("<defs>\n", film->out);
    fprintf(film->out,
            "<path id=\"body\" class=\"body\" transform=\"scale(%g)\" "
            "d=\"M12,0 -8,8.5 -4,0 -8,-8.5Z\"/>\n",
            film->size);
    draw_grid(film);
    fprintf(film->out,
            "<clipPath id=\"arena\"><rect width=\"%.0f\" height=\"%.0f\"/></clipPath>\n"
            "<clipPath id=\"window\"><rect width=\"160\" height=\"30\"/></clipPath>\n",
            film->width, film->height);
    fputs("</defs>\n", film->out);
}

void film_arena(struct film *film)
{
    fputs("<g class=\"arena\">\n<g", film->out);
    write_way(film, arena_pose, 0);
    fputs("<use href=\"#grid\"/>\n", film->out);
    for (size_t i = 0; i < film->history->robots && !film->crowd; i++)
        draw_trails(film, i);
    draw_formation(film);
    for (size_t i = 0; i < film->history->robots; i++)
        draw_robot(film, i);
    fputs("</g>\n</g>\n", film->out);
}
