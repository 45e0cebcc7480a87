/* src/command_gradient/fvi_gradient_room.c -- Allocate the arrays of derivatives that `fvi gradient` computes. */
#include "fvi_gradient_answer.h"

#include "input/fvi_files.h"
#include "output/fvi_complain.h"
#include "output/fvi_table.h"

#include <stdlib.h>

typedef fvi_gradient_request request;

/* ---- how many ---- */

size_t fvi_gradient_dampers(const request *r)
{
    return r->system.mechanism ? r->system.mechanism->damper_count : 0;
}

size_t fvi_gradient_terms(const request *r)
{
    size_t terms = r->terms;
    for (size_t j = 0; j < fvi_gradient_dampers(r); j++)
        terms += r->system.mechanism->damper[j].kernel->count;
    return terms;
}

/* Return term i of the law, or of the laws of all dampers. */
static const fvi_kernel_term *term_of(const request *r, size_t i)
{
    const fvi_damper *of = r->system.mechanism ? r->system.mechanism->damper : NULL;
    while (of && i >= of->kernel->count)
        i -= of++->kernel->count;
    return of ? of->kernel->term + i : r->run.law->term + i;
}

/* The derivatives are by x0, p0, masses and dampings, by alpha, c and g, by each --let, and by the terms of laws. */
size_t fvi_gradient_numbers(const request *r)
{
    return 4 * r->o.d + 3 + r->o.lets.count + fvi_gradient_dampers(r)
           + 4 * fvi_gradient_terms(r);
}

int fvi_gradient_force_has_lets(const request *r)
{
    for (size_t j = 0; r->by_lets && j < r->o.lets.count; j++)
        if (r->o.lets.used[j] & FVI_USED_BY_FORCE)
            return 1;
    return 0;
}

/* The kernel of two springpots in series has the fields rho1 and time = rho1 / rho2. The user has typed rho1 and rho2.
 * So the derivative by rho1 gets a second part, and the derivative by rho2 takes the place of that by the time. */
void fvi_gradient_name_pairs(request *r)
{
    for (size_t i = 0; r->to.times && i < fvi_gradient_terms(r); i++) {
        const fvi_kernel_term *t = term_of(r, i);
        if (t->kind != FVI_KERNEL_MAXWELL2 || t->rho == 0)
            continue;
        const double by_time = r->to.times[i];
        if (r->to.terms)
            r->to.terms[i] += t->time / t->rho * by_time;
        r->to.times[i] = -t->time * t->time / t->rho * by_time;
    }
}

/* ---- where ---- */

static int differentiate_by_let(size_t j, size_t d, const double *x, void *params, double *S)
{
    double value;
    (void)d;
    fvi_expression_parameter_gradient(params, j, x, &value, S);
    return 0;
}

/* Return nonzero if there is a derivative by alpha. There is none with a law. In form M the momentum p at alpha = 1 is
 * another number than below 1, see (17.17). A mesh that was made without a singular start has no derivative by it. */
static int has_alpha(const request *r)
{
    const fvi_method *m = r->o.method;
    if (r->terms || r->system.mechanism || (r->system.matrices && m->dense && r->run.alpha == 0))
        return 0;
    if (m->scheme == FVI_SCHEME_VARIABLE_STEP
        && (r->run.alpha == 0 || r->run.alpha == 1))
        return !fvi_initial_history_acts(r->run.past, r->run.alpha);
    return !m->stages || m->damped_inertia || r->o.alpha < 1;
}

const fvi_lagrangian *fvi_gradient_lagrangian(const request *r)
{
    return r->system.mechanism ? r->system.mechanism->lagrangian : NULL;
}

/* Return nonzero for a sum of laws that grows faster than s, which has no derivatives by its parameters with stages. */
static int has_fast_growth(const fvi_kernel *kernel)
{
    return (kernel->count > 1 || kernel->term->kind != FVI_KERNEL_POWER)
           && fvi_kernel_growth(kernel) > 1;
}

