/* src/expression/expression_parse.c -- Parse a text into nodes.               [H 9] */
#include "tape.h"

#include "system/decimal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <fvi/error.h>

enum { MOST_NESTED = 100, MOST_NODES = 1 << 24 };

/* A parser by recursive descent. Each function parse_... reads a piece of the text, appends its nodes, and returns the
 * number of the node that holds its value. After an error all functions do nothing and return 0, so a caller need not
 * check. */
typedef struct {
    const char *text, *at;         /* the whole text; the next byte to be read */
    const fvi_symbols *names;      /* names of coordinates and parameters */
    fvi_tape_state state;          /* whether the text may contain the time and velocities */
    const fvi_name_finder *finder; /* finds coordinates with other names; or NULL */
    fvi_node *node;                /* the nodes so far; fvi_parse hands them to its caller */
    size_t count, room;            /* number of nodes; number of nodes that fit in the array */
    int depth;                     /* number of calls of parse_signed_power that have not returned */
    int status;                    /* FVI_SUCCESS, or the code of the first error */
    fvi_misprint wrong;            /* place and reason of that error, for FVI_EINVAL */
} parser;

/* Record an error at `at`, if it is the first one. Return 0, which stands for the number of a node. */
static int refuse(parser *p, const char *at, const char *reason)
{
    if (!p->status) {
        p->wrong = (fvi_misprint){ .at = (size_t)(at - p->text), .reason = reason };
        p->status = FVI_EINVAL;
    }
    return 0;
}

/* ---- nodes ---- */

/* Return the degree of the polynomial that an operation computes from the degrees of its operands. The degree 3 stands
 * for every other function, too, so a result above 3 is 3. */
static int degree_of_operation(const parser *p, const fvi_node *new)
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

