#include "story.h"

#include <stdio.h>
#include <string.h>

/* By the words of events.csv; %u is the robot. */
static const struct {
    const char *event, *words;
} tales[] = {
    {"kill", "robot %u is lost"},
    {"revive", "robot %u is back"},
    {"stall", "robot %u stalls"},
    {"mute", "robot %u falls silent"},
    {"unmute", "robot %u is heard again"},
    {"drain", "robot %u\u2019s battery runs low"},
    {"loss", "beacons are lost at another rate"},
    {"delay", "beacons are late"},
    {"range", "another range"},
    {"estop", "emergency stop"},
    {"partition", "the team is cut in two"},
    {"heal", "the team is one again"},
};

/* The tick's own rows may be a little older than its events. */
#define SOON 0.06 /* s */

static bool tell_formation(const struct archive *archive, int32_t time_ms, char *words, size_t room)
{
    size_t tick = history_tick(&archive->history, time_ms / 1000.0 + SOON);
    const char *name = history_shape_at(&archive->history, tick)->name;

    snprintf(words, room, name[0] == '\0' ? "another formation" : "formation %s", name);
    return true;
}

static bool tell(const struct archive *archive, const struct incident *incident, char *words,
                 size_t room)
{
    if (strcmp(incident->event, "role") == 0 && incident->detail[0] == 'L') {
        snprintf(words, room, "robot %u leads", incident->robot);
        return true;
    }
    if (strcmp(incident->event, "formation") == 0)
        return tell_formation(archive, incident->time_ms, words, room);
    for (size_t i = 0; i < sizeof tales / sizeof tales[0]; i++) {
        if (strcmp(incident->event, tales[i].event) != 0)
            continue;
        const char *hole = strstr(tales[i].words, "%u");
        if (hole == NULL)
            snprintf(words, room, "%s", tales[i].words);
        else
            snprintf(words, room, "%.*s%u%s", (int)(hole - tales[i].words), tales[i].words,
                     incident->robot, hole + 2);
        return true;
    }
    return false;
}

size_t stories_tell(const struct archive *archive, struct story *stories, size_t most)
{
    size_t count = 0;

    for (size_t i = 0; i < archive->incident_count; i++) {
        const struct incident *incident = &archive->incidents[i];
        struct story story = {.t = incident->time_ms / 1000.0};
        if (incident->time_ms <= 0 || !tell(archive, incident, story.words, sizeof story.words))
            continue;
        if (count < most)
            stories[count] = story;
        count++;
    }
    return count;
}
