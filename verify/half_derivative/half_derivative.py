"""H 7. Half a derivative, twice.

Proved here:
  (7.4)  c_k = sum alpha_n beta_{k-n} satisfies k c_k = (k-1-alpha-beta) c_{k-1},
         with k, n, alpha and beta all symbolic, by a telescoping certificate;
         hence (7.2) for every k, and for alpha = beta = 1/2 the weights 1, -1, 0, ...
  (7.3)  h Delta_- Delta_- x_k = x_k - x_{k-1} for symbolic sequences, and x_0 at
         k = 0; the mirror image for Delta_+;
  (7.5)  at alpha = 1/2 the identity is Segner's recurrence of the Catalan numbers;
  (7.7)  1/q, q times, for q = 2, ..., 6 (exact rationals, k <= 40);
  (7.8)  the L1 weights do not have the property;
         the identities that the induction of the printed proof uses, and a case in which they do not suffice;
         the term that its reorganised sum counts twice;
  (7.9)  Corollary: FVI(1/2) is the Lagrange-d'Alembert integrator, for a generic
         potential U, symbolic m, h, rho, kappa; identical rationals along runs.
Printed: exact sums for the products and for two derivatives in a row (mpmath, 100
and 130 digits), and the runs, by the double sums of the paper, in rationals."""
from functools import cache

import mpmath
from sympy import (Function, Rational, S, binomial, catalan, diff, expand, expand_func,
                   gamma, gammasimp, pi, simplify, sqrt, symbols)

from shared.refgen import array, claim, header, hexd, hexd_real, prove, table

a, b = symbols("alpha beta")
n, k = symbols("n k", integer=True, positive=True)


def weight(order, j):
    """Return alpha_j by its definition."""
    return expand_func((-1) ** j * binomial(order, j))


def weights(order, count):
    return [weight(order, j) for j in range(count)]


#> certificate
def w(order, j):
    """Return alpha_j for a symbolic j."""
    return gamma(j - order) / (gamma(-order) * gamma(j + 1))


T = w(a, n) * w(b, k - n)                       # the terms of c_k
G = n * T                                       # the certificate
step = k * T - (k - 1 - a - b) * T.subs(k, k - 1) - (G - G.subs(n, n + 1))
prove("(7.4) k T(k,n) - (k-1-alpha-beta) T(k-1,n) = G(n) - G(n+1)", gammasimp(step / T))
prove("(7.4) the last term, n = k", (k * T - G).subs(n, k))
prove("(7.4) G(0) = 0", G.subs(n, 0))
#< certificate

for j in range(8):
    prove(f"(7.2) c_k = (alpha + beta)_k, k = {j}",
          expand(sum(weight(a, i) * weight(b, j - i) for i in range(j + 1)) - weight(a + b, j)))
half = weights(Rational(1, 2), 201)
for j in range(201):
    c = sum(half[i] * half[j - i] for i in range(j + 1))
    claim(f"(7.2) alpha = beta = 1/2, k = {j}", c == [1, -1][j] if j < 2 else c == 0)
for j in range(1, 61):
    claim("(7.5) alpha_n = -2 C_{n-1} / 4^n", half[j] == -2 * catalan(j - 1) / S(4) ** j)
for j in range(1, 60):
    claim("(7.5) Segner: C_j = sum C_i C_{j-1-i}",
          catalan(j) == sum(catalan(i) * catalan(j - 1 - i) for i in range(j)))
claim("(7.6) C_30 < 2^53 < C_31, and C_31 is odd",
      catalan(30) < 2 ** 53 < catalan(31) and catalan(31) % 2 == 1)

# ---- the lemma, on sequences ----


def minus(w, z, j):
    return sum(w[i] * z[j - i] for i in range(j + 1))


def plus(w, z, j):
    return sum(w[i] * z[j + i] for i in range(len(z) - j))


def twice(w, z, j):
    """Return the paper's double sum, sum_n alpha_n sum_p alpha_p z_{j-n-p}."""
    return sum(w[i] * sum(w[p] * z[j - i - p] for p in range(j - i + 1)) for i in range(j + 1))


N = 8
x = symbols(f"x0:{N + 1}")
for j in range(N + 1):
    before = x[j - 1] if j > 0 else 0
    prove(f"(7.3) the lemma, k = {j}", expand(twice(half, x, j) - (x[j] - before)))
    after = x[j + 1] if j < N else 0
    ahead = [plus(half, x, i) for i in range(N + 1)]
    prove(f"(7.3) its mirror, k = {j}", expand(plus(half, ahead, j) + (after - x[j])))
    prove("(7.1) two sums are the double sum",
          expand(minus(half, [minus(half, x, i) for i in range(N + 1)], j) - twice(half, x, j)))
