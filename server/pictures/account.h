/* account.h: runs told on one HTML page: numbers, figures, events. */
#ifndef ACCOUNT_H
#define ACCOUNT_H

#include "archive.h"

#include <stdio.h>

/* The page refers to nothing outside and runs no script. */
void account_write(struct archive *const *archives, size_t count, FILE *out);

#endif
