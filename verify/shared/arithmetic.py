"""Arithmetic that several proofs share: functions of matrices, and dual numbers.

mpmath is slow on matrices, so sums of products are taken in integers: a number is an integer times 2^-bits, with more
bits than the requested precision."""
from functools import reduce
from math import prod
from operator import mul, or_

import mpmath
from mpmath import mp
from mpmath.libmp import MPZ

from shared.refgen import claim

# -- functions of matrices ---------------------------------------------------------------


def whole_dot(a, b):
    return sum(map(mul, a, b))


def units(z, bits):
    return int(mpmath.ldexp(mpmath.re(z), bits)), int(mpmath.ldexp(mpmath.im(z), bits))


def rough_roots(p):
    """Return the zeros of a polynomial in doubles, all at once by the method of Durand and Kerner."""
    value = lambda z: reduce(lambda total, c: total * z + c, p)
    roots = [(0.4 + 0.9j)**k * max(map(abs, p))**(1 / len(p)) for k in range(len(p) - 1)]
    for _ in range(500):
        change = 0
        for i, z in enumerate(roots):
            step = value(z) / prod(z - other for other in roots if other is not z)
            roots[i], change = z - step, max(change, abs(step))
        if change < 1e-8:
            break
    return [mpmath.mpmathify(z) for z in roots]


def spectrum(M):
    """Return the spectrum of a matrix of mpmath with different eigenvalues l: the l; for each l the polynomial
    chi(x)/((x - l) chi'(l)), which is 1 there and 0 at the others; the powers 1, M, ..., M^(s-1), entry by entry,
    real parts before imaginary ones; and the bits."""
    s, bits = M.rows, mp.prec + 64
    columns = [[re for re, _ in column] + [im for _, im in column]
               for column in ([units(M[i, j], bits) for i in range(s)] for j in range(s))]
    powers, traces = [[[(int(i == j) << bits, 0) for j in range(s)] for i in range(s)]], []
    for _ in range(s):
        product = []
        for row in powers[-1]:
            re, im = map(list, zip(*row))
            straight, turned = re + [-v for v in im], im + re
            product.append([(whole_dot(straight, c) >> bits, whole_dot(turned, c) >> bits) for c in columns])
        powers.append(product)
        traces.append(mpmath.mpc(*(mpmath.ldexp(sum(product[i][i][part] for i in range(s)), -bits)
                                   for part in (0, 1))))
    chi = [mpmath.mpc(1)]                       # from the highest power on, by Newton's identities
    for k in range(1, s + 1):
        chi.append(-sum(chi[k - i] * traces[i - 1] for i in range(1, k + 1)) / k)
    roots = rough_roots([complex(c) for c in chi])
    steps, small = [1], mpmath.mpf(10)**(20 - mp.dps)
    for _ in range(5):                          # each step of Newton's method doubles the digits
        if max(map(abs, steps)) < small:
            break
        steps = [mpmath.fdiv(*mpmath.polyval(chi, root, derivative=True)) for root in roots]
        roots = [root - step for root, step in zip(roots, steps)]
    claim("the eigenvalues have converged, to different numbers", max(map(abs, steps)) < small and
          min(abs(a - b) for i, a in enumerate(roots) for b in roots[:i] or [a + 1]) > mpmath.mpf(10)**-6)
    basis = []
    for root in roots:
        q = [mpmath.mpc(1)]
        for c in chi[1:s]:
            q.append(c + root * q[-1])
        slope = mpmath.polyval(q, root)
        basis.append([c / slope for c in q[::-1]])
    entries = [[power[i][j][part] for part in (0, 1) for power in powers[:s]]
               for i in range(s) for j in range(s)]
    return roots, basis, entries, bits


def function_of(parts, f):
    """Return f(M), row by row, in units of 2^-(2 bits); parts are spectrum(M)."""
    roots, basis, entries, bits = parts
    values = [f(root) for root in roots]
    re, im = zip(*(units(mpmath.fdot(values, c), bits) for c in zip(*basis)))
    straight, turned = re + tuple(-v for v in im), im + re
    return [(whole_dot(straight, e), whole_dot(turned, e)) for e in entries]


