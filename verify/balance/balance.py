"""H 21. Which conservation laws of mechanics survive.

Proved here:
  (21.3) the doubled action is Bateman's and a term in x - y: symbols, N = 3;
  (21.4) C_n - C_{n-1} = v_n . ((K - T) u)_n - u_n . ((K - T)^T v)_n for any K, T, u, v,
         N = 5, in R^2 with symmetric blocks K and diagonal blocks T, where T has one
         diagonal above the main one; the equation fails if T is transposed in the sum;
  (21.5) the form at alpha = 1/2, and at rho = 0;
  (21.6) the response of two masses to each other, in numbers, with any weights, N = 4;
  (21.7) D_1 L_d . Xi x + D_2 L_d . Xi y = 0 for a generic central U in R^2;
  (21.9) the sum of the dampings is Delta^{2 alpha - 1}: alpha symbolic, k <= 8;
  (21.8) a symmetry of unequal masses turns a solution into a solution if Xi^T rho + rho Xi = 0, and
         not if Xi and rho commute;
  (21.12) the imaginary parts on the circle, for three schemes.
The proofs for H 12 of (12.13), (12.15) and (12.16) are in memory.py. Printed: forms and energies without rounding
errors, from the definitions in rationals; the response of five masses to each other, from dense matrices at 60 and 90
digits."""
import mpmath
from sympy import (I, Function, Matrix, Rational, Symbol, arg, binomial, conjugate, cos, diff,
                   exp, expand, expand_complex, gamma, im, pi, re, sin, sqrt, symbols,
                   trigsimp, zeros)

from shared.arithmetic import factorised, substituted
from shared.refgen import array, claim, header, hexd, hexd_real, prove, table

Q = Rational

# ---- the doubled action ----

N = 3
x, y = (Matrix(symbols(f"{c}:{N + 1}")) for c in "xy")
K = Matrix(N + 1, N + 1, lambda i, j: Symbol(f"K{min(i, j)}{max(i, j)}") if abs(i - j) < 2 else 0)
T = Matrix(N + 1, N + 1, lambda i, j: Symbol(f"T{i - j}") if i >= j else 0)
doubled = (x.T * K * x + y.T * K * y)[0] / 2 - (y.T * T * x)[0]
prove("(21.3) Bateman's action and a square of x - y", expand(
    doubled - (y.T * (K - T) * x)[0] - ((x - y).T * K * (x - y))[0] / 2))

# ---- Green's identity ----

#> green
N, d = 5, 2


def node(c, k):
    return Matrix(symbols(f"{c}{k}_:{d}"))


def block(k, j):
    """Return K_{kj}. It is symmetric and K_{jk} = K_{kj}^T, like the Hessian of an action."""
    a, b = min(k, j), max(k, j)
    return Matrix(d, d, lambda i, l: Symbol(f"K{a}{b}_{min(i, l)}{max(i, l)}")) \
        if b - a < 2 else zeros(d, d)


def memory(k, j):
    """Return T_{kj}. It is diagonal, and zero for j > k + 1."""
    return Matrix(d, d, lambda i, l: Symbol(f"T{k - j + 1}_{i}") if i == l else 0) \
        if k - j >= -1 else zeros(d, d)


u, v = ([node(c, k) for k in range(N + 1)] for c in "uv")


def form(n, T):
    far = sum((v[j].dot(T(j, k) * u[k]) - v[k].dot(T(k, j) * u[j])
               for k in range(n + 1) for j in range(n + 1, N + 1)), 0)
    return v[n].dot(block(n, n + 1) * u[n + 1]) - u[n].dot(block(n, n + 1) * v[n + 1]) + far


def forward(k):
    return sum(((block(k, j) - memory(k, j)) * u[j] for j in range(N + 1)), zeros(d, 1))


def backward(k):
    return sum(((block(j, k) - memory(j, k)).T * v[j] for j in range(N + 1)), zeros(d, 1))


for n in range(1, N):
    change = v[n].dot(forward(n)) - u[n].dot(backward(n))
    prove(f"(21.4) C_{n} - C_{n - 1}", expand(form(n, memory) - form(n - 1, memory) - change))
    wrong = expand(form(n, lambda k, j: memory(j, k)) - form(n - 1, lambda k, j: memory(j, k)) - change)
    claim("(21.4) not with T transposed", wrong != 0)
#< green

