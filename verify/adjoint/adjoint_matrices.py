"""H 23. Systems of matrices: derivatives with respect to factors of M, C and K, and to the order.

Proved here:
  (23.19) the derivatives by the factors, with a shift, a drift and the impulses of a past, for d = 2 and
          N = 3, all numbers symbols;
  (23.20) the identity between the derivatives by all factors;
  (23.23) the terms of the mirrored memory that a memory of mu - J_p does not contain, six nodes, all weights symbols.
Printed: derivatives of runs of three unknowns by Algorithm 3 and (13.7) as they are written in the chapters, in dual
numbers of 45 digits; the parts that depend on the order come from complex steps of 10^-45 with 100 digits."""
from functools import cache
from random import Random

import mpmath
from mpmath import mp, mpc, mpf
from sympy import Matrix, Rational, diff, expand, symbols

from shared.arithmetic import HALF, ONE, TINY, UNITS, ZERO, Dual, apart, dot, dual, fixed
from shared.refgen import METHODS, initial_history, header, hexd, nearest, prove, table

# ---- the derivatives by the factors ----

h, kappa, c, theta, end, unit = symbols("h kappa c theta end unit")
sM, sC, sK = symbols("s_M s_C s_K")
N3 = 3


def vectors(name):
    return [Matrix(symbols(f"{name}{k}_0:2")) for k in range(N3 + 1)]


def symmetric(name):
    a, b, e = symbols(f"{name}0:3")
    return Matrix([[a, b], [b, e]])


x, lam, F = vectors("x"), vectors("lambda"), vectors("F")
M, C, K = symmetric("m"), symmetric("c"), symmetric("k")
p0, pN = Matrix(symbols("p0_0:2")), Matrix(symbols("pN_0:2"))
w3, start_impulses = symbols("w0:4"), symbols("b0:6")


def product(a, A, b):
    return (a.T * A * b)[0]


#> factors
v0 = M.inv() * p0 / sM
L = (lam[0].T * p0)[0] - (lam[N3].T * pN)[0]
for k in range(N3):
    S = kappa * x[k] + (1 - kappa) * x[k + 1]
    Mk = kappa * lam[k] + (1 - kappa) * lam[k + 1]
    L += sM / h * product(x[k + 1] - x[k], M, lam[k + 1] - lam[k]) - h * sK * product(S, K, Mk)
    L -= unit * sC * product(start_impulses[2 * k] * lam[k] + start_impulses[2 * k + 1] * lam[k + 1], C, v0)
z = [x[j] - x[0] - j * h * v0 for j in range(N3 + 1)]
nu = [0 * x[0], (1 - theta) * lam[1] + theta * lam[0], (1 - theta) * lam[2] + theta * lam[1],
      end * lam[3] + theta * lam[2]]
for k in range(1, N3 + 1):
    H = sum((w3[n] * z[k - n] for n in range(k + 1)), 0 * x[0])
    L += -c * sC * product(nu[k], C, H) + h * (lam[k].T * F[k])[0]
n = [sum((w3[k - j] * nu[k] for k in range(j, N3 + 1)), 0 * x[0]) for j in range(N3 + 1)]
ones = {sM: 1, sC: 1, sK: 1}
v, zz = v0.subs(ones), [a.subs(ones) for a in z]
by_p0 = Matrix([diff(L.subs(ones), p) for p in p0])
steps = range(N3)
impulse_sum = sum((start_impulses[2 * k] * lam[k] + start_impulses[2 * k + 1] * lam[k + 1] for k in steps), 0 * x[0])
prove("(23.19) by a factor of K", expand(diff(L, sK) + h * sum(
    product(kappa * x[k] + (1 - kappa) * x[k + 1], K, kappa * lam[k] + (1 - kappa) * lam[k + 1]) for k in steps)))
by_C = -c * sum(product(zz[j], C, n[j]) for j in range(N3 + 1)) - unit * product(impulse_sum, C, v)
prove("(23.19) by a factor of C", diff(L, sC).subs(ones) - by_C)
by_M = (sum(product(x[k + 1] - x[k], M, lam[k + 1] - lam[k]) for k in steps) / h
        - (p0.T * (by_p0 - lam[0]))[0])
prove("(23.19) by a factor of M", diff(L, sM).subs(ones) - by_M)
#< factors
# L is homogeneous: it is a sum of terms with one factor each, of the terms with the forces, and of those with p0 and
# p_N. The derivative by p0 includes the path through M^-1 p0.
prove("(23.20)", (L - diff(L, sC) - diff(L, sK)).subs(ones) - by_M - (p0.T * by_p0)[0] + (lam[N3].T * pN)[0]
      - h * sum((lam[k].T * F[k])[0] for k in range(1, N3 + 1)))

