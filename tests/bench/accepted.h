/* accepted.h: the record of the exact figures as they were last accepted: a text file, a line each.
 */
#ifndef ACCEPTED_H
#define ACCEPTED_H

#include <stdbool.h>

/* Holds the figures against the record: none may be more than 2 % worse, and none may stand in
 * only one of both. Says on stderr what is wrong; true when nothing is. */
bool accepted_check(const char *path);

/* Makes the figures the record. */
void accepted_write(const char *path);

#endif
