/* tests/run/test_threads.c -- Runs that share no stepper go on in several threads.
 * `make portability` runs this under ThreadSanitizer too. Run alone: make test-threads */
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

int main(void)
{
    Suite *suite = suite_create("runs in threads");
    ADD_CASE(suite, "threads", two_threads_give_the_digits_of_one);
    return run_suite(suite);
}
