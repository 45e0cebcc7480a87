/* src/command_gradient/fvi_gradient_answer.c -- Print the answer of `fvi gradient`. */
#include "fvi_gradient_answer.h"
#include "fvi_gradient_choice.h"
#include "fvi_gradient_rows.h"
#include <fvi/lobatto.h>

#include "output/fvi_complain.h"
#include "output/fvi_format.h"
#include "output/fvi_output.h"

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

typedef struct {
    FILE *f;
    const request *r;
} table;

static void print_row(void *to, const char *name, const double *by, const char *warning)
{
    const table *t = to;
    if (!fvi_gradient_has_row(t->r, name))
        return;
    if (warning)
        fprintf(t->f, "# warning = %s\n", warning);
    else if (isnan(*by))
        fprintf(t->f, "# warning = " FVI_GRADIENT_NO_START "\n", name);
    else {
        fprintf(t->f, "%s", name);
        fvi_print_number(t->f, "\t", *by + 0.0); /* no -0 */
        fputc('\n', t->f);
    }
}

int fvi_gradient_print_answer(const fvi_own_command *command, const request *r)
{
    FILE *f = fvi_output_open(r->o.output);
    if (!f)
        return fvi_cannot_write(r->o.output);
    print_head(f, command, r);
    fvi_print_number(f, "# value = ", r->value);
    fprintf(f, "\n# name\tderivative\n");
    table t = { f, r };
    fvi_gradient_rows(r, &(fvi_gradient_visitor){ print_row, &t });
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
