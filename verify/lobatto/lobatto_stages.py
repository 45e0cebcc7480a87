"""H 17. From 2 to 8 stages, and the two forms of the inertia.

Proved with exact numbers, U, the path and the weights left open:
  (17.24) is the restricted variation of an action in which the inertia is a further
          term like the damping, with the order 1 in the place of alpha
          (two steps, s = 2, 3);
  (17.26) the energy that the inertia loses: the squared jumps of the velocity (s = 2, 3);
  (17.28) m l^2 + rho l^(2 alpha) + c is not 0 where Re l >= 0.
Claimed at 50 digits, s = 5 to 8: (17.2), (17.3), (17.6), and that |R(-mu)| goes like
s (s - 1)/mu^2.
Printed: nodes, weights and D; W_n from Cauchy's integral over a circle,
Delta(z)^beta by its eigenvalues; and three steps of form D of a driven oscillator
from those W_n, all equations in one linear system: never by roots, nodes of a
quadrature or a step at a time as in the C code; and loads (17.18)."""
from functools import cache

import mpmath
from mpmath import mp, mpf
from sympy import (Function, I, Matrix, Rational, cos, diag, diff, expand, expand_trig, eye, ones,
                   sin, symbols)

from shared.arithmetic import circle, coefficients, real_function
from shared.refgen import claim, header, hexd, prove, table

mp.dps = 50
h, m, rho = symbols("h m rho", positive=True)
Q = Rational


@cache
def rule(s):
    """Return c, b, D of s Lobatto nodes in [0, 1], from the zeros of P'_{s-1}."""
    legendre = mpmath.taylor(lambda x: mpmath.legendre(s - 1, x), 0, s - 1)
    slope = [k * legendre[k] for k in range(1, s)][::-1]
    inner = mpmath.polyroots(slope, maxsteps=200, extraprec=200) if s > 2 else []
    x = [mpf(-1), *sorted(mpmath.re(r) for r in inner), mpf(1)]
    x = [(x[i] - x[s - 1 - i]) / 2 for i in range(s)]
    L = [mpmath.legendre(s - 1, v) for v in x]
    c, b = [(1 + v) / 2 for v in x], [1 / (s * (s - 1) * v**2) for v in L]
    D = mpmath.matrix(s, s)
    for i in range(s):
        for j in range(s):
            if i != j:
                D[i, j] = L[i] / L[j] / (c[i] - c[j])
    D[0, 0], D[s - 1, s - 1] = -mpf(s * (s - 1)) / 2, mpf(s * (s - 1)) / 2
    return c, b, D


@cache
def inverse_table(s):
    """Return A^(-1) and A of Lobatto IIIC, (17.3)."""
    c, b, D = rule(s)
    inverse = D.copy()
    inverse[0, 0] += 1 / b[0]
    return inverse, inverse**-1


def small(matrix):
    return mpmath.mnorm(matrix, 1) < mpf(10) ** -40


for s in range(5, 9):
    c, b, D = rule(s)
    inverse, A = inverse_table(s)
    B, one = mpmath.diag(b), mpmath.ones(s, 1)
    ends = mpmath.zeros(s)
    ends[0, 0], ends[s - 1, s - 1] = -1, 1
    claim("(17.2) summation by parts", small(B * D + D.T * B - ends))
    for q in range(s):  # exact for all polynomials of degree s - 1
        claim("(17.1) D differentiates", small(
            D * mpmath.matrix([v**q for v in c])
            - mpmath.matrix([q * v ** (q - 1) if q else mpf(0) for v in c])))
    for q in range(s - 1):  # C(s - 1), the first column and the last row of IIIC
        claim("(17.3) A integrates", small(
            A * mpmath.matrix([v**q for v in c]) - mpmath.matrix([v ** (q + 1) / (q + 1) for v in c])))
    claim("(17.3) first column b_1, last row b", small(A[:, 0] - b[0] * one)
          and small(A[s - 1, :] - mpmath.matrix([b])))
    flip = mpmath.matrix(s, s)
    for i in range(s):
        flip[i, s - 1 - i] = 1
    claim("(17.6) reversal", small(flip * inverse * flip - B**-1 * inverse.T * B))
    mu = mpf(10) ** 30
    R = mpmath.lu_solve(inverse + mu * mpmath.eye(s), mpmath.eye(s)[:, 0] / b[0])[s - 1]
    claim("|R(-mu)| mu^2 goes to s (s - 1)", abs(abs(R) * mu**2 - s * (s - 1)) < mpf(10) ** -20)

