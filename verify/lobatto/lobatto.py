"""H 17. Variational integrators on Lobatto nodes, s = 2, 3, 4.

Proved here with exact numbers (sqrt(5) included); z, mu and other named numbers are
symbols:
  (17.1)  D differentiates the Lagrange polynomials, b integrates them;
  (17.2)  summation by parts: B D + D^T B = e_s e_s^T - e_1 e_1^T;
  (17.3)  A^(-1) = D + e_1 e_1^T / b_1, A the table of Lobatto IIIC;
  (17.5)  Delta(z) (A + z/(1-z) 1 b^T) = 1;
  (17.6)  P Delta(z) P = B^(-1) Delta(z)^T B, also for products;
  (17.8)  is the restricted variation of the action of two steps (s = 2, 3), its
          path, its potential and its weights left open;
  (17.7)  A D d = d where d_1 = 0: for alpha = 0 the memory is x - x_0;
  (17.10) the resolvent of Delta(z) is N + z a a~^T / (1 - z r);
  (17.11) the Hermitian part of B Delta(z);
  (17.14) c_{s,beta}; (17.15) the first gap of the scheme without damping, both ends;
  (17.16) the alternating mode for s = 2, alpha symbolic;
  (17.18) the computations in the proof for s = 2; (17.19), (17.20): s = 3 in closed form;
  (17.29) at three rational a, q: its matrix has the moments of the weights (a q)^k at q^k.
Printed: W_n from Cauchy's integral over a circle, Delta(z)^beta by its
eigenvalues, 25 and 45 digits; never by roots, series or nodes as in the C code; and
where the symbol at z = 1 and -1 vanishes, by its determinant."""
from functools import cache

import mpmath
from sympy import (Function, I, Matrix, Rational, cancel, cos, diag, diff, expand, eye, factor,
                   integrate, numer, ones, pi, prod, radsimp, sin, solve, sqrt, symbols,
                   together)

from shared.arithmetic import circle, coefficients, real_function
from shared.refgen import claim, header, hexd, hexd_real, prove, table

z, mu, x, h, m, rho = symbols("z mu x h m rho")
Q = Rational
r5 = sqrt(5)

C = {2: [0, 1], 3: [0, Q(1, 2), 1], 4: [0, (5 - r5) / 10, (5 + r5) / 10, 1]}
B = {2: [Q(1, 2)] * 2, 3: [Q(1, 6), Q(4, 6), Q(1, 6)], 4: [Q(1, 12), Q(5, 12), Q(5, 12), Q(1, 12)]}
D = {2: Matrix([[-1, 1], [-1, 1]]),
     3: Matrix([[-3, 4, -1], [-1, 0, 1], [1, -4, 3]]),
     4: Matrix([[-6, 5 * (1 + r5) / 2, 5 * (1 - r5) / 2, 1],
                [-(1 + r5) / 2, 0, r5, (1 - r5) / 2],
                [(r5 - 1) / 2, -r5, 0, (1 + r5) / 2],
                [-1, 5 * (r5 - 1) / 2, -5 * (1 + r5) / 2, 6]])}
A = {2: Matrix([[1, -1], [1, 1]]) / 2,
     3: Matrix([[2, -4, 2], [2, 5, -1], [2, 8, 2]]) / 12,
     4: Matrix([[5, -5 * r5, 5 * r5, -5], [5, 15, 10 - 7 * r5, r5],
                [5, 10 + 7 * r5, 15, -r5], [5, 25, 25, 5]]) / 60}
STAGES = (2, 3, 4)


def zero(what, matrix):
    prove(what, *matrix)


def unit(s, i):
    return eye(s)[:, i]


for s in STAGES:
    others = [[v for v in C[s] if v != node] for node in C[s]]
    lagrange = [expand(radsimp(1 / expand(prod(node - v for v in rest))) * prod(x - v for v in rest))
                for node, rest in zip(C[s], others)]
    for i in range(s):
        prove("(17.1) b", integrate(lagrange[i], (x, 0, 1)) - B[s][i])
        for j in range(s):
            prove("(17.1) D", expand(diff(lagrange[j], x).subs(x, C[s][i]) - D[s][i, j]))

