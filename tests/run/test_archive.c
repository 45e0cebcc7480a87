/* tests/run/test_archive.c -- A run that is saved and continued.
 * Run alone: make test-archive */
#include <fvi/fvi.h>
#include "harness/ulp.h"

#include <stdlib.h>

/* HALF is beyond the window of 32 terms of one memory and the first block, of 64, of another. */
enum { N = 120, HALF = 70, D = 3, ROOM = 1 << 20 };

/* An archive that keeps the pieces, or gives them back. */
typedef struct {
    fvi_archive archive;
    unsigned char *at, *end;
    size_t pieces, constants, wrong; /* the number of a piece that is spoiled */
} shelf;

static int save(fvi_archive *v, void *data, size_t bytes, int constant)
{
    shelf *s = (shelf *)v;
    ck_assert(bytes <= (size_t)(s->end - s->at));
    if (bytes > 0)
        memcpy(s->at, data, bytes);
    s->at += bytes;
    s->pieces++;
    s->constants += constant != 0;
    return 0;
}

static int load(fvi_archive *v, void *data, size_t bytes, int constant)
{
    shelf *s = (shelf *)v;
    if (bytes > (size_t)(s->end - s->at)
        || (constant && memcmp(s->at, data, bytes) != 0))
        return -7;
    if (!constant && bytes > 0)
        memcpy(data, s->at, bytes);
    s->at += bytes;
    return 0;
}

/* The same, but the number s->wrong of the pieces that are one count, or one number of
 * that size, is far too large. */
static int load_wrong(fvi_archive *v, void *data, size_t bytes, int constant)
{
    shelf *s = (shelf *)v;
    const int status = load(v, data, bytes, constant);
    if (!constant && (bytes == 4 || bytes == 8) && s->pieces++ == s->wrong)
        memset(data, 0x7f, bytes); /* a double is 1e306 */
    return status;
}

/* The same, but it is one more, or a rounding. */
static int load_one_more(fvi_archive *v, void *data, size_t bytes, int constant)
{
    shelf *s = (shelf *)v;
    const int status = load(v, data, bytes, constant);
    if (!constant && bytes == 8 && s->pieces++ == s->wrong)
        ++*(unsigned char *)data;
    return status;
}

static unsigned char bytes[ROOM];

static int add_if_constant(fvi_archive *v, void *data, size_t length,
                           int constant)
{
    (void)data;
    ((shelf *)v)->constants += constant ? length : 0;
    return 0;
}

/* The bytes that steps do not change, also of a stepper that is of no use any more. */
static size_t constant_bytes(fvi_stepper *s)
{
    shelf all = { .archive = { add_if_constant } };
    fvi_stepper_archive(s, &all.archive);
    return all.constants;
}

static size_t saved(fvi_stepper *s)
{
    shelf all = { { save }, bytes, bytes + ROOM, 0, 0, 0 };
    ck_assert_int_eq(fvi_stepper_archive(s, &all.archive), 0);
    ck_assert(all.pieces > all.constants && all.constants >= 5);
    return (size_t)(all.at - bytes);
}

static int loaded(fvi_stepper *s, size_t size)
{
    shelf all = { { load }, bytes, bytes + size, 0, 0, 0 };
    int status = fvi_stepper_archive(s, &all.archive);
    ck_assert(status != 0 || all.at == all.end);
    return status;
}

static void steps(fvi_stepper *s, size_t count)
{
    for (size_t k = 0; k < count; k++)
        ck_assert_int_eq(fvi_stepper_step(s), FVI_SUCCESS);
}

static const double mass[D] = { 1, 2, 1 }, rho[D] = { 0.3, 0, 0.2 },
                    x0[D] = { 1, 0, -0.5 }, p0[D] = { 0.5, 0.1, 0 },
                    cg[2] = { 1, 0.5 }, aw[2] = { 0.3, 2 };

static fvi_system duffing(void)
{
    return (fvi_system){
        .d = D, .mass = mass, .damping = rho, .potential = fvi_potential_chain(cg), .force = fvi_force_cosine(aw)
    };
}

/* Every method, memory, past and kind of alpha: the run that goes on from what was saved
 * has the bits of the one that was not interrupted. */
