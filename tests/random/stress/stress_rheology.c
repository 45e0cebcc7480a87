/* tests/random/stress/stress_rheology.c -- Are the laws of materials found from any start, and do their intervals
 * hold the truth? */
#include "stress.h"

#include "estimation/rheology_search.h"
#include "system/larger.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_randist.h>
#include <math.h>
#include <stdio.h>
#include <time.h>

enum { POINTS = 60, FROM = 50, SETS = 600 };

/* The terms of ten laws for moduli, and of five laws each for creep and for relaxation. */
static const struct {
    const char *name;
    size_t elements;
    fvi_element kind[3];
    fvi_kernel_term term[3];
} laws[] = {
    { "spring+power", 2, { FVI_ELEMENT_SPRING, FVI_ELEMENT_POWER },
      { { FVI_KERNEL_POWER, 1, 0, 0, 0 }, { FVI_KERNEL_POWER, 2, 0.2, 0, 0 } } },
    { "spring+zener", 2, { FVI_ELEMENT_SPRING, FVI_ELEMENT_ZENER },
      { { FVI_KERNEL_POWER, 1, 0, 0, 0 }, { FVI_KERNEL_ZENER, 3, 0.25, 1.5, 0 } } },
    { "zener", 1, { FVI_ELEMENT_ZENER }, { { FVI_KERNEL_ZENER, 3, 0.25, 1.5, 0 } } },
    { "maxwell2", 1, { FVI_ELEMENT_MAXWELL2 }, { { FVI_KERNEL_MAXWELL2, 3, 0.42, 1.5, 0.1 } } },
    { "power+power", 2, { FVI_ELEMENT_POWER, FVI_ELEMENT_POWER },
      { { FVI_KERNEL_POWER, 2, 0.08, 0, 0 }, { FVI_KERNEL_POWER, 0.5, 0.4, 0, 0 } } },
    { "spring+davidson", 2, { FVI_ELEMENT_SPRING, FVI_ELEMENT_DAVIDSON },
      { { FVI_KERNEL_POWER, 1, 0, 0, 0 }, { FVI_KERNEL_DAVIDSON, 3, 0.2, 0.5, 0 } } },
    { "spring+power+power", 3, { FVI_ELEMENT_SPRING, FVI_ELEMENT_POWER, FVI_ELEMENT_POWER },
      { { FVI_KERNEL_POWER, 1, 0, 0, 0 }, { FVI_KERNEL_POWER, 1, 0.12, 0, 0 },
        { FVI_KERNEL_POWER, 0.05, 0.4, 0, 0 } } },
    { "spring+maxwell+maxwell", 3,
      { FVI_ELEMENT_SPRING, FVI_ELEMENT_MAXWELL, FVI_ELEMENT_MAXWELL },
      { { FVI_KERNEL_POWER, 1, 0, 0, 0 }, { FVI_KERNEL_MAXWELL, 0.1, 0, 0.05, 0 },
        { FVI_KERNEL_MAXWELL, 20, 0, 20, 0 } } },
    { "spring+zener+zener", 3, { FVI_ELEMENT_SPRING, FVI_ELEMENT_ZENER, FVI_ELEMENT_ZENER },
      { { FVI_KERNEL_POWER, 1, 0, 0, 0 }, { FVI_KERNEL_ZENER, 0.15, 0.4, 0.05, 0 },
        { FVI_KERNEL_ZENER, 60, 0.4, 20, 0 } } },
    { "spring+distributed", 2, { FVI_ELEMENT_SPRING, FVI_ELEMENT_DISTRIBUTED },
      { { FVI_KERNEL_POWER, 1, 0, 0, 0 }, { FVI_KERNEL_DISTRIBUTED, 2, 0.1, 0, 0.4 } } },
};
static const char *const test_names[] = { "moduli", "creep", "relaxation" };
enum { CASES = 20 };

typedef struct {
    double at[POINTS], clean[2 * POINTS], noisy[2 * POINTS], sigma;
    size_t law;
    fvi_material_data data;
} question;

static void ask(size_t which, question *q)
{
    const fvi_material_test test = which < 10 ? FVI_MATERIAL_MODULI
                                   : which < 15 ? FVI_MATERIAL_CREEP
                                                : FVI_MATERIAL_RELAXATION;
    const int both = test == FVI_MATERIAL_MODULI;
    q->law = which < 10 ? which : (which - 10) % 5;
    q->sigma = both ? 0.02 : 0.01;
    q->data = (fvi_material_data){ .test = test,
                                   .n = both ? 41 : POINTS,
                                   .at = q->at,
                                   .first = q->noisy,
                                   .second = q->noisy + POINTS,
                                   .load = 1,
                                   .elements = laws[q->law].elements,
                                   .kind = laws[q->law].kind,
                                   .starts = 20 };
    for (size_t i = 0; i < q->data.n; i++)
        q->at[i] = both ? pow(10, -2 + 5 * (double)i / 40) : pow(10, -3 + 4.5 * (double)i / 59);
    fvi_material_curve(test, &(fvi_kernel){ laws[q->law].elements, laws[q->law].term }, 1,
                       q->data.n, q->at, q->clean, q->clean + POINTS, NULL);
}

