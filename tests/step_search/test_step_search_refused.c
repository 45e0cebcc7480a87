/* tests/step_search/test_step_search_refused.c -- Chapter 18: runs that agree and are wrong.
 * Run alone: make test-step_search_refused */
#include "step_search_runs.h"

enum { MOST = 1 << 13, EACH = 20 };

/* ---- what the estimate alone would accept ---- */

static void run_rows(const fvi_method *method, fvi_run run, size_t rows,
                     size_t parts, double *x)
{
    fvi_stepper *s;
    run.h /= (double)parts;
    run.steps = rows * parts;
    ck_assert_int_eq(fvi_start(method, &run, &s), FVI_SUCCESS);
    int status = FVI_SUCCESS;
    for (size_t k = 0; k <= rows; k++) {
        x[k] = status ? GSL_NAN : s->x[0];
        for (size_t i = 0; i < parts && k < rows && !status; i++)
            status = fvi_step(s);
    }
    fvi_stop(s);
}

/* (18.2), the order held between 1/4 and the lowest of the method, at once believed:
 * no second order, no look at F. Only x of the caller's rows is compared. */
static int credulous(const fvi_method *method, const fvi_run *run, double error,
                     size_t most, double *x, double *p, fvi_step_found *found)
{
    double before[ROWS + 1], D = GSL_POSINF, D_before;
    size_t first = 1;
    (void)p;
    while (run->steps * first < 128)
        first *= 2;
    for (size_t parts = first; run->steps * parts <= most; parts *= 2) {
        run_rows(method, *run, run->steps, parts, x);
        D_before = D;
        D = parts == first ? GSL_POSINF : 0;
        for (size_t k = 0; k <= run->steps && parts > first; k++)
            D = isnan(x[k] - before[k]) ? GSL_POSINF
                                        : fmax(D, fabs(x[k] - before[k]));
        double q = fmin(fmax(log2(D_before / D), 0.25), method->lowest);
        *found = (fvi_step_found){ parts, D / (exp2(q) - 1), q };
        if (isfinite(D_before) && found->estimate <= error)
            return FVI_SUCCESS;
        memcpy(before, x, sizeof before);
    }
    return FVI_ETOL;
}

/* ---- the table of the chapter ---- */

/* The spacing of the first run's nodes */
static double finest(double T, size_t rows)
{
    while (rows < 128)
        rows *= 2;
    return T / (double)rows;
}

static void ordinary(fvi_linear *q, double h)
{
    (void)q, (void)h;
}

static void stiff(fvi_linear *q, double h)
{
    (void)h;
    q->c = pow(10, dice(13, 17));
}

/* All nodes of the first runs see one phase of the cosine. */
static void aliased(fvi_linear *q, double h)
{
    q->w = 2 * M_PI / h * floor(dice(1, 6)) * exp2(floor(dice(0, 11)));
}

static const struct {
    const char *name;
    void (*change)(fvi_linear *q, double h);
} families[] = { { "ordinary", ordinary },
                 { "stiff", stiff },
                 { "aliased", aliased } };

static const struct {
    const fvi_method *method;
    double loosest, tightest;
} methods[] = { { &fvi_fractional, 1e-1, 2e-2 },
                { &fvi_shifted, 1e-2, 1e-4 },
                { &fvi_lobatto3, 1e-3, 1e-8 },
                { &fvi_lobatto4, 1e-3, 1e-10 } };

/* EACH problems of a family, both decisions about each; the same for all methods
 * but for E. */
static void sweep(size_t family, size_t m)
{
    decider *const decide[] = { credulous, fvi_step_search };
    const char *const who[] = { "estimate", "rule" };
    int accepted[2] = { 0 }, wrong[2] = { 0 };
    for (int i = 0; i < EACH; i++) {
        fvi_linear q = any_problem();
        const double T = dice(2, 10),
                     error = exp(dice(log(methods[m].tightest),
                                      log(methods[m].loosest)));
        const size_t rows = 1 + (size_t)dice(0, ROWS - 1);
        families[family].change(&q, finest(T, rows));
        for (int n = 0; n < 2; n++) {
            fvi_step_found found;
            double worst;
            int status = search_with(decide[n], methods[m].method, &q, T, rows,
                                     error, MOST, &found, &worst);
            ck_assert(status == FVI_SUCCESS || status == FVI_ETOL);
            accepted[n] += !status;
            wrong[n] += !status && worst > 3 * error;
        }
    }
    const char *name = families[family].name, *method = methods[m].method->name;
    for (int n = 0; n < 2; n++) {
        seen(accepted[n], "%s, %s: accepted by the %s", name, method, who[n]);
        seen(wrong[n], "%s, %s: wrong by the %s", name, method, who[n]);
    }
    ck_assert_msg(wrong[1] == 0, "%s, %s: %d wrong", name, method, wrong[1]);
    if (family == 0)
        ck_assert_msg(accepted[1] == EACH, "%s: only %d", method, accepted[1]);
    else
        ck_assert_int_lt(accepted[1], EACH);
}

