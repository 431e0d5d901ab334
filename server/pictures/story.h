/* story.h: what befell a team, in a few words each, for captions and along a time's axis. */
#ifndef STORY_H
#define STORY_H

#include "archive.h"

#define STORY_WORDS_MAX 96

/* "robot 1 is lost", "robot 2 leads", "formation G2". */
struct story {
    double t; /* s */
    char words[STORY_WORDS_MAX];
};

/* The first `most` of those after t = 0; returns how many there are. What only a log tells of is
 * none: who takes which vertex, for one. */
size_t stories_tell(const struct archive *archive, struct story *stories, size_t most);

#endif
