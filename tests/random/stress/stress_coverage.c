/* tests/random/stress/stress_coverage.c -- Do the intervals of a fit hold the truth, and does the fit warn if
 * they do not? */
#include "stress.h"
#include "system/larger.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_randist.h>
#include <stdio.h>

enum { MOST = 200, STARTS = 12 };
#define UNSEEN 0.005 /* half the probability at which an offset is flagged: fvi_examination.unseen */

/* The fault of a data set. */
typedef enum { NOTHING, AN_OFFSET, A_DRIFT, AN_ECHO, A_LAW, WRONG_READINGS } fault;

/* Rows of the table. With a fault the intervals seldom hold the truth, so the goal is the share of wrong
 * answers that have a flag or are refused. A third parameter can compensate much of an offset, of a drift or of
 * another law, and noise can hide a law. Then no test of residuals sees every fault, and the table also has the
 * share that the best test would see. The last three rows are those in which the best test could see them. */
static const struct {
    const char *name;
    fault what;
    size_t least_points, parameters; /* 0: two or three parameters */
    double loudest; /* sigma is between 0.003 and this */
    int sets;
    double held, caught; /* the goals in percent; 0: no goal */
} rows[] = {
    { "the model is right", NOTHING, 24, 0, 0.3, 1500, 93, 0 },
    { "offset of 0.5 to 2 sigma", AN_OFFSET, 24, 0, 0.3, 250, 0, 0 },
    { "drift by 1 to 4 sigma", A_DRIFT, 24, 0, 0.3, 250, 0, 0 },
    { "AR(0.9) noise", AN_ECHO, 24, 0, 0.3, 150, 0, 95 },
    { "zener's law, fitted by a power", A_LAW, 24, 0, 0.3, 250, 0, 0 },
    { "6 % wrong readings, Huber's loss", WRONG_READINGS, 24, 0, 0.1, 250, 92, 0 },
    { "offset, 48 points or more, c known", AN_OFFSET, 48, 2, 0.3, 200, 0, 95 },
    { "drift, 48 points or more, c known", A_DRIFT, 48, 2, 0.3, 200, 0, 95 },
    { "zener's law, sigma to 0.03, c known", A_LAW, 48, 2, 0.03, 200, 0, 95 },
};
enum { ROWS = sizeof rows / sizeof *rows };

/* A data set and its truth. */
typedef struct {
    fvi_linear_oscillator body;
    size_t n, P;
    double sigma, t[MOST], clean[MOST], x[MOST];
    double size; /* of the offset or the drift, in sigma */
    int known; /* is sigma given? */
} data_set;

static void add_noise(gsl_rng *random, fault what, data_set *o)
{
    const double T = o->t[o->n - 1],
                 offset = what == AN_OFFSET ? stress_uniform(random, 0.5, 2) : 0,
                 drift = what == A_DRIFT ? stress_uniform(random, 1, 4) : 0;
    double echo = gsl_ran_gaussian(random, 1);
    o->size = offset + drift;
    for (size_t i = 0; i < o->n; i++) {
        const double fresh = gsl_ran_gaussian(random, 1);
        echo = 0.9 * echo + sqrt(1 - 0.81) * fresh;
        o->clean[i] = o->x[i];
        o->x[i] +=
            o->sigma * ((what == AN_ECHO ? echo : fresh) + offset + drift * o->t[i] / T);
        if (what == WRONG_READINGS && gsl_rng_uniform(random) < 0.06)
            o->x[i] += o->sigma * gsl_ran_gaussian(random, 20);
    }
}

/* Draw a random body of unit mass, spring and start. Compute its exact motion at n times, with noise. */
static int draw(gsl_rng *random, size_t row, data_set *o)
{
    static const size_t points[] = { 24, 48, 100, 200 };
    const fault what = rows[row].what;
    const size_t skip = rows[row].least_points > 24;
    const fvi_kernel_term term = { FVI_KERNEL_ZENER, 1, stress_uniform(random, 0.2, 0.45),
                                   stress_decades(random, 0.5, 3), 0 };
    const fvi_kernel law = { 1, &term };
    const double T = stress_uniform(random, 6, 20);
    *o = (data_set){ .n = points[skip + gsl_rng_uniform_int(random, 4 - skip)],
                     .P = rows[row].parameters ? rows[row].parameters
                                               : 2 + gsl_rng_uniform_int(random, 2),
                     .sigma = stress_decades(random, 0.003, rows[row].loudest),
                     .known = gsl_rng_uniform_int(random, 2) != 0 };
    o->body = (fvi_linear_oscillator){ .m = 1,
                                       .c = 1,
                                       .rho = stress_decades(random, 0.1, 2),
                                       .alpha = stress_uniform(random, 0.05, 0.95),
                                       .x0 = 1,
                                       .v0 = 0.25,
                                       .law = what == A_LAW ? &law : NULL };
    for (size_t i = 0; i < o->n; i++)
        o->t[i] = T * (double)(i + 1) / (double)o->n;
    const int status = fvi_exact_at(&o->body, o->n, o->t, o->x, NULL, NULL);
    o->body.law = NULL; /* the law is a local variable of this function */
    add_noise(random, what, o);
    return status;
}

/* Fit alpha and rho, and c if P is 3, from starts that do not depend on the truth. e: NULL if only chi^2 is
 * wanted. */
