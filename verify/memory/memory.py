"""H 12. Memory: the direct sum, blocks of convolutions, decaying exponentials.

Proved here, nu symbolic unless a range is named:
  (12.2)  order beta on positions is order beta - 1 on increments (generic x_j);
  (12.4)  the blocks contain every pair of a term and a later sum once (all k < 640);
  (12.5)  the weights are moments of a density of one sign: n symbolic, by the
          recurrence of H 4 and the first moment;
  (12.7)  the substitution and its modulus and angle on the lines Im t = +-a;
  (12.8)  the four estimates that bound the integral there, and K < 12;
  (12.12) the modes add up to the sum of exponentials (generic terms);
  (12.13) the computations in its proof: the conjugate kernels (generic, to length 8), the
          joint at 33, the line that ends the weights; (12.15) in R^2, (12.16) at z = -1.
Compared: (12.6) itself, in 40-digit arithmetic on a grid of nu, delta, N, n.
Printed: exact weights and tail sums (mpmath's gamma function at 60 and 90
digits); direct sums from the binomial, exact rationals."""
import mpmath
from sympy import (I, Matrix, Rational, binomial, cos, diff, exp, expand, expand_func,
                   gamma, gammasimp, im, log, pi, re, sin, symbols)

from shared.refgen import array, claim, header, hexd, hexd_real, largest, prove, smallest, table

nu, r, s, t, n = symbols("nu r s t n", positive=True)


def weight(order, k):
    """Return w_k of this order; k is a number."""
    return (-1) ** k * expand_func(binomial(order, k))


#> increments
x = symbols("x0:7")
d = [x[0]] + [x[j] - x[j - 1] for j in range(1, 7)]
for k in range(7):
    prove(f"(12.2) order nu + 1 on x is order nu on the increments, k = {k}",
          expand(sum(weight(nu + 1, j) * x[k - j] for j in range(k + 1))
                 - sum(weight(nu, j) * d[k - j] for j in range(k + 1))))
#< increments

