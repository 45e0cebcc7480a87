"""H 23, 29. Runs with a mechanism: derivatives with respect to all numbers, by complex steps.

Proved here:
  (23.29) the transpose of the sums that give the forces of dampers, with symbols for all weights, five steps;
  (23.30) the transpose of the projection of a momentum, for two coordinates and a constraint, all symbols.
Printed: derivatives of runs of two coordinates by (29.5) to (29.8) as they are written in the chapter, with three
dampers: on a row, on a length, and with a law of two terms. The systems are masses with Duffing springs, a cart with
a pendulum, and a pendulum in the plane on a rod. A run with a complex number makes one step of Newton's method from
the real run, whose error is 10^-90."""
from functools import cache
from random import Random

import mpmath
from mpmath import mp, mpc, mpf
from sympy import Matrix, Rational, symbols

from shared.adjoint_chain import numbers
from shared.damper_runs import (TINY, Points, growth_of, impulses, impulses_of_power, is_power, numbers_of, products, slope,
                                tilted, weights, weights_of)
from shared.refgen import METHODS, header, hexd, initial_history, nearest, prove, table

# ---- (23.29), (23.30) ----

#> transposed
w, nu, zeta = symbols("w0:5"), symbols("nu0:5"), symbols("zeta0:5")
force = [sum(w[n] * zeta[k - n] for n in range(k + 1)) for k in range(5)]
eta = [sum(w[n] * nu[k + n] for n in range(5 - k)) for k in range(5)]
prove("(23.29)", sum(a * b for a, b in zip(nu, force)) - sum(a * b for a, b in zip(eta, zeta)))
A = Matrix(2, 2, symbols("a b b c"))
C, b = Matrix([symbols("c0:2")]), Matrix(symbols("b0:2"))
delta = -(C * b)[0] / (C * A.inv() * C.T)[0]
epsilon = A.inv() * C.T * delta
moved = b + epsilon  # the derivative of b . p by p_raw, where p = p_raw - C^T w with C A^-1 p = -c_t
p, ct = Matrix(symbols("p0:2")), symbols("c_t")
impulse = ((C * A.inv() * p)[0] + ct) / (C * A.inv() * C.T)[0]
prove("(23.30)", *((p - C.T * impulse).dot(b).diff(v) - moved[i] for i, v in enumerate(p)), (C * moved)[0])
#< transposed

mp.dps = 100
D, N, STEP, DAMPERS = 2, 5, mpf(1) / 8, 3
dot = mpmath.fdot


# ---- systems: each returns L_x, L_v and a force that depends on the velocity; q has the numbers that may vary ----

def masses(q, x, v):
    return ([-(q["c"] + q["g"] * u * u) * u for u in x], [m * u for m, u in zip(q["mass"], v)], [mpf(0)] * D)


def cart(q, x, v):
    sine, cosine = mpmath.sin(x[1]), mpmath.cos(x[1])
    return ([-x[0], -v[0] * v[1] * sine - q["c"] * sine], [3 * v[0] + v[1] * cosine, v[0] * cosine + v[1]],
            [v[1] * x[0] / 4, -v[1] * v[1] / 8])


def rod(q, x, v):
    return [mpf(0), -q["c"]], list(v), [mpf(0)] * D


def inverse(q, system, x, p):
    """Return the v with L_v(x, v) = p. L_v is linear in v."""
    columns = [system(q, x, [mpf(i == j) for i in range(D)])[1] for j in range(D)]
    det = columns[0][0] * columns[1][1] - columns[1][0] * columns[0][1]
    return [(columns[1][1] * p[0] - columns[1][0] * p[1]) / det, (columns[0][0] * p[1] - columns[0][1] * p[0]) / det]


# ---- elongations: their values and gradients ----

def elongations(x):
    a, b = x[0] + 2, x[1]
    r = mpmath.sqrt(a * a + b * b)
    return [x[1] - x[0], r, x[0]], [[mpf(-1), mpf(1)], [a / r, b / r], [mpf(1), mpf(0)]]


# ---- weights of stages ----

@cache
def table_of(s, form):
    c, b, D_, inverse_A = numbers(s)[:4]
    matrix = lambda f: [[f(i, j) for j in range(s)] for i in range(s)]
    E = matrix(lambda i, j: D_[i, j] if form == "m" else inverse_A[i, j])
    T = matrix(lambda i, j: b[j] * D_[j, i] if form == "m" else -b[i] * inverse_A[i, j])
    return c, b, E, T


