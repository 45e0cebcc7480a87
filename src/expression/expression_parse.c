/* src/expression/expression_parse.c -- Parse a text into nodes.               [H 9] */
#include "tape.h"

#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <fvi/error.h>

enum { DEEPEST = 100, MOST_NODES = 1 << 24, MOST_DIGITS = 400 };

/* The position in the text, and the nodes so far. status is nonzero after an error; then all functions do nothing. */
typedef struct {
    const char *text, *at;
    const fvi_symbols *names;
    fvi_tape_state state;
    const fvi_name_finder *finder;
    fvi_node *node;
    size_t count, room;
    int depth, status;
    fvi_misprint wrong;
} parser;

static int refuse(parser *p, const char *at, const char *reason)
{
    if (!p->status)
        p->wrong = (fvi_misprint){ (size_t)(at - p->text), reason };
    if (!p->status)
        p->status = FVI_EINVAL;
    return 0;
}

/* ---- nodes ---- */

static int degree(const parser *p, const fvi_node *new)
{
    const int a = p->node[new->a].degree, b = p->node[new->b].degree;
    switch (new->op) {
    case TAPE_ADD:
    case TAPE_SUBTRACT:
        return a > b ? a : b;
    case TAPE_MULTIPLY:
        return a + b < 3 ? a + b : 3;
    case TAPE_NEGATE:
        return a;
    case TAPE_DIVIDE:
        return b == 0 ? a : 3;
    case TAPE_WHOLE_POWER:
        return a == 1 && new->number == 2 ? 2 : a == 0 ? 0 : 3;
    default:
        return a == 0 && b == 0 ? 0 : 3;
    }
}

/* Append a node and return its number. After an error return 0, which is as good as any number. */
static int append(parser *p, fvi_node new)
{
    if (p->status)
        return 0;
    if (p->count == p->room) {
        const size_t room = 2 * p->room + 64;
        fvi_node *node =
            room < MOST_NODES ? realloc(p->node, room * sizeof *node) : NULL;
        if (!node) {
            p->status = FVI_ENOMEM;
            return 0;
        }
        p->node = node;
        p->room = room;
    }
    p->node[p->count] = new;
    return (int)p->count++;
}

/* Add an operation on nodes a and b (b = a if there is one operand). If both are numbers, they are the last nodes and
 * are replaced by the result. */
static int add_operation(parser *p, fvi_operation op, int a, int b, double number)
{
    if (p->status)
        return 0;
    fvi_node new = { op, 0, a, b, number };
    new.degree = degree(p, &new);
    const int numbers =
        p->node[a].op == TAPE_NUMBER && p->node[b].op == TAPE_NUMBER;
    const int at = append(p, new);
    if (!numbers || p->status)
        return at;
    const fvi_node small[3] = { p->node[a],
                                p->node[b],
                                { op, 0, 0, 1, number } };
    const double value = fvi_tape_value(small, 3, NULL, NULL);
    if (!isfinite(value))
        return refuse(p, p->at, "a constant before this is not finite");
    p->count = (size_t)(a < b ? a : b);
    return append(p, (fvi_node){ .op = TAPE_NUMBER, .number = value });
}

/* Add u^v. Small whole powers, which are usual in potentials, are done by multiplication. */
static int raise_to(parser *p, int u, int v)
{
    if (p->status)
        return 0;
    const fvi_node exponent = p->node[v];
    if (exponent.op == TAPE_NUMBER && exponent.number >= 2
        && exponent.number <= 16 && exponent.number == floor(exponent.number)
        && p->node[u].op != TAPE_NUMBER && v == (int)p->count - 1) {
        p->count--;
        return add_operation(p, TAPE_WHOLE_POWER, u, u, exponent.number);
    }
    return add_operation(p, TAPE_POWER, u, v, 0);
}

/* ---- words ---- */

static void skip_spaces(parser *p)
{
    while (*p->at == ' ' || *p->at == '\t' || *p->at == '\n' || *p->at == '\r')
        p->at++;
}

