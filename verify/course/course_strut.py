"""The Course, stage 13: a damper along any length.

Proved here:
  weights  the recurrence of the program gives the coefficients of (3/2 - 2 s + s^2/2)^b, for every b;
  torque   the slopes of |x| and of 2 (|x| - 1)^2 have no component along the rotation (-x_2, x_1);
  (29.14)  one step of (29.6) conserves x_1 p_2 - x_2 p_1 for any force along |x|, and any two nodes;
  axes     two equal dampers along the axes, turned by any angle, are the same two dampers;
  (29.11)  with the first weight alone the work is half of the square of the change of length.
Printed: ten steps of (29.6), with weights from binomial series, slopes by sympy, and each step solved with 50 digits;
for the strut and for two dampers along the axes."""
import mpmath
from sympy import Matrix, Rational, cos, diff, eye, factorial, lambdify, simplify, sin, sqrt, symbols

from shared.refgen import header, hexd, nearest, prove, table

# ---- proofs ----

a, b, s, force, h, m = symbols("a b s force h m", positive=True)
power = (Rational(3, 2) - 2 * s + s ** 2 / 2) ** b
first = Rational(3, 2) ** b
w = [first]
for n in range(1, 6):
    w.append((4 * (n - 1 - b) * w[n - 1] + ((2 * b - n + 2) * w[n - 2] if n > 1 else 0)) / (3 * n))
    taylor = diff(power, s, n).subs(s, 0) / factorial(n)
    prove(f"weight {n}", simplify((w[n] - taylor) / first))

x, y = symbols("x1:3", positive=True), symbols("y1:3", positive=True)
radius = sqrt(x[0] ** 2 + x[1] ** 2)
U = 2 * (radius - 1) ** 2


def slopes(of, at=x):
    return Matrix([diff(of, v) for v in x]).subs(dict(zip(x, at)), simultaneous=True)


def turning(at, momentum):
    return at[0] * momentum[1] - at[1] * momentum[0]


prove("a strut has no torque", turning(x, slopes(radius)), turning(x, slopes(U)))
middle = [(i + j) / 2 for i, j in zip(x, y)]
velocity = Matrix([(j - i) / h for i, j in zip(x, y)])
common, push = m * velocity, h / 2 * slopes(U, middle)
before = common + push + h / 2 * force * slopes(radius)
after = common - push - h / 2 * force * slopes(radius, y)
prove("(29.14) a step turns nothing", turning(y, after) - turning(x, before))

turned = Matrix([[cos(a), sin(a)], [-sin(a), cos(a)]])
prove("axes", *(turned.T * turned - eye(2)))
z0, z1 = symbols("z0 z1")
prove("(29.11)", ((z0 + z1) / 2 - z0) * (z1 - z0) - (z1 - z0) ** 2 / 2)

# ---- ten steps by the definition ----

mpmath.mp.dps = 50
STEPS = 10
slope_of_U = lambdify(x, list(slopes(U)), "mpmath")
strut = [(lambdify(x, radius, "mpmath"), lambdify(x, list(slopes(radius)), "mpmath"))]
axes = [(lambda p, q: p, lambda p, q: [1, 0]), (lambda p, q: q, lambda p, q: [0, 1])]


def series(order, count):
    """Return the coefficients of (3/2)^order (1 - s)^order (1 - s/3)^order."""
    one = [(-1) ** n * mpmath.binomial(order, n) for n in range(count)]
    return [mpmath.mpf(1.5) ** order * sum(one[j] * one[n - j] / mpmath.mpf(3) ** (n - j) for j in range(n + 1))
            for n in range(count)]


def run(dampers, alpha, step, rho=mpmath.mpf(0.1)):
    at, momenta, work = [[mpmath.mpf(1.2), mpmath.mpf(0)]], [[mpmath.mpf(0.3), mpmath.mpf(0.8)]], [mpmath.mpf(0)]
    weights = [rho * v / step ** (2 * alpha) for v in series(2 * alpha, STEPS)]
    means = [[] for _ in dampers]
    for k in range(STEPS):
        here, p = at[k], momenta[k]

        def forces(*there):
            """Return the forces of the dampers, and the force of the spring at the middle of the step."""
            now = [(g(*here) + g(*there)) / 2 - g(*at[0]) for g, _ in dampers]
            lam = [sum(weights[n] * v for n, v in enumerate([new] + old[::-1])) for new, old in zip(now, means)]
            return now, lam, slope_of_U(*[(i + j) / 2 for i, j in zip(here, there)])

        def first_line(*there):
            _, lam, dU = forces(*there)
            return [(there[i] - here[i]) / step + step / 2 * dU[i]
                    + step / 2 * sum(f * slope(*here)[i] for f, (_, slope) in zip(lam, dampers)) - p[i] for i in (0, 1)]

        there = list(mpmath.findroot(first_line, [here[i] + step * p[i] for i in (0, 1)]))
        now, lam, dU = forces(*there)
        momenta.append([(there[i] - here[i]) / step - step / 2 * dU[i]
                        - step / 2 * sum(f * slope(*there)[i] for f, (_, slope) in zip(lam, dampers)) for i in (0, 1)])
        work.append(work[k] + sum(f * (g(*there) - g(*here)) for f, (g, _) in zip(lam, dampers)))
        at.append(there)
        for old, new in zip(means, now):
            old.append(new)
    return at, momenta, work


header("verify/course/course_strut.py")
rows = []
for is_strut, dampers in ((1, strut), (0, axes)):
    for alpha in (0.3, 0.5):
        at, momenta, work = run(dampers, mpmath.mpf(alpha), mpmath.mpf(0.05))
        rows += [[is_strut, hexd(Rational(alpha)), k, *("{ " + ", ".join(map(nearest, v)) + " }" for v in (at[k], momenta[k])),
                  nearest(work[k])] for k in (1, 2, 3, STEPS)]
table("ref_strut", "int strut; double alpha; int k; double x[2]; double p[2]; double work;", rows)
