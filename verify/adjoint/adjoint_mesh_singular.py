"""H 23. Steps of any length, and a singular start.

Proved: (23.24) term by term, with the coefficients that (22.20) sums; (23.25) for three steps, two and three stages,
two modes, all other numbers symbols; (23.26) for the modes of (22.7). Printed: derivatives of runs of chains of five
masses in dual numbers of 45 digits, by adjoint_steps.py. There the memory after t1 contains V itself; the
contribution of the singular part to its modes comes from adjoint_kernels.py."""
from random import Random

import mpmath
from mpmath import mp, mpf
from sympy import (Matrix, Rational, diag, diff, digamma, expand, eye, gamma, log, ones, symbols,
                   zeros)

from shared.adjoint_chain import D5
from shared.adjoint_kernels import tilted
from shared.adjoint_steps import Mesh, literal
from shared.arithmetic import BITS, TINY, ZERO, Dual, dot, dual, fixed
from shared.refgen import initial_history, claim, header, hexd, prove, table
from variable_steps import variable_steps as one

mp.dps = 72

# ---- the derivatives of the singular part ----

t, r, m, A, alpha, J = symbols("t r m A alpha J", positive=True)
for n in (1, 2, 5):
    for e in (0, 1):
        for turn in (1, -1):     # rising powers, then falling powers
            a = n * turn * (2 - 2 * alpha) + e
            g = r**n * t**a / gamma(1 + a)
            prove("(23.24) by r", r * diff(g, r) - n * g)
            prove("(23.24) by alpha", diff(g, alpha) / g + 2 * turn * n * (log(t) - digamma(1 + a)))
            slope = diff(g, t)
            prove("(23.24), G' by alpha", diff(slope, alpha) * t / g + 2 * turn * n * (a * (log(t) - digamma(1 + a)) + 1))
            told = (g * a if e == 0 else slope * (a - 1)).subs(gamma(1 + a), a * (a - 1) * gamma(a - 1) if e else a * gamma(a))
            prove("(22.20), what multiplies I", told - r**n * t**(a - e) / gamma(a - e))
b = J * (2 - 2 * alpha) + 1 - 2 * alpha
P = A * m * r**(J + 1) * t**b / gamma(1 + b)
prove("(23.24), P by r", r * diff(P, r) / P - J - 1)
prove("(23.24), P by m", m * diff(P, m) - P)
prove("(23.24), P by alpha", diff(P, alpha) / P + 2 * (J + 1) * (log(t) - digamma(1 + b)))

#> told
# (23.26): z after three steps, if a jump was added to v and z before the second step, equals z for V - u, plus eta,
# which decays by 1 - p in each step. p and L belong to the steps.
L, p, V = ([symbols(f"{name}{k}_0:2") for k in range(3)] for name in "LpV")
c0, jump, eta = symbols("c_0 jump eta")


def moved(k, z, ve, v):
    """Return z and v_e after step k, by (22.7) for s = 2."""
    return (1 - p[k][0]) * z + (v[1] - ve) - sum(l * (f - ve) for l, f in zip(L[k], v)), v[1]


z, ve, less, le = 0, c0, 0, 0
for k in range(3):
    if k == 1:
        z, ve = z + eta, ve + jump
    u = c0 + (jump if k else 0)
    z, ve = moved(k, z, ve, V[k])
    less, le = moved(k, less, le, [v - u for v in V[k]])
    fallen = eta * (1 - p[1][0]) * (1 - p[2][0] if k == 2 else 1) if k else 0
    prove("(23.26) the modes", expand(z - less - fallen))
    prove("(23.26) the velocities", expand(ve - u - le))
#< told

