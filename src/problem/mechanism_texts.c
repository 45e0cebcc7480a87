/* src/problem/mechanism_texts.c -- Evaluate the Lagrangians, elongations, constraints and forces of texts. [H 29] */
#include "typed_mechanism.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* The variables of an expression in one array, a gradient and a Hessian, of n variables. They are on the stack if there
 * are few variables, because every step needs them. */
enum { FEW = 17, ROOM = (FEW + 2) * FEW };
typedef struct {
    size_t n;
    double *y, *gradient, *hessian, *kept, small[ROOM];
} variables;

/* Fill in the variables x1, ..., xd; v1, ..., vd unless v is NULL; t. Return FVI_SUCCESS or FVI_ENOMEM. */
static int open_variables(variables *w, const fvi_expression *e, size_t d,
                          const double *x, const double *v, double t)
{
    const size_t n = w->n = fvi_expression_variables(e);
    w->kept = n > FEW ? malloc((n + 2) * n * sizeof *w->kept) : NULL;
    if (n > FEW && !w->kept)
        return FVI_ENOMEM;
    w->y = w->kept ? w->kept : w->small;
    w->gradient = w->y + n;
    w->hessian = w->gradient + n;
    memcpy(w->y, x, d * sizeof *x);
    if (v)
        memcpy(w->y + d, v, d * sizeof *v);
    w->y[n - 1] = t;
    return FVI_SUCCESS;
}

static void close_variables(variables *w)
{
    free(w->kept);
}

static void make_hessian(variables *w, const fvi_expression *e, double factor)
{
    memset(w->hessian, 0, w->n * w->n * sizeof *w->hessian);
    fvi_expression_add_hessian(e, w->y, factor, w->hessian);
}

/* Copy a block of d by d numbers, from `row` and `column` on, into a matrix, unless that is NULL. */
static void copy_block(const variables *w, size_t d, size_t row, size_t column,
                       double *to)
{
    for (size_t i = 0; to && i < d; i++)
        memcpy(to + i * d, w->hessian + (row + i) * w->n + column,
               d * sizeof *to);
}

/* ---- L ---- */

static int lagrangian_at(double t, size_t d, const double *x, const double *v,
                         void *params, double *L, double *Lx, double *Lv,
                         double *Lxx, double *Lxv, double *Lvv)
{
    const fvi_expression *e = params;
    variables w;
    const int status = open_variables(&w, e, d, x, v, t);
    if (status)
        return status;
    if (L)
        *L = fvi_expression_value(e, w.y);
    if (Lx || Lv)
        fvi_expression_gradient(e, w.y, w.gradient);
    if (Lx)
        memcpy(Lx, w.gradient, d * sizeof *Lx);
    if (Lv)
        memcpy(Lv, w.gradient + d, d * sizeof *Lv);
    if (Lxx || Lxv || Lvv)
        make_hessian(&w, e, 1);
    copy_block(&w, d, 0, 0, Lxx);
    copy_block(&w, d, 0, d, Lxv);
    copy_block(&w, d, d, d, Lvv);
    close_variables(&w);
    return FVI_SUCCESS;
}

int fvi_typed_lagrangian_by_parameter(size_t j, double t, size_t d, const double *x, const double *v,
                                      void *params, double *value, double *Sx, double *Sv)
{
    const fvi_expression *e = params;
    variables w;
    double own;
    const int status = open_variables(&w, e, d, x, v, t);
    if (status)
        return status;
    fvi_expression_parameter_gradient(e, j, w.y, &own, w.gradient);
    if (value)
        *value = own;
    for (size_t i = 0; i < d; i++) {
        Sx[i] += w.gradient[i];
        Sv[i] += w.gradient[d + i];
    }
    close_variables(&w);
    return FVI_SUCCESS;
}

int fvi_typed_lagrangian_column(size_t j, double t, size_t d, const double *x, const double *v,
                                void *params, double *Sx, double *Sv)
{
    return fvi_typed_lagrangian_by_parameter(j, t, d, x, v, params, NULL, Sx, Sv);
}

/* ---- elongations ---- */

