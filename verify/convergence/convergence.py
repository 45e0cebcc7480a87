"""H 20: convergence of the FVI. Prints tests/convergence/convergence_ref.h.

  (20.1)  sums of (9.4) over five steps of a symbolic path: no negative power of h occurs;
  (20.3)  quotients of Gamma at random n and gamma, with 40 digits;
  (20.4)  the total of the kernel's excess in closed form, by induction;
  (20.6)  the totals of the damped weights;
  (20.9)  its constants at points of the strip;
  (20.5), (20.6), (20.8)  the constants of some motions, with 40 digits.

The inequality (20.3) for all n and gamma is proved by hand, by the convexity of log Gamma. Here it is checked at
random n and gamma."""
import cmath
import random
from functools import cache

import mpmath
from mpmath import mp, mpf
from sympy import Rational, exp, expand, gamma, gammasimp, log, prod, series, simplify, sinh, symbols

from shared.refgen import claim, header, hexd, hexd_real, prove, table

a, g, h, rho, p0, z, lam = symbols("alpha gamma h rho p0 z lambda", positive=True)
k = symbols("k", integer=True, positive=True)


#> velocity
def w(beta, n):
    """Return the coefficient of z^n of (1 - z)^beta, a polynomial in beta."""
    return prod([(Rational(i) - 1 - beta) / i for i in range(1, n + 1)])


N = 5
d = symbols("d1:7")                     # z_k = h sum of ubar_j, and z_0 = 0
ubar = (0, *(di / h for di in d))
Z = [sum(d[:j]) for j in range(N + 1)]
G, F = symbols("G0:6"), symbols("F0:7")  # grad U at S_j, and F at t_j

for steps in range(N + 1):
    # (9.4), step by step. D_k is the discrete derivative of order 2 alpha without h^(-2 alpha).
    p = p0
    for j in range(steps):
        D = sum(w(2 * a, n) * Z[j + 1 - n] for n in range(j + 2))
        p += -h * G[j] - rho * h * h ** (-2 * a) * D + h * F[j + 1]
    # (20.2)
    b = [w(2 * a - 2, n) for n in range(steps + 1)]
    want = (p0 + h * sum(F[1:steps + 1]) - h * sum(G[:steps])
            - rho * h * h * h ** (-2 * a)
            * sum(b[steps - j] * ubar[j] for j in range(1, steps + 1)))
    prove(f"(20.2) after {steps} steps", expand(expand(p - want) * h ** (2 * a)))
#< velocity

for n in range(6):                      # S_j depends on the errors 1, ..., j + 1
    e = symbols("e1:8")
    prove("(20.7) the double sum is a convolution with (1 - z)^-2",
          sum(sum(e[:j + 1]) for j in range(n))
          - sum((n - i + 1) * e[i - 1] for i in range(1, n + 1)))

#> kernel
c = gamma(k + g) / gamma(k)             # Gamma(gamma + 1) h^-gamma K_h, k steps back
total = c * (k + g) / (g + 1)           # of c_1 + ... + c_k
prove("(20.4) the sum of the c_n: its first term",
      gammasimp((total - c).subs(k, 1)))
prove("(20.4) the sum of the c_n: from k to k + 1",
      gammasimp((total.subs(k, k + 1) - total - c.subs(k, k + 1)) / c))
prove("(20.4) the trapezoids",
      gammasimp((total - c / 2 - c * (k + (g - 1) / 2) / (g + 1)) / c))
for n in range(8):                      # c_n is a sum of the b_j = w_j(-gamma)
    prove("(20.3) the sum of the b_n",
          gammasimp(sum(w(-g, i) for i in range(n + 1))
                    - (c / gamma(g + 1)).subs(k, n + 1)))
#< kernel

for value in (Rational(1, 3), Rational(1), Rational(7, 4)):
    s = series((1 - z) ** -value, z, 0, 7).removeO()
    prove("(20.6) b_n are the coefficients of (1 - z)^-gamma",
          *(s.coeff(z, n) - w(-value, n) for n in range(7)))
prove("(20.6) gamma = 2, a step late",
      (h**2 * exp(-lam * h) / (1 - exp(-lam * h)) ** 2
       - (h / (2 * sinh(lam * h / 2))) ** 2).rewrite(exp))

mp.dps = 40
random.seed(20)