def circle(symbol, radius, count):
    """Return for half a circle of count points: the points z, their weights in a mean over the whole circle if
    conjugates represent the other half, and the spectra of symbol(z)."""
    points = [mpmath.expjpi(mpmath.mpf(2 * j) / count) * radius for j in range(count // 2 + 1)]
    return [(z, mpmath.mpf(1 if z.imag == 0 else 2) / count, spectrum(symbol(z))) for z in points]


def coefficients(points, f, orders):
    """Return {n: the coefficient of z^n in f(symbol(z))}, by Cauchy's integral over a circle. The error is aliasing:
    radius^count times coefficients of later powers."""
    found = [function_of(parts, f) for _, _, parts in points]
    bits = points[0][2][3]
    entries = [[v[part] for part in (0, 1) for v in entry] for entry in zip(*found)]
    W, s = {}, len(points[0][2][0])
    for n in orders:
        re, im = zip(*(units(share * z**-n, bits) for z, share, _ in points))
        turned = re + tuple(-v for v in im)
        values = [mpmath.ldexp(whole_dot(turned, e), -3 * bits) for e in entries]
        W[n] = mpmath.matrix([values[s * i:s * i + s] for i in range(s)])
    return W


def real_function(M, f):
    """Return the real part of f(M)."""
    return coefficients([(mpmath.mpf(1), mpmath.mpf(1), spectrum(M))], f, [0])[0]


# -- dual numbers -----------------------------------------------------------------------
# 45 digits, of which 30 are printed. With 240 bits instead of 150 no derivative of H 23 changed by more than 4 10^-38
# of itself.
BITS, TINY = 150, mpmath.mpf(10) ** -45
# Slopes by up to 28 numbers stand side by side in one integer, with ROOM bits for each. So one run gives them all,
# and a product with a value is one product. mpmath provides these long integers; they are gmpy2's if it is installed.
ROOM = 420
UNITS = [MPZ(1) << ROOM * i for i in range(28)]
MIDDLE = sum(unit << ROOM - 1 for unit in UNITS)
KEPT, LOWER = sum(unit * ((1 << ROOM - BITS) - 1) for unit in UNITS), MIDDLE >> BITS


def down(d):
    """Return each slope divided by 2^BITS, rounded down. The mask KEPT keeps the lost bits of one slope out of its
    neighbour."""
    return (d + MIDDLE >> BITS & KEPT) - LOWER if d else 0


def apart(d, count):
    """Return the first `count` slopes, each as a number."""
    return [mpmath.ldexp((d + MIDDLE >> ROOM * i) % UNITS[1] - (1 << ROOM - 1), -BITS) for i in range(count)]


class Dual:
    """v + d eps with eps^2 = 0, both in units of 2^-BITS. d holds the derivatives, without the error of a difference.
    """
    __slots__ = "v", "d"

    def __init__(self, v, d=0):
        self.v, self.d = v, d

    def __add__(self, o):
        return Dual(self.v + o.v, self.d + o.d)

    def __sub__(self, o):
        return Dual(self.v - o.v, self.d - o.d)

    def __mul__(self, o):
        return Dual(self.v * o.v >> BITS, down(self.v * o.d + self.d * o.v))

    def __truediv__(self, o):
        q = (self.v << BITS) // o.v
        return Dual(q, down((self.d - down(q * o.d)) * ((1 << 2 * BITS) // o.v)))


def fixed(v):
    return int(mpmath.ldexp(v, BITS))


def dual(v, unit=1):
    """Return the dual number of a complex number whose imaginary part is TINY times the slope. TINY^2 is negligible."""
    return Dual(fixed(mpmath.re(v)), unit * fixed(mpmath.im(v) / TINY))


def slopes(run, q, wanted):
    """Return the derivatives of run(q, turn) by each wanted (name, i), that is by q[name][i], or by alpha, whose
    slope is turn; at most 28."""
    q, turn = {name: list(v) for name, v in q.items()}, 0
    for unit, (name, i) in zip(UNITS, wanted):
        if name == "alpha":
            turn = unit
        else:
            q[name][i] += Dual(0, unit << BITS)
    return apart(run(q, turn).d, len(wanted))


ZERO, ONE, HALF = Dual(0), Dual(1 << BITS), Dual(1 << BITS - 1)


def dot(a, b):
    """Return the sum of the products of two lists of dual numbers."""
    av, bv, ad = [x.v for x in a], [x.v for x in b], [x.d for x in a]
    slopes, some = sum(map(mul, av, [x.d for x in b])), reduce(or_, ad, 0)
    if some:          # all slopes in a row of weights are in one slot; the zeros below it need no product
        below = (some & -some).bit_length() - 1
        slopes += sum(map(mul, [d >> below for d in ad], bv)) << below
    return Dual(sum(map(mul, av, bv)) >> BITS, down(slopes))


def line(row, b):
    """Return the sum of the products of a row of whole numbers and a list of dual numbers."""
    return Dual(sum(map(mul, row, [x.v for x in b])) >> BITS, down(sum(map(mul, row, [x.d for x in b]))))


def factorised(M, bits=BITS):
    """Return the LU factorisation of M with pivots (L below the diagonal, U from the diagonal on), the order of the
    rows, and 1 over U's diagonal."""
    order = list(range(len(M)))
    for k in order[:]:
        best = max(range(k, len(M)), key=lambda i: abs(M[i][k]))
        M[k], M[best], order[k], order[best] = M[best], M[k], order[best], order[k]
        behind = M[k][k + 1:]
        while behind and not behind[-1]:        # skip the zeros of bodies that are not coupled
            behind.pop()
        for row in M[k + 1:]:
            row[k] = f = (row[k] << bits) // M[k][k]
            if f:
                row[k + 1:k + 1 + len(behind)] = [a - (f * b >> bits) for a, b in zip(row[k + 1:], behind)]
    return M, order, [(1 << 2 * bits) // M[k][k] for k in range(len(M))]


def substituted(lu, right, down):
    """Return x of M x = right, in whole numbers. down takes a product to the units of its factors."""
    M, order, over = lu
    y, x = [], []
    for row, at in zip(M, order):
        y.append(right[at] - down(sum(map(mul, row, y))))
    for i in range(len(M) - 1, -1, -1):
        x.insert(0, down((y[i] - down(sum(map(mul, M[i][i + 1:], x)))) * over[i]))
    return x


def solved(lu, right):
    """Return x of M x = right for dual numbers on the right and an M without slopes; lu = factorised(M)."""
    return list(map(Dual, substituted(lu, [r.v for r in right], lambda v: v >> BITS),
                    substituted(lu, [r.d for r in right], down)))
