"""H 23. Derivatives with respect to the exponents and times of a law of damping.

Proved here:
  (23.21) the derivatives of each symbol with respect to its numbers, in terms of the symbol and ln s; and that the
          coefficients of a power series in delta(z)/h are differentiated by the same products:
          for Euler's and BDF2's delta, up to z^5, all numbers symbols;
  (23.22) the series of ln(delta(z)/h), up to z^6.
Printed: derivatives of runs of two masses by fvi, fvi-bdf2 and fvi-stable as they are written in the chapters, by
dual numbers of 45 digits, with weights from complex steps of 10^-45 with 100 digits; and derivatives of runs of five
masses with stages, form D, with the symbol differentiated by a difference over 10^-20."""
from functools import cache
from random import Random

import mpmath
from mpmath import mp, mpc, mpf
from sympy import Rational, cancel, diff, exp, integrate, log, series, simplify, symbols

from shared.adjoint_chain import D5, N as N6, LawChain, numbers
from shared.arithmetic import HALF, TINY, UNITS, ZERO, Dual, apart, dot, dual
from shared.damper_runs import HAS, Points, parabola, products
from shared.refgen import METHODS, claim, header, hexd, nearest, prove, table

# ---- the symbols ----

#> symbols
a, e, T, L, x, z, h = symbols("a e T L x z h", positive=True)
q = exp(2 * a * L)  # s^{2a}, L = ln s
C = q / (1 + T * q)
prove("(23.21) a fraction by its order", diff(C, a) - 2 * L * C * (1 - T * C))
prove("(23.21) by its time", diff(C, T) + C**2)
maxwell = exp(L) / (1 + T * exp(L))
prove("(23.21) a Maxwell element by its time", diff(maxwell, T) + maxwell**2)
span = integrate(exp(2 * x * L), (x, a, e))
prove("(23.21) a range by its ends", diff(span, a) + exp(2 * a * L), diff(span, e) - exp(2 * e * L))
#< symbols


def truncated(f, n):
    return series(f, z, 0, n).removeO().expand()


for delta in (1 - z, (1 - z) * (3 - z) / 2):
    rational = (delta / h) / (1 + T * delta / h)  # 2 a = 1, where every function is rational
    weights = [cancel(truncated(rational, 6).coeff(z, n)) for n in range(6)]
    squares = [sum(weights[j] * weights[n - j] for j in range(n + 1)) for n in range(6)]
    for n in range(6):
        prove(f"(23.21) the weights, z^{n}", diff(weights[n], T) + squares[n])
    power = truncated((delta / h) ** (2 * a), 5)
    logarithm = truncated(log(delta / h), 5)
    for n in range(5):
        product = sum(power.coeff(z, j) * logarithm.coeff(z, n - j) for j in range(n + 1))
        prove(f"(23.21) the weights of a power, z^{n}", diff(power.coeff(z, n), a) - 2 * product)
logarithm = truncated(log((1 - z) * (3 - z) / 2 / h), 7)
claim("(23.22)", simplify(logarithm.coeff(z, 0) - log(Rational(3, 2)) + log(h)) == 0 and all(
    logarithm.coeff(z, n) == -Rational(1, n) * (1 + Rational(1, 3) ** n) for n in range(1, 7)))

# ---- runs without stages ----

mp.dps = 100
N, D, STEP = 12, 2, mpf(1) / 16


def times(u, v):
    return [sum(u[j] * v[n - j] for j in range(n + 1)) for n in range(N + 1)]


def over(u, v):
    out = []
    for n in range(N + 1):
        out.append((u[n] - sum(v[j] * out[n - j] for j in range(1, n + 1))) / v[0])
    return out


def power(order, bdf2):
    """Return the coefficients of (delta(z)/h)^order."""
    w, g = [STEP**-order], [mpf(1.5) ** order if bdf2 else mpc(1)]
    for n in range(1, N + 1):
        w.append(w[-1] * (n - 1 - order) / n)
        g.append(g[-1] * (n - 1 - order) / n / 3 if bdf2 else mpc(0))
    return times(w, g)


