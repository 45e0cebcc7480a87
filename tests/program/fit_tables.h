/* tests/program/fit_tables.h -- Tables that `fvi fit` reads, written into the folder of the test. */
#ifndef FIT_TABLES_H
#define FIT_TABLES_H

#include "identification/identification_ref.h"
#include "program.h"

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

static inline FILE *file_in_folder(const char *name)
{
    char path[PATH_MAX + 100];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *f = fopen(path, "w");
    ck_assert_ptr_nonnull(f);
    return f;
}

/* The exact motion of another program with noise, to five digits. */
static inline void write_data(const char *name, double sigma, unsigned long seed)
{
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    FILE *f = file_in_folder(name);
    gsl_rng_set(r, seed);
    fprintf(f, "# made elsewhere\n# t\tx\n");
    for (size_t i = 0; i < REF_POINTS; i++)
        fprintf(f, "%.1f\t%.5f\n", 0.1 * (double)(i + 1),
                ref_low[i] + gsl_ran_gaussian(r, sigma));
    fclose(f);
    gsl_rng_free(r);
}

#endif
