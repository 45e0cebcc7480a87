/* src/problem/force_check.c -- Check that a typed force is finite at all times at which a run asks for it. */
#include "estimation/identification_data.h"
#include "methods/force_times.h"
#include "run/step_force.h"

#include <fvi/typed_fit.h>

#include <math.h>

typedef struct {
    const fvi_method *method;
    fvi_force force; /* of one number */
    double h;
    size_t bounds;   /* so many intervals may yet be bounded */
    double t, F;     /* output: a time at which F is not finite, and F */
} check;

/* Return nonzero if F(t) is not finite; or, with only_infinite, if it is infinite. */
static int is_bad(check *c, double t, int only_infinite)
{
    double F = 0;
    if (c->force.value(t, 1, c->force.params, &F) || isfinite(F) || (only_infinite && isnan(F)))
        return 0;
    c->t = t;
    c->F = F;
    return 1;
}

/* Return nonzero if F is not finite in step k. A method that takes the limits of F at the ends of the step has a huge
 * value where F is infinite there. But sin(t - 1)/(t - 1), which is not a number at t = 1, has a limit. */
static int is_bad_in_step(check *c, size_t k)
{
    double t[FVI_MOST_FORCE_TIMES];
    const size_t n = fvi_step_force_times(c->method, c->h, k, t);
    for (size_t i = 0; i < n; i++)
        if (is_bad(c, t[i], 0))
            return 1;
    return n > 1 && is_bad(c, (double)(k + 1) * c->h, 1);
}

/* Return nonzero if F is known to be finite in the steps from `first` to before `last`, and at their ends. */
static int is_bounded(check *c, size_t first, size_t last)
{
    const double around = 1e-15, from = (double)first * c->h, to = (double)last * c->h;
    double most = INFINITY;
    if (!c->force.bound || c->bounds == 0)
        return 0;
    c->bounds--;
    return !c->force.bound(from * (1 - around), to * (1 + around), 0, 1, c->force.params, &most) && isfinite(most);
}

/* Return nonzero if F is not finite in one of these steps, the first one. Where F has no bound, halve the interval. So
 * a force with few poles costs some bounds, and not a value for each step. */
static int is_bad_between(check *c, size_t first, size_t last)
{
    const size_t middle = first + (last - first) / 2;
    if (last - first == 1)
        return is_bad_in_step(c, first);
    return !is_bounded(c, first, last) && (is_bad_between(c, first, middle) || is_bad_between(c, middle, last));
}

int fvi_check_force(const fvi_method *method, double h, size_t steps, const char *field, const char *text,
                    const fvi_typed_force *force, fvi_error *error)
{
    const int status = fvi_check_start_force(method, field, text, force, error);
    check c = { .method = method, .h = h, .bounds = 64 + steps / 8 };
    if (force)
        c.force = fvi_force_typed(force);
    if (status || steps == 0 || method->dense || !c.force.value || !is_bad_between(&c, 0, steps))
        return status;
    return fvi_fail(error, FVI_EINVAL, field, c.F, "'%s' is %s at t = %.10g, where %s asks for it", text,
                    fvi_not_finite_in_words(c.F), c.t < 1e-12 * h ? 0 : c.t, method->name);
}

int fvi_check_force_of_fit(const fvi_estimation *fit, const char *field, const char *text,
                           const fvi_typed_force *force, fvi_error *error)
{
    enum { MOST_STEPS = 1 << 20 };
    const double steps = fvi_estimation_equal_steps(fit), whole = round(steps);
    const int ends_there = whole >= 1 && whole <= MOST_STEPS && fabs(steps - whole) <= 1e-9 * whole;
    return fvi_check_force(fit->method, ends_there ? fvi_estimation_last_time(fit) / whole : 1,
                           ends_there ? (size_t)whole : 0, field, text, force, error);
}
