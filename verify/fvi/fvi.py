"""H 9. Proved with symbols (alpha, kappa, m, rho, h, the sequences and the potential are all open): the restricted
variation of the discrete action gives the three-term equation (9.2) for x, which is (9.3) when written out; the
momentum form (9.4) is the same equation; kappa and 1 - kappa differ only if U is not quadratic; the kick (9.5); the
delay (9.7); the error (9.8) of the start under a force at t = 0. And y_k = x_{N-k} satisfies the advanced equation
with 1 - kappa.

Reference values: trajectories of (9.2) as the chapter prints it, with two sums for two derivatives and positions
only, in exact rationals, or in two precisions of many digits where a step is a quadratic equation. Each value has a
bound of the rounding errors of the C code: the operations of (9.4) are repeated in an arithmetic in which every
number carries the error that the doubles may have. The repetition also shows once more that (9.4) and (9.2) have the
same solutions."""
from fractions import Fraction as Q
from functools import lru_cache

import mpmath
from sympy import (Function, Rational, coth, diff, exp, expand, gamma, gammasimp, ratsimp,
                   sinh, symbols)

from shared.fvi_runs import Case, Digits, Exactly, by_definition, by_momentum, weight
from shared.refgen import claim, header, hexd, prove, rows_of, table

h, m, rho, kappa, alpha = symbols("h m rho kappa alpha", positive=True)


# ---- the equation and its momentum form, with symbols ----

class g(Function):
    """The gradient of U, any function."""


class U(Function):
    """The potential, any function with gradient g."""
    def fdiff(self, argindex=1):
        return g(self.args[0])


N = 4
x, y, F = symbols("x0:5"), symbols("y0:5"), symbols("F0:5")
a, b = symbols("a b")
Ld = m * (b - a)**2 / (2 * h) - h * U(kappa * a + (1 - kappa) * b)
L = lambda p, q: Ld.subs({a: p, b: q}, simultaneous=True)
D1 = lambda p, q: diff(Ld, a).subs({a: p, b: q}, simultaneous=True)
D2 = lambda p, q: diff(Ld, b).subs({a: p, b: q}, simultaneous=True)
retarded = lambda z, k: h**-alpha * sum(weight(alpha, n) * z[k - n] for n in range(k + 1))
advanced = lambda z, k: h**-alpha * sum(weight(alpha, n) * z[k + n] for n in range(N - k + 1))
twice = lambda z, k: retarded([retarded(z, j) for j in range(N + 1)], k)

free = sum(L(x[k], x[k + 1]) + L(y[k], y[k + 1]) for k in range(N))
memory = -h * sum(retarded(x, k) * rho * advanced(y, k) for k in range(N + 1))
work = h * sum(F[k] * (x[k] + y[k]) for k in range(N + 1))
action = free + memory + work                                           # (9.1)


#> three-terms
def three_terms(k):
    return D1(x[k], x[k + 1]) + D2(x[k - 1], x[k]) - h * rho * twice(x, k) + h * F[k]


for k in range(1, N):
    # delta x_k = delta y_k: D_{x_k} of the x-terms, D_{y_k} of the memory.
    varied = diff(free + work, x[k]) + diff(memory, y[k])
    prove("(9.2) is the x-part of the restricted variation", expand(varied - three_terms(k)))
    both = diff(action, x[k]) + diff(action, y[k])
    of_y = diff(free + work, y[k]) + diff(memory, x[k])
    prove("nothing but the x-part and the y-part is left", expand(both - varied - of_y))
    S = lambda j: kappa * x[j] + (1 - kappa) * x[j + 1]
    printed = (m * (x[k + 1] - 2 * x[k] + x[k - 1]) / h**2 + kappa * g(S(k))
               + (1 - kappa) * g(S(k - 1)) + rho * twice(x, k) - F[k])
    prove("(9.3)", expand(three_terms(k) + h * printed))
    claim("the x-part holds no y, the y-part no x",
          not varied.free_symbols & set(y) and not of_y.free_symbols & set(x))
#< three-terms

#> momentum-form
for k in range(N - 1):
    p = -D1(x[k], x[k + 1])                         # p_k, which dx must match
    dx = x[k + 1] - x[k]
    G = g(x[k] + (1 - kappa) * dx)
    prove("A dx + s grad U = p_k", expand(m / h * dx + kappa * h * G - p, power_base=False))
    after = p - h * G - h * rho * twice(x, k + 1) + h * F[k + 1]
    prove("(9.4) matched to the next step is (9.2)",
          expand(after + D1(x[k + 1], x[k + 2]) - three_terms(k + 1)))
#< momentum-form

