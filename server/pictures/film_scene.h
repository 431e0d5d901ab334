/* film_scene.h: what the parts of a film share. */
#ifndef FILM_SCENE_H
#define FILM_SCENE_H

#include "archive.h"
#include "story.h"
#include "track.h"

#define FILM_STORIES_MAX 40

struct film {
    FILE *out;
    const struct archive *archive;
    const struct history *history;
    size_t first, last; /* ticks */
    struct timeline timeline;
    double width, height;       /* of the arena's picture, pixels */
    double scale;               /* pixels a metre */
    double x0, y0;              /* the arena's point at the origin of pixels, m */
    bool crowd;                 /* its robots are small, and have neither names nor trails */
    double size;                /* of their bodies, 1 or less */
    struct scene_point *camera; /* tick by tick, what is in the middle of the picture, m */
    size_t stories;
    struct story story[FILM_STORIES_MAX];
    bool moves;  /* else its last moment is drawn */
    bool failed; /* no memory */
};

/* Opens a track; false, and the film has failed, when there is no memory. */
bool film_track(struct film *film, struct track *track);

/* Chooses scale and camera. False when there is no memory; film->camera is to be freed. */
bool film_camera(struct film *film);
struct scene_point *film_camera_at(const struct film *film, size_t tick);

/* The arena from above; first what of it is drawn more than once. */
void film_arena_defs(struct film *film);
void film_arena(struct film *film);

/* From one line of its grid to the next, m. */
double film_grid_step(const struct film *film);

/* Over the arena: clock and captions; who is what. */
void film_words(struct film *film);
void film_key(struct film *film);

#endif