START_TEST(a_run_goes_on_with_the_same_bits)
{
    static const double alphas[] = { 0, 0.3, 0.5, 0.75, 1 };
    const fvi_system system = duffing();
    size_t tried = 0;
    for (size_t m = 0; fvi_methods[m]; m++)
        for (size_t a = 0; a < LEN(alphas); a++)
            for (int kind = 0; kind <= FVI_HISTORY_MODES; kind++)
                for (int past = 0; past < 3; past++) {
                    fvi_run run = fvi_run_default(&system, x0, p0, 0.05, N);
                    fvi_stepper *whole, *again;
                    run.alpha = alphas[a];
                    run.memory = (fvi_history_kind)kind;
                    run.past = (fvi_initial_history)past;
                    if (kind > 0 && 4 * run.alpha == floor(4 * run.alpha)
                        && run.alpha != 0.75)
                        continue; /* 0, 1/2, 1: the kinds are one */
                    if (fvi_stepper_start(fvi_methods[m], &run, &whole, NULL))
                        continue; /* not for this method */
                    if (fvi_methods[m]
                            ->dense) { /* steps of its own: H 22 */
                        fvi_stepper_free(whole);
                        continue;
                    }
                    steps(whole, HALF);
                    const size_t size = saved(whole);
                    steps(whole, N - HALF);
                    ck_assert_int_eq(fvi_stepper_start(fvi_methods[m], &run, &again,
                                                       NULL),
                                     0);
                    ck_assert_int_eq(loaded(again, size), 0);
                    ck_assert(again->k == HALF && again->t == HALF * 0.05);
                    steps(again, N - HALF);
                    ck_assert_msg(
                        memcmp(whole->x, again->x, D * sizeof *x0) == 0
                            && memcmp(whole->p, again->p, D * sizeof *x0) == 0,
                        "%s, alpha = %g, memory %d, past %d",
                        fvi_methods[m]->name, alphas[a], kind, past);
                    fvi_stepper_free(whole);
                    fvi_stepper_free(again);
                    tried++;
                }
    ck_assert_uint_gt(tried, 200);
}
END_TEST

/* O(Q d) bytes with the compressed memory, whatever N: of a window of 2 * 32 terms, at most 100
 * modes and some more for each coordinate, and twice 100 nodes. */
START_TEST(what_is_saved_is_short)
{
    const fvi_system system = duffing();
    fvi_run run = fvi_run_default(&system, x0, p0, 0.05, 1000000);
    fvi_stepper *s;
    run.alpha = 0.3;
    run.memory = FVI_HISTORY_MODES;
    ck_assert_int_eq(fvi_stepper_start(&fvi_fractional, &run, &s, NULL), 0);
    steps(s, 1000);
    ck_assert_uint_lt(saved(s), 8 * (D * (100 + 2 * 32 + 20) + 200 + 20));
    fvi_stepper_free(s);
}
END_TEST

/* Of another problem, or a longer run, nothing is taken, and not the sizes of its pieces. */
START_TEST(another_run_is_refused)
{
    const double large_masses[D] = { 1, 2, 1.5 }, less[D] = { 0.3, 0, 0.1 };
    const fvi_system system = duffing();
    fvi_system other = system, second = system, small = system;
    other.mass = large_masses;
    second.damping = less;
    small.d = 2;
    const struct {
        const fvi_system *system;
        double alpha;
        size_t steps;
        fvi_history_kind memory;
        int status;
    } runs[] = { { &system, 0.3, N, FVI_HISTORY_MODES, 0 },
                 { &other, 0.3, N, FVI_HISTORY_MODES, -7 },
                 { &second, 0.3, N, FVI_HISTORY_MODES, -7 },
                 { &small, 0.3, N, FVI_HISTORY_MODES, -7 },
                 { &system, 0.4, N, FVI_HISTORY_MODES, -7 },
                 { &system, 0.3, 9 * N, FVI_HISTORY_MODES, -7 },
                 { &system, 0.3, N, FVI_HISTORY_DIRECT, -7 },
                 { &system, 0.3, 99, FVI_HISTORY_DIRECT, FVI_EINVAL } };
    fvi_run run = fvi_run_default(&system, x0, p0, 0.05, N);
    fvi_stepper *s;
    run.alpha = 0.3;
    run.memory = FVI_HISTORY_MODES;
    ck_assert_int_eq(fvi_stepper_start(&fvi_fractional, &run, &s, NULL), 0);
    steps(s, 100);
    const size_t size = saved(s);
    fvi_stepper_free(s);
    for (size_t n = 0; n < LEN(runs); n++) {
        run.system = runs[n].system;
        run.alpha = runs[n].alpha;
        run.steps = runs[n].steps;
        run.memory = runs[n].memory;
        ck_assert_int_eq(fvi_stepper_start(&fvi_fractional, &run, &s, NULL), 0);
        const size_t own = constant_bytes(s);
        ck_assert_int_eq(loaded(s, size), runs[n].status);
        if (runs[n].status == -7)
            ck_assert_uint_eq(constant_bytes(s), own);
        fvi_stepper_free(s);
    }
    ck_assert_int_eq(fvi_stepper_archive(NULL, NULL), FVI_EFAULT);
}
END_TEST

