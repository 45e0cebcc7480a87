"""H 23. The adjoint of methods with stages.

Proved here, for s = 2, 3 in exact numbers, with the memory a polynomial in Delta(z), three steps:
  (23.13) the derivative of sum Lambda . R by the stages, form M;
  (23.15) its derivative by the velocities of the stages, form D, and the derivatives that follow;
  (23.16) the same on steps h_0, h_1, h_2, with the memory a polynomial in (22.1).
Printed: the derivatives of the weights (23.14), by Cauchy's integral of ln(Delta) Delta^beta; and derivatives of
chains of five masses, with a power and with laws of three random terms, by dual numbers of 45 digits,
adjoint_chain.py."""
from random import Random

import mpmath
from mpmath import mp, mpf
from sympy import Matrix, Rational, diag, expand, eye, ones, symbols, zeros

from shared.adjoint_chain import D5, N, Chain, LawChain, numbers, points
from shared.arithmetic import coefficients, dual
from shared.refgen import initial_history, header, hexd, nearest, prove, table

# ---- the transpose, with stages ----

NODES = {2: [0, 1], 3: [0, Rational(1, 2), 1]}
z, t, m, h, c = symbols("z t m h c")


def rule_of(s):
    """Return b and D of the nodes, by Lagrange's polynomials."""
    nodes, b, D = NODES[s], [], zeros(s, s)
    for j in range(s):
        l = Rational(1)
        for i in range(s):
            if i != j:
                l *= (t - nodes[i]) / (nodes[j] - nodes[i])
        poly = expand(l)
        b.append(expand(poly.integrate((t, 0, 1))))
        for i in range(s):
            D[i, j] = expand(poly.diff(t).subs(t, nodes[i]))
    return b, D


STEPS = 3
for s in (2, 3):
    b, D = rule_of(s)
    e1, es, P, B = eye(s)[:, 0], eye(s)[:, s - 1], eye(s)[::-1, :], diag(*b)
    inverse = (D + e1 * e1.T / b[0]).applyfunc(expand)
    A = inverse.inv()
    Delta = [inverse, -e1 * es.T / b[0]]
    W = [(Delta[0] * Delta[0] + 3 * Delta[0]).applyfunc(expand),
         (Delta[0] * Delta[1] + Delta[1] * Delta[0] + 3 * Delta[1]).applyfunc(expand),
         (Delta[1] * Delta[1]).applyfunc(expand)]
    L = [Matrix(symbols(f"L{k}_0:{s}")) for k in range(STEPS + 1)]
    G = [diag(*symbols(f"G{k}_0:{s}")) for k in range(STEPS)]
    V = [Matrix(symbols(f"V{k}_0:{s}")) for k in range(STEPS)]
    x = symbols(f"x0:{STEPS + 1}")
    v0, xi = symbols("v0"), symbols(f"xi0:{STEPS + 1}")
    #> form-d
    # Form D: R = m (A^-1 (V - v_k) + c W V) + h G X with X = x_k + h A V. xi_k is the multiplier of x_{k+1}.
    total = 0
    for k in range(STEPS):
        before = V[k - 1][s - 1] if k else v0
        X = x[k] * ones(s, 1) + h * A * V[k]
        memory = sum((W[n] * (V[k - n] - v0 * ones(s, 1)) for n in range(k + 1)), zeros(s, 1))
        R = m * (inverse * V[k] - e1 / b[0] * before) + h * c * memory + h * G[k] * X
        total += -(L[k].T * B * R)[0] + xi[k + 1] * (x[k] + h * (es.T * A * V[k])[0] - x[k + 1])
    Jp = symbols("Jp")
    total = expand(total + Jp * m * V[STEPS - 1][s - 1])
    T = [sum((W[n] * P * L[k + n] for n in range(STEPS - k)), zeros(s, 1)) for k in range(STEPS)]
    first = [L[k][0] for k in range(STEPS)] + [Jp]
    for k in range(STEPS):
        mu = P * L[k]
        row = (m * (inverse * mu - e1 / b[0] * first[k + 1]) + h * c * T[k]
               + h * (h * A * P * G[k] * L[k] - xi[k + 1] * ones(s, 1)))
        by_V = Matrix([total.diff(v) for v in V[k]])
        prove("(23.15) by the velocities of a step", *(by_V + B * P * row).applyfunc(expand))
        prove("(23.15) by x_k", expand(total.diff(x[k]) - (
            xi[k + 1] - (xi[k] if k else 0) - h * (ones(1, s) * B * G[k] * L[k])[0])))
    prove("(23.15) by v_0", expand(total.diff(v0) - m * first[0]
                                   - h * c * sum((ones(1, s) * B * P * T[k])[0] for k in range(STEPS))))
    prove("(23.15) by c", expand(total.diff(c) + h * sum(
        ((V[k] - v0 * ones(s, 1)).T * B * P * T[k])[0] for k in range(STEPS))))
    #< form-d
    #> mesh
    # Steps of any length: the same equations, where T comes from the matrix of the reversed mesh.
    H, w = symbols(f"h0:{STEPS}"), [Matrix(symbols(f"w{k}_0:{s}")) for k in range(STEPS)]

    def memory_of(steps):
        DD = zeros(STEPS * s, STEPS * s)
        for k, step in enumerate(steps):
            DD[k * s:(k + 1) * s, k * s:(k + 1) * s] = inverse / step
            if k:
                DD[k * s:(k + 1) * s, (k - 1) * s:k * s] = -e1 * es.T / b[0] / step
        return DD * DD + 3 * DD

    Y, total = memory_of(H) * Matrix.vstack(*V), 0
    Tall = memory_of(H[::-1]) * Matrix.vstack(*[P * L[k] for k in reversed(range(STEPS))])
    for k in range(STEPS):
        before = V[k - 1][s - 1] if k else v0
        R = (m * (inverse * V[k] - e1 / b[0] * before) + H[k] * c * Y[k * s:(k + 1) * s, 0]
             + H[k] * G[k] * (x[k] * ones(s, 1) + H[k] * A * V[k]))
        total += (-(L[k].T * B * R)[0] + (w[k].T * V[k])[0]
                  + xi[k + 1] * (x[k] + H[k] * (es.T * A * V[k])[0] - x[k + 1]))
    total = expand(total + Jp * m * V[STEPS - 1][s - 1])
    for k in range(STEPS):
        Tk = Tall[(STEPS - 1 - k) * s:(STEPS - k) * s, 0]
        row = (m * (inverse * P * L[k] - e1 / b[0] * first[k + 1]) + H[k] * c * Tk
               + H[k] * (H[k] * A * P * G[k] * L[k] - xi[k + 1] * ones(s, 1)) - P * B.inv() * w[k])
        by_V = Matrix([total.diff(v) for v in V[k]])
        prove("(23.16) by the velocities of a step", *(by_V + B * P * row).applyfunc(expand))
    #< mesh
    #> form-m
    # Form M: the rows of R are e_1 p + m/h K X - h G X - h B c W v with v = D X / h. p is replaced by its recurrence.
    K = (D.T * B * D).applyfunc(expand)
    X = [Matrix([x[k], *symbols(f"X{k}_1:{s - 1}"), x[k + 1]]) for k in range(STEPS)]
    total = 0
    for k in range(STEPS):
        memory = sum((W[n] * D * X[k - n] / h for n in range(k + 1)), zeros(s, 1))
        total += (L[k].T * (m / h * K * X[k] - h * B * G[k] * X[k] - h * B * c * memory))[0]
    for k in range(STEPS):
        row = m / h * K * L[k] - h * B * G[k] * L[k] - c * D.T * B * P * T[k]
        by_X = Matrix([total.diff(v) for v in X[k]])
        prove("(23.13) by the inner stages", *[expand(v) for v in (by_X - row)[1:s - 1, 0]])
    prove("(23.13) by the last stage", expand(total.diff(x[STEPS]) - row[s - 1]))
    #< form-m

