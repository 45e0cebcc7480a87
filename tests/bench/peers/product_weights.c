/* tests/bench/peers/product_weights.c -- Compute the weights of J^gamma: product_weights.h. [H 18] */
#include "product_weights.h"

#include <math.h>

/* Compute n^e for n = 1, ..., N. If 2, 3, 5 or 7 divides n it is a product, so only one number in four needs a
 * power. */
static void powers_of(double e, size_t N, double *power)
{
    static const size_t prime[] = { 2, 3, 5, 7 };
    for (size_t n = 1; n <= N; n++) {
        size_t i = 0;
        while (i < 4 && (n % prime[i] || n == prime[i]))
            i++;
        power[n] = i < 4 ? power[prime[i]] * power[n / prime[i]]
                         : pow((double)n, e);
    }
}

/* Compute w_k = (k+1)^e - 2 k^e + (k-1)^e and start_k = (k-1)^e - k^gamma (k - e), e = gamma + 1, divided by
 * Gamma(gamma + 2); by their series in 1/k where digits would cancel. */
static void trapezoid(double gamma, size_t N, double *w, double *start0)
{
    const double e = gamma + 1, unit = 1 / tgamma(e + 1);
    double even[6] = { 0 }, all[12] = { 0 }, term = 1, before = 0, here = 1;
    for (int i = 1; i < 12; i++) {
        term *= (e - i + 1) / i;
        all[i] = i % 2 ? -term : term;
        if (i % 2 == 0)
            even[i / 2] = 2 * term;
    }
    w[0] = unit;
    for (size_t n = 1; n <= N; n++) {
        const double k = (double)n, z = 1 / k, zz = z * z;
        if (n < 32) {
            const double after = pow(k + 1, e);
            w[n] = unit * (after - 2 * here + before);
            start0[n] = unit * (before - here / k * (k - e));
            before = here;
            here = after;
            continue;
        }
        const double size = unit * pow(k, e) * zz;
        double sum = 0, tail = 0;
        for (int i = 5; i >= 1; i--)
            sum = sum * zz + even[i];
        for (int i = 11; i >= 2; i--)
            tail = tail * z + all[i];
        w[n] = size * sum;
        start0[n] = size * tail;
    }
}

/* Compute the power series of (a_0 + a_1 z + a_2 z^2)^gamma; w_0 = a_0^gamma. */
static void power_of_series(const double *a, double gamma, size_t N, double *w)
{
    w[0] = pow(a[0], gamma);
    for (size_t n = 1; n <= N; n++) {
        double sum = 0;
        for (size_t k = 1; k <= 2 && k <= n; k++)
            sum += (gamma * (double)k - (double)(n - k)) * a[k] * w[n - k];
        w[n] = sum / ((double)n * a[0]);
    }
}

static void multistep(rule which, double gamma, size_t N, double *w,
                      double *start0, double *start1)
{
    static const double bdf[] = { 1.5, -2, 0.5 }, difference[] = { 1, -1, 0 };
    if (which
        == TRAPEZOIDAL) { /* ((1 + z) / (2 (1 - z)))^gamma, by its own recursion */
        w[0] = pow(2, -gamma);
        for (size_t n = 1; n <= N; n++)
            w[n] = (2 * gamma * w[n - 1]
                    + (n > 1 ? (double)(n - 2) * w[n - 2] : 0))
                   / (double)n;
    } else {
        power_of_series(which == BDF2 ? bdf : difference, -gamma, N, w);
    }
    if (which == NEWTON_GREGORY) /* multiplied by 1 - gamma (1 - z) / 2 */
        for (size_t n = N; n >= 1; n--)
            w[n] = (1 - gamma / 2) * w[n] + gamma / 2 * w[n - 1];
    if (which == NEWTON_GREGORY)
        w[0] *= 1 - gamma / 2;
    /* exact for 1 and t: sum_{j=1}^{n} w_{n-j} and sum j w_{n-j} by running sums */
    double ones = 0, lines = 0;
    powers_of(gamma, N, start0);
    const double unit = 1 / tgamma(gamma + 1), slope = unit / (gamma + 1);
    for (size_t n = 1; n <= N; n++) {
        const double size = start0[n];
        ones += w[n - 1];
        lines += ones;
        start1[n] = slope * size * (double)n - lines;
        start0[n] = unit * size - ones - start1[n];
    }
}

void product_weights(rule which, double gamma, size_t N, double *w,
                     double *start0, double *start1)
{
    if (which == PRODUCT)
        trapezoid(gamma, N, w, start0);
    else
        multistep(which, gamma, N, w, start0, start1);
}
