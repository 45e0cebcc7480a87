/* src/stability/warnings.c -- Warnings before and along a run: no solution, an unstable step. [H 14, 19] */
#include <fvi/warnings.h>

#include <fvi/error.h>
#include <fvi/stability.h>
#include "run/solution.h"
#include "system/larger.h"
#include "system/quadratic.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>

enum {
    MOST_MASSES = 256, /* with more masses than this, the modes would take too long */
    BETWEEN = 8 /* steps from one check of the load to the next */
};

#define NO_SOLUTION(START)                                                     \
    "rl with " START " != 0 and alpha > 1/2 has no solution; these rows "      \
    "depend on h and come near to no motion"
#define NO_MEMORY(WHAT) "there is no memory to find out whether " WHAT

int fvi_warning_of_initial_history(const fvi_run *run, const char **text)
{
    int has;
    const int status = fvi_run_has_solution(run, &has);
    *text = NULL;
    if (status == FVI_ENOMEM) {
        *text = NO_MEMORY("a motion starts so");
        return -1;
    }
    if (status || has)
        return 0;
    *text = run->system->mechanism  ? NO_SOLUTION("an elongation")
            : run->system->matrices ? NO_SOLUTION("C x0")
                                    : NO_SOLUTION("x0");
    return 1;
}

/* The load of a run, which is above 1 if a mode grows; and *h, the step where the load reaches 1. *h is 0 if no step is
 * stable, and NaN if the method cannot tell. Returns 0; or another number if the load is not known, or would take d^3
 * operations, which are more than a run of a long chain takes. */
static int number_along(const fvi_method *method, const fvi_run *run, double *load,
                        double *h)
{
    *h = NAN;
    if (run->system->d > MOST_MASSES && method->stages > 0)
        return -1; /* the other methods need no more than two diagonals of the Hessian */
    int status = fvi_stability_number(method, run, load);
    if (!status && *load > 1 && method->stability_number_grows)
        status = fvi_stability_longest_step(method, run, h);
    return status;
}

static double largest_damping_by_mass(const fvi_system *system)
{
    double ratio = 0;
    for (size_t i = 0; i < system->d; i++)
        ratio = larger(ratio, system->damping[i] / system->mass[i]);
    return ratio;
}

int fvi_warning_of_step(const fvi_method *method, const fvi_run *run,
                        size_t size, char *text)
{
    const int has_matrices = run->system->matrices != NULL;
    double load = 0, h = 0;
    char more[80] = "";
    *text = '\0';
    const int status = number_along(method, run, &load, &h);
    if (status == FVI_ENOMEM) {
        snprintf(text, size, NO_MEMORY("this step is stable"));
        return -1;
    }
    if (status || load <= 1)
        return 0;
    if (h > 0)
        snprintf(more, sizeof more,
                 has_matrices ? "; stable below some h = %.2g"
                              : "; stable below h = %.4g",
                 h);
    else if (h == 0 && (run->alpha < 1 || has_matrices))
        snprintf(more, sizeof more, "; no step is stable");
    else if (h == 0)
        snprintf(more, sizeof more, "; no step is stable: rho / m is %.4g",
                 largest_damping_by_mass(run->system));
    snprintf(text, size, "this step is unstable (load %.4g, above 1)%s", load,
             more);
    return 1;
}

fvi_watch fvi_watch_begin(const fvi_method *method, const fvi_run *run,
                          int is_unstable)
{
    const fvi_potential *u = &run->system->potential;
    const int depends = method->stages > 0
                            ? !method->damped_inertia && run->system->d <= MOST_MASSES
                        : method->takes_kappa ? run->kappa != 0.5
                                              : !method->implicit,
              worth = depends && !is_unstable && method->stability_number && u->hessian
                      && !fvi_potential_is_quadratic(u);
    return (fvi_watch){ 0, worth ? 1 : SIZE_MAX };
}

int fvi_warning_along(fvi_watch *watch, const fvi_method *method,
                      const fvi_run *run, size_t k, const double *x,
                      size_t size, char *text)
{
    double load = 0;
    if (k < watch->next)
        return 0;
    watch->next = k + (k < BETWEEN ? 1 : BETWEEN);
    const int status =
        fvi_stability_along_run(method, run, x, &watch->stiffest, &load);
    if (status == FVI_ENOMEM) {
        snprintf(text, size, NO_MEMORY("this step is stable"));
        return -1;
    }
    if (status || load <= 1)
        return 0;
    watch->next = SIZE_MAX;
    snprintf(text, size,
             "this step is unstable where the run is at t = %.4g (load %.4g, "
             "above 1)",
             (double)k * run->h, load);
    return 1;
}
