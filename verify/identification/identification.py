"""H 24: data and errors of a fit. Prints tests/identification/identification_ref.h.

  (24.2)  the exact motion of a linear spring and its derivatives by all parameters, from
          their Laplace transforms, at two precisions: data that do not come from the library;
  (24.3)  the standard deviations and correlations that follow;
  (24.8)  the twin order gives the same complex modulus;
  (24.10) the modulus of the weights;
  (24.6)  the derived equation of a step, from the equation of the step;
  and derivatives of runs of Algorithm 3, by complex steps of 1e-25 in the definition.

Held: m x'' + c x + rho D^{2 alpha} (x - x0) = 0, so X = x0/s + (v0 m - c x0/s) / Q with Q = m s^2 + rho s^{2 alpha} +
c. All inputs are exact doubles."""
from functools import cache
from operator import mul

from mpmath import mp, mpf
from sympy import Function, I, Rational, cos, diff, exp, expand, expand_trig, sin, symbols
from sympy import pi as sympi

from shared.refgen import claim, header, hexd, hexd_real, prove

#> transform
s, m, c, rho, alpha, x0, p0 = symbols("s m c rho alpha x0 p0", positive=True)
Q = m * s**2 + rho * s ** (2 * alpha) + c
X = x0 / s + (p0 - c * x0 / s) / Q
PARAMETERS = alpha, rho, c, x0, p0
prove("the transform solves the equation",
      m * (s**2 * X - s * x0 - p0 / m) + c * X + rho * s ** (2 * alpha) * (X - x0 / s))
SLOPES = [diff(X, theta) for theta in PARAMETERS]
#< transform


def evaluate(z, a):
    """Return X and its derivatives at s = z, with m = 1, in the order of PARAMETERS."""
    al, r, k, x_, p_ = a
    log = mp.log(z)
    power = mp.exp(2 * al * log)
    q = z**2 + r * power + k
    of_Q = -(p_ - k * x_ / z) / q**2
    return (x_ / z - of_Q * q, of_Q * r * 2 * log * power, of_Q * power,
            of_Q - x_ / z / q, (1 - k / q) / z, 1 / q)


# The function evaluate agrees with the formulas that sympy derived.
point = {s: mpf("0.3") + mpf("1.1") * 1j, alpha: mpf("0.37"), rho: mpf("0.6"), c: mpf("1.3"),
         x0: mpf("0.8"), p0: mpf("-0.4"), m: 1}
for mine, derived in zip(evaluate(point[s], [point[p] for p in PARAMETERS]), [X, *SLOPES]):
    claim("evaluate is the transform", abs(complex(derived.subs(point).evalf()) - complex(mine)) < 1e-14)


