"""The Course: the numbers that each stage of body.c must print, and the proofs of its steps.

Proved here:
  (3c), (3d), (3e)  one step of stage 3 makes the action of points stationary, for a generic U;
  (4d)  x = t, y = t - 1: the action is 5/4; its slope is 0 if both bodies vary, 1/6 if x alone varies;
  (5e)  moving a node of both bodies changes the action by the two residuals (5d), for a
        generic U, symbolic m, h, rho, kappa, and any weights, with the one assumption that
        the weights of order 2 alpha are the weights of order alpha, applied twice;
  (6d)  a run of (6c) and (6d) has residuals 0;
  (7b)  the kick is an error of the program's momentum: without the kick the runs from zero tend to
        the motion with the transform (s + p0)/(s^2 + 1 + rho s^(2 alpha));
  (8d)  at alpha = 1/2 and kappa = 1/2 a step for the mass m is the midpoint rule for the mass
        m - rho h/2, for a generic U; the motion of the mass m satisfies it only up to h;
  (10c) at the longest stable step of the running body, h = 2^(5/3), the load is 1;
  (12a) the delay alpha h disappears if theta = alpha.
  (12, what the principle buys)  the derivative of x_3 by rho is a sum over a second body that starts at 0
        with the momentum 1 and is read backwards, for every rho.
  (H 23, a method without an action)  for a stiffening spring the film of the equations with a quarter, a half and
        a quarter of the forces gives another derivative than two runs; the film of (3b) gives the same one.
Printed: the runs of the stages by the definition, as fractions where h = 1, else with 50 digits by double sums over
binomial coefficients."""
from fractions import Fraction as Q

import mpmath
from sympy import Function, Rational, Symbol, cos, diff, integrate, limit, pi, series, simplify, sin, sqrt, symbols
from sympy import exp as sympy_exp

from shared.refgen import array, claim, header, hexd, hexd_real, nearest, prove, table

# ---- proofs ----

m, h, rho, kappa, alpha, s, t = symbols("m h rho kappa alpha s t", positive=True)
U = Function("U")


def inside(a, b):
    return kappa * a + (1 - kappa) * b


def lagrangian(a, b):
    """Return the discrete Lagrangian (3b)."""
    return m * (b - a) ** 2 / (2 * h) - h * U(inside(a, b))


def slope_of_U(q):
    z = Symbol("z")
    return diff(U(z), z).subs(z, q).doit()


N = 4
X, Y = symbols("x0:5"), symbols("y0:5")
w = symbols("w0:5")                                 # weights of order alpha, any numbers
twice = [sum(w[i] * w[n - i] for i in range(n + 1)) for n in range(N + 1)]
k = 2

points = sum(lagrangian(X[j], X[j + 1]) for j in range(N))
p = -diff(lagrangian(X[k], X[k + 1]), X[k])         # the momentum before the step, which (3d) solves for x_{k+1}
before = m * (X[k + 1] - X[k]) / h + kappa * h * slope_of_U(inside(X[k], X[k + 1]))
prove("(3d) the step is solved for the momentum before it", (p - before).doit())
push = before - h * slope_of_U(inside(X[k], X[k + 1]))
prove("(3e) the push is the slope at the end of the step",
      (diff(lagrangian(X[k], X[k + 1]), X[k + 1]) - push).doit())
after = diff(lagrangian(X[k - 1], X[k]), X[k])
prove("(3c) stationary: the momentum after a step is the momentum before the next",
      (diff(points, X[k]) - (after - p)).doit())

# D_-^(1/2) t = 2 sqrt(t/pi) and D_+^(1/2) (t - 1) = -2 sqrt((1 - t)/pi), each of the path minus its held end.
damping = Rational(1, 2) * 4 * sqrt(t * (1 - t)) / pi
q = symbols("q", positive=True)  # t = sin(q)^2: sqrt(t (1 - t)) = sin q cos q, and dt = 2 sin q cos q dq
in_q = damping.subs(sqrt(t * (1 - t)), sin(q) * cos(q)) * 2 * sin(q) * cos(q)
prove("(4c) the action of x = t, y = t - 1", Rational(1, 2) + Rational(1, 2) + integrate(in_q, (q, 0, pi / 2)) - Rational(5, 4))
bump = 4 * t ** 2 * (1 - t)
# Two half derivatives are a derivative, so the change of the damping term is rho int (x' dy + y' dx).
change_of_x = integrate(diff(bump, t) * 1, (t, 0, 1)) + Rational(1, 2) * integrate(bump, (t, 0, 1))
change_of_y = integrate(diff(bump, t) * 1, (t, 0, 1)) - Rational(1, 2) * integrate(bump, (t, 0, 1))
prove("(4d) x alone: slope 1/6", change_of_x - Rational(1, 6))
prove("(4d) both: slope 0", change_of_x + change_of_y)