//> sweep
/* Of the easy problems none is refused, of the hard ones none is wrong. */
START_TEST(eq_18_5_no_wrong_run_is_accepted)
{
    for (size_t family = 0; family < LEN(families); family++)
        for (size_t m = 0; m < LEN(methods); m++)
            sweep(family, m);
}
END_TEST
//< sweep

/* A kick leaves the order 1 - 2 alpha, from 0.3 down to 0.02, on oscillations that
 * the first runs do not resolve: there half an order less would be no order. */
START_TEST(eq_18_5_where_the_order_is_low_it_must_be_seen_too)
{
    for (int i = 0; i < 40; i++) {
        fvi_linear q = any_problem();
        q.past = FVI_PAST_RIEMANN_LIOUVILLE;
        q.alpha = dice(0.35, 0.49);
        q.c = pow(10, dice(3, 8));
        fvi_step_found found;
        double worst;
        int status = search_linear(&fvi_fractional, &q, dice(2, 10), ROWS, 0.1,
                                   MOST, &found, &worst);
        ck_assert_msg(status == FVI_ETOL || worst <= 0.3, "alpha=%g c=%g: %g",
                      q.alpha, q.c, worst);
    }
}
END_TEST

/* ---- four runs that were accepted once ---- */

static void refused_or_right(const fvi_method *method, const char *name,
                             const fvi_linear *q, double T, size_t rows,
                             double error)
{
    fvi_step_found found;
    double worst;
    int status =
        search_linear(method, q, T, rows, error, 1 << 16, &found, &worst);
    ck_assert_msg(status == FVI_ETOL || (!status && worst <= error),
                  "%s, c=%g w=%g: %d, estimate %g, true error %g", method->name,
                  q->c, q->w, status, found.estimate, worst);
    if (search_with(credulous, method, q, T, rows, error, 1 << 16, &found,
                    &worst)
        == FVI_SUCCESS) {
        seen(found.estimate, "%s, %s: the estimate", name, method->name);
        seen(worst, "%s, %s: the error", name, method->name);
    }
}

START_TEST(eq_18_5_what_once_was_accepted_is_refused_or_right)
{
    const fvi_method *const all[] = { &fvi_fractional, &fvi_shifted, &fvi_bdf2,
                                      &fvi_lobatto2, &fvi_lobatto3 };
    const fvi_linear cosine = { .m = 1,
                                .c = 1,
                                .rho = 0.2,
                                .alpha = 0.5,
                                .x0 = 1,
                                .v0 = 0.5,
                                .forcing = FVI_FORCING_COSINE,
                                .A = 1,
                                .w = 160.84954386379741 };
    const fvi_linear hard = {
        .m = 1, .c = 1e12, .rho = 0.2, .alpha = 0.5, .x0 = 1, .v0 = 0.5
    };
    const fvi_linear harder = {
        .m = 1, .c = 1e16, .rho = 0.1, .alpha = 0.3, .x0 = 1
    };
    fvi_linear faster = cosine;
    faster.A = 5;
    faster.w = 2 * M_PI * 0x1p14;
    for (size_t i = 0; i < LEN(all); i++) {
        refused_or_right(all[i], "cosine", &cosine, 20, 4, 1e-2);
        refused_or_right(all[i], "hard", &hard, 1, 10, 1e-3);
        refused_or_right(all[i], "harder", &harder, 1, 10, 1e-2);
        refused_or_right(all[i], "faster", &faster, 20, 20, 1e-4);
    }
}
END_TEST

/* ---- what decides ---- */

/* W = 2.5e13 down to 1.6e12. The next terms of the cosine and of the phase are below
 * 1e-7 of D, the rounding of a few steps is below 1e-5 of it. */