static void add_noise(gsl_rng *random, question *q)
{
    for (size_t i = 0; i < q->data.n; i++) {
        const double *G = q->clean + i;
        const int both = q->data.test == FVI_MATERIAL_MODULI;
        const double size = q->sigma * (both ? hypot(G[0], G[POINTS]) : fabs(G[0]));
        q->noisy[i] = G[0] + gsl_ran_gaussian(random, size);
        if (both)
            q->noisy[POINTS + i] = G[POINTS] + gsl_ran_gaussian(random, size);
    }
}

/* Return how many of 50 random starts end at the least sum. */
static int arrivals(gsl_rng *random, const question *q)
{
    fvi_rheology o;
    double sum[FROM], least = GSL_POSINF;
    int arrived = 0;
    if (fvi_rheology_alloc(&q->data, &o))
        return 0;
    for (int k = 0; k < FROM; k++) {
        double u[FVI_LAW_SHAPE], of_creep[FVI_MATERIAL_ELEMENTS], z[FVI_LAW_MOST];
        for (size_t j = 0; j < o.shapes; j++)
            u[j] = stress_uniform(random, o.begin[j], o.end[j]);
        for (size_t n = 0; n < o.elements; n++)
            of_creep[n] = gsl_rng_uniform(random);
        sum[k] = fvi_rheology_search(&o, u, of_creep, z);
        least = smaller(least, sum[k]);
    }
    for (int k = 0; k < FROM; k++)
        arrived += sum[k] <= least * (1 + 1e-6);
    fvi_rheology_free(&o);
    return arrived;
}

/* Return the true numbers, in the order of an answer. */
static void truth_of(size_t law, double *truth)
{
    for (size_t n = 0, j = 0; n < laws[law].elements; n++) {
        const fvi_kernel_term *t = &laws[law].term[n];
        const double field[] = { t->rho, t->alpha,
                                 t->kind == FVI_KERNEL_MAXWELL2 ? t->rho / t->time : t->time,
                                 t->end };
        size_t f;
        for (size_t i = 0; fvi_element_number(laws[law].kind[n], i, &f); i++)
            truth[j++] = field[f];
    }
}

/* How many starts may fail? With 300 other seeds, 15 of the 20 laws were found from all 50 starts every time. (For 0 to 3
 * more it is luck.) The law that was found least often was found from 42.8 starts on average, with a standard deviation
 * of 2.5. Of all 1000 starts 16 failed on average, with a standard deviation of 4.2. The bounds are 15 laws, and four
 * standard deviations: 33 of 50 starts of each law, and 33 of 1000 starts that fail.
 * How often may the intervals miss? 600 sets of 95 % scatter by 0.9 %. 200 sets scatter by 1.5 %, and the numbers of one
 * law hold the truth together or not: with 200 sets, seed 1, all of creep of a spring and zener's element held it in 89.5
 * to 91.5 %, and with 4000, seed 5, in 94.3 to 94.8 %. */
double stress_rheology(gsl_rng *random, char *describe, size_t size)
{
    int all = 0, flagged = 0, sets = 0;
    double longest = 0, least_share = 1, fewest = FROM, failed = 0;
    printf("test\tlaw\tarrived of 50\tms a fit\tflagged of 600\theld\n");
    for (size_t which = 0; which < CASES; which++) {
        question q;
        double truth[FVI_MATERIAL_NUMBERS], held[FVI_MATERIAL_NUMBERS] = { 0 };
        fvi_material m = { .numbers = 0 };
        int flags = 0;
        ask(which, &q);
        truth_of(q.law, truth);
        add_noise(random, &q);
        const int arrived = arrivals(random, &q);
        const clock_t began = clock();
        for (int set = 0; set < SETS; set++) {
            add_noise(random, &q);
            if (fvi_material_fit(&q.data, NULL, &m, NULL))
                return GSL_POSINF;
            flags += m.grave != 0;
            for (size_t j = 0; j < m.numbers; j++)
                held[j] += truth[j] >= m.lower[j] && truth[j] <= m.upper[j];
        }
        const double ms = 1e3 * (double)(clock() - began) / CLOCKS_PER_SEC / SETS;
        printf("%s\t%s\t%d\t%.1f\t%d\t", test_names[q.data.test], laws[q.law].name, arrived, ms,
               flags);
        for (size_t j = 0; j < m.numbers; j++) {
            printf("%s%.1f", j ? " " : "", 100 * held[j] / SETS);
            least_share = smaller(least_share, held[j] / SETS);
        }
        putchar('\n');
        fflush(stdout);
        all += arrived == FROM;
        fewest = smaller(fewest, arrived);
        failed += FROM - arrived;
        flagged += flags;
        sets += SETS;
        longest = larger(longest, ms);
    }
    snprintf(describe, size, "%d of 20 laws from each of 50 starts, each from %g at least, %g starts failed; "
                             "%.1f ms a fit at most; %d of %d refused",
             all, fewest, failed, longest, flagged, sets);
    const double not_found = larger(larger(15. / (all ? all : 1), 33 / (fewest > 0 ? fewest : 1)), failed / 33);
    return larger(larger(not_found, flagged / (0.03 * sets)),
                  (1 - least_share) / (0.05 + 4 * sqrt(0.05 * 0.95 / SETS)));
}
