"""What the modes of variable steps take over from a singular start, and what a step reads of it.

The memory after t1 knows the singular part by (22.20). Its integrals over all modes are sums of
25 digits, by the double exponential at the lower end; their derivatives by the order are
differences. Nothing is proved here; adjoint_mesh_pull.py asks."""
from functools import cache
from operator import mul

import mpmath
from mpmath import mp, mpf

from shared.adjoint_chain import numbers
from shared.arithmetic import real_function
from variable_steps import variable_steps as one

@cache
def rational(s):
    """a(mu) of (22.5) and p by partial fractions: lambda, P_lambda e_1 / b_1, over all lambda."""
    b, parts = numbers(s)[1], []
    for value, P in one.eigen(s, 100):
        twice = 2 if mpmath.im(value) > 0 else 1
        parts.append((value, [twice * P[i, 0] / b[0] for i in range(s)]))
    return b, parts


@cache
def reading(s, mu):
    b, parts = rational(s)
    a = [mpf(0)] * s
    for value, v in parts:
        by = 1 / (mu + value)
        a = [x + mpmath.re(y * by) for x, y in zip(a, v)]
    return a, mu * mpmath.fdot(a, b)


FINE, FINER = 200, 900   # bits behind the point


def whole(values, bits):
    return [int(mpmath.ldexp(v, bits)) for v in values]


class Moments:
    """I(a, S) for many a, by the series of (22.20) for S < 110, else by that for large S."""

    def __init__(self, exponents):
        self.near = [whole([1 / (a + k) for k in range(320)], FINE) for a in exponents]
        self.far = []
        for a in exponents:
            row = [mpf(1)]
            for k in range(1, 100):
                row.append(row[-1] * (k - a))
            self.far.append(whole(row, FINE))

    def at(self, S):
        """In units of 2^-FINE."""
        near, weights = S < 110, []
        term = mpmath.exp(-S) if near else 1 / S
        for k in range(320 if near else 100):
            weights.append(term)
            if k > S and term < mpf(10) ** -50:
                break
            term *= S / (k + 1) if near else 1 / S
        bits = FINE if near else FINER
        weights = whole(weights, bits)
        return [sum(map(mul, row, weights)) >> bits for row in (self.near if near else self.far)]


SPACING, HIGHEST = mpf(1) / 8, 70


def kernels(s, alpha, gap, J, t1, lengths):
    """For each step after t1, entry by entry of its stages, the integral over sigma of what it
    reads of modes that are e^{-S}, of those that are t1^b I(b, S) / Gamma(b), b = n gap, and, for
    beta > 0, of those that are -1; of these the first step has -h^{-beta} (A^{-1})^beta 1."""
    beta = 2 * alpha - 1
    b = [n * gap for n in range(1, J + 1)]
    moments, sizes = Moments(b), whole([t1**v * mpmath.rgamma(v) for v in b], FINE)
    modes, readings = [[] for _ in range(J + 2)], [[[] for _ in range(s)] for _ in lengths]
    lowest = mpmath.log((1 + beta if beta < 0 else beta) / 60)
    for l in range(int(lowest / SPACING), int(HIGHEST / SPACING)):
        u = SPACING * l
        tail = mpmath.exp(-u)
        sigma = mpmath.exp(u - tail)
        weight = SPACING * (1 + tail) * sigma ** (beta if beta > 0 else 1 + beta)
        told = whole([mpmath.exp(-sigma * t1)], FINE)
        told += [v * w >> FINE for v, w in zip(moments.at(sigma * t1), sizes)]
        for column, v in zip(modes, told + [-1 << FINE if beta > 0 else 0]):
            column.append(v)
        for h, rows in zip(lengths, readings):
            a, p = reading(s, h * sigma)
            for row, v in zip(rows, a):
                row.append(int(mpmath.ldexp(weight * v, FINE)))
            weight *= 1 - p
    size = mpmath.sinpi(abs(beta)) / mpmath.pi
    out = [[[size * mpmath.ldexp(sum(map(mul, row, column)), -2 * FINE) for column in modes] for row in rows]
           for rows in readings]
    if beta > 0:
        own = real_function(numbers(s)[3], lambda v: v**beta)
        for i in range(s):
            out[0][i][-1] = -lengths[0] ** -beta * sum(own[i, j] for j in range(s))
    return out


@cache
def tilted(s, alpha, falls, J, t1, lengths):
    """The same, and their derivatives by alpha: means and differences, 2 10^-16 apart."""
    with mp.workdps(50):
        e, turn = mpf(10) ** -16, -1 if falls else 1
        above, below = (kernels(s, v, turn * (2 - 2 * v), J, t1, lengths) for v in (alpha + e, alpha - e))
        return [[[((p + m) / 2, (p - m) / (2 * e)) for p, m in zip(*rows)] for rows in zip(*stages)]
                for stages in zip(above, below)]