#> structure
for s in STAGES:
    b, Bs, one = Matrix(B[s]), diag(*B[s]), ones(s, 1)
    e1, es, flip = unit(s, 0), unit(s, s - 1), eye(s)[::-1, :]
    zero("(17.2) summation by parts", Bs * D[s] + D[s].T * Bs - es * es.T + e1 * e1.T)
    inverse = D[s] + e1 * e1.T / b[0]
    zero("(17.3) A^(-1)", A[s] * inverse - eye(s))
    Delta = inverse - z / b[0] * e1 * es.T
    zero("(17.5) Delta(z) is linear",
         Delta * (A[s] * (1 - z) + z * one * b.T) - (1 - z) * eye(s))
    zero("(17.7) order -1 of the velocity", (A[s] * D[s] - eye(s))[:, 1:])
    zero("(17.7) and at the end of the step", (b.T * D[s] - es.T)[:, 1:])
    zero("(17.6) reversal", flip * Delta * flip - Bs.inv() * Delta.T * Bs)
    zero("(17.6) of a product",
         flip * Delta * Delta.subs(z, mu) * flip
         - Bs.inv() * (Delta.subs(z, mu) * Delta).T * Bs)
    #< structure
    # (17.11): 2 Re <v, B Delta v> with z = p + iq, for complex v.
    p, q = symbols("p q", real=True)
    v, w = Matrix(symbols(f"v:{s}")), Matrix(symbols(f"w:{s}"))    # w stands for conj(v)
    twice = (w.T * (Bs * Delta.subs(z, p + I * q)
                    + (Bs * Delta).T.subs(z, p - I * q)) * v)[0]
    stated = (v[s-1] * w[s-1] + v[0] * w[0]
              - (p + I * q) * w[0] * v[s-1] - (p - I * q) * v[0] * w[s-1])
    prove("(17.11)", twice - stated)

for s in STAGES:
    b, e1, es = Matrix(B[s]), unit(s, 0), unit(s, s - 1)
    Delta = D[s] + e1 * e1.T / b[0] - z / b[0] * e1 * es.T
    N = (eye(s) * mu + D[s] + e1 * e1.T / b[0]).adjugate().applyfunc(expand)    # over det
    det = expand((eye(s) * mu + D[s] + e1 * e1.T / b[0]).det())
    a = N * e1 / b[0]
    r = a[s - 1]                                            # over det
    back = Matrix([b[i] * a[s - 1 - i] for i in range(s)])  # over det
    #> resolvent
    # (mu + Delta)(N + z a a~^T / (1 - z r)) = 1, times det (det - z r) det
    zero("(17.10) resolvent", (eye(s) * mu + Delta) * (N * (det - z * r) + z * a * back.T)
         - det * (det - z * r) * eye(s))
    prove("(17.12) 1 - r(-mu) = mu b.a", det - r - mu * (b.T * a)[0])
    #< resolvent

# (17.29): the matrix of the recurrence, with 1 above the diagonal and A_n C_{n+1} below, to the powers 0, ..., 9. Moment
# m of the weights (a q)^k at q^k is 1 / (1 - a q^{m+1}).
for a_, q_ in (Q(2, 3), Q(3, 5)), (Q(5, 4), Q(3, 4)), (Q(1, 7), Q(1, 2)):
    up = [q_**n * (1 - a_ * q_**(n + 1))**2 / ((1 - a_ * q_**(2 * n + 1)) * (1 - a_ * q_**(2 * n + 2))) for n in range(5)]
    down = [a_ * q_**n * (1 - q_**n)**2 / ((1 - a_ * q_**(2 * n)) * (1 - a_ * q_**(2 * n + 1))) for n in range(5)]
    J = Matrix(5, 5, lambda n, l: up[n] + down[n] if n == l else 1 if l == n + 1 else up[l] * down[n] if n == l + 1 else 0)
    for m_ in range(10):
        prove(f"(17.29) moment {m_}", (J**m_)[0, 0] - (1 - a_ * q_) / (1 - a_ * q_**(m_ + 1)))