def symbol(kind, a, T, e, bdf2):
    if kind == "DISTRIBUTED":
        ln = [-mpmath.log(STEP / (1.5 if bdf2 else 1))]
        ln += [-(1 + (mpf(3) ** -n if bdf2 else 0)) / n for n in range(1, N + 1)]
        return over([u - v for u, v in zip(power(2 * e, bdf2), power(2 * a, bdf2))], [2 * v for v in ln])
    top = power(mpf(1) if kind == "MAXWELL" else 2 * a, bdf2)
    if kind == "POWER":
        return top
    return over(top, [(n == 0) + T * v for n, v in enumerate(top)])


def impulses(kind, a, T, e):
    """Return the impulses (26.20), h int (1 - u) q((k + u) h) du and h int u q du of all steps, where q is the
    inverse transform of C/s^2. For step 0 they are integrals of q, from the inverse transforms of C/s^3 and C/s^4."""
    points, weights = parabola(STEP, N)
    return products(weights, points.symbol(kind, a, T, e))


def growth(kind, factor, a, T, e):
    """Return the order with which a term grows for large s. It is 0 for a fraction with a relaxation time."""
    return 2 * a if kind == "POWER" or kind == "ZENER" and T == 0 else \
        2 * e if kind == "DISTRIBUTED" else int(kind == "MAXWELL" and T == 0)


def grows(method, terms):
    """Return whether the start has impulses, that is, whether some term grows faster than s."""
    return method != "fvi" and max(growth(*term) for term in terms) > 1


def of_terms(terms, find, count):
    """Return `count` dual numbers, the sum over all terms with the slopes by all numbers of the terms. find(kind,
    order, time, end) computes the numbers of a term of factor 1."""
    out = [ZERO] * count
    for l, (kind, *numbers) in enumerate(terms):
        for i, v in enumerate(numbers):
            if i and not HAS[kind][i - 1]:
                continue
            factor, *tilted = [v + mpc(0, TINY) if j == i else v for j, v in enumerate(numbers)]
            found = [dual(factor * u, UNITS[3 * i + l]) for u in find(kind, *tilted)]
            out = [u + (v if i == 0 else Dual(0, v.d)) for u, v in zip(out, found)]  # values once, slopes each time
    return out


def weights(method, terms):
    """Return V_n of all terms as dual numbers; for fvi-stable by (26.15). terms: (kind, factor, order, time, end),
    where each number has its own slope."""
    w = of_terms(terms, lambda *term: symbol(*term, method != "fvi"), N + 1)
    return [HALF * (u + v) for u, v in zip(w, [ZERO] + w)] if method == "stable" else w


