#include "yaml.h"

#include "text.h"

#include <errno.h>
#include <libfyaml.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* One pass over a file. */
struct pass {
    struct fy_parser *parser;
    struct fy_diag *diag;
    struct place place; /* of the event last seen that has one */
    struct refusal *refusal;
};

static void refuse_syntax(struct pass *pass)
{
    void *state = NULL;
    struct fy_diag_error *error = fy_diag_errors_iterate(pass->diag, &state);

    if (error != NULL && error->line > 0 && error->column > 0) {
        pass->place.line = (unsigned)error->line;
        pass->place.column = (unsigned)error->column;
    }
    refuse(pass->refusal, pass->place, "not YAML: %s",
           error != NULL && error->msg != NULL ? error->msg : "the text ends too early");
}

/* libfyaml's mark of a quoted scalar or an alias stands behind the quote or asterisk. */
static bool is_marked_inside(struct fy_event *event)
{
    if (event->type != FYET_SCALAR)
        return event->type == FYET_ALIAS;
    enum fy_scalar_style style = fy_token_scalar_style(event->scalar.value);
    return style == FYSS_SINGLE_QUOTED || style == FYSS_DOUBLE_QUOTED;
}

/* The next event, NULL after a refusal. */
static struct fy_event *next_event(struct pass *pass)
{
    struct fy_event *event = fy_parser_parse(pass->parser);

    if (event == NULL || fy_parser_get_stream_error(pass->parser)) {
        refuse_syntax(pass);
        fy_parser_event_free(pass->parser, event);
        return NULL;
    }
    const struct fy_mark *mark = fy_event_start_mark(event);
    if (mark != NULL) {
        pass->place.line = (unsigned)mark->line + 1;
        pass->place.column = (unsigned)mark->column + 1 - is_marked_inside(event);
    }
    return event;
}

static struct node *read_value(struct pass *pass, struct fy_event *event, unsigned depth);

/* A scalar's text, put together here: libfyaml 0.7.12 leaks where it does that itself. */
static char *copy_text(struct fy_token *token, size_t *length)
{
    size_t room = token != NULL ? fy_token_get_text_length(token) : 0;
    char *text = room <= YAML_BYTES_MAX ? malloc(room + 1) : NULL;
    struct fy_token_iter *pieces = room > 0 && text != NULL ? fy_token_iter_create(token) : NULL;
    const struct fy_iter_chunk *piece = NULL;
    int error = 0;

    *length = 0;
    while (pieces != NULL && (piece = fy_token_iter_chunk_next(pieces, piece, &error)) != NULL) {
        size_t count = piece->len < room - *length ? piece->len : room - *length;
        memcpy(text + *length, piece->str, count);
        *length += count;
    }
    fy_token_iter_destroy(pieces);
    if (text != NULL)
        text[*length] = '\0';
    return text;
}

static struct node *read_scalar(struct pass *pass, struct fy_event *event)
{
    struct node *node = node_new(NODE_SCALAR, pass->place);
    size_t length = 0;

    if (node != NULL)
        node->text = copy_text(event->scalar.value, &length);
    if (node == NULL || node->text == NULL)
        refuse_memory(pass->refusal, pass->place);
    else if (text_length(node->text, length) < length)
        refuse(pass->refusal, pass->place, "a control character; text is allowed");
    else
        return node;
    tree_free(node);
    return NULL;
}

static bool read_item(struct pass *pass, struct node *list, struct fy_event *event, unsigned depth)
{
    struct node *item = read_value(pass, event, depth);

    if (item == NULL)
        return false;
    node_append(list, item);
    return true;
}

static bool judge_key(struct pass *pass, const struct node *mapping, const struct node *key)
{
    if (key->kind != NODE_SCALAR)
        return refuse(pass->refusal, key->place, "a key is a single word");
    if (mapping->count == YAML_KEYS_MAX)
        return refuse(pass->refusal, key->place, "too many keys; %d are allowed", YAML_KEYS_MAX);

    const struct node *before = tree_find(mapping, key->text);
    if (before != NULL)
        return refuse(pass->refusal, key->place,
                      "'%.60s' stands here twice, first in line %u; once is allowed", key->text,
                      before->key->place.line);
    return true;
}

static bool read_member(struct pass *pass, struct node *mapping, struct fy_event *event,
                        unsigned depth)
{
    struct node *key = read_value(pass, event, depth);

    if (key == NULL)
        return false;
    struct fy_event *next = judge_key(pass, mapping, key) ? next_event(pass) : NULL;
    struct node *value = next != NULL ? read_value(pass, next, depth) : NULL;
    if (value == NULL) {
        tree_free(key);
        return false;
    }
    value->key = key;
    node_append(mapping, value);
    return true;
}

static struct node *read_items(struct pass *pass, enum node_kind kind, unsigned depth)
{
    enum fy_event_type end = kind == NODE_LIST ? FYET_SEQUENCE_END : FYET_MAPPING_END;
    struct node *parent = node_new(kind, pass->place);

    if (parent == NULL) {
        refuse_memory(pass->refusal, pass->place);
        return NULL;
    }
    for (;;) {
        struct fy_event *event = next_event(pass);
        if (event != NULL && event->type == end) {
            fy_parser_event_free(pass->parser, event);
            return parent;
        }
        bool read = event != NULL && (kind == NODE_LIST ? read_item(pass, parent, event, depth)
                                                        : read_member(pass, parent, event, depth));
        if (!read) {
            tree_free(parent);
            return NULL;
        }
    }
}

