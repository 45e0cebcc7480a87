/* tests/bench/precision_small.c -- Time small and long runs: precision.h. [H 18] */
#define _POSIX_C_SOURCE 200809L /* clock_gettime, posix_spawn, uname */
#include "precision.h"
#include "bench.h"
#include "system/larger.h"

#include <fcntl.h>
#include <gsl/gsl_math.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ; /* POSIX requires this declaration */

/* Return the seconds of `program run --steps 200` by the wall clock, with its table thrown away; 0 if it
 * failed. The process is spawned, as a shell does it. fork would first copy the page tables of this process,
 * which are large after minutes of other runs. */
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

/* Return the seconds of N uniform steps of `fvi` on the plate; 0 if they failed. */
static double steps(size_t N)
{
    const fvi_run run =
        problem_run(problem_number(0), N, FVI_HISTORY_MODES, 0);
    const double start = now();
    fvi_stepper *s;
    if (fvi_stepper_start(&fvi_fractional, &run, &s, NULL))
        return 0;
    while (s->k < N && !fvi_stepper_step(s))
        ;
    const int whole = s->k == N;
    fvi_stepper_free(s);
    return whole ? now() - start : 0;
}

static double once(int what, const char *program)
{
    return what == 0   ? process(program)
           : what == 1 ? steps(1000000)
                       : steps(100000000);
}

void time_small(const char *program, small_times *s)
{
    static const int runs[SMALL] = { 100, 5, 1 };
    for (int what = 0; what < SMALL; what++) {
        double best = GSL_POSINF;
        for (int i = 0; i < runs[what]; i++) {
            const double t = once(what, program);
            best = t > 0 ? smaller(best, t) : best;
        }
        s->least[what] = s->turns ? smaller(s->least[what], best) : best;
        s->most[what] = s->turns ? larger(s->most[what], best) : best;
    }
    s->turns++;
}

void print_small(const small_times *s)
{
    static const char *const of[SMALL] = {
        "ms, `fvi run` of 200 steps, the whole process, wall clock",
        "ms, 10^6 uniform steps of fvi, P1", "s, 10^8 uniform steps of fvi, P1"
    };
    static const double unit[SMALL] = { 1e3, 1e3, 1 };
    printf("# small and long runs of ours, a turn after every third problem\n"
           "#> small\n# of what\tbest of %d\tslowest\n",
           s->turns);
    for (int what = 0; what < SMALL; what++)
        printf("%s\t%.3g\t%.3g\n", of[what], unit[what] * s->least[what],
               unit[what] * s->most[what]);
    printf("#< small\n\n\n");
}