# ---- the derivatives of the weights ----

mp.dps = 60
BETA_RATES, LAGS = [-1.0, -0.95, -0.5, 0.0, 0.2, 0.8, 1.0], [0, 1, 3, 4, 40]


def literal(values):
    return "{ " + ", ".join(nearest(v) for v in values) + " }"


rates = []      # aliasing leaves an error of 4^-64; of 60 digits, 4^40 = 10^24 are lost
for s in (2, 3, 4, 8):
    for beta in BETA_RATES if s < 8 else (-0.5, 0.8):
        found = coefficients(points(s, mpf(1) / 4, 64), lambda v, e=mpf(beta): v**e * mpmath.log(v), LAGS)
        for n in LAGS:
            rates.append([s, repr(beta), n, literal(found[n])])

# ---- chains of five masses ----


def cases():
    random, order = Random(23), [0.05, 0.35, 0.5, 0.7, 0.95, 1.0]
    uniform = lambda a, b: round(random.uniform(a, b) * 2**20) / 2**20
    todo = [(s, damped, past, order[(2 * which + 2 * s - 4 + damped + s - 2) % 6])
            for s in (2, 3, 4) for damped in (0, 1) for which, past in enumerate(("held", "caputo", "rl"))]
    todo += [(2, 0, "held", 1.0), (3, 0, "rl", 1.0)]
    todo += [(s, damped, past, order[(2 * which + s + 3 * damped) % 5])
             for s in (5, 6, 7, 8) for damped in (0, 1) for which, past in enumerate(("held", "caputo", "rl"))]
    for s, damped, past, alpha in todo:
        zero = past == "rl" and alpha > 0.5
        q = dict(x0=[0.0 if zero else uniform(-1, 1) for _ in range(D5)],
                 p0=[uniform(-1, 1) for _ in range(D5)], mass=[uniform(0.5, 2) for _ in range(D5)],
                 rho=[0.0 if i == 2 else uniform(0, 0.4) for i in range(D5)],
                 cg=[uniform(0.5, 2), uniform(0.2, 1)])
        yield s, damped, past, alpha, q


