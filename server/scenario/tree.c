#include "tree.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool refuse(struct refusal *refusal, struct place place, const char *format, ...)
{
    char reason[1024];
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(reason, sizeof reason, format, arguments);
    va_end(arguments);
    snprintf(refusal->line, refusal->room, "%s%s%s:%u:%u: error: %s",
             place.setting ? "<--set " : "", place.source, place.setting ? ">" : "", place.line,
             place.column, reason);
    for (char *c = refusal->line; *c != '\0'; c++) {
        if ((unsigned char)*c < 0x20)
            *c = ' ';
    }
    return false;
}

bool refuse_memory(struct refusal *refusal, struct place place)
{
    return refuse(refusal, place, "not enough memory from here on");
}

struct node *node_new(enum node_kind kind, struct place place)
{
    struct node *node = calloc(1, sizeof *node);

    if (node != NULL) {
        node->kind = kind;
        node->place = place;
    }
    return node;
}

void node_append(struct node *parent, struct node *item)
{
    if (parent->last != NULL)
        parent->last->next = item;
    else
        parent->first = item;
    parent->last = item;
    parent->count++;
}

void node_clear(struct node *parent)
{
    for (struct node *item = parent->first, *next; item != NULL; item = next) {
        next = item->next;
        tree_free(item);
    }
    parent->first = parent->last = NULL;
    parent->count = 0;
}

void tree_free(struct node *root)
{
    if (root == NULL)
        return;
    node_clear(root);
    tree_free(root->key);
    free(root->text);
    free(root);
}

struct node *tree_find(const struct node *mapping, const char *key)
{
    for (struct node *value = mapping->first; value != NULL; value = value->next) {
        if (strcmp(value->key->text, key) == 0)
            return value;
    }
    return NULL;
}