z = [v - X[0] for v in X]
u = [v - Y[N] for v in Y]
memory = [sum(w[n] * z[j - n] for n in range(j + 1)) for j in range(N + 1)]
ahead = [sum(w[n] * u[j + n] for n in range(N - j + 1)) for j in range(N + 1)]
S = sum(lagrangian(X[j], X[j + 1]) + lagrangian(Y[j], Y[j + 1]) for j in range(N)) \
    - h * rho * sum(a * b for a, b in zip(memory, ahead))     # rho includes the powers of h


def residual(path, j):
    """Return the residual (5d) of the path at the node j."""
    step = diff(lagrangian(path[j], path[j + 1]), path[j]) + diff(lagrangian(path[j - 1], path[j]), path[j])
    return step - h * rho * sum(twice[n] * (path[j - n] - path[0]) for n in range(j + 1))


film = Y[::-1]
#> two_residuals
for j in (1, 2, 3):
    moved = diff(S, X[j]) + diff(S, Y[j])
    mirrored = residual(film, N - j).subs(kappa, 1 - kappa)   # a film shows each step backwards
    prove(f"(5e) node {j}: the change is the residual of x and of the film of y", (moved - residual(X, j) - mirrored).doit())
#< two_residuals

momentum = symbols("p")
next_momentum = momentum - h * slope_of_U(inside(X[k], X[k + 1])) \
    - h * rho * sum(twice[n] * (X[k + 1 - n] - X[0]) for n in range(k + 2))
met = next_momentum.subs(momentum, before) + diff(lagrangian(X[k + 1], X[k + 2]), X[k + 1])
prove("(6d) the run empties the residual at k + 1", (met - residual(X, k + 1)).doit())


# alpha = kappa = 1/2: (6c) gives the momentum before the step, (8b) the momentum after it.
d, slope_mid = symbols("d slope_mid")
p_before = m * d / h + h * slope_mid / 2
p_after = p_before - h * slope_mid - rho * d
prove("(8d) M d/h is the mean of the two momenta", (m - rho * h / 2) * d / h - (p_before + p_after) / 2)
claim("(8d) the mass m is not", series(1 - rho * h / m - sympy_exp(-rho * h / m), h, 0, 3).removeO() != 0)

# (10c) of the running body, kappa = 1/2: 4^alpha rho h^(2 - 2 alpha) / m = 4.
longest = Rational(2) ** Rational(5, 3)
prove("(10c) the longest step", 4 ** Rational(1, 4) * Rational(1, 2) * longest ** Rational(3, 2) - 4)

theta = Symbol("theta")
late = ((1 - sympy_exp(-h)) / h) ** (2 * alpha) * (1 - theta + theta * sympy_exp(h))
slope_in_h = simplify(limit(diff(late, h), h, 0))
prove("(12a) no delay if theta = alpha", slope_in_h - (theta - alpha))

# ---- runs by the definition ----


def weights_of(order, count):
    """Return the weights (2a) of (1 - B)^order, by binomial coefficients."""
    return [(-1) ** n * binomial(order, n) for n in range(count)]


def binomial(order, n):
    out = order * 0 + 1
    for i in range(n):
        out = out * (order - i) / (i + 1)
    return out


def run(order, steps, h, kappa, rho, x0=1, p0=0, past="held", theta=0, half=0, unit=None):
    """Return x and p of a run of a body with m = c = 1 by (6c) and (6d), or by (12b). unit: h^(1 - order) rho, which
    is rho if h = 1."""
    w = weights_of(order, steps + 1)
    unit = rho if unit is None else unit
    origin = 0 if past == "rl" else x0
    drift = p0 if past == "caputo" else 0
    x, p, z = [x0], [p0], [x0 - origin]

    def memory(k):
        return sum(w[n] * z[k - n] for n in range(k + 1))

    for k in range(steps):
        now = memory(k)
        z.append(x[k] - origin - drift * h * (k + 1))
        still = memory(k + 1)
        r = p[k] - unit * (half - theta) * now
        d = (r - unit * theta * still - kappa * h * x[k]) / (1 / h + theta * unit + kappa * (1 - kappa) * h)
        z[-1] += d
        x.append(x[k] + d)
        p.append(r - h * (x[k] + (1 - kappa) * d) - unit * (1 - half + theta) * (still + d))
    return x, p


