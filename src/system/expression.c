/* src/system/expression.c -- A parsed sum, term by term.               [H 9] */
#include <fvi/expression.h>

#include "enclosure.h"
#include "fail.h"
#include "tape.h"

#include <stdlib.h>
#include <string.h>

/* A term is a tape of its own, so that coordinates that do not meet cost each other
 * nothing. */
typedef struct {
    fvi_node *node;
    size_t count;
    int *coordinate; /* that stand in it, without repetition */
    size_t coordinates;
} term;

struct fvi_expression {
    size_t d;
    const double *values;
    term *terms;
    size_t count, room;
    size_t reach; /* the largest distance of two coordinates of a term */
    int degree;
};

/* What is parsed, and grows while it is taken apart. */
typedef struct {
    fvi_expression *e;
    fvi_node *node;
    size_t count, room;
    int status;
    fvi_node tape[FVI_TAPE_LONGEST]; /* the term at work */
    int coordinate[FVI_TAPE_LONGEST];
} builder;

/* ---- one term ---- */

/* The place of a coordinate that is in the tape already; or -1. */
static int met_before(const term *t, const fvi_node *new)
{
    for (size_t i = 0; new->op == TAPE_COORDINATE &&i < t->count; i++)
        if (t->node[i].op == TAPE_COORDINATE && t->node[i].a == new->a)
            return (int)i;
    return -1;
}

/* What stands under node i, then node i itself, to the end of a tape that has room
 * for FVI_TAPE_LONGEST. Returns its place there. */
static int emit(builder *w, term *t, int i, int depth)
{
    fvi_node new = w->node[i];
    const int before = met_before(t, &new);
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

static void widen(fvi_expression *e, const term *t)
{
    for (size_t i = 0; i < t->coordinates; i++)
        for (size_t j = 0; j < t->coordinates; j++)
            if (t->coordinate[i] - t->coordinate[j] > (int)e->reach)
                e->reach = (size_t)(t->coordinate[i] - t->coordinate[j]);
}

/* Copies that are no longer than they must be; 0 if there is no memory. */
static int keep(term *t)
{
    fvi_node *node = malloc(t->count * sizeof *node);
    int *coordinate = malloc((t->coordinates + 1) * sizeof *coordinate);
    if (node && coordinate) {
        memcpy(node, t->node, t->count * sizeof *node);
        memcpy(coordinate, t->coordinate, t->coordinates * sizeof *coordinate);
        t->node = node;
        t->coordinate = coordinate;
        return 1;
    }
    free(node);
    free(coordinate);
    return 0;
}

/* The tree under the root becomes a term. */
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
    if (keep(&t)) {
        widen(e, &t);
        e->terms[e->count++] = t;
    } else {
        w->status = FVI_ENOMEM;
    }
}

/* ---- the sum ---- */

/* One more node; its number. */
static int make(builder *w, fvi_operation op, int a, int b, double number)
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

/* The operand of a sign, or of a factor or a divisor that has no coordinate; else -1. */
static int inside(const builder *w, int i)
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

static int hides_a_sum(const builder *w, int i)
{
    while (inside(w, i) >= 0)
        i = inside(w, i);
    return is_sum(w, i);
}

enum { ONE = -1 /* instead of a node: no factor */ };

static int negative(builder *w, int factor)
{
    return factor == ONE ? make(w, TAPE_NUMBER, 0, 0, -1)
                         : make(w, TAPE_NEGATE, factor, factor, 0);
}

/* The factor, with what stands at i around its inside. */
static int more(builder *w, int factor, int i)
{
    const fvi_node at = w->node[i];
    if (at.op == TAPE_NEGATE)
        return negative(w, factor);
    const int other = inside(w, i) == at.a ? at.b : at.a;
    if (factor == ONE && at.op == TAPE_MULTIPLY)
        return other;
    if (factor == ONE)
        factor = make(w, TAPE_NUMBER, 0, 0, 1);
    return make(w, at.op, factor, other, 0);
}

/* factor times what stands at i, sum by sum: signs and what has no coordinate go to
 * each term. A long sum leans to the left: there is no recursion that way. */
static void take_apart(builder *w, int i, int factor)
{
    while (!w->status && hides_a_sum(w, i)) {
        const fvi_node at = w->node[i];
        if (is_sum(w, i)) {
            take_apart(w, at.b,
                       at.op == TAPE_ADD ? factor : negative(w, factor));
            i = at.a;
        } else {
            factor = more(w, factor, i);
            i = inside(w, i);
        }
    }
    if (!w->status)
        add_term(w, factor == ONE ? i : make(w, TAPE_MULTIPLY, factor, i, 0));
}