/* Whoever wrote the state could make any checksum right: each count and each time in it is
 * judged before it is used. Of variable steps the size of x, and what is known of the force
 * and of the steps so far, may be any number: three numbers and two counts. */
START_TEST(a_count_that_no_run_has_is_refused)
{
    enum { WIDE = 20 };
    double many[4][WIDE];
    for (size_t i = 0; i < 4 * WIDE; i++)
        many[i / WIDE][i % WIDE] = 0.5 + (double)(i % 3);
    const fvi_system small = duffing(), wide = {
        .d = WIDE, .mass = many[0], .damping = many[1], .potential = fvi_potential_chain(cg),
        .force = fvi_force_cosine(aw)
    };
    const struct {
        const fvi_method *method;
        const fvi_system *system;
        fvi_history_kind memory;
        size_t any;
    } runs[] = { { &fvi_fractional, &small, FVI_HISTORY_DIRECT, 0 },
                 { &fvi_fractional, &small, FVI_HISTORY_MODES, 0 },
                 { &fvi_fractional, &wide, FVI_HISTORY_MODES, 0 },
                 { &fvi_cq_bdf2, &small, FVI_HISTORY_MODES, 0 },
                 { &fvi_lobatto_m3, &small, FVI_HISTORY_MODES, 0 },
                 { &fvi_variable_step, &small, FVI_HISTORY_MODES, 5 } };
    for (size_t n = 0; n < LEN(runs); n++) {
        const int is_wide = runs[n].system == &wide;
        fvi_run run = fvi_run_default(runs[n].system, is_wide ? many[2] : x0,
                                      is_wide ? many[3] : p0, 0.05, N);
        run.alpha = 0.3;
        run.memory = runs[n].memory;
        fvi_stepper *s;
        size_t accepted = 0, wrong = 0;
        ck_assert_int_eq(fvi_stepper_start(runs[n].method, &run, &s, NULL), 0);
        while (s->k < HALF)
            ck_assert_int_eq(fvi_stepper_step(s), 0);
        const size_t size = saved(s);
        for (;; wrong++) {
            shelf all = { { load_wrong }, bytes, bytes + size, 0, 0, wrong };
            const int status = fvi_stepper_archive(s, &all.archive);
            if (!status && all.pieces <= wrong)
                break; /* there are no more */
            ck_assert_msg(!status || status == FVI_EINVAL, "run %zu", n);
            accepted += !status;
            ck_assert_int_eq(fvi_stepper_reset(s), 0);
        }
        ck_assert_msg(wrong >= 3 && accepted == runs[n].any,
                      "run %zu: of %zu counts %zu may be anything", n, wrong,
                      accepted);
        fvi_stepper_free(s);
    }
}
END_TEST

/* A count that is possible must fit the others: k, t, and the terms of a memory that has no
 * past. */
START_TEST(counts_that_do_not_fit_are_refused)
{
    const fvi_system system = duffing();
    const fvi_method *const methods[] = { &fvi_fractional, &fvi_fractional,
                                          &fvi_variable_step };
    const size_t wrong[] = { 0, 2, 0 };
    for (size_t n = 0; n < LEN(wrong); n++) {
        const fvi_run run = fvi_run_default(&system, x0, p0, 0.05, N);
        fvi_stepper *s;
        ck_assert_int_eq(fvi_stepper_start(methods[n], &run, &s, NULL), 0);
        while (s->k < HALF)
            ck_assert_int_eq(fvi_stepper_step(s), 0);
        const size_t size = saved(s);
        shelf all = { { load_one_more }, bytes, bytes + size, 0, 0, wrong[n] };
        ck_assert_int_eq(fvi_stepper_archive(s, &all.archive), FVI_EINVAL);
        fvi_stepper_free(s);
    }
}
END_TEST

