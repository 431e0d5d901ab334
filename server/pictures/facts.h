/* facts.h: the numbers of a run, in words and units. */
#ifndef FACTS_H
#define FACTS_H

#include "archive.h"

#define FACT_WORDS_MAX 96

struct fact {
    const char *words; /* what it is, with its unit */
    const char *path;  /* where it is in summary.json: "link.frames" */
    int decimals;
    bool compared; /* also where runs are set beside one another */
};

/* Ends with one that has no words. */
extern const struct fact facts[];

/* False when the run's summary.json does not say. Of a run without one, what its recording says of
 * itself, and what can be measured in its history. */
bool fact_tell(const struct fact *fact, const struct archive *archive, char *words, size_t room);

#endif