#> singular-start
# (23.25), s = 2 and 3, K = 1, two modes. DD^beta is a polynomial in the matrix (22.1); all other numbers are symbols.
for s in (2, 3):
    b, D = one.exact_rule(s)
    e1, es, Pi, B = eye(s)[:, 0], eye(s)[:, s - 1], eye(s)[::-1, :], diag(*b)
    inverse = (D + e1 * e1.T / b[0]).applyfunc(expand)
    stages, A = inverse.inv(), symbols("A")
    h, Jp, rho, x0, row_slope, G_row, G1 = symbols("h0:3"), *symbols("Jp rho x0 Jrow Grow G1")
    Lam, V = ([Matrix(symbols(f"{name}{k}_0:{s}")) for k in range(3)] for name in ("L", "V"))
    U = [diag(*symbols(f"U{k}_0:{s}")) for k in range(3)]
    G, P, shape = (Matrix(symbols(f"{name}_0:{s}")) for name in ("G", "P", "shape"))
    weight, told = symbols("omega0:2"), symbols("eta0:2")
    a = [[Matrix(symbols(f"a{q}_{k}_0:{s}")) for k in range(3)] for q in (0, 1)]
    fall = [symbols(f"f{q}_0:3") for q in (0, 1)]
    xi = symbols("xi1:4")

    def memory_of(steps):
        DD = zeros(3 * s, 3 * s)
        for k, step in enumerate(steps):
            DD[k * s:(k + 1) * s, k * s:(k + 1) * s] = inverse / step
            if k:
                DD[k * s:(k + 1) * s, (k - 1) * s:k * s] = -e1 * es.T / b[0] / step
        return DD * DD + 3 * DD

    u = [c0, c0 + jump, c0 + jump]
    Y = memory_of(h) * Matrix.vstack(*[v - w * ones(s, 1) for v, w in zip(V, u)])
    T = memory_of(h[::-1]) * Matrix.vstack(*[Pi * l for l in reversed(Lam)])
    T = [T[(2 - k) * s:(3 - k) * s, 0] for k in range(3)]
    x, total = [x0, *symbols("x1 x2")], 0
    for k in range(3):
        before = V[k - 1][s - 1] + (jump if k == 1 else 0) if k else c0
        past = Y[k * s:(k + 1) * s, 0]
        for q in (0, 1):
            past += weight[q] * told[q] * a[q][k] * ((1 - fall[q][1] if k == 2 else 1) if k else 0)
        X = x[k] * ones(s, 1) + h[k] * stages * V[k] + (zeros(s, 1) if k else G)
        R = m * (inverse * V[k] - e1 / b[0] * before) + h[k] * (rho * past + U[k] * X + (zeros(s, 1) if k else P))
        total -= (Lam[k].T * B * R)[0]
        if k < 2:
            total += xi[k] * (x[k] + h[k] * (es.T * stages * V[k])[0] + (0 if k else G1) - x[k + 1])
    total = expand(total + Jp * m * V[2][s - 1] + row_slope * (x0 + (shape.T * V[0])[0] + G_row))
    for i in range(s):
        prove("(23.25) by G at a stage", diff(total, G[i]) + h[0] * b[i] * U[0][i, i] * Lam[0][i])
        prove("(23.25) by P", diff(total, P[i]) + h[0] * b[i] * Lam[0][i])
    prove("(23.25) by G in a row", diff(total, G_row) - row_slope)
    prove("(23.25) by G at t1", diff(total, G1) - xi[0])
    plain = [h[k] * (ones(1, s) * B * Pi * T[k])[0] for k in range(3)]
    prove("(23.25) by G' at t1", expand(diff(total, jump) - m * Lam[1][0] - rho * (plain[1] + plain[2])))
    prove("(23.25) by c_0", expand(diff(total, c0) - m * Lam[0][0] - rho * sum(plain)))
    by_rho = sum(h[k] * ((V[k] - u[k] * ones(s, 1)).T * B * Pi * T[k])[0] for k in range(3))
    for q in (0, 1):
        w = 0
        for k in (2, 1):         # (22.5) for mu, backwards to t1
            w = (1 - fall[q][k]) * w + h[k] * (a[q][k].T * Pi * B * Pi * Lam[k])[0]
        prove("(23.25) by what a mode is told", expand(diff(total, told[q]) + rho * weight[q] * w))
        by_rho += weight[q] * told[q] * w
    prove("(23.25) by rho", expand(diff(total, rho) + by_rho))
    first = [Lam[1][0], Lam[2][0], Jp]
    for k in range(3):
        row = (m * (inverse * Pi * Lam[k] - e1 / b[0] * first[k]) + h[k] * rho * T[k]
               + h[k] * (h[k] * stages * Pi * U[k] * Lam[k] - (xi[k] if k < 2 else 0) * ones(s, 1)))
        row -= Pi * B.inv() * shape * row_slope if k == 0 else zeros(s, 1)
        prove("(23.16) as it was", *(Matrix([diff(total, v) for v in V[k]]) + B * Pi * row).applyfunc(expand))
