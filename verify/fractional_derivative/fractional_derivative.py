"""H 1. Riemann-Liouville and Caputo derivatives.

Proved here, with alpha (and beta, and exponents) symbolic:
  (1.4)   Riemann-Liouville = Caputo + f(a) u^-alpha / Gamma(1 - alpha), for any f
          by parts, and on 1, t, t^2; with the printed minus it is false;
  (1.5)   the weight of the mean has mass 1;
  (1.6)   the power rule, from Euler's beta integral;
  (1.7)   integration by parts on all polynomials, no boundary term for alpha < 1,
          and the boundary term at alpha = 1;
  (1.8)   its form for Caputo, with a boundary term;
  (1.9)   orders add on powers; (1.10) a function on which they do not;
  (1.11)  the limits alpha -> 0 and alpha -> 1;
  (1.12)  the part of a sine that has been forgotten lies between two powers of t;
  (1.13)  the first error term of the Grünwald-Letnikov sum, on all polynomials.
Printed: powers from the gamma function, functions from their Taylor series at the end, term by term, and one function
that is not entire from the defining integral (mpmath, two precisions), at random orders, times and exponents; the
seed is in the script."""
import math
import random

import mpmath
from sympy import (Function, Rational, binomial, diff, gamma, gammasimp, limit, oo, pi,
                   powsimp, simplify, sqrt, symbols)

from shared.refgen import claim, header, hexd, hexd_real, prove, table

alpha, beta, g = symbols("alpha beta g", positive=True)
a, t, tau, u, h = symbols("a t tau u h", positive=True)
m, n = symbols("m n", positive=True)  # exponents: any positive numbers

#> euler
# Euler: int_0^u (u - s)^-alpha s^g ds = B(1 - alpha, g + 1) u^(1 - alpha + g).
for k in range(7):  # an integer g: expand (1 - w)^k and integrate w^(j - alpha)
    prove(f"Euler's beta integral, g = {k}",
          sum((-1) ** j * binomial(k, j) / (j + 1 - alpha) for j in range(k + 1))
          - gammasimp(gamma(1 - alpha) * gamma(k + 1) / gamma(k + 2 - alpha)))
#< euler


def euler(p, q):
    """Return int_0^1 s^p (1 - s)^q ds."""
    return gamma(p + 1) * gamma(q + 1) / gamma(p + q + 2)


#> power
def factor(order, e):
    """Return the factor in D^order u^e = factor u^(e - order)."""
    return gamma(e + 1) / gamma(e + 1 - order)


riemann_liouville = diff(euler(g, -alpha) * u ** (1 - alpha + g), u) / gamma(1 - alpha)
prove("(1.6) power rule", gammasimp(riemann_liouville / u ** (g - alpha)
                                    - factor(alpha, g)))
caputo = g * euler(g - 1, -alpha) / gamma(1 - alpha)
prove("(1.6) power rule for Caputo, g > 0", gammasimp(caputo - factor(alpha, g)))
#< power

#> relation
# Any f. By parts, int_a^t (t-tau)^-alpha f = f(a) K(t-a) + int_a^t K(t-tau) f', where K' is the kernel and K(0) = 0.
# The derivative d/dt of the right side is (1.4).
f = Function("f")
K = (t - tau) ** (1 - alpha) / (1 - alpha)
prove("(1.4) by parts", diff(-K * f(tau), tau)
      - (t - tau) ** -alpha * f(tau) + K * diff(f(tau), tau))
prove("(1.4) boundary term", K.subs(tau, t).subs(alpha, Rational(1, 2)),
      diff(K.subs(tau, a), t) - (t - a) ** -alpha)
prove("(1.4) under the integral", diff(K, t) - (t - tau) ** -alpha)
#< relation

#> monomials
# t^k = sum_j C(k, j) a^(k-j) u^j, both derivatives by (1.6), u = t - a.
for k in range(3):
    rl = sum(binomial(k, j) * a ** (k - j) * factor(alpha, j) * u ** (j - alpha)
             for j in range(k + 1))
    c = sum(binomial(k, j) * a ** (k - j) * factor(alpha, j) * u ** (j - alpha)
            for j in range(1, k + 1))
    end = a ** k * u ** -alpha / gamma(1 - alpha)
    prove(f"(1.4) on t^{k}", gammasimp((rl - c - end) * u ** alpha))
    claim(f"(1.4) on t^{k} is false with the printed minus",
          simplify((rl - c + end).subs({alpha: Rational(1, 2), a: 1, u: 1})) != 0)
