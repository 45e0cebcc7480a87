/* src/reference/exact_rows.c -- Solve the linear problem at evenly spaced times. [H 11] */
#include "exact_window.h"
#include "memory/double_double.h"
#include "system/fail.h"
#include "system/larger.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <string.h>

static const double LONGEST = 100;    /* largest ratio of the last time of a window to its first */
static const double GROWS = 8;        /* largest cancellation of two starts */
static const double ROUNDING = 1e-16; /* the tolerance 0 stands for this one */
static const double TAME = 1e70; /* fourth powers of larger numbers are out of range */

static int check_rows(double h, size_t n, double tolerance, const double *x,
                      const double *v, fvi_error *error)
{
    if (!x && !v)
        return fvi_fail(error, FVI_EFAULT, "x", NAN, "there are no outputs");
    if (n == 0)
        return fvi_refuse(error, "n", "n must be at least 1");
    if (!(h > 0) || !gsl_finite(h) || !gsl_finite(h * (double)n))
        return fvi_fail(error, FVI_EDOM, "h", h, "h must be finite and positive, and n h finite");
    if (!(tolerance >= 0 && tolerance < 1))
        return fvi_fail(error, FVI_EDOM, "tolerance", tolerance, "the tolerance must be in [0, 1)");
    return FVI_SUCCESS;
}

typedef struct {
    fvi_inverse *S;
    double h, tolerance, *x, *v;
    int careful; /* nonzero if the rounding of t_k matters */
    int turns;   /* nonzero if turn has been computed */
    double complex turn[FVI_POLES][FVI_BLOCK + 1]; /* e^{s j h} */
    fvi_error *error;
} rows;

/* Rows a to b for a source that began at the time `since`. */
typedef struct {
    size_t a, b;
    double since;
} range;

static double time_of(const rows *r, size_t k, double since)
{
    return (double)k * r->h - since;
}

/* ---- residues ---- */

static void prepare_turns(rows *r)
{
    for (size_t i = 0; i < r->S->poles && !r->turns; i++) {
        const fvi_residue *a = &r->S->pole[i];
        double complex *turn = r->turn[i];
        turn[0] = 1;
        for (size_t j = 1; j <= FVI_BLOCK; j *= 2) {
            turn[j] = fvi_pole_exp(a->s, a->low, (double)j * r->h, 0);
            for (size_t l = 1; l < j && j < FVI_BLOCK; l++)
                turn[j + l] = turn[j] * turn[l];
        }
    }
    r->turns = 1;
}

/* Return the rounding error of t_k: tk - (t + j h). */
static double rounded_by(const rows *r, double t, double tk, size_t j)
{
    const dd apart = two_sum(tk, -t), steps = two_product((double)j, r->h);
    return (apart.hi - steps.hi) + (apart.lo - steps.lo);
}

/* Add a residue to a block of rows. `at` is its value at the first row. */
static void add_residues(rows *r, size_t pole, double complex at, double t,
                         size_t k, size_t count, double since)
{
    const fvi_residue *a = &r->S->pole[pole];
    const int few = cabs(a->s) * time_of(r, k + count, 0) < 1e7; /* nonzero for few turns */
    for (size_t j = 0; j < count && at != 0; j++) {
        double complex e = at * r->turn[pole][j];
        if (r->careful) {
            const double complex off =
                a->s * rounded_by(r, t, time_of(r, k + j, since), j);
            e += e * (few ? off : fvi_complex_expm1(off));
        }
        if (r->x)
            r->x[k + j] += 2 * creal(e);
        if (r->v)
            r->v[k + j] += 2 * creal(a->s * e);
    }
}

/* Add the residues at one row where a cosine is in resonance with a zero of Q. Return the number of that zero, or
 * S->poles if there is none. */
static size_t find_resonance(const rows *r, const fvi_window *w, double t, double *x,
                             double *v)
{
    const fvi_inverse *S = r->S;
    for (size_t i = 0; i < S->roots && S->poles > S->roots; i++)
        if (w->passed[i] && w->passed[S->roots]
            && fvi_inverse_resonance(S, &S->root[i], t, x, v))
            return i;
    return S->poles;
}

/* Add the residues of all poles. e^{st} is computed at the first row of a block or, if few digits are asked for, of
 * eight blocks. From there it is multiplied by turns. */
