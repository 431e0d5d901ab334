#include "expression.h"

#include "text.h"

#include <math.h>
#include <muParserDLL.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define NAME_CHARS "0123456789_.abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
#define WORD_MAX 31

struct expression {
    muParserHandle_t parser;
    size_t count;
    double *values; /* what the parser's names refer to */
};

static double least(const double *values, int count)
{
    double result = values[0];

    for (int i = 1; i < count; i++)
        result = values[i] < result || isnan(values[i]) ? values[i] : result;
    return result;
}

static double greatest(const double *values, int count)
{
    double result = values[0];

    for (int i = 1; i < count; i++)
        result = values[i] > result || isnan(values[i]) ? values[i] : result;
    return result;
}

static const struct {
    const char *name;
    double (*of_one)(double);
    double (*of_two)(double, double);
    double (*of_many)(const double *, int);
} functions[] = {
    {"sin", sin, NULL, NULL},     {"cos", cos, NULL, NULL},      {"tan", tan, NULL, NULL},
    {"asin", asin, NULL, NULL},   {"acos", acos, NULL, NULL},    {"atan", atan, NULL, NULL},
    {"atan2", NULL, atan2, NULL}, {"sinh", sinh, NULL, NULL},    {"cosh", cosh, NULL, NULL},
    {"tanh", tanh, NULL, NULL},   {"exp", exp, NULL, NULL},      {"ln", log, NULL, NULL},
    {"sqrt", sqrt, NULL, NULL},   {"abs", fabs, NULL, NULL},     {"floor", floor, NULL, NULL},
    {"min", NULL, NULL, least},   {"max", NULL, NULL, greatest},
};

#define FUNCTION_COUNT (sizeof functions / sizeof functions[0])

/* A look at the text before the parser's. */
struct scan {
    const char *next;
    const char *const *names;
    unsigned depth; /* open parentheses */
    char *error;
    size_t room;
};

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static bool is_known(const char *name, const char *const *names)
{
    for (size_t i = 0; i < FUNCTION_COUNT; i++) {
        if (strcmp(name, functions[i].name) == 0)
            return true;
    }
    for (; *names != NULL; names++) {
        if (strcmp(name, *names) == 0)
            return true;
    }
    return strcmp(name, "pi") == 0;
}

static const char *nearest_name(const char *name, const char *const *names)
{
    const char *known[FUNCTION_COUNT + EXPRESSION_NAMES_MAX + 2];
    size_t count = 0;

    for (; names[count] != NULL; count++)
        known[count] = names[count];
    known[count++] = "pi";
    for (size_t i = 0; i < FUNCTION_COUNT; i++)
        known[count++] = functions[i].name;
    known[count] = NULL;
    return text_nearest(name, known);
}

static size_t word_length(const char *text)
{
    size_t length = strspn(text, NAME_CHARS);

    return length < WORD_MAX ? length : WORD_MAX;
}

static bool refuse_name(struct scan *scan, const char *name)
{
    const char *nearest = nearest_name(name, scan->names);
    char list[EXPRESSION_NAMES_MAX * (WORD_MAX + 2) + 1] = "";

    for (const char *const *known = scan->names; *known != NULL; known++) {
        strncat(list, *known, sizeof list - strlen(list) - 1);
        strncat(list, ", ", sizeof list - strlen(list) - 1);
    }
    snprintf(scan->error, scan->room, "'%s' has no meaning here%s%s%s; pi, %s%s are allowed", name,
             nearest != NULL ? ", '" : "", nearest != NULL ? nearest : "",
             nearest != NULL ? "' would have" : "", list, EXPRESSION_FUNCTIONS);
    return false;
}

static bool scan_name(struct scan *scan)
{
    char name[WORD_MAX + 1];
    size_t length = word_length(scan->next);

    snprintf(name, sizeof name, "%.*s", (int)length, scan->next);
    if (length == WORD_MAX || !is_known(name, scan->names))
        return refuse_name(scan, name);
    scan->next += length;
    return true;
}

static const char *skip_digits(const char *text)
{
    while (is_digit(*text))
        text++;
    return text;
}

/* Digits, a point with more of them, a power of ten. */
static bool scan_number(struct scan *scan)
{
    const char *end = skip_digits(scan->next);

    if (*end == '.')
        end = skip_digits(end + 1);
    if (*end == 'e' || *end == 'E') {
        const char *power = end + 1;
        if (*power == '+' || *power == '-')
            power++;
        end = is_digit(*power) ? skip_digits(power) : end;
    }
    if (is_letter(*end) || *end == '.') {
        snprintf(scan->error, scan->room, "'%.*s' is no number", (int)word_length(scan->next),
                 scan->next);
        return false;
    }
    scan->next = end;
    return true;
}