@cache
def quotient(n, order):
    """Return c_n = Gamma(n + gamma) / Gamma(n)."""
    return mpmath.gammaprod([n + mpf(order)], [n]) if n < 10**6 else \
        mpmath.exp(mpmath.loggamma(n + mpf(order)) - mpmath.loggamma(n))


@cache
def excess(n, order):
    """Return c_n (n + (gamma - 1)/2) - n^(gamma + 1), which is (20.4) without its powers of h."""
    order = mpf(order)
    return quotient(n, order) * (n + (order - 1) / 2) - mpf(n) ** (order + 1)


for _ in range(4000):
    n, order = int(10 ** random.uniform(0, 5)), mpf(random.uniform(0, 2))
    c_n, power = quotient(n, order), mpf(n) ** order
    if order <= 1:
        claim("(20.3) below 1", power * (1 - order * (1 - order) / n) <= c_n <= power)
    else:
        claim("(20.3) above 1", power <= c_n <= power * (1 + (order - 1) / n))
    claim("(20.4) the excess has the sign of gamma - 1",
          excess(n, order) * (order - 1) >= 0)
    claim("(20.4) the bound", abs(excess(n, order)) <= 2 * abs(order - 1) * power)
    step = mpf(10 ** random.uniform(-6, 3))
    total_ = mpmath.exp(-step) * (1 / -mpmath.expm1(-step)) ** order
    claim("(20.6) the total of the damped weights, lambda = 1",
          total_ * step**order <= 1)


def constants(alpha, kappa_, T, r, l, G_, var, start, V, A, room):
    """Return C, lambda and the largest step (0: any step) from the formulas of the chapter. room = 0 stands for
    infinity."""
    alpha, kappa_, T, r, l, G_, var, start, V, A = map(
        mpf, (alpha, kappa_, T, r, l, G_, var, start, V, A))
    order = 2 - 2 * alpha
    missed = 2 * A * T**order / mpmath.gamma(order + 2)
    if alpha < 0.5:
        missed += start * T ** (order - 1) / mpmath.gamma(order + 1)
    C = r * abs(1 - 2 * alpha) * missed + var + l * V * T / 2 + A / 2 + kappa_ * G_
    rate = max(mpmath.sqrt(4 * l), (4 * r) ** (1 / order))
    growth = (mpmath.exp(rate * T) - 1) / rate if rate else T
    steps = [mpf(room) / (2 * C * growth)] if room else []
    if 0 < kappa_ < 1 and l:
        steps.append(1 / mpmath.sqrt(kappa_ * (1 - kappa_) * l))
    return C, rate, min(steps) if steps else mpf(0)


def position_constants(alpha, kappa_, T, r, l, G_, var, start, V, W, room):
    """Return D, lambda and the largest step (0: any step) of (20.14). room = 0 stands for infinity."""
    alpha, kappa_, T, r, l, G_, var, start, V, W = map(
        mpf, (alpha, kappa_, T, r, l, G_, var, start, V, W))
    order = 2 - 2 * alpha
    D = (T * (var + l * V * T / 2 + kappa_ * G_) + W
         + r * abs(1 - 2 * alpha) * T**order / mpmath.gamma(order + 1) * (start + mpf(17) / 8 * W))
    rate = max(mpmath.sqrt(4 * l), (4 * r) ** (1 / order))
    steps = [mpf(room) / (2 * D * mpmath.exp(rate * T))] if room else []
    if 0 < kappa_ < 1 and l:
        steps.append(1 / mpmath.sqrt(kappa_ * (1 - kappa_) * l))
    return D, rate, min(steps) if steps else mpf(0)


#> variation
def missed(n, theta, order):
    """Return Gamma(gamma + 1) h^-gamma |K_h - K|, n + theta steps back. K_h is a straight line between nodes."""
    left, right = (quotient(j, order) if j else mpf(0) for j in (n, n + 1))
    return abs((1 - theta) * left + theta * right - (n + mpf(theta)) ** mpf(order))