static int believe(const data_set *o, const double *x, double sigma, double huber, fvi_estimate *f,
                   fvi_examination *e)
{
    static const fvi_free_parameter which[] = { FVI_FREE_PARAMETER_ALPHA,
                                                FVI_FREE_PARAMETER_RHO,
                                                FVI_FREE_PARAMETER_CONSTANT };
    double m = 1, rho = 0.5, c = o->P == 3 ? 1.5 : 1, x0 = 1, p0 = 0.25;
    const fvi_system system = { .d = 1,
                                .mass = &m,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&c) };
    fvi_run run = fvi_run_default(&system, &x0, &p0, 1, 1);
    const fvi_estimation fit = { .method = &fvi_lobatto_m4,
                                 .run = &run,
                                 .constants = &c,
                                 .n = o->n,
                                 .t = o->t,
                                 .x = x,
                                 .sigma = sigma,
                                 .parameters = o->P,
                                 .which = which,
                                 .starts = STARTS,
                                 .huber = huber };
    const int status = fvi_estimate_multistart(&fit, NULL, f);
    return status || !e ? status : fvi_estimate_examine(&fit, f, e);
}

/* Return the probability with which the best test of residuals would see this fault. By Neyman and Pearson's
 * lemma this is the test along the fault itself, which knows the fault and its sign. The residuals contain
 * `visible` sigma of the fault, the part that no parameter can compensate. Noise alone exceeds 1.88 sigma in 3
 * % of data sets. To first order in the noise, no test with 3 % of false flags in each experiment sees more. */
static double best_chance(const data_set *o, fault what, const fvi_examination *e)
{
    double visible;
    if (what == A_LAW) {
        fvi_estimate f = { .chi2 = 0 };
        const int status = believe(o, o->clean, o->sigma, 0, &f, NULL);
        if (status && status != FVI_ETOL && status != FVI_EMAXITER)
            return 1;
        visible = sqrt(f.chi2);
    } else {
        const size_t which = what == AN_OFFSET ? 0 : 1;
        visible = o->size * gsl_cdf_ugaussian_Qinv(UNSEEN) / e->unseen[which];
    }
    return gsl_cdf_ugaussian_P(visible - gsl_cdf_ugaussian_Qinv(0.03));
}

/* refused: no answer, or an answer that is not believed. flagged: an answer with a flag. silent: all other
 * answers, with the number of their intervals that hold the truth. wrong: an interval misses the truth, or the
 * law is another one. */
typedef struct {
    int refused, flagged, silent, held, intervals, wrong, caught;
    double possible; /* the share of the wrong answers that the best test would see */
} tally;

static void count(const data_set *o, fault what, int status, const fvi_examination *e,
                  tally *to)
{
    const int has_best = what == AN_OFFSET || what == A_DRIFT || what == A_LAW;
    const double truth[] = { o->body.alpha, o->body.rho, o->body.c };
    int held = 0;
    for (size_t j = 0; !status && j < o->P; j++)
        held += truth[j] >= e->lower[j] && truth[j] <= e->upper[j];
    const int speaks = status || e->flags, is_wrong = what == A_LAW || held < (int)o->P;
    to->refused += status != 0;
    to->flagged += !status && e->flags;
    to->wrong += is_wrong;
    to->caught += is_wrong && speaks;
    if (is_wrong && has_best)
        to->possible += status ? 1 : best_chance(o, what, e);
    if (!speaks) {
        to->silent++;
        to->intervals += (int)o->P;
        to->held += held;
    }
}

static double percent(int part, int of)
{
    return of > 0 ? 100. * part / of : 0;
}

/* Return the used share of the allowance. By chance a share may lie below its goal by three standard deviations
 * of this number of draws. */
static double allowance(double goal, double share, int draws)
{
    return goal > 0 ? (100 - share) / (100 - goal + 3 * sqrt(goal * (100 - goal) / draws)) : 0;
}

/* Print the table of figures/identification/coverage.tsv. Return the worst of its goals. */
double stress_coverage(gsl_rng *random, char *describe, size_t size)
{
    double worst = 0;
    printf("data\tsets\trefused\tflagged\tsilent\theld\twrong\tcaught\tpossible\n");
    for (size_t row = 0; row < ROWS; row++) {
        tally all = { 0 };
        for (int set = 0; set < rows[row].sets; set++) {
            data_set o;
            fvi_examination e = { .flags = 0 };
            if (draw(random, row, &o))
                return GSL_POSINF;
            fvi_estimate f;
            const int status = believe(&o, o.x, o.known ? o.sigma : 0,
                                       rows[row].what == WRONG_READINGS ? 1.345 : 0, &f, &e);
            count(&o, rows[row].what, status, &e, &all);
        }
        const double held = percent(all.held, all.intervals),
                     caught = percent(all.caught, all.wrong);
        const int sets = rows[row].sets, is_right = rows[row].what == NOTHING;
        printf("%s\t%d\t%d\t%d\t%d\t%.1f\t%d\t%.1f\t", rows[row].name, sets, all.refused,
               all.flagged, all.silent, held, all.wrong, caught);
        if (all.possible > 0)
            printf("%.1f\n", 100 * all.possible / all.wrong);
        else
            puts("-");
        fflush(stdout);
        worst = larger(worst, allowance(rows[row].held, held, all.intervals));
        worst = larger(worst, allowance(rows[row].caught, caught, all.wrong));
        if (is_right) /* at most 3 % of false flags, with the same allowance */
            worst = larger(worst, allowance(97, 100 - percent(all.flagged, sets), sets));
    }
    snprintf(describe, size, "held and caught in percent");
    return worst;
}
