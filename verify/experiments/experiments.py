"""H 10, the linearly damped oscillator. (The problem of order 3/2 is in experiments_bagley_torvik.py.)

Proved with symbols: the closed form (10.1) solves the oscillator in all three cases; the determinants (10.4) and the
rate of decay (10.5) that follows from them; the modified equation (10.6) of the FVI at alpha = 1/2, with its
momentum. Claimed at the paper's parameters: the rational values at h = 1/2; the steps and quantities that give a
slope of 0.94; that the errors tend to (10.7).

Printed: the oscillator from the exponential of its matrix; trajectories of the three-term equation (9.3) and of
Euler's methods with many digits; the errors that the C code must reproduce."""
from fractions import Fraction
from functools import cache

import mpmath
from sympy import (Matrix, Rational, cos, diff, exp, expand, factorial, lambdify, log,
                   series, simplify, sin, solve, sqrt, symbols)

from shared.refgen import claim, header, hexd, hexd_real, prove, table

m, rho, c, h, t = symbols("m rho c h t", positive=True)
x0, p0 = symbols("x0 p0")

# ---- (10.1): the closed form ----

#> closed-form
w, q = symbols("w q", positive=True)        # frequency, half the distance of two rates
L = rho / (2 * m)
slow = L - q
CASES = {                     # c in terms of the other parameters; decay, A, B, G of (10.1)
    "under": (m * (w**2 + L**2), L, cos(w * t) + L * sin(w * t) / w,
              cos(w * t) - L * sin(w * t) / w, sin(w * t) / w),
    "critical": (m * L**2, L, 1 + L * t, 1 - L * t, t),
    "over": (m * (L**2 - q**2), slow, 1 + slow * (1 - exp(-2 * q * t)) / (2 * q),
             exp(-2 * q * t) - slow * (1 - exp(-2 * q * t)) / (2 * q),
             (1 - exp(-2 * q * t)) / (2 * q)),
}
for name, (stiffness, rate, A, B, G) in CASES.items():
    x = exp(-rate * t) * (x0 * A + p0 / m * G)
    p = exp(-rate * t) * (p0 * B - stiffness * x0 * G)
    prove(f"(10.1) {name}: p = m x'", expand(m * diff(x, t) - p))
    prove(f"(10.1) {name}: p' = -c x - rho p / m",
          expand(diff(p, t) + stiffness * x + rho * p / m))
    prove(f"(10.1) {name}: start", x.subs(t, 0) - x0, p.subs(t, 0) - p0)
prove("the slower rate without a difference",
      (slow - 2 * c / (rho + 2 * m * q)).subs(c, CASES["over"][0]))
#< closed-form

# ---- (10.4), (10.5): determinants ----

#> determinants
a, b = symbols("a b")                       # x_{k+1}, p_{k+1}
X, P = symbols("X P")                       # x_k, p_k
METHODS = {
    "explicit": [a - X - h * P / m, b - P + h * (c * X + rho * P / m)],
    "implicit": [a - X - h * b / m, b - P + h * (c * a + rho * b / m)],
    "fvi": [P - m * (a - X) / h - h * c * (X + a) / 4,          # P = -D1 L_d
            b - m * (a - X) / h + h * c * (X + a) / 4 + rho * (a - X)],
}
DET = {}
for name, equations in METHODS.items():
    after = solve(equations, [a, b], dict=True)[0]
    DET[name] = simplify(Matrix([after[a], after[b]]).jacobian([X, P]).det())
W = h**2 * c / m
prove("(10.4)", DET["explicit"] - (1 - h * rho / m + W),
      DET["implicit"] - 1 / (1 + h * rho / m + W), DET["fvi"] - (1 - h * rho / m / (1 + W / 4)))
damped = rho**2 / (2 * m**2)
EXCESS = {"explicit": c / m - damped, "implicit": damped - c / m, "fvi": -damped}
for name, want in EXCESS.items():
    rate = series(log(DET[name]), h, 0, 3).removeO()    # log det = -h rho / m exactly
    prove(f"(10.5) {name}", rate + h * rho / m - h**2 * want)
#< determinants

# ---- (10.6): the modified equation ----