for q in range(2, 7):
    ws, c = weights(Rational(1, q), 41), [1] + [0] * 40
    for _ in range(q):
        c = [sum(ws[i] * c[j - i] for i in range(j + 1)) for j in range(41)]
    claim(f"(7.7) order 1/{q}, {q} times", c == [1, -1] + [0] * 39)


def l1(order, j):
    """Return the weights of the L1 rule: Caputo's derivative of a piecewise linear x."""
    if j == 0:
        return 1 / gamma(2 - order)
    return ((j + 1) ** (1 - order) - 2 * S(j) ** (1 - order)
            + S(j - 1) ** (1 - order)) / gamma(2 - order)


h2 = [l1(Rational(1, 2), j) for j in range(4)]
c_l1 = [simplify(sum(h2[i] * h2[j - i] for i in range(j + 1))) for j in range(4)]
prove("(7.8) L1: c_0 = 4/pi, c_1 = 8 (sqrt(2) - 2)/pi",
      c_l1[0] - 4 / pi, c_l1[1] - 8 * (sqrt(2) - 2) / pi)
claim("(7.8) and the rest does not vanish", c_l1[2] != 0 and c_l1[3] != 0)

# ---- the printed proof ----


def beta(w, j, l):
    return 2 * w[l + j] + sum(w[i] * w[l + j - i] for i in range(1, j))


other = [S(1), -S(1) / 2, -S(1) / 8, S(0)]      # alpha_3 = -1/16 is replaced by 0
claim("the induction starts", beta(half, 2, 0) == beta(other, 2, 0) == 0)
claim("but does not go on", beta(half, 3, 0) == 0 and beta(other, 3, 0) == S(1) / 8)

for kk in range(2, 9):
    for r in range(1, kk):
        inner = lambda i: sum(half[p] * x[kk - i - p] for p in range(1, kk - i + 1))
        head = (x[kk] - x[kk - 1] + sum(beta(half, s, 0) * x[kk - s] for s in range(2, r + 1))
                + sum(beta(half, r + 1, l) * x[kk - (r + 1) - l] for l in range(kk - r)))
        printed = head + sum(half[i] * inner(i) for i in range(r, kk + 1))
        right = head + sum(half[i] * inner(i) for i in range(r + 1, kk + 1))
        prove("the reorganised sum, from n = r + 1", expand(right - twice(half, x, kk)))
        if r == kk - 1:
            prove("as printed, from n = r", expand(
                twice(half, x, kk) - printed - half[kk - 1] * x[0] / 2))
claim("off by -1/4, -1/16, -1/32, -5/256 of x_0", [half[j - 1] / 2 for j in range(2, 6)]
      == [-S(1) / 4, -S(1) / 16, -S(1) / 32, -S(5) / 256])

# ---- the corollary ----

m, h, rho, kappa = symbols("m h rho kappa", positive=True)
U, y0, y1 = Function("U"), *symbols("y0 y1")
Ld = m * (y1 - y0) ** 2 / (2 * h) - h * U(kappa * y0 + (1 - kappa) * y1)


def D1(p, q):
    return diff(Ld, y0).subs({y0: p, y1: q}).doit()


def D2(p, q):
    return diff(Ld, y1).subs({y0: p, y1: q}).doit()


#> corollary
for j in range(1, N):
    dynamics = D1(x[j], x[j + 1]) + D2(x[j - 1], x[j])
    fractional = dynamics - rho * twice(half, x, j)  # h rho Delta Delta x_k
    forced = dynamics + -rho * (x[j] - x[j - 1])     # f^+(x_{k-1}, x_k), f^- = 0
    prove(f"(7.9) the two equations are one, k = {j}", expand(fractional - forced))
#< corollary


def run(force, explicit, count, memory):
    """Return x_0, ..., x_count in rationals: m = c = 1, h = 1/2, rho = 1/5, x_0 = 1, p_0 = 1/2. explicit: kappa = 1,
    U' = force; else kappa = 1/2, U' = x. memory: the paper's double sum; else the discrete force of
    Lagrange-d'Alembert."""
    h, rho, xs, p = Rational(1, 2), Rational(1, 5), [S(1)], Rational(1, 2)
    for j in range(count):
        if j > 0:
            fractional = rho * (twice(half, xs, j) if memory else xs[j] - xs[j - 1])
            end = 0 if explicit else h * (xs[j] + xs[j - 1]) / 4
            p = (xs[j] - xs[j - 1]) / h - end - fractional  # F^+
        if explicit:  # p = (y - x)/h + h U'(x)
            xs.append(xs[j] + h * (p - h * force(xs[j])))
        else:         # p = (y - x)/h + h (x + y)/4
            xs.append((p + xs[j] / h - h * xs[j] / 4) / (1 / h + h / 4))
    return xs


#> runs
harmonic = run(None, False, 30, memory=True)
claim("(7.9) 31 identical rationals", harmonic == run(None, False, 30, memory=False))
claim("they begin like this",
      harmonic[:4] == [1, Rational(19, 17), Rational(1389, 1445), Rational(72883, 122825)])
