/* tests/run/test_threads.c -- Runs that share no stepper can run in several threads. `make portability` runs this
 * under ThreadSanitizer too.
 * Run alone: make test-threads */
#define _POSIX_C_SOURCE 200809L /* pthread_barrier_t */
#include "harness/ulp.h"
#include "many_runs.h"

#include <pthread.h>

enum { THREADS = 2, TIMES = 10 };
static many_run alone[MANY];
static pthread_barrier_t ready;

/* Both threads do all runs again and again, one of them backwards, and remember the
 * first that came out otherwise. */
typedef struct {
    int backwards;
    const char *first;
} worker;

static void *all_runs(void *argument)
{
    worker *w = argument;
    pthread_barrier_wait(&ready);
    for (size_t i = 0; i < TIMES * MANY && !w->first; i++) {
        const size_t n = w->backwards ? MANY - 1 - i % MANY : i % MANY;
        many_run r;
        many_run_of(n, &r);
        if (memcmp(&r, &alone[n], sizeof r) != 0)
            w->first = alone[n].name;
    }
    return NULL;
}

START_TEST(two_threads_give_the_digits_of_one)
{
    pthread_t thread[THREADS];
    worker workers[THREADS] = { { 0, NULL }, { 1, NULL } };
    size_t done = 0;
    for (size_t i = 0; i < MANY; i++) {
        many_run_of(i, &alone[i]);
        done += alone[i].status == 0;
    }
    ck_assert_uint_ge(done, MANY / 2); /* some are refused, and that alike */
    ck_assert_int_eq(pthread_barrier_init(&ready, NULL, THREADS), 0);
    for (size_t t = 0; t < THREADS; t++)
        ck_assert_int_eq(
            pthread_create(&thread[t], NULL, all_runs, &workers[t]), 0);
    for (size_t t = 0; t < THREADS; t++)
        ck_assert_int_eq(pthread_join(thread[t], NULL), 0);
    pthread_barrier_destroy(&ready);
    for (size_t t = 0; t < THREADS; t++)
        ck_assert_msg(!workers[t].first, "thread %zu: %s", t, workers[t].first);
}
END_TEST

/* ---- CHOLMOD in several threads ---- */

enum { WIDE = 40 };

/* A spring from each mass to the mass `WIDE / 2` places on: a band so wide that CHOLMOD
 * factorises it. A few steps; x of the first mass, or NaN. */
static void *run_of_wide_matrices(void *place)
{
    fvi_triplet triplets[3 * WIDE];
    fvi_sparse M, K, none;
    fvi_structure *structure;
    fvi_stepper *s;
    double x0[WIDE] = { 1 }, p0[WIDE] = { 0 }, *x = place;
    size_t n = 0;
    char fault;
    for (int i = 0; i < WIDE; i++)
        triplets[n++] = (fvi_triplet){ i, i, 1 };
    *x = NAN;
    pthread_barrier_wait(&ready);
    if (fvi_sparse_assemble(WIDE, n, triplets, &M)
        || fvi_sparse_assemble(WIDE, 0, triplets, &none))
        return NULL;
    for (int i = 0; i < WIDE; i++)
        triplets[i].entry = 4;
    for (int i = 0; i < WIDE / 2; i++) {
        triplets[n++] = (fvi_triplet){ i, i + WIDE / 2, -1 };
        triplets[n++] = (fvi_triplet){ i + WIDE / 2, i, -1 };
    }
    if (!fvi_sparse_assemble(WIDE, n, triplets, &K)
        && !fvi_structure_alloc(&M, &K, &none, &structure, &fault)) {
        const fvi_system system = fvi_structure_system(structure);
        const fvi_run run = fvi_run_default(&system, x0, p0, 0.1, 3);
        if (!fvi_stepper_start(&fvi_cq2_midpoint, &run, &s, NULL)) {
            while (s->k < 3 && !fvi_stepper_step(s))
                *x = s->x[0];
            fvi_stepper_free(s);
        }
        fvi_structure_free(structure);
        fvi_sparse_free(&K);
    }
    fvi_sparse_free(&M);
    fvi_sparse_free(&none);
    return NULL;
}

START_TEST(two_threads_may_factorise_at_once)
{
    pthread_t thread[THREADS];
    double x[THREADS] = { 0 };
    ck_assert_int_eq(pthread_barrier_init(&ready, NULL, THREADS), 0);
    for (size_t t = 0; t < THREADS; t++)
        ck_assert_int_eq(
            pthread_create(&thread[t], NULL, run_of_wide_matrices, &x[t]), 0);
    for (size_t t = 0; t < THREADS; t++)
        ck_assert_int_eq(pthread_join(thread[t], NULL), 0);
    pthread_barrier_destroy(&ready);
    ck_assert(x[0] == x[1]);
    ck_assert(x[0] > 0.5 && x[0] < 1);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("runs in threads");
    ADD_CASE(suite, "threads", two_threads_give_the_digits_of_one,
             two_threads_may_factorise_at_once);
    return run_suite(suite);
}
