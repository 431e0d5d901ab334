#include "parameter_file.h"

#include "fields.h"
#include "limits.h"
#include "reading.h"
#include "yaml.h"

#include <errno.h>
#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A field's offset is the parameter's index. */
static bool read_parameter(struct refusal *refusal, const struct node *node,
                           const struct field *field, void *into)
{
    static const struct limits finite = {-DBL_MAX, DBL_MAX, false, ""};
    struct parameter_entry *entry = into;
    uint8_t index = (uint8_t)field->offset;
    double number;
    char reason[160];

    if (!number_read(refusal, node, 0, &finite, &number))
        return false;
    if (!parameter_round(index, number, &entry->parameters.value[index], reason, sizeof reason))
        return refuse(refusal, node->place, "%s", reason);
    entry->given |= UINT32_C(1) << index;
    return true;
}

static bool read_id(struct refusal *refusal, const struct node *node, const struct field *field,
                    void *into)
{
    int64_t id;

    return integer_read(refusal, node, 0, 1, ROBOT_ID_MAX, &id) &&
           read_parameter(refusal, node, field, into);
}

#define STORED_FIELD(symbol, name, ...)                                                            \
    {name, PARAMETER_##symbol == PARAMETER_ID,                                                     \
     PARAMETER_##symbol == PARAMETER_ID ? read_id : read_parameter, PARAMETER_##symbol, NULL},

/* The last one stays without a key. */
static const struct field entry_fields[PARAMETERS_STORED_COUNT + 1] = {
    PARAMETERS_STORED(STORED_FIELD)};

const struct parameter_entry *parameter_file_find(const struct parameter_file *file, uint16_t id)
{
    for (size_t i = 0; i < file->count; i++)
        if (file->robots[i].parameters.value[PARAMETER_ID] == id)
            return &file->robots[i];
    return NULL;
}

static bool add_entry(struct refusal *refusal, const struct node *node, struct parameter_file *file)
{
    struct parameter_entry entry = {.given = 0};

    parameters_default(&entry.parameters);
    if (!mapping_read(refusal, node, entry_fields, &entry))
        return false;
    uint16_t id = entry.parameters.value[PARAMETER_ID];
    if (parameter_file_find(file, id) != NULL)
        return refuse(refusal, tree_find(node, "id")->place,
                      "two robots with the id %u; each has its own", id);
    file->robots[file->count++] = entry;
    return true;
}

static bool read_robots(struct refusal *refusal, const struct node *node, const struct field *field,
                        void *into)
{
    struct parameter_file *file = into;

    (void)field;
    if (!is_kind(refusal, node, NODE_LIST))
        return false;
    if (node->count == 0 || node->count > ROBOT_ID_MAX)
        return refuse(refusal, node->place, "%zu robots; 1 to %u are allowed", node->count,
                      ROBOT_ID_MAX);
    file->robots = calloc(node->count, sizeof *file->robots);
    if (file->robots == NULL)
        return refuse_memory(refusal, node->place);
    for (const struct node *item = node->first; item != NULL; item = item->next)
        if (!add_entry(refusal, item, file))
            return false;
    return true;
}

static const struct field file_fields[] = {
    {"schema", true, schema_read, 0, NULL},
    {"robots", true, read_robots, 0, NULL},
    {NULL, false, NULL, 0, NULL},
};

/* Takes the tree. */
static struct parameter_file *file_of(struct refusal *refusal, struct node *root)
{
    struct parameter_file *file = root != NULL ? calloc(1, sizeof *file) : NULL;

    if (root == NULL)
        return NULL;
    if (file == NULL)
        refuse_memory(refusal, root->place);
    else if (!mapping_read(refusal, root, file_fields, file)) {
        parameter_file_free(file);
        file = NULL;
    }
    tree_free(root);
    return file;
}

struct parameter_file *parameter_file_parse(const char *name, const char *text, size_t length,
                                            char *error, size_t room)
{
    struct refusal refusal = {error, room};

    return file_of(&refusal, yaml_parse(name, text, length, &refusal));
}

struct parameter_file *parameter_file_read(const char *path, char *error, size_t room)
{
    struct refusal refusal = {error, room};

    return file_of(&refusal, yaml_read_file(path, &refusal));
}

static void write_entry(FILE *out, const struct parameter_entry *entry)
{
    const char *lead = "  - ";
    char number[PARAMETER_WORDS_MAX];

    for (uint8_t i = 0; i < PARAMETERS_STORED_COUNT; i++) {
        if ((entry->given >> i & 1) == 0)
            continue;
        fprintf(out, "%s%s: %s\n", lead, parameter_line(i)->name,
                parameter_number(i, entry->parameters.value[i], number));
        lead = "    ";
    }
}

bool parameter_file_write(const char *path, const struct parameter_entry *robots, size_t count,
                          char *error, size_t room)
{
    FILE *out = fopen(path, "w");

    if (out == NULL) {
        snprintf(error, room, "%s: cannot be written: %s", path, strerror(errno));
        return false;
    }
    fputs("schema: 1\nrobots:\n", out);
    for (size_t i = 0; i < count; i++)
        write_entry(out, &robots[i]);
    bool good = ferror(out) == 0;
    if (fclose(out) == 0 && good)
        return true;
    snprintf(error, room, "%s: cannot be written: %s", path, strerror(errno));
    return false;
}

void parameter_file_free(struct parameter_file *file)
{
    if (file == NULL)
        return;
    free(file->robots);
    free(file);
}