# ---- the terms that a memory held at J_p leaves out ----

#> constant
w, mu, half = symbols("w0:7"), symbols("mu0:7"), Rational(1, 2)
for shift, share in ((theta, half), (0, 1)):  # (13.7); Algorithm 3
    nu = [share * mu[0] + shift * mu[1]] + [(1 - shift) * mu[i] + shift * mu[i + 1] for i in range(1, 6)]
    held = [sum(w[j] * (mu[i - j] - mu[0]) for j in range(i + 1)) for i in range(7)]
    for i in range(6):
        besides = sum(w[:i + 1]) - (1 - share - shift) * w[i]
        prove("(23.23)", expand(sum(w[j] * nu[i - j] for j in range(i + 1))
                                - (1 - shift) * held[i] - shift * held[i + 1] - besides * mu[0]))
#< constant

# ---- derivatives of runs ----

mp.dps = 100
D, N, STEP = 3, 12, mpf(1) / 16
BY_M, BY_C, BY_ALPHA, BY_K = UNITS[:4]


def tilted(value):
    """Return a function of alpha, evaluated at alpha + i TINY, as a dual number."""
    return dual(value, BY_ALPHA)


@cache
def weights(method, alpha):
    beta = 2 * mpc(alpha, TINY)
    plain, g = [mpc(1)], [(mpf(3) / 2) ** beta]
    for k in range(1, N + 1):
        plain.append(plain[-1] * (k - 1 - beta) / k)
        g.append(g[-1] * (k - 1 - beta) / k / 3)
    w = plain
    if method == "stable":
        w = [(1 + beta) / 2 * a + (1 - beta) / 2 * b for a, b in zip(plain, [0] + plain)]
    if method == "bdf2":
        w = [mpmath.fdot(g[:k + 1], plain[k::-1]) for k in range(N + 1)]
    return list(map(tilted, w))


@cache
def impulses(alpha):
    """Return (19.5): h^(1 + e) times the integrals of (1 - s) and of s times (k + s)^e / Gamma(1 + e)."""
    e, out = (1 if alpha > 0.5 else 0) - 2 * mpc(alpha, TINY), []
    power = [mpf(0)] + [mpf(k) ** e for k in range(1, N + 1)]
    for k in range(N):
        whole = ((k + 1) * power[k + 1] - k * power[k]) / (1 + e)
        moment = ((k + 1) ** 2 * power[k + 1] - k**2 * power[k]) / (2 + e)
        scale = mpmath.rgamma(1 + e) * STEP ** (1 + e)
        out.append((tilted(scale * (whole - moment + k * whole)), tilted(scale * (moment - k * whole))))
    return out


def times(A, v):
    return [dot(row, v) for row in A]


def solve(A, right):
    """Solve A x = right in dual numbers; A must be positive definite."""
    rows = [[*row, r] for row, r in zip(A, right)]
    for k in range(D):
        for i in range(k + 1, D):
            f = rows[i][k] / rows[k][k]
            rows[i] = [a - f * b for a, b in zip(rows[i], rows[k])]
    x = []
    for i in reversed(range(D)):
        x.insert(0, (rows[i][D] - dot(rows[i][i + 1:D], x)) / rows[i][i])
    return x


