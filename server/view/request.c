#include "request.h"

#include "limits.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define FIELDS_MAX 4
#define COMMON_KEYS 3 /* number, token, act */

struct field {
    const char *key;
    bool (*read)(const json_t *value, struct act *act);
    const char *allowed;
};

/* ---- values ---------------------------------------------------------------------------- */

static bool read_robot(const json_t *value, struct act *act)
{
    json_int_t id = json_integer_value(value);

    act->robot = (uint16_t)id;
    return json_is_integer(value) && id >= 1 && id <= (json_int_t)ROBOT_ID_MAX;
}

static bool read_finite(const json_t *value, double *number)
{
    *number = json_number_value(value);
    return json_is_number(value) && isfinite(*number);
}

static bool read_x(const json_t *value, struct act *act)
{
    return read_finite(value, &act->pose.x) && fabs(act->pose.x) <= POSITION_MAX_M;
}

static bool read_y(const json_t *value, struct act *act)
{
    return read_finite(value, &act->pose.y) && fabs(act->pose.y) <= POSITION_MAX_M;
}

static bool read_theta(const json_t *value, struct act *act)
{
    return read_finite(value, &act->pose.theta);
}

static bool read_speed(const json_t *value, struct act *act)
{
    return read_finite(value, &act->speed) &&
           (act->speed == 0 || (act->speed >= ACT_SPEED_MIN && act->speed <= ACT_SPEED_MAX));
}

static bool read_name(const json_t *value, struct act *act)
{
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
                                  "0123456789._-";
    const char *name = json_string_value(value);

    if (name == NULL || name[0] == '\0' || strlen(name) >= sizeof act->name ||
        name[strspn(name, letters)] != '\0')
        return false;
    snprintf(act->name, sizeof act->name, "%s", name);
    return true;
}

static bool read_numbers(const json_t *value, double numbers[ACT_VERTICES_MAX], size_t *count)
{
    *count = json_array_size(value);
    if (*count < 1 || *count > ACT_VERTICES_MAX)
        return false;
    for (size_t i = 0; i < *count; i++)
        if (!read_finite(json_array_get(value, i), &numbers[i]))
            return false;
    return true;
}

static bool read_L(const json_t *value, struct act *act)
{
    size_t leaders = 0;

    if (!read_numbers(value, act->L, &act->count))
        return false;
    for (size_t i = 0; i < act->count; i++)
        leaders += act->L[i] == 0;
    return leaders == 1;
}

static bool read_psi(const json_t *value, struct act *act)
{
    size_t count;

    return read_numbers(value, act->psi, &count) && count == act->count;
}

/* ---- acts ------------------------------------------------------------------------------ */

static const struct field robot = {"robot", read_robot, "an id"};
static const struct field x = {"x", read_x, "at most 2097 m either way"};
static const struct field y = {"y", read_y, "at most 2097 m either way"};
static const struct field theta = {"theta", read_theta, "a number"};
static const struct field name = {"name", read_name, "up to 63 letters, digits, . _ -"};
static const struct field L = {"L", read_L, "up to 128 numbers, exactly one of them 0"};
static const struct field psi = {"psi", read_psi, "as many numbers as L has"};
static const struct field speed = {"speed", read_speed, "0 or 0.01 to 1000"};

static const struct field *const fields_of[ACT_COUNT][FIELDS_MAX] = {
    [ACT_KILL] = {&robot},
    [ACT_REVIVE] = {&robot},
    [ACT_STALL] = {&robot},
    [ACT_MUTE] = {&robot},
    [ACT_UNMUTE] = {&robot},
    [ACT_DRAIN] = {&robot},
    [ACT_MOVE] = {&robot, &x, &y, &theta},
    [ACT_FORMATION] = {&name},
    [ACT_DRAW] = {&name, &L, &psi},
    [ACT_SPEED] = {&speed},
};

static bool find_act(const char *word, enum act_kind *kind)
{
    for (*kind = 0; word != NULL && *kind < ACT_COUNT; (*kind)++)
        if (strcmp(act_words[*kind], word) == 0)
            return true;
    return false;
}

static size_t field_count(enum act_kind kind)
{
    size_t count = 0;

    while (count < FIELDS_MAX && fields_of[kind][count] != NULL)
        count++;
    return count;
}

static bool read_fields(const json_t *request, struct act *act, char *words)
{
    size_t count = field_count(act->kind);

    for (size_t i = 0; i < count; i++) {
        const struct field *field = fields_of[act->kind][i];

        if (!field->read(json_object_get(request, field->key), act)) {
            snprintf(words, REQUEST_WORDS_MAX, "%s needs \"%s\": %s", act_words[act->kind],
                     field->key, field->allowed);
            return false;
        }
    }
    if (json_object_size(request) == COMMON_KEYS + count)
        return true;
    snprintf(words, REQUEST_WORDS_MAX, "%s has a key too many", act_words[act->kind]);
    return false;
}

/* ---- the request ----------------------------------------------------------------------- */

static bool read_number(const json_t *request, struct act *act)
{
    const json_t *number = json_object_get(request, "number");
    json_int_t value = json_integer_value(number);

    act->number = (uint32_t)value;
    return json_is_integer(number) && value >= 0 && value <= (json_int_t)UINT32_MAX;
}

/* Takes as long wherever the two begin to differ. */
static bool has_token(const json_t *request, const char *token)
{
    const char *given = json_string_value(json_object_get(request, "token"));
    size_t length = strlen(token);
    unsigned char difference = 0;

    if (given == NULL || strlen(given) != length)
        return false;
    for (size_t i = 0; i < length; i++)
        difference |= (unsigned char)(given[i] ^ token[i]);
    return difference == 0;
}

static bool refuse_kind(const struct request_rules *rules, enum act_kind kind, char *words)
{
    const char *run = strcmp(rules->kind, "sim") == 0     ? "a simulation"
                      : strcmp(rules->kind, "serve") == 0 ? "a run of real robots"
                                                          : "a replay";

    if (rules->acts == 0)
        snprintf(words, REQUEST_WORDS_MAX, "%s cannot be acted on", run);
    else
        snprintf(words, REQUEST_WORDS_MAX, "%s is nothing that %s can do", act_words[kind], run);
    return false;
}

static bool read_request(const struct request_rules *rules, const json_t *request, struct act *act,
                         char *words)
{
    const char *word = json_string_value(json_object_get(request, "act"));

    if (!has_token(request, rules->token)) {
        snprintf(words, REQUEST_WORDS_MAX,
                 "only whoever opened the address with the token in it may act");
        return false;
    }
    if (!find_act(word, &act->kind)) {
        snprintf(words, REQUEST_WORDS_MAX, "there is no such act");
        return false;
    }
    if ((rules->acts & ACT_BIT(act->kind)) == 0)
        return refuse_kind(rules, act->kind, words);
    return read_fields(request, act, words);
}

enum request_end request_read(const struct request_rules *rules, const char *text, size_t count,
                              struct act *act, char words[REQUEST_WORDS_MAX])
{
    json_t *request = json_loadb(text, count, JSON_REJECT_DUPLICATES, NULL);
    enum request_end end = REQUEST_UNANSWERABLE;

    *act = (struct act){0};
    if (read_number(request, act))
        end = read_request(rules, request, act, words) ? REQUEST_GOOD : REQUEST_REFUSED;
    json_decref(request);
    return end;
}
