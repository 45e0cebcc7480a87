/* tests/fvi/test_error.c -- The library fails with a code, and does nothing else.
 * Run alone: make test-error
 *
 * All tests run with GSL's default error handler on, which would end the process. */
#include <fvi/fvi.h>
#include <fvi/paper/experiments.h>
#include <fvi/paper/fractional_derivative.h>
#include "harness/ulp.h"

#include <gsl/gsl_errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

/* ---- codes ---- */

/* The codes are GSL's; each has words of its own, and so has what is none of them. */
START_TEST(codes_are_gsl_s_numbers_and_have_words)
{
    const int codes[][2] = {
        { FVI_SUCCESS, GSL_SUCCESS },   { FVI_EDOM, GSL_EDOM },
        { FVI_EFAULT, GSL_EFAULT },     { FVI_EINVAL, GSL_EINVAL },
        { FVI_ENOMEM, GSL_ENOMEM },     { FVI_EBADFUNC, GSL_EBADFUNC },
        { FVI_EMAXITER, GSL_EMAXITER }, { FVI_ETOL, GSL_ETOL },
        { FVI_EOVRFLW, GSL_EOVRFLW },   { FVI_ELOSS, GSL_ELOSS },
        { FVI_EROUND, GSL_EROUND },     { FVI_ESING, GSL_ESING },
        { FVI_EUNSUP, GSL_EUNSUP },     { FVI_ERUNAWAY, GSL_ERUNAWAY },
        { -1, -1 }
    };
    for (size_t i = 0; i < LEN(codes); i++) {
        ck_assert_int_eq(codes[i][0], codes[i][1]);
        for (size_t j = 0; j < i; j++)
            ck_assert_str_ne(fvi_error_name(codes[i][0]),
                             fvi_error_name(codes[j][0]));
    }
    ck_assert_str_eq(fvi_error_name(-1), fvi_error_name(12345));
}
END_TEST

/* ---- handlers ---- */

static int calls, last_code;

static void note(const char *reason, const char *file, int line, int code)
{
    ck_assert(reason && *reason && file && *file && line > 0);
    calls++;
    last_code = code;
}

static void note_too(const char *reason, const char *file, int line, int code)
{
    note(reason, file, line, code);
}

START_TEST(a_handler_hears_of_an_error_once)
{
    double w[4];
    ck_assert(fvi_set_error_handler(note) == NULL);
    ck_assert_int_eq(fvi_gl_weights(2.5, 4, w), FVI_EDOM);
    ck_assert(calls == 1 && last_code == FVI_EDOM);
    ck_assert(fvi_set_error_handler(note_too) == note);
    ck_assert_int_eq(fvi_gl_weights(0.5, 4, NULL), FVI_EFAULT);
    ck_assert(calls == 2 && last_code == FVI_EFAULT);
    ck_assert(fvi_set_error_handler(NULL) == note_too);
    ck_assert_int_eq(fvi_gl_weights(2.5, 4, w), FVI_EDOM);
    ck_assert_int_eq(calls, 2);
}
END_TEST

/* ---- no memory ---- */

enum { WIDE = 200 };

static int full_value(size_t d, const double *x, void *params, double *value)
{
    (void)d, (void)x, (void)params;
    *value = 0;
    return 0;
}

static int full_gradient(size_t d, const double *x, void *params, double *g)
{
    (void)x, (void)params;
    memset(g, 0, d * sizeof *g);
    return 0;
}

static int full_hessian(size_t d, const double *x, void *params, double *H)
{
    (void)x, (void)params;
    for (size_t i = 0; i < d * d; i++)
        H[i] = 1 / (1 + (double)(i / d + i % d));
    return 0;
}

static double wide[2][WIDE]; /* ones, and x0 */

static fvi_run wide_run(fvi_system *system)
{
    for (size_t i = 0; i < WIDE; i++)
        wide[0][i] = 1;
    *system = (fvi_system){ WIDE,
                            wide[0],
                            wide[0],
                            { .value = full_value,
                              .gradient = full_gradient,
                              .hessian = full_hessian },
                            { 0 },
                            NULL, NULL };
    fvi_run run = fvi_run_default(system, wide[1], wide[0], 0x1p-6, 300);
    run.kappa = 0.25;
    return run;
}

static int load(void)
{
    fvi_system system;
    const fvi_run run = wide_run(&system);
    double out;
    return fvi_stability_number(&fvi_fractional, &run, &out);
}

static int load_of_stages(void)
{
    fvi_system system;
    const fvi_run run = wide_run(&system);
    double out;
    return fvi_stability_lobatto(3, &run, &out);
}

static int history(void)
{
    fvi_history *memory, *twin;
    int status = fvi_history_alloc(0.5, 1, 1 << 15, FVI_HISTORY_DIRECT, 0, &memory);
    if (status)
        return status;
    status = fvi_history_copy(memory, &twin);
    fvi_history_free(memory);
    if (status)
        return status;
    double x = 1;
    status = fvi_history_push(twin, &x, &x, &x);
    fvi_history_free(twin);
    return status;
}

static int fork_a_run(const fvi_method *method, fvi_history_kind kind)
{
    fvi_system system;
    fvi_run run = wide_run(&system);
    run.memory = kind;
    fvi_stepper *s, *twin;
    int status = fvi_stepper_start(method, &run, &s, NULL);
    if (status)
        return status;
    status = fvi_stepper_copy(s, &twin);
    fvi_stepper_free(s);
    if (!status)
        fvi_stepper_free(twin);
    return status;
}