#> modified
d = symbols("d0:6")                         # a smooth x and its derivatives at t_k
at = lambda s: sum(d[i] * s**i / factorial(i) for i in range(6))
x_, x__, x___ = at(-h), at(0), at(h)
fvi = (m * (x___ - 2 * x__ + x_) / h**2 + c * (x___ + 2 * x__ + x_) / 4
       + rho * (x__ - x_) / h)              # (9.3), alpha = kappa = 1/2, U = c x^2 / 2
m_eff = m - rho * h / 2
order_2 = lambda e: [expand(e).coeff(h, i) for i in range(2)]
residual = m_eff * d[2] + rho * d[1] + c * d[0]
prove("(10.6) the equation", *order_2(fvi - residual))
momentum = m * (x___ - x__) / h + h * c * (x___ + x__) / 4      # p_k = -D1 L_d
on_shell = momentum.subs(d[0], -(m * d[2] + rho * d[1]) / c)
prove("(10.6) the momentum", *order_2(on_shell - m_eff * d[1]))
#< modified

# ---- (10.7): the constant of the error ----

mpmath.mp.dps = 40
mpf = mpmath.mpf
RHO, X0, P0, T = mpf(0.2), mpf(1), mpf("0.5"), 15
values = {m: 1, c: 1, rho: Rational(0.2), x0: 1, p0: Rational(1, 2)}
omega = sqrt(c / m - L**2)
exact_x = exp(-L * t) * (x0 * cos(omega * t) + (p0 / m + L * x0) * sin(omega * t) / omega)
exact_p = m * diff(exact_x, t)
energy = lambda x, p: p * p / 2 + x * x / 2             # mass and stiffness 1


#> constant
def largest(e):
    """Return max |e(t)| for 0 <= t <= T, by a fine grid and bisection of the derivative."""
    f, slope = (lambdify(t, g, "mpmath") for g in (e, diff(e, t)))
    near = lambdify(t, e, "math")               # doubles suffice for the grid
    best = mpf(max(range(1, 50 * T + 1), key=lambda i: abs(near(i / 50)))) / 50
    top = mpmath.findroot(slope, (best - mpf(1) / 50, best + mpf(1) / 50), solver="anderson")
    claim("the maximum is near the best of the grid", abs(top - best) < mpf(1) / 50)
    return abs(f(top))


by_m = lambda e: diff(e, m).subs(values)    # x0 and p0 are kept; then m = 1
dx, dp = by_m(exact_x), by_m(exact_p)
x1, p1 = exact_x.subs(values), exact_p.subs(values)
#< constant

CONSTANTS = [RHO / 2 * largest(e) for e in (dx, dp, p1 * dp + x1 * dx)]

# ---- trajectories of linear systems, with many digits ----


def number(v):
    """Return a rational or a double as an exact number."""
    v = Fraction(v)
    return mpf(v.numerator) / v.denominator


@cache
def matrix_of(name, step):
    """Return the matrix of one step, by solving the equations above."""
    after = solve([e.subs({m: 1, c: 1, rho: Rational(0.2), h: Rational(step)})
                   for e in METHODS[name]], [a, b], dict=True)[0]
    M = Matrix([after[a], after[b]]).jacobian([X, P])
    return [[number(Fraction(int(v.p), int(v.q))) for v in M.row(i)] for i in range(2)]


def powers(M, N):
    """Return (x, p) after 0, 1, ..., N steps."""
    out = [(X0, P0)]
    for _ in range(N):
        out.append(tuple(row[0] * out[-1][0] + row[1] * out[-1][1] for row in M))
    return out


def steps_of(name, step, N):
    return powers(matrix_of(name, step), N)


def exact_steps(step, N):
    """Return exp(k h M) (x0, p0), by powers of the exponential of the matrix."""
    return powers(mpmath.expm(mpmath.matrix([[0, 1], [-1, -RHO]]) * number(step)).tolist(), N)


#> fractional
def fractional_steps(order, step, N):
    """Return the positions by (9.3) with weights of order 2 alpha, kappa = 1/2, c = m = 1, no force."""
    hh, order = number(step), number(order)
    g = [mpf(1)]
    for n in range(1, N + 1):
        g.append(g[-1] * (n - 1 - order) / n)
    x = [X0, (P0 + X0 / hh - hh * X0 / 4) / (1 / hh + hh / 4)]    # p_0 = -D1 L_d
    for k in range(1, N):
        memory = RHO * hh**-order * sum(g[n] * x[k - n] for n in range(k + 1))
        rest = (-2 * x[k] + x[k - 1]) / hh**2 + (2 * x[k] + x[k - 1]) / 4 + memory
        x.append(-rest / (1 / hh**2 + mpf(1) / 4))
    return x