#> blocks
base, steps = 4, 640
met = [[0] * steps for _ in range(steps)]  # [k][j]: how often x_j enters H_k
for k in range(steps):
    for j in range(k // base * base, k + 1):
        met[k][j] += 1
    done = k + 1
    if done % base == 0:
        length = done & -done
        for j in range(done - length, done):
            for later in range(done, min(done + length, steps)):
                met[later][j] += 1
claim("(12.4) every pair once, and none twice",
      all(met[k][j] == (j <= k) for k in range(steps) for j in range(steps)))
#< blocks

#> moments
w = gamma(n - nu) / (gamma(-nu) * gamma(n + 1))
moment = -sin(pi * nu) / pi * gamma(n - nu) * gamma(1 + nu) / gamma(n + 1)
reflection = gamma(-nu) * gamma(1 + nu) + pi / sin(pi * nu)
prove("Gamma(-nu) Gamma(1 + nu) = -pi / sin(pi nu)", gammasimp(reflection))
prove("(12.5) the weight is the Beta integral", gammasimp(w / moment) - 1)
density = r ** (n - nu - 1) * (1 - r) ** nu
parts = (r ** (n - nu) * (1 - r) ** (1 + nu)).diff(r)
prove("(12.5) (n - nu) I_n = (n + 1) I_{n+1}, by parts, for the integral itself",
      parts / density - ((n - nu) - (n + 1) * r))
prove("(12.5) r = e^{-s} gives e^{-ns} (e^s - 1)^nu: -dr = r ds, and",
      expand((1 - exp(-s)) * exp(s) - (exp(s) - 1)))
#< moments

#> lines
tau, a, eps, v = symbols("tau a epsilon v", positive=True)
z = (tau + I * a) - exp(-tau) * (cos(a) - I * sin(a))  # log(N s) at t = tau + i a
prove("(12.7) ds/dt = s (1 + e^-t)", diff(exp(t - exp(-t)), t) / exp(t - exp(-t)) - (1 + exp(-t)))
prove("(12.7) N |s| = exp(tau - e^-tau cos a)", re(z) - (tau - exp(-tau) * cos(a)))
prove("(12.7) the angle of s is a + e^-tau sin a", im(z) - (a + exp(-tau) * sin(a)))
R = exp(tau - exp(-tau) * cos(a))
prove("(12.8) dr/dtau = r (1 + e^-tau cos a)", R.diff(tau) / R - 1 - exp(-tau) * cos(a))
prove("(12.8) (v r N)^2 / (r N) = v e^(-v cos a) with v = e^-tau",
      ((v * R) ** 2 / R).subs(tau, -log(v)) - v * exp(-v * cos(a)))
prove("(12.8) which is largest at v = 1/cos a",
      (v * exp(-v * cos(a))).diff(v).subs(v, 1 / cos(a)))
#< lines

mpmath.mp.dps = 40
K = 2 * mpmath.e * (1 + mpmath.sqrt(mpmath.pi / mpmath.e)) * mpmath.mpf(33) / 32
claim("(12.8) K < 12", K < 12)
claim("(12.8) Gamma(nu + 1/2) / Gamma(nu + 1) falls: psi rises",
      all(mpmath.psi(0, o + 0.5) < mpmath.psi(0, o + 1) for o in mpmath.linspace(0, 1, 11)))


def exact(order, k):
    """Return the weight by its definition, at the working precision."""
    order = mpmath.mpf(order.p) / order.q if isinstance(order, Rational) else mpmath.mpf(order)
    return (-1) ** k * mpmath.binomial(order, k)


#> nodes
def nodes(order, longest, delta):
    """Return (12.7) to (12.10) as the chapter prints them."""
    h = mpmath.mpf(0.3)
    for _ in range(15):
        slope = (1 + order) * h / (2 * mpmath.pi)
        h = (2 * mpmath.pi * (mpmath.pi / 2 - slope)
             / mpmath.log1p(24 / (delta * mpmath.sin(slope) ** (1 + order))))
    first, big = 33 - order, mpmath.log(4 / delta)
    A = (big - mpmath.loggamma(2 + order)) / (1 + order) + 0.04
    left = mpmath.lambertw(mpmath.e ** A).real - A
    X = longest * (big + order * mpmath.log(first + 1) - mpmath.loggamma(1 + order)) / first
    right = mpmath.log(X) + 1 / X
    result = []
    for q in range(1 + int(mpmath.ceil((right - left) / h))):
        u = left + q * h
        node = mpmath.exp(u - mpmath.exp(-u)) / longest
        result.append((node, -mpmath.sinpi(order) / mpmath.pi * h * node
                       * (1 + mpmath.exp(-u)) * mpmath.expm1(node) ** order))
    return result
#< nodes


worst = 0
for order in (0.01, 0.3, 0.7, 0.99):
    for longest in (128, 10 ** 5, 10 ** 9):
        for delta in (0.0005, 1e-8, 1e-14):
            pairs = nodes(order, longest, delta)
            claim("one sign", all(c < 0 for _, c in pairs))
            k = 33
            while k <= longest:
                total = mpmath.fsum(c * mpmath.exp(-k * p) for p, c in pairs)
                worst = largest((worst, abs(total / exact(order, k) - 1) / delta))
                k = min(3 * k, longest) if k < longest else longest + 1
claim("(12.6) every weight sampled is within delta", worst <= 1)
claim("(12.6) and not by more than a factor of 20", worst >= 0.05)

#> modes
p, c = symbols("p c")
terms = symbols("y0:9")
state = 0
for k in range(9):
    state = state + terms[k] - p * state  # (12.12)
    prove(f"(12.12) z = sum_j (1 - p)^j y_(k-j), k = {k}",
          expand(state - sum((1 - p) ** j * terms[k - j] for j in range(k + 1))))
#< modes

#> energy
# (12.15) in R^2: (9.3) without a force, with X for the damping, times the mean displacement.
m1, m2, C11, C12, C22, r1, r2, h, kappa = symbols("m1 m2 C11 C12 C22 r1 r2 h kappa", positive=True)
M, C, rho = Matrix([[m1, 0], [0, m2]]), Matrix([[C11, C12], [C12, C22]]), Matrix([[r1, 0], [0, r2]])
before, here, after, X = (Matrix(symbols(f"{name}1:3")) for name in ("p", "q", "n", "X"))
S = lambda u, w: kappa * u + (1 - kappa) * w
residual = (M * (after - 2 * here + before) / h**2 + kappa * C * S(here, after)
            + (1 - kappa) * C * S(before, here) + rho * X)
form = lambda A, u: (u.T * A * u)[0] / 2
energy = lambda u, w: (form(M - h**2 * (1 - 2 * kappa)**2 * C / 4, w - u) / h**2
                       + form(C, (u + w) / 2))
mean = (after - before) / 2
prove("(12.15) the energy changes by the work on the mean displacement",
      expand(energy(here, after) - energy(before, here) + (mean.T * rho * X)[0]
             - (mean.T * residual)[0]))
#< energy

#> kernels
# (12.13), z = e^{-i phi}: (1 + z)/(1 - z) = -i cot(phi/2).
phi = symbols("phi", real=True)
z = exp(-I * phi)
prove("(12.13) the work of a wave", (1 + z) * sin(phi / 2).rewrite(exp) + I * cos(phi / 2).rewrite(exp) * (1 - z))
length = 8
a = symbols(f"a1:{length + 1}") + (0, 0)
kernel = lambda k: sum((k + 1 - l) * sin(l * phi) for l in range(1, k + 1))
prove("(12.13) sum a_k sin(k phi) = sum (second difference) K_k",
      expand(sum((a[k - 1] - 2 * a[k] + a[k + 1]) * kernel(k) for k in range(1, length + 1))
             - sum(a[k - 1] * sin(k * phi) for k in range(1, length + 1))))
for k in range(1, length):
    difference = 4 * sin(phi / 2)**2 * kernel(k) - (k + 1) * sin(phi) + sin((k + 1) * phi)
    prove("(12.13) K_k = ((k + 1) sin(phi) - sin((k + 1) phi)) / (4 sin^2(phi/2))",
          expand(difference.rewrite(exp)))
prove("(12.13) beta > 1: sum_{k >= 2} k (a_{k-1} - a_k) = a_1 + sum a_k", expand(
    sum(k * (a[k - 2] - a[k - 1]) for k in range(2, length + 2)) - a[0] - sum(a)))
n = symbols("n", positive=True)
ratio = lambda k: (k - nu) / (k + 1)        # a_{k+1} / a_k, by (4.2)
prove("(12.13) the bend of the weights, relative to a_n",
      1 - 2 * ratio(n) + ratio(n) * ratio(n + 1) - (1 + nu) * (2 + nu) / ((n + 1) * (n + 2)))
prove("(12.13) a_{n-1} - a_n, relative to a_n",
      1 / ratio(n - 1) - 1 - (1 + nu) / (n - 1 - nu))
prove("(12.13) W_n, relative to a_n",
      gammasimp(gamma(n + 1 - nu) / (nu * gamma(n - nu))) - (n - nu) / nu)
claim("(12.13) delta = 1/2000 is small enough at the joint",
      Rational(1, 2000) < min(Rational(2, 32 * 33), Rational(2, 33 * 34) / 3))
#< kernels
worst = 0
for order in (0.01, 0.3, 0.7, 0.99):
    for longest in (128, 10 ** 5, 10 ** 9):
        for delta in (0.0005, 1e-8, 1e-14):
            delta = smallest((delta, 16 / longest))
            drop = mpmath.fsum(c * mpmath.exp(-longest * p) * mpmath.expm1(p)
                               for p, c in nodes(order, longest, delta))
            want = exact(order, longest) * (1 + order) / (longest - 1 - order)
            worst = largest((worst, abs(drop / want - 1) / delta))
claim("(12.13) the last step of the weights in use is within 20 delta", worst <= 20)

# ---- exact values -------------------------------------------------------------

header("verify/memory/memory.py")
ORDERS = [2.0 ** -30, 0.02, 0.2, 0.5, 0.8, 0.98, 1 - 2.0 ** -30]
LAGS = [33, 34, 40, 64, 100, 333, 1000, 10 ** 4, 10 ** 5, 10 ** 6, 10 ** 7, 10 ** 8]


def hex_weight(order, k):
    def value(digits):
        mpmath.mp.dps = digits + 30  # binomial subtracts orders from integers and so needs more digits
        return mpmath.nstr(exact(order, k), digits)
    return hexd_real(value)


table("ref_tail", "double nu; size_t n; double want;",
      [[hexd(o), k, hex_weight(o, k), f"nu = {o!r}"] for o in ORDERS for k in LAGS])

# sum_{n >= 33} |w_n|, which by (4.3) is the weight of order nu - 1 at n = 32.
table("ref_rest", "double nu; double want;",
      [[hexd(o), hex_weight(Rational(o) - 1, 32), f"nu = {o!r}"] for o in ORDERS])

# (12.1) with small integers and orders 1/2 and 3/2: the results are dyadic, so they are exact doubles.
data = [(7 * j * j + 3 * j + 5) % 11 - 5 for j in range(24)]
array("ref_terms", data, "x_k")
for name, order in (("ref_sums_half", Rational(1, 2)), ("ref_sums_three_halves", Rational(3, 2))):
    sums = [sum(weight(order, j) * data[k - j] for j in range(k + 1)) for k in range(24)]
    claim("the sums are doubles", all(Rational(float(h)) == h for h in sums))
    array(name, sums, f"H_k of order {order}")
