/* src/expression/expression.c -- Parse a text and split it into the terms of its sum.               [H 9] */
#include <fvi/expression.h>

#include "system/fail.h"
#include "expression_terms.h"

#include <stdlib.h>
#include <string.h>

/* The state of the parser: the nodes of the whole text, to which nodes are added while the sum is taken apart. */
typedef struct {
    fvi_expression *e;
    fvi_node *node;
    size_t count, room;
    int status;
    fvi_node tape[FVI_TAPE_LONGEST]; /* nodes of the present term */
    int coordinate[FVI_TAPE_LONGEST];
} builder;

/* ---- one term ---- */

/* Return the position of a coordinate that the tape contains already, or -1. */
static int find_coordinate(const term *t, const fvi_node *new)
{
    for (size_t i = 0; new->op == TAPE_COORDINATE &&i < t->count; i++)
        if (t->node[i].op == TAPE_COORDINATE && t->node[i].a == new->a)
            return (int)i;
    return -1;
}

/* Copy what stands under node i, then node i itself, to the end of the tape, which has room for FVI_TAPE_LONGEST nodes.
 * Return the position of node i there. */
static int emit(builder *w, term *t, int i, int depth)
{
    fvi_node new = w->node[i];
    const int before = find_coordinate(t, &new);
    if (before >= 0 || w->status)
        return before;
    if (depth == FVI_TAPE_LONGEST) {
        w->status = FVI_EINVAL;
        return 0;
    }
    if (new.op > TAPE_PARAMETER) {
        const int unary = new.a == new.b;
        new.a = emit(w, t, new.a, depth + 1);
        new.b = unary ? new.a : emit(w, t, new.b, depth + 1);
    } else if (new.op == TAPE_COORDINATE) {
        t->coordinate[t->coordinates++] = new.a;
    }
    if (t->count == FVI_TAPE_LONGEST)
        w->status = FVI_EINVAL;
    if (w->status)
        return 0;
    t->node[t->count] = new;
    return (int)t->count++;
}

static void update_half_bandwidth(fvi_expression *e, const term *t)
{
    for (size_t i = 0; i < t->coordinates; i++)
        for (size_t j = 0; j < t->coordinates; j++)
            if (t->coordinate[i] - t->coordinate[j] > (int)e->half_bandwidth)
                e->half_bandwidth = (size_t)(t->coordinate[i] - t->coordinate[j]);
}

/* Replace the arrays of the term by copies of their exact length, in one block that begins at t->node. Return 0 if
 * there is no memory. */
static int shrink_term(term *t)
{
    fvi_node *node = malloc(t->count * sizeof *node + t->coordinates * sizeof *t->coordinate);
    if (!node)
        return 0;
    int *coordinate = (int *)(node + t->count);
    memcpy(node, t->node, t->count * sizeof *node);
    memcpy(coordinate, t->coordinate, t->coordinates * sizeof *coordinate);
    t->node = node;
    t->coordinate = coordinate;
    return 1;
}

/* Make a term from the tree under the root. */
static void add_term(builder *w, int root)
{
    fvi_expression *e = w->e;
    term t = { .node = w->tape, .coordinate = w->coordinate };
    emit(w, &t, root, 0);
    if (w->status)
        return;
    if (e->count == e->room) {
        const size_t room = 2 * e->room + 4;
        term *terms = realloc(e->terms, room * sizeof *terms);
        if (!terms) {
            w->status = FVI_ENOMEM;
            return;
        }
        e->terms = terms;
        e->room = room;
    }
    if (shrink_term(&t)) {
        update_half_bandwidth(e, &t);
        e->terms[e->count++] = t;
    } else {
        w->status = FVI_ENOMEM;
    }
}

/* ---- the sum ---- */

/* Add a node. Return its number. */
static int add_node(builder *w, fvi_operation op, int a, int b, double number)
{
    if (w->count == w->room) {
        const size_t room = 2 * w->room;
        fvi_node *node = realloc(w->node, room * sizeof *node);
        if (!node) {
            w->status = FVI_ENOMEM;
            return 0;
        }
        w->node = node;
        w->room = room;
    }
    w->node[w->count] = (fvi_node){ op, 0, a, b, number };
    return (int)w->count++;
}

/* Return the operand of a sign, or the operand beside a factor or a divisor without a coordinate; else -1. */
static int inner_operand(const builder *w, int i)
{
    const fvi_node *at = &w->node[i];
    if (at->op == TAPE_NEGATE)
        return at->a;
    if (at->op != TAPE_MULTIPLY && at->op != TAPE_DIVIDE)
        return -1;
    if (w->node[at->b].degree == 0)
        return at->a;
    return at->op == TAPE_MULTIPLY && w->node[at->a].degree == 0 ? at->b : -1;
}

