/* src/program/fvi_gradient_answer.c -- What `fvi gradient` prints. */
#include "fvi_gradient_answer.h"
#include <fvi/lobatto.h>

#include "output/fvi_complain.h"
#include "output/fvi_format.h"
#include "output/fvi_output.h"
#include "output/fvi_table.h"

#include <math.h>

typedef fvi_gradient_request request;

double fvi_gradient_row_time(const request *r, size_t k)
{
    const size_t stages = (size_t)r->o.method->stages;
    return ((double)(k / r->per) + fvi_lobatto_abscissa(stages, k % r->per))
           * r->o.h;
}

static void print_head(FILE *f, const fvi_own_command *command,
                       const request *r)
{
    fvi_subcommand_options_head(f, command, &r->words, &r->o);
    if (r->o.no_solution)
        fprintf(f, "# warning = %s\n", r->o.no_solution);
    if (*r->unstable)
        fprintf(f, "# warning = %s\n", r->unstable);
}

/* One for each mass: name, or name_1, name_2, ... */
static void print_row(FILE *f, const char *name, const char *number, double by)
{
    fprintf(f, "%s%s", name, number);
    fvi_print_number(f, "\t", by + 0.0); /* no -0 */
    fputc('\n', f);
}

static void print_each(FILE *f, const request *r, const char *name,
                       const double *by)
{
    for (size_t i = 0; i < r->o.d; i++) {
        char number[24] = "";
        if (r->o.numbered)
            snprintf(number, sizeof number, "_%zu", i + 1);
        if (isnan(by[i]))
            fprintf(f,
                    "# warning = no derivative by %s%s: other starts have "
                    "no solution\n",
                    name, number);
        else
            print_row(f, name, number, by[i]);
    }
}

/* By each number of one --damping, R without a letter. */
static void print_term(FILE *f, const request *r, size_t i)
{
    const fvi_kernel_kind kind = r->run.law->term[i].kind;
    const int is_maxwell = kind == FVI_KERNEL_MAXWELL,
              is_range = kind == FVI_KERNEL_DISTRIBUTED;
    char number[24] = "", name[32];
    if (r->terms > 1)
        snprintf(number, sizeof number, "_%zu", i + 1);
    snprintf(name, sizeof name, "damping%s", number);
    if (kind >= FVI_KERNEL_MAXWELL2 || !r->to.terms) {
        fprintf(f, "# warning = no derivatives by the numbers of %s\n", name);
        return;
    }
    print_row(f, name, "", r->to.terms[i]);
    if (!r->to.orders)
        return;
    if (!is_maxwell)
        print_row(f, name, "_A", r->to.orders[i]);
    if (is_range)
        print_row(f, name, "_B", r->to.ends[i]);
    if (is_maxwell || kind == FVI_KERNEL_ZENER)
        print_row(f, name, "_T", r->to.times[i]);
}

/* By one factor of each matrix. */
static void print_matrices(FILE *f, const request *r)
{
    print_row(f, "mass", "", *r->to.mass);
    for (size_t i = 0; i < r->terms; i++)
        print_term(f, r, i);
    const fvi_mechanism *of = r->system.mechanism;
    for (size_t j = 0; of && j < of->damper_count; j++) {
        char name[24];
        snprintf(name, sizeof name, "d%zu", j + 1);
        print_row(f, of->damper[j].name ? of->damper[j].name : name, ".rho",
                  r->to.damping[j]);
    }
    if (r->terms == 0 && !of) {
        print_row(f, "rho", "", *r->to.damping);
        print_row(f, "alpha", "", *r->to.alpha);
    }
    print_row(f, "c", "", *r->to.parameters);
}

static void print_numbers(FILE *f, const request *r)
{
    static const char *const c_and_g[] = { "c", "g" };
    if (r->system.matrices) {
        print_matrices(f, r);
        return;
    }
    print_each(f, r, "mass", r->to.mass);
    for (size_t i = 0; i < r->terms; i++)
        print_term(f, r, i);
    if (r->terms == 0)
        print_each(f, r, "rho", r->to.damping);
    if (r->to.alpha)
        print_row(f, "alpha", "", *r->to.alpha);
    else if (r->terms == 0)
        fprintf(f, "# warning = no derivative by alpha: %s\n",
                r->o.method->scheme == FVI_SCHEME_VARIABLE_STEP
                    ? "there x has a logarithm at 0, for which these "
                      "steps are not made"
                    : "p of this method jumps at 1");
    const int pendulum = r->o.potential.kind == FVI_POTENTIAL_PENDULUM;
    for (size_t j = 0; !r->o.potential.expression && j < r->to.sensitivity.count; j++)
        print_row(f, pendulum ? "g" : c_and_g[j], "", r->to.parameters[j]);
}

int fvi_gradient_print_answer(const fvi_own_command *command, const request *r)
{
    FILE *f = fvi_output_open(r->o.output);
    if (!f)
        return fvi_cannot_write(r->o.output);
    print_head(f, command, r);
    fvi_print_number(f, "# value = ", r->value);
    fprintf(f, "\n# name\tderivative\n");
    print_each(f, r, "x0", r->to.x0);
    print_each(f, r, "p0", r->to.p0);
    print_numbers(f, r);
    for (size_t j = 0; j < r->o.lets.count; j++)
        if (r->o.lets.used[j] & FVI_USED_BY_DAMPING)
            fprintf(f, "# warning = no derivative by %s, of which the law speaks\n",
                    r->o.lets.name[j]);
        else
            print_row(f, r->o.lets.name[j], "", r->lets[j]);
    return fvi_output_close(f, 1) ? fvi_cannot_write(r->o.output) : 0;
}

int fvi_gradient_print_forces(const fvi_own_command *command, const request *r)
{
    const size_t d = r->o.d;
    if (!r->words.own[FORCES])
        return 0;
    FILE *f = fvi_output_open(r->words.own[FORCES]);
    if (!f)
        return fvi_cannot_write(r->words.own[FORCES]);
    print_head(f, command, r);
    fprintf(f, "# t");
    for (size_t i = 0; i < d; i++)
        if (r->o.numbered)
            fprintf(f, "\tF%zu", i + 1);
        else
            fprintf(f, "\tF");
    for (size_t k = 0; k <= r->o.steps * r->per; k++) {
        fvi_print_number(f, "\n", fvi_gradient_row_time(r, k));
        for (size_t i = 0; i < d; i++)
            fvi_print_number(f, "\t", r->force[k * d + i]);
    }
    fputc('\n', f);
    return fvi_output_close(f, 1) ? fvi_cannot_write(r->words.own[FORCES]) : 0;
}