int fvi_gradient_make_room_of_forces(request *r)
{
    const size_t d = r->o.d;
    const double rows = 8 * (double)d * (double)r->per * (double)(r->o.steps + 1);
    if (!r->words.own[FORCES] && !fvi_gradient_force_has_lets(r) && !(r->o.ground && r->to.mass))
        return 0;
    if (rows < fvi_machine_bytes())
        r->force = malloc((r->o.steps * r->per + 1) * d * sizeof *r->force);
    r->to.force = r->force;
    return r->force ? 0 : fvi_complain("not enough memory");
}

/* Make room for the derivatives by each --let in dampers between points, constraints and forces of velocity. */
static void make_room_of_mechanism(request *r)
{
    int is_used = 0;
    for (size_t j = 0; j < r->o.lets.count; j++)
        is_used |= (r->o.lets.used[j] & FVI_USED_BY_MECHANISM) != 0;
    if (!is_used || !r->o.mechanism)
        return;
    r->columns = fvi_typed_mechanism_columns(r->o.mechanism, r->o.lets.count);
    r->to.columns = &r->columns;
    r->to.names = r->names;
}

int fvi_gradient_make_room(request *r)
{
    const size_t d = r->o.d;
    make_room_of_mechanism(r);
    r->to.sensitivity = fvi_parameter_gradient_of(&r->system.potential);
    if (r->o.potential.expression)
        r->to.sensitivity = (fvi_parameter_gradient){ r->o.lets.count, differentiate_by_let };
    const fvi_lagrangian *L = fvi_gradient_lagrangian(r);
    const size_t terms = fvi_gradient_terms(r);
    if (L) {
        r->to.sensitivity = (fvi_parameter_gradient){ r->o.lets.count, NULL };
        r->to.lagrangian = fvi_typed_lagrangian_column;
    }
    r->numbers = calloc(fvi_gradient_numbers(r), sizeof(double));
    if (!r->numbers)
        return fvi_complain("not enough memory");
    r->to.x0 = r->numbers;
    r->to.p0 = r->to.x0 + d;
    r->lets = r->to.p0 + 3 * d + 3; /* the numbers of --let come after c and g */
    r->to.mass = r->to.p0 + d;
    r->to.damping = r->to.mass + d;
    r->has_mass = !L && !(r->o.ground && r->o.method->scheme == FVI_SCHEME_VARIABLE_STEP);
    if (!r->has_mass)
        r->to.mass = NULL;
    r->has_alpha = has_alpha(r);
    r->to.alpha = r->has_alpha ? r->to.damping + d : NULL;
    r->to.parameters = r->o.potential.expression || L ? r->lets : r->to.damping + d + 1;
    double *of_laws = r->lets + r->o.lets.count;
    if (r->system.mechanism) { /* a number for each damper */
        r->to.damping = of_laws;
        of_laws += fvi_gradient_dampers(r);
    }
    if (terms == 0)
        return 0;
    if (r->o.method->scheme != FVI_SCHEME_VARIABLE_STEP || (terms == 1 && !r->system.mechanism))
        r->to.terms = of_laws;
    r->has_terms = r->to.terms != NULL;
    if (r->o.method->scheme == FVI_SCHEME_VARIABLE_STEP)
        return 0;
    int any_grows = r->system.matrices && r->run.law && has_fast_growth(r->run.law);
    for (size_t j = 0; j < fvi_gradient_dampers(r); j++)
        any_grows |= has_fast_growth(r->system.mechanism->damper[j].kernel);
    if (r->o.method->stages && any_grows) {
        r->to.terms = NULL;
        r->has_terms = 0;
        return 0;
    }
    for (size_t i = 0; i < terms; i++) {
        r->has_pairs |= term_of(r, i)->kind == FVI_KERNEL_MAXWELL2;
    }
    r->has_orders = 1;
    r->to.orders = r->to.terms + terms;
    r->to.times = r->to.orders + terms;
    r->to.ends = r->to.times + terms;
    return 0;
}
