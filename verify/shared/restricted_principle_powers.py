"""Sums of powers, {exponent: coefficient}: their derivatives and integrals with alpha symbolic; and the action (3.3)
and its first variation (3.5) in numbers.

The powers are of t, or of 1 - t if the function takes the sum from the other end."""
import mpmath
from sympy import Rational as Q, gamma, symbols

a = symbols("alpha", positive=True)


def Beta(p, q):
    return gamma(p) * gamma(q) / gamma(p + q)


def power(order, exponent):
    """Return the factor of (1.6): D^order s^exponent = power(order, exponent) s^(exponent - order)."""
    return gamma(exponent + 1) / gamma(exponent + 1 - order)


def integral(left, right):
    """Return int_0^1 sum l_p t^p sum r_q (1-t)^q dt for {exponent: coefficient}."""
    return sum(l * r * Beta(p + 1, q + 1) for p, l in left.items() for q, r in right.items())


def D(z, times=1):
    """Return D^alpha of a sum of powers, applied `times` times, from its own end."""
    for _ in range(times):
        z = {p - a: v * power(a, p) for p, v in z.items()}
    return z


def plus(*parts):
    """Return the sum of (factor, sum of powers)."""
    out = {}
    for factor, z in parts:
        for p, v in z.items():
            out[p] = out.get(p, 0) + factor * v
    return out


def ddt(z, sign=1):
    """Return d/dt; sign = -1 for powers of 1 - t."""
    return {p - 1: sign * v * p for p, v in z.items() if p != 0}


def real(z):
    return mpmath.mpf(int(z.p)) / int(z.q)


def powered(order, exponent):
    return mpmath.gamma(real(exponent) + 1) * mpmath.rgamma(real(exponent) + 1 - real(order))


# The action and its variation: products of powers, which are integrated one by one.
MASS, DAMPING, SPRING, CUBE = Q(2), Q(3, 4), Q(3, 2), Q(1, 2)  # U = SPRING z^2/2 + CUBE z^4/4


def times(*curves):
    out = {Q(0): Q(1)}
    for z in curves:
        new = {}
        for (p, l), (q, r) in ((i, j) for i in out.items() for j in z.items()):
            new[p + q] = new.get(p + q, 0) + l * r
        out = new
    return out


def over(z, T):
    """Return int_0^T of a sum of powers."""
    return sum(real(v) * real(T) ** real(p + 1) / real(p + 1) for p, v in z.items())


def coupled(z, o, alpha, T):
    """Return int D_- z D_+ o dt."""
    return sum(real(l) * real(r) * powered(alpha, p) * powered(alpha, q)
               * real(T) ** real(p + q + 1 - 2 * alpha)
               * mpmath.beta(real(p + 1 - alpha), real(q + 1 - alpha))
               for p, l in z.items() for q, r in o.items())


def action(alpha, T, x, y, sign=-1):
    half = [plus((MASS / 2, times(ddt(z), ddt(z))), (sign * SPRING / 2, times(z, z)),
                (sign * CUBE / 4, times(z, z, z, z))) for z in (x, y)]
    return sum(over(z, T) for z in half) + sign * real(DAMPING) * coupled(x, y, alpha, T)


def first_variation(alpha, T, x, y, xi, eta, sign=-1):
    half = [plus((MASS, times(ddt(z), ddt(d))), (sign * SPRING, times(z, d)),
                (sign * CUBE, times(z, z, z, d))) for z, d in ((x, xi), (y, eta))]
    return (sum(over(z, T) for z in half) + sign * real(DAMPING)
            * (coupled(xi, y, alpha, T) + coupled(x, eta, alpha, T)))


def sizes(z):
    return {p: abs(v) for p, v in z.items()}
