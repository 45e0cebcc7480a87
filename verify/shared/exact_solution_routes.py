"""Two ways to compute x and x' of m x'' + c x + rho D^(2 alpha) x = F: Talbot's rule, which does not split the
solution, and the residues with the integral along the cut."""
import copy
import math
from functools import cache

import mpmath
from mpmath import mp, mpc, mpf


HELD, CAPUTO, RL = 0, 1, 2  # as in src/fvi/past.h


class Problem:
    """One problem. Every number is a double, taken as exact."""

    def __init__(self, m=1, c=1, rho=1, alpha=0.25, past=RL, x0=0, v0=0, forcing=0,
                 A=0, T=0, w=0):
        self.row = [m, c, rho, alpha, past, x0, v0, forcing, A, T, w]
        (self.m, self.c, self.rho, self.alpha, _, self.x0, self.v0, _, self.A, self.T,
         self.w) = [mpf(float(q)) for q in self.row]
        self.forcing = forcing
        self.beta = 2 * self.alpha
        self.k0 = 1 if past != RL or alpha == 0.5 else 0
        self.k1 = 1 if past == CAPUTO and alpha > 0.5 else 0

    def in_doubles(self):
        """Return the same problem in Python's own numbers."""
        p = copy.copy(self)
        p.__dict__ = {name: float(v) if isinstance(v, mpf) else v for name, v in vars(p).items()}
        return p

    def Q(self, z, power=None):
        power = z**self.beta if power is None else power
        return self.m * z * z + self.c + self.rho * power

    def numerator(self, z, power=None):
        power = z**self.beta if power is None else power
        total = self.m * (z * self.x0 + self.v0)
        if self.k0 and self.x0:
            total += self.rho * self.x0 * power / z
        if self.k1 and self.v0:
            total += self.rho * self.v0 * power / (z * z)
        if self.forcing:
            total += self.A / z if self.forcing == 1 else self.A * z / (z * z + self.w**2)
        return total

    def X(self, z, power=None):
        """Return the transform (11.2); for a step force, of its beginning only."""
        return self.numerator(z, power) / self.Q(z, power)


#> talbot
@cache
def contour(count, digits):
    """Return the points z time 5 / (2 count) of Talbot's contour, and their weights."""
    points = []
    for k in range(count):
        angle = k * mp.pi / count
        ct = mpmath.cot(angle) if k else mpf(0)
        zeta = angle * mpc(ct, 1) if k else mpc(1)
        turn = mpc(1, angle + (angle * ct - 1) * ct) if k else mpf(1) / 2
        points.append((zeta, mpmath.exp(mpf(2) * count / 5 * zeta) * turn))
    return points


@cache
def points_of(count, digits, beta, number):
    """Return the points, their powers, the weights, each converted by `number`."""
    return [(number(zeta), number(zeta**beta), number(weight)) for zeta, weight in contour(count, digits)]


def talbot(transform, x0, time, points, beta):
    """Return x and x' from X by Talbot's contour with the parameters of Abate and Valko. They have about 0.6 count
    digits, if no pole lies far up the imaginary axis in units of count / time."""
    count = len(points)
    radius = 2 * count / (5 * time)
    x = v = 0
    scale = radius**beta
    for zeta, power, weight in points:
        z = radius * zeta
        value = transform(z, scale * power)             # z^beta is known
        x += (weight * value).real
        v += (weight * (z * value - x0)).real
    return x * radius / count, v * radius / count
#< talbot


def by_talbot(p, time, digits, number=mpc):
    """Return x and x' to this number of digits."""
    count = int(digits / 0.55) + 12
    mp.dps = digits + count // 4 + 15
    points = points_of(count, mp.dps, p.beta, number)
    x, v = talbot(p.X, p.x0, time, points, p.beta)
    if p.forcing == 1 and time > p.T:
        y, w_ = talbot(lambda z, power: p.A / (z * p.Q(z, power)), 0, time - p.T, points, p.beta)
        x, v = x - y, v - w_
    return x, v


def pole(p, digits):
    """Return the zero of Q, by the secant method from a rough approximation."""
    mp.dps = digits
    if p.rho == 0 or p.beta in (0, 2):
        return 1j * mpmath.sqrt((p.c + (p.rho if p.beta == 0 else 0))
                                / (p.m + (p.rho if p.beta == 2 else 0)))
    angle = mpmath.findroot(lambda e: angle_equation(p, e), (mpf("1e-9"), 1 - mpf("1e-9")),
                            solver="anderson", tol=1e-20, maxsteps=500)
    return mpmath.findroot(p.Q, start(p, angle), tol=mpf(10) ** (-2 * digits + 20))


def start(p, e):
    th = mp.pi / 2 + e * (mp.pi / max(p.beta, 2 - p.beta) - mp.pi / 2)
    return (mpmath.sqrt(p.c / p.m * mpmath.sin(p.beta * th) / mpmath.sin((2 - p.beta) * th))
            * mpmath.expj(th))


def angle_equation(p, e):
    z = start(p, e)
    th = mpmath.arg(z)
    return (p.rho * abs(z) ** p.beta * mpmath.sin((2 - p.beta) * th)
            + p.c * mpmath.sin(2 * th)) / p.c


#> cut
def by_cut(p, time, digits):
    """Return x and x' as residues plus the integral along the cut, by the trapezoidal rule in ln r."""
    z = pole(p, digits + 30)
    rest = p.beta * p.rho * z ** (p.beta - 1) + 2 * p.m * z  # Q'(z)
    terms = [(z, p.numerator(z) / rest)]
    if p.forcing == 2:
        terms.append((mpc(0, p.w), p.A / (2 * p.Q(mpc(0, p.w)))))
    x = sum(2 * (a_ * mpmath.exp(z_ * time)).real for z_, a_ in terms)
    v = sum(2 * (a_ * z_ * mpmath.exp(z_ * time)).real for z_, a_ in terms)
    turn = mpmath.expjpi(p.beta)
    narrow = min(mp.pi / 2, mp.pi - mpmath.arg(z))
    step = 2 * mp.pi * narrow / (mpf("2.4") * (digits + 5))
    at, size, r_, less = 1, 0, 3 * (digits + 5) / time, mpmath.exp(-step)
    power, power_less = r_**p.beta * turn, less**p.beta
    while p.rho and p.beta not in (0, 1, 2) and at > size * mpf(10) ** (-digits - 3):
        k_ = -p.X(-r_, power).imag * r_ * mpmath.exp(-r_ * time) * step / mp.pi
        x, v = x + k_, v - r_ * k_
        at, size = (abs(k_) if r_ * time < 1 else 1), max(size, abs(k_))
        r_, power = r_ * less, power * power_less
    return x, v
#< cut


def size(p, time, x, v):
    """Return the largest |x| and |x'| of nine times up to this time (or up to 20 units of time)."""
    xs, vs = [abs(p.x0), abs(x)], [abs(p.v0), abs(v)]
    p = p.in_doubles()
    for k in range(1, 9):
        x, v = by_talbot(p, min(float(time), 20 / unit(p)) * k / 8, 8, complex)
        xs.append(abs(x))
        vs.append(abs(v))
    return f"{float(max(xs)):.2g}", f"{float(max(vs)):.2g}"


def unit(p):
    return math.sqrt(p.c / p.m) if p.c else 1