#< monomials

prove("(1.5) mass of the weight", (1 - alpha) * euler(-alpha, 0) - gammasimp(
    (1 - alpha) * gamma(1 - alpha) / gamma(2 - alpha)),
    gammasimp((1 - alpha) * gamma(1 - alpha) / gamma(2 - alpha)) - 1)

#> by-parts
# On [0, 1]: G = t^m (so D_- acts on it), F = (1 - t)^n (so D_+ does).
left = factor(alpha, m) * euler(m - alpha, n)   # int F D_- G
right = factor(alpha, n) * euler(m, n - alpha)  # int (D_+ F) G
prove("(1.7) on t^m and (1 - t)^n", gammasimp(left - right))
prove("(1.7) where the ends do not vanish", gammasimp((left - right).subs(m, 0)),
      gammasimp((left - right).subs({m: 0, n: 0})))
#< by-parts
half = Rational(1, 2)
t_times_D1 = (factor(alpha, 0) / (2 - alpha)).subs(alpha, half)  # int t t^-alpha
Dt_times_1 = (factor(alpha, 0) / (1 - alpha)                       # t = 1 - (1 - t)
              - factor(alpha, 1) / (2 - alpha)).subs(alpha, half)
prove("(1.7) f = t, g = 1, alpha = 1/2", t_times_D1 - 2 / (3 * sqrt(pi)),
      Dt_times_1 - 2 / (3 * sqrt(pi)))

#> by-parts-ends
# alpha = 1, G = 1: int F G' = 0, but the limit of int F D_- G is F(0) G(0) = 1.
prove("(1.7) does not commute with alpha -> 1",
      limit(gammasimp(left.subs(m, 0)), alpha, 1) - 1)
# (1.8): Caputo's derivative of the constant is 0, so I_+^(1-alpha) of (1 - t)^n at 0 remains.
integral = gamma(n + 1) / gamma(n + 2 - alpha)
prove("(1.8) G = 1", gammasimp(0 - (right.subs(m, 0) - 1 * integral)))
# F = e^(2 (1-t)), G = e^t, alpha = 0.3 and 0.7, with I^(1-alpha) e^(c s) in closed form.
with mpmath.workdps(30):
    def mean(o, c, s):
        """Return I^(1-o) of e^(c s) at s."""
        return c ** (o - 1) * mpmath.exp(c * s) * mpmath.gammainc(1 - o, 0, c * s, regularized=True)

    for o in (mpmath.mpf(3) / 10, mpmath.mpf(7) / 10):
        caputo_side = mpmath.quad(lambda s: mpmath.exp(2 - 2 * s) * mean(o, 1, s), [0, 1])
        # s = 1 - t: D e^(2 s) = s^-o / Gamma(1-o) + 2 I^(1-o) e^(2 s); s^-o by v = s^(1-o)
        end = mpmath.quad(lambda v: mpmath.exp(1 - v ** (1 / (1 - o))), [0, 1])
        other_side = end / mpmath.gamma(2 - o) + mpmath.quad(
            lambda s: 2 * mean(o, 2, s) * mpmath.exp(1 - s), [0, 1])
        claim(f"(1.8) F = e^(2 (1-t)), G = e^t, alpha = {o}, to 15 digits",
              abs(caputo_side - other_side + mean(o, 2, 1)) < 1e-15)
prove("(1.8) F = G = 1, alpha = 1/2", integral.subs({n: 0, alpha: half}) - 2 / sqrt(pi))
#< by-parts-ends

#> semigroup
prove("(1.9) orders add on powers",
      gammasimp(factor(beta, g) * factor(alpha, g - beta) - factor(alpha + beta, g)))
# (1.10): beta = 1 and the constant of f. D^1 1 = 0, but D^(1 + alpha) 1 is not.
prove("(1.10) f = 1", gammasimp(0 - (factor(1 + alpha, 0) - 1 / gamma(-alpha))))
prove("(1.10) f = t^g", gammasimp(g * factor(alpha, g - 1) - factor(1 + alpha, g)))
coefficients = {0: 1, 1: 2, 2: 3}  # f = 1 + 2 t + 3 t^2, alpha = 1/2
one_after_the_other = sum(c * k * factor(half, k - 1) * t ** (k - 1 - half)
                          for k, c in coefficients.items() if k)
