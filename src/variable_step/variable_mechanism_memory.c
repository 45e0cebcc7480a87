/* src/variable_step/variable_mechanism_memory.c -- The modes of the dampers of a mechanism. [H 29, 22] */
#include "variable_mechanism.h"
#include "variable_step_events.h"

#include "kernel/kernel_general.h"
#include "system/arrays.h"
#include "system/fail.h"
#include "system/larger.h"

#include <stdlib.h>
#include <string.h>

/* Return the term of a law that is a single power, which has the modes of the lattice; NULL for any other law, which
 * has modes of its own. */
static const fvi_kernel_term *power_of(const fvi_kernel *kernel)
{
    return kernel->count == 1 && fvi_kernel_term_is_power(kernel->term) ? kernel->term : NULL;
}

static const fvi_damper *damper_of(const fvi_stepper *s, size_t j)
{
    return &s->run.system->mechanism->damper[j];
}

/* ---- the start ---- */

/* Return nonzero if damper j has Riemann and Liouville's past and its elongation jumps from 0 at t = 0. */
static int starts_with_jump(const fvi_stepper *s, size_t j)
{
    return damper_of(s, j)->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE
           && fvi_mechanism_is_stretched(s, j);
}

static int depends_on_jumps(const fvi_stepper *s, size_t j)
{
    return fvi_kernel_growth(damper_of(s, j)->kernel) > 1;
}

/* Return the largest order below 1 of the terms of a law. */
static double order_below_one(const fvi_kernel *kernel)
{
    double order = 0;
    for (size_t i = 0; i < kernel->count; i++)
        if (kernel->term[i].rho > 0 && kernel->term[i].alpha < 0.5)
            order = larger(order, 2 * kernel->term[i].alpha);
    return order;
}

/* Return the smallest order of the Zener terms of a law; INFINITY if there is none. */
static double order_of_relaxation(const fvi_kernel *kernel)
{
    double order = INFINITY;
    for (size_t i = 0; i < kernel->count; i++) {
        const fvi_kernel_term *term = &kernel->term[i];
        if (term->rho > 0 && term->time > 0 && term->kind != FVI_KERNEL_POWER)
            order = smaller(order, 2 * term->alpha);
    }
    return order;
}

/* Return the smallest q < 1 with which a coordinate without inertia leaves its balance like t^q, or INFINITY.
 * *has_jump: nonzero if one of these coordinates jumps before. q is the highest order of its dampers. If all its
 * dampers answer stiffly at once, the coordinate jumps, and q is the order of their relaxation. */
static double power_of_massless(const fvi_stepper *s, int *has_jump)
{
    const fvi_mechanism_state *m = s->mechanism;
    double least = INFINITY;
    *has_jump = 0;
    for (size_t i = 0; i < m->d; i++) {
        double q = 0, relaxation = INFINITY;
        for (size_t j = 0; m->is_massless[i] && j < m->r; j++)
            if (m->G[j * m->d + i] != 0) {
                q = larger(q, fvi_kernel_growth(damper_of(s, j)->kernel));
                relaxation = smaller(relaxation, order_of_relaxation(damper_of(s, j)->kernel));
            }
        if (m->is_massless[i] && q == 0 && relaxation < 1) {
            q = relaxation;
            *has_jump = 1;
        }
        if (q > 0 && q < 1)
            least = smaller(least, q);
    }
    return least;
}

/* The shortest step, as a part of T, after a jump of a coordinate without inertia. Its equation has the square of the
 * length as a factor, and the rounding errors of the equation must not underflow. */
static const double LEAST_OF_MASSLESS = 1e-140;

/* After a jump of zdot, lambda is like t^{1 - order}, and after a jump of z like t^{-order}. So a first step of length
 * h adds about h^{2 - order}, or h^{1 - order}, to p, and h^q to x. Each may be 1e-4 of the tolerance. */
