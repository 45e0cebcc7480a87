"""H 15. Existence, uniqueness, and the rate of Picard's iteration.

Proved here, with alpha (gamma = 2 - 2 alpha), K, R and exponents symbolic:
  (15.2)  two histories with the same (x, v), and the difference of their derivatives;
  the paper's bound with Gamma(1 - beta) is false, the bound with Gamma(2 - beta) is sharp;
  (15.3)  the impulse of the memory is a fractional integral of v, on powers;
  (15.5)  its norm; (15.7) its norm with a weight; (15.8) the n-th power;
  (15.9)  Picard's iterates of the linear problem are the partial sums of a series,
          and the series solves the equation (sums up to n = 6);
  (15.10) the weights are integrals of hat functions; they integrate 1 and t;
  (15.12) the limit alpha -> 1.
Printed: fractional integrals of piecewise linear functions and one Picard step from the integrals (mpmath, two
precisions), e_n as a sum of gamma functions, iterates and solutions from the series."""
import random
from functools import cache
from math import comb

import mpmath
from sympy import (Rational, binomial, diff, exp, expand, gamma, gammasimp, integrate, limit,
                   oo, pi, sqrt, symbols)
from sympy.ntheory.multinomial import multinomial_coefficients

from shared.refgen import claim, header, hexd, hexd_real, prove, table

b, c, g, lam, R, Kx, Kv, s, t = symbols("beta c gamma lambda R K_x K_v s t", positive=True)
p, q = symbols("p q", positive=True)


def factor(order, e):
    """Return the factor in D^order t^e = factor t^(e - order). A negative order is an integral."""
    return gamma(e + 1) / gamma(e + 1 - order)


#> history
one = t
other = t + c * t ** 2 * (1 - t) ** 2  # the same start, and the same x and v at t = 1
for order in (0, 1):
    prove("(15.2) the same x and v at 0 and 1",
          *[diff(other - one, t, order).subs(t, when) for when in (0, 1)])
bump = {2: 1, 3: -2, 4: 1}  # t^2 (1 - t)^2
prove("(15.2) another derivative at t = 1",
      gammasimp(sum(k * factor(b, e) for e, k in bump.items())
                + 2 * b * (1 - b) / gamma(5 - b)))
prove("(15.2) beta = 1/2", (2 * b * (1 - b) / gamma(5 - b)).subs(b, Rational(1, 2))
      - 8 / (105 * sqrt(pi)))
#< history

#> printed
# x = t, v = 1 on [0, d]: D^beta x = d^(1 - beta) / Gamma(2 - beta).
d = symbols("d", positive=True)
true_bound = d ** (1 - b) / gamma(2 - b)
printed_bound = d ** (1 - b) / gamma(1 - b)
prove("the bound with Gamma(2 - beta) is attained", factor(b, 1) * d ** (1 - b) - true_bound)
prove("the printed one is too small by the factor 1 - beta",
      gammasimp(printed_bound / true_bound) - (1 - b))
#< printed

#> impulse
# On x - x0 = t^p, v = p t^(p - 1): int_0^t D^beta t^p = I^(2 - beta) v, b in (0, 2).
prove("(15.3) the impulse", gammasimp(
    factor(b, p) * t ** (p - b + 1) / (p - b + 1)
    - p * factor(b - 2, p - 1) * t ** (p - 1 + 2 - b)))
#< impulse

#> norms
prove("(15.5) I^gamma 1 at t = d", factor(-g, 0) - 1 / gamma(1 + g))
prove("(15.7) e^(-lambda t) I^gamma e^(lambda t) <= lambda^-gamma",
      integrate(s ** (g - 1) * exp(-lam * s), (s, 0, oo)) / gamma(g) - lam ** -g)
prove("(15.8) I^p of t^q / Gamma(1 + q) is t^(p + q) / Gamma(1 + p + q)",
      gammasimp(factor(-p, q) / gamma(1 + q) - 1 / gamma(1 + p + q)))
#< norms

#> neumann
# By (15.5), the functions 1, I 1, I^2 1, I^gamma 1, ... are t^e / Gamma(1 + e). A function is written as {(n, k): c},
# the sum of c I^(n + gamma k) 1, so an integral shifts the keys.
def integral(v, n, k, coefficient):
    return {(e[0] + n, e[1] + k): coefficient * c for e, c in v.items()}


def plus(*parts):
    total = {}
    for part in parts:
        for e, c in part.items():
            total[e] = expand(total.get(e, 0) + c)
    return {e: c for e, c in total.items() if c != 0}


def A(v, Kx, Kv, R):
    return plus(integral(v, 2, 0, Kx), integral(v, 1, 0, Kv), integral(v, 0, 1, R))


