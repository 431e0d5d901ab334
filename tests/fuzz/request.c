/* Any text of a viewer's: without the very token no act comes out of it, and what comes out with it
 * is within what act.h promises. */
#include "request.h"

#include "limits.h"

#include <assert.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define TOKEN_MAX 100

/* The token that the text has, if any. */
static void find_token(const char *text, size_t size, char token[TOKEN_MAX])
{
    json_t *request = json_loadb(text, size, 0, NULL);
    const char *given = json_string_value(json_object_get(request, "token"));

    snprintf(token, TOKEN_MAX, "%s", given != NULL ? given : "");
    json_decref(request);
}

static bool is_name(const char *name)
{
    size_t length = strnlen(name, SCENE_NAME_MAX);

    for (size_t i = 0; i < length; i++)
        if (name[i] == '/' || name[i] <= ' ' || name[i] > 'z')
            return false;
    return length > 0 && length < SCENE_NAME_MAX;
}

static void look_at_drawing(const struct act *act)
{
    size_t leaders = 0;

    assert(is_name(act->name) && act->count >= 1 && act->count <= ACT_VERTICES_MAX);
    for (size_t i = 0; i < act->count; i++) {
        assert(isfinite(act->L[i]) && isfinite(act->psi[i]));
        leaders += act->L[i] == 0;
    }
    assert(leaders == 1);
}

static void look_at(const struct act *act, uint32_t acts)
{
    assert(act->kind < ACT_COUNT && (acts & ACT_BIT(act->kind)) != 0);
    if (act->kind <= ACT_MOVE)
        assert(act->robot >= 1 && act->robot <= ROBOT_ID_MAX);
    if (act->kind == ACT_MOVE)
        assert(fabs(act->pose.x) <= POSITION_MAX_M && fabs(act->pose.y) <= POSITION_MAX_M &&
               isfinite(act->pose.theta));
    if (act->kind == ACT_SPEED)
        assert(act->speed == 0 || (act->speed >= 0.01 && act->speed <= ACT_SPEED_MAX));
    if (act->kind == ACT_FORMATION)
        assert(is_name(act->name));
    if (act->kind == ACT_DRAW)
        look_at_drawing(act);
}

static enum request_end read_with(const char *token, uint32_t acts, const char *text, size_t size)
{
    struct request_rules rules = {token, "sim", acts};
    char words[REQUEST_WORDS_MAX] = "";
    struct act act;
    enum request_end end = request_read(&rules, text, size, &act, words);

    if (end == REQUEST_GOOD)
        look_at(&act, acts);
    assert(end != REQUEST_REFUSED || words[0] != '\0');
    return end;
}

/* Every token beside the one that was given: a character changed, too many, too few. */
static void read_with_others(char token[TOKEN_MAX + 1], const char *text, size_t size)
{
    size_t length = strlen(token);

    for (size_t i = 0; i < length; i++) {
        token[i] ^= 1;
        assert(token[i] == '\0' || read_with(token, UINT32_MAX, text, size) != REQUEST_GOOD);
        token[i] ^= 1;
    }
    token[length] = '0';
    token[length + 1] = '\0';
    assert(read_with(token, UINT32_MAX, text, size) != REQUEST_GOOD);
    token[length > 0 ? length - 1 : 0] = '\0';
    assert(length == 0 || read_with(token, UINT32_MAX, text, size) != REQUEST_GOOD);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const char *text = (const char *)data;
    char token[TOKEN_MAX + 1];

    if (size > REQUEST_BYTES_MAX)
        return 0;
    find_token(text, size, token);
    read_with(token, UINT32_MAX, text, size);
    read_with(token, ACT_BIT(ACT_ESTOP) | ACT_BIT(ACT_END), text, size);
    read_with_others(token, text, size);
    return 0;
}
