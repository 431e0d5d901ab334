#include "onlookers.h"

#include <stdlib.h>

static void show_scene(void *view, int32_t time_ms, const uint8_t *fleet, size_t count)
{
    view_scene(view, time_ms, fleet, count);
}

static void show_event(void *view, int32_t time_ms, const uint8_t *log, size_t count)
{
    view_event(view, time_ms, log, count);
}

struct audience onlookers_audience(struct view *view)
{
    return view == NULL ? (struct audience){0} : (struct audience){view, show_scene, show_event};
}

void onlookers_status(struct view *view, const struct steer *steer, struct view_status status)
{
    size_t room = steer->scenario->formation_count + SERVER_DRAWN_MAX;
    const char **names = calloc(room, sizeof *names);

    if (names == NULL)
        return;
    status.formation_count = drawings_names(steer->drawings, names, room);
    status.formations = names;
    view_status(view, &status);
    free(names);
}
