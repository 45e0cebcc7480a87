/* tests/identification/test_identification_records.c -- H 24: data with several columns of several masses, and
 * several records.
 * Run alone: make test-identification_records */
#include "identification_runs.h"

enum { D = 3, ROWS = 120, COLUMNS = 3 };

/* Three masses in a row, c = 4; a damper of Zener's on the first, and one on the elongation of the
 * last two: rho, alpha, time. */
static const double TRUTH[] = { 4, 1.2, 0.3, 0.8 };
static const double FIRST[] = { 1, 0, 0 }, BETWEEN[] = { 0, -1, 1 };
static const char *const SHOWN[] = { "x1", "x3-x2", "v2" };

typedef struct {
    double mass[D], damping[D], cg[2], x0[D], p0[D], t[ROWS], x[2][COLUMNS][ROWS];
    fvi_kernel_term term[2];
    fvi_kernel kernel[2];
    fvi_damper damper[2];
    fvi_mechanism mechanism;
    fvi_system system;
    fvi_run run;
    fvi_expression *shows[COLUMNS];
    fvi_measured measured[2][COLUMNS];
    fvi_record record[2];
    double second_x0[D];
    fvi_estimation fit;
} body;

static const fvi_free_parameter WHICH[] = {
    FVI_FREE_PARAMETER_CONSTANT, FVI_FREE_PARAMETER_LAW + FVI_FREE_PARAMETER_EACH,
    FVI_FREE_PARAMETER_LAW + 1 + FVI_FREE_PARAMETER_EACH,
    FVI_FREE_PARAMETER_LAW + 2 + FVI_FREE_PARAMETER_EACH
};

static void build(body *b, const double *numbers)
{
    const fvi_symbols names = { "x", D, NULL, 0 };
    *b = (body){ .mass = { 1, 2, 1 },
                 .cg = { numbers[0], 0 },
                 .x0 = { 1, 0, 0 },
                 .p0 = { 0, 0.5, 0 },
                 .second_x0 = { 0, 0, -1 } };
    b->term[0] = (fvi_kernel_term){ FVI_KERNEL_ZENER, numbers[1], numbers[2], numbers[3], 0 };
    b->term[1] = (fvi_kernel_term){ FVI_KERNEL_POWER, 0.3, 0.4, 0, 0 };
    for (size_t k = 0; k < 2; k++) {
        b->kernel[k] = (fvi_kernel){ 1, b->term + k };
        b->damper[k] = (fvi_damper){ .of = fvi_elongation_row(k ? BETWEEN : FIRST),
                                     .kernel = b->kernel + k };
    }
    b->mechanism = (fvi_mechanism){ .damper_count = 2, .damper = b->damper };
    b->system = (fvi_system){ .d = D,
                              .mass = b->mass,
                              .damping = b->damping,
                              .potential = fvi_potential_chain(b->cg),
                              .mechanism = &b->mechanism };
    b->run = fvi_run_default(&b->system, b->x0, b->p0, 1, 1);
    for (size_t i = 0; i < ROWS; i++)
        b->t[i] = 0.1 * (double)(i + 1);
    for (size_t c = 0; c < COLUMNS; c++)
        ck_assert_int_eq(fvi_expression_parse_state(SHOWN[c], &names, 1, NULL, &b->shows[c], NULL),
                         FVI_SUCCESS);
    for (size_t r = 0; r < 2; r++) {
        for (size_t c = 0; c < COLUMNS; c++)
            b->measured[r][c] = (fvi_measured){ b->x[r][c], 0, b->shows[c] };
        b->record[r] = (fvi_record){ .n = ROWS,
                                     .t = b->t,
                                     .measured = b->measured[r],
                                     .x0 = r ? b->second_x0 : NULL };
    }
    b->fit = (fvi_estimation){ .method = &fvi_lobatto_m4,
                               .run = &b->run,
                               .constants = b->cg,
                               .parameters = LEN(WHICH),
                               .which = WHICH,
                               .starts = 3,
                               .h = 0.1,
                               .records = 2,
                               .columns = COLUMNS,
                               .record = b->record };
}

static void clear(body *b)
{
    for (size_t c = 0; c < COLUMNS; c++)
        fvi_expression_free(b->shows[c]);
}