half = {Symbol(f"T{i}_{l}"): 0 for i in (0, 3, 4, 5, 6) for l in range(d)}
half |= {Symbol(f"T2_{l}"): -Symbol(f"T1_{l}") for l in range(d)}     # h^0 rho (1 - z)
rho = Matrix(d, d, lambda i, l: Symbol(f"T1_{i}") if i == l else 0)
for n in range(N):
    bateman = (v[n].dot(block(n, n + 1) * u[n + 1]) - u[n].dot(block(n, n + 1) * v[n + 1])
               - v[n + 1].dot(rho * u[n]))
    prove("(21.5) Bateman's form", expand(form(n, memory).subs(half) - bateman))

# ---- the points at which grad U is evaluated, and the nodes on which it acts ----

#> felt
# grad U is evaluated at S_i = sum_l a_l x_{i+l}, and it acts on the node k as sum_l b_l grad U(S_{k-l}).
N, width = 5, 3
a, b, G = symbols("a:3"), symbols("b:3"), symbols("G:6")


def force_matrix(a, b, G):
    """Return the derivatives of the force on the node k with respect to x_j; G_i = U''(S_i)."""
    B = zeros(N + width, N + width)
    for i in range(N + 1):
        B[i:i + width, i:i + width] += G[i] * Matrix(b) * Matrix(a).T
    return B


P = Matrix(N + width, N + width, lambda i, j: int(i + j == N + width - 1))
prove("transposed and read backwards: asked at the mirror of b, felt at that of a",
      *(P * force_matrix(a, b, G).T * P - force_matrix(b[::-1], a[::-1], G[::-1])))
for i in range(width):
    for j in range(width):
        prove("the force is a gradient for every U if and only if all of these vanish",
              diff((force_matrix(a, b, G) - force_matrix(a, b, G).T)[i, j], G[0]) - (b[i] * a[j] - b[j] * a[i]))
# If U'' is constant, the force depends only on the difference of j and k. Then b = a is not necessary for a gradient:
# sum_l b_l a_{l+n} = sum_l a_l b_{l+n} suffices. For example, the weights b = (1/4, 1/2, 1/4) with a = (0, 1, 0), the
# middle, satisfy it.
mean = {**dict(zip(a, (0, 1, 0))), **dict(zip(b, (Q(1, 4), Q(1, 2), Q(1, 4))))}


def apart(a, b, n):
    return sum(b[l] * a[l + n] for l in range(width) if 0 <= l + n < width)


alike = force_matrix(a, b, [1] * (N + 1))
for j in range(width - 1, N + 1):                         # so that no i is cut off
    for k in range(width - 1, N + 1):
        prove("the forces of a quadratic U", alike[k, j] - (apart(a, b, j - k) if abs(j - k) < width else 0))
prove("mean has a gradient for quadratic U, and a is not b",
      *((apart(a, b, n) - apart(b, a, n)).subs(mean) for n in range(1, width)))
varied = force_matrix(a, b, G).subs(mean)
claim("mean has none where U'' varies", expand(varied - varied.T) != zeros(N + width, N + width))
#< felt

# ---- reciprocity ----

#> reciprocity
N, d = 4, 2
m, r, c = [1, 3], [2, 5], [1, 4, 2]
C = Matrix([[c[0] + c[1], -c[1]], [-c[1], c[1] + c[2]]])
t = symbols("w:5")                                        # any weights
mass, damping = Matrix([[m[0], 0], [0, m[1]]]), Matrix([[r[0], 0], [0, r[1]]])
q = Q(3, 16)                                              # kappa (1 - kappa), h = 1


def response(push):
    """Return x_1, ..., x_N from x_0 = 0 and p_0 = push, by solving K x - T x = -p_0 [k = 0]."""
    xs = [zeros(d, 1)]
    step = (mass + q * C).inv()
    for k in range(N):
        before = 2 * xs[k] - (xs[k - 1] if k else zeros(d, 1))
        load = -C * xs[k] - damping * sum((t[n] * xs[k - n] for n in range(k + 1)), zeros(d, 1))
        xs.append((before + step * (load + push if k == 0 else load)).applyfunc(expand))
    return xs


one, two = response(Matrix([1, 0])), response(Matrix([0, 1]))
for k in range(1, N + 1):
    prove(f"(21.6) mass 2 after a push of 1, mass 1 after a push of 2, k = {k}",
          expand(one[k][1] - two[k][0]))
#< reciprocity