int fvi_expression_parse(const char *text, const fvi_symbols *names,
                         const double *values, fvi_expression **e,
                         fvi_misprint *wrong)
{
    if (!text || !names || !e || (names->d > 0 && !names->variable))
        FVI_FAIL("null pointer", FVI_EFAULT);
    fvi_misprint place = { 0, "not enough memory" };
    builder *w = calloc(1, sizeof *w);
    fvi_expression *new = calloc(1, sizeof *new);
    int status = w && new ? fvi_parse(text, names, &w->node, &w->count, &place)
                          : FVI_ENOMEM;
    if (!status) {
        const int root = (int)w->count - 1;
        *new = (fvi_expression){ .d = names->d,
                                 .values = values,
                                 .degree = w->node[root].degree };
        w->e = new;
        w->room = w->count;
        if (names->d > 1)
            take_apart(w, root, ONE);
        else
            add_term(w, root);
        if ((status = w->status))
            place = (fvi_misprint){ 0, "a term is too long" };
    }
    if (w)
        free(w->node);
    free(w);
    if (status) {
        fvi_expression_free(new);
        if (wrong)
            *wrong = place;
        return status;
    }
    *e = new;
    return FVI_SUCCESS;
}

void fvi_expression_free(fvi_expression *e)
{
    for (size_t i = 0; e && i < e->count; i++) {
        free(e->terms[i].node);
        free(e->terms[i].coordinate);
    }
    if (e)
        free(e->terms);
    free(e);
}

/* ---- values and derivatives ---- */

double fvi_expression_value(const fvi_expression *e, const double *x)
{
    double sum = 0;
    for (const term *t = e->terms; t < e->terms + e->count; t++)
        sum += fvi_tape_value(t->node, t->count, x, e->values);
    return sum;
}

void fvi_expression_parameter_gradient(const fvi_expression *e, size_t j,
                                 const double *x, double *value, double *grad)
{
    const int parameter = -1 - (int)j;
    *value = 0;
    if (grad)
        memset(grad, 0, e->d * sizeof *grad);
    for (const term *t = e->terms; t < e->terms + e->count; t++) {
        *value += fvi_tape_slope(t->node, t->count, x, e->values, parameter).a;
        for (size_t i = 0; grad && i < t->coordinates; i++)
            grad[t->coordinate[i]] +=
                fvi_tape_second_derivative(t->node, t->count, x, e->values, t->coordinate[i],
                              parameter)
                    .c;
    }
}

static int potential_value(size_t d, const double *x, void *params,
                           double *value)
{
    (void)d;
    *value = fvi_expression_value(params, x);
    return FVI_SUCCESS;
}

static int potential_gradient(size_t d, const double *x, void *params,
                              double *grad)
{
    const fvi_expression *e = params;
    memset(grad, 0, d * sizeof *grad);
    for (const term *t = e->terms; t < e->terms + e->count; t++)
        for (size_t i = 0; i < t->coordinates; i++)
            grad[t->coordinate[i]] +=
                fvi_tape_slope(t->node, t->count, x, e->values,
                               t->coordinate[i])
                    .a;
    return FVI_SUCCESS;
}

static int potential_hessian(size_t d, const double *x, void *params, double *H)
{
    const fvi_expression *e = params;
    const size_t diagonals = e->reach + 1;
    for (size_t i = 0; i < d; i++)
        for (size_t k = 0; k < diagonals && i + k < d; k++)
            H[i * diagonals + k] = 0;
    for (const term *t = e->terms; t < e->terms + e->count; t++)
        for (size_t m = 0; m < t->coordinates; m++)
            for (size_t n = 0; n < t->coordinates; n++) {
                const int i = t->coordinate[m], j = t->coordinate[n];
                if (i <= j)
                    H[(size_t)i * diagonals + (size_t)(j - i)] +=
                        fvi_tape_second_derivative(t->node, t->count, x, e->values, i, j).c;
            }
    return FVI_SUCCESS;
}

static int is_quadratic(const void *params)
{
    return ((const fvi_expression *)params)->degree <= 2;
}

fvi_potential fvi_potential_expression(const fvi_expression *e)
{
    return (fvi_potential){ .value = potential_value,
                            .gradient = potential_gradient,
                            .hessian = potential_hessian,
                            .params = (void *)e,
                            .quadratic = is_quadratic,
                            .diagonals = e->reach + 1 };
}

static int force_value(double t, size_t d, void *params, double *F)
{
    const double value = fvi_expression_value(params, &t);
    for (size_t i = 0; i < d; i++)
        F[i] = value;
    return FVI_SUCCESS;
}

/* A sum of one variable is one term. */
static int force_bound(double from, double to, size_t order, size_t d,
                       void *params, double *most)
{
    const fvi_expression *e = params;
    fvi_enclosure f;
    int status = fvi_tape_enclose(e->terms->node, e->terms->count, from, to,
                                  e->values, (int)order, &f);
    for (size_t k = 0; !status && k <= order; k++)
        for (size_t i = 0; i < d; i++)
            most[k * d + i] = k == 0             ? fvi_enclosure_half(&f)
                              : k <= (size_t)f.top ? f.most[k]
                                                   : 0;
    return status;
}

fvi_force fvi_force_expression(const fvi_expression *e)
{
    return (fvi_force){ .value = force_value,
                        .bound = force_bound,
                        .params = (void *)e };
}

void fvi_expression_complex_value(const fvi_expression *e, double re, double im,
                                  double *value_re, double *value_im)
{
    const double complex v = fvi_tape_complex(e->terms->node, e->terms->count,
                                              CMPLX(re, im), e->values);
    *value_re = creal(v);
    *value_im = cimag(v);
}
