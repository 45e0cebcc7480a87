/* src/mechanism/mechanism_nodes.c -- Take a step of order 1 or of the node scheme.             [H 29] */
#include "mechanism_state.h"
#include "run/step_times.h"

#include <math.h>
#include <string.h>

static double time_of(const fvi_stepper *s, size_t k)
{
    return (double)k * s->run.h;
}

/* Return kappa: L is evaluated at kappa x_k + (1 - kappa) x_{k+1}. */
static double kappa_of(const fvi_mechanism_state *o, const fvi_stepper *s)
{
    return o->form == FVI_MECHANISM_NODES ? 0.5 : s->run.kappa;
}

//> point
/* Evaluate L and its derivatives at the point of the step, for x_{k+1} = x_k + u. */
static int evaluate_point(fvi_stepper *s, const double *u)
{
    const fvi_mechanism_state *o = s->mechanism;
    const double ahead = 1 - kappa_of(o, s);
    for (size_t i = 0; i < o->d; i++) {
        o->X[i] = s->x[i] + ahead * u[i];
        o->V[i] = u[i] / s->run.h;
    }
    return fvi_mechanism_point(s, 0, time_of(s, s->k) + ahead * s->run.h,
                               o->form == FVI_MECHANISM_NODES);
}
//< point

/* Evaluate z, G and c at the end of the step, x_k + u. */
static int evaluate_end(fvi_stepper *s, const double *u)
{
    const fvi_mechanism_state *o = s->mechanism;
    const fvi_constraints *c = s->run.system->mechanism->constraints;
    const double t = time_of(s, s->k + 1);
    double *x = o->X + o->d; /* the second point of X */
    for (size_t i = 0; i < o->d; i++)
        x[i] = s->x[i] + u[i];
    int status = fvi_mechanism_elongations(s, t, x, o->elongation, o->gradient);
    if (!status && o->m)
        status = c->value(t, o->d, x, c->params, o->residual + o->d);
    double *C = o->matrix + o->d * o->n; /* the last rows of the Jacobian */
    if (!status && o->m)
        status = c->gradient(t, o->d, x, c->params, C, NULL);
    for (size_t i = o->m; i-- > 0;) { /* widen the rows from d to n numbers */
        memmove(C + i * o->n, C + i * o->d, o->d * sizeof *C);
        memset(C + i * o->n + o->d, 0, o->m * sizeof *C);
    }
    return status;
}

//> damper
/* Return the force of damper j, (29.6), for the elongations at both ends of the step. */
static double damper_force(const fvi_mechanism_state *o, size_t j)
{
    const double mean = (o->z[j] + o->elongation[j]) / 2 - o->z0[j];
    return o->known[j] + o->W[j] * mean;
}
//< damper

/* A coordinate without inertia takes the mean of what acts on it at both ends of a step. With the values at the nodes
 * its mean places would swing about the balance of the forces, which (29.17) and (29.25) do not cancel.
 *
 * force_of_begin -- return the force on coordinate i in the first half of the step: F at its beginning, or the mean.
 * write_gradients -- write the derivatives by x_i of the elongation of damper e for both halves of the step: those at
 * its ends, or twice their mean. */
static double force_of_begin(const fvi_mechanism_state *o, size_t i)
{
    return o->is_massless[i] ? (o->load[i] + o->load[o->d + i]) / 2 : o->load[i];
}

static void write_gradients(const fvi_mechanism_state *o, size_t e, size_t i, double *begin, double *end)
{
    *begin = o->G[e * o->d + i];
    *end = o->gradient[e * o->d + i];
    if (o->is_massless[i])
        *begin = *end = (*begin + *end) / 2;
}

/* Add the derivative by u of half the gradient at the end of the step, times the force of damper e, in the rows of
 * coordinates without inertia. Changes o->fx. */
static int add_curvature_of_massless(fvi_stepper *s, size_t e, double force)
{
    fvi_mechanism_state *o = s->mechanism;
    const fvi_elongation *of = &s->run.system->mechanism->damper[e].of;
    const size_t d = o->d;
    if (!o->any_massless || of->row || !of->hessian)
        return FVI_SUCCESS;
    memset(o->fx, 0, d * d * sizeof *o->fx);
    const double h = s->run.h;
    const int status = of->hessian(time_of(s, s->k + 1), d, o->X + d, h * h / 4 * force, of->params, o->fx);
    for (size_t i = 0; i < d; i++)
        for (size_t j = 0; j < d && o->is_massless[i]; j++)
            o->matrix[i * o->n + j] += o->fx[i * d + j];
    return status;
}