def run(method, kappa, terms, data):
    """Return J = (h/2) sum_{k>=1} |x_k - sin t_k|^2 + sum_i x_N,i/2 + x_N,i p_N,i^2/4 of a run with U = sum c x^2/2 +
    g x^4/4 and F = cos(5t/4)/5."""
    h, w, J, printed = dual(STEP), weights(method, terms), ZERO, method == "fvi"
    theta = HALF if method == "stable" else ZERO
    c, g = data["cg"]
    rest, whole, three = dual(1 - kappa), dual(mpf(1)), dual(mpf(3))
    grad = lambda S: (c + g * S * S) * S
    F = [dual(mpmath.cos(5 * k * STEP / 4) / 5) for k in range(N + 1)]
    start_impulses = of_terms(terms, impulses, 2 * N) if grows(method, terms) else None  # (26.20)
    for x0, p0, m, rho in zip(data["x0"], data["p0"], data["mass"], data["rho"]):
        x, p, z, H = x0, p0, [ZERO], ZERO
        inertia = m / h + theta * rho * h * w[0]
        v0 = p0 / m if start_impulses else ZERO
        for k in range(N):
            if not printed:
                p = p + HALF * h * F[k] - (HALF - theta) * rho * h * H
            if start_impulses:
                p = p - rho * v0 * start_impulses[2 * k]
            known = w[0] * (x - x0 - dual((k + 1) * STEP) * v0) + dot(w[1:k + 2], z[::-1])
            d, right = ZERO, p - theta * rho * h * known
            for _ in range(9):
                S = x + rest * d
                d -= ((inertia * d + dual(kappa) * h * grad(S) - right)
                      / (inertia + dual(kappa) * rest * h * (c + three * g * S * S)))
            gradient, x, H = grad(x + rest * d), x + d, known + w[0] * d
            z.append(x - x0 - dual((k + 1) * STEP) * v0)
            p = p + (h if printed else HALF * h) * F[k + 1] - h * gradient
            p = p - (whole if printed else HALF + theta) * rho * h * H
            if start_impulses:
                p = p - rho * v0 * start_impulses[2 * k + 1]
            off = x - dual(mpmath.sin((k + 1) * STEP))
            J += HALF * h * off * off
        J += HALF * x * (whole + HALF * p * p)
    return J


KINDS = ["POWER", "ZENER", "MAXWELL", "DISTRIBUTED"]
EDGES = [[("POWER", 0.0, 1.0, 1.0), ("POWER", 0.5, 1.0, 1.0), ("POWER", 1.0, 1.0, 1.0)],
         [("ZENER", 0.0, 0.75, 1.0), ("ZENER", 0.5, 0.75, 1.0), ("ZENER", 0.75, 0.0, 1.0)],
         [("ZENER", 0.875, 0.5, 1.0), ("MAXWELL", 0.25, 0.0, 1.0), ("DISTRIBUTED", 0.0, 1.0, 1.0)],
         [("DISTRIBUTED", 0.5, 1.0, 0.75), ("MAXWELL", 0.25, 0.0625, 1.0), ("POWER", 0.75, 1.0, 1.0)]]


def literal(values):
    return "{ " + ", ".join(values) + " }"


def doubles(values):
    return literal(hexd(Rational(v)) for v in values)


def law(terms):
    return literal(f"{{ FVI_KERNEL_{kind}, {', '.join(hexd(Rational(v)) for v in numbers)} }}"
                   for kind, *numbers in terms)


def drawn(random, which, most):
    """Return three random terms (kind, rho, alpha, time, end)."""
    uniform = lambda a, b: round(random.uniform(a, b) * 2**20) / 2**20
    if which < len(EDGES):
        return [(kind, uniform(0.1, 0.6), a, T, e) for kind, a, T, e in EDGES[which]]
    out = []
    for l in range(3):
        kind, a = KINDS[(which + l) % 4], uniform(0, most)
        out.append((kind, uniform(0.1, 0.6), a, uniform(0.05, 2), uniform(a + 0.02, 1)))
    return out


def derivatives(method, kappa, terms, data):
    """Return the derivatives of J by the factors of all terms, then by their orders, times and ends."""
    terms = [(kind, *map(mpf, numbers)) for kind, *numbers in terms]
    return apart(run(method, kappa, terms, {k: [dual(mpf(v)) for v in u] for k, u in data.items()}).d, 12)


random, rows = Random(2321), []
uniform = lambda a, b: round(random.uniform(a, b) * 2**20) / 2**20
for which in range(12):
    for method in ("fvi", "bdf2", "stable"):
        terms = drawn(random, which, 0.97)
        data = dict(x0=[uniform(-1, 1) for _ in range(D)], p0=[uniform(-1, 1) for _ in range(D)],
                    mass=[uniform(0.5, 2) for _ in range(D)], rho=[uniform(0.2, 1.5), 0.5],
                    cg=[uniform(0.5, 2), uniform(0.2, 1)])
        kappa = 0.5 if method == "stable" else uniform(0.2, 0.8)
        want = derivatives(method, mpf(kappa), terms, data)
        rows.append([f"&fvi_{METHODS[method]}", hexd(Rational(kappa)), law(terms)]
                    + [doubles(data[k]) for k in ("x0", "p0", "mass", "rho", "cg")]
                    + [literal(map(nearest, want))])