#< singular-start

class Pulled(Mesh):
    """A run with x = y + G until t1, the end of step K, where G is a sum of J powers; kind: rising, falling or euler.
    """
    by_impulses = False

    def __init__(self, s, past, alpha, q, h, row, impulses, K, t1, J, kind):
        self.last, self.t1, self.J, self.kind, self.e = K, t1, J, kind, int(alpha > 0.5)
        self.falls = kind == "falling"
        self.T, self.at, self.over = sum(h), {}, {}
        super().__init__(s, 1, past, alpha, q, h, row, impulses)

    def heads(self, j):
        """Return the factors k_n of mass j. The weight w_n of (22.23) is a constant: it has no slope."""
        rho, m = (mpmath.ldexp(self.q0[name][j].v, -BITS) for name in ("rho", "mass"))
        falls = self.falls and rho > 0
        signs = [(-1) ** n * (-1 if falls else 1) for n in range(self.J + 2)]
        if self.kind == "euler" and rho > 0:
            P, N = rho / m * self.T ** (2 - 2 * self.alpha0), self.J
            p = P / (1 + P)
            w = [sum(mpmath.binomial(k, n) * (1 - p) ** (n + 1) * p ** (k - n) for k in range(n, N + 1))
                 for n in range(N + 1)]
            return [dual(v * u) for v, u in zip(signs, w)] + [ZERO]
        return [dual(mpf(0 if falls and n == 0 else v)) for n, v in enumerate(signs)]

    def prepare(self, q, turn):
        """Compute A, c_n (r t1^gap)^n, G at all stages and rows, and the remainder that acts as a force."""
        self.q0, self.turn = getattr(self, "q0", q), turn
        alpha = mpmath.mpc(self.alpha0, TINY / 2)
        self.gap = (2 * alpha - 2) if self.falls else (2 - 2 * alpha)
        self.size = [p / m if self.e else x for p, m, x in zip(q["p0"], q["mass"], q["x0"])]
        self.c, unit = [], {way: dual(self.t1**self.gap_of(way), turn) for way in (True, False)}
        for j in range(D5):
            rho, m, falls = q["rho"][j], q["mass"][j], self.falling(j)
            r = (m / rho if falls else rho / m) * unit[falls]
            power, c = self.size[j], []
            for k in self.heads(j):
                c.append(power * k)
                power = power * r
            self.c.append(c)
        self.G, self.P, self.rows = {}, {}, {}
        for k in range(min(self.last, self.steps)):
            for i in range(self.s):
                t = self.ends[k] + self.nodes[i] * mpf(self.lengths[k])
                self.G[k, i] = self.singular(t)
                self.P[k, i] = self.left(q, t, alpha)
        for n in range(1, ROWS + 1):
            self.rows[n] = self.singular(n * self.row)
        self.told_of = None
        if self.last < self.steps:
            rows = tilted(self.s, self.alpha0, self.falls, self.J, self.t1, tuple(map(mpf, self.lengths[self.last:])))
            self.told_of = [[[Dual(fixed(v), turn * fixed(d / 2)) for v, d in row] for row in stages] for stages in rows]

    def falling(self, j):
        return self.falls and self.q0["rho"][j].v != 0

    def gap_of(self, falls):
        return self.gap if falls == self.falls else -self.gap

    def powers(self, t, falls, slope):
        """Return t^a / Gamma(1 + a), or its derivative by t, of all terms. The factor t1^(n gap) is left out: it is
        part of c_n."""
        if (t, falls, slope) not in self.at:
            gap, found = self.gap_of(falls), []
            if falls not in self.over:
                a = [n * gap + self.e for n in range(1, self.J + 1)]
                self.over[falls] = [(dual(v), dual(mpmath.rgamma(1 + v))) for v in a]
            by, power = dual((t / self.t1)**gap), dual(t**(self.e - slope))
            for a, over in self.over[falls]:
                power *= by
                found.append(power * over * a if slope else power * over)
            self.at[t, falls, slope] = found
        return [Dual(v.v, self.turn * v.d) for v in self.at[t, falls, slope]]

    def singular(self, t, slope=0):
        """Return G of all bodies, or G'."""
        if t == 0:
            return [ZERO] * D5
        falls = [self.falling(j) for j in range(D5)]
        powers = {way: self.powers(t, way, slope) for way in set(falls)}
        return [dot(c[1:self.J + 1], powers[way]) for c, way in zip(self.c, falls)]

    def left(self, q, t, alpha):
        if self.kind != "rising" or t == 0:
            return [ZERO] * D5
        if t not in self.at:
            n = self.J + 1
            a = n * self.gap + self.e - 2
            self.at[t] = dual((t / self.t1)**(n * self.gap) * t**(self.e - 2) * mpmath.rgamma(1 + a))
        by = Dual(self.at[t].v, self.turn * self.at[t].d)
        return [ZERO - q["mass"][j] * self.c[j][self.J + 1] * by for j in range(D5)]

    def taken(self, q, k):
        """Return the part of v at the start that the memory takes in until t1; 0 afterwards."""
        return [c[0] if self.e and k < self.last else ZERO for c in self.c]

    def told(self, k, i, j):
        if k < self.last:
            return ZERO
        row = self.told_of[k - self.last][i]
        one_less = self.c[j][0] + self.slope_at_t1[j]
        return dot(self.c[j][:self.J + 1], row[:-1]) + one_less * row[-1]

    def enter(self, q, k, x, p):
        if k == 0 and self.e:
            p = [c[0] * m for c, m in zip(self.c, q["mass"])]
        if k == min(self.last, self.steps):
            G, slope = (self.singular(min(self.t1, self.ends[k]), i) for i in (0, 1))
            x = [a + b for a, b in zip(x, G)]
            p = [a + m * b for a, m, b in zip(p, q["mass"], slope)]
            self.slope_at_t1 = slope
        return x, self.hit(k, p)

    def begin(self, k):
        super().begin(k)
        self.now = k

    def beside(self, i, j):
        return self.G[self.now, i][j] if self.now < self.last else ZERO

    def besides(self, n):
        return self.rows[n] if self.now < self.last else [ZERO] * D5

    def force(self, q, k, i, j):
        given = super().force(q, k, i, j)
        return given - self.P[k, i][j] if k < self.last else given


