/* tests/step_search/test_step_search_refused.c -- H 18: runs that agree with each other but are wrong.
 * Run alone: make test-step_search_refused */
#include "credulous.h"
#include "error_control/step_search.h"

enum { MOST = 1 << 13, EACH = 20 };

/* ---- the table of the chapter ---- */

/* The spacing of the first run's nodes */
static double finest(double T, size_t rows)
{
    while (rows < 128)
        rows *= 2;
    return T / (double)rows;
}

static void ordinary(fvi_linear_oscillator *q, double h)
{
    (void)q, (void)h;
}

static void stiff(fvi_linear_oscillator *q, double h)
{
    (void)h;
    q->c = pow(10, dice(13, 17));
}

/* All nodes of the first runs see one phase of the cosine. */
static void aliased(fvi_linear_oscillator *q, double h)
{
    q->w = 2 * M_PI / h * floor(dice(1, 6)) * exp2(floor(dice(0, 11)));
}

static const struct {
    const char *name;
    void (*change)(fvi_linear_oscillator *q, double h);
} families[] = { { "ordinary", ordinary },
                 { "stiff", stiff },
                 { "aliased", aliased } };

static const struct {
    const fvi_method *method;
    double loosest, tightest;
} methods[] = { { &fvi_fractional, 1e-1, 2e-2 },
                { &fvi_cq2_shifted, 1e-2, 1e-4 },
                { &fvi_lobatto_m3, 1e-3, 1e-8 },
                { &fvi_lobatto_m4, 1e-3, 1e-10 } };

/* EACH problems of a family, both decisions about each; the same for all methods
 * but for E. */
static void ck_assert_none_wrong(size_t family, size_t m)
{
    decider *const decide[] = { credulous, fvi_step_search };
    const char *const who[] = { "estimate", "rule" };
    int accepted[2] = { 0 }, wrong[2] = { 0 };
    for (int i = 0; i < EACH; i++) {
        fvi_linear_oscillator q = any_problem();
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
            ck_assert_none_wrong(family, m);
}
END_TEST
//< sweep

/* A kick leaves the order 1 - 2 alpha, from 0.3 down to 0.02, on oscillations that
 * the first runs do not resolve: there half an order less would be no order. */
START_TEST(eq_18_5_where_the_order_is_low_it_must_be_seen_too)
{
    for (int i = 0; i < 40; i++) {
        fvi_linear_oscillator q = any_problem();
        q.past = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
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

static void ck_assert_right_or_refused(const fvi_method *method,
                                       const char *name, const fvi_linear_oscillator *q,
                                       double T, size_t rows, double error)
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
    const fvi_method *const all[] = { &fvi_fractional, &fvi_cq2_shifted, &fvi_cq_bdf2,
                                      &fvi_lobatto_m2, &fvi_lobatto_m3 };
    const fvi_linear_oscillator cosine = { .m = 1,
                                .c = 1,
                                .rho = 0.2,
                                .alpha = 0.5,
                                .x0 = 1,
                                .v0 = 0.5,
                                .forcing = FVI_FORCING_COSINE,
                                .A = 1,
                                .w = 160.84954386379741 };
    const fvi_linear_oscillator hard = {
        .m = 1, .c = 1e12, .rho = 0.2, .alpha = 0.5, .x0 = 1, .v0 = 0.5
    };
    const fvi_linear_oscillator harder = {
        .m = 1, .c = 1e16, .rho = 0.1, .alpha = 0.3, .x0 = 1
    };
    fvi_linear_oscillator faster = cosine;
    faster.A = 5;
    faster.w = 2 * M_PI * 0x1p14;
    for (size_t i = 0; i < LEN(all); i++) {
        ck_assert_right_or_refused(all[i], "cosine", &cosine, 20, 4, 1e-2);
        ck_assert_right_or_refused(all[i], "hard", &hard, 1, 10, 1e-3);
        ck_assert_right_or_refused(all[i], "harder", &harder, 1, 10, 1e-2);
        ck_assert_right_or_refused(all[i], "faster", &faster, 20, 20, 1e-4);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the search for a step: refused");
    ADD_CASE(suite, "values", eq_18_5_no_wrong_run_is_accepted,
             eq_18_5_where_the_order_is_low_it_must_be_seen_too,
             eq_18_5_what_once_was_accepted_is_refused_or_right);
    return run_suite(suite);
}
