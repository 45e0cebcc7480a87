"""H 13. Convolution quadratures, and the integrators of order 2.

Proved here with symbols; weights, sequences, alpha, theta, kappa and potential are open unless stated otherwise:
  (13.3)  integration by parts and time reversal, any weights (N = 5);
  (13.4)  orders add for the powers of any delta with delta(0) = 1; the three
          deltas have delta(z)^beta = delta(0)^beta (...)^beta (n <= 6);
  (13.5)  L1 weights come from a piecewise linear path; their orders do not add;
  (13.7)  both halves of the restricted variation of the action with the
          out-of-phase term, N = 5; the residuals have a factor x_0 or y_N;
  (13.8)  the expansions that give theta = alpha, and order 2 of BDF2;
  (13.10) the momentum form is (13.7), with the momentum (13.9) at both its ends;
  (13.11) delta of BDF2 is (1 - z) (3 - z)/2;
  (13.13) to (13.15), (13.17) arguments on the unit circle, values at -1;
  (13.16) is of order 2;
  (13.18), (13.19) the impulses of a line.
Printed: weights by the binomial series, 60 and 90 digits; trajectories of the three-term equation (13.7) as the
chapter prints it, with the derivative of order alpha taken twice; growth factors by bisection."""
import mpmath
from sympy import (Function, I, Rational, binomial, cos, diff, exp, expand,
                   expand_func, gamma, im, integrate, limit, numer, oo, pi, re, series,
                   simplify, sin, sqrt, symbols, together, trigsimp)

from shared.refgen import claim, header, hexd, hexd_real, prove, table

alpha, beta, gam = symbols("alpha beta gamma", positive=True)
h, m, rho, theta, kappa, s, z = symbols("h m rho theta kappa s z")

# ---- any weights ----------------------------------------------------------------

N = 5
w = symbols(f"w0:{N + 2}")
F, G = symbols(f"F0:{N + 1}"), symbols(f"G0:{N + 1}")


#> operators
def back(v, z):
    """Return the retarded sum, sum_n v_n z_{k-n}, for all k."""
    return [sum(v[n] * z[k - n] for n in range(k + 1)) for k in range(len(z))]


def ahead(v, z):
    """Return the advanced sum, sum_n v_n z_{k+n}, for all k."""
    return [sum(v[n] * z[k + n] for n in range(len(z) - k)) for k in range(len(z))]


dot = lambda a, b: sum(p * q for p, q in zip(a, b))
prove("(13.3) by parts", expand(dot(G, back(w, F)) - dot(ahead(w, G), F)))
for left, right in zip(ahead(w, G), reversed(back(w, G[::-1]))):
    prove("(13.3) reversal", expand(left - right))
#< operators


#> series
def power_series(u, order, count):
    """Return the coefficients of (1 + u_1 z + u_2 z^2 + ...)^order by the binomial series."""
    result, power = [0] * count, [1] + [0] * (count - 1)  # u(z)^j, j = 0, 1, ...
    for j in range(count):
        c = expand_func(binomial(order, j))
        result = [a + c * b for a, b in zip(result, power)]
        power = [sum(u[i] * power[n - i] for i in range(1, n + 1)) for n in range(count)]
    return [expand(c) for c in result]


u = (1, *symbols("u1:7"))
one, two = power_series(u, beta, 7), power_series(u, gam, 7)
for left, right in zip(back(one, two), power_series(u, beta + gam, 7)):
    prove("(13.4) orders add, whatever delta", expand(left - right))
#< series

DELTA = {
    "EULER": 1 - z,
    "BDF2": (1 - z) + (1 - z) ** 2 / 2,
    "TRAPEZOID": 2 * (1 - z) / (1 + z),
}


def normalised(kind, count):
    """Return the coefficients of delta(z)/delta(0)."""
    d = DELTA[kind]
    part = series(d / d.subs(z, 0), z, 0, count).removeO()
    return [part.coeff(z, n) for n in range(count)]


prove("(13.11)", expand(DELTA["BDF2"] - (1 - z) * (3 - z) / 2))
f = ((1 - z) / (1 + z)) ** beta
prove("the recurrence of the trapezoidal weights", (1 - z**2) * diff(f, z) / f + 2 * beta)