static bool judge_event(struct pass *pass, struct fy_event *event, unsigned depth)
{
    if (event->type == FYET_ALIAS || fy_event_get_anchor_token(event) != NULL)
        return refuse(pass->refusal, pass->place,
                      "anchors and aliases are not allowed; quote a text that begins with & or *");
    if (fy_event_get_tag_token(event) != NULL)
        return refuse(pass->refusal, pass->place,
                      "tags are not allowed; quote a text that begins with !");
    if (depth > YAML_DEPTH_MAX)
        return refuse(pass->refusal, pass->place, "nested too deep; %d levels are allowed",
                      YAML_DEPTH_MAX);
    return true;
}

/* The value that begins with `event`, which is freed; NULL after a refusal. */
static struct node *read_value(struct pass *pass, struct fy_event *event, unsigned depth)
{
    struct node *node = NULL;
    enum fy_event_type type = event->type;

    if (judge_event(pass, event, depth)) {
        if (type == FYET_SCALAR)
            node = read_scalar(pass, event);
        else
            node =
                read_items(pass, type == FYET_SEQUENCE_START ? NODE_LIST : NODE_MAPPING, depth + 1);
    }
    fy_parser_event_free(pass->parser, event);
    return node;
}

/* Passes over what surrounds the value; true when `type` was met, false after a refusal or when
 * the text ended before. */
static bool skip_to(struct pass *pass, enum fy_event_type wanted, bool *ended)
{
    for (;;) {
        struct fy_event *event = next_event(pass);
        if (event == NULL)
            return false;
        enum fy_event_type type = event->type;
        fy_parser_event_free(pass->parser, event);
        if (type == wanted)
            return true;
        if (type == FYET_STREAM_END) {
            *ended = true;
            return false;
        }
    }
}

static struct node *read_document(struct pass *pass)
{
    bool ended = false;

    if (!skip_to(pass, FYET_DOCUMENT_START, &ended)) {
        if (ended)
            refuse(pass->refusal, pass->place, "nothing in it; a mapping of keys is allowed");
        return NULL;
    }
    struct fy_event *event = next_event(pass);
    struct node *root = event != NULL ? read_value(pass, event, 1) : NULL;
    if (root == NULL)
        return NULL;
    if (skip_to(pass, FYET_DOCUMENT_START, &ended))
        refuse(pass->refusal, pass->place, "a second document; one is allowed");
    if (ended)
        return root;
    tree_free(root);
    return NULL;
}

static bool judge_bytes(const char *name, const char *text, size_t length, struct refusal *refusal)
{
    struct place place = {name, false, 1, 1};

    if (length > YAML_BYTES_MAX)
        return refuse(refusal, place, "longer than the %d bytes allowed", YAML_BYTES_MAX);

    size_t good = text_length(text, length);
    if (good == length)
        return true;
    for (size_t i = 0; i < good; i++) {
        place.column++;
        if (text[i] == '\n') {
            place.line++;
            place.column = 1;
        }
    }
    return refuse(refusal, place, "not text: byte 0x%02X; UTF-8 is allowed",
                  (unsigned char)text[good]);
}

static struct node *parse(struct pass *pass, const char *text, size_t length)
{
    struct fy_parse_cfg config = {
        .flags = FYPCF_QUIET | FYPCF_DEFAULT_VERSION_1_2,
        .diag = pass->diag,
    };

    pass->parser = fy_parser_create(&config);
    if (pass->parser == NULL || fy_parser_set_string(pass->parser, text, length) != 0) {
        refuse_memory(pass->refusal, pass->place);
        return NULL;
    }
    return read_document(pass);
}

struct node *yaml_parse(const char *name, const char *text, size_t length, struct refusal *refusal)
{
    struct pass pass = {.place = {name, false, 1, 1}, .refusal = refusal};
    struct fy_diag_cfg config;

    if (!judge_bytes(name, text, length, refusal))
        return NULL;
    fy_diag_cfg_default(&config);
    config.fp = NULL;
    pass.diag = fy_diag_create(&config);
    if (pass.diag == NULL) {
        refuse_memory(refusal, pass.place);
        return NULL;
    }
    fy_diag_set_collect_errors(pass.diag, true);
    struct node *root = parse(&pass, text, length);
    fy_parser_destroy(pass.parser);
    fy_diag_destroy(pass.diag);
    return root;
}

struct node *yaml_read_file(const char *path, struct refusal *refusal)
{
    struct place start = {path, false, 1, 1};
    struct node *root = NULL;
    size_t size = YAML_BYTES_MAX + 1; /* one more than allowed shows that there is more */
    char *text = malloc(size);
    FILE *file = fopen(path, "rb");

    if (text == NULL)
        refuse_memory(refusal, start);
    else if (file == NULL)
        refuse(refusal, start, "cannot be opened: %s", strerror(errno));
    else {
        size_t length = fread(text, 1, size, file);
        if (ferror(file))
            refuse(refusal, start, "cannot be read: %s", strerror(errno));
        else
            root = yaml_parse(path, text, length, refusal);
    }
    if (file != NULL)
        fclose(file);
    free(text);
    return root;
}
