/* film_camera.c: which part of the arena is shown, and how large. */
#include "film_scene.h"

#include <math.h>
#include <stdlib.h>

#define MARGIN 48.0     /* pixels about the team */
#define SCALE_MAX 200.0 /* pixels a metre */
#define OVERVIEW 0.5    /* of the scale that following has is enough to show everything at once */
#define CALM 0.5        /* s of the picture, before and after, over which the camera is averaged */

struct box {
    double x0, x1, y0, y1;
};

static void include(struct box *box, double x, double y)
{
    box->x0 = fmin(box->x0, x);
    box->x1 = fmax(box->x1, x);
    box->y0 = fmin(box->y0, y);
    box->y1 = fmax(box->y1, y);
}

/* Where a vertex of the formation in force is, m. */
static struct scene_point place_vertex(const struct film *film, size_t tick, size_t vertex)
{
    const struct scene_pose *about = &film->history->moments[tick].about;
    const struct scene_point *at = &history_shape_at(film->history, tick)->vertices[vertex];

    return (struct scene_point){about->x + cos(about->theta) * at->x - sin(about->theta) * at->y,
                                about->y + sin(about->theta) * at->x + cos(about->theta) * at->y};
}

/* What has to be in sight at a tick: who lives, and where they should be. */
static void include_team(struct box *box, const struct film *film, size_t tick)
{
    for (size_t i = 0; i < film->history->robots; i++) {
        const struct glimpse *g = history_at(film->history, tick, i);
        if (g->alive)
            include(box, g->x, g->y);
    }
    for (size_t j = 0; j < history_shape_at(film->history, tick)->count; j++) {
        struct scene_point at = place_vertex(film, tick, j);
        include(box, at.x, at.y);
    }
}

static struct box box_of(const struct film *film, size_t first, size_t last)
{
    struct box box = {INFINITY, -INFINITY, INFINITY, -INFINITY};

    for (size_t tick = first; tick <= last; tick++)
        include_team(&box, film, tick);
    for (size_t i = 0; i < film->history->robots && box.x0 > box.x1; i++) {
        const struct glimpse *g = history_at(film->history, last, i); /* nobody lives */
        include(&box, g->x, g->y);
    }
    return box;
}

struct scene_point *film_camera_at(const struct film *film, size_t tick)
{
    return &film->camera[tick - film->first];
}

/* The largest scale at which a box of this size is in the picture. */
static double scale_for(const struct film *film, double width, double height)
{
    return fmin(SCALE_MAX, fmin((film->width - 2 * MARGIN) / fmax(width, 1e-3),
                                (film->height - 2 * MARGIN) / fmax(height, 1e-3)));
}

/* The middle of the team, averaged over some time. */
static void follow_team(struct film *film, const struct scene_point *sums)
{
    double speed = (film->timeline.to - film->timeline.from) / film->timeline.play;
    size_t count = film->last - film->first + 1;
    double period = (film->timeline.to - film->timeline.from) / (double)count;
    size_t half = (size_t)(CALM * speed / period);

    for (size_t i = 0; i < count; i++) {
        size_t reach = half < i ? half : i;
        size_t from = i - reach, to = i + half < count ? i + half : count - 1;
        double n = (double)(to + 1 - from);
        film->camera[i] = (struct scene_point){(sums[to + 1].x - sums[from].x) / n,
                                               (sums[to + 1].y - sums[from].y) / n};
    }
}

/* How far the team comes from the middle of the picture. */
static struct scene_point reach_of(const struct film *film)
{
    struct scene_point reach = {0, 0};

    for (size_t tick = film->first; tick <= film->last; tick++) {
        struct box box = box_of(film, tick, tick);
        const struct scene_point *camera = film_camera_at(film, tick);
        reach.x = fmax(reach.x, fmax(box.x1 - camera->x, camera->x - box.x0));
        reach.y = fmax(reach.y, fmax(box.y1 - camera->y, camera->y - box.y0));
    }
    return reach;
}

static void stand_still(struct film *film, const struct box *all)
{
    for (size_t tick = film->first; tick <= film->last; tick++)
        *film_camera_at(film, tick) =
            (struct scene_point){(all->x0 + all->x1) / 2, (all->y0 + all->y1) / 2};
}

static void sum_middles(const struct film *film, struct scene_point *sums)
{
    for (size_t tick = film->first; tick <= film->last; tick++) {
        struct scene_point *sum = &sums[tick - film->first];
        struct box box = box_of(film, tick, tick);
        sum[1] =
            (struct scene_point){sum->x + (box.x0 + box.x1) / 2, sum->y + (box.y0 + box.y1) / 2};
    }
}

/* Either all that is shown is in the picture all the time, or the camera goes with the team. */
bool film_camera(struct film *film)
{
    size_t count = film->last - film->first + 1;
    struct scene_point *sums = calloc(count + 1, sizeof *sums);

    film->camera = calloc(count, sizeof *film->camera);
    if (sums == NULL || film->camera == NULL) {
        free(sums);
        return false;
    }
    sum_middles(film, sums);
    follow_team(film, sums);
    free(sums);
    struct scene_point reach = reach_of(film);
    struct box all = box_of(film, film->first, film->last);
    double overview = scale_for(film, all.x1 - all.x0, all.y1 - all.y0);

    film->scale = scale_for(film, 2 * reach.x, 2 * reach.y);
    if (overview >= OVERVIEW * film->scale) {
        film->scale = overview;
        stand_still(film, &all);
    }
    film->x0 = film->camera[0].x;
    film->y0 = film->camera[0].y;
    return true;
}
