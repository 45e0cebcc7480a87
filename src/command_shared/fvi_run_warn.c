/* src/command_shared/fvi_run_warn.c -- Warn of runs that go on all the same. */
#include "fvi_run_warn.h"

#include "output/fvi_complain.h"

#include <stdlib.h>

int fvi_run_warn_of_memory(const fvi_options *o, const fvi_run *r)
{
    fvi_run typed = *r;
    char text[FVI_WARNING_ROOM];
    if (o->text[TOLERANCE] == fvi_option_list[TOLERANCE].preset)
        typed.tolerance = 0;
    const int warned = fvi_warning_of_memory(o->method, &typed, sizeof text, text);
    if (warned > 0)
        fvi_warn(text);
    return warned < 0 ? fvi_complain("not enough memory") : 0;
}

int fvi_run_warn(const fvi_options *o, const fvi_run *r, size_t size,
                 char *text)
{
    const int warned = fvi_warning_of_step(o->method, r, size, text);
    if (warned < 0)
        return fvi_complain("not enough memory");
    if (fvi_run_warn_of_memory(o, r))
        return 1;
    if (o->no_solution)
        fvi_warn(o->no_solution);
    if (warned)
        fvi_warn(text);
    return 0;
}

int fvi_run_check_inertia(fvi_run_inertia *w, const fvi_stepper *s, char *text)
{
    enum { BETWEEN = 16 };
    const size_t steps = w->steps++;
    const int checks_now = s->method->dense || steps <= BETWEEN || steps % BETWEEN == 0 || s->k == s->run.steps;
    return w->watch && checks_now ? fvi_warning_of_inertia(w->watch, s->t, s->x, s->p, FVI_WARNING_ROOM, text) : 0;
}

int fvi_run_inertia_of_rows(const fvi_options *o, const fvi_system *system, size_t rows,
                            const double *x, const double *p, char *text)
{
    double *t = o->text[LAGRANGIAN] ? malloc(rows * sizeof *t) : NULL;
    if (!t)
        return o->text[LAGRANGIAN] ? -1 : 0;
    for (size_t k = 0; k < rows; k++)
        t[k] = (double)k * o->h;
    const int warned =
        fvi_warning_of_inertia_in_rows(system, rows, t, x, p, FVI_WARNING_ROOM, text);
    free(t);
    return warned;
}
