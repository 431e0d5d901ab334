/* Any bytes as a scenario file: it is refused with one line that says where and why, or what is
 * read of it keeps its promises. The duration is set, for a day's trajectory takes seconds. */
#include "scenario.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#define VERTICES 128

static void look_at_refusal(const char *error)
{
    assert(strncmp(error, "f.yaml:", 7) == 0 || strncmp(error, "<--set duration=1>:", 19) == 0);
    assert(strstr(error, ": error: ") != NULL);
    assert(strchr(error, '\n') == NULL);
}

static void look_at_formation(const struct scenario_formation *formation, size_t robots)
{
    size_t leaders = 0;

    assert(formation->count > 0 && formation->count <= robots && formation->count <= VERTICES);
    for (size_t i = 0; i < formation->count; i++) {
        assert(isfinite(formation->L[i]) && isfinite(formation->psi[i]));
        leaders += formation->L[i] == 0;
    }
    assert(leaders == 1);
}

static void look_at_events(const struct scenario *scenario)
{
    const struct event_view view = {0.5, 1, -1, 2};

    for (size_t i = 0; i < scenario->event_count; i++) {
        const struct event *event = &scenario->events[i];
        assert(event->at_tick >= 0 && event->at_tick <= SCENARIO_DURATION_MAX * TICKS_PER_S);
        assert(event->formation < scenario->formation_count);
        assert((event->groups != NULL) == (event->action == EVENT_PARTITION));
        if (event->when != NULL)
            event->when(event->condition, &view);
    }
}

static void look_at(const struct scenario *scenario)
{
    size_t candidates = 0;

    assert(scenario->robot_count > 0 && scenario->formation < scenario->formation_count);
    for (size_t i = 0; i < scenario->robot_count; i++) {
        assert(scenario->robots[i].id >= 1 && scenario->robots[i].id <= ROBOT_ID_MAX);
        assert(isfinite(scenario->robots[i].x + scenario->robots[i].y));
        candidates += scenario->robots[i].candidate;
    }
    assert(candidates > 0);
    for (size_t i = 0; i < scenario->formation_count; i++)
        look_at_formation(&scenario->formations[i], scenario->robot_count);
    look_at_events(scenario);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const settings[] = {"duration=1"};
    char error[512] = "";
    struct scenario *scenario = scenario_parse("f.yaml", (const char *)data, size, settings, 1,
                                               VERTICES, error, sizeof error);

    if (scenario == NULL)
        look_at_refusal(error);
    else
        look_at(scenario);
    scenario_free(scenario);
    return 0;
}