power_of_A = {(0, 0): 1}
for n in range(1, 6):
    power_of_A = A(power_of_A, Kx, Kv, R)
    claim(f"(15.8) A^{n} 1 is the multinomial sum", power_of_A == plus(*[
        {(2 * i + j, k): m * Kx ** i * Kv ** j * R ** k}
        for (i, j, k), m in multinomial_coefficients(3, n).items()]))
#< neumann

W, x0, v0 = symbols("W x_0 v_0")


def series(n, W, R, x0, v0):
    """Return the partial sum of (15.9): the terms with i + k < n, and those of the terms with i + k = n that contain
    v0."""
    def term(i, k):
        return binomial(i + k, i) * (-W) ** i * (-R) ** k
    pairs = [(i, m - i) for m in range(n + 1) for i in range(m + 1)]
    return plus(*[{(2 * i, k): v0 * term(i, k)} for i, k in pairs],
                *[{(2 * i + 1, k): -W * x0 * term(i, k)} for i, k in pairs if i + k < n])


#> picard
# f = -W x. T v = v0 - W I (x0 + I v) - R I^gamma v; the iteration starts with v = v0.
def T(v, W, R, x0, v0):
    return plus({(0, 0): v0, (1, 0): -W * x0}, integral(v, 2, 0, -W), integral(v, 0, 1, -R))


v = {(0, 0): v0}  # {(n, k): c} is the sum of c t^e / Gamma(1 + e), e = n + gamma k
for n in range(1, 7):
    v = T(v, W, R, x0, v0)
    claim(f"(15.9) iterate {n} is a partial sum", v == series(n, W, R, x0, v0))
#< picard

#> hats
# (15.10): the integral of a hat of width 2 around s = n times s^(gamma - 1). F'' is this kernel.
F = s ** (g + 1) / (g * (g + 1))
prove("(15.10) F'' is the kernel", diff(F, s, 2) - s ** (g - 1))
prove("(15.10) Gamma(gamma) gamma (gamma + 1)",
      gammasimp(gamma(g) * g * (g + 1) - gamma(g + 2)))
for order in (1, 2, 3):  # two integrations by parts give a second difference; checked for integer orders
    for n in (1, 2, 5):
        hat = (integrate(s ** (order - 1) * (s - n + 1), (s, n - 1, n))
               + integrate(s ** (order - 1) * (n + 1 - s), (s, n, n + 1)))
        prove("(15.10) second difference", hat - sum(
            m * F.subs({g: order, s: n + j}) for j, m in ((-1, 1), (0, -2), (1, 1))))


def weight(gamma_, k, j):
    """Return the weight of v_j in out_k, without h^gamma / Gamma(2 + gamma)."""
    if j == k:
        return 1
    if j == 0:
        return (k - 1) ** (gamma_ + 1) - (k - 1 - gamma_) * k ** gamma_
    return (k - j + 1) ** (gamma_ + 1) - 2 * (k - j) ** (gamma_ + 1) + (k - j - 1) ** (gamma_ + 1)


for k in range(1, 7):
    prove("(15.10) integrates 1", sum(weight(g, k, j) for j in range(k + 1)) - (g + 1) * k ** g)
    prove("(15.10) integrates t", sum(j * weight(g, k, j) for j in range(k + 1)) - k ** (g + 1))
#< hats

#> limit
# gamma -> 0: the term k of E_gamma(-R t^gamma) becomes (-R)^k.
k = symbols("k", integer=True, positive=True)
prove("(15.12) term by term", limit((t ** g) ** k / gamma(1 + g * k), g, 0) - 1)
prove("(15.12) its Laplace transform, R any positive number",
      limit(1 / (s * (1 + R * s ** -g)), g, 0) - 1 / (s * (1 + R)))
#< limit

# ---- exact values -----------------------------------------------------------

dice = random.Random(1890)
mp = mpmath.mpf


def two_precisions(value):
    def text(digits):
        mpmath.mp.dps = digits + 40
        return mpmath.nstr(value(), digits)
    return hexd_real(text, 30)


def integral_on_grid(order, h, v, k):
    """Return I^order at t_k of the polygon through v, from the antiderivatives."""
    order, h = mp(order), mp(h)
    return h ** order / mpmath.gamma(2 + order) * mpmath.fsum(
        weight(order, mp(k), mp(j)) * v[j] for j in range(k + 1)) if k else mp(0)


def numbers(values):
    return "{ " + ", ".join(values) + " }"


STEPS = 6
rows = []
for order in (0.25, 0.5, 1.0, 1.5, 2.0, *[dice.uniform(0, 2) for _ in range(7)]):
    h, v = dice.uniform(0.01, 1), [dice.uniform(-1, 1) for _ in range(STEPS + 1)]
    rows.append([hexd(order), hexd(h), numbers(map(hexd, v)), numbers(
        two_precisions(lambda: integral_on_grid(order, h, list(map(mp, v)), k)) if k else "0"
        for k in range(STEPS + 1))])