# y_k = x_{N-k}: the advanced equation at k, with 1 - kappa and the force F(t_{N-k}), is (9.3) at N - k. part_of_y is
# the part of (9.1) with y, divided by -h.
part_of_y = lambda k: -(diff(free + work, y[k]) + diff(memory, x[k])) / h
mirror = [x[N - k] for k in range(N + 1)]
twice_ahead = lambda z, k: advanced([advanced(z, j) for j in range(N + 1)], k)
for k in range(1, N):
    S = lambda z, K, j: K * z[j] + (1 - K) * z[j + 1]
    forces = lambda z, K, j: K * g(S(z, K, j)) + (1 - K) * g(S(z, K, j - 1))
    prove("the mirror has 1 - kappa",
          expand(forces(mirror, 1 - kappa, k) - forces(x, kappa, N - k)),
          expand(twice_ahead(mirror, k) - twice(x, N - k)))
    reversed_ = part_of_y(k).doit().subs(kappa, 1 - kappa)
    reversed_ = reversed_.subs(dict(zip(y + F, mirror + [F[N - j] for j in range(N + 1)])),
                               simultaneous=True)
    prove("the mirror solves the y-part with 1 - kappa, where the force is reversed too",
          expand(reversed_ + three_terms(N - k) / h))

# kappa and 1 - kappa: one recurrence for quadratic U, two for cubic U.
def mean_force(force, K):
    return (K * force(K * x[1] + (1 - K) * x[2]) + (1 - K) * force(K * x[0] + (1 - K) * x[1]))


swap = lambda force: mean_force(force, kappa) - mean_force(force, 1 - kappa)
prove("quadratic U sees only kappa (1 - kappa)", expand(swap(lambda z: a * z + b)))
prove("cubic U tells kappa from 1 - kappa",
      expand(swap(lambda z: z**2) - kappa * (kappa - 1) * (2 * kappa - 1)
             * (x[0] - x[2]) * (2 * x[1] - x[0] - x[2])))

#> kick
# (9.5): the sum of the damping of a constant over the steps j = 1, ..., k.
for k in range(1, 9):
    total = sum(sum(weight(2 * alpha, n) for n in range(j + 1)) for j in range(1, k + 1))
    prove("(9.5) the kick", ratsimp(total - (weight(2 * alpha - 2, k) - 1)))
#< kick
# As Gamma functions: w_k of order 2 alpha - 2 is Gamma(k + 2 - 2 alpha) / (Gamma(2 - 2 alpha) k!).
for k in range(1, 6):
    prove("the kick as Gamma functions", gammasimp(
        weight(2 * alpha - 2, k) - gamma(k + 2 - 2 * alpha) / gamma(2 - 2 * alpha) / gamma(k + 1)))

# (9.8): the start on a path with m x'' = F - grad U.
v0, step = symbols("v0 step")
begin = -D1(x[0], x[0] + step * v0 + step**2 * (F[0] - g(x[0])) / (2 * m)).subs(h, step)
prove("(9.8) the start of a forced motion",
      expand(begin).subs(step, 0) - m * v0,
      diff(expand(begin), step).subs(step, 0).doit() - F[0] / 2 - (kappa - Rational(1, 2)) * g(x[0]))

#> late
# (9.7): on e^{st} the weights of order beta act as s^beta, delayed by beta h / 2, times an even function of h. The
# transform of the start, of x_0 and p_0, is even in h.
s, beta = symbols("s beta", positive=True)
even = lambda f: prove("even in h", (f - f.subs(h, -h)).rewrite(exp))
prove("(9.7) the base of the weights",
      (1 - exp(-s * h)) / h - (exp(-s * h / 2) * 2 / h * sinh(s * h / 2)).rewrite(exp))
even(sinh(s * h / 2) / h)
even(h / 2 * coth(s * h / 2))               # of a constant whose first term is halved
even((h / 2)**2 / sinh(s * h / 2)**2)       # of t
z, c, X = symbols("z c X", positive=True)   # z = e^{-sh}; x_k = X^k with |X z| < 1, so the sums are known
geometric = 1 / (1 - X * z)
Phi = h * (geometric - Rational(1, 2))
A_ = m + h**2 * c / 4
left = (h * A_ * (X - 2 + 1 / X) / h**2 + h * c) * (geometric - 1)
start = A_ * (X - 1) / h + h * c / 2        # p_0 = -D_1 L_d for kappa = 1/2
prove("(9.7) p_0 for kappa = 1/2", expand(
    start - (m * (X - 1) / h + h / 2 * c * (1 + X) / 2)))
prove("(9.7) the transform of (9.3) with its start", ratsimp(
    left + start - (A_ * ((1 / z - 2 + z) / h**2 * Phi - (1 / z - z) / (2 * h)) + c * Phi)))
#< late


# ---- trajectories ----