#> talbot
@cache
def contours(times, digits):
    """Return Talbot's contours, wide enough for an oscillation of frequency 1. Each contour serves the times from
    T/1.3 to T. A contour is its points, their weights, and e^(s t) at each time in units of 2^-bits."""
    bits, windows, times = mp.prec + 20, [], list(times)
    A, B, C, D = mpf("0.5017"), mpf("0.6407"), mpf("-0.6122"), mpf("0.2645")
    while times:
        window, times = [t for t in times if 1.3 * t >= times[-1]], [t for t in times if 1.3 * t < times[-1]]
        T = window[-1]
        N = int(2.2 * digits + 6 * T)
        N += N % 2
        points, weights = [], []
        for k in range(N // 2):                            # the other half is the conjugate
            u = (2 * k + 1) * mp.pi / N
            cot = mp.cot(B * u)
            z = N * mp.mpc(A * u * cot + C, D * u) / T
            if (z.real + 2) * window[0] > -2.4 * digits - 40:  # the other points contribute nothing
                points.append(z)
                weights.append(2 * mp.mpc(A * (cot - B * u * (1 + cot**2)), D) / T)
        windows.insert(0, (points, weights, [fixed([mp.exp(z * t) for z in points], bits) for t in window]))
    return windows, bits


def fixed(values, bits):
    """Return real and imaginary parts as whole numbers of 2^-bits."""
    return [[int(mp.ldexp(part(v), bits)) for v in values] for part in (mp.re, mp.im)]


def motions(a, times, digits):
    """Return rows of x(t) and its derivatives: the integral of exp(s t) X(s) / (2 pi i), by the trapezoidal rule. The
    sums are taken in whole numbers."""
    mp.dps = digits + 15
    rows, (windows, bits) = [], contours(tuple(times), digits)
    for points, weights, powers in windows:
        columns = [fixed(column, bits) for column in
                   zip(*([dz * f for f in evaluate(z, a)] for z, dz in zip(points, weights)))]
        rows += [[mp.ldexp(sum(map(mul, re, by_im)) + sum(map(mul, im, by_re)), -2 * bits)
                  for by_re, by_im in columns] for re, im in powers]
    return rows
#< talbot


#> covariance
def covariance(jacobian):
    """Return standard deviations for sigma = 1, and correlations, from the covariance (J^T J)^-1."""
    J = mp.matrix(jacobian)
    C = (J.T * J) ** -1
    sd = [mp.sqrt(C[i, i]) for i in range(C.rows)]
    return sd, [[C[i, j] / sd[i] / sd[j] for j in range(C.rows)] for i in range(C.rows)]
#< covariance


#> tangent
theta, h, kappa = symbols("theta h kappa", positive=True)
x, d, p = (Function(name)(theta) for name in "xdp")        # x_k, x_{k+1} - x_k, p_k
u = Function("u")                                          # U'(S; theta)
S = x + (1 - kappa) * d
slope_x, delta, pi = (diff(f, theta) for f in (x, d, p))
a, b = symbols("a b")
G = diff(u(a, b), a).subs({a: S, b: theta})                # U''
dU = diff(u(a, b), b).subs({a: S, b: theta})               # d U' at fixed S
step = m * d / h + kappa * h * u(S, theta) - p             # the equation of a step is step = 0
derived = (m / h + kappa * (1 - kappa) * h * G) * delta - (pi - kappa * h * (G * slope_x + dU))
prove("(24.6) the derived equation", expand((diff(step, theta) - derived).doit()))
after = p - h * u(S, theta)
prove("(24.6) the momentum after it", expand(
    (diff(after, theta) - (pi - h * (G * (slope_x + (1 - kappa) * delta) + dU))).doit()))
#< tangent

#> moduli
w, al, r_, c_ = symbols("w alpha_0 rho_0 c_0", positive=True)
seen = c_ + r_ * w ** (2 * al) * (cos(sympi * al) + I * sin(sympi * al))
twin_rho = r_ * w ** (2 * al) / w ** (2 * (1 - al))
twin_c = c_ + 2 * r_ * w ** (2 * al) * cos(sympi * al)
twin = twin_c + twin_rho * w ** (2 * (1 - al)) * (cos(sympi * (1 - al)) + I * sin(sympi * (1 - al)))
prove("(24.8) the twin is seen the same", expand(expand_trig(twin - seen)))
turn = symbols("turn", real=True)                          # w h
prove("(24.10) 1 - e^(-i wh) = 2 sin(wh/2) e^(i (pi - wh)/2)", expand(
    (1 - exp(-I * turn) - 2 * sin(turn / 2) * I * exp(-I * turn / 2)).rewrite(exp)))
#< moduli


def algorithm_3(v, steps, kappa, past, near=()):
    """Return x_N of (9.4), from its definition, and the increments x_{k+1} - x_k. v are alpha, rho, mass, x0, p0, c,
    g. near: the increments of a similar run, from which Newton's method starts. The memory is summed in units of
    2^-(2 bits)."""
    alpha, rho, m, x0, p0, c, g = v
    bits, moves = mp.prec + 100, []
    parts = lambda e: (int(mp.ldexp(mp.re(e), bits)), int(mp.ldexp(mp.im(e), bits)))
    h = mpf(1) / 16
    w = [mpf(1)]
    for n in range(1, steps + 1):
        w.append(w[-1] * (n - 1 - 2 * alpha) / n)
    damper, line = rho * h ** (1 - 2 * alpha), past == "CAPUTO" and mp.re(alpha) > 0.5
    w_re, w_im = zip(*map(parts, w))
    z, x, p = [parts(x0 if past == "RIEMANN_LIOUVILLE" else 0)], x0, p0
    for k in range(steps):
        d = near[k] if near else h * p / m
        for _ in range(60):                                # Newton's method
            at = x + (1 - kappa) * d
            wrong = m * d / h + kappa * h * (c * at + g * at**3) - p
            d -= wrong / (m / h + kappa * (1 - kappa) * h * (c + 3 * g * at**2))
            if abs(wrong) < mpf(10) ** (-mp.dps + 8):
                break
        at = x + (1 - kappa) * d
        x += d
        moves.append(d)
        z.insert(0, parts(x - (0 if past == "RIEMANN_LIOUVILLE" else x0) - ((k + 1) * h * p0 / m if line else 0)))
        z_re, z_im = zip(*z)
        dot = lambda a, b: sum(map(mul, a, b))
        turned = dot(w_re, z_im) + dot(w_im, z_re)
        H = mp.ldexp(dot(w_re, z_re) - dot(w_im, z_im), -2 * bits) + (1j * mp.ldexp(turned, -2 * bits) if turned else 0)
        p -= h * (c * at + g * at**3) + damper * H
    return x, moves


def slopes(values, steps, kappa, past, digits):
    mp.dps = digits
    tiny = mpf(10) ** (-digits // 2)
    exact = [number(Rational(v)) for v in values]
    end, moves = algorithm_3(exact, steps, mpf(kappa), past)
    found = [mp.re(end)]
    for j in range(7):
        found.append(algorithm_3([v + (1j * tiny if i == j else 0) for i, v in enumerate(exact)],
                                 steps, mpf(kappa), past, moves)[0].imag / tiny)
    return found


RUNS = [(0.3, 0.5, "HELD"), (0.75, 0.25, "CAPUTO"), (0.75, 0.5, "HELD"),
        (0.4, 0.5, "RIEMANN_LIOUVILLE"), (0.5, 0.5, "HELD")]
REST = (0.4, 1.25, 1.0, 0.25, 1.5, 0.5)  # rho, mass, x0, p0, c, g
STEPS = 100

POINTS = 200
TIMES = [Rational(i * 0.1) for i in range(1, POINTS + 1)]  # the doubles i * 0.1
CASES = {"low": (0.3, 0.4, 1.0, 1.0, 0.25), "high": (0.65, 0.4, 1.0, 1.0, 0.25)}


def number(x):
    return mpf(int(x.p)) / mpf(int(x.q))


def runs(values, digits):
    mp.dps = digits + 15
    a = [number(Rational(v)) for v in values]
    return motions(a, [number(t) for t in TIMES], digits)


def both(pair):
    """Return the double that both precisions round to."""
    texts = iter([mp.nstr(pair[0], 30), mp.nstr(pair[1], 30)])
    return hexd_real(lambda digits: next(texts))


def main():
    header("verify/identification/identification.py")
    print("#include <fvi/past.h>\n")
    print(f"enum {{ REF_POINTS = {POINTS} }}; /* t = 0.1, 0.2, ..., 20: the doubles i * 0.1 */")
    print("/* alpha, rho, c, x0, p0; m = 1; held */")
    motions, errors = [], []
    for name, values in CASES.items():
        rough, fine = runs(values, 30), runs(values, 38)
        motions.append((name, [both((r[0], f[0])) for r, f in zip(rough, fine)]))
        for P in (3, 5):
            results = [covariance([row[1:1 + P] for row in run]) for run in (rough, fine)]
            sd = [both(pair) for pair in zip(*(r[0] for r in results))]
            corr = [both((results[0][1][i][j], results[1][1][i][j]))
                    for i in range(P) for j in range(i)]
            errors.append([f'"{name}"', P, *(hexd(v) for v in values), "{ " + ", ".join(sd) + " }",
                           "{ " + ", ".join(corr) + " }"])
    for name, x in motions:
        print(f"\nstatic const double ref_{name}[] = {{")
        for v in x:
            print(f"    {v},")
        print("};")
    print("\n/* sd for sigma = 1; correlations (1,0), (2,0), (2,1), ... */")
    print("static const struct { const char *name; int P; double truth[5]; double sd[5]; double corr[10]; } "
          "ref_errors[] = {")
    for name, P, *rest in errors:
        print(f"    {{ {name}, {P}, {{ {', '.join(rest[:5])} }}, {rest[5]}, {rest[6]} }},")
    print("};")
    print("\n/* alpha, kappa, past; x_N and its derivatives by alpha, rho, mass, x0, p0, c, g; "
          "h = 1/16 */")
    print(f"enum {{ REF_STEPS = {STEPS} }};")
    print(f"static const double ref_rest[] = {{ {', '.join(hexd(v) for v in REST)} }};")
    rows = []
    for al, kap, past in RUNS:
        pairs = zip(*(slopes((al, *REST), STEPS, kap, past, digits) for digits in (40, 50)))
        rows.append((al, kap, past, [both(pair) for pair in pairs]))
    print("static const struct { double alpha, kappa; fvi_initial_history past; double x, slope[7]; } ref_slopes[] = {")
    for al, kap, past, (first, *others) in rows:
        print(f"    {{ {hexd(al)}, {hexd(kap)}, FVI_INITIAL_HISTORY_{past}, {first}, {{ {', '.join(others)} }} }},")
    print("};")


main()