header("verify/existence/existence.py")
table("ref_integrals", f"double gamma, h, v[{STEPS + 1}], want[{STEPS + 1}];", rows)


@cache
def picard_step(order, h, damping, start, v, digits):
    """Return x and T v for f(x, v) = -2 x - v / 2 and all k. The result is cached for each number of digits."""
    alpha, h, start, v = mp(order), mp(h), list(map(mp, start)), list(map(mp, v))
    x = [start[0] + integral_on_grid(1, h, v, k) for k in range(STEPS + 1)]
    f = [-2 * x[k] - v[k] / 2 for k in range(STEPS + 1)]
    return x, [start[1] + integral_on_grid(1, h, f, k)
               - mp(damping) * integral_on_grid(2 - 2 * alpha, h, v, k) for k in range(STEPS + 1)]


rows = []
for order in (0.0, 0.25, 0.5, 0.75, 0.9375):
    h, damping = dice.uniform(0.1, 1), dice.uniform(0, 3)
    start = tuple(dice.uniform(-1, 1) for _ in range(2))
    v = tuple(dice.uniform(-1, 1) for _ in range(STEPS + 1))
    both = [numbers(two_precisions(lambda: picard_step(order, h, damping, start, v, mpmath.mp.dps)
                                   [i][k]) for k in range(STEPS + 1)) for i in (0, 1)]
    rows.append([*map(hexd, (order, h, damping, *start)), numbers(map(hexd, v)), *both])
n = STEPS + 1
table("ref_steps", f"double alpha, h, R, x0, v0, v[{n}], x[{n}], next[{n}];", rows)


def norm_of_power(alpha, R, Kx, Kv, d, n):
    alpha, R, Kx, Kv, d = map(mp, (alpha, R, Kx, Kv, d))
    total = mp(0)
    for (i, j, k), m in multinomial_coefficients(3, n).items():
        e = 2 * i + j + (2 - 2 * alpha) * k
        total += m * Kx ** i * Kv ** j * R ** k * d ** e / mpmath.gamma(1 + e)
    return total


rows = []
for alpha in (0.0, 0.25, 0.5, 0.8, dice.uniform(0, 1)):
    R, Kx, Kv, d = (dice.uniform(0, 3) for _ in range(4))
    for n, kx, kv, r in ((0, Kx, Kv, R), (1, Kx, Kv, R), (7, Kx, Kv, R), (30, Kx, Kv, R),
                         (12, Kx, 0.0, R), (12, 0.0, 0.0, R), (3, Kx, Kv, 0.0)):
        rows.append([*map(hexd, (alpha, r, kx, kv, d)), n,
                     two_precisions(lambda: norm_of_power(alpha, r, kx, kv, d, n))])
table("ref_bounds", "double alpha, R, Kx, Kv, d; size_t n; double want;", rows)


def value(v, gamma_, t):
    return mpmath.fsum(c * t ** (n + gamma_ * k) / mpmath.gamma(1 + n + gamma_ * k)
                       for (n, k), c in v.items())


@cache
def rgamma(e, digits):
    return mpmath.rgamma(1 + e)


@cache
def iterate(n, alpha, W, R, x0, v0, digits):
    """Return position and velocity of the exact n-th iterate at t = 1. Its x is x0 + I v."""
    alpha, W, R, x0, v0 = map(mp, (alpha, W, R, x0, v0))
    terms = []
    for total in range(n + 1):
        for i in range(total + 1):
            k = total - i
            c = comb(total, i) * (-W) ** i * (-R) ** k
            terms.append(((2 * i, k), v0 * c))
            if total < n:
                terms.append(((2 * i + 1, k), -W * x0 * c))
    gamma_ = 2 - 2 * alpha
    sizes = [(m + gamma_ * k, c) for (m, k), c in terms if c]
    return (x0 + mpmath.fsum(c * rgamma(e + 1, digits) for e, c in sizes),
            mpmath.fsum(c * rgamma(e, digits) for e, c in sizes))


# Iterates 1, 2, 4 and the solution (n large) at t = 1; W = 0: Mittag-Leffler.
rows = []
for alpha, W, R, x0, v0 in ((0.5, 0, 1, 0, 1), (0.25, 0, 1, 0, 1), (0.75, 0, 1, 0, 1),
                            (0.25, 1, 0.5, 1, 0.5), (0.5, 1, 0.5, 1, 0.5),
                            (0.75, 1, 0.5, 1, 0.5), (0.0, 1, 0.5, 1, 0.5)):
    for n in (1, 2, 4, 60):
        both = [two_precisions(lambda: iterate(n, alpha, W, R, x0, v0, mpmath.mp.dps)[i]) for i in (0, 1)]
        rows.append([hexd(alpha), W, hexd(R), x0, hexd(v0), n, *both,
                     "the solution" if n == 60 else ""])
table("ref_iterates", "double alpha, W, R, x0, v0; size_t n; double x, v;", rows)