/* Append a node and return its number. */
static int append_node(parser *p, fvi_node new)
{
    if (p->status)
        return 0;
    if (p->count == p->room) {
        const size_t room = 2 * p->room + 64;
        fvi_node *node = room < MOST_NODES ? realloc(p->node, room * sizeof *node) : NULL;
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

/* Append an operation on nodes a and b (b = a if there is one operand). The number is the exponent of TAPE_WHOLE_POWER,
 * else 0. If both operands are constants, they are the last nodes, and one node with the value replaces them and the
 * operation. */
static int add_operation(parser *p, fvi_operation op, int a, int b, double number)
{
    if (p->status)
        return 0;
    fvi_node new = { .op = op, .a = a, .b = b, .number = number };
    new.degree = degree_of_operation(p, &new);
    const int both_constant =
        p->node[a].op == TAPE_NUMBER && p->node[b].op == TAPE_NUMBER;
    const int appended = append_node(p, new);
    if (!both_constant || p->status)
        return appended;
    const fvi_node constant_expression[3] = {
        p->node[a], p->node[b], { .op = op, .a = 0, .b = 1, .number = number }
    };
    const double value = fvi_tape_value(constant_expression, 3, NULL, NULL);
    if (!isfinite(value))
        return refuse(p, p->at, "a constant before this is not finite");
    p->count = (size_t)(a < b ? a : b); /* remove the operands and the operation */
    return append_node(p, (fvi_node){ .op = TAPE_NUMBER, .number = value });
}

/* Append the node u to the power of the node v. A constant whole exponent from 2 to 16, which is usual in potentials,
 * becomes TAPE_WHOLE_POWER, which multiplies. Then the node v, which must be the last one, is removed. */
static int add_power(parser *p, int u, int v)
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

/* Return the length of the name at `at`. If `points` is nonzero, it may contain points, as d1.force. */
static size_t name_length(const char *at, int points)
{
    size_t n = 0;
    while (is_letter(at[n]) || (n > 0 && is_digit(at[n]))
           || (points && n > 0 && at[n] == '.' && is_letter(at[n + 1])))
        n++;
    return n;
}

/* Return nonzero if the `length` bytes at `at` are the word. */
static int is_word(const char *at, size_t length, const char *word)
{
    return strlen(word) == length && strncmp(at, word, length) == 0;
}

/* Return how many digits there are from `at` on. */
static size_t count_digits(const char *at)
{
    size_t n = 0;
    while (is_digit(at[n]))
        n++;
    return n;
}

/* Read a decimal number. 0x10 is refused: strtod would read it, but the parser goes on at the x. */
static int parse_number(parser *p)
{
    const char *from = p->at, *at = from + count_digits(from);
    size_t digits = (size_t)(at - from);
    if (*at == '.') {
        digits += count_digits(at + 1);
        at += 1 + count_digits(at + 1);
    }
    if (digits == 0)
        return refuse(p, from, "a digit is missing");
    if (*at == 'e' || *at == 'E') {
        const char *exponent = at + 1 + (at[1] == '+' || at[1] == '-');
        if (count_digits(exponent) == 0)
            return refuse(p, exponent, "the exponent is missing");
        at = exponent + count_digits(exponent);
    }
    const double value = fvi_strtod(from, NULL);
    if (isnan(value)) {
        p->status = FVI_ENOMEM;
        return 0;
    }
    if (!isfinite(value))
        return refuse(p, from, "a number is too large");
    p->at = at;
    return append_node(p, (fvi_node){ .op = TAPE_NUMBER, .number = value });
}

static int parse_sum(parser *p);

/* Read the argument, or for min and max both arguments, of a function whose name has been read. */
static int parse_call(parser *p, fvi_operation op)
{
    if (!accept_sign(p, "("))
        return refuse(p, p->at, "a ( is missing behind the function");
    const int first = parse_sum(p);
    int second = first;
    if (op >= TAPE_MIN) {
        if (!p->status && !accept_sign(p, ","))
            return refuse(p, p->at, "min and max are of two, parted by a comma");
        second = parse_sum(p);
    }
    if (!p->status && !accept_sign(p, ")"))
        return refuse(p, p->at, "a ) is missing");
    return add_operation(p, op, first, second, 0);
}

/* Return the number, from 0, of the name among the variables x1, ..., xd, if `variable` is "x"; for d = 1 also of x
 * alone. Return -1 if the name is none of them. */
static int find_numbered_variable(const char *variable, size_t d, const char *at, size_t length)
{
    const size_t stem = strlen(variable);
    if (d == 1 && is_word(at, length, variable))
        return 0;
    if (length <= stem || strncmp(at, variable, stem) != 0 || at[stem] == '0'
        || count_digits(at + stem) != length - stem || length - stem > 9)
        return -1;
    const size_t written = strtoul(at + stem, NULL, 10); /* counted from 1 */
    return written >= 1 && written <= d ? (int)written - 1 : -1;
}

/* Return the number, from 0, of the name among x1, ..., xd, then v1, ..., vd if the text may contain velocities, then t
 * if it may contain the time. Return -1 if the name is none of them. */
static int find_coordinate(const parser *p, const char *at, size_t length)
{
    const size_t d = p->names->d;
    const int i = d ? find_numbered_variable(p->names->variable, d, at, length) : -1,
              v = i < 0 && p->state == TAPE_VELOCITY
                      ? find_numbered_variable("v", d, at, length)
                      : -1;
    if (v >= 0)
        return v + (int)d;
    if (i < 0 && p->state != TAPE_PLACE && is_word(at, length, "t"))
        return (int)(p->state == TAPE_VELOCITY ? 2 * d : d);
    return i;
}

/* Read a name: a coordinate, a parameter, a function with its arguments, or pi. */
static int parse_name(parser *p)
{
    const char *from = p->at;
    const size_t length = name_length(from, p->finder != NULL);
    const int coordinate = p->finder ? p->finder->find(from, length, p->finder->params)
                                     : find_coordinate(p, from, length);
    p->at += length;
    if (coordinate >= 0)
        return append_node(p, (fvi_node){ .op = TAPE_COORDINATE, .degree = 1, .a = coordinate });
    if (coordinate == -2) { /* the finder had no memory */
        p->status = p->status ? p->status : FVI_ENOMEM;
        return 0;
    }
    for (size_t j = 0; j < p->names->parameters; j++)
        if (is_word(from, length, p->names->parameter[j]))
            return append_node(p, (fvi_node){ .op = TAPE_PARAMETER, .a = (int)j });
    for (int f = 0; fvi_tape_functions[f]; f++)
        if (is_word(from, length, fvi_tape_functions[f]))
            return parse_call(p, (fvi_operation)(TAPE_FUNCTIONS + f));
    if (is_word(from, length, "pi"))
        return append_node(p, (fvi_node){ .op = TAPE_NUMBER, .number = 3.14159265358979323846 });
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
           || count_digits(name + stem) != length - stem;
}

/* ---- the grammar ----
 *
 *     sum           product, then any number of + product or - product
 *     product       signed power, then any number of * signed power or / signed power
 *     signed power  - signed power, or + signed power, or power
 *     power         primary, or primary ^ signed power
 *     primary       number, or name, or ( sum ) */

static int parse_signed_power(parser *p);

static int parse_primary(parser *p)
{
    skip_spaces(p);
    if (p->status)
        return 0;
    if (is_digit(*p->at) || *p->at == '.')
        return parse_number(p);
    if (is_letter(*p->at))
        return parse_name(p);
    if (!accept_sign(p, "("))
        return refuse(p, p->at,
                      *p->at ? "a number, a name or ( is wanted here"
                             : "it ends too early");
    const int u = parse_sum(p);
    if (!p->status && !accept_sign(p, ")"))
        return refuse(p, p->at, "a ) is missing");
    return u;
}

static int parse_power(parser *p)
{
    const int u = parse_primary(p);
    if (!accept_sign(p, "**") && !accept_sign(p, "^"))
        return u;
    return add_power(p, u, parse_signed_power(p));
}

/* Every recursion goes through this function, so the depth is checked here. */
static int parse_signed_power(parser *p)
{
    int u;
    if (++p->depth > MOST_NESTED)
        return refuse(p, p->at, "nested too deeply");
    if (accept_sign(p, "-")) {
        u = parse_signed_power(p);
        u = add_operation(p, TAPE_NEGATE, u, u, 0);
    } else {
        u = accept_sign(p, "+") ? parse_signed_power(p) : parse_power(p);
    }
    p->depth--;
    return u;
}

static int parse_product(parser *p)
{
    int u = parse_signed_power(p);
    for (;;) {
        if (accept_sign(p, "*"))
            u = add_operation(p, TAPE_MULTIPLY, u, parse_signed_power(p), 0);
        else if (accept_sign(p, "/"))
            u = add_operation(p, TAPE_DIVIDE, u, parse_signed_power(p), 0);
        else
            return u;
    }
}

static int parse_sum(parser *p)
{
    int u = parse_product(p);
    for (;;) {
        if (accept_sign(p, "+"))
            u = add_operation(p, TAPE_ADD, u, parse_product(p), 0);
        else if (accept_sign(p, "-"))
            u = add_operation(p, TAPE_SUBTRACT, u, parse_product(p), 0);
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
    parse_sum(&p);
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