# ---- chains ----

# Each step is shorter than the method allows after the steps before it, so the method accepts these steps when it is
# told where to end them. One step ends near T/1000.
UNIT, ROWS = 2**-21, 4
UNITS = [30, 31, 65, 130, 165, 250, 420, 700, 1200, 2000, 3400, 5800, 10200, 18500, 30000, 42000, 60000, 80000]
IMPULSES = {k: [(-1) ** (j + k) * (j + 1) * 2.0**-17 for j in range(D5)] for k in (0, 15, 18)}


def expansion(past, alpha, s, kind, ratios, T):
    """Return the number of terms and t1, by the rules of H 22."""
    gap, e = 2 - 2 * alpha, int(alpha > 0.5)
    fastest, slowest = max(ratios), min(r for r in ratios if r > 0)
    if kind == "rising":
        return max(mpmath.ceil((1 + 2 * alpha - e) / gap), 8 if s == 6 else 32), (2 * fastest) ** (-1 / gap)
    if kind == "falling":
        return mpmath.ceil(56 * mpmath.log(2) / mpmath.log(slowest * (1e-30 * T) ** gap)), None
    P = fastest * T**gap
    return mpmath.ceil(-56 * mpmath.log(2) / mpmath.log(P / (1 + P) * (1 - mpf(1e-30) ** gap))), None