double fvi_mesh_shortest(const fvi_stepper *s, const fvi_variable_step_state *o)
{
    const struct fvi_mesh_mechanism *m = o->mechanism;
    int has_jump;
    const double of_place = power_of_massless(s, &has_jump);
    double shortest = smaller(1, pow(1e-4 * fmin(o->tolerance, 1), 1 / of_place));
    if (has_jump && shortest < LEAST_OF_MASSLESS)
        return 0;
    for (size_t j = 0; j < m->r; j++) {
        const int jumps = depends_on_jumps(s, j)
                          && (fvi_variable_step_velocities_jump(&s->run) || m->damper[j].before != m->damper[j].now);
        const double power = jumps ? 2 - fvi_kernel_growth(damper_of(s, j)->kernel)
                             : starts_with_jump(s, j) ? 1 - order_below_one(damper_of(s, j)->kernel)
                                               : INFINITY;
        shortest = smaller(shortest, pow(1e-4 * fmin(o->tolerance, 1), 1 / power));
    }
    return shortest;
}

static int refuse(fvi_error *error, int code, size_t j, const char *text)
{
    return fvi_at_index(error, j, fvi_fail(error, code, "damper", (double)j + 1, text, j + 1));
}

/* Start the history of damper j. With a jump of its elongation, every mode starts with z_0, and a spring is at rest at
 * 0. */
static void start_stretched_modes(const fvi_stepper *s, fvi_variable_step_state *o, size_t j)
{
    fvi_mesh_damper *to = &o->mechanism->damper[j];
    to->centre = starts_with_jump(s, j) ? 0 : s->mechanism->z[j];
    if (starts_with_jump(s, j))
        fvi_mesh_stretch_damper(o, to, 1, s->mechanism->z + j);
}

/* Set W1 for the terms that depend on zdot - before: a power above the order 1, or the rising terms of a law. Set the
 * leakage, too. */
static void set_rising(const fvi_variable_rule *rule, fvi_mesh_damper *to)
{
    const double ones[FVI_LANES] = { 1, 1, 1, 1, 1, 1, 1, 1 };
    double all[FVI_LANES];
    fvi_square_apply(rule->s, &to->W0, ones, all);
    for (size_t i = 0; i < FVI_LANES; i++)
        to->W1[i] = to->kernel ? all[i] - to->W1[i] : to->beta > 0 ? all[i] : 0;
    to->leakage = fvi_memory_leakage(rule, &to->W0);
}

static int begin_power(const fvi_variable_step_state *o, double rho, double alpha, size_t count,
                       fvi_mesh_damper *to)
{
    to->rho = rho;
    to->beta = 2 * alpha - 1;
    fvi_variable_present(o->rule, to->beta, &to->W0);
    set_rising(o->rule, to);
    if (to->rho == 0 || to->beta == 0 || to->beta == -1)
        return FVI_SUCCESS;
    return fvi_modes_alloc(o->rule, o->modes_kind, to->beta, count, o->T, o->least, &to->modes);
}

static int begin_law(fvi_stepper *s, const fvi_variable_step_state *o, const fvi_kernel *kernel,
                     size_t count, size_t j, fvi_mesh_damper *to)
{
    to->rho = 1;
    to->beta = -0.5; /* only a scale of W0 */
    int status = fvi_variable_step_prepare_kernel(kernel, &to->kernel);
    if (!status)
        status = fvi_variable_step_begin_kernel(o, to->kernel, count, &to->modes, &to->rising);
    return status == FVI_EUNSUP
               ? fvi_at_index(s->error, j, fvi_fail(s->error, status, "damper", (double)j + 1,
                                                    "damper %zu: %s of this law is too near to its cut, or off it, for "
                                                    "modes of variable steps; %sfvi-stable takes it", j + 1,
                                                    fvi_kernel_singularity(kernel),
                                                    s->run.event_count ? "without events " : ""))
               : status;
}

int fvi_mesh_begin_damper(fvi_stepper *s, const fvi_variable_step_state *o,
                          const fvi_kernel *kernel, size_t count, size_t j,
                          fvi_mesh_damper *to)
{
    const fvi_kernel_term *power = power_of(kernel);
    const int status = power ? begin_power(o, power->rho, power->alpha, count, to)
                 : begin_law(s, o, kernel, count, j, to);
    return fvi_variable_step_explain_modes(s, o, status);
}

