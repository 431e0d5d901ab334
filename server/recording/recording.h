/* recording.h: run.mcap, a run as the tools of ROS 2 read it.
 *
 * MCAP (mcap.dev/spec) of profile ros2: CDR messages of the topics of topic.h, in chunks compressed
 * by zstd. A chunk is handed to the system after half a second of mission time or a second of the
 * clock on the wall, whichever comes first: a program that is killed loses no more. Log times are
 * mission times. Scenes before t = 0 are not recorded; events before it are, with a log time of 0
 * and their own in the message. */
#ifndef RECORDING_H
#define RECORDING_H

#include "scene.h"

/* Said once, as the MCAP metadata record "muster". */
struct recording_about {
    const char *scenario; /* name */
    const char *robots;   /* "avr", "native", "real" */
    uint64_t seed;
    double duration; /* s, as the scenario says */
};

struct recording;

/* Creates DIR/run.mcap. NULL and words in `error` when that fails. */
struct recording *recording_open(const char *dir, const struct recording_about *about, char *error,
                                 size_t room);

/* `fleet` is the scene already written (scene_write). What cannot be written is told at the end. */
void recording_scene(struct recording *recording, const struct scene *scene, const uint8_t *fleet,
                     size_t count);
/* `log` likewise (scene_event_write). */
void recording_event(struct recording *recording, int32_t time_ms, const uint8_t *log,
                     size_t count);

/* Hands over what has been recorded, now. */
void recording_flush(struct recording *recording);

/* Writes index and footer. False and words in `error` when anything could not be written. */
bool recording_close(struct recording *recording, char *error, size_t room);

#endif
