/* src/run/step_force.c -- Evaluate the force F(t) of a step, and check that it is finite. [H 2] */
#include "step_force.h"

#include "system/fail.h"

#include <string.h>

/* 0 v is 0 for a finite v and NaN otherwise, and so is the sum. The sum may be taken in any order, so the loop is
 * vectorised. */
int fvi_many_are_finite(size_t n, const double *v)
{
    double sum = 0;
#pragma omp simd reduction(+ : sum)
    for (size_t i = 0; i < n; i++)
        sum += 0 * v[i];
    return sum == 0;
}

int fvi_step_force(const fvi_stepper *s, double t, double *F)
{
    const fvi_force *force = &s->run.system->force;
    const size_t d = s->run.system->d;
    if (force->value)
        return force->value(t, d, force->params, F);
    memset(F, 0, d * sizeof *F);
    return FVI_SUCCESS;
}

int fvi_check_finite(const fvi_stepper *s, const char *field, const char *what, const char *which, double t, size_t n,
                     const double *v)
{
    const double begin = 1e-12 * s->run.h; /* a time before it is a limit at t = 0 */
    size_t i = 0;
    if (fvi_row_is_finite(n, v))
        return FVI_SUCCESS;
    while (i + 1 < n && isfinite(v[i]))
        i++;
    const char *words = fvi_not_finite_in_words(v[i]);
    const double when = t < begin ? 0 : t;
    return fvi_at_index(s->error, i,
                        n > 1 ? fvi_fail(s->error, FVI_EBADFUNC, field, v[i], "%s%s%zu is %s at t = %.10g", what,
                                         which, i + 1, words, when)
                              : fvi_fail(s->error, FVI_EBADFUNC, field, v[i], "%s is %s at t = %.10g", what, words,
                                         when));
}

/* Check F(t) of many coordinates, or describe F(t) of one. The function is not inlined, so fvi_force_value is short. */
__attribute__((noinline)) static int check_force(const fvi_stepper *s, double t, const double *F)
{
    return fvi_check_finite(s, "force", "the force", " on coordinate ", t, s->run.system->d, F);
}

int fvi_finite_step_force(const fvi_stepper *s, double t, double *F)
{
    const int status = fvi_step_force(s, t, F);
    return status ? status : check_force(s, t, F);
}

int fvi_force_value(fvi_stepper *s, double t)
{
    const fvi_system *system = s->run.system;
    if (!system->force.value)
        return FVI_SUCCESS;
    const int status = system->force.value(t, system->d, system->force.params, s->F);
    return status || (system->d == 1 && isfinite(*s->F)) ? status : check_force(s, t, s->F);
}
