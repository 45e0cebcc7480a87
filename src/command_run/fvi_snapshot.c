/* src/command_run/fvi_snapshot.c -- Write all unknowns at the end of a run to a file. */
#include "fvi_run.h"

#include "output/fvi_complain.h"
#include "output/fvi_format.h"
#include "output/fvi_output.h"



int fvi_snapshot(const fvi_options *o, const fvi_stepper *s)
{
    if (!o->snapshot)
        return 0;
    FILE *out = fvi_output_open(o->snapshot);
    if (!out)
        return fvi_cannot_write(o->snapshot);
    fprintf(out, "# t = %.17g\n# unknown\tx\tp\n", s->t);
    for (size_t i = 0; i < o->d; i++) {
        fprintf(out, "%zu", i + 1);
        fvi_print_number(out, "\t", s->x[i]);
        fvi_print_number(out, "\t", s->p[i]);
        fputc('\n', out);
    }
    return fvi_output_close(out, 1) != 0 ? fvi_cannot_write(o->snapshot) : 0;
}