STEP = 1 / 16
runs, forces = [], [0, 13, -1]
for s, damped, past, alpha, data in cases():
    q = {k: [dual(mpf(v)) for v in w] for k, w in data.items()}
    nodes = numbers(s)[0]
    times = [(k + nodes[i]) * mpf(STEP) for k in range(N) for i in range(s - 1)] + [N * mpf(STEP)]
    q["F"] = [dual(mpmath.cos(1.25 * v) / 5) for v in times for _ in range(D5)]
    run = Chain(s, damped, past, alpha, q, STEP)
    at = [f % len(q["F"]) for f in forces]
    want = run.slopes([(name, i) for name in ("x0", "p0", "mass", "rho") for i in range(D5)]
                      + [("cg", 0), ("cg", 1), ("alpha", 0)] + [("F", i) for i in at])
    no = (past == "rl" and alpha > 0.5)
    text = [("NAN" if no and i < D5 and data["rho"][i] > 0 else nearest(v)) for i, v in enumerate(want)]
    if alpha == 1 and not damped:
        text[22] = "NAN"
    runs.append([f"&fvi_lobatto_{'d' if damped else 'm'}{s}",
                 initial_history(past), repr(alpha)]
                + ["{ " + ", ".join(hexd(Rational(v)) for v in data[k]) + " }"
                   for k in ("x0", "p0", "mass", "rho", "cg")]
                + ["{ " + ", ".join(map(str, at)) + " }", "{ " + ", ".join(text) + " }"])

# ---- the same with random laws ----

KINDS = {
    "POWER": lambda a, T, b: lambda v: v ** (2 * a),
    "ZENER": lambda a, T, b: lambda v: v ** (2 * a) / (1 + T * v ** (2 * a)),
    "MAXWELL": lambda a, T, b: lambda v: v / (1 + T * v),
    "DISTRIBUTED": lambda a, T, b: lambda v: (v ** (2 * b) - v ** (2 * a)) / (2 * mpmath.log(v)),
}


def law_cases():
    random = Random(26)
    uniform = lambda a, b: round(random.uniform(a, b) * 2**20) / 2**20
    for which in range(9):
        q = dict(x0=[uniform(-1, 1) for _ in range(D5)], p0=[uniform(-1, 1) for _ in range(D5)],
                 mass=[uniform(0.5, 2) for _ in range(D5)],
                 rho=[0.0 if i == which % D5 else uniform(0, 1.5) for i in range(D5)],
                 cg=[uniform(0.5, 2), uniform(0.2, 1)], terms=[uniform(0.1, 0.6) for _ in range(3)])
        terms = []
        for _ in range(3):
            kind, a = random.choice(list(KINDS)), uniform(0, 0.44)
            terms.append((kind, a, uniform(0.05, 2), uniform(a + 0.02, 0.5)))
        yield 2 + which % 3, terms, q


laws = []
for s, terms, data in law_cases():
    q = {k: [dual(mpf(v)) for v in w] for k, w in data.items()}
    nodes = numbers(s)[0]
    times = [(k + nodes[i]) * mpf(STEP) for k in range(N) for i in range(s - 1)] + [N * mpf(STEP)]
    q["F"] = [dual(mpmath.cos(1.25 * v) / 5) for v in times for _ in range(D5)]
    run = LawChain(s, [KINDS[kind](*map(mpf, (a, T, b))) for kind, a, T, b in terms], q, STEP)
    at = [f % len(q["F"]) for f in forces]
    want = run.slopes([(name, i) for name in ("x0", "p0", "mass", "rho") for i in range(D5)]
                      + [("cg", 0), ("cg", 1)] + [("terms", i) for i in range(3)] + [("F", i) for i in at])
    text = [f"{{ FVI_KERNEL_{kind}, {', '.join(hexd(Rational(v)) for v in (rho, a, T, b))} }}"
            for (kind, a, T, b), rho in zip(terms, data["terms"])]
    laws.append([f"&fvi_lobatto_d{s}", "{ " + ", ".join(text) + " }"]
                + ["{ " + ", ".join(hexd(Rational(v)) for v in data[k]) + " }"
                   for k in ("x0", "p0", "mass", "rho", "cg")]
                + ["{ " + ", ".join(map(str, at)) + " }", literal(want)])

header("verify/adjoint/adjoint_stages.py")
print("\n/* d W_n / d beta, row by row */")
table("ref_stage_rates", "size_t s; double beta; size_t n; double want[64];", rates)
print("""
/* Five masses, F = cos(5t/4)/5 on each, h = 1/16, six steps; dJ, J as in to_sine, by x0, p0,
   mass, rho, c, g, alpha, and three entries of F */""")
table("ref_chains", "const fvi_method *method; fvi_initial_history past; double alpha, x0[5], p0[5], mass[5], "
      "rho[5], cg[2]; size_t force[3]; double want[26];", runs)
print("""
/* The same run with a law of three terms; dJ by x0, p0, mass, rho, c, g, the factors of the terms,
   and three entries of F */""")
table("ref_law_chains", "const fvi_method *method; fvi_kernel_term term[3]; double x0[5], p0[5], mass[5], "
      "rho[5], cg[2]; size_t force[3]; double want[28];", laws)
