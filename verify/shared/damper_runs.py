"""Runs with several dampers as the chapter prints them, in complex numbers of 100 digits.

The derivative by a number is the imaginary part of a run in which this number has the imaginary part TINY. So nothing
is subtracted, and no adjoint run occurs. This file proves nothing."""
from functools import cache

import mpmath
from mpmath import mp, mpc, mpf

mp.dps = 100
TINY = mpf(10) ** -45

# The symbols of a term with factor 1. s and all numbers may be complex.
SYMBOLS = {
    "POWER": lambda s, a, T, e: s ** (2 * a),
    "ZENER": lambda s, a, T, e: s ** (2 * a) / (1 + T * s ** (2 * a)),
    "MAXWELL": lambda s, a, T, e: s / (1 + T * s),
    "DISTRIBUTED": lambda s, a, T, e: (s ** (2 * e) - s ** (2 * a)) / (2 * mpmath.log(s)),
    "MAXWELL2": lambda s, a, T, e: s ** (2 * a) / (1 + T * s ** (2 * (a - e))),
    "DAVIDSON": lambda s, a, T, e: (s / (1 + T * s)) ** (2 * a),
}
# Whether a term of this kind has an order, a time and an end.
HAS = {"POWER": (1, 0, 0), "ZENER": (1, 1, 0), "MAXWELL": (0, 1, 0), "DISTRIBUTED": (1, 0, 1),
       "MAXWELL2": (1, 1, 1), "DAVIDSON": (1, 1, 0)}


def growth(kind, factor, a, T, e):
    """Return the order with which a term grows for large s. It is 0 for a fraction with a relaxation time."""
    return {"POWER": 2 * a, "DISTRIBUTED": 2 * e, "MAXWELL2": 2 * e}.get(kind, 0)


def growth_of(terms):
    return max(mpmath.re(mpc(growth(*term))) for term in terms)


@cache
def circle(N):
    """Return points and their powers for coefficients up to z^N. Aliasing leaves an error of 10^-64 of the
    coefficients."""
    M, r = 32, mpf(1) / 100
    points = [r * mpmath.expjpi(mpf(2 * j) / M) for j in range(M)]
    return points, [[z ** -n / M for z in points] for n in range(N + 1)]


def coefficients(function, N):
    points, powers = circle(N)
    values = [function(z) for z in points]
    return [mpmath.fdot(row, values) for row in powers]


def symbol_of(terms):
    return lambda s: sum(factor * SYMBOLS[kind](s, *rest) for kind, factor, *rest in terms)


def is_power(terms):
    return len(terms) == 1 and terms[0][0] == "POWER"


@cache
def weights(method, terms, h, N):
    """Return V_n of C(delta(z)/h), with Euler's delta for fvi and fvi-shifted and BDF2's for the others. fvi-stable
    takes the mean of two weights, but for a single power the factor (13.16)."""
    a = terms[0][2]
    euler = lambda z: (1 - z) / h
    bdf2 = lambda z: (1 - z) * (3 - z) / 2 / h
    C = symbol_of(terms)
    if method == "stable" and is_power(terms):
        return coefficients(lambda z: C(euler(z)) * (mpf(1) / 2 + a + (mpf(1) / 2 - a) * z), N)
    if method == "stable":
        return coefficients(lambda z: C(bdf2(z)) * (1 + z) / 2, N)
    return coefficients(lambda z: C((bdf2 if method in ("bdf2", "node") else euler)(z)), N)


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
    return points, weights


def impulses(terms, h, N):
    """Return the impulses (26.20), h int (1 - u) q((k + u) h) du and h int u q du of all steps, where q is the
    inverse transform of C/s^2. For step 0 they are integrals of q, from the inverse transforms of C/s^3 and C/s^4."""
    points, weights = parabola(h, N)
    C = symbol_of(terms)
    values = [C(s) for s in points]
    found = [mpmath.fdot(row, values) for row in weights]
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


def product(A, x):
    return [mpmath.fdot(row, x) for row in A]


def solve(A, right):
    """Return x of A x = right. The matrix of a step needs no pivots."""
    d = len(right)
    rows = [[*row, r] for row, r in zip(A, right)]
    for k in range(d):
        for i in range(k + 1, d):
            f = rows[i][k] / rows[k][k]
            rows[i] = [a - f * b for a, b in zip(rows[i], rows[k])]
    x = [mpf(0)] * d
    for i in reversed(range(d)):
        x[i] = (rows[i][d] - mpmath.fdot(rows[i][i + 1:d], x[i + 1:])) / rows[i][i]
    return x