# (17.7), (17.8): the action of two steps, all weights and the potential open.
U = Function("U")
for s in (2, 3):
    W = [Matrix(s, s, symbols(f"W{n}_:{s}:{s}")) for n in range(2)]
    b, Bs = B[s], diag(*B[s])
    nodes = {name: symbols(f"{name}0:{2 * s - 1}") for name in "xy"}
    X, Y = ([Matrix(nodes[name][k * (s - 1):k * (s - 1) + s]) for k in range(2)] for name in "xy")
    F = [Matrix(symbols(f"F{k}_:{s}")) for k in range(2)]          # two values at the joint
    minus = [W[0] * X[0], W[0] * X[1] + W[1] * X[0]]
    plus = [Bs.inv() * (W[0].T * Bs * Y[0] + W[1].T * Bs * Y[1]), Bs.inv() * W[0].T * Bs * Y[1]]
    free = lambda Z: sum(h * b[i] * (m / 2 * ((D[s] * Z[k])[i] / h)**2 - U(Z[k][i]) + F[k][i] * Z[k][i])
                         for k in range(2) for i in range(s))
    memory = -h * rho * sum((minus[k].T * Bs * plus[k])[0] for k in range(2))
    twice = [W[0] * minus[0], W[0] * minus[1] + W[1] * minus[0]]   # W * W: order 2 alpha
    K = D[s].T * Bs * D[s]
    row = lambda k, i: ((m / h) * (K * X[k])[i]
                        - h * b[i] * (diff(U(X[k][i]), X[k][i]) + rho * twice[k][i] - F[k][i]))
    #> restricted
    for i in range(1, 2 * s - 2):
        # delta x = delta y: D_x of the part without memory, D_y of the memory
        varied = diff(free(X), nodes["x"][i]) + diff(memory, nodes["y"][i])
        k, j = divmod(i, s - 1)
        wanted = row(k, j) if j else row(0, s - 1) + row(1, 0)
        prove("(17.8) is the x-part of the restricted variation", expand((varied - wanted).doit()))
    #< restricted


# (17.14): c = e_s^T Delta(1)^beta (c^s/s! - A c^(s-1)/(s-1)!), by residues.
#> correction
lam = symbols("lambda")
POLYNOMIAL = {2: lam - 2, 3: lam**2 - 6 * lam + 24, 4: lam**3 - 12 * lam**2 + 60 * lam - 360}
for s in STAGES:
    Delta1 = D[s] + unit(s, 0) * (unit(s, 0) - unit(s, s - 1)).T / B[s][0]
    prove("(17.14) eigenvalues", (lam * eye(s) - Delta1).det() - lam * POLYNOMIAL[s])
#< correction


def correction(s, beta):
    """Return c_{s,beta} of (17.14) by its definition, in floating point."""
    M = mpmath.matrix((D[s] + unit(s, 0) * (unit(s, 0) - unit(s, s - 1)).T / B[s][0]).evalf(60).tolist())
    c = [mpmath.mpf(str(Q(v).evalf(60) if v in (0, 1) else v.evalf(60))) for v in C[s]]
    defect = [c[i]**s / mpmath.factorial(s) for i in range(s)]
    Am = A[s].evalf(60)
    for i in range(s):
        defect[i] -= sum(mpmath.mpf(str(Am[i, j])) * c[j]**(s - 1) for j in range(s)) / mpmath.factorial(s - 1)
    roots = mpmath.polyroots([mpmath.mpf(int(k)) for k in POLYNOMIAL[s].as_poly(lam).all_coeffs()],
                             maxsteps=200, extraprec=200)
    total, every = mpmath.mpc(0), list(roots) + [mpmath.mpf(0)]
    for root in roots:
        v = mpmath.matrix(defect)
        for other in every:
            if other != root:
                v = (M * v - v * other) / (root - other)
        total += root**beta * v[s - 1]
    return total.real


CLOSED = {
    2: lambda be: -mpmath.mpf(2)**be / 4,
    3: lambda be: -mpmath.mpf(24)**(be / 2) * mpmath.sin(be * mpmath.atan(mpmath.sqrt(15) / 3))
                  / (12 * mpmath.sqrt(15)),
}