#> l1
t, a0, a1 = symbols("t a0 a1", positive=True)
n = symbols("n", positive=True)
# The integral over one step of (t_k - t)^(-alpha)/Gamma(1 - alpha), times a slope of 1.
piece = integrate(t ** (-Rational(1, 2)), (t, n, n + 1)) / gamma(Rational(1, 2))
prove("(13.5) one step of the integral, alpha = 1/2",
      piece - (sqrt(n + 1) - sqrt(n)) / gamma(Rational(3, 2)))
prove("(13.5) the same for any alpha, by its derivative",
      simplify(diff(n ** (1 - alpha) / gamma(2 - alpha), n) * gamma(1 - alpha)
               - n ** (-alpha)).rewrite(gamma).simplify())
claim("(13.5) twice the order 1/2 is not order 1: w_0^2 = 4/pi",
      (1 / gamma(Rational(3, 2))) ** 2 == 4 / pi)
#< l1

# ---- the action with the out-of-phase term ---------------------------------------

x, y = symbols(f"x0:{N + 1}"), symbols(f"y0:{N + 1}")

#> action
coupling = (-h * rho * (1 - theta) * dot(back(w, x), ahead(w, y))
            - h * rho * theta * dot(back(w, x)[1:], ahead(w, y)[:-1]))
twice = back(back(w, w[: N + 1]), x)            # two derivatives in a row
later = ahead(back(w, w[: N + 1]), y)
for k in range(1, N):
    of_x = diff(coupling, y[k]) + h * rho * ((1 - theta) * twice[k] + theta * twice[k + 1])
    of_y = diff(coupling, x[k]) + h * rho * ((1 - theta) * later[k] + theta * later[k - 1])
    prove("(13.7) what is left has a factor x_0",
          expand(of_x - h * rho * theta * w[0] * w[k + 1] * x[0]))
    prove("the mirror: a factor y_N",
          expand(of_y - h * rho * theta * w[0] * w[N + 1 - k] * y[N]))
#< action
# The mirror image of x is its reversal: later of y reversed is twice of x.
for k in range(N + 1):
    mirrored = later[N - k].subs(dict(zip(y, reversed(x))), simultaneous=True)
    prove("y_k = x_{N-k} solves the other half", expand(mirrored - twice[k]))

#> order
# On e^{st}, with h = 1, the weights act as s^b (delta(e^-s)/s)^b. The expansion goes to second order in s.
b = symbols("b")
power = lambda r: series(exp(b * (r[0] * s + r[1] * s**2)), s, 0, 3).removeO()
LOG = {"EULER": (-Rational(1, 2), Rational(1, 24)), "BDF2": (0, -Rational(1, 3))}
for kind, r in LOG.items():
    once = series(DELTA[kind].subs(z, exp(-s)) / s, s, 0, 3).removeO()
    prove("the logarithm of delta(e^-s)/s", expand(once - power(r).subs(b, 1)))
shift = 1 - theta + theta * (1 + s + s**2 / 2)                  # the mean of D_k and D_{k+1}
euler = expand(power(LOG["EULER"]) * shift)
prove("(13.8) the term in s", euler.coeff(s, 1) - (theta - b / 2))
prove("(13.8) theta = b/2 = alpha: the next term",
      expand(euler.coeff(s, 2).subs(theta, b / 2) - b * (7 - 3 * b) / 24))
prove("(13.8) BDF2", power(LOG["BDF2"]).coeff(s, 1), power(LOG["BDF2"]).coeff(s, 2) + b / 3)
#< order

# ---- the momentum form -------------------------------------------------------------

grad = Function("g")
X, D, left, right = (symbols(f"{v}0:3") for v in ("X", "D", "L", "R"))  # F(t_k -), F(t_k +)
D1 = lambda p, q: -m * (q - p) / h - kappa * h * grad(kappa * p + (1 - kappa) * q)
D2 = lambda p, q: m * (q - p) / h - (1 - kappa) * h * grad(kappa * p + (1 - kappa) * q)
mean = (left[1] + right[1]) / 2
equation = (D1(X[1], X[2]) + D2(X[0], X[1])
            - h * rho * ((1 - theta) * D[1] + theta * D[2]) + h * mean)        # (13.7)