at_once = sum(c * factor(3 * half, k) * t ** (k - 3 * half) for k, c in coefficients.items())
prove("(1.10) 1 + 2 t + 3 t^2",
      one_after_the_other - at_once - t ** (-3 * half) / (2 * sqrt(pi)))
prove("t^(-1/2): D^(1/2) gives 0, D^1 does not", 1 / gamma(g - half + 1).subs(g, -half),
      diff(t ** -half, t) + half * t ** (-3 * half))
# Caputo twice, 1/2 < alpha < 1: on t (x'(0) = 1) and on t^g, g >= 2.
prove("Caputo twice, x = t: x'(a) is left over", gammasimp(
    factor(alpha, 1) * factor(alpha, 1 - alpha) - 1 / gamma(2 - 2 * alpha)))
prove("Caputo twice, x = t^g", gammasimp(
    factor(alpha, g) * factor(alpha, g - alpha)
    - g * (g - 1) * factor(2 * alpha - 2, g - 2)))
#< semigroup

#> limits
prove("(1.11) t^g, alpha -> 1", limit(factor(alpha, g), alpha, 1) - g)
prove("(1.11) t^g, alpha -> 0", limit(factor(alpha, g), alpha, 0) - 1)
prove("(1.11) 1, alpha -> 1: pointwise 0", limit(factor(alpha, 0), alpha, 1))
prove("(1.11) but its integral over [0, 1] tends to 1",
      limit(gammasimp(factor(alpha, 0) / (1 - alpha)), alpha, 1) - 1)
#< limits

#> sine
# int_0^oo cos(s) e^(-s p) ds = p / (1 + p^2), between p - p^3 and p; and
# (t + s)^-alpha = 1 / Gamma(alpha) int_0^oo p^(alpha - 1) e^(-(t + s) p) dp.
p = symbols("p", positive=True)
primitive = (p / (1 + p ** 2), p, p - p ** 3)
prove("(1.12) the bounds", primitive[1] - primitive[0] - p ** 3 / (1 + p ** 2),
      primitive[0] - primitive[2] - p ** 5 / (1 + p ** 2))
prove("(1.12) the powers of t",  # int p^(alpha - 1 + k) e^(-t p) = Gamma(alpha + k) t^-..
      gammasimp(gamma(alpha + 1) / gamma(alpha) - alpha),
      gammasimp(gamma(alpha + 3) / gamma(alpha) - alpha * (alpha + 1) * (alpha + 2)))
#< sine
mpmath.mp.dps = 60
for order in (0.1, 0.5, 0.9):
    o, T = mpmath.mpf(order), mpmath.mpf(15)
    D = mpmath.nsum(lambda k: (-1) ** int(k) * T ** (2 * k + 1 - o)
                    * mpmath.rgamma(2 * k + 2 - o), [0, 150])
    rest = (mpmath.sin(T + o * mpmath.pi / 2) - D) * mpmath.gamma(1 - o)
    first = o * T ** (-1 - o)
    claim(f"(1.12) at t = 15, alpha = {order}",
          0 < first - rest < first * (o + 1) * (o + 2) / T ** 2)

#> expansion
# p_j = j! h^j binom(N + j, j) = t^j + h j (j+1)/2 t^(j-1) + ..., t = N h. The sum of p_j is known exactly, because
# the weights turn 1/(1-z)^(j+1) into (1-z)^(alpha-j-1): it is j! h^(j-alpha) w_N. By (4.5) of H 4,
# Gamma(N + c) / N! = N^(c-1) (1 + c (c-1) / (2N) + ...).
j = symbols("j", positive=True)
c = j + 1 - alpha
sum_of_p = factor(alpha, j) * t ** (j - alpha) * (1 + c * (c - 1) * h / (2 * t))
lower = h * j * (j + 1) / 2 * factor(alpha, j - 1) * t ** (j - 1 - alpha)
claimed = (factor(alpha, j) * t ** (j - alpha)
           - alpha * h / 2 * j * factor(alpha, j - 1) * t ** (j - 1 - alpha))