//> residual
/* Assemble h times the equation of p_k. u holds the increment, then h^2 / 2 Lambda. */
static int assemble_equations(fvi_stepper *s, const double *u)
{
    fvi_mechanism_state *o = s->mechanism;
    const size_t d = o->d, n = o->n;
    const double h = s->run.h, kappa = kappa_of(o, s), ahead = 1 - kappa;
    const int is_node = o->form == FVI_MECHANISM_NODES;
    int status = evaluate_point(s, u);
    if (!status && is_node)
        status = evaluate_end(s, u);
    for (size_t i = 0; i < d; i++) {
        o->residual[i] = h
                         * (o->Lv[i] - kappa * h * o->f[i]
                            - h / 2 * force_of_begin(o, i) - s->p[i]);
        for (size_t j = 0; j < d; j++)
            o->matrix[i * n + j] = o->Lvv[i * d + j]
                                   + h * (ahead * o->Lxv[j * d + i]
                                          - kappa * o->fv[i * d + j])
                                   - kappa * ahead * h * h * o->fx[i * d + j];
        for (size_t l = 0; l < o->m; l++) {
            o->residual[i] += o->C[l * d + i] * u[d + l];
            o->matrix[i * n + d + l] = o->C[l * d + i];
        }
    }
    for (size_t e = 0; e < o->r && is_node && !status; e++) {
        const double force = damper_force(o, e);
        status = add_curvature_of_massless(s, e, force);
        for (size_t i = 0; i < d; i++) {
            double G, at_end;
            write_gradients(o, e, i, &G, &at_end);
            const double half = h * h / 2 * G;
            o->residual[i] += half * force + h * G * o->start_impulse[2 * e];
            for (size_t j = 0; j < d; j++)
                o->matrix[i * n + j] +=
                    half * o->W[e] / 2 * o->gradient[e * d + j];
        }
    }
    return status;
}
//< residual

int fvi_mechanism_linearise_nodes(fvi_stepper *s, const double *u)
{
    const fvi_mechanism_state *o = s->method_state;
    const int status = assemble_equations(s, u);
    return status || o->form == FVI_MECHANISM_NODES ? status : evaluate_end(s, u);
}

/* Write the rate at which the time alone changes the elongation of damper j, at the end of the step. */
static int elongation_rate_at_end(const fvi_stepper *s, size_t j, double *rate)
{
    const fvi_elongation *of = &s->run.system->mechanism->damper[j].of;
    *rate = 0;
    return of->row || !of->rate ? FVI_SUCCESS : of->rate(time_of(s, s->k + 1), s->mechanism->d, s->x, of->params, rate);
}

/* End a step of order 1. Here F, the forces of velocity and the dampers act at the end of the step. */
static int end_first_order(fvi_stepper *s)
{
    fvi_mechanism_state *o = s->mechanism;
    const fvi_state_force *force = s->run.system->mechanism->force_on;
    const size_t d = o->d;
    const double h = s->run.h, t = time_of(s, s->k + 1);
    int status = fvi_mechanism_force(s, t, o->load);
    if (!status && force) {
        status = force->at(t, d, s->x, o->V, force->params, o->room, NULL, NULL);
        if (!status)
            status = fvi_mechanism_finite_forces(s, t, o->room);
        for (size_t i = 0; i < d; i++)
            o->load[i] += o->room[i];
    }
    if (!status)
        status = fvi_mechanism_elongations(s, t, s->x, o->z, o->G);
    if (!status)
        status = fvi_mechanism_finite_elongations(s, t, o->z);
    for (size_t j = 0; j < o->r; j++)
        o->zdot[j] = o->z[j] - o->z0[j];
    if (!status)
        status = fvi_mechanism_update_histories(s, t, o->zdot);
    for (size_t i = 0; i < d; i++)
        s->p[i] += h * (o->f[i] + o->load[i]);
    for (size_t j = 0; j < o->r && !status; j++) {
        const double *G = o->G + j * d, force_now = o->lambda[j];
        double rate;
        status = elongation_rate_at_end(s, j, &rate);
        for (size_t i = 0; i < d; i++) {
            s->p[i] -= h * force_now * G[i];
            o->work[j] += force_now * G[i] * s->dx[i];
        }
        o->work[j] += force_now * (h * rate);
        o->impulse[j] += h * force_now;
    }
    return status;
}

/* Apply the multipliers, and project p_{k+1} to the hidden constraint. */
static int end_constraints(fvi_stepper *s, const double *u)
{
    fvi_mechanism_state *o = s->mechanism;
    const fvi_constraints *c = s->run.system->mechanism->constraints;
    const double t = time_of(s, s->k + 1), h = s->run.h;
    for (size_t l = 0; l < o->m; l++) {
        o->begun[l] = 2 * u[o->d + l] / (h * h);
        for (size_t i = 0; i < o->d; i++)
            s->p[i] -= o->C[l * o->d + i] * u[o->d + l] / h;
    }
    memcpy(o->v, o->V, o->d * sizeof *o->v); /* the initial guess is the mean velocity of the step */
    int status = FVI_SUCCESS;
    if (o->m)
        status = c->gradient(t, o->d, s->x, c->params, o->C, NULL);
    if (!status && o->m)
        status = fvi_mechanism_project_momentum(s, t, s->x, o->C, s->p, o->v,
                                                o->ended);
    for (size_t l = 0; l < o->m; l++) {
        o->ended[l] *= 2 / h;
        o->tie[l] += h / 2 * (o->begun[l] + o->ended[l]);
    }
    return status;
}