momentum = D2(X[0], X[1]) + h / 2 * (left[1] - rho * D[1])                     # (13.9)
#> meets
meets = (momentum + h / 2 * right[1]
         - h * rho * ((Rational(1, 2) - theta) * D[1] + theta * D[2]))
prove("(13.10) the equation for dx is (13.7)", expand(meets + D1(X[1], X[2]) - equation))
g1 = grad(kappa * X[1] + (1 - kappa) * X[2])
after = (momentum + h / 2 * (right[1] + left[2]) - h * g1
         - h * rho * ((Rational(1, 2) - theta) * D[1] + (Rational(1, 2) + theta) * D[2]))
at_end = D2(X[1], X[2]) + h / 2 * (left[2] - rho * D[2])
prove("(13.10) and then p_{k+1} is (13.9) again", expand(after - at_end - equation))
#< meets
prove("alpha = 1/2: the loss of a step is rho dx, the midpoint rule",
      ((Rational(1, 2) - theta) * D[1] + (Rational(1, 2) + theta) * D[2]).subs(theta, Rational(1, 2))
      - D[2])

# ---- stability --------------------------------------------------------------------

#> shift
phi, a = symbols("phi a", positive=True)
weight = 1 - a + a * exp(I * phi)                     # (1 - theta) + theta/z, z = e^{-i phi}
square = simplify((re(weight.rewrite(cos)) ** 2 + im(weight.rewrite(cos)) ** 2).expand())
turning = (re(weight.rewrite(cos)) * diff(im(weight.rewrite(cos)), phi)
           - im(weight.rewrite(cos)) * diff(re(weight.rewrite(cos)), phi)) / square
prove("(13.14) the argument a (pi - phi) + arg(1 - a + a e^{i phi}) is monotone",
      trigsimp(simplify((turning - a) * square + a * (1 - a) * (1 - 2 * a) * (1 - cos(phi)))))
#< shift
#> stable
g = (1 - 2 * a) / 2                                   # g_1; g_0 = 1 - g, b = 2 a
taps = (1 - g) + g * exp(-I * phi)                    # g_0 + g_1 z, its argument is -psi
square = (1 - g) ** 2 + 2 * g * (1 - g) * cos(phi) + g**2
prove("(13.17) |g_0 + g_1 z|^2", trigsimp(expand(
    (taps * taps.subs(I, -I)).rewrite(cos) - square)))
turning = g * (g + (1 - g) * cos(phi)) / square       # d psi / d phi
tangent = g * sin(phi) / (1 - g + g * cos(phi))
slope = numer(together(diff(tangent, phi) - turning * (1 + tangent**2)))    # a multiple of sin^2
prove("(13.17) the slope of psi = atan(g sin / (1 - g + g cos))",
      expand(expand(slope).subs(sin(phi), sqrt(1 - cos(phi) ** 2))))
prove("(13.17) g - psi' has the sign of g", expand(
    (g - turning) * square - g * (1 - g) * (1 - 2 * g) * (1 - cos(phi))))
b = symbols("b", positive=True)
late = ((1 + b) / 2 + (1 - b) / 2 * exp(-s)) * (1 + exp(s)) / 2
prove("(13.16) order 2: no term of order s", series(
    ((1 - exp(-s)) / s) ** b * late, s, 0, 2).removeO() - 1)
#< stable
#> line
bdf = (1 - z) + (1 - z) ** 2 / 2
summed = bdf * z / (1 - z) ** 2 * (1 + z) / 2 / (1 - z)      # for a dashpot, o = 1, h = 1: the sums R_k of the line
prove("(13.18) a dashpot's R_1 is 3/4, then it is k", series(summed - (z / (1 - z) ** 2 - z / 4), z, 0, 9).removeO())
e = exp(-s)                                                  # the transform for o = b: s^(b - 3) (1 - b/3 s^2 + ...)
line = (bdf.subs(z, e) / s) ** b * s**2 * e / (1 - e) ** 2 * s * (1 + e) / 2 / (1 - e)
prove("(13.19) the difference is b/3 s^2 of it", series(line, s, 0, 3).removeO() - (1 - b * s**2 / 3))
#< line
#> bdf2
delta = DELTA["BDF2"].subs(z, exp(-I * phi)).rewrite(cos).expand()
prove("(13.14) Re delta = (1 - cos)^2, Im delta = sin (2 - cos)",
      trigsimp(simplify(re(delta) - (1 - cos(phi)) ** 2)),
      trigsimp(simplify(im(delta) - sin(phi) * (2 - cos(phi)))))
