#include "fields.h"

#include "text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define KEYS_MAX 24

static const char *const no_names[] = {NULL};
static const char *const index_names[] = {"i", NULL};

const char *node_title(const struct node *node)
{
    return node->key != NULL ? node->key->text : "the value";
}

static const char *describe(enum node_kind kind)
{
    switch (kind) {
    case NODE_LIST: return "a list [...]";
    case NODE_MAPPING: return "a mapping of keys";
    case NODE_SCALAR: break;
    }
    return "a single value";
}

bool is_kind(struct refusal *refusal, const struct node *node, enum node_kind kind)
{
    if (node->kind == kind)
        return true;
    bool empty = node->kind == NODE_SCALAR && node->text[0] == '\0';
    return refuse(refusal, node->place, "%.60s is %s; %s is allowed", node_title(node),
                  empty ? "empty" : describe(node->kind), describe(kind));
}

static const char *list_keys(const struct field *fields, char *list, size_t room)
{
    list[0] = '\0';
    for (; fields->key != NULL; fields++) {
        strncat(list, fields->key, room - strlen(list) - 1);
        if (fields[1].key != NULL)
            strncat(list, ", ", room - strlen(list) - 1);
    }
    return list;
}

static bool refuse_key(struct refusal *refusal, const struct node *key, const struct field *fields)
{
    const char *known[KEYS_MAX + 1];
    char list[256];
    size_t count = 0;

    for (; fields[count].key != NULL && count < KEYS_MAX; count++)
        known[count] = fields[count].key;
    known[count] = NULL;

    const char *nearest = text_nearest(key->text, known);
    return refuse(refusal, key->place, "unknown key '%.60s'%s%s%s; %s are allowed", key->text,
                  nearest != NULL ? ", perhaps '" : "", nearest != NULL ? nearest : "",
                  nearest != NULL ? "'" : "", list_keys(fields, list, sizeof list));
}

static bool know_all(struct refusal *refusal, const struct node *mapping,
                     const struct field *fields)
{
    for (const struct node *value = mapping->first; value != NULL; value = value->next) {
        const struct field *field = fields;
        while (field->key != NULL && strcmp(field->key, value->key->text) != 0)
            field++;
        if (field->key == NULL)
            return refuse_key(refusal, value->key, fields);
    }
    return true;
}

bool mapping_read(struct refusal *refusal, const struct node *mapping, const struct field *fields,
                  void *into)
{
    if (!is_kind(refusal, mapping, NODE_MAPPING) || !know_all(refusal, mapping, fields))
        return false;
    for (const struct field *field = fields; field->key != NULL; field++) {
        const struct node *value = tree_find(mapping, field->key);
        char list[256];
        if (value == NULL && field->required)
            return refuse(refusal, mapping->place, "the key '%s' is missing; %s are allowed",
                          field->key, list_keys(fields, list, sizeof list));
        if (value != NULL && !field->read(refusal, value, field, into))
            return false;
    }
    return true;
}

bool field_number(struct refusal *refusal, const struct node *value, const struct field *field,
                  void *into)
{
    return number_read(refusal, value, 0, field->limits, (double *)((char *)into + field->offset));
}

bool field_bool(struct refusal *refusal, const struct node *value, const struct field *field,
                void *into)
{
    static const char *const choices[] = {"false", "true", NULL};
    unsigned choice;

    if (!choice_read(refusal, value, choices, &choice))
        return false;
    *(bool *)((char *)into + field->offset) = choice == 1;
    return true;
}

static bool compile(struct refusal *refusal, const struct node *node, const char *text,
                    const char *const *names, struct expression **out)
{
    char reason[512];

    *out = expression_new(text, names, reason, sizeof reason);
    if (*out != NULL)
        return true;
    if (text[0] == '\0')
        return refuse(refusal, node->place, "%.60s is empty; a number or an expression is allowed",
                      node_title(node));
    return refuse(refusal, node->place, "%.60s is '%.100s', no number or expression: %s",
                  node_title(node), text, reason);
}

bool expression_read(struct refusal *refusal, const struct node *node, const char *const *names,
                     struct expression **out)
{
    return is_kind(refusal, node, NODE_SCALAR) && compile(refusal, node, node->text, names, out);
}

bool value_judge(struct refusal *refusal, const struct node *node, double value,
                 const struct limits *limits, const char *when)
{
    char number[32];
    bool low = limits->above ? value > limits->low : value >= limits->low;

    if (low && value <= limits->high)
        return true;
    snprintf(number, sizeof number, "%.10g", value);
    return refuse(refusal, node->place, "%.60s is %s%s; a number %s %.10g %s %.10g%s%s is allowed",
                  node_title(node), isnan(value) ? "undefined" : number, when,
                  limits->above ? "above" : "from", limits->low, limits->above ? "up to" : "to",
                  limits->high, limits->unit[0] != '\0' ? " " : "", limits->unit);
}

static bool compute(struct refusal *refusal, const struct node *node, const char *text,
                    size_t index, double *out)
{
    struct expression *expression;
    double i = (double)index;

    if (!compile(refusal, node, text, index > 0 ? index_names : no_names, &expression))
        return false;
    *out = expression_value(expression, &i);
    expression_free(expression);
    return true;
}

