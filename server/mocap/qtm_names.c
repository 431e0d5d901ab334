#include "qtm_names.h"

#include <string.h>

#define DEPTH_MAX 64
#define PATH_LENGTH 4

enum state { TEXT, ENTITY, TAG, OPENING, ATTRIBUTES, CLOSING, DECLARATION, COMMENT };

static const char *const path[PATH_LENGTH] = {NULL, "The_6D", "Body", "Name"};

void qtm_names_begin(struct qtm_names *names)
{
    memset(names, 0, sizeof *names);
}

bool qtm_names_done(const struct qtm_names *names)
{
    return names->begun && !names->failed && names->state == TEXT && names->depth == 0;
}

static bool is_space(char byte)
{
    return byte == ' ' || byte == '\t' || byte == '\r' || byte == '\n';
}

static bool in_name(const struct qtm_names *names)
{
    return names->depth == PATH_LENGTH && names->matched == PATH_LENGTH;
}

static char *newest_name(struct qtm_names *names)
{
    return names->name[names->count - 1];
}

/* Space before a name is left out here, space behind it when its element closes. */
static void keep(struct qtm_names *names, char byte)
{
    if (!in_name(names) || names->name_length == CAPTURE_NAME_MAX - 1 ||
        (is_space(byte) && names->name_length == 0))
        return;
    newest_name(names)[names->name_length++] = byte;
}

static void add_to_word(struct qtm_names *names, char byte)
{
    if (names->word_length < QTM_WORD_MAX)
        names->word[names->word_length++] = byte;
    else
        names->word_length = QTM_WORD_MAX + 1;
}

static bool word_is(const struct qtm_names *names, const char *wanted)
{
    return names->word_length == strlen(wanted) &&
           memcmp(names->word, wanted, names->word_length) == 0;
}

static void open_element(struct qtm_names *names)
{
    unsigned depth = names->depth;

    if (names->word_length == 0 || depth == DEPTH_MAX) {
        names->failed = true;
        return;
    }
    names->begun = true;
    names->depth++;
    if (depth >= PATH_LENGTH || names->matched != depth ||
        (path[depth] != NULL && !word_is(names, path[depth])))
        return;
    names->matched++;
    if (names->matched == PATH_LENGTH) {
        names->name_length = 0;
        memset(newest_name(names), 0, CAPTURE_NAME_MAX);
    } else if (names->matched == PATH_LENGTH - 1) {
        names->failed = names->count == CAPTURE_BODIES_MAX;
        names->count += !names->failed;
    }
}

static void close_element(struct qtm_names *names)
{
    if (names->depth == 0) {
        names->failed = true;
        return;
    }
    while (in_name(names) && names->name_length > 0 &&
           is_space(newest_name(names)[names->name_length - 1]))
        newest_name(names)[--names->name_length] = '\0';
    names->depth--;
    if (names->matched > names->depth)
        names->matched = names->depth;
}

static void in_text(struct qtm_names *names, char byte)
{
    names->word_length = 0;
    if (byte == '<')
        names->state = TAG;
    else if (byte == '&')
        names->state = ENTITY;
    else
        keep(names, byte);
}

static void in_entity(struct qtm_names *names, char byte)
{
    static const struct {
        const char *word;
        char stands_for;
    } entities[] = {{"amp", '&'}, {"lt", '<'}, {"gt", '>'}, {"quot", '"'}, {"apos", '\''}};

    if (byte != ';') {
        add_to_word(names, byte);
        return;
    }
    names->state = TEXT;
    for (size_t i = 0; i < sizeof entities / sizeof entities[0]; i++) {
        if (word_is(names, entities[i].word)) {
            keep(names, entities[i].stands_for);
            return;
        }
    }
    names->failed = true;
}

/* The byte behind `<`. */
static void in_tag(struct qtm_names *names, char byte)
{
    names->quote = '\0';
    names->dashes = 0;
    names->last = byte;
    switch (byte) {
    case '/': names->state = CLOSING; break;
    case '?':
    case '!': names->state = DECLARATION; break;
    default:
        names->state = OPENING;
        names->failed = is_space(byte) || byte == '>';
        add_to_word(names, byte);
    }
}

static void end_opening(struct qtm_names *names, char byte, char before)
{
    names->state = byte == '>' ? TEXT : ATTRIBUTES;
    if (byte == '>' && before == '/')
        close_element(names);
}

static void in_opening(struct qtm_names *names, char byte)
{
    if (!is_space(byte) && byte != '>' && byte != '/') {
        add_to_word(names, byte);
        return;
    }
    open_element(names);
    names->last = byte;
    end_opening(names, byte, '\0');
}

/* A bracket in quotes ends nothing. */
static void in_attributes(struct qtm_names *names, char byte)
{
    if (names->quote != '\0') {
        if (byte == names->quote)
            names->quote = '\0';
    } else if (byte == '"' || byte == '\'') {
        names->quote = byte;
    } else if (byte == '>') {
        end_opening(names, byte, names->last);
    }
    names->last = byte;
}

static void in_declaration(struct qtm_names *names, char byte)
{
    names->dashes = byte == '-' ? names->dashes + 1 : 0;
    if (names->dashes == 2 && names->last == '!')
        names->state = COMMENT;
    else if (byte == '>')
        names->state = TEXT;
    else if (byte == '[') /* entities of its own, or text that is not parsed */
        names->failed = true;
    if (names->dashes == 0)
        names->last = byte;
}

static void in_comment(struct qtm_names *names, char byte)
{
    if (byte == '>' && names->dashes >= 2)
        names->state = TEXT;
    names->dashes = byte == '-' ? names->dashes + 1 : 0;
}

static void take_byte(struct qtm_names *names, char byte)
{
    switch ((enum state)names->state) {
    case TEXT: in_text(names, byte); break;
    case ENTITY: in_entity(names, byte); break;
    case TAG: in_tag(names, byte); break;
    case OPENING: in_opening(names, byte); break;
    case ATTRIBUTES: in_attributes(names, byte); break;
    case CLOSING:
        if (byte == '>') {
            names->state = TEXT;
            close_element(names);
        }
        break;
    case DECLARATION: in_declaration(names, byte); break;
    case COMMENT: in_comment(names, byte); break;
    }
}

void qtm_names_take(struct qtm_names *names, const uint8_t *bytes, size_t count)
{
    for (size_t i = 0; i < count && !names->failed; i++)
        if (bytes[i] != '\0') /* the answer ends with one */
            take_byte(names, (char)bytes[i]);
}