#< bdf2
W, R = symbols("W R", positive=True)
P = lambda delta, th: ((1 + kappa * (1 - kappa) * W) * (1 / z - 2 + z) + W
                       + R * delta ** (2 * alpha) * (1 - th + th / z))
prove("(13.14) P(-1), shifted", P(DELTA["EULER"], alpha).subs(z, -1) - (
    W * (1 - 2 * kappa) ** 2 + 4**alpha * (1 - 2 * alpha) * R - 4))
prove("(13.14) P(-1), BDF2", P(DELTA["BDF2"], 0).subs(z, -1) - (
    W * (1 - 2 * kappa) ** 2 + 4 ** (2 * alpha) * R - 4))
claim("(13.15) the trapezoidal delta has a pole at -1",
      limit(DELTA["TRAPEZOID"], z, -1, "+") == oo)
prove("alpha = 1: Algorithm 1 with the mass m + rho", together(
    P(DELTA["EULER"], 1).subs(alpha, 1) - ((1 + R + kappa * (1 - kappa) * W) * (1 / z - 2 + z) + W)))

# ---- values for the tests of the C code --------------------------------------------

DELTA_0 = {"EULER": 1, "BDF2": Rational(3, 2), "TRAPEZOID": 2}
COUNT = 24
RATIO = {kind: normalised(kind, COUNT) for kind in DELTA}
number = lambda q: mpmath.mpf(int(Rational(q).p)) / int(Rational(q).q)


#> weights
def weights(kind, order, count):
    """Return w_n by the binomial series in delta/delta(0) - 1, or by (13.5)."""
    order = number(order)
    if kind == "L1":
        c = [number(n) ** (1 - order) for n in range(count + 1)]
        slopes = [c[n + 1] - c[n] for n in range(count)]
        return [v / mpmath.gamma(2 - order) for v in
                [slopes[0]] + [slopes[n] - slopes[n - 1] for n in range(1, count)]]
    u = [number(v) for v in RATIO[kind][:count]]
    result, power = [mpmath.mpf(0)] * count, [mpmath.mpf(1)] + [mpmath.mpf(0)] * (count - 1)
    for j in range(count):
        c = mpmath.binomial(order, j)
        result = [p + c * q for p, q in zip(result, power)]
        power = [mpmath.fsum(u[i] * power[n - i] for i in range(1, n + 1)) for n in range(count)]
    return [number(DELTA_0[kind]) ** order * v for v in result]
#< weights


def both(values, count):
    """Return values() at 60 and 90 digits, as hex literals of doubles."""
    found = {}
    for digits in (60, 90):
        mpmath.mp.dps = digits + 30
        found[digits] = values()
    return [hexd_real(lambda d, i=i: mpmath.nstr(found[d][i], d)) for i in range(count)]


header("verify/convolution_quadrature/convolution_quadrature.py")
ORDERS = [0.1, 0.5, 0.9, 1.2, 1.5, 1.8]
rows = []
for kind in ("EULER", "BDF2", "TRAPEZOID", "L1"):
    for order in ORDERS:
        if kind != "L1" or order < 1:
            values = both(lambda: weights(kind, order, COUNT), COUNT)
            rows += [[f"FVI_DELTA_{kind}", hexd(order), k, values[k]] for k in (0, 1, 2, 3, 7, 23)]
print(f"\nenum {{ REF_COUNT = {COUNT} }};")
table("ref_weights", "fvi_delta kind; double beta; size_t n; double want;", rows)

Q = Rational


class Case:
    """One mass with U = c x^2/2 + g x^3/3 and F = a for t <= T, then 0."""
    def __init__(self, name, kind, alpha, kappa, h, steps, c, rho, x0, p0, mass=1, g=0,
                 step=(0, 0), exact=False):
        self.name, self.kind, self.alpha, self.kappa, self.h, self.steps = (
            name, kind, Q(alpha), Q(kappa), Q(h), steps)
        self.c, self.rho, self.x0, self.p0, self.mass, self.g = map(Q, (c, rho, x0, p0, mass, g))
        self.step, self.exact = tuple(map(Q, step)), exact
        self.theta = self.alpha if kind == "EULER" else Q(0)