# ---- form D from the action: two steps, weights, path and potential open ----
U = Function("U")
for s in (2, 3):
    b = [Q(1, 2)] * 2 if s == 2 else [Q(1, 6), Q(4, 6), Q(1, 6)]
    D = Matrix([[-1, 1], [-1, 1]]) if s == 2 else Matrix([[-3, 4, -1], [-1, 0, 1], [1, -4, 3]])
    Bs, e1, es = diag(*b), eye(s)[:, 0], eye(s)[:, s - 1]
    own, before = D + e1 * e1.T / b[0], -e1 * es.T / b[0]  # Delta(z) = own + z before (17.5)
    #> damped
    # Two steps share no value of x: X_k and Y_k are s free numbers each.
    X, Y, F = ([Matrix(symbols(f"{name}{k}_:{s}")) for k in range(2)] for name in "xyF")
    back = lambda f, W: [W[0] * f[0], W[0] * f[1] + W[1] * f[0]]
    ahead = lambda f, W: [Bs.inv() * (W[0].T * Bs * f[0] + W[1].T * Bs * f[1]),
                          Bs.inv() * W[0].T * Bs * f[1]]             # (17.6)
    couple = lambda W: h * sum((f.T * Bs * g)[0] for f, g in zip(back(X, W), ahead(Y, W)))
    first = [own / h, before / h]
    alpha = [Matrix(s, s, symbols(f"W{n}_:{s}:{s}")) for n in range(2)]
    action = -m * couple(first) - rho * couple(alpha) + sum(
        h * b[i] * (-U(Z[k][i]) + F[k][i] * Z[k][i]) for Z in (X, Y) for k in range(2) for i in range(s))
    twice = lambda W: back(back(X, W), W)
    for k in range(2):
        for i in range(s):
            # delta x = delta y: D_x of the part without memory, D_y of the couplings
            varied = (diff(action.subs({v: 0 for Z in Y for v in Z}), X[k][i])
                      + diff(-m * couple(first) - rho * couple(alpha), Y[k][i]))
            wanted = -h * b[i] * (m * twice(first)[k][i] + rho * twice(alpha)[k][i]
                                  + diff(U(X[k][i]), X[k][i]) - F[k][i])
            prove("(17.24) is the x-part of the restricted variation", expand((varied - wanted).doit()))
    #< damped
    V, v0 = [Matrix(symbols(f"v{k}_:{s}")) for k in range(2)], symbols("v")
    starts = [v0, V[0][s - 1]]
    work = sum((V[k].T * Bs * (own * V[k] - e1 * starts[k] / b[0]))[0] for k in range(2))
    prove("(17.26) the inertia loses the squared jumps", expand(
        work - (V[1][s - 1]**2 - v0**2) / 2 - sum((V[k][0] - starts[k])**2 for k in range(2)) / 2))

# ---- (17.28), l = r e^{i t}, 0 < t < pi/2: the imaginary part is positive ----
t, r, a = symbols("t r a", positive=True)
prove("(17.28) Im of m l^2 + rho l^(2 a) at r e^{it}",
      expand_trig((m * r**2 * (cos(2 * t) + I * sin(2 * t))
                   + rho * r**(2 * a) * (cos(2 * a * t) + I * sin(2 * a * t))).as_real_imag()[1]
                  - m * r**2 * sin(2 * t) - rho * r**(2 * a) * sin(2 * a * t)))

# ---- reference values ----
CIRCLE, RADIUS = 12, mpf(10) ** -2  # aliasing leaves an error of 1e-24 of W_{n + 12}


@cache
def points(s):
    inverse, b = inverse_table(s)[0], rule(s)[1]

    def delta(z):
        Delta = inverse.copy()
        Delta[0, s - 1] -= z / b[0]
        return Delta
    return circle(delta, RADIUS, CIRCLE)


@cache
def weights(s, beta, count):
    """Return W_0, ..., W_{count-1} with an error of some 1e-24 |W_0|."""
    W = coefficients(points(s), lambda root: root**beta, range(count))
    return [W[n] for n in range(count)]


def double(v):
    return hexd(Q(str(mpmath.nstr(v, 40))))