/* What the sensors show of the exact motion (11.20), which knows nothing of steps. */
static void fill_exact(body *to)
{
    static double x[ROWS * D], v[ROWS * D];
    body b;
    build(&b, TRUTH);
    for (size_t r = 0; r < 2; r++) {
        fvi_exact_motion *motion;
        const fvi_exact_problem problem = { .motion = { .system = &b.system },
                                            .x0 = r ? b.second_x0 : b.x0,
                                            .p0 = b.p0 };
        ck_assert_int_eq(fvi_exact_motion_alloc(&problem, &motion, NULL), FVI_SUCCESS);
        ck_assert_int_eq(fvi_exact_motion_at(motion, ROWS, b.t, x, v, NULL), FVI_SUCCESS);
        fvi_exact_motion_free(motion);
        for (size_t i = 0; i < ROWS; i++) {
            to->x[r][0][i] = x[i * D];
            to->x[r][1][i] = x[i * D + 2] - x[i * D + 1];
            to->x[r][2][i] = v[i * D + 1];
        }
    }
    clear(&b);
}

static const double BEGIN[] = { 3.2, 1, 0.4, 1 };

/* The error of the method at h = 0.1 is what is left: seen 2e-7. With h = 0.025 it is 2^-8 of that
 * or less, and it must be below 1e-7. */
START_TEST(eq_24_1_columns_and_records_give_the_parameters_back)
{
    body b;
    fvi_estimate f;
    build(&b, BEGIN);
    fill_exact(&b);
    b.fit.h = 0.025;
    ck_assert_int_eq(fvi_estimate_multistart(&b.fit, NULL, &f), FVI_SUCCESS);
    double worst = 0;
    for (size_t j = 0; j < LEN(WHICH); j++)
        worst = larger(worst, fabs(f.estimate[j] / TRUTH[j] - 1));
    seen(worst, "relative error of a parameter of three masses");
    ck_assert_double_lt(worst, 1e-7);
    for (size_t j = 0; j < LEN(WHICH); j++) /* the fit leaves no trace */
        ck_assert_double_eq(j == 0 ? b.cg[0] : j == 1 ? b.term[0].rho : j == 2 ? b.term[0].alpha
                                                                              : b.term[0].time,
                            BEGIN[j]);
    clear(&b);
}
END_TEST

static void add_noise_to(body *b, const double sigma[COLUMNS], unsigned long seed)
{
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(r, seed);
    for (size_t m = 0; m < 2; m++)
        for (size_t c = 0; c < COLUMNS; c++)
            for (size_t i = 0; i < ROWS; i++)
                b->x[m][c][i] += gsl_ran_gaussian(r, sigma[c]);
    gsl_rng_free(r);
}

static void know_sigma(body *b, const double sigma[COLUMNS])
{
    for (size_t m = 0; m < 2; m++)
        for (size_t c = 0; c < COLUMNS; c++)
            b->measured[m][c].sigma = sigma[c];
}

/* Each column counts by its own sigma: chi^2 has 716 degrees of freedom, so it is 716 -+ 38 for a
 * standard deviation. Where nobody knows sigma, that of each column comes out, to 1/sqrt(2 * 240) =
 * 4.6 %; four of these are allowed. */
START_TEST(eq_24_1_each_column_counts_by_its_own_sigma)
{
    const double sigma[] = { 0.01, 0.03, 0.1 };
    body b;
    fvi_estimate known, found;
    build(&b, BEGIN);
    fill_exact(&b);
    add_noise_to(&b, sigma, 3);
    know_sigma(&b, sigma);
    ck_assert_int_eq(fvi_estimate_multistart(&b.fit, NULL, &known), FVI_SUCCESS);
    ck_assert_double_lt(fabs(known.chi2 - 716), 4 * 38);
    ck_assert_double_lt(off(&known, TRUTH, LEN(WHICH)), 3.5);
    know_sigma(&b, (double[COLUMNS]){ 0 });
    ck_assert_int_eq(fvi_estimate_multistart(&b.fit, NULL, &found), FVI_SUCCESS);
    for (size_t c = 0; c < COLUMNS; c++) {
        ck_assert_double_eq(known.column_sigma[c], sigma[c]);
        ck_assert_double_lt(fabs(found.column_sigma[c] / sigma[c] - 1), 4 * 0.046);
    }
    for (size_t j = 0; j < LEN(WHICH); j++) /* nearly the same weights */
        ck_assert_double_lt(fabs(found.estimate[j] - known.estimate[j]), known.sd[j] / 2);
    clear(&b);
}
END_TEST