R, one_ = Symbol("R"), Rational(1)
x_, _ = run(one_ / 2, 3, one_, one_, R, x0=one_, p0=0 * one_)
y_, _ = run(one_ / 2, 3, one_, one_, R, x0=0 * one_, p0=one_)
H_ = [sum(b * (x_[k - n] - 1) for n, b in enumerate(weights_of(one_ / 2, k + 1))) for k in range(3)]
prove("the second body gives the derivative by rho", diff(x_[3], R) + sum(y_[3 - k] * H_[k] for k in (1, 2)))

def stiff_run(force, strength, steps):
    """Return places and dampings of the running body with g = h = 1. force: h times the spring's force on a node,
    from three places."""
    w = weights_of(mpmath.mpf(1) / 2, steps + 1)
    x = [mpmath.mpf(1), mpmath.findroot(lambda q: q - 1 + slope_of_u((q + 1) / 2) / 2, 0.7)]
    D = [mpmath.mpf(0)]
    for k in range(1, steps):
        D.append(sum(w[n] * (x[k - n] - 1) for n in range(k + 1)))
        x.append(mpmath.findroot(lambda q: 2 * x[k] - x[k - 1] - q - force(x[k - 1], x[k], q) - strength * D[k], x[k]))
    return x, D


def slope_of_u(q):
    return q + q**3


def mean_force(a, b, c):
    return (slope_of_u(a) + 2 * slope_of_u(b) + slope_of_u(c)) / 4


def middle_force(a, b, c):
    return (slope_of_u((a + b) / 2) + slope_of_u((b + c) / 2)) / 2


def film_and_runs(force, steps=10):
    """Return the derivative of the last place by rho twice: from the film of the same equations, and from two runs."""
    x, D = stiff_run(force, 0.5, steps)
    w = weights_of(mpmath.mpf(1) / 2, steps + 1)
    y = [mpmath.mpf(0)] * (steps + 1)
    for k in range(steps, 1, -1):                     # y_(k - 1) from the linearised equation of the node k
        near = min(k, steps - 1)
        a, b, c = (-mpmath.diff(force, tuple(x[near - 1:near + 2]), n) for n in ((1, 0, 0), (0, 1, 0), (0, 0, 1)))
        ahead = sum(w[n] * y[k + n] for n in range(steps - k + 1)) / 2
        y[k - 1] = -1 / (c - 1) if k == steps else -((b + 2) * y[k] + (c - 1) * y[k + 1] - ahead) / (a - 1)
    e = mpmath.mpf(10) ** -6
    runs = (stiff_run(force, 0.5 + e, steps)[0][-1] - stiff_run(force, 0.5 - e, steps)[0][-1]) / (2 * e)
    return -sum(y[k] * D[k] for k in range(1, steps)), runs


for name, force_, said in (("a quarter, a half, a quarter", mean_force, (-0.179, -0.220)), ("kappa = 1/2", middle_force, (0.171, 0.171))):
    for what, value, printed in zip(("film", "two runs"), film_and_runs(force_), said):
        claim(f"g = h = 1, {name}, {what}: {mpmath.nstr(value, 8)} is printed as {printed}", abs(value - printed) < 5.1e-4)

header("verify/course/course.py")
one, half = Q(1), Q(1, 2)


def root(n, digits):
    """Return half a derivative of t at t = 1 with n steps, which is a fraction times sqrt(n)."""
    fraction = sum(weight * Q(n - j, n) for j, weight in enumerate(weights_of(half, n + 1)))
    with mpmath.workdps(digits + 10):
        return mpmath.sqrt(n) * fraction.numerator / fraction.denominator


array("ref_half_weights", weights_of(half, 9), "(2b): the weights of order 1/2")
table("ref_half_of_t", "int steps; double want;",
      [[n, hexd_real(lambda digits: mpmath.nstr(root(n, digits), digits))]
       for n in (4, 16, 64, 256)])