fifth = Q(1, 5)     # the exact 1/5 of the paper, where the double 0.2 will not do
paper = Case("", Q(1, 2), Q(1, 2), Q(1, 2), 4, [1], [Q(1, 2)], rho=[fifth])
claim("the paper's first figure, alpha = 1/2", [row[0] for row in by_definition(paper, Exactly)[0]]
      == [1, Q(19, 17), Q(1389, 1445), Q(72883, 122825), Q(1258381, 10440125)])
by_hand = Case("", Q(3, 4), 0, 1, 3, [0], [1], rho=[Q(1, 2)])
claim("the chapter's three steps", by_definition(by_hand, Exactly)
      == ([[0], [1], [Q(1, 2)], [0]], [[1], [Q(-1, 2)], [Q(-1, 2)], [Q(-5, 16)]]))
# ---- values for the tests of the C code ----

tenth = Q(0.1)
CASES = [
    Case("linear, alpha = 1/2, the paper's", Q(1, 2), Q(1, 2), Q(1, 2), 16, [1], [Q(1, 2)],
         rho=[Q(0.2)]),
    Case("alpha = 0", 0, Q(1, 4), Q(1, 2), 12, [1], [Q(1, 2)]),
    Case("alpha = 1/4", Q(1, 4), Q(1, 4), Q(1, 4), 16, [1], [Q(1, 2)], mass=[2]),
    Case("alpha = 3/8", Q(3, 8), Q(3, 4), Q(1, 16), 16, [1], [Q(-1, 2)]),
    Case("alpha = 3/4", Q(3, 4), Q(1, 2), Q(1, 4), 10, [1], [Q(1, 2)]),
    Case("alpha = 3/4, driven", Q(3, 4), Q(1, 2), Q(1, 4), 10, [0], [0], rho=[1], ramp=[3]),
    Case("alpha = 1", 1, Q(1, 2), Q(1, 4), 8, [1], [Q(1, 2)]),
    Case("Caputo, alpha = 1/4", Q(1, 4), Q(1, 2), Q(1, 4), 16, [2], [Q(1, 2)], mass=[2], caputo=1),
    Case("Caputo, alpha = 1/2", Q(1, 2), Q(1, 4), Q(1, 4), 16, [2], [Q(1, 2)], caputo=1),
    Case("Caputo, alpha = 3/4", Q(3, 4), Q(1, 2), Q(1, 4), 16, [2], [Q(1, 2)], mass=[2], caputo=1,
         ramp=[1]),
    Case("Caputo, alpha = 1", 1, Q(1, 4), Q(1, 4), 8, [2], [Q(3, 4)], mass=[2], caputo=1),
    Case("cubic, kappa = 0", Q(3, 4), 0, Q(1, 4), 7, [Q(1, 2)], [Q(3, 4)], "CUBIC", g=1),
    Case("cubic, kappa = 1", Q(3, 4), 1, Q(1, 4), 7, [Q(1, 2)], [Q(3, 4)], "CUBIC", g=1),
    Case("cubic, kappa = 1/4", Q(1, 4), Q(1, 4), Q(1, 4), 12, [Q(1, 2)], [Q(3, 4)], "CUBIC", g=1,
         exact=False),
    Case("cubic, kappa = 3/4", Q(1, 4), Q(3, 4), Q(1, 4), 12, [Q(1, 2)], [Q(3, 4)], "CUBIC", g=1,
         exact=False),
    Case("cubic, kappa = 1/2, alpha = 0.1, Caputo, driven", tenth, Q(1, 2), tenth, 12, [Q(1, 2)],
         [Q(3, 4)], "CUBIC", g=1, caputo=1, ramp=[1], exact=False),
    Case("chain, one damped", Q(3, 8), Q(1, 2), Q(1, 16), 12, [1, Q(-1, 2)], [0, Q(3, 4)], "CHAIN",
         mass=[1, 2], rho=[0, Q(1, 2)], ramp=[1, -2]),
    Case("chain, both damped, Caputo", Q(3, 4), Q(1, 4), Q(1, 4), 12, [1, Q(-1, 2)], [1, Q(3, 4)],
         "CHAIN", mass=[1, 2], rho=[Q(1, 4), Q(1, 2)], caputo=1),
    Case("quartic chain, kappa = 1", Q(3, 4), 1, Q(1, 4), 5, [1, Q(-1, 2)], [0, Q(3, 4)], "CHAIN",
         g=Q(1, 2), mass=[1, 2], rho=[Q(1, 2), 0], ramp=[1, -2]),
    Case("quartic chain, kappa = 0, Caputo", Q(1, 4), 0, Q(1, 4), 5, [1, Q(-1, 2)], [0, Q(3, 4)],
         "CHAIN", g=Q(1, 2), mass=[1, 2], rho=[Q(1, 2), Q(1, 4)], caputo=1),
]


