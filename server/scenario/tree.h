/* tree.h: a file's values as a tree whose nodes know where they stand. */
#ifndef SCENARIO_TREE_H
#define SCENARIO_TREE_H

#include <stdbool.h>
#include <stddef.h>

/* A position, counted from 1. `source` is a file's name or a setting's text. */
struct place {
    const char *source;
    bool setting;
    unsigned line, column;
};

/* Where the reason of a refusal goes: one line, cut to fit. */
struct refusal {
    char *line;
    size_t room; /* > 0 */
};

/* Writes `source:line:column: error: ...`. Always false, to be returned. */
bool refuse(struct refusal *refusal, struct place place, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

bool refuse_memory(struct refusal *refusal, struct place place);

enum node_kind { NODE_SCALAR, NODE_LIST, NODE_MAPPING };

struct node {
    enum node_kind kind;
    struct place place;
    char *text;                /* scalar: without its quotes; "" where there is no value */
    struct node *key;          /* in a mapping: this value's key, a scalar */
    struct node *first, *last; /* list, mapping: the items, in the file's order */
    struct node *next;         /* in a list or mapping */
    size_t count;
};

/* A node without text, key or items. NULL when there is no memory. */
struct node *node_new(enum node_kind kind, struct place place);

/* The item, which belongs to the parent from now on, comes last. */
void node_append(struct node *parent, struct node *item);

/* Frees a node's items. */
void node_clear(struct node *parent);

/* The value of `key`, NULL when the mapping has none. */
struct node *tree_find(const struct node *mapping, const char *key);

/* Frees a node with all that belongs to it. */
void tree_free(struct node *root);

#endif