#< fractional


def rounded(v):
    return hexd_real(lambda n: mpmath.nstr(v, n), 20)


def least_squares(points):
    """Return the slope of log error against log h."""
    u = [(mpmath.log(number(hh)), mpmath.log(e)) for hh, e in points]
    n = len(u)
    ux, uy = sum(p[0] for p in u) / n, sum(p[1] for p in u) / n
    return sum((p[0] - ux) * (p[1] - uy) for p in u) / sum((p[0] - ux)**2 for p in u)


# The oscillator, from the exponential of its matrix.
OSCILLATORS = [  # m, rho, c, x0, p0
    (1, 0.2, 1, 1, 0.5), (2, 3, 1, -1, 0.25), (0.5, 1, 0.5, 1, -2), (3, 0, 2, 0.5, 1),
    (1, 2, 1, 1, 0.5), (1, 2 - 2.0**-52, 1, 1, 0.5), (1, 2 + 2.0**-51, 1, 1, 0.5),
    (1, 2, 1 - 2.0**-40, 1, 0.5), (1, 2, 1 + 2.0**-40, -1, 1), (1, 2.001, 1, 1, 0.5),
    (0.3, 0.84**0.5, 0.7, 1, 0.5), (0.3, 0.84**0.5 - 2.0**-53, 0.7, 1, 0.5),
    (1 / 3, 0.2, 0.03, 1, 0.5), (1, 50, 1e-3, 1, -50), (1, 63, 1e-3, 1, 2), (1, 1, 0, 1, 2),
    (2, 0, 0, 1, 3), (1e-140, 1e-140, 1e-140, 1, 1e-140), (1e140, 1e140, 1e139, 1e-150, 1)]
rows = []
for oscillator in OSCILLATORS:
    critical = abs(oscillator[1]**2 - 4 * oscillator[0] * oscillator[2]) < 1e-9 * oscillator[1]**2
    for time in (0, 0.1, 1.5, 15, 40) + (400,) * critical:
        @cache
        def at_digits(n):
            mpmath.mp.dps = n + 60
            M, R, K, q0, r0, s = map(number, (*oscillator, time))
            mpmath.mp.dps = n + 60 + int(mpmath.log10(1 + R / M * s) + R / M * s)
            E = mpmath.expm(mpmath.matrix([[0, 1], [-K / M, -R / M]]) * s)  # the matrix acts on (x, p / m)
            return [mpmath.nstr((E[i, 0] * q0 + E[i, 1] * r0 / M) * (M if i else 1), n) for i in range(2)]
        rows.append([*map(hexd, map(Rational, oscillator)), hexd(Rational(time)),
                     *(hexd_real(lambda n: at_digits(n)[i], 40) for i in range(2)),
                     f"{oscillator}, t = {time}".replace("(", "").replace(")", "")])
mpmath.mp.dps = 40
header("verify/experiments/experiments.py")
table("ref_oscillator", "double m, rho, c, x0, p0, t, x, p;", rows)

# x for several alpha, h = 1/2, N = 30, and its distance from the exact x for alpha = 1/2.
line = exact_steps(0.5, 30)
rows = []
for order in (0, 0.25, 0.4, 0.5, 0.6, 0.75, 1):
    x = fractional_steps(2 * Fraction(order), 0.5, 30)
    far = max(abs(x[k] - line[k][0]) for k in range(31))
    rows.append([hexd(Rational(order)), "{ " + ", ".join(rounded(x[k]) for k in (1, 2, 5, 10, 20, 30))
                 + " }", rounded(far), f"alpha = {order}: x_30 = {mpmath.nstr(x[30], 12)}"])
print("\nstatic const size_t ref_alphas_k[] = { 1, 2, 5, 10, 20, 30 };")
table("ref_alphas", "double alpha, x[6], far;", rows)

#> rationals
R = Rational(1, 5)
x = [Rational(1), Rational(19, 17)]
for k in range(1, 4):
    rest = 4 * (-2 * x[k] + x[k - 1]) + (2 * x[k] + x[k - 1]) / 4 + R * 2 * (x[k] - x[k - 1])
    x.append(-rest / (4 + Rational(1, 4)))