int fvi_text_value(double t, size_t d, const double *x, void *params, double *g)
{
    const fvi_typed_expression *of = params;
    variables w;
    const int status = open_variables(&w, of->e, d, x, NULL, t);
    if (status)
        return status;
    *g = fvi_expression_value(of->e, w.y);
    close_variables(&w);
    return FVI_SUCCESS;
}

int fvi_text_slopes(double t, size_t d, const double *x, const fvi_typed_expression *of, double *G, double *rate)
{
    variables w;
    const int status = open_variables(&w, of->e, d, x, NULL, t);
    if (status)
        return status;
    fvi_expression_gradient(of->e, w.y, w.gradient);
    if (G)
        memcpy(G, w.gradient, d * sizeof *G);
    if (rate)
        *rate = w.gradient[d];
    close_variables(&w);
    return FVI_SUCCESS;
}

static int elongation_gradient(double t, size_t d, const double *x,
                               void *params, double *G)
{
    return fvi_text_slopes(t, d, x, params, G, NULL);
}

static int elongation_rate(double t, size_t d, const double *x, void *params,
                           double *rate)
{
    return fvi_text_slopes(t, d, x, params, NULL, rate);
}

int fvi_text_hessian(double t, size_t d, const double *x, double factor, void *params, double *H)
{
    const fvi_typed_expression *of = params;
    variables w;
    const int status = open_variables(&w, of->e, d, x, NULL, t);
    if (status)
        return status;
    make_hessian(&w, of->e, factor);
    for (size_t i = 0; i < d; i++)
        for (size_t j = 0; j < d; j++)
            H[i * d + j] += w.hessian[i * w.n + j];
    close_variables(&w);
    return FVI_SUCCESS;
}

fvi_elongation fvi_elongation_of_text(fvi_typed_expression *of)
{
    return (fvi_elongation){ .value = fvi_text_value,
                             .gradient = elongation_gradient,
                             .hessian = fvi_text_hessian,
                             .rate = elongation_rate,
                             .params = of };
}

/* ---- constraints ---- */

static int constraint_values(double t, size_t d, const double *x, void *params,
                             double *c)
{
    const fvi_typed_mechanism *m = params;
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < m->constraints && !status; i++) {
        fvi_typed_expression *of = &m->constraint[i];
        if (of->index)
            c[i] = x[of->index - 1] - fvi_expression_value(of->e, &t);
        else
            status = fvi_text_value(t, d, x, of, &c[i]);
    }
    return status;
}

static int constraint_gradients(double t, size_t d, const double *x,
                                void *params, double *C, double *ct)
{
    const fvi_typed_mechanism *m = params;
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < m->constraints && !status; i++) {
        const fvi_typed_expression *of = &m->constraint[i];
        if (!of->index) {
            status = fvi_text_slopes(t, d, x, of, C + i * d, ct ? ct + i : NULL);
            continue;
        }
        memset(C + i * d, 0, d * sizeof *C);
        C[i * d + of->index - 1] = 1;
        if (!ct)
            continue;
        fvi_expression_gradient(of->e, &t, ct + i);
        ct[i] = -ct[i];
    }
    return status;
}

static int constraint_hessians(double t, size_t d, const double *x,
                               const double *factor, void *params, double *H)
{
    const fvi_typed_mechanism *m = params;
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < m->constraints && !status; i++)
        if (!m->constraint[i].index)
            status = fvi_text_hessian(t, d, x, factor[i], &m->constraint[i],
                                        H);
    return status;
}

/* ---- forces ---- */

static int add_force(const fvi_typed_expression *of, double t, size_t d,
                     const double *x, const double *v, double *F, double *Fx,
                     double *Fv)
{
    const size_t i = of->index - 1;
    variables w;
    const int status = open_variables(&w, of->e, d, x, v, t);
    if (status)
        return status;
    F[i] += fvi_expression_value(of->e, w.y);
    if (Fx || Fv)
        fvi_expression_gradient(of->e, w.y, w.gradient);
    for (size_t j = 0; j < d; j++) {
        if (Fx)
            Fx[i * d + j] += w.gradient[j];
        if (Fv)
            Fv[i * d + j] += w.gradient[d + j];
    }
    close_variables(&w);
    return FVI_SUCCESS;
}

