/* figures/restricted_principle/restricted_principle.c -- H 3: a solution and its mirror image, varied by the same
 * bump, and the action of the varied curves.
 *
 * - Block 0: t, a solution x, its mirror image y, both with the same bump added, and y with the mirror image of
 *   the bump added.
 * - Block 1: the size eps of the bump, the change of the action if both curves get the bump, the change if only
 *   x gets it, and the predicted tangent of the latter. */
#include <fvi/paper/restricted_principle.h>

#include <stdio.h>
#include <stdlib.h>

enum { ORDER = 20, TERMS = ORDER * ORDER, ROWS = 200 };

static const double alpha = 0.3, T = 3, m = 1, rho = 0.5, c = 4;
static const double epsilon = 0.35; /* the size of the bump in block 0 */

/* xi, the bump t (T - t)^3 divided by its largest value, which is at T/4: its powers of t and their coefficients, and
 * the coefficients of the bump as seen from the other end. */
static const double degree[] = { 0, 1, 2, 3, 4 };
static double here[] = { 0, 27, -27, 9, -1 }, there[5];

static double at(const fvi_powers *f, double s)
{
    return fvi_powers_derivative(f, 0, s);
}

int main(void)
{
    double exponent[TERMS], coefficient[TERMS];
    const fvi_powers x = { TERMS, exponent, coefficient };
    const fvi_powers xi = { 5, degree, here };
    const fvi_powers none = { 0, NULL, NULL };
    const fvi_system system = { .d = 1,
                                .mass = &m,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&c) };
    double top = at(&xi, T / 4);
    for (size_t n = 0; n < 5; n++)
        here[n] /= top;
    if (fvi_damped_powers(alpha, c / m, rho / m, ORDER, exponent, coefficient)
        || fvi_powers_reflect(5, T, here, there))
        return EXIT_FAILURE;

    printf("# t  x  y  x + eps bump  y + eps bump  x + eps bump reversed\n"
           "# (x'' + %g x + %g D^%g x = 0, T = %g, eps = %g)\n",
           c / m, rho / m, 2 * alpha, T, epsilon);
    for (int i = 0; i <= ROWS; i++) {
        double t = T * i / ROWS, r = T * (ROWS - i) / ROWS;
        printf("%.17g %.17g %.17g %.17g %.17g %.17g\n", t, at(&x, t), at(&x, r),
               at(&x, t) + epsilon * at(&xi, t),
               at(&x, r) + epsilon * at(&xi, t),
               at(&x, r) + epsilon * at(&xi, r));
    }

    /* y is x read from the other end, so it has the same powers. A varied curve has the powers of x and of the bump. */
    double e2[TERMS + 5], cx[TERMS + 5], cy[TERMS + 5], S0, both, alone, slope;
    if (fvi_action(&system, alpha, T, &x, &x, &S0)
        || fvi_action_variation(&system, alpha, T, &x, &x, &xi, &none, &slope))
        return EXIT_FAILURE;
    for (size_t j = 0; j < TERMS; j++) {
        e2[j] = exponent[j];
        cx[j] = cy[j] = coefficient[j];
    }
    printf("\n\n# eps  S - S(0), both curves varied  x alone  its predicted "
           "tangent\n");
    for (int i = -10; i <= 10; i++) {
        double eps = i / 20.0;
        for (size_t n = 0; n < 5; n++) {
            e2[TERMS + n] = degree[n];
            cx[TERMS + n] = eps * here[n];
            cy[TERMS + n] = eps * there[n];
        }
        const fvi_powers xe = { TERMS + 5, e2, cx }, ye = { TERMS + 5, e2, cy };
        if (fvi_action(&system, alpha, T, &xe, &ye, &both)
            || fvi_action(&system, alpha, T, &xe, &x, &alone))
            return EXIT_FAILURE;
        printf("%.17g %.17g %.17g %.17g\n", eps, both - S0, alone - S0,
               slope * eps);
    }
    return EXIT_SUCCESS;
}