static bool scan_operator(struct scan *scan)
{
    static const char *const pairs[] = {"<=", ">=", "==", "!=", "&&", "||"};

    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
        if (strncmp(scan->next, pairs[i], 2) == 0) {
            scan->next += 2;
            return true;
        }
    }
    if (*scan->next == '=') {
        snprintf(scan->error, scan->room, "an assignment; == compares");
        return false;
    }
    if (*scan->next == ',' && scan->depth == 0) {
        snprintf(scan->error, scan->room, "a comma outside of a function's parentheses");
        return false;
    }
    if (strchr("+-*/^()<>?:, \t\r\n", *scan->next) == NULL) {
        snprintf(scan->error, scan->room, "'%.1s' has no meaning in an expression",
                 *scan->next > 0 ? scan->next : "?");
        return false;
    }
    scan->depth += *scan->next == '(';
    scan->depth -= *scan->next == ')' && scan->depth > 0;
    scan->next++;
    return true;
}

static bool scan_all(struct scan *scan)
{
    while (*scan->next != '\0') {
        bool number = is_digit(*scan->next) || (*scan->next == '.' && is_digit(scan->next[1]));
        bool name = is_letter(*scan->next) || *scan->next == '.';
        if (!(number ? scan_number(scan) : name ? scan_name(scan) : scan_operator(scan)))
            return false;
    }
    return true;
}

/* Without a handler muParser prints. */
static void keep_silent(muParserHandle_t parser)
{
    (void)parser;
}

static void define_all(struct expression *expression, const char *const *names)
{
    muParserHandle_t parser = expression->parser;

    mupSetErrorHandler(parser, keep_silent);
    mupClearConst(parser);
    mupClearFun(parser);
    mupDefineNameChars(parser, NAME_CHARS);
    mupDefineConst(parser, "pi", M_PI);
    for (size_t i = 0; i < FUNCTION_COUNT; i++) {
        if (functions[i].of_one != NULL)
            mupDefineFun1(parser, functions[i].name, functions[i].of_one, true);
        else if (functions[i].of_two != NULL)
            mupDefineFun2(parser, functions[i].name, functions[i].of_two, true);
        else
            mupDefineMultFun(parser, functions[i].name, functions[i].of_many, true);
    }
    for (size_t i = 0; i < expression->count; i++)
        mupDefineVar(parser, names[i], &expression->values[i]);
}

/* The parser parses when it first computes. */
static bool compile(struct expression *expression, const char *text, const char *const *names,
                    char *error, size_t room)
{
    expression->parser = mupCreate(muBASETYPE_FLOAT);
    if (expression->parser == NULL) {
        snprintf(error, room, "not enough memory");
        return false;
    }
    define_all(expression, names);
    mupSetExpr(expression->parser, text);
    mupEval(expression->parser);
    if (!mupError(expression->parser))
        return true;
    snprintf(error, room, "%s", mupGetErrorMsg(expression->parser));
    return false;
}

static size_t count_of(const char *const *names)
{
    size_t count = 0;

    while (names[count] != NULL)
        count++;
    return count;
}

struct expression *expression_new(const char *text, const char *const *names, char *error,
                                  size_t room)
{
    struct scan scan = {.next = text, .names = names, .error = error, .room = room};

    if (!scan_all(&scan))
        return NULL;

    struct expression *expression = calloc(1, sizeof *expression);
    if (expression != NULL) {
        expression->count = count_of(names);
        expression->values = calloc(EXPRESSION_NAMES_MAX, sizeof *expression->values);
    }
    if (expression == NULL || expression->values == NULL) {
        snprintf(error, room, "not enough memory");
    } else if (compile(expression, text, names, error, room)) {
        return expression;
    }
    expression_free(expression);
    return NULL;
}

double expression_value(const struct expression *expression, const double *values)
{
    for (size_t i = 0; i < expression->count; i++)
        expression->values[i] = values[i];
    return mupEval(expression->parser);
}

bool expression_is_constant(const struct expression *expression)
{
    return mupGetExprVarNum(expression->parser) == 0;
}

void expression_free(struct expression *expression)
{
    if (expression == NULL)
        return;
    if (expression->parser != NULL)
        mupRelease(expression->parser);
    free(expression->values);
    free(expression);
}
