"""H 19: the past of the body before t = 0. Prints tests/past/past_ref.h.

  (19.3)  on the powers of t, the three derivatives differ by A t^e / Gamma(1 + e);
  (19.4)  v D^b v - 1/2 D^b v^2 is a sum of squares, on all quadratic v;
  (19.5)  the impulses, from the integral, at 120 digits;
  (19.6)  the jump of Caputo's past at alpha = 1/2, and the change of the velocity at alpha = 1;
  (19.8)  the first powers of t of the three solutions.

All inputs are exact doubles. The integrals are taken term by term in powers of k + s. This loses some seventy digits
at k = 10^9, so 120 are used."""
from functools import cache

import mpmath
from mpmath import mp, mpf
from sympy import (Poly, Rational, binomial, diff, expand, gamma, gammasimp, legendre,
                   limit, oo, symbols)

from shared.refgen import claim, header, hexd, hexd_real, prove, table

t, u = symbols("t u", positive=True)
beta, b, rho, m, c, v0, x0, s = symbols("beta b rho m c v0 x0 s", positive=True)


#> powers
def of_power(q, order):
    """Return D^order t^q / Gamma(q + 1), from -infinity, of a path that is 0 before t = 0. The jumps of the power at
    t = 0 count."""
    return t ** (q - order) / gamma(q - order + 1)


def caputo(q, order, first):
    """Return the same without the contributions of the values at t = 0 of the path and its derivatives up to the
    order first - 1."""
    return 0 if q < first else of_power(q, order)


for q in range(4):
    for first, e, A in ((1, -beta, q == 0), (2, 1 - beta, q == 1)):
        # beta < 1: Riemann-Liouville acts on x, Caputo and held on x - x0.
        # beta > 1: held acts on x - x0, Caputo on x - x0 - t v0.
        z = 0 if q == 0 and first == 2 else 1              # the held past subtracts x0
        extra = z * of_power(q, beta) - caputo(q, beta, first)
        prove(f"(19.3) q = {q}, n = {first}",
              gammasimp(extra - int(A) * t**e / gamma(1 + e)))
#< powers

#> squares
a = symbols("a0:3")
v = sum(a[i] * t**i for i in range(3))


def marchaud(difference):
    """Return int_0^t difference(u) u^(-b-1) du of a polynomial in u without a constant term."""
    terms = expand(difference).as_poly(u).all_terms()
    claim("it vanishes at u = 0", all(k > 0 for (k,), _ in terms if _ != 0))
    return sum(coefficient * t ** (k - b) / (k - b) for (k,), coefficient in terms)


def derivative(f):
    """Return D^b of a polynomial, b < 1, without the factor 1 / Gamma(1 - b)."""
    return sum(k_ * t ** (i - b) * gamma(i + 1) * gamma(1 - b) / gamma(i + 1 - b)
               for (i,), k_ in f.as_poly(t).all_terms())


work = v * derivative(v) - derivative(expand(v**2)) / 2
squares = (t**-b * v**2 + b * marchaud((v - v.subs(t, t - u)) ** 2)) / 2
prove("(19.4) v D v - 1/2 D v^2", gammasimp(expand((work - squares) * t**b)))
#< squares

#> jump
Q = m * s**2 + c + rho * s**beta
held = ((m * s + rho * s ** (beta - 1)) * x0 + m * v0) / Q
Caputo = held + rho * s ** (beta - 2) * v0 / Q
prove("(19.6) the jump is the answer to the constant force rho v0",
      ((Caputo - held).subs(beta, 1) - rho * v0 / (s * Q.subs(beta, 1))))
of_v = (s * held - x0).subs(beta, 2)                       # the transform of x'
prove("(19.7) alpha = 1: x'(0+) = m v0 / (m + rho)",
      limit(s * of_v, s, oo) - m * v0 / (m + rho))
#< jump

