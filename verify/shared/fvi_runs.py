"""Runs of (9.2) as the chapter prints it, and of (9.4) with bounds of its rounding errors.

A run is in exact rationals, or in mpmath numbers of many digits where a step is a quadratic equation."""
from fractions import Fraction as Q

import mpmath

from shared.refgen import claim


def weight(order, n):
    """Return (-1)^n binom(order, n) from the product, for any type of number."""
    w = order * 0 + 1
    for j in range(1, n + 1):
        w = w * (j - 1 - order) / j
    return w


class Exactly:
    """Numbers as fractions of Python."""
    number = staticmethod(Q)
    power = staticmethod(lambda base, e: rational_power(Q(base), Q(e)))


class Digits:
    """Numbers as mpmath numbers with many digits."""
    number = staticmethod(lambda q: mpmath.mpf(Q(q).numerator) / Q(q).denominator)
    power = staticmethod(lambda base, e: Digits.number(base) ** Digits.number(e))


def rational_power(base, e):
    """Return base^e if it is rational; base must be a power of two."""
    n = (base.numerator.bit_length() - 1) - (base.denominator.bit_length() - 1)
    claim(f"{base}^{e} is rational", base == Q(2) ** n and (n * e).denominator == 1)
    return Q(2) ** int(n * e)


class Case:
    """A run. Its data are doubles, so they are rational numbers."""
    def __init__(self, name, alpha, kappa, h, steps, x0, p0, potential="HARMONIC", c=1, g=0,
                 mass=(1,), rho=(Q(1, 2),), caputo=0, ramp=(), exact=True):
        self.name, self.steps, self.potential, self.caputo = name, steps, potential, caputo
        self.alpha, self.kappa, self.h, self.c, self.g = map(Q, (alpha, kappa, h, c, g))
        self.d = len(x0)
        pad = lambda v: [Q(z) for z in v]
        self.mass, self.rho, self.x0, self.p0 = map(pad, (mass, rho, x0, p0))
        self.ramp = pad(ramp) or [Q(0)] * self.d
        self.exact = exact

    def springs(self, z, one):
        """Return grad U(z); `one` converts a number to the kind of z."""
        c, g = one(self.c), one(self.g)
        if self.potential == "CUBIC":       # U = c z^2 / 2 + g z^3 / 3
            return [(c + g * v) * v for v in z]
        if self.potential == "HARMONIC":
            return [c * v for v in z]
        force = lambda r: (c + g * r * r) * r                   # CHAIN
        wall = [one(0)] + list(z) + [one(0)]
        r = [force(wall[i + 1] - wall[i]) for i in range(self.d + 1)]
        return [r[i] - r[i + 1] for i in range(self.d)]

    def stiffness(self):
        """Return the constant Hessian of a quadratic U."""
        if self.potential != "CHAIN":
            return [[self.c * (i == j) for j in range(self.d)] for i in range(self.d)]
        return [[self.c * (2 * (i == j) - (abs(i - j) == 1)) for j in range(self.d)]
                for i in range(self.d)]

    def force(self, k):
        return [f * k * self.h for f in self.ramp]      # F(t) = ramp t

    def damped(self, k, i):
        """Return the path that Caputo's derivative subtracts from x_k."""
        if not self.caputo:
            return Q(0)
        drift = k * self.h * self.p0[i] / self.mass[i] if 2 * self.alpha > 1 else 0
        return self.x0[i] + drift                                       # (9.6)


def solve(case, A, K, rhs, x, kind):
    """Return d with A d + s grad U(x + theta d) = rhs: exactly, or by many Newton steps."""
    number, dim = kind.number, case.d
    s, theta = K * case.h, 1 - K
    at = lambda d: case.springs([x[i] + number(theta) * d[i] for i in range(dim)], number)
    zero = [number(0)] * dim
    if s * theta == 0 or case.g == 0:
        r = [rhs[i] - number(s) * v for i, v in enumerate(at(zero))]
        J = [[number(A[i] * (i == j) + (s * theta * case.stiffness()[i][j] if s * theta else 0))
              for j in range(dim)] for i in range(dim)]
        if dim == 1:
            return [r[0] / J[0][0]]
        det = J[0][0] * J[1][1] - J[0][1] * J[1][0]
        return [(J[1][1] * r[0] - J[0][1] * r[1]) / det, (J[0][0] * r[1] - J[1][0] * r[0]) / det]
    claim("Newton is for one dimension here", dim == 1 and case.potential == "CUBIC")
    d = rhs[0] / number(A[0])
    for _ in range(12):
        z = x[0] + number(theta) * d
        slope = number(A[0]) + number(s * theta) * (number(case.c) + 2 * number(case.g) * z)
        d -= (number(A[0]) * d + number(s) * at([d])[0] - rhs[0]) / slope
    return [d]