@cache
def eigen(s):
    """Return the eigenvalues of Delta(z)/h at all points z of a circle, and for each n and each entry of W_n the weights
    of a function of these eigenvalues."""
    c, b, D_, inverse_A = numbers(s)[:4]
    found, roots = [], []
    for j in range(32):
        z = mpf(1) / 100 * mpmath.expjpi(mpf(2 * j) / 32)
        M = mpmath.matrix(s, s)
        for i in range(s):
            for l in range(s):
                M[i, l] = inverse_A[i, l] - (z / b[0] if (i, l) == (0, s - 1) else 0)
        values, V = mpmath.eig(M)
        back = V**-1
        # Entry (i, l) of a function of Delta(z) is the sum of s of these times its values at the eigenvalues.
        found.append((z, [V[i, e] * back[e, l] for i in range(s) for l in range(s) for e in range(s)]))
        roots += [v / STEP for v in values]
    shares = [[weights_of([v * z**-n / 32 for z, by in found for v in by[entry * s:entry * s + s]])
               for entry in range(s * s)] for n in range(N)]
    return Points(roots), shares


@cache
def stage_weights(s, terms):
    points, shares = eigen(s)
    values = [C / v for C, v in zip(points.law(terms), points.points)]
    return [mpmath.matrix([found[s * i:s * i + s] for i in range(s)])
            for found in (products(rows, values) for rows in shares)]


def stage_impulses(s, rho, e):
    """Return rho h^(1 + e) int l_i(u) (k + u)^e / Gamma(1 + e) du for all steps k and stages i, in powers of k + u."""
    c, out = numbers(s)[0], []
    for k in range(N):
        rows = []
        for i in range(s):
            poly = [mpf(1)]  # coefficients of the powers of w = k + u, the lowest first
            for l in range(s):
                if l != i:
                    shifted, scale = k + c[l], 1 / (c[i] - c[l])
                    poly = [scale * (u - shifted * v) for u, v in zip([mpf(0)] + poly, poly + [mpf(0)])]
            power = lambda w, a: mpf(0) if w == 0 else mpf(w) ** a
            total = sum(v * (power(k + 1, e + j + 1) - power(k, e + j + 1)) / (e + j + 1) for j, v in enumerate(poly))
            rows.append(rho * STEP ** (1 + e) * mpmath.rgamma(1 + e) * total)
        out.append(rows)
    return out


# ---- runs ----