/* A force that fails in the middle of a step: p has moved, but t has not. */
static int force_that_may_fail(double t, size_t d, void *params, double *F)
{
    int *calls_left = params;
    (void)t;
    for (size_t i = 0; i < d; i++)
        F[i] = 1;
    return *calls_left > 0 && --*calls_left == 0 ? -9 : 0;
}

START_TEST(a_step_that_failed_is_not_saved)
{
    int calls_left;
    fvi_system system = duffing();
    system.force = (fvi_force){ .value = force_that_may_fail, .params = &calls_left };
    const fvi_method *const methods[] = { &fvi_fractional, &fvi_cq2_midpoint, &fvi_lobatto_m4, &fvi_variable_step };
    for (size_t n = 0; n < LEN(methods); n++) {
        const fvi_run run = fvi_run_default(&system, x0, p0, 0.05, N);
        fvi_stepper *s, *copy;
        calls_left = 0;
        ck_assert_int_eq(fvi_stepper_start(methods[n], &run, &s, NULL), 0);
        ck_assert_int_eq(fvi_stepper_step(s), 0);
        calls_left = methods[n] == &fvi_cq2_midpoint ? 2 : 1;
        ck_assert_int_eq(fvi_stepper_step(s), -9);
        shelf all = { { save }, bytes, bytes + ROOM, 0, 0, 0 };
        ck_assert_int_eq(fvi_stepper_archive(s, &all.archive), FVI_EINVAL);
        ck_assert_int_eq(fvi_stepper_copy(s, &copy), 0);
        ck_assert_int_eq(fvi_stepper_archive(copy, &all.archive), FVI_EINVAL);
        ck_assert(all.at == bytes);
        ck_assert_int_eq(fvi_stepper_reset(s), 0);
        ck_assert_int_eq(fvi_stepper_archive(s, &all.archive), 0);
        fvi_stepper_free(copy);
        fvi_stepper_free(s);
    }
}
END_TEST

/* The direct memory knows all that was, and so a run may be made longer. */
START_TEST(a_run_with_the_direct_memory_may_be_made_longer)
{
    const fvi_system system = duffing();
    fvi_run run = fvi_run_default(&system, x0, p0, 0.05, 2 * N);
    fvi_stepper *whole, *first, *longer;
    run.alpha = 0.3;
    run.memory = FVI_HISTORY_DIRECT;
    ck_assert_int_eq(fvi_stepper_start(&fvi_cq2_shifted, &run, &whole,
                                       NULL), 0);
    ck_assert_int_eq(fvi_stepper_start(&fvi_cq2_shifted, &run, &longer,
                                       NULL), 0);
    run.steps = N;
    ck_assert_int_eq(fvi_stepper_start(&fvi_cq2_shifted, &run, &first,
                                       NULL), 0);
    steps(whole, 2 * N);
    steps(first, N);
    ck_assert_int_eq(loaded(longer, saved(first)), 0);
    steps(longer, N);
    ck_assert(memcmp(whole->x, longer->x, D * sizeof *x0) == 0);
    fvi_stepper_free(whole);
    fvi_stepper_free(first);
    fvi_stepper_free(longer);
}
END_TEST

/* A method that keeps data, and does not show them. */
START_TEST(a_method_without_serialize_is_refused)
{
    fvi_method shy = fvi_fractional;
    shy.serialize = NULL;
    const fvi_system system = duffing();
    const fvi_run run = fvi_run_default(&system, x0, p0, 0.05, N);
    fvi_stepper *s;
    ck_assert_int_eq(fvi_stepper_start(&shy, &run, &s, NULL), 0);
    shelf all = { { save }, bytes, bytes + ROOM, 0, 0, 0 };
    ck_assert_int_eq(fvi_stepper_archive(s, &all.archive), FVI_EUNSUP);
    ck_assert_uint_eq(all.pieces, 0);
    fvi_stepper_free(s);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("runs that are saved");
    ADD_CASE(suite, "values", a_run_goes_on_with_the_same_bits,
             what_is_saved_is_short,
             a_run_with_the_direct_memory_may_be_made_longer);
    ADD_CASE(suite, "errors", another_run_is_refused,
             a_count_that_no_run_has_is_refused,
             counts_that_do_not_fit_are_refused, a_step_that_failed_is_not_saved,
             a_method_without_serialize_is_refused);
    return run_suite(suite);
}