def check_same(case, definition, momentum, tolerance):
    for one, other in zip(definition, momentum):
        for row, rounded in zip(one, other):
            claim(f"{case.name}: (9.4) gives what (9.2) gives",
                  all(abs(v - r.v) <= tolerance for v, r in zip(row, rounded)))


def values(case):
    """Return the rows of one case: x and p as C literals, and the bounds of their rounding errors."""
    with mpmath.workdps(60):
        kind = Exactly if case.exact else Digits
        definition, momentum = by_definition(case, kind), by_momentum(case, kind)
        check_same(case, definition, momentum, 0 if case.exact else mpmath.mpf(10) ** -50)
    return rows_of(case, definition, momentum, lambda: by_definition(case, Digits))


header("verify/fvi/fvi.py")
runs, rows = [], []
for case in CASES:
    pair = lambda v: "{ " + ", ".join(map(hexd, v)) + " }"
    runs.append([f'"{case.name}"', case.d, hexd(case.alpha), hexd(case.kappa), hexd(case.h),
                 case.steps, case.caputo, case.potential, pair([case.c, case.g]), pair(case.mass),
                 pair(case.rho), pair(case.ramp), pair(case.x0), pair(case.p0), len(rows)])
    rows += values(case)
table("ref_runs", "const char *name; size_t d; double alpha, kappa, h; size_t steps; int caputo, "
      "potential; double cg[2], mass[2], rho[2], ramp[2], x0[2], p0[2]; size_t first;", runs)
print("\n/* x_k and p_k, component after component, step after step, and how many units")
print(" * of 2^-53 the results of the C code may be away from them. */")
table("ref_rows", "double x, p, x_units, p_units;", rows)


@lru_cache(None)
def over_gammas(j, order, bits):
    """Return 1 / Gamma(e + 1) and 1 / Gamma(e + 2), e = 2i + (2 - order) j, i < 16, in units of 2^-bits."""
    return [[int(mpmath.ldexp(mpmath.rgamma(2 * i + (2 - order) * j + more), bits)) for more in (1, 2)]
            for i in range(16)]


#> delayed
def delayed(alpha, x0, step, t):
    """Return the solution of x'' + x + (1/2) D^{2 alpha} z (t - alpha h) = 0, v_0 = 1, Caputo. Its transform is a
    geometric series in (1 + e^{-alpha h s} s^{2 alpha} / 2) / s^2, which is inverted term by term, in whole numbers
    of 2^-bits. The powers of t below are under 2^60."""
    total, order, bits = 0, 2 * alpha, mpmath.mp.prec + 80
    fixed = lambda v: int(mpmath.ldexp(v, bits))
    for j in range(45):
        before, now, then = total, t - j * alpha * step, t - (j + 1) * alpha * step
        if now <= 0:
            break
        # (-1)^i binom(i + j, i) / (-2)^j, now^e and then^(e + 2 - order), e = 2i + (2 - order) j
        factor, of_now = fixed(mpmath.mpf(-0.5)**j), fixed(now**((2 - order) * j))
        of_then = fixed(then**((2 - order) * (j + 1))) if then > 0 else 0
        now, then = fixed(now), fixed(then)
        for i, ((G0, G1), (H0, H1)) in enumerate(zip(*(over_gammas(n, order, bits) for n in (j, j + 1)))):
            term = of_now * (x0 * G0 + (now * G1 >> bits)) + of_then * x0 * H0 // 2
            if order > 1:
                term += of_then * (then * H1 >> bits) // 2
            total += factor * (term >> bits) >> bits
            factor = -factor * (i + 1 + j) // (i + 1)
            of_now, of_then = of_now * now**2 >> 2 * bits, of_then * then**2 >> 2 * bits
        if abs(total - before) >> 80 == 0:
            break
    return mpmath.ldexp(total, -bits)
#< delayed


rows = []
for number in (0.15, 0.3, 0.5, 0.75):
    for count in (64, 128):
        text = []
        for k in range(1, 9):
            both = {}
            for digits in (20, 30):
                mpmath.mp.dps = digits + 15
                both[digits] = mpmath.nstr(delayed(mpmath.mpf(number), 1, mpmath.mpf(2) / count,
                                                   mpmath.mpf(k) / 4), digits)
            lo, hi = hexd(Q(both[20])), hexd(Q(both[30]))
            claim("the nearest double at both precisions", lo == hi)
            text.append(lo)
        rows.append([hexd(number), 1, count, "{ " + ", ".join(text) + " }", f"alpha = {number}"])
print("\n/* The delayed equation (9.7), t = 1/4, 1/2, ..., 2 */")
table("ref_delayed", "double alpha, x0; size_t steps; double x[8];", rows)