bool number_read(struct refusal *refusal, const struct node *node, size_t index,
                 const struct limits *limits, double *out)
{
    return is_kind(refusal, node, NODE_SCALAR) && compute(refusal, node, node->text, index, out) &&
           value_judge(refusal, node, *out, limits, "");
}

static bool to_integer(struct refusal *refusal, const struct node *node, double value, int64_t low,
                       int64_t high, int64_t *out)
{
    bool good = value >= (double)low && value <= (double)high && floor(value) == value;

    if (!good && low == high)
        return refuse(refusal, node->place, "%.60s is %.10g; %lld is allowed", node_title(node),
                      value, (long long)low);
    if (!good)
        return refuse(refusal, node->place,
                      "%.60s is %.10g; a whole number from %lld to %lld is allowed",
                      node_title(node), value, (long long)low, (long long)high);
    *out = (int64_t)value;
    return true;
}

bool integer_read(struct refusal *refusal, const struct node *node, size_t index, int64_t low,
                  int64_t high, int64_t *out)
{
    double value;

    return is_kind(refusal, node, NODE_SCALAR) &&
           compute(refusal, node, node->text, index, &value) &&
           to_integer(refusal, node, value, low, high, out);
}

static bool read_list(struct refusal *refusal, const struct node *node, size_t count,
                      const struct limits *limits, double *out)
{
    size_t index = 0;

    if (node->count != count)
        return refuse(refusal, node->place, "%.60s holds %zu numbers; %zu are allowed",
                      node_title(node), node->count, count);
    for (const struct node *item = node->first; item != NULL; item = item->next, index++) {
        if (!number_read(refusal, item, index + 1, limits, &out[index]))
            return false;
    }
    return true;
}

bool numbers_read(struct refusal *refusal, const struct node *node, size_t count,
                  const struct limits *limits, double *out)
{
    struct expression *expression;
    bool good = true;

    if (node->kind == NODE_LIST)
        return read_list(refusal, node, count, limits, out);
    if (!expression_read(refusal, node, index_names, &expression))
        return false;
    for (size_t index = 0; index < count && good; index++) {
        out[index] = expression_value(expression, &(double){(double)(index + 1)});
        good = value_judge(refusal, node, out[index], limits, "");
    }
    expression_free(expression);
    return good;
}

bool choice_read(struct refusal *refusal, const struct node *node, const char *const *choices,
                 unsigned *out)
{
    char list[128] = "";

    if (!is_kind(refusal, node, NODE_SCALAR))
        return false;
    for (unsigned i = 0; choices[i] != NULL; i++) {
        if (strcmp(node->text, choices[i]) == 0) {
            *out = i;
            return true;
        }
        if (i > 0)
            strncat(list, ", ", sizeof list - strlen(list) - 1);
        strncat(list, choices[i], sizeof list - strlen(list) - 1);
    }
    return refuse(refusal, node->place, "%.60s is '%.60s'; allowed: %s", node_title(node),
                  node->text, list);
}

/* What set_read() works with. */
struct set {
    const struct node *node;
    int64_t low, high;
    bool (*each)(struct refusal *, const struct node *, int64_t, void *);
    void *into;
};

static bool read_bound(struct refusal *refusal, const struct set *set, const char *text,
                       int64_t *out)
{
    double value;

    return compute(refusal, set->node, text, 0, &value) &&
           to_integer(refusal, set->node, value, set->low, set->high, out);
}

/* "7" or "4..7"; writes into `text`. */
static bool read_range(struct refusal *refusal, const struct set *set, char *text)
{
    char *dots = strstr(text, "..");
    int64_t first, last;

    if (dots != NULL)
        *dots = '\0';
    if (!read_bound(refusal, set, text, &first))
        return false;
    last = first;
    if (dots != NULL && !read_bound(refusal, set, dots + 2, &last))
        return false;
    if (last < first)
        return refuse(refusal, set->node->place,
                      "%lld..%lld runs backwards; FIRST..LAST is allowed", (long long)first,
                      (long long)last);
    for (; first <= last; first++) {
        if (!set->each(refusal, set->node, first, set->into))
            return false;
    }
    return true;
}

static bool read_ranges(struct refusal *refusal, const struct set *set)
{
    for (const char *part = set->node->text;; part++) {
        size_t length = strcspn(part, ",");
        char *copy = strndup(part, length);
        bool good = copy != NULL ? read_range(refusal, set, copy)
                                 : refuse_memory(refusal, set->node->place);
        free(copy);
        part += length;
        if (!good || *part == '\0')
            return good;
    }
}

bool set_read(struct refusal *refusal, const struct node *node, int64_t low, int64_t high,
              bool (*each)(struct refusal *refusal, const struct node *node, int64_t value,
                           void *into),
              void *into)
{
    struct set set = {node, low, high, each, into};

    if (node->kind != NODE_LIST)
        return is_kind(refusal, node, NODE_SCALAR) && read_ranges(refusal, &set);
    for (set.node = node->first; set.node != NULL; set.node = set.node->next) {
        if (!is_kind(refusal, set.node, NODE_SCALAR) || !read_ranges(refusal, &set))
            return false;
    }
    return true;
}
