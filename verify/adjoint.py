"""Chapter 23. The discrete adjoint of a fractional variational integrator.

Proved here:
  (23.9)  the derivatives of the weights by their order: the recurrence, for symbolic
          order, and the generating function ln(1 - z) (1 - z)^beta, n <= 12;
  (23.11) the derivative of the density of (12.5) by nu.
Compared: (23.11) itself, in 40-digit arithmetic: the sum over the nodes of (12.7).
Printed: the rates of the weights, from the definition: the product, differentiated."""
import mpmath
from mpmath import mp
from sympy import (Rational, binomial, diff, exp, expand, expand_func, log, pi, series,
                   simplify, sin, cos, symbols)

from refgen import claim, header, hexd, hexd_real, prove, short, table

b, z, s, nu = symbols("beta z s nu", positive=True)

# ---- the rates of the weights ----


def weight(n):
    """w_n(beta) as a polynomial in beta, by its definition."""
    return expand((-1) ** n * expand_func(binomial(b, n)))


#> rates
w = [weight(n) for n in range(13)]
rate = [diff(v, b) for v in w]
for n in range(1, 13):
    prove(f"(23.9) the recurrence, n = {n}",
          expand(rate[n] - rate[n - 1] * (n - 1 - b) / n + w[n - 1] / n))
    prove(f"(23.9) rate_n = - sum_j w_(n-j) / j, n = {n}",
          expand(rate[n] + sum(w[n - j] / j for j in range(1, n + 1))))
prove("(23.9) ln(1-z) = - sum z^j / j",
      series(log(1 - z), z, 0, 9).removeO() + sum(z**j / Rational(j) for j in range(1, 9)))
#< rates

#> density
density = -sin(pi * nu) / pi * (exp(s) - 1) ** nu
prove("(23.11) its derivative by nu",
      simplify((diff(density, nu) + (exp(s) - 1) ** nu
                * (cos(pi * nu) + sin(pi * nu) / pi * log(exp(s) - 1))).rewrite(exp)))
#< density


def exact_rate(beta, n):
    """d w_n / d beta: the product (j - beta) / (j + 1), differentiated, exactly."""
    beta, value, slope = Rational(beta), Rational(1), Rational(0)
    for j in range(n):
        value, slope = value * (j - beta) / (j + 1), (slope * (j - beta) - value) / (j + 1)
    return slope


def far_rate(beta, n):
    """The same by the digamma function: w_n (psi(-beta) - psi(n - beta))."""
    def at(digits):
        with mp.workdps(digits):
            x = mpmath.mpf(Rational(beta).p) / Rational(beta).q
            value = (mpmath.gammaprod([n - x], [-x, n + 1])
                     * (mpmath.digamma(-x) - mpmath.digamma(n - x)))
            return mpmath.nstr(value, digits - 15, min_fixed=0, max_fixed=0)
    return at


orders = [0.0, 1e-3, 0.3, 0.5, 0.9, 1.0, 1.25, 1.7, 2.0]
rates = []
for beta in orders:
    for n in [0, 1, 2, 3, 7, 20, 32, 33, 100, 500]:
        value = exact_rate(beta, n)
        rates.append([repr(beta), n, hexd(value), short(value)])
    for n in [10**4, 10**6] if beta % 1 else []:
        rates.append([repr(beta), n, hexd_real(far_rate(beta, n), 60)])
claim("the two definitions agree",
      abs(float(far_rate(0.3, 100)(60)) - float(exact_rate(0.3, 100))) < 1e-15)

header("verify/adjoint.py")
print("\n/* beta, n, d w_n / d beta; the exact rational where it is short */")
table("ref_rates", "double beta; size_t n; double want;", rates)