class Run:
    """One run. `base`: None for the real run; else the real run's roots and inverse matrices of all steps."""

    def __init__(self, method, system, pasts, kappa, base=None):
        self.name, self.system, self.pasts, self.kappa, self.base = method, system, pasts, kappa, base
        self.form, self.s = (method[-1], int(method[-2])) if method.startswith("lobatto") else (method, 1)
        self.roots = []

    def solve(self, residual, guess):
        """Return a root of residual. A run with complex numbers makes one Newton step from the root of the real run."""
        k = len(self.roots)
        if self.base:
            u, back = self.base[k]
            self.roots.append(None)
            return [v - d for v, d in zip(u, back * mpmath.matrix(residual(u)))]
        u, n = list(guess), len(guess)
        for _ in range(60):
            r, J, e = residual(u), mpmath.matrix(n, n), mpf(10) ** -50
            for j in range(n):
                moved = residual([v + (e if i == j else 0) for i, v in enumerate(u)])
                for i in range(n):
                    J[i, j] = (moved[i] - r[i]) / e
            back = J**-1
            change = back * mpmath.matrix(r)
            u = [v - d for v, d in zip(u, change)]
            if max(map(abs, change)) < mpf(10) ** -85:
                break
        self.roots.append((u, back))
        return u

    def __call__(self, q, kernels, x, p):
        h, each, first = STEP, range(D), self.form == "fvi"
        stages = self.name.startswith("lobatto")
        z, G = elongations(x)
        v = inverse(q, self.system, x, p)
        held = [growth_of(t) > 1 and (not first or past == "caputo") for t, past in zip(kernels, self.pasts)]
        slopes = [dot(g, v) if on else mpf(0) for g, on in zip(G, held)]
        z0 = [mpf(0) if first and past == "rl" else u for u, past in zip(z, self.pasts)]
        self.A = [s if on else (u if past == "rl" and growth_of(t) < 1 else mpf(0))
                  for s, on, u, past, t in zip(slopes, held, z, self.pasts, kernels)]
        all_impulses = [None if first or past == "caputo" or (past == "held" and growth_of(t) <= 1)
                 or (past == "rl" and growth_of(t) == 1) else self.start_impulses(t, past) for t, past in zip(kernels, self.pasts)]
        past = [[] for _ in kernels]
        if first:
            for j in range(DAMPERS):
                past[j].append(z[j] - z0[j])
        J = self.value(0, x, p)
        step = self.stages if stages else self.nodes
        for k in range(N):
            x, p = step(k, q, kernels, x, p, z0, slopes, all_impulses, past)
            J += self.value(k + 1, x, p)
        return J

    @staticmethod
    def value(k, x, p):
        return sum(mpf((7 * k + 3 * i) % 11 - 5) / 8 * x[i] + mpf((5 * k + 4 * i) % 7 - 3) / 8 * p[i] for i in range(D))

    def start_impulses(self, terms, past):
        e = (1 if past == "held" else 0) - 2 * terms[0][2]
        if self.name.startswith("lobatto"):
            return stage_impulses(self.s, terms[0][1], e)
        return impulses_of_power(terms, STEP, N, e) if is_power(terms) else impulses(terms, STEP, N)

    @staticmethod
    def load(q, t):
        return [mpmath.cos(5 * t / 4) * (i + 1) / 5 for i in range(D)]

    def nodes(self, k, q, kernels, x, p, z0, slopes, all_impulses, past):
        h, each, first = STEP, range(D), self.form == "fvi"
        kappa = self.kappa if first else mpf(1) / 2
        rows = [weights("fvi" if first else "node", t, STEP, N + 1) for t in kernels]
        z, G = elongations(x)
        free = [mpf(0)] * DAMPERS
        start_forces = [[A * v for v in b[k]] if b else free[:2] for A, b in zip(self.A, all_impulses)]

        def step(u):
            X = [a + (1 - kappa) * d for a, d in zip(x, u)]
            V, end = [d / h for d in u[:D]], [a + d for a, d in zip(x, u)]
            Lx, Lv, Q = self.system(q, X, V)
            z1, G1 = elongations(end)
            lam = free
            if not first:
                now = [(a + b) / 2 - c - (k + mpf(1) / 2) * h * s for a, b, c, s in zip(z, z1, z0, slopes)]
                lam = [w[0] * v + sum(w[n] * past[j][-n] for n in range(1, k + 1))
                       for j, (w, v) in enumerate(zip(rows, now))]
            return X, V, end, Lx, Lv, Q, z1, G1, lam

        def residual(u):
            X, V, end, Lx, Lv, Q, z1, G1, lam = step(u)
            F = self.load(q, k * h)
            out = []
            for i in each:
                f = Lx[i] + (0 if first else Q[i])
                out.append(Lv[i] - kappa * h * f - p[i] - (0 if first else h / 2 * F[i])
                           + sum((h / 2 * l + a[0]) * g[i] for l, a, g in zip(lam, start_forces, G) if not first)
                           + (x[i] * u[D] if self.system is rod else 0))
            return out + ([(dot(end, end) - 1) / 2] if self.system is rod else [])
        u = self.solve(residual, [h * v for v in inverse(q, self.system, x, p)] + [mpf(0)] * (self.system is rod))
        X, V, end, Lx, Lv, Q, z1, G1, lam = step(u)
        F = self.load(q, (k + 1) * h)
        if first:
            for j in range(DAMPERS):
                past[j].append(z1[j] - z0[j] - (k + 1) * h * slopes[j])
            lam = [sum(w[n] * past[j][k + 1 - n] for n in range(k + 2)) for j, w in enumerate(rows)]
            Q = self.system(q, end, V)[2]
            p = [Lv[i] + (1 - kappa) * h * Lx[i] + h * (F[i] + Q[i]) - h * sum(l * g[i] for l, g in zip(lam, G1))
                 for i in each]
        else:
            for j in range(DAMPERS):
                past[j].append((z[j] + z1[j]) / 2 - z0[j] - (k + mpf(1) / 2) * h * slopes[j])
            p = [Lv[i] + h / 2 * (Lx[i] + Q[i]) + h / 2 * F[i] - sum((h / 2 * l + a[1]) * g[i]
                                                                    for l, a, g in zip(lam, start_forces, G1)) for i in each]
        return end, self.project(end, p)

    def project(self, x, p):
        if self.system is not rod:
            return p
        w = dot(x, p) / dot(x, x)
        return [a - w * b for a, b in zip(p, x)]

    def stages(self, k, q, kernels, x, p, z0, slopes, all_impulses, past):
        h, s, form = STEP, self.s, self.form
        c, b, E, T = table_of(s, form)
        begin = 1 if form == "m" else 0
        W = [stage_weights(s, t) for t in kernels]
        z = elongations(x)[0]
        known = []
        for j in range(DAMPERS):
            rows = [mpf(0)] * s
            for n in range(1, k + 1):
                rows = [r + v for r, v in zip(rows, W[j][n] * mpmath.matrix(past[j][-n]))]
            if all_impulses[j]:
                rows = [r + self.A[j] * v / (h * bi) for r, v, bi in zip(rows, all_impulses[j][k], b)]
            known.append(rows)
        m = self.system is rod

        def step(u):
            X = [x] * begin + [[a + u[i * D + j] for j, a in enumerate(x)] for i in range(s - begin)]
            V = [[sum(E[i][l] * (X[l][j] - x[j]) for l in range(s)) / h for j in range(D)] for i in range(s)]
            found = [elongations(y) for y in X]
            zdot = [[sum(E[i][l] * (found[l][0][j] - z[j]) for l in range(s)) / h for i in range(s)]
                    for j in range(DAMPERS)]
            lam = [[r + v for r, v in zip(known[j], W[j][0] * mpmath.matrix([v - slopes[j] for v in zdot[j]]))]
                   for j in range(DAMPERS)]
            f, Lv = [], []
            for i in range(s):
                Lx, momentum, Q = self.system(q, X[i], V[i])
                F = self.load(q, (k + c[i]) * h)
                f.append([Lx[j] + Q[j] + F[j] - sum(lam[e][i] * found[i][1][e][j] for e in range(DAMPERS))
                          for j in range(D)])
                Lv.append(momentum)
            return X, zdot, f, Lv

        def residual(u):
            X, zdot, f, Lv = step(u)
            out, places = [], (s - begin) * D
            for i in range(s - begin):
                for j in range(D):
                    out.append((p[j] if i == 0 else 0) + h * b[i] * f[i][j] + sum(T[i][l] * Lv[l][j] for l in range(s))
                               - (X[i][j] * u[places + i] if m else 0))
            return out + [(dot(X[i], X[i]) - 1) / 2 for i in range(1, s) if m]
        v = inverse(q, self.system, x, p)
        u = self.solve(residual, [c[i] * h * v[j] for i in range(begin, s) for j in range(D)]
                       + [mpf(0)] * ((s - begin) * m))
        X, zdot, f, Lv = step(u)
        for j in range(DAMPERS):
            past[j].append([v - slopes[j] for v in zdot[j]])
        p = [p[j] + h * sum(b[i] * f[i][j] for i in range(s)) for j in range(D)]
        if m:
            p = [p[j] - sum(X[i][j] * u[(s - begin) * D + i] for i in range(s - begin)) for j in range(D)]
        return X[-1], self.project(X[-1], p)