# (17.15): half the trace of a step for x'' + x = 0, y = h^2. It is +-1 at the ends of the first gap; for s = 2 there
# is no gap.
#> gap
y = symbols("y", positive=True)
GAP = {2: [4], 3: [8, 12], 4: [42 - 6 * sqrt(29), 10]}
for s in STAGES:
    rows = (D[s].T * diag(*B[s]) * D[s] - y * diag(*B[s])).applyfunc(expand)
    # The map from x_k, x_{k+1} to h p_k, -h p_{k+1}: a Schur complement, times the inner determinant.
    reduced = lambda i, j: expand(rows.extract([i, *range(1, s - 1)], [j, *range(1, s - 1)]).det())
    prove("(17.15) a step is time-symmetric", reduced(0, 0) - reduced(s - 1, s - 1))
    half = factor(cancel(-reduced(0, 0) / reduced(0, s - 1)))   # half the trace
    edges = [v for sign in (1, -1) for v in solve(numer(together(half - sign)), y) if v > 0]
    claim("(17.15) the first gap", sorted(edges, key=lambda v: v.evalf())[:2] == GAP[s])
    claim("(17.15) stable below", all(abs(half.subs(y, GAP[s][0] * Q(i, 20))) < 1 for i in range(1, 20)))
    claim("(17.15) not in the gap", abs(half.subs(y, sum(GAP[s]) / 2 if s > 2 else 5)) > 1)
#< gap

# (17.16), s = 2: the memory of x_k = (-1)^k, X_k = (-1)^k (1, -1). The load of a node comes from the last stage of
# one step, with the other sign, and the first stage of the next.
al = symbols("alpha", positive=True)
Delta1 = D[2] + 2 * unit(2, 0) * (unit(2, 0) + unit(2, 1)).T                # Delta(-1)
J = (Delta1 - eye(2)) / sqrt(3)
zero("(17.16) Delta(-1) = 2 (cos(pi/3) + sin(pi/3) J), J^2 = -1", J * J + eye(2))
angle = (2 * al - 1) * pi / 3
Y = 2**(2 * al - 1) * (cos(angle) * eye(2) + sin(angle) * J) * D[2] * Matrix([1, -1])
load = (Y[0] - Y[1]) / 2                                                    # times R
prove("(17.16)", load - 2**(2 * al + 1) / sqrt(3) * sin((1 - 2 * al) * pi / 3))

#> sharp
# (17.18), s = 2, on z = e^{-i phi}: c = 1 - cos phi, i sin phi = (1/z - z)/2.
c, sine = symbols("c sine", positive=True)
Delta = D[2] + 2 * unit(2, 0) * (unit(2, 0) - z * unit(2, 1)).T
u, u_star = Matrix([1, 1 / z]), Matrix([[1, z]])
A_ = (1 + mu)**2 + 1 - (z + 1 / z)
prove("(17.18) u* B (mu + Delta)^(-1) u", (u_star * (mu * eye(2) + Delta).inv() * u)[0] / 2
      - (2 + mu - (1 / z - z) / 2) / (A_ + (1 / z - z)))
A_ = mu**2 + 2 * mu + 2 * c
prove("(17.18) its imaginary part", (2 + mu - I * sine) * (A_ - 2 * I * sine)
      - ((2 + mu) * A_ - 2 * sine**2 - I * sine * (A_ + 4 + 2 * mu)))
prove("(17.18) 1 < 2 alpha < 2", expand(A_**2 + 4 * (2 * c - c**2) - mu**2 * (A_ + 4 + 2 * mu)
                                         - (2 * c * mu**2 + 8 * c * mu + 8 * c)))
prove("(17.18) Delta = u* B Delta u: (1/z - z)/2 at 2 alpha = 1",
      (u_star * Delta * u)[0] / 2 - (1 / z - z) / 2)
#< sharp
#> closed
# (17.19), s = 3, z = 1: r is the only path with X_3 = X_1 and mean zero.
Bs, K = diag(*B[3]), D[3].T * diag(*B[3]) * D[3]
Delta1 = D[3] + 6 * unit(3, 0) * (unit(3, 0) - unit(3, 2)).T
r = Matrix([2, -1, 2])
prove("(17.19) r", (r.T * K * r)[0] - 48, (r.T * Bs * r)[0] - 2, (r.T * Bs * Delta1 * r)[0])
zero("(17.19) the range of Delta(1)", (Delta1**2 - 6 * Delta1 + 24 * eye(3)) * r)
# (17.20), s = 3, z = -1: X_3 = -X_1; N^3 = 40, so Delta^(2 alpha) = f0 + f1 N + f2 N^2.
Delta1 = D[3] + 6 * unit(3, 0) * (unit(3, 0) + unit(3, 2)).T
f0, f1, f2 = symbols("f0 f1 f2")
N = Delta1 - 2 * eye(3)
zero("(17.20) (Delta(-1) - 2)^3 = 40", N**3 - 40 * eye(3))
E = Matrix([[1, 0], [0, 1], [-1, 0]])
zero("(17.20) the symbol at -1",
     E.T * (-K + x * Bs + h * Bs * (f0 * eye(3) + f1 * N + f2 * N**2)) * E
     - Matrix([[x / 3 - 4 + h * (f0 - 2 * f1 - 8 * f2) / 3, h * 4 * (f1 - 4 * f2) / 3],
               [-h * 4 * (f1 - 4 * f2) / 3, 2 * x / 3 - Q(16, 3) + h * (2 * f0 - 4 * f1 - 8 * f2) / 3]]))
