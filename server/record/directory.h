/* directory.h: where a run leaves its files. */
#ifndef DIRECTORY_H
#define DIRECTORY_H

#include <stdbool.h>
#include <stddef.h>

/* Makes `dir` and those above it, and removes what an earlier run left there and a run need not
 * write again: trace, recording, summary and figures. False and words in `error` when there can be no such
 * directory. */
bool directory_prepare(const char *dir, char *error, size_t room);

#endif
