/* figures/course/course_pasts.c -- Chapter 7: three pasts, and the past for which no motion exists.
 *
 * alpha = 3/4, and the momentum at the start is 1/2.
 * - Blocks 0 to 2: t and x before and after t = 0, of a body that was held at x0, of a body that came along a
 *   straight line (Caputo), and of a body that stood at 0 and is suddenly at x0 (Riemann-Liouville).
 * - Blocks 3 to 6: the past of block 2 again, with the steps 0.2, 0.05, 0.0125 and 0.003125. The runs do not
 *   converge. */
#define main body_main
#pragma GCC diagnostic ignored "-Wreturn-type" /* main alone may end without a return */
#include "course/body_07.c"
#undef main

int main(void)
{
    const char *name[] = { "held", "Caputo", "Riemann-Liouville" };
    p0 = 0.5, alpha = 0.75, h = 0.05;
    for (past = HELD; past <= RL; past++) {
        printf("%s# t, x: %s\n", past ? "\n\n" : "", name[past]);
        printf("-2 %.17g\n0 %.17g\n", past == HELD ? x0 : past == CAPUTO ? x0 - 2 * p0 / m : 0, past == RL ? 0 : x0);
        run(120);
        for (int k = 0; k <= 120; k += 2)
            printf("%.17g %.17g\n", k * h, x[k]);
    }
    past = RL;
    for (h = 0.2; h > 0.003; h /= 4) {
        int N = (int)(3 / h + 0.5);
        printf("\n\n# t, x: from zero, h = %g\n", h);
        run(N);
        for (int k = 0; k <= N; k += N > 100 ? N / 60 : 1)
            printf("%.17g %.17g\n", k * h, x[k]);
        printf("%.17g %.17g \"h = %g\"\n", N * h, x[N], h);
    }
    return 0;
}