def run(method, past, alpha, kappa, M, C, K, x0, p0):
    """Return J = (h/2) sum_{k>=1} |x_k - sin t_k|^2 + |p_N|^2 / 2 of a run."""
    h, printed, above, each = dual(STEP), method == "fvi", alpha > 0.5, range(D)
    drifts = above and (not printed or past == "caputo")
    w, unit = weights(method, alpha), tilted(STEP ** (1 - 2 * mpc(alpha, TINY)))
    theta = dict(shifted=tilted(mpc(alpha, TINY)), stable=HALF).get(method, ZERO)
    v0 = solve(M, p0)
    drift = [h * v if drifts else ZERO for v in v0]
    has_start_impulses = not printed and (past == "held" and above or past == "rl" and alpha != 0.5)
    b, damped_amplitude = impulses(alpha) if has_start_impulses else [(ZERO, ZERO)] * N, times(C, v0 if above else x0)
    origin = [ZERO] * D if printed and past == "rl" else x0
    rest = (ONE - kappa) * h
    A = [[M[i][j] / h + theta * unit * w[0] * C[i][j] + kappa * rest * K[i][j] for j in each] for i in each]
    x, p, z, J = x0, p0, [[a - o for a, o in zip(x0, origin)]], ZERO
    H = [w[0] * v for v in z[0]]
    force = [[dual(mpmath.cos(5 * k * STEP / 4) * (i + 1) / 5) for i in each] for k in range(N + 1)]
    for k in range(N):
        if not printed:
            CH = times(C, H)
            p = [p[i] + HALF * h * force[k][i] - (HALF - theta) * unit * CH[i] - b[k][0] * damped_amplitude[i] for i in each]
        moved = [v + Dual((k + 1) * ONE.v) * u for v, u in zip(origin, drift)]
        known = [w[0] * (x[i] - moved[i]) + dot(w[1:k + 2], [z[k - n][i] for n in range(k + 1)]) for i in each]
        before, at = times(C, known), times(K, x)
        d = solve(A, [p[i] - theta * unit * before[i] - kappa * h * at[i] for i in each])
        grad = times(K, [a + (ONE - kappa) * v for a, v in zip(x, d)])
        x = [a + v for a, v in zip(x, d)]
        H = [a + w[0] * v for a, v in zip(known, d)]
        z.append([a - v for a, v in zip(x, moved)])
        CH = times(C, H)
        for_p = [h * (f - g) if printed else h * (HALF * f - g) for f, g in zip(force[k + 1], grad)]
        p = [p[i] + for_p[i] - (ONE if printed else HALF + theta) * unit * CH[i] - b[k][1] * damped_amplitude[i] for i in each]
        off = [v - dual(mpmath.sin((k + 1) * STEP)) for v in x]
        J += HALF * h * dot(off, off)
    return J + HALF * dot(p, p)


def positive(random, rank):
    """Return a positive matrix, a sum of squares, whose entries are whole multiples of 2^-20 and so exact doubles."""
    rows = [[random.randrange(-2**10, 2**10) for _ in range(D)] for _ in range(rank)]
    return [[sum(r[i] * r[j] for r in rows) / 2**20 for j in range(D)] for i in range(D)]


def problem(random, method, past, alpha):
    uniform = lambda a, b: round(random.uniform(a, b) * 2**20) / 2**20
    M, C, K = positive(random, D), positive(random, random.choice([1, D])), positive(random, D)
    for i in range(D):
        M[i][i] += 1.0
    x0, p0 = ([uniform(-1, 1) for _ in range(D)] for _ in range(2))
    if past == "rl" and alpha > 0.5 and method != "fvi":  # such a run exists from x0 = 0 alone
        x0 = [0.0] * D
    kappa = 0.5 if method == "stable" else uniform(0.2, 0.8)
    # The derivative of (factor times matrix) by the factor is the matrix, so it is the slope.
    q = [[[Dual(fixed(v), unit * fixed(v)) for v in row] for row in A]
         for A, unit in zip((M, C, K), (BY_M, BY_C, BY_K))]
    start = [[dual(mpf(v)) for v in u] for u in (x0, p0)]
    want = apart(run(method, past, mpf(alpha), dual(mpf(kappa)), *q, *start).d, 4)
    flat = lambda A: "{ " + ", ".join(hexd(Rational(v)) for row in A for v in row) + " }"
    line = lambda v: "{ " + ", ".join(v) + " }"
    return [f"&fvi_{METHODS[method]}", initial_history(past),
            repr(alpha), hexd(Rational(kappa)), flat(M), flat(C), flat(K),
            line(hexd(Rational(v)) for v in x0), line(hexd(Rational(v)) for v in p0),
            line(nearest(v) for v in want)]


random = Random(2319)
runs = [problem(random, method, past, alpha) for method in METHODS for past in ("held", "caputo", "rl")
        for alpha in (0.0, 0.05, 0.35, 0.5, 0.7, 0.95, 1.0)]
header("verify/adjoint/adjoint_matrices.py")
print("""
/* Three unknowns, F_i = (i + 1) cos(5t/4)/5, h = 1/16, twelve steps;
   J = (h/2) sum_{k>=1} |x_k - sin t_k|^2 + |p_N|^2/2, by factors of M and C, by alpha
   (at 1/2 from below) and by a factor of K */""")
table("ref_matrices", "const fvi_method *method; fvi_initial_history past; double alpha, kappa, M[9], C[9], K[9], "
      "x0[3], p0[3], want[4];", runs)
