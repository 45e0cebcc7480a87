"""The part of the memory that variable steps take over from a singular start.

The memory after t1 contains the singular part by (22.20). Its integrals over all modes are sums with 25 digits, by the
double exponential rule at the lower end. Their derivatives by the order are differences. This file proves nothing;
adjoint_mesh_singular.py uses it."""
from functools import cache
from operator import mul

import mpmath
from mpmath import mp, mpf
from mpmath.libmp import MPZ

from shared.adjoint_chain import numbers
from shared.arithmetic import real_function
from variable_steps import variable_steps as one

FINE, WIDE, EDGE = 200, 320, 110   # bits behind the point; the S from which on the series for large S is used
SLOT, HALF_SLOT = 720, 1 << 719    # sums of products of three numbers of FINE bits, side by side in one integer


def whole(v, bits=FINE):
    return int(mpmath.ldexp(v, bits))


@cache
def rational(s):
    """Return a(mu) of (22.5) and p by partial fractions: b, and lambda and P_lambda e_1 / b_1 over all lambda, in
    units of 2^-WIDE."""
    b, parts = numbers(s)[1], []
    units = lambda z: (whole(mpmath.re(z), WIDE), whole(mpmath.im(z), WIDE))
    for value, P in one.eigen(s, 100):
        twice = 2 if mpmath.im(value) > 0 else 1
        parts.append((units(value), [units(twice * P[i, 0] / b[0]) for i in range(s)]))
    return [whole(v, WIDE) for v in b], parts


@cache
def reading(s, mu):
    """Return a(mu) and 1 - p(mu), in units of 2^-WIDE."""
    b, parts = rational(s)
    mu, a = whole(mu, WIDE), [0] * s
    for (re, im), v in parts:
        size = (mu + re)**2 + im**2
        by_re, by_im = (mu + re << 2 * WIDE) // size, (im << 2 * WIDE) // size
        a = [x + (y_re * by_re + y_im * by_im >> WIDE) for x, (y_re, y_im) in zip(a, v)]
    return a, (1 << WIDE) - (mu * sum(map(mul, a, b)) >> 2 * WIDE)


@cache
def powers_of(S):
    """Return e^-S S^k / k! for S < EDGE, else EDGE^k / S^(k + 1), for all k up to the last that is not negligible."""
    bits, weights = 2 * FINE, []      # e^-S is small, so more bits are needed
    if S < EDGE:
        term, z = whole(mpmath.exp(-S), bits), whole(S, bits)
        while len(weights) <= S or term >> FINE:
            weights.append(term >> FINE)
            term = (term * z >> bits) // len(weights)
    else:
        term, z = whole(1 / S, bits), whole(EDGE / S, bits)
        while term >> FINE and len(weights) < 100:
            weights.append(term >> FINE)
            term = term * z >> bits
    return weights


def joined(numbers):
    return sum(MPZ(v) << SLOT * n for n, v in enumerate(numbers))


@cache
def halves(count):
    return joined([HALF_SLOT] * count)


def taken_apart(total, count):
    total += halves(count)
    return [(total >> SLOT * n & 2 * HALF_SLOT - 1) - HALF_SLOT for n in range(count)]


class Moments:
    """I(a, S) / Gamma(a) for many a, by the series of (22.20) for S < EDGE, else by the series for large S. The
    coefficients of each power of S are joined in one integer; those of the n-th a are in slot n, n >= 1."""

    def __init__(self, exponents):
        near, far = [[0] * 320], [[0] * 100]
        for a, unit in ((whole(a), whole(mpmath.rgamma(a))) for a in exponents):
            near.append([(unit << FINE) // (a + (k << FINE)) for k in range(320)])
            row = [unit]
            for k in range(1, 100):
                row.append(row[-1] * ((k << FINE) - a) // (EDGE << FINE))
            far.append(row)
        self.near, self.far = ([joined(column) for column in zip(*rows)] for rows in (near, far))

    def at(self, S):
        """Return the sums for this S, in units of 2^-(2 FINE)."""
        return sum(map(mul, self.near if S < EDGE else self.far, powers_of(S)))


SPACING, HIGHEST = mpf(1) / 8, 70


@cache
def node(l):
    """Return sigma, its logarithm, and the derivative of the logarithm by the variable of the sum."""
    tail = mpmath.exp(-SPACING * l)
    return mpmath.exp(SPACING * l - tail), SPACING * l - tail, 1 + tail


@cache
def fallen(S):
    return whole(mpmath.exp(-S)) if S < FINE else 0       # e^-S is below one unit of 2^-FINE


def kernels(s, alpha, gap, J, t1, lengths):
    """Return for each step after t1 and each of its stages the integral over sigma of the step's reading of these
    modes: e^{-S}; I(b, S) / Gamma(b) for b = n gap; and, if beta > 0, -1. To the reading of the modes -1 the first
    step adds -h^{-beta} (A^{-1})^beta 1."""
    beta = 2 * alpha - 1
    moments, rest = Moments([n * gap for n in range(1, J + 1)]), joined([0] * (J + 1) + [-(beta > 0) << 2 * FINE])
    modes, readings = [], [[[] for _ in range(s)] for _ in lengths]
    lowest = mpmath.log((1 + beta if beta < 0 else beta) / 60)
    for l in range(int(lowest / SPACING), int(HIGHEST / SPACING)):
        sigma, logarithm, slope = node(l)
        modes.append((fallen(sigma * t1) << FINE) + moments.at(sigma * t1) + rest)
        weight = whole(SPACING * slope * mpmath.exp((beta if beta > 0 else 1 + beta) * logarithm), WIDE)
        for h, rows in zip(lengths, readings):
            a, kept = reading(s, h * sigma)
            for row, v in zip(rows, a):
                row.append(weight * v >> 2 * WIDE - FINE)
            weight = weight * kept >> WIDE
    size = mpmath.sinpi(abs(beta)) / mpmath.pi
    out = [[[size * mpmath.ldexp(v, -3 * FINE) for v in taken_apart(sum(map(mul, row, modes)), J + 2)]
            for row in rows] for rows in readings]
    if beta > 0:
        own = real_function(numbers(s)[3], lambda v: v**beta)
        for i in range(s):
            out[0][i][-1] = -lengths[0] ** -beta * sum(own[i, j] for j in range(s))
    return out


@cache
def tilted(s, alpha, falls, J, t1, lengths):
    """Return the same with the derivatives by alpha, as means and differences of two orders 2 10^-16 apart."""
    with mp.workdps(50):
        e, turn = mpf(10) ** -16, -1 if falls else 1
        above, below = (kernels(s, v, turn * (2 - 2 * v), J, t1, lengths) for v in (alpha + e, alpha - e))
        return [[[((p + m) / 2, (p - m) / (2 * e)) for p, m in zip(*rows)] for rows in zip(*stages)]
                for stages in zip(above, below)]