for _ in range(300):                    # (20.13), at offsets theta of all magnitudes
    order, theta, steps_ = mpf(random.uniform(0, 2)), 10 ** random.uniform(-4, 0), random.randint(1, 60)
    total_ = sum(missed(n, theta, order) for n in range(steps_) if n + theta <= steps_ - 1)
    claim("(20.13) between nodes", total_ <= mpf(17) / 8 * abs(1 - order) * mpf(steps_) ** order)
    total_ = sum(missed(n, 0, order) for n in range(steps_))
    claim("(20.13) at nodes", total_ <= abs(1 - order) * mpf(steps_) ** order)
    claim("(20.15) each of them, below 1",
          order > 1 or max(missed(n, theta, order) for n in range(steps_)) <= 2 * (1 - order))
# In the first step y^gamma - y is largest at y = exp(L / (1 - gamma)), L = log gamma.
L = log(g)
prove("(20.13) the top of the first step", simplify(g * exp((g - 1) * L / (1 - g)) - 1))
prove("(20.13) its height", simplify(
    (exp(g * L / (1 - g)) - exp(L / (1 - g))) / exp(g * L / (1 - g)) - (1 - g)))
#< variation


def literal_of_positions(row, i):
    def at(digits):
        mp.dps = digits + 20
        return mpmath.nstr(position_constants(*row)[i], digits)
    return hexd_real(at, 30)


def literal(row, i):
    def at(digits):
        mp.dps = digits + 20
        return mpmath.nstr(constants(*row)[i], digits)
    return hexd_real(at, 30)


MOTIONS = [(alpha, kappa_, T, r, l, G_, var, start, V, A, room)
           for alpha, r in ((0.0, 0.5), (0.2, 0.3), (0.5, 0.75), (0.7, 0.2), (0.95, 0.25))
           for kappa_, T, l, G_, var, start, V, A, room in (
               (0.5, 1.0, 1.5, 2.0, 0.25, 0.5, 1.25, 3.0, 1.0),
               (0.25, 4.0, 0.125, 0.5, 2.0, 1.0, 1.5, 0.75, 0.0),
               (1.0, 0.1, 6.0, 3.0, 0.0, 2.0, 2.0, 8.0, 0.125))]
MOTIONS.append((0.3, 0.5, 2.0, 0.0, 0.0, 0.0, 1.0, 1.0, 3.0, 1.0, 0.5))

# -- order two of the methods of H 13: (20.9) in doubles, which is enough for constants ---
def strip():
    """Return the largest |Psi - 1| / |y|^2 and the largest |Psi| of three methods at points of the strip."""
    near, size = 0.0, 0.0
    for a in (n / 20 for n in range(21)):
        for y in (complex(r / 8, cmath.pi * j / 113) for r in range(9) for j in range(-113, 114) if r or j):
            z, root = cmath.exp(-y), ((1 - cmath.exp(-y)) / y) ** (2 * a)
            for Psi in (root * (1 - a + a / z), root * ((3 - z) / 2) ** (2 * a),
                        root * (0.5 + a + (0.5 - a) * z) * (1 + 1 / z) / 2):
                near, size = max(near, abs(Psi - 1) / abs(y) ** 2), max(size, abs(Psi))
    return near, size


claim("(20.9) on the strip", strip()[0] < 0.7 and strip()[1] < 2.3)

header("verify/convergence/convergence.py")
print("\n/* c = Gamma(n + gamma) / Gamma(n); excess as in (20.4), without h. */")


def at_n(function, n, order):
    def at(digits):
        mp.dps = digits + 40
        return mpmath.nstr(function(n, order), digits)
    return hexd_real(at, 30)


table("ref_quotients", "double gamma; size_t n; double c, excess;",
      [[hexd(order), n, at_n(quotient, n, order), at_n(excess, n, order)]
       for order in (2.0**-10, 0.1, 0.5, 0.75, 1.0, 1.125, 1.5, 1.9, 2.0)
       for n in (1, 2, 3, 10, 100, 1000)])
print("\n/* A room of 0 stands for infinity, as does a step h of 0. */")
table("ref_bounds", "double motion[11]; double C, lambda, h;",
      [["{ " + ", ".join(hexd(v) for v in row) + " }"]
       + [literal(row, i) for i in range(3)] for row in MOTIONS])
print("\n/* From the variation of the velocity, which stands in the place of the acceleration. */")
table("ref_position_bounds", "double motion[11]; double C, lambda, h;",
      [["{ " + ", ".join(hexd(v) for v in row) + " }"]
       + [literal_of_positions(row, i) for i in range(3)] for row in MOTIONS])