static void add_all_residues(rows *r, const fvi_window *w, fvi_exact_source source,
                             range of)
{
    const fvi_inverse *S = r->S;
    double complex at[FVI_POLES];
    size_t carried = 0; /* number of blocks since e^{st} was computed */
    if (of.a <= of.b)
        prepare_turns(r);
    for (size_t k = of.a, count; k <= of.b && !fvi_interrupted(); k += count) {
        double x = 0, v = 0;
        source.t = time_of(r, k, of.since);
        const size_t near = find_resonance(r, w, source.t, &x, &v);
        count = near < S->poles ? 1 : GSL_MIN(of.b - k + 1, FVI_BLOCK);
        carried = r->careful ? 0 : carried % 8;
        if (r->x)
            r->x[k] += x;
        if (r->v)
            r->v[k] += v;
        for (size_t i = 0; i < S->poles; i++) {
            const int force = near == S->poles || (i != near && i != S->roots);
            if (!w->passed[i])
                continue;
            at[i] = carried > 0
                        ? at[i] * r->turn[i][FVI_BLOCK]
                        : fvi_inverse_residue(&S->pole[i], &source, force);
            add_residues(r, i, at[i], source.t, k, count, of.since);
        }
        carried += near == S->poles; /* only the first rows are resonant */
    }
}

/* ---- windows ---- */

/* Add the integral of a source at its rows. */
static void add_integral_rows(const rows *r, fvi_window *w, fvi_exact_source source,
                              range of)
{
    if (of.a > of.b || w->count == 0)
        return;
    source.t = time_of(r, of.a, of.since);
    fvi_window_add(w, &source, r->h, of.b - of.a + 1, r->x ? r->x + of.a : NULL,
                   r->v ? r->v + of.a : NULL);
}

/* Return the last row of the window that begins with row a. By (11.15) the range (first, last) is cut into as few equal
 * ratios as LONGEST allows. */
static size_t window_end(const rows *r, range of)
{
    const double first = time_of(r, of.a, of.since),
                 all = time_of(r, of.b, of.since) / first,
                 windows = ceil(log(all) / log(LONGEST) - 1e-9);
    if (windows <= 1)
        return of.b;
    const double more = first * (pow(all, 1 / windows) - 1) / r->h;
    return GSL_MIN(of.a + (size_t)more, of.b);
}

/* Return the first row of a range that is later than `after`; b + 1 if there is none. */
static size_t row_after(const rows *r, range of, double after)
{
    const double guess = floor(after / r->h);
    size_t k = of.a;
    if (guess > (double)of.a)
        k = (size_t)GSL_MIN_DBL(guess, (double)of.b + 1);
    while (k > of.a && time_of(r, k - 1, 0) > after)
        k--;
    while (k <= of.b && time_of(r, k, 0) <= after)
        k++;
    return k;
}

/* Add the rows of a window of a step: as a start with its force until row `late`, and from there as a start and a
 * pulse. */
static void add_step(rows *r, fvi_window *w, range of, size_t late)
{
    const fvi_linear_oscillator *p = &r->S->p;
    const fvi_exact_source plain = { .start = 1, .sign = 1 }, start = { .start = 1 };
    const fvi_exact_source pulse = { .sign = p->T > 0, .lasts = p->T },
                    both = { .start = 1, .sign = p->T > 0, .lasts = p->T };
    range rest = { late, of.b, 0 };
    of.b = late - 1;
    add_integral_rows(r, w, plain, of);
    add_all_residues(r, w, plain, of);
    if (p->x0 != 0 || p->v0 != 0)
        add_integral_rows(r, w, start, rest);
    add_all_residues(r, w, both, rest);
    rest.since = p->T;
    add_integral_rows(r, w, pulse, rest);
}

static int add_rows(rows *r, const fvi_exact_source *source, range of);

/* Add a window in which a step ends. Rows later than T + first / 2 contain a pulse. Those soon after T contain a second
 * start, with the opposite force. The window is cut there if the force, had it lasted, would outgrow the motion. */
static int add_window_of_step(rows *r, range *of)
{
    const double T = r->S->p.T, first = time_of(r, of->a, 0);
    const size_t ended = row_after(r, *of, T),
                 late = GSL_MAX(ended, row_after(r, *of, T + first / 2));
    double shortest = first, grows = 1;
    if (late > of->a && late <= of->b) {
        grows = fvi_window_growth(r->S, T, time_of(r, of->b, 0));
        if (grows > GROWS) {
            of->b = late - 1;
            grows = 1;
        }
    }
    if (late <= of->b)
        shortest = GSL_MIN_DBL(first, time_of(r, late, T));
    fvi_window w;
    int status = fvi_window_open(r->S, shortest, time_of(r, of->b, 0), r->h,
                                 r->tolerance, grows, &w, r->error);
    if (status)
        return status;
    add_step(r, &w, *of, late);
    fvi_window_close(&w);
    const fvi_exact_source off = { .sign = -1 };
    return add_rows(r, &off, (range){ ended, late - 1, T });
}

