"""Impacts, and a ball that bounces on a springpot. Prints tests/events/events_ref.h.

Claimed by sympy, for every symmetric M in two dimensions, every normal n and every speed r of the wall: the impact p
-> p - (1 + e) n (n.v + r) / (n.M^-1 n) multiplies the relative speed n.v + r by -e and leaves the momentum along the
wall unchanged. At a wall that rests it takes (1 - e^2) (n.v)^2 / (2 n.M^-1 n) from the kinetic energy.

The ball moves by x'' + rho D^o (x - 1) = -1 from x = 1 at rest and was held before. Its equation is linear, and an
impact does not change the memory. So the contributions of impacts at t_k that change the velocity by d_k add up:

    x = 1 - t^2 E_{b,3}(-rho t^b) + sum_k d_k (t - t_k) E_{b,2}(-rho (t - t_k)^b),    b = 2 - o,

with Mittag-Leffler's E. Each t_k is a root of x, and d_k = -(1 + e) v(t_k). Without damping the t_k are sqrt(2) (1 +
2 (e + e^2 + ...)), exactly."""
from functools import cache

import sympy
from mpmath import gamma, mp, mpf, sqrt

from shared.refgen import claim, header, nearest, table

mp.dps = 40

# ---- the impact ----
a, b, c, n1, n2, p1, p2, e, r = sympy.symbols("a b c n1 n2 p1 p2 e r", real=True)
M = sympy.Matrix([[a, b], [b, c]])
n, p = sympy.Matrix([n1, n2]), sympy.Matrix([p1, p2])
v = M.inv() * p
speed, inverse = (n.T * v)[0], (n.T * M.inv() * n)[0]
after = p - (1 + e) * n * (speed + r) / inverse
claim("(22.27): the speed is -e times what it was",
      sympy.simplify((n.T * M.inv() * after)[0] + r + e * (speed + r)) == 0)
claim("nothing along the wall", sympy.simplify(sympy.Matrix([-n2, n1]).dot(after - p)) == 0)
energy = (p.T * v)[0] / 2 - (after.T * M.inv() * after)[0] / 2
claim("the energy that an impact takes",
      sympy.simplify(energy.subs(r, 0) - (1 - e**2) * speed**2 / (2 * inverse)) == 0)


# ---- the ball ----
@cache
def coefficient(order, shift, k):
    """Return the coefficient of z^k, which all arguments share."""
    return 1 / gamma(order * k + shift)


def mittag_leffler(order, shift, z):
    total, power, k = mpf(0), mpf(1), 0
    while True:
        term = power * coefficient(order, shift, k)
        total += term
        power *= z
        k += 1
        if k > 10 and abs(term) < mpf(10) ** -38:
            return total


def state(t, o, rho, hits):
    """Return x and v at t after the impacts `hits`."""
    order = 2 - o
    x, v = 1 - t**2 * mittag_leffler(order, 3, -rho * t**order), -t * mittag_leffler(order, 2, -rho * t**order)
    for at, jump in hits:
        if t > at:
            z = -rho * (t - at) ** order
            x += jump * (t - at) * mittag_leffler(order, 2, z)
            v += jump * mittag_leffler(order, 1, z)
    return x, v


def fall(t, o, rho, hits):
    """Return the next root of x after t."""
    step = mpf(1) / 64
    low = t + step
    while state(low + step, o, rho, hits)[0] > 0:
        low += step
        if low > 5:
            return None
    for _ in range(12):
        x, v = state(low, o, rho, hits)
        low -= x / v
    claim("a root", abs(state(low, o, rho, hits)[0]) < mpf(10) ** -35)
    return low


def bounces(o, rho, e, T):
    hits, t = [], mpf(0)
    while (t := fall(t, o, rho, hits)) and t < T:
        hits.append((t, -(1 + e) * state(t, o, rho, hits)[1]))
    return [at for at, _ in hits], state(T, o, rho, hits)


header(__file__)
e, T, rows = mpf(0.8), mpf(5), []
known = {"0.6": "1.488362842713238 3.559706909650385",
         "1.4": "1.558856990006441 3.108679570573761 4.044795610490283 4.651383333797419"}
for alpha, rho in (("0", "0.3"), ("0.25", "0.3"), ("0.3", "0.3"), ("0.5", "0.3"), ("0.7", "0.3"),
                   ("0.75", "0.1"), ("0.5", "0")):
    a, r = mpf(float(alpha)), mpf(float(rho))
    times, (x, v) = bounces(2 * a, r, e, T)
    if alpha in ("0.3", "0.7"):
        claim("another program, exponentials and Radau's method, finds the same impacts to 1e-14",
              all(abs(at - mpf(other)) < 1e-14 for at, other in
                  zip(times, known[str(round(2 * float(alpha), 1))].split(), strict=True)))
    if rho == "0":
        claim("parabolas", all(abs(at - sqrt(mpf(2)) * (1 + 2 * sum(e**k for k in range(1, i + 1))))
                               < mpf(10) ** -35 for i, at in enumerate(times)))
    rows.append([nearest(w) for w in (a, r, len(times), *times, *[mpf(0)] * (4 - len(times)), x, v)])
table("ref_ball", "double alpha, rho, count, t0, t1, t2, t3, x, v;", rows)