def three_steps(s, alpha):
    """Return x and p after each of three steps of length 1/2 of m x'' + c x + rho D^{2 alpha} x = F, Caputo, by
    (17.24). One linear system gives all 3 s velocities."""
    mass, c_, rho_, x0, p0 = mpf(3) / 2, mpf(2), mpf(3) / 4, mpf(1) / 4, mpf(1) / 2
    step, beta = mpf(1) / 2, 2 * mpf(alpha) - 1
    c, b, _ = rule(s)
    inverse, A = inverse_table(s)
    W, damper = weights(s, beta, 6), rho_ * step**-beta
    v0, n = p0 / mass, 3 * s
    whole, right = mpmath.zeros(n, n), mpmath.zeros(n, 1)
    for k in range(3):
        for i in range(s):
            row = k * s + i
            # X_k = x0 + step (A V_k + sum of b.V over the earlier steps)
            right[row] -= c_ * x0
            for l in range(k + 1):
                for j in range(s):
                    whole[row, l * s + j] += c_ * step * (A[i, j] if l == k else b[j])
                    memory = damper * W[k - l][i, j]
                    whole[row, l * s + j] += memory
                    if beta > 0:
                        right[row] += memory * v0
            for j in range(s):
                whole[row, k * s + j] += mass * inverse[i, j] / step
            if i == 0 and k == 0:
                right[row] += mass * v0 / (step * b[0])
            elif i == 0:
                whole[row, k * s - 1] -= mass / (step * b[0])
            right[row] += mpmath.cos(mpf(5) / 4 * step * (k + c[i]))
    V = mpmath.lu_solve(whole, right)
    rows, x = [], x0
    for k in range(3):
        x += step * sum(b[j] * V[k * s + j] for j in range(s))
        rows += [double(x), double(mass * V[k * s + s - 1])]
    return "{ " + ", ".join(rows) + " }"


@cache
def symbol(s, point, alpha):
    """Return (17.18) at z = 1 / point: K^(-1) B and K^(-1) B Delta^(2 alpha) on the paths with X_s = X_1 / point,
    without the constant paths."""
    c, b, D = rule(s)
    M, B, E = inverse_table(s)[0].copy(), mpmath.diag(b), mpmath.matrix(s, s - 1 - (point > 0))
    M[0, s - 1] -= point / b[0]
    power = real_function(M, lambda root: (                 # 0^(2 alpha) = 0
        root**(2 * alpha) if abs(root) > mpf(10)**-20 else mpf(0)))
    for j in range(E.cols):
        if point > 0:                                   # paths with mean zero
            E[j + 1, j], E[0, j], E[s - 1, j] = 1, -b[j + 1] / 2 / b[0], -b[j + 1] / 2 / b[0]
        else:
            E[j, j], E[s - 1, 0] = 1, -1
    K, W, R = (E.T * X * E for X in (D.T * B * D, B, B * power))
    return K**-1 * W, K**-1 * R


def load(s, alpha, w, r):
    """Return the load, from the real eigenvalues at z = -1 and 1: the largest eigenvalue where an odd number of them
    exceeds 1, else the largest one up to 1."""
    best = mpf(0)
    for point in (-1, 1):
        W, R = symbol(s, point, alpha)
        values = mpmath.eig(W * w + R * r, right=False)
        real = [v.real for v in values if abs(v.imag) < mpf(10)**-20 * (1 + abs(v))]
        above = [v for v in real if v > 1]
        best = max([best] + (above if len(above) % 2 else [v for v in real if v <= 1]))
    return best


header("verify/lobatto/lobatto_stages.py")
rows = []
for s in range(5, 9):
    c, b, D = rule(s)
    of = lambda values: "{ " + ", ".join(double(v) for v in values) + " }"
    rows.append([str(s), of(c), of(b), of([D[i, j] for i in range(s) for j in range(s)])])
table("ref_rules", "size_t s; double c[8]; double b[8]; double D[64];", rows)
rows = []
for s in range(5, 9):
    for beta in (-0.9, -0.4, 0.5, 0.9):
        for n, W in enumerate(weights(s, mpf(beta), 6)):
            if n in (0, 1, 3, 4, 5):
                rows.append([str(s), beta.hex(), str(n),
                             "{ " + ", ".join(double(W[i, j]) for i in range(s) for j in range(s)) + " }"])
table("ref_many_stages", "size_t s; double beta; size_t n; double want[64];", rows)
table("ref_damped", "size_t s; double alpha; double want[6];",
      [[str(s), alpha.hex(), three_steps(s, alpha)]
       for s in range(2, 9) for alpha in (0.0, 0.3, 0.5, 0.75, 1.0)])
table("ref_many_loads", "size_t s; double alpha, W, R, want;",
      [[str(s), alpha.hex(), w.hex(), r.hex(), double(load(s, mpf(alpha), mpf(w), mpf(r)))]
       for s in range(5, 9) for alpha in (0.3, 0.9)
       for w, r in ((9.0, 0.5), (2.0, 15.0), (200.0, 0.1))])
