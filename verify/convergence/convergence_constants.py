"""H 20: the bounds (20.25) and (20.20) in numbers. Prints tests/convergence/convergence_constants_ref.h.

The integrals over steps and rates are computed by quadrature, as the page states them, and not by the closed forms of
the tests. The constants K and E of (20.22) are those of tests/convergence/convergence_stages_ref.h, which
convergence_stages.py proves."""
import pathlib
import re
from functools import cache

from mpmath import exp, expj, fabs, gamma, linspace, log, mp, mpf, pi, quad, sin
from sympy import binomial, factorial

from shared.refgen import header, hexd, largest, smallest, table

mp.dps = 20
CONSTANTS = [[float.fromhex(v) for v in row] for row in re.findall(
    r"\{ \d, (\S+), (\S+), (\S+), (\S+), (\S+) \}", pathlib.Path("tests/convergence/convergence_stages_ref.h").read_text())]
KAPPA, STAGE = mpf("1.34"), mpf("2.37")   # (20.18), and (20.21), the rows of the resolvent


def derivatives(i):
    """Return the bounds A_i, B_i and H_i of the test cases."""
    return 1 + mpf(i) / 4, mpf(1) / 2 + mpf(i) / 8, mpf(3) / 4 + mpf(i) / 2


#> stages
def power(t, k, exponent):
    return quad(lambda y: y**exponent, [t[k], t[k + 1]]) if k else t[1]**(exponent + 1) / (exponent + 1)


def misses(s, t, which):
    """Return (20.22) with the smaller of its two terms in each step: the largest sum over all stages."""
    C, K1, K, E1, E = CONSTANTS[s - 2]
    D = lambda i: derivatives(i)[which]
    most = ends = mpf(0)
    for k in range(len(t) - 1):
        h = t[k + 1] - t[k]
        first = D(1) * h**2
        row = K1 * first if k == 0 else min(K1 * first, K * h**(s - 1) * D(s - 1) * power(t, k, 2 - s))
        end = E1 * first if k == 0 else min(E1 * first, E * h**s * D(s) * power(t, k, 1 - s))
        most, ends = max(most, ends + row), ends + end
    return most


@cache
def rate_and_decay(u):
    """Return sigma = exp(u) and exp(-sigma/2). All integrals over the rates have the same points u."""
    rate = exp(u)
    return rate, exp(-rate / 2)


def rate_integral(j, theta, more):
    """Return G_j, or with more = 1 its second form: the bound of the j-th derivative of psi at t = 1, integrated over
    all rates."""
    A = [derivatives(i)[0] for i in range(j + 1)]

    def low(u):
        rate, decayed = rate_and_decay(u)
        return exp(u * (1 + more - theta)) * (
            rate**(j - 1) * (decayed - decayed**2) * A[0]
            + decayed * sum(rate**(j - 1 - i) * A[i] * 2**i for i in range(j)))
    rest = 0 if more else A[j] * 2**j * gamma(1 - theta) / theta * mpf(2)**-theta
    return quad(low, linspace(-240, 8, 63)) + rest


def memory_misses(s, theta, t):
    """Return the largest bound (20.24) over all steps."""
    C, K1, K, E1, E = CONSTANTS[s - 2]
    G1, G, G_end, G_more = (rate_integral(j, theta, more) for j, more in ((1, 0), (s - 1, 0), (s, 0), (s - 1, 1)))
    most = mpf(0)
    for n in range(len(t) - 1):
        total = mpf(0)
        for k in range(n + 1):
            h = t[k + 1] - t[k]
            first = G1 * h * power(t, k, theta - 1)
            if k == n:
                inner = K1 * first if k == 0 else min(K1 * first, K * h**(s - 1) * G * power(t, k, theta - s + 1))
                total += STAGE * inner
                continue
            end, past = E1 * first, K1 * first
            if k:
                third = pi * 2**(s - 1) * derivatives(s - 1)[0] / sin(pi * theta) * (t[n] - t[k])**(theta - 1)
                end = smallest((end, E * h**s * G_end * power(t, k, theta - s)))
                past = smallest((past, K * h**s * (G_more * power(t, k, theta - s) + third * power(t, k, 1 - s))))
            total += end + KAPPA * past
        most = largest((most, total))
    return sin(pi * theta) / pi * most