#< closed


RADIUS = mpmath.mpf(7) / 16      # not 1/2, where two eigenvalues of s = 2 coincide


#> definition
def delta(s, point):
    M = BASE[s].copy()
    M[0, s - 1] -= point / BS[s][0]
    return M


def cauchy(s, betas, orders, count):
    """Return {(k, n): W_n of betas[k]} by Cauchy's integral of Delta(z)^beta, with an error of RADIUS^count."""
    points = circle(lambda z: delta(s, z), RADIUS, count)
    return {(k, n): W for k, beta in enumerate(betas)
            for n, W in coefficients(points, lambda root: root**beta, orders).items()}
#< definition


Z = symbols("Z")
EXACT = {s: D[s] + unit(s, 0) * (unit(s, 0) - Z * unit(s, s - 1)).T / B[s][0] for s in STAGES}
BASE, BS = {}, {}


@cache
def number_at(e, digits):
    return mpmath.mpf(str(expand(e).evalf(digits)))


def number(e):
    """Return a rational plus a rational times sqrt(5) as a number."""
    return number_at(e, mpmath.mp.dps + 10)


def at_digits(digits):
    """Compute all matrices with this number of digits."""
    mpmath.mp.dps = digits + 25
    for s in STAGES:
        BASE[s] = mpmath.matrix([[number(e) for e in row] for row in EXACT[s].subs(Z, 0).tolist()])
        BS[s] = [number(v) for v in B[s]]


def at_precision(digits):
    at_digits(digits)
    return {s: cauchy(s, [mpmath.mpf(b) for b in BETAS], LAGS, 3 * digits + 5) for s in STAGES}


BETAS = [-0.95, -0.5, 0.2, 0.8]
LAGS = [0, 1, 3, 4, 40]
found = {}
for digits in (25, 45):
    found[digits] = at_precision(digits)

# (17.10), the sign and the constant: the integral against Cauchy's.
mpmath.mp.dps = 20
for s in STAGES:
    @cache
    def resolvent(mu_):
        """Return the first column of the inverse."""
        return mpmath.lu_solve(BASE[s] + mpmath.eye(s) * mu_, mpmath.eye(s)[:, 0])

    for k, beta in enumerate(map(mpmath.mpf, BETAS)):
        if beta < -0.9:
            continue        # the decay is too slow for a plain sum

        def integrand(u):
            mu_ = mpmath.exp(u)
            a = [v / BS[s][0] for v in resolvent(mu_)]
            return mu_**(1 + beta) * a[s - 1]**3 * a[0] * BS[s][s - 1] * a[0]
        total = sum(integrand(mpmath.mpf(i) / 4) for i in range(-200, 60)) / 4
        claim("(17.10) W_4", abs(-mpmath.sinpi(beta) / mpmath.pi * total
                                 - found[45][s][k, 4][0, s - 1]) < 1e-8)

mpmath.mp.dps = 60
for s in STAGES:
    for beta in (Q(1, 2), Q(4, 5), Q(-2, 5)):
        if s in CLOSED:
            be = mpmath.mpf(int(beta.p)) / int(beta.q)
            claim("(17.14) closed", abs(CLOSED[s](be) - correction(s, be)) < 1e-50)
for s in (3, 4):
    claim("(17.14) vanishes at beta = 0", abs(correction(s, mpmath.mpf(0))) < 1e-50)