static int fork_direct(void)
{
    return fork_a_run(&fvi_cq_bdf2, FVI_HISTORY_DIRECT);
}

static int fork_exponentials(void)
{
    return fork_a_run(&fvi_cq2_shifted, FVI_HISTORY_MODES);
}

static int fork_stages(void)
{
    return fork_a_run(&fvi_lobatto_m4, FVI_HISTORY_MODES);
}

static double line(double t, const void *params)
{
    (void)params;
    return t;
}

static double slope(double t, const void *params)
{
    (void)t, (void)params;
    return 1;
}

static int quadrature(void)
{
    const fvi_curve curve = { line, slope, NULL };
    double d;
    return fvi_caputo(FVI_RETARDED, 0.5, 0, &curve, 1, &d);
}

static int exact(void)
{
    const fvi_linear_oscillator problem = {
        .m = 1, .c = 1, .rho = 1, .alpha = 0.3, .x0 = 1
    };
    static double x[1 << 15];
    return fvi_exact_at(&problem, LEN(x), x, x, NULL, NULL);
}

static int matrix(void)
{
    static double x[301];
    return fvi_matrix_method_simple(1, 1, 1, 0.3, (fvi_force){ 0 }, 0.125, 300,
                                    x);
}

static int growth(void)
{
    double out;
    return fvi_amplification(0.75, 0.5, 1, 100, &out);
}

/* A stack that has been as large as this need not grow under a limit, which would be the end
 * of the process. */
static void use_stack(void)
{
    volatile char room[1 << 19];
    for (size_t i = 0; i < sizeof room; i += 1 << 10)
        room[i] = 1;
}

/* What a child says that may take so many bytes more than it has. A handler hears of
 * an error once, and of nothing else. */
static int under(int (*ask)(void), size_t more)
{
    const pid_t child = fork();
    ck_assert(child >= 0);
    if (child == 0) {
        unsigned long pages = 0;
        use_stack();
        FILE *f = fopen("/proc/self/statm", "r");
        if (!f || fscanf(f, "%lu", &pages) != 1)
            _exit(99);
        fclose(f);
        const rlim_t most = pages * (rlim_t)sysconf(_SC_PAGESIZE) + more;
        struct rlimit limit = { most, most };
        if (setrlimit(RLIMIT_AS, &limit))
            _exit(99);
        calls = 0;
        fvi_set_error_handler(note);
        const int code = ask();
        _exit(calls == (code != 0) ? code : 98);
    }
    int status;
    ck_assert(waitpid(child, &status, 0) == child);
    ck_assert_msg(WIFEXITED(status), "ended by signal %d with %zu bytes more",
                  WTERMSIG(status), more);
    return WEXITSTATUS(status);
}

/* With no byte more than the process has, with some more, and so on until there are
 * enough: FVI_ENOMEM until then, whichever allocation it is that fails. A sanitizer has
 * no room for itself under such a limit. */
#ifdef __SANITIZE_ADDRESS__
enum { IS_SANITIZED = 1 };
#else
enum { IS_SANITIZED = 0 };
#endif
START_TEST(without_memory_the_code_says_so_and_no_process_ends)
{
    const struct {
        int (*ask)(void);
        size_t step; /* bytes */
        int fails;   /* at least so often */
    } all[] = {
        { load, 1 << 15, 5 },        { load_of_stages, 1 << 16, 5 },
        { history, 1 << 16, 5 },     { fork_direct, 1 << 16, 5 },
        { fork_stages, 1 << 16, 5 }, { fork_exponentials, 1 << 16, 5 },
        { quadrature, 1 << 12, 0 },  { exact, 1 << 12, 0 },
        { matrix, 1 << 15, 5 },      { growth, 1 << 12, 0 },
    };
    for (size_t i = 0; i < LEN(all) && !IS_SANITIZED; i++) {
        int status = FVI_ENOMEM, fails = 0;
        while (status == FVI_ENOMEM) {
            status = under(all[i].ask, (size_t)fails * all[i].step);
            fails += status == FVI_ENOMEM;
        }
        ck_assert_msg(status == 0, "row %zu: %d", i, status);
        ck_assert_msg(fails >= all[i].fails, "row %zu: %d", i, fails);
    }
}
END_TEST

/* ---- GSL's handler ---- */

static double negative(double z, void *params)
{
    (void)z, (void)params;
    return -1;
}

static void gsl_s(const char *reason, const char *file, int line, int code)
{
    (void)reason, (void)file, (void)line, (void)code;
    calls++;
}

/* What fails in GSL, a root that is not there, is not heard there; and who was its
 * handler is so again. */
START_TEST(gsl_s_handler_is_left_as_it_was)
{
    double out = 7;
    gsl_error_handler_t *before = gsl_set_error_handler(gsl_s);
    ck_assert_int_eq(load(), 0);
    ck_assert_int_eq(history(), 0);
    ck_assert_int_eq(quadrature(), 0);
    ck_assert_int_eq(growth(), 0);
    const gsl_function no_root = { negative, NULL };
    ck_assert_int_eq(fvi_amplification_of_kernel(no_root, -1, &out), FVI_EINVAL);
    ck_assert(out == 7);
    ck_assert_int_eq(calls, 0);
    ck_assert(gsl_set_error_handler(before) == gsl_s);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("errors");
    ADD_CASE(suite, "errors", codes_are_gsl_s_numbers_and_have_words,
             a_handler_hears_of_an_error_once,
             without_memory_the_code_says_so_and_no_process_ends,
             gsl_s_handler_is_left_as_it_was);
    return run_suite(suite);
}
