/* fields.h: the values of a tree, strictly typed. Each function is false after a refusal. */
#ifndef SCENARIO_FIELDS_H
#define SCENARIO_FIELDS_H

#include "expression.h"
#include "tree.h"

#include <stdint.h>

/* The numbers allowed: low to high, or above low to high. */
struct limits {
    double low, high;
    bool above;
    const char *unit; /* "" where there is none */
};

/* One key of a mapping. */
struct field {
    const char *key;
    bool required;
    bool (*read)(struct refusal *refusal, const struct node *value, const struct field *field,
                 void *into);
    size_t offset;               /* of what a reader below fills, in `into` */
    const struct limits *limits; /* for field_number */
};

/* Hands each value of a mapping to its field's reader, in the order of `fields`, which end with
 * a NULL key. A key that is no field is refused, and so is a required one that is missing. */
bool mapping_read(struct refusal *refusal, const struct node *mapping, const struct field *fields,
                  void *into);

/* Readers of a field: a double within limits, true or false. */
bool field_number(struct refusal *refusal, const struct node *value, const struct field *field,
                  void *into);
bool field_bool(struct refusal *refusal, const struct node *value, const struct field *field,
                void *into);

/* What a node is called in errors: its key, else "this". */
const char *node_title(const struct node *node);

bool is_kind(struct refusal *refusal, const struct node *node, enum node_kind kind);

/* The expression that a scalar holds. */
bool expression_read(struct refusal *refusal, const struct node *node, const char *const *names,
                     struct expression **out);

/* Whether a value that `node` gave is within limits. `when` tells of the moment, "" if none. */
bool value_judge(struct refusal *refusal, const struct node *node, double value,
                 const struct limits *limits, const char *when);

/* A number within limits. `index` is the value of i, counted from 1; 0: there is no i here. */
bool number_read(struct refusal *refusal, const struct node *node, size_t index,
                 const struct limits *limits, double *out);

/* The same without a fraction. Limits within +-2^53. */
bool integer_read(struct refusal *refusal, const struct node *node, size_t index, int64_t low,
                  int64_t high, int64_t *out);

/* `count` numbers: a list of as many, or one expression in i for all of them. */
bool numbers_read(struct refusal *refusal, const struct node *node, size_t count,
                  const struct limits *limits, double *out);

/* The position of a word in a list that ends with NULL. */
bool choice_read(struct refusal *refusal, const struct node *node, const char *const *choices,
                 unsigned *out);

/* Whole numbers low to high: a single one, ranges such as "1, 4..7", or a list of both. Calls
 * `each` with every one of them until it is false. */
bool set_read(struct refusal *refusal, const struct node *node, int64_t low, int64_t high,
              bool (*each)(struct refusal *refusal, const struct node *node, int64_t value,
                           void *into),
              void *into);

#endif
