/* yaml.h: from YAML text to a tree.
 *
 * The part of YAML 1.2 that people write by hand: one document of mappings, lists and scalars.
 * Anchors, aliases and tags are refused, and so is what is not text: a tree is never larger than
 * its file. libfyaml stays behind this interface. */
#ifndef SCENARIO_YAML_H
#define SCENARIO_YAML_H

#include "tree.h"

#define YAML_BYTES_MAX (1024 * 1024)
#define YAML_DEPTH_MAX 16
#define YAML_KEYS_MAX 1000 /* of one mapping */

/* The tree of a file's text, NULL after a refusal. `name` must outlive the tree. */
struct node *yaml_parse(const char *name, const char *text, size_t length, struct refusal *refusal);

/* The same of a file. `path` must outlive the tree. */
struct node *yaml_read_file(const char *path, struct refusal *refusal);

#endif