# ---- problems ----

def uniform(low, high):
    return round(random.uniform(low, high) * 2**20) / 2**20


def problem(method, system, pasts, kernels):
    kappa = uniform(0.2, 0.8) if method == "fvi" else 0.5
    q = dict(c=mpf(uniform(0.5, 2)), g=mpf(uniform(0.2, 1)), mass=[mpf(uniform(0.5, 2)) for _ in range(D)])
    x, p = ([uniform(-1, 1) for _ in range(D)] for _ in range(2))
    if system is rod:  # start on the rod and move along it; the numbers are those of a triangle 3-4-5
        x, p = [0.6, -0.8], [0.4, 0.3]
    exact = [tuple((kind, *map(mpf, rest)) for kind, *rest in kernel) for kernel in kernels]
    start, push = ([mpf(v) for v in u] for u in (x, p))
    if system is rod:
        start, push = [mpf(3) / 5, -mpf(4) / 5], [mpf(2) / 5, mpf(3) / 10]
    base = Run(method, system, pasts, mpf(kappa))
    base(q, exact, start, push)
    go = lambda a, t, u, v: slope(Run(method, system, pasts, mpf(kappa), base.roots)(a, t, u, v))
    tilt = lambda u, i: [v + mpc(0, TINY) if j == i else v for j, v in enumerate(u)]
    want = [mpf(0)] * 24
    for j, l, i in numbers_of(exact):
        want[8 * j + 4 * l + i] = go(q, tilted(exact, j, l, i), start, push)
    if system is rod:  # vary the start along the circle, and vary the speed
        turn = mpc(0, TINY)
        want += [go(q, exact, [start[0] - turn * start[1], start[1] + turn * start[0]],
                    [push[0] - turn * push[1], push[1] + turn * push[0]]),
                 go(q, exact, start, [v * (1 + turn) for v in push]), mpf(0), mpf(0)]
    else:
        want += [go(q, exact, tilt(start, i), push) for i in range(D)]
        want += [go(q, exact, start, tilt(push, i)) for i in range(D)]
    want += [go({**q, "mass": tilt(q["mass"], i)}, exact, start, push) if system is masses else mpf(0) for i in range(D)]
    want += [go({**q, "c": q["c"] + mpc(0, TINY)}, exact, start, push)]
    want += [go({**q, "g": q["g"] + mpc(0, TINY)}, exact, start, push) if system is masses else mpf(0)]
    line = lambda v: "{ " + ", ".join(v) + " }"
    doubles = lambda v: line(hexd(Rational(float(u))) for u in v)
    terms = line(line(f"{{ FVI_KERNEL_{kind}, {', '.join(hexd(Rational(v)) for v in rest)} }}"
                      for kind, *rest in kernel) for kernel in kernels)
    name = f"&fvi_lobatto_{method[-1]}{method[-2]}" if method.startswith("lobatto") else f"&fvi_{METHODS[method]}"
    return [name, {masses: 0, cart: 1, rod: 2}[system], hexd(Rational(kappa)),
            line(map(initial_history, pasts)), terms, line(str(len(k)) for k in kernels), doubles(q["mass"]),
            doubles([q["c"], q["g"]]), doubles(x), doubles(p), line(map(nearest, want))]


