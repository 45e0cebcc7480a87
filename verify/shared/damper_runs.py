"""Runs with several dampers as the chapter prints them, in complex numbers of 100 digits.

The derivative by a number is the imaginary part of a run in which this number has the imaginary part TINY. So nothing
is subtracted, and no adjoint run occurs. This file proves nothing."""
from functools import cache
from operator import mul

import mpmath
from mpmath import mp, mpc, mpf
from mpmath.libmp import to_fixed

mp.dps = 100
TINY = mpf(10) ** -45

# The symbols of a term with factor 1 at all points of S. The points and all numbers may be complex.
SYMBOLS = {
    "POWER": lambda S, a, T, e: S.power(2 * a),
    "ZENER": lambda S, a, T, e: [q / (1 + T * q) for q in S.power(2 * a)],
    "MAXWELL": lambda S, a, T, e: [s / (1 + T * s) for s in S.points],
    "DISTRIBUTED": lambda S, a, T, e: [(v - u) / (2 * L) for v, u, L in zip(S.power(2 * e), S.power(2 * a), S.logarithms)],
    "MAXWELL2": lambda S, a, T, e: [q / (1 + T * u) for q, u in zip(S.power(2 * a), S.power(2 * (a - e)))],
    "DAVIDSON": lambda S, a, T, e: [(s / (1 + T * s)) ** (2 * a) for s in S.points],
}
# Whether a term of this kind has an order, a time and an end.
HAS = {"POWER": (1, 0, 0), "ZENER": (1, 1, 0), "MAXWELL": (0, 1, 0), "DISTRIBUTED": (1, 0, 1),
       "MAXWELL2": (1, 1, 1), "DAVIDSON": (1, 1, 0)}


def growth(kind, factor, a, T, e):
    """Return the order with which a term grows for large s. It is 0 for a fraction with a relaxation time."""
    return {"POWER": 2 * a, "DISTRIBUTED": 2 * e, "MAXWELL2": 2 * e}.get(kind, 0)


def growth_of(terms):
    return max(mpmath.re(mpc(growth(*term))) for term in terms)


class Points:
    """Points s, and all that was found there. Runs differ in one number, so they share most powers and symbols."""

    def __init__(self, points):
        self.points, self.logarithms, self.powers, self.terms = points, [mpmath.log(s) for s in points], {}, {}

    def power(self, order):
        """Return s^order at all points."""
        if order not in self.powers:
            self.powers[order] = [mpmath.exp(order * L) for L in self.logarithms]
        return self.powers[order]

    def symbol(self, kind, *numbers):
        """Return the symbol of a term with factor 1 at all points; numbers: order, time, end."""
        if (kind, *numbers) not in self.terms:
            self.terms[kind, *numbers] = SYMBOLS[kind](self, *numbers)
        return self.terms[kind, *numbers]

    def law(self, terms):
        """Return the symbol of a law at all points."""
        values = [[factor * v for v in self.symbol(kind, *numbers)] for kind, factor, *numbers in terms]
        return [sum(v) for v in zip(*values)]


# Sums of products are taken in whole numbers, in units of 2^-BITS, because mpmath's are ten times slower.
BITS = 420


def whole(values):
    """Return all real parts, then all imaginary parts, as whole numbers."""
    return [to_fixed(mpmath.re(v)._mpf_, BITS) for v in values] + [to_fixed(mpmath.im(v)._mpf_, BITS) for v in values]


def weights_of(values):
    """Return two rows of whole numbers: times whole(...) they give the real and the imaginary part of a sum of products
    with `values`."""
    both, n = whole(values), len(values)
    return both[:n] + [-v for v in both[n:]], both[n:] + both[:n]


def products(rows, values):
    """Return the sums of products of `values` with each row, a result of weights_of."""
    values = whole(values)
    return [mpc(*(mpmath.ldexp(sum(map(mul, part, values)), -2 * BITS) for part in row)) for row in rows]


@cache
def circle(N):
    """Return points and weights for coefficients up to z^N. Aliasing leaves an error of 10^-64 of the coefficients."""
    M, r = 32, mpf(1) / 100
    points = [r * mpmath.expjpi(mpf(2 * j) / M) for j in range(M)]
    return points, [weights_of([z ** -n / M for z in points]) for n in range(N + 1)]