/* An offset of one sensor is found by its name, and seen where it is not asked for. */
START_TEST(eq_24_14_an_offset_of_one_column_is_seen_and_found)
{
    const double sigma[] = { 0.01, 0.01, 0.01 };
    const fvi_free_parameter with_offset[] = { FVI_FREE_PARAMETER_CONSTANT,
                                               FVI_FREE_PARAMETER_OFFSET
                                                   + 2 * FVI_FREE_PARAMETER_EACH };
    body b;
    fvi_estimate f;
    fvi_examination e;
    build(&b, TRUTH);
    fill_exact(&b);
    add_noise_to(&b, sigma, 5);
    know_sigma(&b, sigma);
    for (size_t r = 0; r < 2; r++)
        for (size_t i = 0; i < ROWS; i++)
            b.x[r][1][i] += 0.02;
    b.fit.which = with_offset;
    b.fit.parameters = 1;
    const int status = fvi_estimate_multistart(&b.fit, NULL, &f);
    ck_assert(status == FVI_SUCCESS || status == FVI_ETOL);
    ck_assert_int_eq(fvi_estimate_examine(&b.fit, &f, &e), FVI_SUCCESS);
    ck_assert(e.flags & FVI_FLAG_OFFSET);
    b.fit.parameters = 2;
    ck_assert_int_eq(fvi_estimate_multistart(&b.fit, NULL, &f), FVI_SUCCESS);
    ck_assert_int_eq(fvi_estimate_examine(&b.fit, &f, &e), FVI_SUCCESS);
    ck_assert_uint_eq(e.grave, 0);
    ck_assert_double_lt(fabs(f.estimate[1] - 0.02), 4 * f.sd[1]);
    ck_assert_double_lt(fabs(f.estimate[0] - 4), 4 * f.sd[0]);
    clear(&b);
}
END_TEST

/* A sensor of velocities, read at the nodes and between two of them, to the order of the cubic's
 * slope: of cos 2 t, h = 0.05, its fourth derivative makes 16 h^3 / (72 sqrt 3) = 1.6e-5 at most. */
START_TEST(a_velocity_between_the_steps_is_the_slope)
{
    static const fvi_free_parameter c[] = { FVI_FREE_PARAMETER_CONSTANT };
    const fvi_symbols names = { "x", 1, NULL, 0 };
    fvi_expression *v;
    question q;
    double curve[REF_POINTS];
    fvi_estimate f;
    ck_assert_int_eq(fvi_expression_parse_state("v", &names, 1, NULL, &v, NULL), FVI_SUCCESS);
    ask(&q, NULL, 1);
    q.rho = 0;
    q.p0 = 1; /* v = 1 in the first row, which is a node */
    for (size_t i = 0; i < REF_POINTS; i++) {
        q.t[i] = 0.1 * (double)i + 0.013 * (double)(i % 4);
        q.x[i] = cos(2 * q.t[i]) - 2 * sin(2 * q.t[i]);
    }
    const fvi_measured column = { q.x, 0.001, v };
    const fvi_record record = { .n = REF_POINTS, .t = q.t, .measured = &column };
    q.fit.which = c;
    q.fit.records = q.fit.columns = 1;
    q.fit.record = &record;
    q.fit.h = 0.05;
    fvi_estimate_multistart(&q.fit, curve, &f);
    ck_assert_double_lt(fabs(f.estimate[0] - 4), 1e-5);
    double worst = 0;
    for (size_t i = 0; i < REF_POINTS; i++)
        worst = larger(worst, fabs(curve[i] - q.x[i]));
    seen(worst, "error of a velocity between the steps");
    ck_assert_double_lt(worst, 3e-5);
    fvi_expression_free(v);
}
END_TEST

#define REFUSED(change, code)                                                  \
    do {                                                                       \
        body b;                                                                \
        fvi_estimate f;                                                        \
        build(&b, BEGIN);                                                      \
        fill_exact(&b);                                                        \
        change;                                                                \
        handled = 0;                                                           \
        fvi_set_error_handler(handler);                                        \
        ck_assert_int_eq(fvi_estimate_multistart(&b.fit, NULL, &f), code);     \
        ck_assert_int_eq(handled, 1);                                          \
        fvi_set_error_handler(NULL);                                           \
        clear(&b);                                                             \
    } while (0)

static const fvi_free_parameter *only(size_t which)
{
    static fvi_free_parameter one[LEN(WHICH)];
    for (size_t j = 0; j < LEN(WHICH); j++)
        one[j] = WHICH[j];
    one[0] = (fvi_free_parameter)which;
    return one;
}