static int forces_at(double t, size_t d, const double *x, const double *v,
                     void *params, double *F, double *Fx, double *Fv)
{
    const fvi_typed_mechanism *m = params;
    int status = FVI_SUCCESS;
    memset(F, 0, d * sizeof *F);
    if (Fx)
        memset(Fx, 0, d * d * sizeof *Fx);
    if (Fv)
        memset(Fv, 0, d * d * sizeof *Fv);
    for (size_t i = 0; i < m->forces && !status; i++)
        status = add_force(&m->force[i], t, d, x, v, F, Fx, Fv);
    return status;
}

/* ---- by the parameters of the texts ---- */

/* Compute the derivative of e by parameter j: to *value, and its gradient by x to by_x, d numbers, and by t to *by_t.
 * by_x and by_t may be NULL. Return FVI_SUCCESS or FVI_ENOMEM. */
static int column(const fvi_expression *e, size_t j, double t, size_t d, const double *x,
                  const double *v, double *value, double *by_x, double *by_t)
{
    variables w;
    const int status = open_variables(&w, e, d, x, v, t);
    if (status)
        return status;
    fvi_expression_parameter_gradient(e, j, w.y, value, w.gradient);
    if (by_x)
        memcpy(by_x, w.gradient, d * sizeof *by_x);
    if (by_t)
        *by_t = w.gradient[w.n - 1];
    close_variables(&w);
    return FVI_SUCCESS;
}

static int force_column(size_t j, double t, size_t d, const double *x, const double *v,
                        void *params, double *F)
{
    const fvi_typed_mechanism *m = params;
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < m->forces && !status; i++) {
        double more = 0;
        status = column(m->force[i].e, j, t, d, x, v, &more, NULL, NULL);
        F[m->force[i].index - 1] += more;
    }
    return status;
}

static int elongation_column(size_t j, size_t e, double t, size_t d, const double *x, void *params,
                             double *g, double *G, double *gt)
{
    const fvi_typed_mechanism *m = params;
    return column(m->typed[e].of.e, j, t, d, x, NULL, g, G, gt);
}

static int constraint_column(size_t j, double t, size_t d, const double *x, void *params, double *c,
                             double *C, double *ct)
{
    const fvi_typed_mechanism *m = params;
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < m->constraints && !status; i++) {
        const fvi_typed_expression *of = &m->constraint[i];
        if (!of->index) {
            status = column(of->e, j, t, d, x, NULL, c + i, C + i * d, ct + i);
            continue;
        }
        fvi_expression_parameter_gradient(of->e, j, &t, c + i, ct + i);
        memset(C + i * d, 0, d * sizeof *C);
        c[i] = -c[i];
        ct[i] = -ct[i];
    }
    return status;
}

fvi_mechanism_columns fvi_typed_mechanism_columns(const fvi_typed_mechanism *m, size_t count)
{
    return (fvi_mechanism_columns){ .count = count,
                                    .force = force_column,
                                    .elongation = elongation_column,
                                    .constraint = constraint_column,
                                    .params = (void *)(uintptr_t)m };
}

/* ---- all of it ---- */

void fvi_mechanism_of_texts(fvi_typed_mechanism *m)
{
    m->L = (fvi_lagrangian){ lagrangian_at, m->lagrangian };
    m->F = (fvi_state_force){ forces_at, m };
    for (size_t i = 0; i < m->constraints; i++)
        m->imposed[i] = m->constraint[i].index;
    m->c = (fvi_constraints){ .count = m->constraints,
                              .name = m->name,
                              .imposed = m->imposed,
                              .value = constraint_values,
                              .gradient = constraint_gradients,
                              .hessian = constraint_hessians,
                              .params = m };
    m->all = (fvi_mechanism){ .damper_count = m->dampers,
                              .damper = m->damper,
                              .lagrangian = m->lagrangian ? &m->L : NULL,
                              .force_on = m->forces ? &m->F : NULL,
                              .constraints = m->constraints ? &m->c : NULL };
}

const fvi_mechanism *fvi_mechanism_typed(const fvi_typed_mechanism *m)
{
    return &m->all;
}
