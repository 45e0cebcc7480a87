/* figures/course/course_film.c -- Chapter 12: the film of a second body gives the derivatives of the last place.
 *
 * Prints t, the running body x, and the film y of a body that was held at 0 and starts with
 * the momentum 1; and, as a second block, t and how much x at the last node grows per unit
 * of a push at t, from two runs. */
#define main body_main
#pragma GCC diagnostic ignored "-Wreturn-type" /* main alone may end without a return */
#include "course/body_12.c"
#undef main

enum { LAST = 200, APART = 10 };

/* The last place, with a force up to just behind the node k. */
static double pushed(int k)
{
    until = (k + 0.5) * h;
    run(LAST);
    return x[LAST];
}

int main(void)
{
    static double body[LAST + 1];
    run(LAST);
    for (int k = 0; k <= LAST; k++)
        body[k] = x[k];
    x0 = 0, p0 = 1;
    run(LAST);
    printf("# t, x, y\n");
    for (int k = 0; k <= LAST; k++)
        printf("%.17g %.17g %.17g\n", k * h, body[k], x[LAST - k]);
    x0 = 1, p0 = 0, push = 1;
    printf("\n\n# t, change of x(20) per unit of a push at t\n");
    for (int k = APART; k < LAST; k += APART)
        printf("%.17g %.17g\n", k * h, (pushed(k) - pushed(k - 1)) / h);
    return 0;
}