#> definition
def by_definition(case, kind):
    """Return positions by (9.2) as printed: with the double sum, and x_1 from p_0 = -D1 L_d."""
    number, dim, K, step = kind.number, range(case.d), case.kappa, case.h
    A = [mass / step for mass in case.mass]
    w = [number(weight(case.alpha, n)) for n in range(case.steps + 1)]
    scale = number(step) * kind.power(step, -2 * case.alpha)
    X, P = [[number(v) for v in case.x0]], [[number(v) for v in case.p0]]
    for k in range(case.steps):
        d = solve(case, A, K, P[k], X[k], kind)
        X.append([X[k][i] + d[i] for i in dim])
        S = [number(K) * X[k][i] + number(1 - K) * X[k + 1][i] for i in dim]
        grad, f = case.springs(S, number), case.force(k + 1)
        Z = [[X[j][i] - number(case.damped(j, i)) for j in range(k + 2)] for i in dim]
        DD = [sum(w[n] * sum(w[l] * Z[i][k + 1 - n - l] for l in range(k + 2 - n))
                  for n in range(k + 2)) for i in dim]
        P.append([number(A[i]) * d[i] - number((1 - K) * step) * grad[i]       # D2 L_d
                  - number(case.rho[i]) * scale * DD[i] + number(step * f[i]) for i in dim])
    return X, P
#< definition


class Rounded:
    """A number, and a bound of the error of the double that stands for it after the operations so far. The bound is
    in units of u = 2^-53 and of first order in u."""
    def __init__(self, value, error=0.0):
        self.v, self.e = value, error

    @staticmethod
    def done(value, error):
        return Rounded(value, error + abs(float(value)))

    def __add__(self, o):
        return Rounded.done(self.v + o.v, self.e + o.e)

    def __sub__(self, o):
        return Rounded.done(self.v - o.v, self.e + o.e)

    def __mul__(self, o):
        error = abs(float(self.v)) * o.e + abs(float(o.v)) * self.e
        return Rounded.done(self.v * o.v, error)

    def __truediv__(self, o):
        q = self.v / o.v
        return Rounded.done(q, (self.e + abs(float(q)) * o.e) / abs(float(o.v)))


def rounded_solve(case, A, x, r, kind):
    """Return the increment and the gradient at the midpoint, with the error bounds of newton.c."""
    exact = lambda q: Rounded(kind.number(q))
    K, dim = case.kappa, range(case.d)
    s, theta = exact(K) * exact(case.h), exact(1) - exact(K)
    at = lambda d: case.springs([x[i] + theta * d[i] for i in dim], exact)
    if K in (0, 1) or case.g == 0:
        r = [r[i] - s * v for i, v in enumerate(case.springs(x, exact))] if K else r
        J = [[(A[i] if i == j else exact(0)) + (s * theta * exact(case.stiffness()[i][j])
              if K not in (0, 1) else exact(0)) for j in dim] for i in dim]
        if case.d == 1:
            d = [r[0] / J[0][0]]
        else:   # LU: one more rounding, because the code multiplies by a reciprocal
            one = exact(1)
            low = J[1][0] * (one / J[0][0])
            last = (r[1] - low * r[0]) * (one / (J[1][1] - low * J[0][1]))
            d = [(r[0] - J[0][1] * last) * (one / J[0][0]), last]
        return d, at(d)
    # Newton stops when the residual is a rounding error, so the error is this residual over the Jacobian.
    value = solve(case, [case.mass[0] / case.h], K, [r[0].v], [x[0].v], kind)[0]
    d = Rounded(value)
    residual = r[0] - A[0] * d - s * at([d])[0]
    z = float(x[0].v + theta.v * value)
    J = float(A[0].v) + float(s.v * theta.v) * (float(case.c) + 2 * float(case.g) * z)
    d = [Rounded.done(value, residual.e / abs(J))]
    return d, at(d)


def by_momentum(case, kind):
    """Repeat the operations of fvi.c: (9.4), with the memory on increments where 2 alpha >= 1 (memory.c)."""
    number, dim, order = kind.number, range(case.d), 2 * case.alpha
    exact = lambda q: Rounded(number(q))
    step = exact(case.h)
    A = [exact(mass) / step for mass in case.mass]
    w = [number(weight(order - 1 if order >= 1 else order, n)) for n in range(case.steps + 1)]
    power = Rounded.done(kind.power(case.h, 1 - order), 2 * float(kind.power(case.h, 1 - order)))
    X, P = [[exact(v) for v in case.x0]], [[exact(v) for v in case.p0]]
    origin = [X[0][i] if case.caputo else exact(0) for i in dim]
    drift = [step * P[0][i] / exact(case.mass[i]) if case.caputo and order > 1 else exact(0)
             for i in dim]
    terms = [[X[0][i] - origin[i]] for i in dim]
    for k in range(case.steps):
        d, grad = rounded_solve(case, A, X[k], P[k], kind)
        X.append([X[k][i] + d[i] for i in dim])
        P.append([])
        for i in dim:
            f = exact(case.force(k + 1)[i])
            p = P[k][i] + step * (f - grad[i])
            terms[i].append(d[i] - drift[i] if order >= 1 else X[k + 1][i] - origin[i])
            # A dot product in any order has n roundings, and each term has 2 u from its weight.
            pairs = list(zip(w, reversed(terms[i])))
            size = sum(abs(float(q * t.v)) for q, t in pairs)
            H = Rounded(sum(q * t.v for q, t in pairs),
                        sum(abs(float(q)) * t.e for q, t in pairs) + (len(pairs) + 2) * size)
            P[k + 1].append(p - exact(case.rho[i]) * power * H if case.rho[i] else p)
    return X, P