for name, kappa_ in (("half", half), ("one", one)):
    x, p = run(half, 6, one, kappa_, Q(0))
    array(f"ref_undamped_{name}_x", x, f"(3d), (3e): h = 1, kappa = {kappa_}, no damping")
    array(f"ref_undamped_{name}_p", p)

grid = 16                                           # 1/16 is exact as a double
w_ = weights_of(half, grid + 1)
H = Q(1, grid)
x, y = [j * H for j in range(grid + 1)], [j * H - 1 for j in range(grid + 1)]


def minus(path):
    return [sum(w_[n] * path[j - n] for n in range(j + 1)) for j in range(len(path))]


def coupling(x, y):
    """Return h rho sum D_- x D_+ y with rho = 1/2. The two powers h^(-1/2) multiply to 1/h."""
    up = minus([v - y[-1] for v in y][::-1])[::-1]
    return half * sum(a * b for a, b in zip(minus([v - x[0] for v in x]), up))


def kinetic(path):
    return sum((b - a) ** 2 for a, b in zip(path, path[1:])) / (2 * H)


bump_ = [4 * (j * H) ** 2 * (1 - j * H) for j in range(grid + 1)]
total = lambda a, b: kinetic(a) + kinetic(b) - coupling(a, b)
bend = lambda path, e: [v + e * d for v, d in zip(path, bump_)]
alone = (total(bend(x, one), y) - total(bend(x, -one), y)) / 2      # exact, because it is quadratic
both = (total(bend(x, one), bend(y, one)) - total(bend(x, -one), bend(y, -one))) / 2
claim("both bent: no slope on the grid either", both == 0)
print(f"\nenum {{ REF_GRID = {grid} }};")
print(f"static const double ref_action = {hexd(total(x, y))}, /* {float(total(x, y)):.6f}; 5/4 in the limit */")
print(f"                    ref_alone = {hexd(alone)}; /* {alone}; 1/6 in the limit */")

table("ref_by_hand", "double kappa; double x[6]; double p[6];",
      [[hexd(kappa_), *("{ " + ", ".join(map(hexd, part)) + " }" for part in run(half, 5, one, kappa_, half))]
       for kappa_ in (one, half)])
table("ref_pasts", "int past; double x[4];",
      [[i, "{ " + ", ".join(map(hexd, run(Q(3, 2), 3, one, one, half, p0=half, past=past)[0])) + " }", past]
       for i, past in enumerate(("held", "caputo", "rl"))])
array("ref_friction", run(one, 4, one, one, half)[0], "alpha = 1/2, h = kappa = 1")
array("ref_once", [sum(weights_of(half, 3)[n] * v[j - n] for n in range(j + 1))
                   for v in [[one, Q(0), -half]] for j in range(3)], "half a derivative of 1, 0, -1/2")
array("ref_paper", run(one, 3, half, half, Q(1, 5), p0=half, unit=Q(1, 5))[0], "the paper's oscillator, h = 1/2")
mpmath.mp.dps = 30
table("ref_no_kick", "double alpha, x;",
      [[a, hexd_real(lambda digits: mpmath.nstr(mpmath.invertlaplace(
          lambda s: (s + 0.5) / (s * s + 1 + s ** (2 * mpmath.mpf(a)) / 2), 2, method="talbot", degree=60), digits))]
       for a in (0.25, 0.75)])
x, p = run(half, 3, one, half, half, theta=Q(1, 4), half=half)
array("ref_second_x", x, "(12b): h = 1, kappa = 1/2, alpha = 1/4")
array("ref_second_p", p)

mpmath.mp.dps = 50
step_ = mpmath.mpf(0.1)
for name, kappa_, alphas in (("ref_first", 1, [0.25]), ("ref_seven", 0.5, [0, 0.25, 0.4, 0.5, 0.6, 0.75, 1])):
    rows = []
    for alpha_ in alphas:
        order = 2 * mpmath.mpf(alpha_)
        x, p = run(order, 140, step_, mpmath.mpf(kappa_), mpmath.mpf(0.5), x0=mpmath.mpf(1), p0=mpmath.mpf(0),
                   unit=step_ ** (1 - order) / 2)
        rows += [[j, hexd(Rational(alpha_)), nearest(x[j]), nearest(p[j])] for j in (range(141) if name == "ref_first" else (70, 140))]
    table(name, "int k; double alpha, x, p;", rows)