# ---- Noether ----

kappa, h, mm, a = symbols("kappa h m a", positive=True)
x0, x1, y0, y1, s = symbols("x0 x1 y0 y1 s", real=True)
U = Function("U")


def rotated(z):
    return cos(s) * z[0] - sin(s) * z[1], sin(s) * z[0] + cos(s) * z[1]


def lagrangian(p, n):
    S = [kappa * p[i] + (1 - kappa) * n[i] for i in range(2)]
    return (mm / (2 * h) * sum((n[i] - p[i]) ** 2 for i in range(2))
            - h * U(S[0] ** 2 + S[1] ** 2))


#> rotation
L = lagrangian((x0, x1), (y0, y1))
turn = diff(L, x0) * -x1 + diff(L, x1) * x0 + diff(L, y0) * -y1 + diff(L, y1) * y0
prove("(21.7) a central U is blind to a rotation, any kappa", turn.doit())
#< rotation

# (21.8): rotations of (x_1 sqrt(m_1), x_2 sqrt(m_2)). The turned residual is -Xi^T times the residual.
m1, m2, r1, r2 = symbols("m1 m2 r1 r2", positive=True)
nodes = [Matrix(symbols(f"n{k}_:2")) for k in range(3)]
w0, w1, w2 = symbols("w0 w1 w2")
Xi = Matrix([[0, -m2], [m1, 0]])


def step(p, n):
    S = kappa * p + (1 - kappa) * n
    return ((m1 * (n[0] - p[0]) ** 2 + m2 * (n[1] - p[1]) ** 2) / (2 * h) - h * U(m1 * S[0] ** 2 + m2 * S[1] ** 2))


def turned(damping):
    action = step(nodes[0], nodes[1]) + step(nodes[1], nodes[2])
    memory = w0 * nodes[2] + w1 * nodes[1] + w2 * nodes[0]
    residual = Matrix([diff(action, v) for v in nodes[1]]) - damping * memory
    along = zeros(2, 1)
    for node in nodes:
        along += residual.jacobian(node) * (Xi * node)
    return (along + Xi.T * residual).doit().applyfunc(expand)


for entry in turned(Matrix([[r1 * m1, 0], [0, r1 * m2]])):
    prove("(21.8) a symmetry that is no rotation", entry)
claim("(21.8) equal dampings commute with Xi and do not do", turned(Matrix([[r1, 0], [0, r1]])) != zeros(2, 1))

for k in range(9):
    partial = sum((-1) ** n * binomial(2 * a, n) for n in range(k + 1))
    weight = (-1) ** k * binomial(2 * a - 1, k)
    prove("(21.9) W_k of order 2 a is w_k of order 2 a - 1",
          (partial - weight).expand(func=True))

# ---- energy: the imaginary parts ----

phi = Symbol("phi", real=True)
z = exp(-I * phi)
delta = ((1 - z) * (3 - z) / 2).rewrite(cos)
prove("(21.12) BDF2: Im delta = sin(phi) (2 - cos(phi))",
      trigsimp(expand(im(expand_complex(delta)) - sin(phi) * (2 - cos(phi)))))
prove("(21.12) Re delta = (1 - cos(phi))^2",
      trigsimp(expand(re(expand_complex(delta)) - (1 - cos(phi)) ** 2)))
prove("(21.12) the work of a wave", expand_complex(
    ((1 + z) / (1 - z) + I * cos(phi / 2) / sin(phi / 2)).rewrite(cos)))
mpmath.mp.dps = 30
for i in range(1, 200):                  # the angles that the proof adds, for the shifted scheme
    for al in (mpmath.mpf(j) / 20 for j in range(1, 21)):
        f = mpmath.pi * i / 200
        zz = mpmath.expj(-f)
        chi = (1 - zz) ** (2 * al) * (1 - al + al / zz)
        claim("(21.12) shifted: Im chi >= 0", chi.imag > -mpmath.mpf(10) ** -25)

# ---- values without rounding ----

N, d = 5, 2
H = Q(1, 4)
MASS, RHO, CG = [1, 2], [Q(1, 2), Q(3, 2)], [1, Q(1, 2)]
X = [[Q(v, 4) for v in p] for p in ((3, -2), (5, 1), (2, 4), (-3, 2), (-4, -1), (1, -3))]
P = [[Q(v, 8) for v in p] for p in ((4, 0), (7, -5), (-3, 6), (2, 2), (-9, 1), (5, -4))]
V = [[Q(v, 8) for v in p] for p in ((1, 3), (-6, 2), (8, -1), (3, 5), (-2, -7), (4, 2))]
EULER, BDF2 = "FVI_DELTA_EULER", "FVI_DELTA_BDF2"


