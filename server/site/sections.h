/* sections.h: the readers of a site's sections. Each is a field's reader (fields.h) into a struct
 * site, which has its defaults before the first one runs. */
#ifndef SITE_SECTIONS_H
#define SITE_SECTIONS_H

#include "fields.h"
#include "site.h"

bool mocap_read(struct refusal *refusal, const struct node *node, const struct field *field,
                void *site);
bool site_robots_read(struct refusal *refusal, const struct node *node, const struct field *field,
                      void *site);

/* Readers of a field, a char * at its offset: a text that is not empty, and the path of a file. A
 * path is relative to the site file's folder; on the command line it is what it is there. */
bool field_text(struct refusal *refusal, const struct node *node, const struct field *field,
                void *into);
bool field_path(struct refusal *refusal, const struct node *node, const struct field *field,
                void *into);

#endif
