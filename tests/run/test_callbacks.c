/* tests/run/test_callbacks.c -- Calls that a callback must not make for the stepper that called it.
 * Run alone: make test-callbacks */
#include <fvi/fvi.h>
#include "harness/ulp.h"

enum { N = 20 };

/* A spring, or an archive, that tries everything with `of`, if there is one. */
typedef struct {
    fvi_archive archive; /* the first: a pointer to it is one to this */
    fvi_stepper *of;
    size_t refused, asked;
} meddler;

static int let_pass(fvi_archive *v, void *data, size_t bytes, int constant)
{
    (void)v, (void)data, (void)bytes, (void)constant;
    return 0;
}

static void meddle(meddler *m)
{
    fvi_archive archive = { let_pass };
    fvi_stepper *copy;
    if (!m->of)
        return;
    const int codes[] = { fvi_stepper_step(m->of), fvi_stepper_copy(m->of, &copy),
                          fvi_stepper_archive(m->of, &archive), fvi_stepper_reset(m->of),
                          fvi_stepper_free(m->of) };
    for (size_t i = 0; i < LEN(codes); i++)
        m->refused += codes[i] == FVI_EINVAL;
    m->asked += LEN(codes);
}

static int value(size_t d, const double *x, void *params, double *energy)
{
    meddle(*(meddler **)params);
    *energy = 0;
    for (size_t i = 0; i < d; i++)
        *energy += x[i] * x[i] / 2 + x[i] * x[i] * x[i] * x[i] / 4;
    return 0;
}

static int gradient(size_t d, const double *x, void *params, double *g)
{
    meddle(*(meddler **)params);
    for (size_t i = 0; i < d; i++)
        g[i] = x[i] + x[i] * x[i] * x[i];
    return 0;
}

static int hessian(size_t d, const double *x, void *params, double *H)
{
    meddle(*(meddler **)params);
    for (size_t i = 0; i < d; i++)
        H[i] = 1 + 3 * x[i] * x[i];
    return 0;
}

static int force(double t, size_t d, void *params, double *F)
{
    meddle(*(meddler **)params);
    for (size_t i = 0; i < d; i++)
        F[i] = t;
    return 0;
}

static int meddle_and_pass(fvi_archive *v, void *data, size_t bytes,
                           int constant)
{
    (void)data, (void)bytes, (void)constant;
    meddle((meddler *)v);
    return 0;
}

static const double one = 1, half = 0.5;

static fvi_system system_of(meddler **m)
{
    return (fvi_system){ .d = 1,
                         .mass = &one,
                         .damping = &half,
                         .potential = { .value = value,
                                        .gradient = gradient,
                                        .hessian = hessian,
                                        .diagonals = 1,
                                        .params = m },
                         .force = { .value = force, .params = m } };
}

/* Every method: a run whose callbacks try has the digits of one whose callbacks do not, and
 * all that they try is refused. */
START_TEST(a_callback_cannot_touch_its_stepper)
{
    size_t tried = 0;
    for (size_t n = 0; fvi_methods[n]; n++) {
        meddler m = { .archive = { meddle_and_pass } }, *to = &m;
        const fvi_system system = system_of(&to);
        fvi_run run = fvi_run_default(&system, &one, &half, 0.1, N);
        fvi_stepper *undisturbed, *s;
        if (fvi_stepper_start(fvi_methods[n], &run, &undisturbed, NULL))
            continue;
        while (undisturbed->t < N * 0.1)
            ck_assert_int_eq(fvi_stepper_step(undisturbed), 0);
        ck_assert_int_eq(fvi_stepper_start(fvi_methods[n], &run, &s, NULL), 0);
        m.of = s;
        while (s->t < N * 0.1)
            ck_assert_int_eq(fvi_stepper_step(s), 0);
        ck_assert_uint_gt(m.asked, 0);
        ck_assert_msg(s->k == undisturbed->k && *s->x == *undisturbed->x && *s->p == *undisturbed->p
                          && m.refused == m.asked,
                      "%s: %zu of %zu refused", fvi_methods[n]->name, m.refused,
                      m.asked);
        m.refused = m.asked = 0;
        ck_assert_int_eq(fvi_stepper_archive(s, &m.archive), 0);
        ck_assert_int_eq(fvi_stepper_reset(s), 0);
        ck_assert_msg(m.asked > 0 && m.refused == m.asked,
                      "%s: archive and reset", fvi_methods[n]->name);
        m.of = NULL;
        ck_assert_int_eq(fvi_stepper_step(s), 0); /* it is its own again */
        ck_assert_int_eq(fvi_stepper_free(s), 0);
        ck_assert_int_eq(fvi_stepper_free(undisturbed), 0);
        tried++;
    }
    ck_assert_uint_gt(tried, 20);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("callbacks of a run");
    ADD_CASE(suite, "errors", a_callback_cannot_touch_its_stepper);
    return run_suite(suite);
}
