/* tests/bench/precision_small.c -- What small and long runs cost: precision.h.
 *                                                                       [Chapter 18] */
#define _POSIX_C_SOURCE 200809L /* clock_gettime, posix_spawn, uname */
#include "precision.h"
#include "bench.h"

#include <fcntl.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ; /* POSIX asks for it so */

/* Seconds by the wall clock of `program run --steps 200`, its table thrown away. It is
 * spawned, as a shell would: fork would first copy the page tables of this process, which
 * holds much after minutes of other runs. 0 if it failed. */
static double process(const char *program)
{
    char *words[] = { (char *)program, "run", "--steps", "200", NULL };
    struct timespec t[2];
    posix_spawn_file_actions_t to;
    pid_t child;
    int status = posix_spawn_file_actions_init(&to);
    for (int file = STDOUT_FILENO; file <= STDERR_FILENO && !status; file++)
        status = posix_spawn_file_actions_addopen(&to, file, "/dev/null",
                                                  O_WRONLY, 0);
    clock_gettime(CLOCK_MONOTONIC, &t[0]);
    if (!status)
        status = posix_spawn(&child, program, &to, NULL, words, environ);
    if (!status && waitpid(child, &status, 0) != child)
        status = 1;
    clock_gettime(CLOCK_MONOTONIC, &t[1]);
    posix_spawn_file_actions_destroy(&to);
    return status ? 0
                  : (double)(t[1].tv_sec - t[0].tv_sec)
                        + 1e-9 * (double)(t[1].tv_nsec - t[0].tv_nsec);
}

/* Seconds of N uniform steps of `fvi` on the plate. */
static double steps(size_t N, int runs)
{
    const fvi_run run =
        problem_run(problem_number(0), N, FVI_MEMORY_EXPONENTIALS, 0);
    double best = 0;
    for (int i = 0; i < runs; i++) {
        const double start = now();
        fvi_stepper *s;
        if (fvi_start(&fvi_fractional, &run, &s))
            return 0;
        while (s->k < N && !fvi_step(s))
            ;
        fvi_stop(s);
        const double time = now() - start;
        best = best == 0 || time < best ? time : best;
    }
    return best;
}

void print_small(const char *program)
{
    double best = 0;
    for (int i = 0; i < 100; i++) {
        const double t = process(program);
        best = best == 0 || (t > 0 && t < best) ? t : best;
    }
    printf("# small and long runs of ours\n#> small\n# of what\tis\n"
           "ms, `fvi run` of 200 steps, the whole process, wall clock\t%.3g\n"
           "ms, 10^6 uniform steps of fvi, P1\t%.3g\n"
           "s, 10^8 uniform steps of fvi, P1\t%.3g\n#< small\n\n\n",
           1e3 * best, 1e3 * steps(1000000, 3), steps(100000000, 1));
}
