/* tree.h: a YAML file as a tree whose nodes know where they stand.
 *
 * The part of YAML 1.2 that people write by hand: one document of mappings, lists and scalars.
 * Anchors, aliases, tags and merges are refused, and so is what is not text: a tree is never
 * larger than its file. libfyaml stays behind this interface. */
#ifndef SCENARIO_TREE_H
#define SCENARIO_TREE_H

#include <stdbool.h>
#include <stddef.h>

#define TREE_BYTES_MAX (1024 * 1024)
#define TREE_DEPTH_MAX 16
#define TREE_KEYS_MAX 1000 /* of one mapping */

/* A position, counted from 1. `source` is a file's name or a setting's text. */
struct place {
    const char *source;
    bool setting;
    unsigned line, column;
};

enum node_kind { NODE_SCALAR, NODE_LIST, NODE_MAPPING };

struct node {
    enum node_kind kind;
    struct place place;
    char *text;        /* scalar: without its quotes; "" where there is no value */
    struct node *key;  /* in a mapping: this value's key, a scalar */
    struct node *first, *last; /* list, mapping: the items, in the file's order */
    struct node *next;         /* in a list or mapping */
    size_t count;
};

/* Where the reason of a refusal goes: one line, cut to fit. */
struct refusal {
    char *line;
    size_t room;
};

/* Writes `source:line:column: error: ...`. Always false, to be returned. */
bool refuse(struct refusal *refusal, struct place place, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

bool refuse_memory(struct refusal *refusal, struct place place);

/* The tree of a file's text, NULL after a refusal. `name` must outlive the tree. */
struct node *tree_parse(const char *name, const char *text, size_t length,
                        struct refusal *refusal);

/* Applies `KEY.PATH=VALUE`: puts the scalar VALUE where the path leads, over what was there.
 * A part of the path is a mapping's key, made when missing, or the index from 0 of an item that
 * the list has. `setting` must outlive the tree. */
bool tree_set(struct node *root, const char *setting, struct refusal *refusal);

/* The value of `key`, NULL when the mapping has none. */
struct node *tree_find(const struct node *mapping, const char *key);

void tree_free(struct node *root);

#endif