int fvi_mesh_begin_dampers(fvi_stepper *s, fvi_variable_step_state *o)
{
    int status = FVI_SUCCESS;
    for (size_t j = 0; j < o->mechanism->r && !status; j++) {
        fvi_mesh_damper *to = &o->mechanism->damper[j];
        if (starts_with_jump(s, j))
            status = fvi_mechanism_check_stretch(damper_of(s, j)->kernel, j, s->error);
        if (status)
            return status;
        status = fvi_mesh_begin_damper(s, o, damper_of(s, j)->kernel, 1, j, to);
        if (!status)
            start_stretched_modes(s, o, j);
    }
    return status;
}

int fvi_mesh_allocate(fvi_variable_step_state *o, size_t r, size_t constraints)
{
    const size_t d = o->d;
    struct fvi_mesh_mechanism *m = o->mechanism = calloc(1, sizeof *m);
    if (m)
        m->damper = calloc(r + 1, sizeof *m->damper);
    if (m)
        m->numbers = FVI_ARRAYS({ &m->p_compensation, d }, { &m->p0, d }, { &m->slope0, FVI_LANES * d },
                                { &m->force0, FVI_LANES * r }, { &m->power0, FVI_LANES * r },
                                { &m->by_force0, FVI_LANES }, { &m->impulse0, r }, { &m->work0, r }, { &m->mass, d },
                                { &m->multiplier0, FVI_LANES * constraints }, { &m->slope, FVI_LANES * d },
                                { &m->inverse, d * d });
    if (!m || !m->damper || !m->numbers)
        FVI_FAIL("no memory for the mechanism", FVI_ENOMEM);
    m->r = r;
    return FVI_SUCCESS;
}

int fvi_mesh_start(fvi_stepper *s, fvi_variable_step_state *o)
{
    const size_t r = s->run.system->mechanism->damper_count;
    int status = fvi_mechanism_start(s, FVI_MECHANISM_FORM_D, o->rule->s);
    if (!status)
        status = fvi_mesh_allocate(o, r, s->mechanism->most);
    for (size_t j = 0; j < r && !status; j++) {
        fvi_mesh_damper *to = &o->mechanism->damper[j];
        status = fvi_mechanism_slope(s, j, s->mechanism->v, &to->now);
        const int jumps = depends_on_jumps(s, j) && damper_of(s, j)->past != FVI_INITIAL_HISTORY_CAPUTO;
        to->before = jumps ? 0 : to->now;
        if (fvi_kernel_growth(damper_of(s, j)->kernel) == 2)
            return refuse(s->error, FVI_EUNSUP, j,
                          "damper %zu has the order 2, which is a mass: fvi-adaptive takes it "
                          "in the Lagrangian, fvi-lobatto2d to 8d as it is");
    }
    return status;
}

/* ---- in a step ---- */

void fvi_mesh_present_damper(const fvi_variable_step_state *o, double h, fvi_mesh_damper *of,
                             double *W)
{
    const size_t n = o->rule->s;
    if (of->kernel) {
        fvi_variable_step_present_kernel(o->rule, of->kernel, h, of->beta, &of->W0, of->W1);
        set_rising(o->rule, of);
    }
    const double factor = of->rho * pow(h, -of->beta);
    for (size_t i = 0; i < n; i++)
        for (size_t l = 0; l < n; l++)
            W[i * n + l] = factor * of->W0.column[l][i];
}

void fvi_mesh_present(const fvi_stepper *s, fvi_variable_step_state *o)
{
    struct fvi_mesh_mechanism *m = o->mechanism;
    const double h = o->length.h;
    const size_t n = o->rule->s;
    if (m->h == h)
        return;
    m->h = h;
    for (size_t j = 0; j < m->r; j++)
        fvi_mesh_present_damper(o, h, &m->damper[j], s->mechanism->W + j * n * n);
}