# past, alpha, stages, kind, K; K = 0: the singular part lasts until the end of the run
CASES = [("held", 0.55, 8, "rising", 15), ("held", 0.9, 8, "rising", 16), ("held", 0.75, 6, "rising", 16),
         ("held", 0.7, 8, "rising", 0), ("held", 0.995, 8, "falling", 4), ("held", 0.995, 8, "euler", 4),
         ("rl", 0.05, 8, "rising", 16), ("rl", 0.35, 8, "rising", 17), ("rl", 0.75, 8, "rising", 15)]


def chain(random, past, alpha, s, kind, K):
    uniform = lambda a, b: round(random.uniform(a, b) * 2**20) / 2**20
    ends = [sum(UNITS[:k + 1]) * UNIT for k in range(len(UNITS))]
    T = ends[-1]
    if kind != "rising":
        ends[K - 1] = 1e-3 * T
    h = [mpf(b) - mpf(a) for a, b in zip([0.0, *ends], ends)]
    e, none = alpha > 0.5, past == "rl" and alpha > 0.5
    t1 = ends[K - 1] if K else 2 * T
    most = {"rising": mpf(t1) ** (2 * alpha - 2) / 2, "falling": mpf(12), "euler": mpf(1.25)}[kind]
    least = {"rising": 0.1, "falling": 0.5, "euler": 0.8}[kind]
    mass = [uniform(0.5, 2) for _ in range(D5)]
    rho = [float(most * mass[0])] + [0.0 if i == 2 else uniform(least, 0.9) * float(most) * mass[i] for i in range(1, D5)]
    data = dict(x0=[0.0 if none else uniform(-1, 1) for _ in range(D5)], p0=[uniform(-1, 1) for _ in range(D5)],
                mass=mass, rho=rho, cg=[uniform(0.5, 2), uniform(0.2, 1) if s == 8 else 0.0])
    J, natural = expansion(past, mpf(alpha), s, kind, [mpf(r) / m for r, m in zip(rho, mass)], mpf(T))
    claim("t1 is the end of a step", natural is None or abs(natural / t1 - 1) < 1e-14)
    q = {k: [dual(mpf(v)) for v in w] for k, w in data.items()}
    q["F"] = [ZERO] * ((ROWS + 1) * D5)
    run = Pulled(s, past, alpha, q, h, mpf(T) / ROWS, {} if e else IMPULSES, K or len(h) + 1, mpf(t1), int(J), kind)
    want = run.slopes([(name, i) for name in ("x0", "p0", "mass", "rho") for i in range(D5)]
                      + [("cg", 0), ("cg", 1), ("alpha", 0)] + [("F", i) for i in (0, 12, len(q["F"]) - 1)])
    want = [mpf(0)] * D5 + want[D5:] if none else want
    return ([initial_history(past), repr(alpha), s, int(J), hexd(Rational(t1)),
             "{ " + ", ".join(hexd(Rational(v)) for v in ends) + " }"]
            + [literal(map(mpf, data[k])) for k in ("x0", "p0", "mass", "rho", "cg")] + [literal(want)])


if __name__ == "__main__":
    random = Random(2320)
    runs = [chain(random, *case) for case in CASES]
    header("verify/adjoint/adjoint_mesh_singular.py")
    print("""
/* Where an impulse acts, and what it adds to the momenta; where alpha < 1/2 */""")
    table("ref_singular_start_impulses", "double t, J[5];",
          [[hexd(Rational(sum(UNITS[:k])) * Rational(UNIT)), literal(map(mpf, I))] for k, I in IMPULSES.items()])
    print("""
/* Five masses with a singular start, stages, terms and t1, where steps end, F = cos(5t/4)/5 on each, four
   rows; dJ, J as in to_sine, by x0, p0, mass, rho, c, g, alpha, and by F_1 of row 0, F_3 of row 2, F_5 of
   row 4, the force changed along lines */""")
    table("ref_singular_starts", "fvi_initial_history past; double alpha; size_t s, J; double t1, ends[18], x0[5], p0[5], mass[5], rho[5], cg[2], want[26];", runs)