def weights(kind, order, count):
    if kind == BDF2:
        claim("no square root here", order in (0, 1, 2))
        z = Symbol("z")
        series = expand(((1 - z) * (3 - z) / 2) ** order)
        return [series.coeff(z, n) for n in range(count)]
    return [(-1) ** n * binomial(order, n) for n in range(count)]


def dyadic_power(base, e):
    value = base ** e
    claim(f"{base}^{e} is rational", value.is_Rational)
    return value


def exact_forms(kind, theta, alpha, k):
    w = weights(kind, 2 * alpha, N + 2) + [0]

    def t(n):
        return (1 - theta) * (w[n] if n >= 0 else 0) + (theta * w[n + 1] if n >= -1 else 0)

    scale = dyadic_power(H, 1 - 2 * alpha)

    def couple(n, a, b):
        total = 0
        for i in range(d):
            S = k * X[n][i] + (1 - k) * X[n + 1][i]
            total -= (MASS[i] / H + k * (1 - k) * H * (CG[0] + 3 * CG[1] * S * S)) * a[i] * b[i]
        return total

    def far(n):
        return sum(RHO[i] * scale * (V[j][i] * t(j - l) * P[l][i] - V[l][i] * t(l - j) * P[j][i])
                   for l in range(n + 1) for j in range(n + 1, N + 1) for i in range(d))

    return [couple(n, V[n], P[n + 1]) - couple(n, P[n], V[n + 1]) + far(n) for n in range(N)]


def exact_energies(kind, theta, alpha, k, spring):
    """Return the energies of a chain of two masses with springs of the stiffness `spring`."""
    delta = 4 if kind == BDF2 else 2
    chi = dyadic_power(Q(delta), 2 * alpha) * (1 - 2 * theta)
    out = []
    for n in range(N):
        dx = [X[n + 1][i] - X[n][i] for i in range(d)]
        mid = [(X[n + 1][i] + X[n][i]) / 2 for i in range(d)]

        def u(z):
            return spring * (z[0] ** 2 + (z[1] - z[0]) ** 2 + z[1] ** 2) / 2

        energy = sum(MASS[i] * dx[i] ** 2 for i in range(d)) / (2 * H * H) + u(mid) \
            - (1 - 2 * k) ** 2 * u(dx) / 4                      # d.Cd/8 = U(d)/4
        out.append((energy, energy - dyadic_power(H, -2 * alpha) * chi / 8
                    * sum(RHO[i] * dx[i] ** 2 for i in range(d))))
    return out


# ---- five masses, dense ----


def masses_response(kind, theta, alpha, steps):
    """Return the matrix R_{ij} = position of mass i after `steps` steps from p_0 = e_j, x_0 = 0. It solves the
    equations (K - T) x = -p_0 [k = 0] as one dense system, which is block Toeplitz."""
    m = [1, 2, mpmath.mpf(1) / 2, 1, 3]
    r = [mpmath.mpf(v) / 8 for v in (1, 8, 0, 4, 2)]
    h, c, k = mpmath.mpf(1) / 4, 2, mpmath.mpf(1) / 4
    n = len(m)
    C = mpmath.matrix(n, n)
    for i in range(n):
        C[i, i] = 2 * c
        if i:
            C[i, i - 1] = C[i - 1, i] = -c
    count = steps + 2
    order = 2 * mpmath.mpf(alpha)
    # the coefficients of delta^order, by binomial series
    if kind == BDF2:
        one = [(-1) ** i * mpmath.binomial(order, i) for i in range(count)]
        other = [mpmath.power(3, order) / mpmath.power(2, order) * mpmath.binomial(order, i)
                 * (-mpmath.mpf(1) / 3) ** i for i in range(count)]
        w = [mpmath.fsum(one[i] * other[j - i] for i in range(j + 1)) for j in range(count)]
    else:
        w = [(-1) ** i * mpmath.binomial(order, i) for i in range(count)]
    th = mpmath.mpf(theta)
    scale = mpmath.power(h, 1 - order)
    dim = n * steps                                  # rows k = 0..steps-1, unknowns x_1..x_steps
    bits = mpmath.mp.prec + 60
    A = [[0] * dim for _ in range(dim)]              # in units of 2^-bits

    def put(row, col, i, l, value):
        if col >= 1 and value != 0:
            A[row * n + i][(col - 1) * n + l] += int(mpmath.ldexp(value, bits))

    for row in range(steps):
        for i in range(n):
            for col in range(row + 2):
                tt = (1 - th) * (w[row - col] if col <= row else 0) + th * w[row + 1 - col]
                put(row, col, i, i, -scale * r[i] * tt)
            put(row, row + 1, i, i, -m[i] / h)
            put(row, row, i, i, 2 * m[i] / h)
            put(row, row - 1, i, i, -m[i] / h)
            for l in range(n):
                put(row, row + 1, i, l, -h * k * (1 - k) * C[i, l])
                put(row, row, i, l, -h * (k * k + (1 - k) ** 2) * C[i, l])
                put(row, row - 1, i, l, -h * k * (1 - k) * C[i, l])
    lu = factorised(A, bits)                            # one factorisation serves all masses
    out = []
    for j in range(n):
        b = [0] * dim
        b[j] = -1 << bits
        solution = substituted(lu, b, lambda v: v >> bits)
        out.append([mpmath.ldexp(solution[(steps - 1) * n + i], -bits) for i in range(n)])
    return out