#> definition
def trajectory(case):
    """Return the positions from (13.7) as the chapter prints it, with the derivative of order alpha taken twice."""
    h, K, m, rho, th = map(number, (case.h, case.kappa, case.mass, case.rho, case.theta))
    grad = lambda v: number(case.c) * v + number(case.g) * v * v
    # h and T are doubles that stand for decimal fractions. Rounding to 12 digits makes a jump at a node a jump at the
    # node.
    late = lambda k: round(float(k * case.h - case.step[1]), 12)
    pushed = lambda k, side: late(k) < 0 or (late(k) == 0 and side < 0)
    force = lambda k, side: number(case.step[0]) if pushed(k, side) else 0
    w, scale = weights(case.kind, case.alpha, case.steps + 1), h ** (-2 * number(case.alpha))
    start, v0 = number(case.x0), number(case.p0) / m
    X, P = [start], [number(case.p0)]
    fall = lambda k: start + (k * h * v0 if case.alpha > Q(1, 2) else 0)
    D = lambda X: scale * dot(w, back(w, [v - fall(j) for j, v in enumerate(X)])[::-1])
    slope = lambda q: (1 - K) * (number(case.c) + 2 * number(case.g) * q)
    for k in range(case.steps):
        if k == 0:      # (13.9) at k = 0, where D_0 = 0
            want = P[0] + h / 2 * force(0, 1)
        else:
            S = K * X[k - 1] + (1 - K) * X[k]
            want = (m * (X[k] - X[k - 1]) / h - (1 - K) * h * grad(S)
                    - h * rho * (1 - th) * D(X) + h * (force(k, -1) + force(k, 1)) / 2)
        new = X[k] + h * v0
        for _ in range(10 if case.g else 1):
            S = K * X[k] + (1 - K) * new
            residual = m * (new - X[k]) / h + K * h * grad(S) + h * rho * th * D(X + [new]) - want
            new -= residual / (m / h + K * h * slope(S) + h * rho * th * scale * w[0] ** 2)
        X.append(new)
        S = K * X[k] + (1 - K) * new
        P.append(m * (new - X[k]) / h - (1 - K) * h * grad(S) + h / 2 * (force(k + 1, -1) - rho * D(X)))
    return X + P
#< definition