START_TEST(eq_18_6_differences_of_what_stands_still_grow)
{
    const double one = 1, none = 0, c = 1e16;
    const fvi_system system = {
        1, &one, &none, fvi_potential_harmonic(&c), { 0 }
    };
    const fvi_run run = { .system = &system,
                          .x0 = &one,
                          .p0 = &none,
                          .h = 0.1,
                          .steps = 10,
                          .kappa = 0.5,
                          .alpha = 0.5 };
    double x[3][11], D[2] = { 0 };
    for (size_t j = 0; j < 3; j++)
        run_rows(&fvi_shifted, run, 10, (size_t)2 << j, x[j]);
    for (size_t j = 0; j < 2; j++)
        for (size_t k = 0; k <= 10; k++)
            D[j] = fmax(D[j], fabs(x[j + 1][k] - x[j][k]));
    for (size_t k = 0; k <= 10; k++) {
        double t = 0.1 * (double)k, h = 0.1 / 8;
        ck_assert_near(1 - x[2][k], 8 * t * t / (pow(h, 4) * c), 1e-4 * D[1],
                       "row %zu", k);
    }
    ck_assert_near(D[1] / D[0], 16, 1e-3, "growth");
}
END_TEST

/* So stiff that x stands still at every node of every run: all D are rounding. */
START_TEST(eq_18_6_what_stands_still_is_not_what_converged)
{
    for (int light = 0; light < 2; light++) {
        const fvi_linear q = {
            .m = light ? 1e-30 : 1, .c = light ? 1 : 1e30, .alpha = 0.5, .x0 = 1
        };
        fvi_step_found found;
        double worst;
        ck_assert_int_eq(search_linear(&fvi_shifted, &q, 20, 20, 1e-2, 1 << 12,
                                       &found, &worst),
                         FVI_ETOL);
        ck_assert_int_eq(search_with(credulous, &fvi_shifted, &q, 20, 20, 1e-2,
                                     1 << 12, &found, &worst),
                         FVI_SUCCESS);
        ck_assert(worst > 1);
    }
    const fvi_linear rest = { .m = 1, .c = 1e3, .alpha = 0.5 };
    fvi_step_found found; /* but what is at rest is found to be */
    double worst;
    ck_assert_int_eq(search_linear(&fvi_shifted, &rest, 20, 20, 1e-2, 1 << 16,
                                   &found, &worst),
                     FVI_SUCCESS);
}
END_TEST

/* At rest in 0, D is 0. The fast link is beside the diagonal of the Hessian, which
 * is 0: a matrix, or a band of two diagonals; the light mass is the second or the
 * first. */
static int link_value(size_t d, const double *x, void *params, double *value)
{
    (void)d, (void)params;
    *value = 1e30 * x[0] * x[1];
    return 0;
}

static int link_gradient(size_t d, const double *x, void *params, double *g)
{
    (void)d, (void)params;
    g[0] = 1e30 * x[1];
    g[1] = 1e30 * x[0];
    return 0;
}

static int link_band(size_t d, const double *x, void *params, double *H)
{
    (void)d, (void)x, (void)params;
    H[0] = H[2] = 0;
    H[1] = 1e30;
    return 0;
}

static int link_full(size_t d, const double *x, void *params, double *H)
{
    link_band(d, x, params, H);
    H[2] = H[1];
    H[3] = 0;
    return 0;
}

static int always(const void *params)
{
    (void)params;
    return 1;
}

START_TEST(eq_18_6_all_of_a_row_of_the_hessian_counts)
{
    const double masses[][2] = { { 1e30, 1 }, { 1, 1e30 } }, none[] = { 0, 0 };
    for (size_t i = 0; i < 4; i++) {
        fvi_potential u = {
            link_value, link_gradient, i < 2 ? link_full : link_band,
            NULL,       always,        i < 2 ? 0 : 2
        };
        const fvi_system system = { 2, masses[i % 2], none, u, { 0 } };
        const fvi_run run = { .system = &system,
                              .x0 = none,
                              .p0 = none,
                              .h = 0.1,
                              .steps = 128,
                              .kappa = 0.5,
                              .alpha = 0.5 };
        double x[2 * 129];
        fvi_step_found found;
        ck_assert_int_eq(fvi_step_search(&fvi_shifted, &run, 1e300, 1 << 12, x,
                                         NULL, &found),
                         FVI_ETOL);
    }
}
END_TEST

static double fast; /* the frequency of what hides */

/* Coordinate 0 hides a hundredth that all nodes see in one phase. */
static int two_tones(double t, size_t d, void *params, double *F)
{
    (void)params;
    for (size_t i = 0; i < d; i++)
        F[i] = cos(t) + (i == 0 ? 0.01 * cos(fast * t) : 0);
    return 0;
}