static int add_window(rows *r, const fvi_exact_source *source, range *of)
{
    const double first = time_of(r, of->a, of->since),
                 last = time_of(r, of->b, of->since);
    if (r->S->p.forcing == FVI_FORCING_STEP && source->start == 1
        && last > r->S->p.T)
        return add_window_of_step(r, of);
    fvi_window w;
    const int status =
        fvi_window_open(r->S, first, last, r->h, r->tolerance, 1, &w, r->error);
    if (status)
        return status;
    add_integral_rows(r, &w, *source, *of);
    add_all_residues(r, &w, *source, *of);
    fvi_window_close(&w);
    return FVI_SUCCESS;
}

static int add_rows(rows *r, const fvi_exact_source *source, range of)
{
    int status = FVI_SUCCESS;
    while (of.a <= of.b && !status) {
        range window = { of.a, window_end(r, of), of.since };
        status = add_window(r, source, &window);
        if (!status)
            status = fvi_interrupted();
        of.a = window.b + 1;
    }
    return status;
}

/* Set the rows from k on to NaN. Return `status` with its error. */
static int fill_with_nan(const rows *r, size_t k, size_t n, int status)
{
    for (; k <= n; k++) {
        if (r->x)
            r->x[k] = GSL_NAN;
        if (r->v)
            r->v[k] = GSL_NAN;
    }
    if (status == FVI_ELOSS)
        return fvi_fail(r->error, FVI_ELOSS, NULL, NAN, "the phase of the oscillation is lost");
    return fvi_fail(r->error, FVI_EOVRFLW, NULL, NAN, "a value is not finite");
}

/* ---- one time after the other, for what has no window ---- */

static int evaluate_one_by_one(const rows *r, size_t n)
{
    for (size_t k = 1; k <= n; k++) {
        const double t = time_of(r, k, 0);
        double x = GSL_NAN, v = GSL_NAN;
        const int end = fvi_interrupted();
        if (end)
            return end;
        if (fvi_exact_phase_is_lost(r->S, t))
            return fill_with_nan(r, k, n, FVI_ELOSS);
        fvi_exact_evaluate(r->S, t, &x, &v);
        if (r->x)
            r->x[k] = x;
        if (r->v)
            r->v[k] = v;
    }
    return FVI_SUCCESS;
}

/* Return nonzero if so many digits are asked for that the rounding of t in a phase matters, or the rounding errors of a
 * hundred turns. */
static int needs_rounding_of_times(const rows *r, size_t n)
{
    double most = 0;
    for (size_t i = 0; i < r->S->poles; i++)
        most = larger(most, cabs(r->S->pole[i].s));
    return most * time_of(r, n, 0) * GSL_DBL_EPSILON > r->tolerance / 64
           || r->tolerance < 1e-12;
}

/* Return nonzero if the squares of all numbers are in range and the phases of all times are known. */
static int is_in_range(const rows *r, size_t n)
{
    const fvi_linear_oscillator *p = &r->S->p;
    const double t = time_of(r, n, 0);
    const double C = p->c / p->m * t * t,
                 most[] = { t,
                            1 / r->h,
                            C,
                            p->rho / p->m * t * t,
                            p->rho / p->m * pow(t, 2 - r->S->beta),
                            fabs(p->x0) * fmax(C, 1),
                            fabs(p->v0) * t,
                            p->forcing ? fabs(p->A) / p->m * t * t : 0 };
    for (size_t i = 0; i < sizeof most / sizeof *most; i++)
        if (!(most[i] < TAME))
            return 0;
    for (size_t i = 0; i < r->S->poles; i++)
        if (fvi_pole_phase_error(&(fvi_pole){ .s = I * cabs(r->S->pole[i].s) },
                                 t)
            > 1e-14)
            return 0;
    return 1;
}

int fvi_exact_grid(const fvi_linear_oscillator *problem, double h, size_t n,
                   double tolerance, double *x, double *v, fvi_error *error)
{
    fvi_inverse S;
    rows r = { .S = &S,
               .h = h,
               .tolerance = GSL_MAX_DBL(tolerance, ROUNDING),
               .x = x,
               .v = v,
               .error = error };
    int status = fvi_exact_check(problem, error);
    if (!status)
        status = check_rows(h, n, tolerance, x, v, error);
    if (!status)
        status = fvi_inverse_prepare(problem, &S, error);
    if (status)
        return status;
    if (x) {
        memset(x, 0, (n + 1) * sizeof *x);
        x[0] = problem->x0;
    }
    if (v) {
        memset(v, 0, (n + 1) * sizeof *v);
        v[0] = problem->v0;
    }
    r.careful = needs_rounding_of_times(&r, n);
    const fvi_exact_source start = { .start = 1, .sign = 1 };
    status = is_in_range(&r, n) ? add_rows(&r, &start, (range){ 1, n, 0 })
                            : evaluate_one_by_one(&r, n);
    for (size_t k = 0; k <= n && !status; k++)
        if ((x && !isfinite(x[k])) || (v && !isfinite(v[k])))
            status = fill_with_nan(&r, k, n, FVI_EOVRFLW);
    return status;
}