header("verify/balance/balance.py")
array("ref_x", [v for p in X for v in p], "x_0, ..., x_5 in R^2")
array("ref_u", [v for p in P for v in p], "u")
array("ref_v", [v for p in V for v in p], "v; none solves anything")
SCHEMES = [(EULER, Q(0), Q(1, 2)), (EULER, Q(0), Q(1, 4)), (EULER, Q(0), Q(3, 4)),
           (EULER, Q(1, 4), Q(1, 4)), (EULER, Q(1, 2), Q(1, 2)), (EULER, Q(3, 4), Q(3, 4)),
           (BDF2, Q(0), Q(1, 2)), (BDF2, Q(0), Q(0)), (EULER, Q(1), Q(1)), (EULER, Q(0), Q(0))]
#> forms
table("ref_forms", "fvi_delta weights; double theta, alpha, kappa; double want[5];",
      [[kind, hexd(theta), hexd(alpha), hexd(k),
        "{ " + ", ".join(hexd(v) for v in exact_forms(kind, theta, alpha, k)) + " }", ""]
       for kind, theta, alpha in SCHEMES for k in (Q(1, 4), Q(1))])
#< forms
table("ref_energies", "fvi_delta weights; double theta, alpha, kappa; double E[5], hat[5];",
      [[kind, hexd(theta), hexd(alpha), hexd(k),
        *("{ " + ", ".join(hexd(v[c]) for v in exact_energies(kind, theta, alpha, k, 2)) + " }"
          for c in (0, 1)), ""]
       for kind, theta, alpha in ((EULER, Q(0), Q(1, 2)), (EULER, Q(1, 4), Q(1, 2)), (BDF2, Q(0), Q(1, 4)),
                                  (BDF2, Q(0), Q(1, 2)), (EULER, Q(1), Q(1)), (EULER, Q(0), Q(0)))
       for k in (Q(1, 4), Q(1, 2))])
STEPS = 8


def digits(kind, theta, alpha):
    found = []
    for count in (60, 90):
        mpmath.mp.dps = count + 20
        found.append(masses_response(kind, theta, alpha, STEPS))
    n = len(found[0])
    for i in range(n):
        for j in range(n):
            claim("(21.6) Maxwell and Betti", abs(found[1][i][j] - found[1][j][i])
                  < mpmath.mpf(10) ** -80)
    return ["{ " + ", ".join(hexd_real(lambda c: mpmath.nstr(found[c > 60][j][i], c))
                             for i in range(n)) + " }" for j in range(n)]


print(f"\nenum {{ REF_STEPS = {STEPS} }};")
table("ref_response", "int method; double alpha; double x[5][5];",
      [[i, hexd(al), "{ " + ",\n        ".join(digits(kind, al if i == 1 else 0, al)) + " }",
        f"alpha = {al!r}, x[j][i] from a push of j"]
       for i, kind, al in ((0, EULER, 0.15), (0, EULER, 0.8), (1, EULER, 0.15), (1, EULER, 0.4),
                           (2, BDF2, 0.15), (2, BDF2, 0.4))])