/* If the next sign is `what`, read it and return nonzero. */
static int accept_sign(parser *p, const char *what)
{
    skip_spaces(p);
    const size_t length = strlen(what);
    if (p->status || strncmp(p->at, what, length) != 0)
        return 0;
    p->at += length;
    return 1;
}

static int is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static int is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* Return the length of the name at `at`, with or without points as in d1.force. */
static size_t name_length(const char *at, int points)
{
    size_t n = 0;
    while (is_letter(at[n]) || (n > 0 && is_digit(at[n]))
           || (points && n > 0 && at[n] == '.' && is_letter(at[n + 1])))
        n++;
    return n;
}

static int is_word(const char *at, size_t length, const char *word)
{
    return strlen(word) == length && strncmp(at, word, length) == 0;
}

static size_t digits(const char *at)
{
    size_t n = 0;
    while (is_digit(at[n]))
        n++;
    return n;
}

/* Read a decimal number. 0x10 is refused, and the decimal point is a point under every locale. */
static int number(parser *p)
{
    const char *from = p->at, *at = from;
    char copy[MOST_DIGITS + 20] = "";
    const char *point = localeconv()->decimal_point;
    at += digits(at);
    const size_t whole = (size_t)(at - from);
    size_t part = 0;
    if (*at == '.')
        at += 1 + (part = digits(at + 1));
    if (whole + part == 0)
        return refuse(p, from, "a digit is missing");
    if (*at == 'e' || *at == 'E') {
        const char *exponent = at + 1 + (at[1] == '+' || at[1] == '-');
        if (digits(exponent) == 0)
            return refuse(p, exponent, "the exponent is missing");
        at = exponent + digits(exponent);
    }
    const size_t length = (size_t)(at - from);
    if (length > MOST_DIGITS || strlen(point) > 10)
        return refuse(p, from, "a number of too many digits");
    memcpy(copy, from, whole);
    if (whole < length && from[whole] == '.') {
        strcat(copy, point);
        strncat(copy, from + whole + 1, length - whole - 1);
    } else {
        strncat(copy, from + whole, length - whole);
    }
    const double value = strtod(copy, NULL);
    if (!isfinite(value))
        return refuse(p, from, "a number is too large");
    p->at = at;
    return append(p, (fvi_node){ .op = TAPE_NUMBER, .number = value });
}

static int sum(parser *p);

/* Read the arguments of a function whose name has been read. */
static int parse_call(parser *p, fvi_operation op)
{
    if (!accept_sign(p, "("))
        return refuse(p, p->at, "a ( is missing behind the function");
    const int u = sum(p);
    int w = u;
    if (op >= TAPE_MIN) {
        if (!p->status && !accept_sign(p, ","))
            return refuse(p, p->at, "min and max are of two, parted by a comma");
        w = sum(p);
    }
    if (!p->status && !accept_sign(p, ")"))
        return refuse(p, p->at, "a ) is missing");
    return add_operation(p, op, u, w, 0);
}

/* Return the number of x or x3, from 0, if there are d such variables; or -1. */
static int numbered(const char *variable, size_t d, const char *at,
                    size_t length)
{
    const size_t stem = strlen(variable);
    if (d == 1 && is_word(at, length, variable))
        return 0;
    if (length <= stem || strncmp(at, variable, stem) != 0 || at[stem] == '0'
        || digits(at + stem) != length - stem || length - stem > 9)
        return -1;
    const size_t i = strtoul(at + stem, NULL, 10);
    return i >= 1 && i <= d ? (int)i - 1 : -1;
}

/* Return the number of a variable among x1, ..., v1, ..., t; or -1. */
static int coordinate(const parser *p, const char *at, size_t length)
{
    const size_t d = p->names->d;
    const int i = d ? numbered(p->names->variable, d, at, length) : -1,
              v = i < 0 && p->state == TAPE_VELOCITY
                      ? numbered("v", d, at, length)
                      : -1;
    if (v >= 0)
        return v + (int)d;
    if (i < 0 && p->state != TAPE_PLACE && is_word(at, length, "t"))
        return (int)(p->state == TAPE_VELOCITY ? 2 * d : d);
    return i;
}