random = Random(2329)
SOFT = [[("POWER", 0.75, 0.3125, 0.0, 0.0)], [("POWER", 0.5, 0.1875, 0.0, 0.0)],
        [("ZENER", 0.75, 0.3125, 1.25, 0.0), ("MAXWELL2", 0.5, 0.4375, 0.75, 0.125)]]
STEEP = [[("POWER", 0.75, 0.6875, 0.0, 0.0)], [("POWER", 0.5, 0.8125, 0.0, 0.0)], [("MAXWELL", 0.75, 0.5, 0.625, 0.0)]]
SUM = [[("POWER", 0.75, 0.6875, 0.0, 0.0), ("ZENER", 0.5, 0.25, 0.75, 0.0)], [("DAVIDSON", 0.5, 0.3125, 0.75, 0.0)],
       [("DISTRIBUTED", 0.25, 0.25, 0.0, 0.8125)]]
HELD = ("held", "held", "held")
runs = []
for method in ("fvi", "stable", "lobatto2m", "lobatto3m", "lobatto2d", "lobatto3d"):
    stages = method.startswith("lobatto")
    for system in (masses, cart) + ((rod,) if method[-1] != "d" and method != "fvi" else ()):
        runs.append(problem(method, system, HELD if system is not cart else ("rl", "held", "held"), SOFT))
        runs.append(problem(method, system, HELD if system is not masses else ("held", "caputo", "held"), STEEP))
        if not stages and system is not rod:
            runs.append(problem(method, system, HELD, SUM))
header("verify/adjoint/adjoint_mechanism.py")
print("""
/* Two coordinates, 0: masses and Duffing springs, 1: a cart with a pendulum and a force of velocity, 2: a
   pendulum on a rod; F_i = (i + 1) cos(5t/4)/5, h = 1/8, five steps. Dampers on x2 - x1, on the distance of x to
   (-2, 0), and on x1. J is linear in all x_k and p_k. Derivatives by rho, alpha, time and end of two terms of
   each damper, by x0 and p0 (of 2 by a turn and by a factor of the speed), by the masses, by c and g */""")
table("ref_mechanisms", "const fvi_method *method; int system; double kappa; fvi_initial_history past[3]; fvi_kernel_term "
      "term[3][2]; size_t terms[3]; double mass[2], cg[2], x0[2], p0[2], want[32];", runs)
