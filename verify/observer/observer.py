"""Velocity, acceleration and a damper's force of a damped Duffing oscillator. Prints tests/observer/observer_ref.h.

    m x'' + c x + g x^3 + rho D^o (x - x0) = f0 + f1 t,     o = 3/5, 1, 7/5,

held before t = 0, with the momentum m v0. The solution is a series in t^{1/5}, because the exponents 2, o and 1 are
all multiples of 1/5: x = sum_k c_k t^{k/5}. Its coefficients follow from the rule D^o t^q = Gamma(1 + q) / Gamma(1 +
q - o) t^{q - o}. The coefficients give the velocity, the acceleration, the force lambda = rho D^o (x - x0), its
impulse and its work, term by term. Claimed: the equation of motion holds, the energy balance closes to 1e-20, and a
quarter more terms change nothing."""
from functools import cache
from operator import mul

from mpmath import gamma, ldexp, mp, mpf

from shared.refgen import claim, header, nearest, table

mp.dps = 50
TERMS = 1000
m, c, g, rho, x0, v0, f0, f1 = (mpf(n) for n in ("1.25", "1.5", "0.5", "0.375", "0.75", "0.5",
                                                "0.25", "-0.5"))
BITS = 300


def fixed(values):
    """Return whole numbers of these units."""
    return [int(ldexp(v, BITS)) for v in values]


def product(a, b, n):
    """Return coefficient n of a product of two series of whole numbers."""
    return sum(map(mul, a[:n + 1], b[n::-1])) >> BITS


@cache
def solve(o):
    """Return the coefficients of x, and the factors that turn them into those of D^o (x - x0)."""
    shift = int(5 * o)
    x, whole, square = [x0] + [mpf(0)] * (TERMS + 10), fixed([x0, *[0] * (TERMS + 10)]), []
    x[5] = v0
    whole[5:6] = fixed([v0])
    derivative = {j: gamma(1 + mpf(j) / 5) / gamma(1 + mpf(j - shift) / 5)
                  for j in range(5, TERMS + 11)}
    for n in range(-9, TERMS):
        k = n + 10
        if k == 5:
            continue
        right = f0 * (n == 0) + f1 * (n == 5)
        if 5 <= n + shift < k:
            right -= rho * x[n + shift] * derivative[n + shift]
        if n >= 0:
            square.append(product(whole, whole, n))
            right -= c * x[n] + g * ldexp(product(square, whole, n), -BITS)
        x[k] = right / (m * mpf(k) / 5 * (mpf(k) / 5 - 1)) if right else mpf(0)
        whole[k:k + 1] = fixed([x[k]])
    return x[:TERMS], derivative


def at(series, t):
    return sum(a * t ** (mpf(k) / 5) for k, a in series.items())


def slope(series):
    return {k - 5: a * mpf(k) / 5 for k, a in series.items() if k != 0 and a != 0}


def integral(series, t):
    return sum(a * t ** (mpf(k) / 5 + 1) / (mpf(k) / 5 + 1) for k, a in series.items())


def times(a, b, terms):
    """Return the product of two series up to t^{terms/5}. A series may begin with powers below 0."""
    low, other = min(a), min(b)
    count = terms - low - other
    u, w = ([*fixed(s.get(first + k, 0) for k in range(count))] for s, first in ((a, low), (b, other)))
    return {n + low + other: ldexp(product(u, w, n), -BITS) for n in range(count)}


@cache
def solution(o, terms):
    """Return the series of x, x' and lambda, of x^3, and of the powers lambda x' and (f0 + f1 t) x'."""
    x, derivative = solve(o)
    path = dict(enumerate(x[:terms]))
    velocity, force = slope(path), {j - int(5 * o): rho * x[j] * derivative[j] for j in range(5, terms)}
    return (path, velocity, force, times(times(path, path, terms), path, terms), times(force, velocity, terms),
            times({0: f0, 5: f1}, velocity, terms))


def row(o, t, terms):
    path, velocity, force, cube, power, power_of_push = solution(o, terms)
    values = [at(path, t), at(velocity, t), at(slope(velocity), t), at(force, t),
              integral(force, t), integral(power, t)]
    place, v, a, push, impulse, work = values
    claim("the equation of motion",
          abs(m * a + c * place + g * place**3 + push - f0 - f1 * t) < mpf(10) ** -20)
    by_force = integral(power_of_push, t)
    energy = [m * w**2 / 2 + c * y**2 / 2 + g * y**4 / 4 for w, y in ((v0, x0), (v, place))]
    claim("the energy balance", abs(energy[1] + work - by_force - energy[0]) < mpf(10) ** -20)
    claim("the impulse", abs(m * v0 - m * v + f0 * t + f1 * t**2 / 2 - impulse
                             - integral({k: c * w for k, w in path.items()}, t)
                             - integral({k: g * w for k, w in cube.items()}, t))
          < mpf(10) ** -20)
    return values + [by_force]


header(__file__)
rows = []
for o in (mpf(3) / 5, mpf(1), mpf(7) / 5):
    for t in (mpf(1) / 2, mpf(1)):
        values = row(o, t, TERMS)
        claim("enough terms", all(abs(u - w) < mpf(10) ** -20
                                  for u, w in zip(values, row(o, t, TERMS * 4 // 5))))
        rows.append([nearest(v) for v in (o / 2, t, *values)])
table("ref_duffing", "double alpha, t, x, v, a, force, impulse, work, by_force;", rows)
