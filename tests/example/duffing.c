/* tests/example/duffing.c -- The example of README.md, from C. */
#include <fvi/fvi.h>

#include <stdio.h>

//> example
/* Duffing's oscillator with fractional damping, let go at 1 with momentum 1/2. */
int main(void)
{
    const double one = 1, spring[] = { 1, 0.5 }, rho = 0.4, p0 = 0.5;
    const fvi_problem problem = {
        .system = { .d = 1,
                    .mass = &one,
                    .damping = &rho,
                    .potential = fvi_potential_duffing(spring) },
        .x0 = &one,
        .p0 = &p0,
        .T = 20,
        .alpha = 0.3 /* the body is at rest until t = 0 */
    };
    const fvi_solve_options steps = { .method = &fvi_lobatto_m3, .h = 0.1 };
    double x[201];
    const fvi_outputs rows = { .rows = 201, .x = x };
    fvi_error error;
    const int status = fvi_solve(&problem, &steps, NULL, &rows, NULL, &error);
    if (status)
        fprintf(stderr, "%s\n", error.text);
    for (size_t k = 0; status == 0 && k <= 200; k++)
        printf("%.17g\t%.17g\n", (double)k * 0.1, x[k]);
    return status;
}
//< example