static int is_sum(const builder *w, int i)
{
    return w->node[i].op == TAPE_ADD || w->node[i].op == TAPE_SUBTRACT;
}

static int contains_sum(const builder *w, int i)
{
    while (inner_operand(w, i) >= 0)
        i = inner_operand(w, i);
    return is_sum(w, i);
}

enum { ONE = -1 /* in place of a node: no factor */ };

static int negate_factor(builder *w, int factor)
{
    return factor == ONE ? add_node(w, TAPE_NUMBER, 0, 0, -1)
                         : add_node(w, TAPE_NEGATE, factor, factor, 0);
}

/* Return the factor together with the operation at node i. */
static int factor_outside(builder *w, int factor, int i)
{
    const fvi_node at = w->node[i];
    if (at.op == TAPE_NEGATE)
        return negate_factor(w, factor);
    const int other = inner_operand(w, i) == at.a ? at.b : at.a;
    if (factor == ONE && at.op == TAPE_MULTIPLY)
        return other;
    if (factor == ONE)
        factor = add_node(w, TAPE_NUMBER, 0, 0, 1);
    return add_node(w, at.op, factor, other, 0);
}

/* Add the terms of factor times node i. Signs and factors without a coordinate go to each term. A long sum leans to the
 * left, and this function does not recurse in that direction. */
static void distribute_factor(builder *w, int i, int factor)
{
    while (!w->status && contains_sum(w, i)) {
        const fvi_node at = w->node[i];
        if (is_sum(w, i)) {
            distribute_factor(w, at.b,
                              at.op == TAPE_ADD ? factor : negate_factor(w, factor));
            i = at.a;
        } else {
            factor = factor_outside(w, factor, i);
            i = inner_operand(w, i);
        }
    }
    if (!w->status)
        add_term(w, factor == ONE ? i : add_node(w, TAPE_MULTIPLY, factor, i, 0));
}

static size_t variables(const fvi_symbols *names, fvi_tape_state state)
{
    return state == TAPE_VELOCITY ? 2 * names->d + 1
           : state == TAPE_TIME   ? names->d + 1
                                  : names->d;
}

/* Parse a text. finder is NULL, or knows the names of the coordinates. */
static int parse_in(const char *text, const fvi_symbols *names,
                    fvi_tape_state state, const fvi_name_finder *finder,
                    const double *values, fvi_expression **e,
                    fvi_misprint *wrong)
{
    fvi_misprint place = { 0, "not enough memory" };
    builder w = { .e = calloc(1, sizeof *w.e) };
    int status = w.e ? fvi_parse(text, names, state, finder, &w.node, &w.count, &place) : FVI_ENOMEM;
    if (!status) {
        const int root = (int)w.count - 1;
        *w.e = (fvi_expression){ .d = variables(names, state),
                                 .values = values,
                                 .degree = w.node[root].degree };
        w.room = w.count;
        if (w.e->d > 1 && !finder)
            distribute_factor(&w, root, ONE);
        else
            add_term(&w, root);
        if ((status = w.status))
            place = (fvi_misprint){ 0, "a term is too long" };
    }
    free(w.node);
    if (status) {
        fvi_expression_free(w.e);
        if (wrong)
            *wrong = place;
        return status;
    }
    *e = w.e;
    return FVI_SUCCESS;
}

int fvi_expression_parse(const char *text, const fvi_symbols *names,
                         const double *values, fvi_expression **e,
                         fvi_misprint *wrong)
{
    if (!text || !names || !e || (names->d > 0 && !names->variable))
        FVI_FAIL("null pointer", FVI_EFAULT);
    return parse_in(text, names, TAPE_PLACE, NULL, values, e, wrong);
}

int fvi_expression_parse_state(const char *text, const fvi_symbols *names,
                               int velocities, const double *values,
                               fvi_expression **e, fvi_misprint *wrong)
{
    if (!text || !names || !e || (names->d > 0 && !names->variable))
        FVI_FAIL("null pointer", FVI_EFAULT);
    return parse_in(text, names, velocities ? TAPE_VELOCITY : TAPE_TIME, NULL,
                    values, e, wrong);
}

size_t fvi_expression_variables(const fvi_expression *e)
{
    return e->d;
}

int fvi_expression_parse_of(const char *text, const fvi_name_finder *finder,
                            const fvi_symbols *names, const double *values,
                            fvi_expression **e, fvi_misprint *wrong)
{
    if (!text || !finder || !names || !e)
        FVI_FAIL("null pointer", FVI_EFAULT);
    return parse_in(text, names, TAPE_PLACE, finder, values, e, wrong);
}

void fvi_expression_free(fvi_expression *e)
{
    for (size_t i = 0; e && i < e->count; i++)
        free(e->terms[i].node);
    if (e)
        free(e->terms);
    free(e);
}