# ---- runs with stages ----

mp.dps = 60
SMALL = mpf(10) ** -20
place = cache(lambda v: Points([v]))


def symbol_at(v, kind, *numbers):
    return place(v).symbol(kind, *numbers)[0]


def slope_of(kind, numbers, which):
    """Return the derivative of the symbol by one of its numbers, as a central difference; its error is of the order
    SMALL^2."""
    up, down = ([v + (sign if i == which else 0) for i, v in enumerate(numbers)] for sign in (SMALL, -SMALL))
    return lambda v: (symbol_at(v, kind, *up) - symbol_at(v, kind, *down)) / (2 * SMALL)


staged = []
SERIES = [("MAXWELL2", 0.375, 0.75, 0.625, 0.375), ("ZENER", 0.5, 0.3125, 0.75, 1.0), ("MAXWELL2", 0.25, 0.5, 1.5, 0.125)]
for which in range(12):
    s, terms = 2 + which % 3, SERIES if which >= 10 else drawn(random, which, 0.97)
    data = dict(x0=[uniform(-1, 1) for _ in range(D5)], p0=[uniform(-1, 1) for _ in range(D5)],
                mass=[uniform(0.5, 2) for _ in range(D5)],
                rho=[0.0 if i == which % D5 else uniform(0, 1.5) for i in range(D5)],
                cg=[uniform(0.5, 2), uniform(0.2, 1)])
    plain = [lambda v, k=kind, n=tuple(map(mpf, rest)): symbol_at(v, k, *n) for kind, _, *rest in terms]
    slopes = [(3 * number + l, slope_of(kind, list(map(mpf, rest)), number), mpf(factor))
              for number in range(3) for l, (kind, factor, *rest) in enumerate(terms) if HAS[kind][number]]
    q = {k: [dual(mpf(v)) for v in w] for k, w in data.items()}
    q["terms"] = [dual(mpf(t[1])) for t in terms] + [dual(mpf(0))] * len(slopes)
    nodes = numbers(s)[0]
    at = [(k + nodes[i]) * STEP for k in range(N6) for i in range(s - 1)] + [N6 * STEP]
    q["F"] = [dual(mpmath.cos(5 * v / 4) / 5) for v in at for _ in range(D5)]
    chain = LawChain(s, plain + [f for _, f, _ in slopes], q, STEP)  # slopes: terms of factor 0
    want = chain.slopes([("terms", i) for i in range(3 + len(slopes))])
    own, want = want[3:], want[:3] + [mpf(0)] * 9
    for (number, _, factor), slope in zip(slopes, own):
        want[3 + number] = factor * slope
    staged.append([f"&fvi_lobatto_d{s}", law(terms)]
                  + [doubles(data[k]) for k in ("x0", "p0", "mass", "rho", "cg")]
                  + [literal(map(nearest, want))])

header("verify/adjoint/adjoint_laws.py")
print("""
/* Two Duffing springs, F = cos(5t/4)/5, h = 1/16, twelve steps, a law of three terms; dJ, J as in
   to_sine, by rho, alpha, time and end of each term, 0 where it has none */""")
table("ref_law_numbers", "const fvi_method *method; double kappa; fvi_kernel_term term[3]; double x0[2], p0[2], "
      "mass[2], rho[2], cg[2], want[12];", rows)
print("""
/* The same of a chain of five masses, form D, six steps */""")
table("ref_stage_law_numbers", "const fvi_method *method; fvi_kernel_term term[3]; double x0[5], p0[5], mass[5], "
      "rho[5], cg[2], want[12];", staged)
