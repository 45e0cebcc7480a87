"""H 4. The Grünwald-Letnikov weights alpha_n = (-1)^n binom(alpha, n).

Proved here, alpha symbolic:
  (4.2)  the printed product, the binomial and the recurrence are the same;
  (4.3)  the partial sums of order alpha are the weights of order alpha - 1;
  (4.4)  products of weight sequences add the orders (Vandermonde), k <= 10;
  (4.5)  the first two terms of the asymptotic series.
Printed: exact weights from the binomial (mpmath's gamma function at 60 and 90
digits, never from the recurrence), at alpha that are doubles."""
import mpmath
from sympy import (Rational, binomial, expand_func, factorial, gamma, gammasimp,
                   limit, oo, prod, simplify, symbols)

from shared.refgen import array, claim, header, hexd, hexd_real, prove, short, table

a, b = symbols("alpha beta")
n = symbols("n", integer=True, positive=True)


def weight(order, k):
    """Return alpha_k by its definition; k is a number, order may be a number or a symbol."""
    return (-1) ** k * expand_func(binomial(order, k))


def weight_symbolic(order):
    """Return alpha_n for a symbolic n, as a quotient of gamma functions."""
    return gamma(n - order) / (gamma(-order) * gamma(n + 1))


#> product
for k in range(1, 13):
    printed = -a * prod(j - a for j in range(1, k)) / factorial(k)
    prove(f"(4.1) the paper's product is (-1)^n binom(alpha, n), n = {k}",
          printed - weight(a, k))
#< product
for k in range(6):
    prove(f"the gamma form is the binomial, n = {k}",
          gammasimp(weight_symbolic(a).subs(n, k) - weight(a, k)) if k else
          gamma(-a) / gamma(-a) - 1)

#> recurrence
ratio = gammasimp(weight_symbolic(a) / weight_symbolic(a).subs(n, n - 1))
prove("(4.2) w_n = w_{n-1} (n - 1 - alpha) / n, n symbolic", ratio - (n - 1 - a) / n)
#< recurrence

#> sums
S = weight_symbolic(a - 1)  # the claim: S_N = w_N(alpha - 1)
prove("(4.3) S_0 = w_0", weight(a - 1, 0) - weight(a, 0))
prove("(4.3) S_n - S_{n-1} = w_n, n symbolic",
      gammasimp((S - S.subs(n, n - 1)) / weight_symbolic(a)) - 1)
#< sums

#> vandermonde
for k in range(11):
    total = sum(weight(a, j) * weight(b, k - j) for j in range(k + 1))
    prove(f"(4.4) sum_j alpha_j beta_(k-j) = (alpha + beta)_k, k = {k}",
          (total - weight(a + b, k)).expand())
#< vandermonde

#> asymptotics
# The ratio of successive terms of n^(-1-alpha) (1 + c/n) must agree with (4.2) up to O(n^-3). This determines c.
c = a * (1 + a) / 2
x = symbols("x", positive=True)  # 1/n
series = ((1 / x - 1 - a) * x - (1 - x) ** (1 + a) * (1 + c * x) / (1 + c * x / (1 - x)))
for power in range(3):
    prove(f"(4.5) agrees at order n^-{power}", series.series(x, 0, 3).removeO().coeff(x, power))
mpmath.mp.dps = 40
for order in ("0.1", "0.5", "0.9", "1.5"):
    o = mpmath.mpf(order)
    for k in (10**3, 10**5):
        exact = (-1) ** k * mpmath.binomial(o, k)
        two_terms = mpmath.mpf(k) ** (-1 - o) * mpmath.rgamma(-o) * (1 + o * (1 + o) / (2 * k))
        claim(f"(4.5) constant 1/Gamma(-alpha), alpha = {order}, n = {k}",
              abs(two_terms / exact - 1) < 10 / mpmath.mpf(k) ** 2)
#< asymptotics

ULP = 2.0 ** -53
ORDERS = [0.1, 0.25, 1 / 3, 0.5, 0.5 - ULP, 0.5 + 2 * ULP, 0.6, 0.75, 0.9,
          1 - 2.0 ** -30, 1 - ULP, 1e-8, 1e-300, 1.2, 1.5, 1.8, 1 + 2.0 ** -30,
          1 + 2 * ULP, 2 - 2.0 ** -30]
INDICES = [1, 2, 3, 4, 7, 10, 33, 100, 999, 1000, 10007, 65536, 100000, 524287, 999999, 1000000]


#> reference
def exact(order, k):
    def value(digits):
        # binomial computes Gamma(1 + order), so a tiny order needs more digits
        mpmath.mp.dps = digits + 20 + (340 if order < 1e-20 else 0)
        return mpmath.nstr((-1) ** k * mpmath.binomial(mpmath.mpf(order), k), digits)
    return hexd_real(value)
#< reference


rows = []
for order in ORDERS:
    for k in INDICES:
        rows.append([hexd(order), k, exact(order, k), f"alpha = {order!r}"])
header("verify/coefficients/coefficients.py")
table("ref_weights", "double alpha; size_t n; double want;", rows)

# Subnormal alpha: the weights are exact multiples of alpha to within 1 ulp.
tiny = [[hexd(2.0 ** -1060), k, exact(2.0 ** -1060, k)] for k in (1, 2, 3, 10, 100, 1000)]
table("ref_tiny", "double alpha; size_t n; double want;", tiny)

# alpha = 1/2: dyadic, so exact doubles for small n.
array("ref_half", [weight(Rational(1, 2), k) for k in range(31)],
      "alpha = 1/2, n = 0, ..., 30: exact")

# Partial sums for alpha = 0.1, from (4.3), at n = 10^5.
table("ref_sums", "double alpha; size_t n; double want;",
      [[hexd(o), 100000, exact(o - 1, 100000)] for o in (0.25, 0.5, 0.75)])

# Far out: n = 10^7 for the test, n = 10^8 for `make stress`.
table("ref_far", "double alpha; size_t n; double want;",
      [[hexd(o), k, exact(o, k)] for o in (0.1, 0.6, 1 - 2.0 ** -30, 1.2, 1.8)
       for k in (10**7, 10**8)])
