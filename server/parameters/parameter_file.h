/* parameter_file.h: stored parameters of robots in a file, as strict as a scenario:
 *
 *   schema: 1
 *   robots:
 *     - id: 1
 *       left_gain: 0.95300
 *       right_dead_band: 0.0310
 *
 * Names, units and ranges are those of parameter_table.h; numbers may be expressions
 * (expression.h). Every robot has an id of its own from 1 to 65,534, and stands here once. */
#ifndef PARAMETER_FILE_H
#define PARAMETER_FILE_H

#include "parameter_words.h"
#include "parameters.h"

/* What is said of one robot. */
struct parameter_entry {
    struct parameters parameters; /* what is not given is at its default */
    uint32_t given;               /* bit i: index i is given; that of PARAMETER_ID always */
};

struct parameter_file {
    size_t count;
    struct parameter_entry *robots; /* in the file's order */
};

/* NULL when it is refused: `error` then holds the one line to print,
 * `file:line:column: error: what, and what is allowed`. */
struct parameter_file *parameter_file_read(const char *path, char *error, size_t room);

/* The same from memory; `name` stands for the file in the error. */
struct parameter_file *parameter_file_parse(const char *name, const char *text, size_t length,
                                            char *error, size_t room);

/* NULL when the file says nothing of it. */
const struct parameter_entry *parameter_file_find(const struct parameter_file *file, uint16_t id);

/* Writes what is given of each, in place of an earlier file. False, and words in `error`, when it
 * cannot. */
bool parameter_file_write(const char *path, const struct parameter_entry *robots, size_t count,
                          char *error, size_t room);

void parameter_file_free(struct parameter_file *file);

#endif