#> first
# The transforms in powers of 1/s, where rho s^beta / (m s^2) is small. They give the first power that is not an
# integer in x = x0 + t v0 - t^2 c x0 / (2 m) + ...
r = rho / m
for past, k0, k1, term, power, value in (
        ("held, beta < 1", 1, 0, -r * v0, 3 - beta, Rational(1, 2)),
        ("held, beta > 1", 1, 0, -r * v0, 3 - beta, Rational(3, 2)),
        ("Riemann-Liouville, beta < 1", 0, 0, -r * x0, 2 - beta, Rational(1, 2)),
        ("Caputo, beta > 1", 1, 1, r * c * x0 / m, 4 - beta, Rational(3, 2))):
    X = ((m * s + k0 * rho * s ** (beta - 1)) * x0
         + (m + k1 * rho * s ** (beta - 2)) * v0) / Q
    rest = X - x0 / s - v0 / s**2 + c * x0 / (m * s**3)
    of_t = limit((rest * s ** (power + 1)).subs(beta, value), s, oo)
    prove(f"(19.8) {past}", of_t - term)                   # of t^power / Gamma(power + 1)
#< first

#> impulses
@cache
def lagrange(nodes, i, digits):
    """Return l_i by powers of s, with this number of digits."""
    nodes, coefficients = [mpf(node) for node in nodes], [mpf(1)]
    for j, node in enumerate(nodes):
        if j != i:
            scale = nodes[i] - node
            shifted = [mpf(0)] + coefficients
            coefficients = [(a_ - node * b_) / scale
                            for a_, b_ in zip(shifted, coefficients + [mpf(0)])]
    return coefficients


@cache
def power(k, q, digits):
    """Return k^q with this number of digits. The stages of all steps share them."""
    return mpf(k) ** q if k else mpf(0)


def impulse(alpha, k, nodes, i):
    """Return (19.5): int_0^1 l_i(s) (k + s)^e / Gamma(1 + e) ds."""
    e = -2 * mpf(alpha) if alpha < 0.5 else 1 - 2 * mpf(alpha)
    if e == -1:                                            # one impulse at t = 0
        return mpf(i == 0 and k == 0)
    total, l = mpf(0), lagrange(nodes, i, mp.dps)
    for degree, coefficient in enumerate(l):               # s = (k + s) - k
        for j in range(degree + 1):
            q = e + j + 1
            total += (coefficient * int(binomial(degree, j)) * mpf(-k) ** (degree - j)
                      * (power(k + 1, q, mp.dps) - power(k, q, mp.dps)) / q)
    return total / mpmath.gamma(1 + e)
#< impulses


mp.dps = 30
direct = mpmath.quad(lambda y: y * (1 - y) / mpf("0.25") * (3 + y) ** mpf("-0.4"), [0, 1])
claim("(19.5) by quadrature",
      abs(direct / mpmath.gamma(mpf("0.6")) - impulse(mpf("0.2"), 3, (0, 0.5, 1), 1))
      < mpf(10) ** -25)



def lobatto(n):
    """Return Lobatto's nodes in [0, 1]: the ends, and the zeros of P_{n-1}'."""
    inner = Poly(diff(legendre(n - 1, s), s), s).nroots(n=40, maxsteps=200)
    return (0.0, *sorted(float((1 + root) / 2) for root in inner), 1.0)


NODES = {n: lobatto(n) if n > 2 else (0.0, 1.0) for n in range(2, 9)}
ALPHAS = (0.0, 2.0**-30, 0.1, 0.25, 0.4, 0.5 - 2.0**-30, 0.5 + 2.0**-30, 0.6, 0.75, 0.9,
          1 - 2.0**-30, 1.0)


def text(alpha, k, n, i):
    def at(digits):
        mp.dps = 120 + digits
        return mpmath.nstr(impulse(alpha, k, NODES[n], i), digits)
    return hexd_real(at, 25)


header("verify/past/past.py")
table("ref_nodes", "double c[8];", [["{ " + ", ".join(hexd(c_) for c_ in NODES[n])
                                     + " }"] for n in NODES])
table("ref_impulses", "double alpha; size_t n, k; double b[8];",
      [[hexd(alpha), n, k, "{ " + ", ".join(text(alpha, k, n, i) for i in range(n)) + " }"]
       for alpha in ALPHAS for n in NODES
       for k in (0, 1, 2, 3, 10, 100, 10**5, 10**9)])