static int name(parser *p)
{
    const char *from = p->at;
    const size_t length = name_length(from, p->finder != NULL);
    const int i = p->finder ? p->finder->find(from, length, p->finder->params)
                            : coordinate(p, from, length);
    p->at += length;
    if (i >= 0)
        return append(p, (fvi_node){ TAPE_COORDINATE, 1, i, 0, 0 });
    if (i == -2) {
        p->status = p->status ? p->status : FVI_ENOMEM;
        return 0;
    }
    for (size_t j = 0; j < p->names->parameters; j++)
        if (is_word(from, length, p->names->parameter[j]))
            return append(p, (fvi_node){ TAPE_PARAMETER, 0, (int)j, 0, 0 });
    for (int f = 0; fvi_tape_functions[f]; f++)
        if (is_word(from, length, fvi_tape_functions[f]))
            return parse_call(p, (fvi_operation)(TAPE_FUNCTIONS + f));
    if (is_word(from, length, "pi"))
        return append(p, (fvi_node){ .op = TAPE_NUMBER,
                                     .number = 3.14159265358979323846 });
    return refuse(p, from, "no such name");
}

int fvi_symbol_is_free(const char *name, const char *variable)
{
    const size_t length = strlen(name), stem = strlen(variable);
    if (length == 0 || name_length(name, 0) != length || strcmp(name, "pi") == 0)
        return 0;
    for (int f = 0; fvi_tape_functions[f]; f++)
        if (strcmp(name, fvi_tape_functions[f]) == 0)
            return 0;
    return strncmp(name, variable, stem) != 0
           || digits(name + stem) != length - stem;
}

/* ---- the grammar ---- */

static int signed_power(parser *p);

static int primary(parser *p)
{
    skip_spaces(p);
    if (p->status)
        return 0;
    if (is_digit(*p->at) || *p->at == '.')
        return number(p);
    if (is_letter(*p->at))
        return name(p);
    if (!accept_sign(p, "("))
        return refuse(p, p->at,
                      *p->at ? "a number, a name or ( is wanted here"
                             : "it ends too early");
    const int u = sum(p);
    if (!p->status && !accept_sign(p, ")"))
        return refuse(p, p->at, "a ) is missing");
    return u;
}

static int power(parser *p)
{
    const int u = primary(p);
    if (!accept_sign(p, "**") && !accept_sign(p, "^"))
        return u;
    return raise_to(p, u, signed_power(p));
}

/* Every recursion goes through this function, so the depth is checked here. */
static int signed_power(parser *p)
{
    int u;
    if (++p->depth > DEEPEST)
        return refuse(p, p->at, "nested too deeply");
    if (accept_sign(p, "-")) {
        u = signed_power(p);
        u = add_operation(p, TAPE_NEGATE, u, u, 0);
    } else {
        u = accept_sign(p, "+") ? signed_power(p) : power(p);
    }
    p->depth--;
    return u;
}

static int product(parser *p)
{
    int u = signed_power(p);
    for (;;) {
        if (accept_sign(p, "*"))
            u = add_operation(p, TAPE_MULTIPLY, u, signed_power(p), 0);
        else if (accept_sign(p, "/"))
            u = add_operation(p, TAPE_DIVIDE, u, signed_power(p), 0);
        else
            return u;
    }
}

static int sum(parser *p)
{
    int u = product(p);
    for (;;) {
        if (accept_sign(p, "+"))
            u = add_operation(p, TAPE_ADD, u, product(p), 0);
        else if (accept_sign(p, "-"))
            u = add_operation(p, TAPE_SUBTRACT, u, product(p), 0);
        else
            return u;
    }
}

int fvi_parse(const char *text, const fvi_symbols *names, fvi_tape_state state,
              const fvi_name_finder *finder, fvi_node **node, size_t *count,
              fvi_misprint *wrong)
{
    parser p = { .text = text,
                 .at = text,
                 .names = names,
                 .state = state,
                 .finder = finder };
    sum(&p);
    skip_spaces(&p);
    if (*p.at)
        refuse(&p, p.at, "an operator is wanted here");
    if (p.status) {
        free(p.node);
        *wrong = p.wrong;
        return p.status;
    }
    *node = p.node;
    *count = p.count;
    return FVI_SUCCESS;
}
