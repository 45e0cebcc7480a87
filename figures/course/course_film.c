/* figures/course/course_film.c -- Chapter 12: a second body, filmed and shown backwards, gives the derivatives of x
 * at the last node.
 *
 * - Block 0: t, the running body x, and the film y. The filmed body was held at 0 and starts with momentum 1; y
 *   is its motion shown backwards.
 * - Block 1: t, and how much x(20) changes per unit of a push at t, from two runs. */
#define main body_main
#pragma GCC diagnostic ignored "-Wreturn-type" /* main alone may end without a return */
#include "course/body_12.c"
#undef main

enum { LAST = 200, APART = 10 };

/* Return x at the last node if the force `push` acts up to half a step after the node k. */
static double last_place_when_pushed(int k)
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
        printf("%.17g %.17g\n", k * h, (last_place_when_pushed(k) - last_place_when_pushed(k - 1)) / h);
    return 0;
}