def both(pair):
    """Return the nearest double of the value at both precisions."""
    lo, hi = (hexd(Rational(mpmath.nstr(v, d))) for d, v in pair.items())
    claim(f"{lo} is the nearest double at both precisions", lo == hi)
    return lo


header("verify/lobatto/lobatto.py")
rows = []
for s in STAGES:
    for k, beta in enumerate(BETAS):
        for n in LAGS:
            text = []
            for i in range(s):
                for j in range(s):
                    pair = {d: found[d][s][k, n][i, j] for d in found}
                    text.append(both(pair))
            rows.append([s, hexd(beta), n, "{ " + ", ".join(text) + " }", f"beta = {beta}"])
print("\n/* W_n, row by row */")
table("ref_matrices", "size_t s; double beta; size_t n; double want[16];", rows)

rows = []
for s in STAGES:
    for beta in (-0.8, -0.5, 0.2, 0.5, 0.8):
        value = {}
        for digits in (25, 45):
            mpmath.mp.dps = digits + 15
            value[digits] = correction(s, mpmath.mpf(beta))
        rows.append([s, hexd(beta), both(value), f"beta = {beta}"])
table("ref_corrections", "size_t s; double beta, want;", rows)


#> loads
def symbol(s, point, alpha):
    """Return K, B and B Delta^(2 alpha) on the paths with X_s = X_1 / point, without the constant paths."""
    rule, D_ = mpmath.diag(BS[s]), mpmath.matrix(s, s)
    for i in range(s):
        for j in range(s):
            D_[i, j] = number(D[s][i, j])
    power = real_function(delta(s, point), lambda root: (  # 0^(2 alpha) = 0
        root**(2 * alpha) if abs(root) > mpmath.mpf(10)**-20 else mpmath.mpf(0)))
    E = mpmath.matrix(s, s - 1)
    for i in range(s - 1):
        E[i, i] = 1
    E[s - 1, 0] = point
    if point == 1:                              # any basis of the paths with mean zero
        E = mpmath.matrix(s, s - 2)
        for i in range(s - 2):
            E[i + 1, i], E[0, i], E[s - 1, i] = 1, -BS[s][i + 1] / 2 / BS[s][0], -BS[s][i + 1] / 2 / BS[s][0]
    return [E.T * X * E for X in (D_.T * rule * D_, rule, rule * power)]


def load(s, alpha, w, r):
    """Return the load: the largest real eigenvalue where an odd number of them exceeds 1, else the largest up to 1."""
    best = mpmath.mpf(0)
    for point in (-1, 1)[:1 if s == 2 else 2]:
        K, W_, R_ = symbol(s, mpmath.mpf(point), alpha)
        values = mpmath.eig(mpmath.inverse(K) * (W_ * w + R_ * r))[0]
        real = [v.real for v in values if abs(v.imag) < mpmath.mpf(10)**-20 * (1 + abs(v))]
        above = [v for v in real if v > 1]
        best = max([best] + (above if len(above) % 2 else [v for v in real if v <= 1]))
    return best
#< loads


LOADS = [(2, 0.1, 2, 3), (2, 0.25, 0.001, 5.2), (2, 0.75, 3.5, 2), (3, 0.02, 0.001, 7.95), (3, 0.05, 0.001, 9),
         (3, 0.1, 0.001, 20.9), (3, 0.25, 2, 15), (3, 0.25, 0.001, 19.8), (3, 0.4, 0.001, 31), (3, 0.3, 9, 0.5),
         (3, 0.75, 7, 30), (4, 0.1, 0.001, 30), (4, 0.1, 0.001, 34), (4, 0.1, 0.001, 59), (4, 0.25, 4, 20),
         (4, 0.25, 0.001, 46.9), (4, 0.4, 0.001, 61), (4, 0.6, 9.9, 0.01), (4, 0.9, 9, 100)]
values = {}
for digits in (25, 45):
    at_digits(digits)
    values[digits] = [load(s, *map(mpmath.mpf, numbers)) for s, *numbers in LOADS]
rows = [[s, hexd(a_), hexd(w), hexd(r), both(dict(zip(values, pair))), f"alpha = {a_}, W = {w}, R = {r}"]
        for (s, a_, w, r), pair in zip(LOADS, zip(*values.values()))]
table("ref_loads", "size_t s; double alpha, W, R, want;", rows)