//> predict
void fvi_mesh_predict(const fvi_stepper *s, fvi_variable_step_state *o)
{
    const size_t n = o->rule->s;
    for (size_t j = 0; j < o->mechanism->r; j++) {
        const fvi_mesh_damper *of = &o->mechanism->damper[j];
        double *known = s->mechanism->known + j * n;
        const double factor = of->rho * pow(o->length.h, -of->beta) * of->before,
                     spring = of->beta == -1 ? of->rho * (s->mechanism->z[j] - of->centre) : 0;
        for (size_t i = 0; i < n; i++)
            known[i] = spring - (of->W1[i] != 0 ? factor * of->W1[i] : 0);
        fvi_mesh_add_history(of, o->length, n, 1, known);
    }
}
//< predict

void fvi_mesh_advance(const fvi_stepper *s, fvi_variable_step_state *o)
{
    const size_t n = o->rule->s;
    for (size_t j = 0; j < o->mechanism->r; j++) {
        fvi_mesh_damper *of = &o->mechanism->damper[j];
        double v[FVI_LANES] = { 0 };
        memcpy(v, s->mechanism->zdot + j * n, n * sizeof *v);
        fvi_mesh_advance_damper(of, 0, n, v, &of->before);
        of->now = of->before;
    }
}

/* ---- the modes of a damper ---- */

void fvi_mesh_stretch_damper(fvi_variable_step_state *o, fvi_mesh_damper *of, size_t count, const double *z)
{
    if (!of->modes)
        return;
    o->undeclared_jump_until = o->T; /* the estimate sees only a part of the error of such a start */
    fvi_modes_activate_all(of->modes);
    for (size_t n = 0; n < count; n++)
        for (size_t q = 0; q < fvi_modes_count(of->modes); q++)
            fvi_modes_add(of->modes, n, q, fvi_modes_decay(of->modes, q) * z[n]);
}

void fvi_mesh_add_history(const fvi_mesh_damper *of, fvi_length length, size_t s, size_t count, double *known)
{
    fvi_modes *const both[] = { of->modes, of->rising };
    double H[FVI_LANES];
    for (size_t k = 0; k < 2; k++) {
        if (!both[k])
            continue;
        fvi_modes_begin(both[k], length);
        for (size_t n = 0; n < count; n++) {
            fvi_modes_history(both[k], n, H);
            for (size_t i = 0; i < s; i++)
                known[i * count + n] += of->rho * H[i];
        }
    }
}

void fvi_mesh_advance_damper(const fvi_mesh_damper *of, size_t n, size_t s, const double *v, double *before)
{
    double change[FVI_LANES] = { 0 };
    for (size_t i = 0; i < s; i++)
        change[i] = v[i] - *before;
    if (of->modes)
        fvi_modes_advance(of->modes, n, of->beta > 0 ? change : v, *before);
    if (of->rising)
        fvi_modes_advance(of->rising, n, change, *before);
    *before = v[s - 1];
}

int fvi_mesh_copy_damper(const fvi_mesh_damper *from, fvi_mesh_damper *to)
{
    *to = *from;
    to->modes = to->rising = NULL;
    to->kernel = from->kernel ? fvi_variable_step_copy_kernel(from->kernel) : NULL;
    if (from->kernel && !to->kernel)
        return FVI_ENOMEM;
    const int status = from->modes ? fvi_modes_copy(from->modes, &to->modes) : FVI_SUCCESS;
    return status || !from->rising ? status : fvi_modes_copy(from->rising, &to->rising);
}

int fvi_mesh_archive_damper(fvi_mesh_damper *of, fvi_archive *v)
{
    const int status = of->modes ? fvi_modes_archive(of->modes, v) : FVI_SUCCESS;
    return status || !of->rising ? status : fvi_modes_archive(of->rising, v);
}

void fvi_mesh_free_damper(fvi_mesh_damper *of)
{
    fvi_modes_free(of->modes);
    fvi_modes_free(of->rising);
    free(of->kernel);
}