def bound_of_stages(s, alpha, r, lipschitz, eps, h):
    """Return E, Lambda_1 E + Q(X) and lambda of (20.25). lambda is the power of 1.05 (times 0.01) for which the bound
    of v in the last step is least."""
    t = [sum(map(mpf, h[:k]), mpf(0)) for k in range(len(h) + 1)]
    theta, longest = mpf(1 - 2 * alpha if alpha <= 0.5 else 2 - 2 * alpha), mpf(max(h))
    of_x = misses(s, t, 1)
    of_v = r * (memory_misses(s, theta, t) if theta else 0) + misses(s, t, 2) + r * eps * t[-1]
    best, at = None, mpf("0.01")
    while at < 1000:
        once = 1 / at + longest
        memory = r * (KAPPA / at**theta + 2 * longest**theta if theta else mpf(1))
        by_x = lipschitz * once + (memory if alpha <= 0.5 else 0)
        chi = by_x * once + (0 if alpha <= 0.5 else memory)
        if chi < 1:
            E, weight = (of_v + by_x * of_x) / (1 - chi), mpf(1)
            for step in h[:-1]:
                weight *= 1 + at * mpf(step)
            if best is None or E * weight < best[0]:
                best = E * weight, E, once * E + of_x, at
        at *= mpf("1.05")
    return best[1:]
#< stages


#> graded
@cache
def missed(s, h, sigma):
    """Return the error of s stages for the rate sigma, the sum over all steps."""
    P = [mpf(int(binomial(s - 2, i) * factorial(2 * s - 2 - i))) / int(factorial(2 * s - 2)) for i in range(s - 1)]
    Q = [(-1)**i * mpf(int(binomial(s, i) * factorial(2 * s - 2 - i))) / int(factorial(2 * s - 2)) for i in range(s + 1)]
    R = lambda z: sum(a * z**i for i, a in enumerate(P)) / sum(a * z**i for i, a in enumerate(Q))
    C = CONSTANTS[s - 2][0]
    miss = lambda nu: C * nu**(2 * s - 1) if nu < 0.25 else fabs(R(-nu) - exp(-nu))   # (20.17) or exact
    return sum(miss(sigma * mpf(l)) * exp(-sigma * sum(map(mpf, h[:k]), mpf(0))) for k, l in enumerate(h))


@cache
def on_cut(m, c, rho, alpha, x0, v0, u):
    """Return sigma = exp(u), and the factor of the step errors in the integral over u."""
    sigma = exp(u)
    k = fabs((1 / (m * sigma**2 + c + rho * sigma**(2 * mpf(alpha)) * expj(2 * pi * alpha))).imag) / pi
    J = fabs(c * x0 / sigma + m * v0) if alpha < 0.5 else fabs(c * x0 / sigma - c * v0 / sigma**2)
    return sigma, sigma * k * J


def graded_bound(row, s, h, order):
    """Return (20.20), inserted in the integral of (20.16) over the cut: the bound of x (order 0) or of v (order 1)."""
    def at(u):
        sigma, factor = on_cut(*row, u)
        return factor * sigma**order * missed(s, h, sigma)

    corners = sorted(log(mpf(0.25) / mpf(l)) for l in set(h))
    return quad(at, [*linspace(-30, corners[0], 40), *corners[1:], *linspace(corners[-1] + 1, 40, 40)])
#< graded


H = (0.0625, 0.125, 0.125, 0.03125, 0.25)
LONG = tuple(8 * v for v in H)
STAGES = [(2, 0.25, 0.25, 0.5, 0.0), (3, 0.25, 0.125, 0.25, 0.0), (4, 0.125, 0.25, 0.5, 0.125), (2, 0.75, 0.125, 0.5, 0.0),
          (3, 0.625, 0.125, 0.25, 0.25), (4, 0.875, 0.0625, 0.5, 0.0), (3, 0.5, 0.25, 0.5, 0.0)]
SPRINGS = [(1.0, 1.0, 0.5, 0.25, 1.0, 0.0), (2.0, 0.5, 0.125, 0.75, 0.5, -1.0), (0.5, 3.0, 2.0, 0.375, 0.0, 1.0),
           (1.0, 8.0, 0.25, 0.875, -1.0, 0.25)]

header("verify/convergence/convergence_constants.py")
print("\n/* (20.25) for five steps, A_i = 1 + i/4, B_i = 1/2 + i/8 and H_i = 3/4 + i/2: E, X and lambda. */")
print(f"\nstatic const double ref_steps[] = {{ {', '.join(map(hexd, H))} }};")
table("ref_bounds", "size_t s; double alpha, r, lipschitz, eps, E, X, lambda;",
      [[row[0], *map(hexd, row[1:]), *(repr(float(f"{float(v):.12g}")) for v in bound_of_stages(*row, H))] for row in STAGES])
print("\n/* (20.20) for steps eight times as long, of x and of v. */")
table("ref_graded", "double m, c, rho, alpha, x0, v0; size_t s; double x, v;",
      [[*map(hexd, row), s, *(repr(float(f"{float(graded_bound(row, s, LONG, order)):.8g}")) for order in range(2))]
       for row in SPRINGS for s in (2, 3)])
