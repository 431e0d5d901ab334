#include "setting.h"

#include "text.h"
#include "yaml.h"

#include <stdlib.h>
#include <string.h>

static struct node *scalar_new(const char *text, size_t length, struct place place)
{
    struct node *node = node_new(NODE_SCALAR, place);

    if (node == NULL)
        return NULL;
    node->text = strndup(text, length);
    if (node->text == NULL) {
        free(node);
        return NULL;
    }
    return node;
}

/* A part of a setting's path. */
struct step {
    const char *text;
    size_t length;
    struct place place;
};

static struct node *add_member(struct node *mapping, const struct step *step)
{
    struct node *key = scalar_new(step->text, step->length, step->place);
    struct node *value = node_new(NODE_MAPPING, step->place);

    if (key == NULL || value == NULL) {
        tree_free(key);
        tree_free(value);
        return NULL;
    }
    value->key = key;
    node_append(mapping, value);
    return value;
}

static struct node *member_at(struct node *mapping, const struct step *step,
                              struct refusal *refusal)
{
    for (struct node *value = mapping->first; value != NULL; value = value->next) {
        if (strlen(value->key->text) == step->length &&
            memcmp(value->key->text, step->text, step->length) == 0)
            return value;
    }
    if (mapping->count == YAML_KEYS_MAX) {
        refuse(refusal, step->place, "too many keys; %d are allowed", YAML_KEYS_MAX);
        return NULL;
    }
    struct node *value = add_member(mapping, step);
    if (value == NULL)
        refuse_memory(refusal, step->place);
    return value;
}

static struct node *item_at(struct node *list, const struct step *step, struct refusal *refusal)
{
    char digits[8] = "";
    struct node *item = list->first;

    if (step->length < sizeof digits)
        memcpy(digits, step->text, step->length);
    if (digits[0] != '\0' && digits[strspn(digits, "0123456789")] == '\0') {
        for (long index = atol(digits); index > 0 && item != NULL; index--)
            item = item->next;
        if (item != NULL)
            return item;
    }
    if (list->count == 0)
        refuse(refusal, step->place, "'%.*s' in a list that is empty", (int)step->length,
               step->text);
    else
        refuse(refusal, step->place, "'%.*s' in a list; an index from 0 to %zu is allowed",
               (int)step->length, step->text, list->count - 1);
    return NULL;
}

static struct node *follow(struct node *from, const struct step *step, struct refusal *refusal)
{
    if (step->length == 0) {
        refuse(refusal, step->place, "an empty key; KEY.PATH=VALUE is allowed");
        return NULL;
    }
    if (from->kind == NODE_MAPPING)
        return member_at(from, step, refusal);
    if (from->kind == NODE_LIST)
        return item_at(from, step, refusal);
    refuse(refusal, step->place, "'%.*s' in what is a single value", (int)step->length, step->text);
    return NULL;
}

static bool make_scalar(struct node *node, const char *text, struct place place,
                        struct refusal *refusal)
{
    char *copy = strdup(text);

    if (copy == NULL)
        return refuse_memory(refusal, place);
    node_clear(node);
    free(node->text);
    node->kind = NODE_SCALAR;
    node->text = copy;
    node->place = place;
    return true;
}

bool setting_apply(struct node *root, const char *setting, struct refusal *refusal)
{
    struct place place = {setting, true, 1, 1};
    size_t length = strlen(setting);
    const char *value = strchr(setting, '=');
    struct node *node = root;

    if (text_length(setting, length) < length)
        return refuse(refusal, place, "not text; UTF-8 is allowed");
    if (value == NULL)
        return refuse(refusal, place, "no '=' in it; KEY.PATH=VALUE is allowed");
    for (const char *part = setting; part <= value;) {
        size_t room = (size_t)(value - part);
        const char *dot = memchr(part, '.', room);
        struct step step = {part, dot != NULL ? (size_t)(dot - part) : room, place};
        step.place.column = (unsigned)(part - setting) + 1;
        node = follow(node, &step, refusal);
        if (node == NULL)
            return false;
        part += step.length + 1;
    }
    place.column = (unsigned)(value + 1 - setting) + 1;
    return make_scalar(node, value + 1, place, refusal);
}

bool settings_apply(struct node *root, const char *const *settings, size_t count,
                    struct refusal *refusal)
{
    for (size_t i = 0; i < count; i++) {
        if (!setting_apply(root, settings[i], refusal))
            return false;
    }
    return true;
}