for name, force in (("U = x^2/2 + x^3/3", lambda x: x + x ** 2),
                    ("U = x^2/2 + x^4/8", lambda x: x + x ** 3 / 2)):
    nonlinear = run(force, True, 7, memory=True)
    claim(f"(7.9) identical rationals, {name}, kappa = 1",
          nonlinear == run(force, True, 7, memory=False))
#< runs

# ---- exact values ----


def digits(f):
    def at(count):
        mpmath.mp.dps = count + 20
        return mpmath.nstr(f(), count)
    return hexd_real(at, 100)  # c_32 at 1/4 + 1/4 lies exactly between two doubles


@cache
def mp_weights(order, digits):
    o = mpmath.mpf(order)
    return [(-1) ** j * mpmath.binomial(o, j) for j in range(61)]


def product(o, q, j, pick=lambda v: v):
    u, v = mp_weights(o, mpmath.mp.dps), mp_weights(q, mpmath.mp.dps)
    return mpmath.fsum(pick(u[i] * v[j - i]) for i in range(j + 1))


header("verify/half_derivative/half_derivative.py")
ORDERS = [(0.1, 0.3), (0.25, 0.25), (1 / 3, 0.5), (0.7, 0.9), (0.9, 1.3), (1.0, 0.4), (2.0, 1.5),
          (0.0, 0.6)]
table("ref_products", "double alpha, beta; size_t k; double want, size;",
      [[hexd(o), hexd(q), j, digits(lambda: product(o, q, j)),
        digits(lambda: product(o, q, j, abs)), f"orders {o!r}, {q!r}"]
       for o, q in ORDERS for j in (0, 1, 2, 3, 7, 30, 31, 32, 60)])

Z = [2, -3, 1, 4, -1, -5, 3, 2, -4, 6, 1, -2, 5]


def two(o, step, j, pick=lambda v: v):
    u = mp_weights(o, mpmath.mp.dps)
    once = [mpmath.fsum(pick(u[i] * Z[q - i]) for i in range(q + 1)) for q in range(j + 1)]
    return mpmath.mpf(step) ** (-2 * mpmath.mpf(o)) * mpmath.fsum(
        pick(u[i] * once[j - i]) for i in range(j + 1))


array("ref_z", Z, "the sequence of the next table")
table("ref_twice", "double alpha, h; size_t k; double want, size;",
      [[hexd(o), hexd(step), j, digits(lambda: two(o, step, j)),
        digits(lambda: two(o, step, j, abs)), f"alpha = {o!r}, h = {step!r}"]
       for o, step in ((0.1, 0.1), (1 / 3, 0.5), (0.5, 0.1), (0.75, 0.3), (1.0, 0.2), (1.6, 2.0))
       for j in range(len(Z))])


def growth(h, rho):
    """Return sum_j |M^j| for the Lagrange-d'Alembert map M of (x, p), m = c = 1, kappa = 1/2. Rounding errors of size
    e in every step never add up to more than this sum times e. (p = dx/h + h (x + dx/2)/2, then p' = p - h (x + dx/2)
    - rho dx.)"""
    one = Rational(1)
    dx = [-h / 2 / (one / h + h / 4), one / (one / h + h / 4)]  # coefficients of x and of p
    M = [[1 + dx[0], dx[1]],
         [-h * (1 + dx[0] / 2) - rho * dx[0], 1 - h * dx[1] / 2 - rho * dx[1]]]
    M = [[float(v) for v in row] for row in M]
    power, total = [[1.0, 0.0], [0.0, 1.0]], 0.0
    while (norm := max(abs(r[0]) + abs(r[1]) for r in power)) > 1e-12:
        total += norm
        power = [[sum(row[i] * M[i][j] for i in (0, 1)) for j in (0, 1)] for row in power]
    return total


table("ref_l1", "double want;", [[hexd_real(lambda count: v.evalf(count)), f"4/pi times {simplify(v * pi / 4)}"]
                                for v in c_l1])
print("\n/* Rounding in a run of (7.9) grows by at most this factor, rounded up. */")
print(f"enum {{ REF_GROWTH_2 = {int(growth(Rational(1, 2), Rational(1, 5))) + 1}, /* h = 1/2 */")
print(f"       REF_GROWTH_5 = {int(growth(Rational(1, 5), Rational(1, 5))) + 1} }}; /* h = 1/5 */")
array("ref_harmonic", harmonic, "x_0, ..., x_30 of (7.9): m = c = 1, h = 1/2, rho = 1/5,\n"
      " * kappa = 1/2, x_0 = 1, p_0 = 1/2, by the double sums, in rationals")
array("ref_duffing", nonlinear, "x_0, ..., x_7 with U = x^2/2 + x^4/8 and kappa = 1")