static int end_nodes(fvi_stepper *s, const double *u)
{
    fvi_mechanism_state *o = s->mechanism;
    const size_t d = o->d;
    const double h = s->run.h;
    for (size_t i = 0; i < d; i++)
        s->p[i] += h * o->f[i] + h / 2 * (o->load[i] + o->load[d + i]);
    for (size_t j = 0; j < o->r; j++) {
        const double force = damper_force(o, j),
                     before = h / 2 * force + o->start_impulse[2 * j],
                     after = h / 2 * force + o->start_impulse[2 * j + 1];
        for (size_t i = 0; i < d; i++) {
            double at_begin, at_end;
            write_gradients(o, j, i, &at_begin, &at_end);
            s->p[i] -= before * at_begin + after * at_end;
        }
        o->impulse[j] += before + after;
        o->work[j] += (before + after) / h * (o->elongation[j] - o->z[j]);
        o->zdot[j] = (o->z[j] + o->elongation[j]) / 2 - o->z0[j];
    }
    memcpy(o->z, o->elongation, o->r * sizeof *o->z);
    memcpy(o->G, o->gradient, o->r * d * sizeof *o->G);
    const int status =
        fvi_mechanism_update_histories(s, time_of(s, s->k) + h / 2, o->zdot);
    return status ? status : end_constraints(s, u);
}

/* Evaluate F at both ends of the step as limits from within, (13.12). In the scheme of order 1 nothing
 * acts at the beginning. */
static int forces_at_ends(fvi_stepper *s)
{
    fvi_mechanism_state *o = s->mechanism;
    memset(o->load, 0, 2 * o->d * sizeof *o->load);
    if (o->form == FVI_MECHANISM_FIRST_ORDER || !s->run.system->force.value)
        return FVI_SUCCESS;
    const int status = fvi_mechanism_force(
        s, fvi_just_after(time_of(s, s->k)), o->load);
    return status ? status
                  : fvi_mechanism_force(s, fvi_just_before(time_of(s, s->k + 1)),
                                        o->load + o->d);
}

//> smooth
/* Smooth the coordinates without inertia. Their equation determines only the mean of two nodes, so an oscillation
 * (-1)^k of the position never decays. The output is the line through the last two means, evaluated at t_k: (3 x_k + 2
 * x_{k-1} - x_{k-2}) / 4 (29.17). The velocity at t_k is the slope of the parabola through the last three means, (2
 * x_k - x_{k-1} - 2 x_{k-2} + x_{k-3}) / 2h (29.25), and in the first two steps the slope of a line. */
static void smooth_massless(fvi_stepper *s)
{
    fvi_mechanism_state *o = s->mechanism;
    const size_t d = o->d;
    const double h = s->run.h;
    double *now = o->raw, *before = now + d, *last = before + d, *first = last + d;
    memcpy(first, last, d * sizeof *first);
    memcpy(last, before, d * sizeof *last);
    memcpy(before, now, d * sizeof *before);
    memcpy(now, s->x, d * sizeof *now);
    for (size_t i = 0; i < d; i++) {
        if (!o->is_massless[i])
            continue;
        s->x[i] = s->k == 0
                      ? (now[i] + before[i]) / 2
                      : (3 * now[i] + 2 * before[i] - last[i]) / 4;
        o->v[i] = s->k == 0   ? (now[i] - before[i]) / h
                  : s->k == 1 ? (now[i] - last[i]) / (2 * h)
                              : (2 * now[i] - before[i] - 2 * last[i] + first[i]) / (2 * h);
    }
}
//< smooth

//> step
int fvi_mechanism_step_nodes(fvi_stepper *s)
{
    fvi_mechanism_state *o = s->mechanism;
    const size_t d = o->d;
    if (o->any_massless)
        memcpy(s->x, o->raw, d * sizeof *s->x);
    int status = forces_at_ends(s);
    if (!status)
        status = fvi_mechanism_predict_forces(s);
    if (!status) /* the last increment is the initial guess */
        status = fvi_mechanism_solve(s, assemble_equations, d, o->u);
    o->has_root = 1;
    if (!status)
        status = evaluate_point(s, o->u);
    o->has_root = 0;
    if (!status && o->form == FVI_MECHANISM_NODES)
        status = evaluate_end(s, o->u);
    if (status)
        return status;
    memcpy(s->dx, o->u, d * sizeof *s->dx);
    for (size_t i = 0; i < d; i++)
        s->x[i] += o->u[i];
    status = o->form == FVI_MECHANISM_NODES ? end_nodes(s, o->u)
                                            : end_first_order(s);
    if (!status && o->any_massless)
        smooth_massless(s);
    return status;
}
//< step