CASES = [
    Case("shifted, alpha = 1/2", "EULER", Q(1, 2), Q(1, 2), Q(1, 2), 9, 8, 2, 1, Q(1, 2), exact=True),
    Case("shifted, alpha = 1/4", "EULER", Q(1, 4), Q(1, 2), Q(1, 4), 8, 32, 16, 1, 2, exact=True),
    Case("shifted, alpha = 3/4", "EULER", Q(3, 4), Q(1, 2), Q(1, 4), 7, 40, 1, 1, Q(1, 2), exact=True),
    Case("shifted, alpha = 3/4, step force", "EULER", Q(3, 4), Q(1, 2), Q(1, 4), 7, 40, 1, 0, 0,
         step=(4, Q(1, 2)), exact=True),
    Case("shifted, alpha = 1", "EULER", 1, Q(1, 2), Q(1, 4), 8, 32, Q(1, 2), 1, 1, exact=True),
    Case("shifted, alpha = 0", "EULER", 0, Q(1, 2), Q(1, 4), 8, 64, 1, 1, 1, exact=True),
    Case("bdf2, alpha = 1/2", "BDF2", Q(1, 2), Q(1, 2), Q(1, 4), 8, 64, 1, 1, 1, step=(4, Q(3, 4)),
         exact=True),
    Case("bdf2, alpha = 1", "BDF2", 1, Q(1, 2), Q(1, 4), 7, 64, Q(1, 8), 1, 1, exact=True),
    Case("shifted, cubic, alpha = 0.1", "EULER", 0.1, Q(1, 2), 0.1, 16, 1, 0.5, 0.5, 0.75, g=1,
         step=(1, 0.5)),
    Case("shifted, cubic, kappa = 1/4, alpha = 0.8", "EULER", 0.8, Q(1, 4), 0.1, 16, 1, 0.5, 0.5, 0.75,
         mass=2, g=1),
    Case("bdf2, alpha = 0.1", "BDF2", 0.1, Q(1, 2), 0.1, 16, 1, 0.5, 1, 0.5, step=(1, 0.5)),
    Case("bdf2, alpha = 1/4", "BDF2", Q(1, 4), Q(1, 4), 0.125, 16, 2, 0.5, 1, 0.5, mass=2),
    Case("bdf2, alpha = 3/4", "BDF2", Q(3, 4), Q(1, 2), 0.0625, 16, 2, 0.5, 1, 0.5, mass=2),
    Case("bdf2, cubic, kappa = 3/4, alpha = 0.9", "BDF2", 0.9, Q(3, 4), 0.05, 16, 1, 0.5, 0.5, 0.75, g=1),
]
runs, rows = [], []
for case in CASES:
    values = both(lambda: trajectory(case), 2 * case.steps + 2)
    if case.exact:
        mpmath.mp.dps = 200
        claim(f"{case.name}: every value is a double", all(abs(v - float(v)) < 1e-150 for v in trajectory(case)))
    runs.append([f'"{case.name}"', int(case.kind == "BDF2"), hexd(case.alpha), hexd(case.kappa), hexd(case.h),
                 case.steps, hexd(case.mass), hexd(case.rho), hexd(case.x0), hexd(case.p0),
                 "{ " + ", ".join(map(hexd, (case.c, case.g))) + " }",
                 "{ " + ", ".join(map(hexd, case.step)) + " }", int(case.exact), len(rows)])
    rows += [[values[k], values[case.steps + 1 + k]] for k in range(case.steps + 1)]
table("ref_runs", "const char *name; int bdf2; double alpha, kappa, h; size_t steps; double mass, rho, "
      "x0, p0, cg[2], step[2]; int exact; size_t first;", runs)
table("ref_rows", "double x, p;", rows)


def growth(kind, theta, alpha, kappa, W, R, digits):
    """Return 1/|z| for the growing solution that alternates in sign, by bisection on (-1, 0)."""
    mpmath.mp.dps = digits + 15
    theta, alpha, kappa, W, R = (mpmath.mpf(v) for v in (theta, alpha, kappa, W, R))
    d = {"EULER": lambda v: 1 - v, "BDF2": lambda v: 1 - v + (1 - v) ** 2 / 2,
         "TRAPEZOID": lambda v: 2 * (1 - v) / (1 + v)}[kind]
    Qz = lambda v: ((1 + kappa * (1 - kappa) * W) * (1 - v) ** 2 + v * W
                    + R * d(v) ** (2 * alpha) * ((1 - theta) * v + theta))
    low, high = -1 + mpmath.mpf(10) ** -30, mpmath.mpf(0)
    claim("one change of sign", Qz(low) < 0 < Qz(high))
    for _ in range(4 * (digits + 15)):
        middle = (low + high) / 2
        low, high = (middle, high) if Qz(middle) < 0 else (low, middle)
    return mpmath.nstr(-1 / low, digits)


GROWTHS = [("EULER", 0, 0.5, 0.5, 1, 2.2), ("EULER", 0.25, 0.25, 0.5, 1, 6), ("EULER", 0.1, 0.1, 0.25, 2, 5),
           ("BDF2", 0, 0.25, 0.5, 1, 2.1), ("BDF2", 0, 0.75, 0.5, 1, 0.6), ("BDF2", 0, 1, 0, 0.5, 0.25),
           ("TRAPEZOID", 0, 0.75, 0.5, 1, 0.01), ("TRAPEZOID", 0, 0.25, 0.5, 1, 0.1),
           ("TRAPEZOID", 0, 0.5, 0, 2, 0.5)]
table("ref_growth", "fvi_delta kind; double theta, alpha, kappa, W, R, want;",
      [[f"FVI_DELTA_{row[0]}", *map(hexd, row[1:]), hexd_real(lambda d, r=row: growth(*r, d), 50)]
       for row in GROWTHS])