prove("(1.13) on t^j", gammasimp((sum_of_p - lower - claimed) * t ** (1 + alpha - j) / h))
claimed = (factor(alpha, 0) * t ** -alpha
           + (1 - alpha) * h / 2 * t ** (-1 - alpha) / gamma(-alpha))
prove("(1.13) on 1", gammasimp((sum_of_p.subs(j, 0) - claimed) * t ** (1 + alpha) / h))
#< expansion


def off(order, e, N):
    """Return the error of the sum for f = t^e at t = 1 with N steps."""
    w, total = 1.0, 1.0
    for n in range(1, N + 1):
        w *= (n - 1 - order) / n
        total += w * ((N - n) / N) ** e
    return abs(N ** order * total - math.gamma(1 + e) / math.gamma(1 + e - order))


chosen = random.Random(1869)            # four times as many steps leave at most 4^-0.6 = 0.44 of the error
for _ in range(40):
    order, e = chosen.uniform(0.05, 1.4), chosen.uniform(0.45, 3)
    claim("every power", off(order, e, 4000) < 0.5 * off(order, e, 1000) + 1e-9)

# ---- exact values -----------------------------------------------------------

dice = random.Random(1867)
exact = mpmath.mpf


def two_precisions(value):
    """Return value() as a double literal, at two precisions that must agree."""
    def text(digits):
        mpmath.mp.dps = digits + 25
        return mpmath.nstr(value(), digits)
    return hexd_real(text, 30, 10)


def power(order, e, u):
    o, e, u = exact(order), exact(e), exact(u)
    return mpmath.gammaprod([e + 1], [e + 1 - o]) * u ** (e - o)


rows = [(dice.uniform(-2, 2), dice.uniform(-1, 12), dice.uniform(0, 5)) for _ in range(60)]
rows += [(dice.uniform(0, 1), dice.uniform(-0.9, 3), 10 ** dice.uniform(-8, 8)) for _ in range(20)]
rows += [(dice.uniform(-2, 2), 10 ** dice.uniform(1, 6), dice.uniform(0.9999, 1.0001))
         for _ in range(20)]
tiny = 2.0 ** -50
rows += [(0.75, -0.25 + tiny, 2.0), (0.25, -0.75 + tiny, 2.0), (1.75, -0.25 - tiny, 2.0),
         (2 - tiny, -1 + tiny, 0.5), (1 - tiny, -1 + tiny, 3.0), (0.5, -0.5, 0.25),
         (1.5, 0.5, 1e-8), (1.5, 0.5, 1e8), (1e-300, 3.0, 2.0), (-2.0, 9.0, 1.5),
         (-2.0, 170.5, 1.0), (1.0, 1e9, 1.0), (0.3, 1e12, 1 - 2.0 ** -40), (2.0, 1.0, 3.0),
         (1.5, 0.0, 4.0), (0.5, 1.5, 1e-300), (0.3, 1000.1, 0.5), (-0.7, 1000.3, 2.0)]
near = 2.0 ** -33  # g + 1 - order is 2^-83, and 2^-83 - 1: next to the two poles of Gamma
rows += [(1 - near, -near * (1 - tiny), 2.0), (2 - near, -near * (1 - tiny), 2.0)]
header("verify/fractional_derivative/fractional_derivative.py")
table("ref_powers", "double order, g, u, want;",
      [[hexd(o), hexd(e), hexd(x),
        "0" if power(o, e, x) == 0 else two_precisions(lambda: power(o, e, x)),
        f"{o:.4g}, {e:.4g}, {x:.4g}"] for o, e, x in rows])


def taylor(derivative, constant, order, u):
    """Return sum_k f^(k) D^order u^k / k!; for Caputo without k = 0."""
    o, u = exact(order), exact(u)
    total, k = mpmath.mpf(0), 0 if constant else 1
    weight, power = mpmath.rgamma(k + 1 - o), u ** (k - o)
    while k < 4 or weight * (4 * u) ** k > mpmath.mpf(10) ** -mpmath.mp.dps:
        total += derivative(k) * weight * power
        k, power = k + 1, power * u
        weight = weight / (k - o) if k > 1 else mpmath.rgamma(k + 1 - o)  # 1 - o may be 0, so start anew
    return total