@cache
def around(h, bdf2):
    """Return Euler's or BDF2's delta(z)/h at the points of the circle."""
    return Points([(1 - z) * (3 - z) / 2 / h if bdf2 else (1 - z) / h for z in circle(0)[0]])


def is_power(terms):
    return len(terms) == 1 and terms[0][0] == "POWER"


@cache
def weights(method, terms, h, N):
    """Return V_n of C(delta(z)/h), with Euler's delta for fvi and fvi-shifted and BDF2's for the others. fvi-stable
    takes the mean of two weights, but for a single power the factor (13.16)."""
    a = terms[0][2]
    points, rows = circle(N)
    stable_power = method == "stable" and is_power(terms)
    C = around(h, method in ("bdf2", "node") or method == "stable" and not stable_power).law(terms)
    if stable_power:
        C = [v * (mpf(1) / 2 + a + (mpf(1) / 2 - a) * z) for v, z in zip(C, points)]
    elif method == "stable":
        C = [v * (1 + z) / 2 for v, z in zip(C, points)]
    return products(rows, C)


@cache
def parabola(h, N):
    """Return Laplace's inverse for t = h, ..., N h, with poles up to 100 inside: its points s, and for each impulse
    of (26.20) the weights of the symbol at these points. The weights do not depend on the numbers of a law."""
    mu, spacing = 30 / (N * h), mpf("0.042")
    points, weights = [], [[] for _ in range(2 * N)]
    for u in [1 + 1j * spacing * (j + mpf(0.5)) for j in range(-205, 205)]:
        s, ds = mu * u * u, mu / mpmath.pi * spacing * u  # ds divided by 2 pi i
        z = s * h
        f = mpmath.exp(z)
        power = h * ds / (s * s) * f / (z * z)
        points.append(s)
        weights[0].append(power)
        weights[1].append(power * (z - 1))
        for k in range(1, N):
            weights[2 * k].append(power * (f - 1 - z))
            weights[2 * k + 1].append(power * (f * (z - 1) + 1))
            power *= f
    return Points(points), [weights_of(row) for row in weights]


def impulses(terms, h, N):
    """Return the impulses (26.20), h int (1 - u) q((k + u) h) du and h int u q du of all steps, where q is the
    inverse transform of C/s^2. For step 0 they are integrals of q, from the inverse transforms of C/s^3 and C/s^4."""
    points, weights = parabola(h, N)
    found = products(weights, points.law(terms))
    return list(zip(found[::2], found[1::2]))


def impulses_of_power(terms, h, N, e):
    """Return (19.5): h^(1 + e) rho times the integrals of (1 - s) and s times (k + s)^e / Gamma(1 + e)."""
    e = e if e != -1 else e + mpf(10) ** -70  # the limit for the order 2
    power, out = [mpf(0)] + [mpf(k) ** e for k in range(1, N + 1)], []
    for k in range(N):
        whole = ((k + 1) * power[k + 1] - k * power[k]) / (1 + e)
        moment = ((k + 1) ** 2 * power[k + 1] - k**2 * power[k]) / (2 + e)
        scale = terms[0][1] * mpmath.rgamma(1 + e) * h ** (1 + e)
        out.append((scale * (whole - moment + k * whole), scale * (moment - k * whole)))
    return out


@cache
def start_impulses(past, terms, h, N):
    """Return the impulses of a past for the amplitude 1; None if it has none."""
    g = growth_of(terms)
    if past == "held" and g > 1:
        return impulses_of_power(terms, h, N, 1 - 2 * terms[0][2]) if is_power(terms) else impulses(terms, h, N)
    if past == "rl" and g < 1:
        return impulses_of_power(terms, h, N, -2 * terms[0][2])
    return None


def tilted(terms, j, l, i):
    """Return the kernels of all dampers, where number i of term l of damper j has the imaginary part TINY."""
    return [tuple((kind, *(v + mpc(0, TINY) if (a, b, c) == (j, l, i) else v for c, v in enumerate(numbers)))
                  for b, (kind, *numbers) in enumerate(kernel)) for a, kernel in enumerate(terms)]


def numbers_of(terms):
    """Return the positions of all numbers of the laws: (damper, term, number)."""
    return [(j, l, i) for j, kernel in enumerate(terms) for l, (kind, *_) in enumerate(kernel)
            for i in range(4) if i == 0 or HAS[kind][i - 1]]


def slope(J):
    return mpmath.im(J) / TINY
