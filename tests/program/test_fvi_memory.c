/* tests/program/test_fvi_memory.c -- One allocation of a command fails: the first, the second, and so on.
 * Run alone: make test-fvi_memory
 *
 * The command must say that there is no memory and leave no incomplete file, or it must succeed without this
 * allocation.
 *
 * With ALL in the environment every allocation is tried (make stress). harness/failing_malloc.c is the library that
 * counts the allocations. It does not work under a sanitizer that has its own allocator; then nothing is tested. */
#define _GNU_SOURCE
#include "folder.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define OTHER_ALLOCATOR 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define OTHER_ALLOCATOR 1
#endif
#endif
#ifndef OTHER_ALLOCATOR
#define OTHER_ALLOCATOR 0
#endif

static const char *const commands[] = {
    "run --alpha 0.3 --steps 20 -o table",
    "run --alpha 0.3 --steps 9 --h 3 --kappa 1", /* unstable, and says so */
    "run --alpha 0.3 --steps 9 --h 3 --method fvi-lobatto3",
    "run --alpha 0.3 --steps 9 --potential duffing:0.1,1 --kappa 1 --h 0.6 --x0 0.5 --p0 3",
    "run --alpha 0.3 --steps 300 --memory direct --format json",
    "run --alpha 0.3 --steps 300 --memory exponentials --dimension 20",
    "run --alpha 0.3 --steps 100 --method fvi-lobatto4",
    "run --alpha 0.6 --steps 80 --method fvi-lobatto4d --potential duffing:1,1",
    "run --alpha 0.3 --steps 9 --method fvi-adaptive --potential pendulum:1",
    "run --damping maxwell:1,2 --steps 300 --method fvi-bdf2 -o table",
    "run --potential x^4/4-k*x^2/2 --let k=1 --force cos(1.2*t)/4 --steps 20",
    "run --damping distributed:.3,.1,.6 --memory exponentials --steps 900 --method fvi-lobatto8d",
    "run --damping distributed:.3,.1,.6 --memory exponentials --steps 900 --method fvi-bdf2",
    "run --damping davidson:1,.3,2 --memory exponentials --steps 300 --method fvi-bdf2 --every 50",
    "run --damping davidson:1,.3,2 --steps 300 --method fvi-stable --every 50 -o table",
    "run --damping symbol:s^.5/(1+s^.5) --steps 300 --method fvi-stable --every 50",
    "run --damping davidson:1,.3,2 --steps 200 --method fvi-lobatto4d --every 50 -o table",
    "run --damping symbol:s^.5/(1+s^.5) --steps 200 --method fvi-lobatto4d --every 50",
    "run --alpha 0.3 --steps 20 --force file:force --checkpoint c --continue -o table",
    "run --force file:force --error 1e-6 --time 5 --steps 4 -o table",
    "run --system chain --alpha 0.3 --steps 20",
    "run --alpha 0.3 --steps 9 --columns t,v,work,balance -o table",
    "run --alpha 0.3 --steps 9 --reduce max(x)",
    "run --ground sin(t) --steps 9 --columns t,x,ag",
    "run --lagrangian v1^2/2-x1^2/2 --x0 1 --v0 0 --steps 5 -o table",
    "response --alpha 0.3 --omega 0.1:10:3",
    "poles --alpha 0.3",
    "exact --alpha 0.3 --steps 9 -o table",
    "sweep --vary alpha=0:1:5 --steps 20 -o table",
    "gradient --alpha 0.3 --steps 20",
    "gradient --alpha 0.3 --steps 20 --method fvi-lobatto3 -o table",
    "gradient --alpha 0.3 --steps 9 --method fvi-adaptive",
    "fit --fit alpha,rho --starts 2 data -o table",
    "help run"
};

static const char kept[] = "what was there\n";
static char library[PATH_MAX + 30], table[1 << 16], whole_table[1 << 16],
    whole_out[sizeof out];

/* Each run that goes on finds the same checkpoint. */
static int goes_on(const char *command)
{
    return strstr(command, "--continue") != NULL;
}

/* Allocation `n` of the command fails, or none if there are fewer; did it? The exit code
 * goes to *status. */
static int run_without(const char *command, size_t n, int *status)
{
    char number[30];
    snprintf(number, sizeof number, "%zu", n);
    write_file("table", kept);
    if (goes_on(command))
        ck_assert_int_eq(shell("cp saved c"), 0);
    setenv("MALLOC_FAILS", number, 1);
    setenv("LD_PRELOAD", library, 1);
    *status = fvi_of_words(command);
    unsetenv("LD_PRELOAD");
    char name[PATH_MAX + 10];
    snprintf(name, sizeof name, "%s/table", folder);
    read_file(name, table, sizeof table);
    snprintf(name, sizeof name, "%s/failed", folder);
    return remove(name) == 0;
}

static void write_inputs(void)
{
    write_chain();
    write_file("force", "# t\tF\n0\t1\n5\t2\n");
    ck_assert_int_eq(fvi("run --alpha 0.3 --rho 0.4 --every 5 --method "
                         "fvi-lobatto4 --columns t,x -o data"),
                     0);
    ck_assert_int_eq(fvi("run --alpha 0.3 --steps 10 --force file:force --checkpoint saved -o part"),
                     0);
}

START_TEST(an_allocation_that_fails_is_said)
{
    const char *command = commands[_i];
    const int all = getenv("ALL") != NULL;
    int status;
    if (OTHER_ALLOCATOR)
        return;
    char *end;
    snprintf(library, sizeof library, "%s", getenv("FVI"));
    ck_assert_ptr_nonnull((end = strrchr(library, '/')));
    strcpy(end, "/failing_malloc.so");
    setenv("MALLOC_FAILED", "failed", 1);
    write_inputs();
    ck_assert(!run_without(command, 0, &status));
    ck_assert_msg(status == 0, "%s: %s", command, err);
    memcpy(whole_out, out, sizeof out);
    memcpy(whole_table, table, sizeof table);
    size_t said = 0;
    for (size_t n = 1; run_without(command, n, &status);
         n += all || goes_on(command) ? 1 : 1 + n / 8) {
        if (status == 0) { /* it did without */
            ck_assert_msg(strcmp(out, whole_out) == 0
                              && strcmp(table, whole_table) == 0,
                          "%s: allocation %zu: another table", command, n);
            continue;
        }
        ck_assert_msg(status == 1 && strstr(err, "memory"),
                      "%s: allocation %zu: exit code %d, '%s'", command, n,
                      status, err);
        ck_assert_msg(strcmp(table, kept) == 0,
                      "%s: allocation %zu: a part of a table", command, n);
        said++;
    }
    ck_assert(said > 2 || strstr(command, "help"));
    ck_assert_int_eq(shell("ls -A"), 0); /* no file of another name is left */
    ck_assert_msg(!strstr(out, ".fvi") && !strstr(out, ".new"), "%s", out);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the program fvi: no memory");
    TCase *each = tcase_create("errors");
    tcase_set_timeout(each, 600);
    tcase_add_loop_test(each, an_allocation_that_fails_is_said, 0,
                        (int)LEN(commands));
    suite_add_tcase(suite, each);
    return run_suite_of_program(suite);
}