# The curves of the test are sin(3t), exp(-2t), t^3 - t + 1, 1/(1 + t^2). With side = +1 the curve ends at `end` and
# is reflected, so u is always the distance from the end.
def derivatives_at(curve, end, side):
    """Return the function k -> d^k f / du^k at the end."""
    e, s = exact(end), -side  # t = end + s u
    if curve == 0:
        sin, cos = mpmath.sin(3 * e), mpmath.cos(3 * e)
        return lambda k: (3 * s) ** k * (sin, cos, -sin, -cos)[k % 4]
    if curve == 1:
        decay = mpmath.exp(-2 * e)
        return lambda k: (-2 * s) ** k * decay
    cubic = (e ** 3 - e + 1, s * (3 * e ** 2 - 1), 6 * e, 6 * s)
    return lambda k: cubic[k] if k < 4 else mpmath.mpf(0)


def by_definition(end, side, order, t, is_caputo):
    """Return the derivative of 1 / (1 + t^2) from the integrals (1.2) and (1.3) themselves. The substitution y = u
    v^n with n (1 - o) = 3 removes the singularity and makes the integrand rational."""
    e, o, s = exact(end), exact(order), -side
    u, n = abs(exact(t) - e), round(3 / (1 - order))
    claim("n (1 - o) = 3", n * (1 - o) == 3)
    f = lambda x: 1 / (1 + x * x)
    df = lambda x: -2 * x / (1 + x * x) ** 2
    if is_caputo:
        return s * u ** (1 - o) * mpmath.rgamma(2 - o) * mpmath.quad(
            lambda v: 3 * v * v * df(exact(t) - s * u * v ** n), mpmath.linspace(0, 1, 3))

    def integral(length):  # d/dt or -d/dt is d/du on either side
        return length ** (1 - o) * mpmath.rgamma(2 - o) * mpmath.quad(
            lambda v: 3 * v * v * f(e + s * length * (1 - v ** n)), mpmath.linspace(0, 1, 3))
    step = mpmath.mpf(10) ** -5
    stencil = (exact(4) / 5, -exact(1) / 5, exact(4) / 105, -exact(1) / 280)
    return sum(c * (integral(u + i * step) - integral(u - i * step))
               for i, c in enumerate(stencil, 1)) / step


def largest_velocity(curve, end, t):
    lo, hi = sorted((end, t))
    if curve == 0:
        return 3.0
    if curve == 1:
        return 2 * float(mpmath.exp(-2 * lo))
    return max(1.0, 3 * lo * lo - 1, 3 * hi * hi - 1) if curve == 2 else 0.65


rows = []
cases = [(i % 3, dice.choice((-1, 1)), dice.uniform(0, 1), dice.uniform(-1, 1),
          dice.uniform(0, 2)) for i in range(48)]
cases += [(c, s, o, 0.25, 1.5) for c in range(2) for s in (-1, 1)
          for o in (0.0, 1e-8, 2.0 ** -53, 1 - 2.0 ** -30, 1 - 2.0 ** -53, 1.0)]
cases += [(c, s, 0.5, 0.5, 1e-6) for c in range(3) for s in (-1, 1)]
cases += [(3, s, o, 0.25, 0.75) for s in (-1, 1) for o in (0.25, 0.5, 0.625)]
for curve, side, order, end, u in cases:
    t_ = end - side * u  # a double
    u_ = abs(exact(t_) - exact(end))
    values = []
    for constant in (False, True):
        if curve == 3:
            mpmath.mp.dps = 50
            value = mpmath.nstr(by_definition(end, side, order, t_, not constant), 30)
            values.append(hexd(Rational(value)))
        elif order == 0 and not constant:  # Caputo, order 0
            series = derivatives_at(curve, end, side)
            values.append(two_precisions(lambda: taylor(series, False, order, u_)))
        else:
            values.append(two_precisions(lambda: taylor(
                derivatives_at(curve, end, side), constant, order, u_)))
    rows.append([curve, f"{side:2d}", hexd(order), hexd(end), hexd(t_),
                 hexd(largest_velocity(curve, end, t_)), *values])
table("ref_curves", "int curve, side; double alpha, end, t, largest, caputo, riemann;", rows)