START_TEST(a_fit_of_records_refuses_what_cannot_be_asked)
{
    const size_t each = FVI_FREE_PARAMETER_EACH;
    REFUSED(b.fit.record = NULL, FVI_EFAULT);
    REFUSED(b.fit.columns = 0, FVI_EINVAL);
    REFUSED(b.fit.columns = FVI_MEASURED_MOST + 1, FVI_EINVAL);
    REFUSED(b.record[1].t = NULL, FVI_EFAULT);
    REFUSED(b.record[1].n = 0, FVI_EINVAL);
    REFUSED(b.measured[1][2].x = NULL, FVI_EFAULT);
    REFUSED(b.measured[1][2].sigma = 1, FVI_EINVAL);
    REFUSED(b.x[1][2][7] = NAN, FVI_EDOM);
    REFUSED(b.second_x0[1] = INFINITY, FVI_EDOM);
    REFUSED(b.t[5] = b.t[4], FVI_EINVAL);
    REFUSED(b.fit.huber = -1, FVI_EDOM);
    REFUSED(b.fit.which = only(FVI_FREE_PARAMETER_X0 + 4 * each), FVI_EINVAL);
    REFUSED(b.fit.which = only(FVI_FREE_PARAMETER_OFFSET + 4 * each), FVI_EINVAL);
    REFUSED(b.fit.which = only(FVI_FREE_PARAMETER_CONSTANT + each), FVI_EINVAL);
    REFUSED(b.fit.which = only(FVI_FREE_PARAMETER_LAW + 3 * each), FVI_EINVAL);
    REFUSED(b.fit.which = only(FVI_FREE_PARAMETER_LAW + 2 + 2 * each), FVI_EINVAL);
    REFUSED(b.fit.which = only(FVI_FREE_PARAMETER_ALPHA), FVI_EUNSUP);
    REFUSED(b.fit.which = only(FVI_FREE_PARAMETER_RHO), FVI_EUNSUP);
}
END_TEST

/* "x0_2" and so on; a slip of the finger gets the nearest name. */
START_TEST(parameters_have_names)
{
    static const struct {
        const char *name;
        size_t which;
    } names[] = {
        { "mass", FVI_FREE_PARAMETER_MASS },
        { "x0_2", FVI_FREE_PARAMETER_X0 + 2 * FVI_FREE_PARAMETER_EACH },
        { "d1.alpha", FVI_FREE_PARAMETER_LAW + 1 + FVI_FREE_PARAMETER_EACH },
        { "d2.rho", FVI_FREE_PARAMETER_LAW + 2 * FVI_FREE_PARAMETER_EACH },
        { "offset.v2", FVI_FREE_PARAMETER_OFFSET + 3 * FVI_FREE_PARAMETER_EACH },
        { "drift", FVI_FREE_PARAMETER_DRIFT },
        { "c", FVI_FREE_PARAMETER_CONSTANT },
    };
    static const char *const wrong[] = { "x0_4", "x0_", "alpha", "d3.rho", "offset.v3", "" };
    const char *const constant[] = { "c", "g" };
    body b;
    char text[100];
    build(&b, BEGIN);
    const fvi_free_parameter_names known = { &b.run, COLUMNS, SHOWN, 2, constant, NULL, 0 };
    fvi_free_parameter which;
    fvi_error error;
    for (size_t i = 0; i < LEN(names); i++) {
        ck_assert_int_eq(fvi_parse_free_parameter("fit", names[i].name, &known, &which, &error), 0);
        ck_assert_uint_eq((size_t)which, names[i].which);
    }
    for (size_t i = 0; i < LEN(wrong); i++)
        ck_assert_int_eq(fvi_parse_free_parameter("fit", wrong[i], &known, &which, &error),
                         FVI_EINVAL);
    ck_assert_int_eq(fvi_parse_free_parameter("fit", "d1.alpa", &known, &which, &error), FVI_EINVAL);
    ck_assert(strstr(error.text, "d1.alpha"));
    ck_assert_str_eq(fvi_free_parameters_of_laws(&b.run, 8, sizeof text, text),
                     "d1.rho,d1.alpha,d1.time,d2.rho,d2.alpha");
    clear(&b);
}
END_TEST

/* Times that are even in their logarithms, and a body that swings 10^4 times between two of them, ask
 * for steps of their own. */
START_TEST(the_data_choose_the_method)
{
    question q;
    ask(&q, ref_low, 3);
    ck_assert_ptr_eq(fvi_estimate_method(&q.fit), &fvi_lobatto_m4);
    q.m = 1e-6;
    ck_assert_ptr_eq(fvi_estimate_method(&q.fit), &fvi_variable_step);
    q.m = 1;
    for (size_t i = 0; i < REF_POINTS; i++)
        q.t[i] = pow(10, -4 + 5 * (double)i / REF_POINTS);
    ck_assert_ptr_eq(fvi_estimate_method(&q.fit), &fvi_variable_step);
    q.fit.n = 0;
    ck_assert_ptr_null(fvi_estimate_method(&q.fit));
    ck_assert_ptr_null(fvi_estimate_method(NULL));
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("columns and records");
    ADD_CASE(suite, "fits", eq_24_1_columns_and_records_give_the_parameters_back,
             eq_24_1_each_column_counts_by_its_own_sigma,
             eq_24_14_an_offset_of_one_column_is_seen_and_found,
             a_velocity_between_the_steps_is_the_slope);
    ADD_CASE(suite, "questions", a_fit_of_records_refuses_what_cannot_be_asked,
             parameters_have_names, the_data_choose_the_method);
    return run_suite(suite);
}