START_TEST(eq_18_7_a_small_fast_part_of_a_force_is_seen)
{
    const double mass[] = { 1, 1 }, rho[] = { 0.2, 0.2 }, c = 1,
                 none[] = { 0, 0 };
    const fvi_system system = {
        2, mass, rho, fvi_potential_harmonic(&c), { two_tones, NULL }
    };
    const fvi_run run = { .system = &system,
                          .x0 = none,
                          .p0 = none,
                          .h = 0.125,
                          .steps = 128,
                          .kappa = 0.5,
                          .alpha = 0.3 };
    double x[2 * 129];
    fvi_step_found found;
    fast = 2 * M_PI * 0x1p12;
    ck_assert_int_eq(
        fvi_step_search(&fvi_lobatto3, &run, 1e-3, 1 << 13, x, NULL, &found),
        FVI_ETOL);
    fast = 3; /* nothing hides */
    ck_assert_int_eq(
        fvi_step_search(&fvi_lobatto3, &run, 1e-3, 1 << 13, x, NULL, &found),
        FVI_SUCCESS);
}
END_TEST

/* Forces that jump at every row, and at no other time: there they have the limit
 * from the right, or that from the left, and both limits are compared. */
static int from_right(double t, size_t d, void *params, double *F)
{
    (void)params;
    for (size_t i = 0; i < d; i++)
        F[i] = fmod(floor(8 * t), 2) == 0 ? 1 : -1;
    return 0;
}

static int from_left(double t, size_t d, void *params, double *F)
{
    (void)params;
    for (size_t i = 0; i < d; i++)
        F[i] = fmod(ceil(8 * t), 2) == 0 ? 1 : -1;
    return 0;
}

START_TEST(eq_18_7_jumps_at_rows_are_no_obstacle)
{
    const double one = 1, none = 0;
    const fvi_force forces[] = { { from_right, NULL }, { from_left, NULL } };
    for (size_t i = 0; i < 2; i++) {
        const fvi_system system = { 1, &one, &one, fvi_potential_harmonic(&one),
                                    forces[i] };
        const fvi_run run = { .system = &system,
                              .x0 = &none,
                              .p0 = &none,
                              .h = 0.125,
                              .steps = 128,
                              .kappa = 0.5,
                              .alpha = 0.5 };
        double x[129];
        fvi_step_found found;
        ck_assert_int_eq(fvi_step_search(&fvi_lobatto4, &run, 1e-6, 1 << 11, x,
                                         NULL, &found),
                         FVI_SUCCESS);
    }
}
END_TEST

/* The share of the circle where |cos v - c| <= (1 + c)/2 is largest at c = 1/3. */
START_TEST(eq_18_7_what_hides_is_seen_almost_surely)
{
    const int all = 3000;
    double largest = 0;
    for (double c = 0; c <= 1; c += 1.0 / 96) {
        int small = 0;
        for (int n = 0; n < all; n++)
            small += fabs(cos(2 * M_PI * (n + 0.5) / all) - c) <= (1 + c) / 2;
        largest = fmax(largest, (double)small / all);
    }
    ck_assert_near(largest, acos(-1.0 / 3) / M_PI, 2.0 / all, "at c = 1/3");
    ck_assert(largest < 0.61 && pow(0.61, 128) < 1e-27);
}
END_TEST

/* F is a constant and the rounding of it: nothing to come nearer to. */
START_TEST(eq_18_7_rounding_is_no_deviation)
{
    const fvi_linear q = { .m = 1,
                           .c = 1,
                           .rho = 0.2,
                           .alpha = 0.5,
                           .forcing = FVI_FORCING_COSINE,
                           .A = 5,
                           .w = 1e-8 };
    fvi_step_found found;
    double worst;
    ck_assert_int_eq(
        search_linear(&fvi_shifted, &q, 20, 20, 1e-3, 1 << 13, &found, &worst),
        FVI_SUCCESS);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the search for a step: refused");
    ADD_CASE(suite, "values", eq_18_5_no_wrong_run_is_accepted,
             eq_18_5_where_the_order_is_low_it_must_be_seen_too,
             eq_18_5_what_once_was_accepted_is_refused_or_right);
    ADD_CASE(suite, "decides", eq_18_6_differences_of_what_stands_still_grow,
             eq_18_7_what_hides_is_seen_almost_surely,
             eq_18_6_what_stands_still_is_not_what_converged,
             eq_18_6_all_of_a_row_of_the_hessian_counts,
             eq_18_7_a_small_fast_part_of_a_force_is_seen,
             eq_18_7_jumps_at_rows_are_no_obstacle,
             eq_18_7_rounding_is_no_deviation);
    return run_suite(suite);
}