claim("rational x at alpha = h = 1/2, rho = 1/5", x == [
    1, Rational(19, 17), Rational(1389, 1445), Rational(72883, 122825), Rational(1258381, 10440125)])
#< rationals

# Determinants and the runs of the Euler panels.
dets, rows = [], []
for name, step, N in (("implicit", 0.2, 75), ("fvi", 0.2, 75), ("explicit", 0.1, 150),
                      ("fvi", 0.1, 150), ("explicit", 0.2, 75), ("explicit", 0.5, 30)):
    (A, B), (C, D) = matrix_of(name, step)
    claim("a complex pair: the radius is the root of the determinant", (A + D)**2 < 4 * (A * D - B * C))
    dets.append([name.upper(), hexd(Rational(step)),
                 rounded(A * D - B * C), f"radius {mpmath.nstr(mpmath.sqrt(A * D - B * C), 12)}"])
    got, want = steps_of(name, step, N), exact_steps(step, N)
    EE = [energy(*u) - energy(*v) for u, v in zip(got, want)]
    rows.append([name.upper(), hexd(Rational(step)), N, rounded(got[N][0]), rounded(energy(*got[N])),
                 rounded(max(abs(u[0] - v[0]) for u, v in zip(got, want))),
                 rounded(max(map(abs, EE))), rounded(sum(EE) / (N + 1)),
                 f"h = {step}: mean of E - E(t) {mpmath.nstr(sum(EE) / (N + 1), 6)}"])
    claim("explicit Euler gains, implicit loses", name == "fvi" or (sum(EE) > 0) == (name == "explicit"))
print("\nenum { EXPLICIT, IMPLICIT, FVI };")
table("ref_det", "int method; double h, det;", dets)
table("ref_euler", "int method; double h; size_t N; double x, E, x_error, E_error, E_mean;", rows)
claim("explicit Euler at h = rho / c neither gains nor loses",
      DET["explicit"].subs(h, rho / c).simplify() == 1)

# Global errors of the FVI.
rows, errors = [], []
for step in (0.5, 0.25, 0.1, 0.05, 0.025, 0.0125, 0.00625, 0.003125):
    N = round(T / step)
    got, want = steps_of("fvi", step, N), exact_steps(step, N)
    e = [max(abs(f(*u) - f(*v)) for u, v in zip(got, want))
         for f in (lambda x, p: x, lambda x, p: p, energy)]
    errors.append((step, e))
    rows.append([hexd(Rational(step)), N, *map(rounded, e),
                 f"h = {step}: " + ", ".join(mpmath.nstr(v, 11) for v in e)])
table("ref_errors", "double h; size_t N; double x, p, E;", rows)
#> slopes
slopes = lambda first, last: [least_squares([(s, e[i]) for s, e in errors[first:last]])
                              for i in range(3)]
five, six = slopes(2, 7), slopes(2, 8)
claim("h = 0.1 ... 0.00625 gives 0.94 for x and p, 0.96 for E",
      [mpmath.nstr(s, 2) for s in five] == ["0.94", "0.94", "0.96"])
claim("coarse steps mislead: the error at h = 1/2 is below that at 1/4", errors[0][1][0] < errors[1][1][0])
claim("twice the time, the same errors", all(
    e[0] == max(abs(u[0] - v[0]) for u, v in zip(steps_of("fvi", s, 2 * round(T / s)),
                                                 exact_steps(s, 2 * round(T / s))))
    for s, e in errors[:4]))
for i in range(3):
    claim("(10.7) the errors tend to K h", abs(errors[-1][1][i] / number(errors[-1][0]) / CONSTANTS[i] - 1) < 0.011)
#< slopes
print("\n/* Slopes for x, p, E: h = 0.1 ... 0.00625, and with 0.003125. */")
table("ref_slopes", "double five, six;", [[rounded(u), rounded(v), mpmath.nstr(u, 5) + ", " + mpmath.nstr(v, 5)]
                                         for u, v in zip(five, six)])
print("\n/* (10.7): error / h in the limit, for x, p, E. */")
print("static const double ref_constants[] = { " + ", ".join(map(rounded, CONSTANTS)) + " };"
      f" /* {', '.join(mpmath.nstr(v, 9) for v in CONSTANTS)} */")
