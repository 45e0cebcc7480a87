"""H 29: elongations as coordinates of a variational principle, for any Lagrangian; momenta that are conserved, works
that are not negative, and two counterexamples."""
from mpmath import gamma, mp, mpf
from sympy import (Function, Matrix, Rational, S, Symbol, cos, diag, diff, expand, integrate, simplify, sin, sqrt, symbols,
                   zeros)

from shared.refgen import claim, header, hexd_real, prove, prove_rational

h, rho = symbols("h rho", positive=True)
g = Function("g")
L = Function("L")

# ---- (29.2): if only g is doubled, the curves mix; (29.3): if the elongations are coordinates, they do not.
# Three steps, any weights, any g: back is Delta_-^alpha, ahead is Delta_+^alpha.
N = 3
x, y, z, w, la, mu, W = (symbols(f"{name}0:{N + 1}") for name in ("x", "y", "z", "w", "l", "m", "W"))


def back(s):
    return [sum(W[n] * s[k - n] for n in range(k + 1)) for k in range(N + 1)]


def ahead(s):
    return [sum(W[n] * s[k + n] for n in range(N - k + 1)) for k in range(N + 1)]


gx, gy = [g(v) - g(x[0]) for v in x], [g(v) - g(y[N]) for v in y]
naive = -h * rho * sum(a * b for a, b in zip(back(gx), ahead(gy)))
for k in range(1, N):
    slope = (diff(naive, x[k]) + diff(naive, y[k])).doit()
    mixed = -h * rho * (diff(g(x[k]), x[k]) * ahead(ahead(gy))[k] + diff(g(y[k]), y[k]) * back(back(gx))[k])
    prove("(29.2) doubling g alone mixes the curves", expand((slope - mixed).doit()))
    wanted = -h * rho * (diff(g(x[k]), x[k]) * back(back(gx))[k] + diff(g(y[k]), y[k]) * ahead(ahead(gy))[k])
    claim("and that is another equation", expand((slope - wanted).doit()) != 0)

zz, ww = [v - z[0] for v in z], [v - w[N] for v in w]
extended = -h * rho * sum(a * b for a, b in zip(back(zz), ahead(ww))) + h * sum(
    la[i] * (z[i] - g(x[i])) + mu[i] * (w[i] - g(y[i])) for i in range(N + 1))
for k in range(1, N):
    by_z = diff(extended, z[k]) + diff(extended, w[k])
    prove("(29.3) lambda and mu are the forces of the damper and of its mirror image",
          expand(by_z - h * (la[k] - rho * back(back(zz))[k] + mu[k] - rho * ahead(ahead(ww))[k])))
    by_x = (diff(extended, x[k]) + diff(extended, y[k])).doit()
    prove("(29.3) each curve feels its own", expand(
        by_x + h * (la[k] * diff(g(x[k]), x[k]) + mu[k] * diff(g(y[k]), y[k])).doit()))

# ---- (29.6): the node scheme is such a sum, in which z is the mean of two nodes
k = 1
nodes = sum(h * L((x[i] + x[i + 1]) / 2, (x[i + 1] - x[i]) / h) - h * la[i] * (g(x[i]) + g(x[i + 1])) / 2
            for i in range(N))


def pieces(i):
    """Return L_v and L_x at the middle of step i."""
    a, b = symbols("a b")
    at = {a: (x[i] + x[i + 1]) / 2, b: (x[i + 1] - x[i]) / h}
    return L(a, b).diff(b).subs(at), L(a, b).diff(a).subs(at)


Lv0, Lx0 = pieces(0)
Lv1, Lx1 = pieces(1)
after = Lv0 + h / 2 * Lx0 - h / 2 * diff(g(x[1]), x[1]) * la[0]
before = Lv1 - h / 2 * Lx1 + h / 2 * diff(g(x[1]), x[1]) * la[1]
prove("(29.6) p_1 from the left is p_1 from the right", simplify((diff(nodes, x[1]) - (after - before)).doit()))

# ---- (29.8): form D, for any L; three stages of the past and the present, any causal matrices
n = 3
b = symbols("b0:3", positive=True)
Dm = Matrix(n, n, lambda i, j: Symbol(f"d{i}{j}") if j <= i else 0)
Da = Matrix(n, n, lambda i, j: Symbol(f"a{i}{j}") if j <= i else 0)
B = diag(*b)
Dp, Dap = B.inv() * Dm.T * B, B.inv() * Da.T * B
X, V, P, Z, La = (Matrix(symbols(f"{name}0:3")) for name in ("X", "V", "P", "Z", "L"))
Y, Wv, Q, U, Mu = (Matrix(symbols(f"{name}0:3")) for name in ("Y", "W", "Q", "U", "M"))


def dot(f, e):
    return (f.T * B * e)[0]


action = sum(b[i] * (L(X[i], V[i]) + L(Y[i], Wv[i])) for i in range(n)) - dot(P, V) - dot(Q, Wv) + dot(Q, Dm * X) \
    - dot(Y, Dm * P) + sum(b[i] * (La[i] * (Z[i] - g(X[i])) + Mu[i] * (U[i] - g(Y[i]))) for i in range(n)) \
    - rho * dot(Da * Z, Dap * U)
for k in range(n):
    pairs = [
        (diff(action, X[k]) + diff(action, Y[k]),
         diff(L(X[k], V[k]), X[k]) - (Dm * P)[k] - La[k] * diff(g(X[k]), X[k])
         + diff(L(Y[k], Wv[k]), Y[k]) + (Dp * Q)[k] - Mu[k] * diff(g(Y[k]), Y[k])),
        (diff(action, V[k]) + diff(action, Wv[k]),
         diff(L(X[k], V[k]), V[k]) - P[k] + diff(L(Y[k], Wv[k]), Wv[k]) - Q[k]),
        (diff(action, P[k]) + diff(action, Q[k]), (Dm * X)[k] - V[k] - (Dp * Y)[k] - Wv[k]),
        (diff(action, Z[k]) + diff(action, U[k]),
         La[k] - rho * (Da * Da * Z)[k] + Mu[k] - rho * (Dap * Dap * U)[k])]
    # The third line pairs Q with X and Y with P, so the mirror image has its own sign.
    prove("(29.8) form D is stationary for any L", *(expand((have - b[k] * want).doit()) for have, want in pairs))

# ---- one equation for both forms: b_i (A^-1)_ij = -b_j D_ji + [i = j = s], and b^T A^-1 = e_s^T
for s, c in ((2, [0, 1]), (3, [0, Rational(1, 2), 1]), (4, [0, (5 - sqrt(5)) / 10, (5 + sqrt(5)) / 10, 1])):
    t = Symbol("t")
    basis = [S(1)] * s
    for j in range(s):
        for m in range(s):
            if m != j:
                basis[j] *= (t - c[m]) / (c[j] - c[m])
    weight = [simplify(integrate(expand(e), (t, 0, 1))) for e in basis]
    D = Matrix(s, s, lambda i, j: simplify(diff(basis[j], t).subs(t, c[i])))
    inverse = D.copy()
    inverse[0, 0] += 1 / weight[0]
    Bs = diag(*weight)
    prove("(29.7) E and T of both forms", *((Bs * inverse + D.T * Bs - diag(*([0] * (s - 1) + [1]))).applyfunc(simplify)))
    prove("(29.8) p_{k+1} is L_v of the last stage",
          *((Matrix([weight]) * inverse - Matrix([[0] * (s - 1) + [1]])).applyfunc(simplify)))
    A = inverse.inv()
    prove("(29.16) the first row of A D is zero", *(simplify(v) for v in (A * D)[0, :]))

# ---- (29.14): rotations. L depends on |x|^2, |v|^2, x.v and x x v alone, and g on |x|^2
R = Matrix([[0, -1], [1, 0]])
f, G = Function("f"), Function("G")


def invariant(a, v):
    return f((a.T * a)[0], (v.T * v)[0], (a.T * v)[0], a[0] * v[1] - a[1] * v[0])


a, v = Matrix(symbols("a1 a2")), Matrix(symbols("v1 v2"))
La_, Lv_ = (Matrix([diff(invariant(a, v), q) for q in of]) for of in (a, v))
grad = Matrix([diff(G((a.T * a)[0]), q) for q in a])
lam = Symbol("lambda")
xk, xn = Matrix(symbols("x1 x2")), Matrix(symbols("y1 y2"))


def at(e, place, slope):
    return e.subs(dict(zip(list(a) + list(v), list(place) + list(slope))), simultaneous=True).doit()


middle, slope = (xk + xn) / 2, (xn - xk) / h
left = at(Lv_, middle, slope) - h / 2 * at(La_, middle, slope) + h / 2 * at(grad, xk, slope) * lam
right = at(Lv_, middle, slope) + h / 2 * at(La_, middle, slope) - h / 2 * at(grad, xn, slope) * lam
prove("(29.14) the node scheme keeps angular momentum", ((right.T * R * xn) - (left.T * R * xk))[0])
prove("(29.14) L and g have no torque", (La_.T * R * a + Lv_.T * R * v)[0], (grad.T * R * a)[0])
# Form M: sum_i R_i . Xi X_i = 0 for any matrix D, as L_x . Xi x + L_v . Xi v = 0 at each stage.
s = 3
Ds = Matrix(s, s, lambda i, j: Symbol(f"D{i}{j}"))
bs = symbols("b0:3")
Lx_i, Lv_i, X_i = (Matrix(s, 2, lambda i, j, q=q: Symbol(f"{q}{i}{j}")) for q in ("p", "q", "X"))
rows = [h * bs[i] * Lx_i[i, :] + sum((Ds[j, i] * bs[j] * Lv_i[j, :] for j in range(s)), zeros(1, 2)) for i in range(s)]
torque = sum((rows[i] * R * X_i[i, :].T)[0] for i in range(s))
local = sum((h * bs[i] * (Lx_i[i, :] * R * X_i[i, :].T + Lv_i[i, :] * R * (Ds * X_i)[i, :].T / h))[0] for i in range(s))
prove("(29.14) form M keeps it for any matrix D", expand(torque - local))
# Form D: the last entry of T is smaller by 1, and h V has the additional term (X_1 - x_k) / b_1 at the first stage.
start = Matrix(1, 2, symbols("x1 x2"))
slopes = Ds * X_i / h
slopes[0, :] += (X_i[0, :] - start) / (h * bs[0])
rows = [h * bs[i] * Lx_i[i, :] + sum((Ds[j, i] * bs[j] * Lv_i[j, :] for j in range(s)), zeros(1, 2)) for i in range(s)]
rows[s - 1] -= Lv_i[s - 1, :]
torque = sum((rows[i] * R * X_i[i, :].T)[0] for i in range(s))
local = sum((h * bs[i] * (Lx_i[i, :] * R * X_i[i, :].T + Lv_i[i, :] * R * slopes[i, :].T))[0] for i in range(s))
prove("form D turns it by the product of two jumps", expand(
    torque - local + (Lv_i[0, :] * R * (X_i[0, :] - start).T)[0] + (Lv_i[s - 1, :] * R * X_i[s - 1, :].T)[0]))

# ---- (29.11), (29.12): works of one step of a damper with g = x^2, w_0 = 1
p, q = symbols("p q", real=True)
node = (q**2 - p**2) / 2 * (q**2 - p**2)
prove("(29.11) at nodes a square", expand(node - (q**2 - p**2)**2 / 2))
first = (q**2 - p**2) * 2 * q * (q - p)
m = (p + q) / 2
mid = (m**2 - p**2) * 2 * m * (q - p)
claim("(29.12) order 1 gives 18 from 2 to -1", first.subs({p: 2, q: -1}) == -18)
claim("(29.12) the middle of the step gives 36 from 2 to -4", mid.subs({p: 2, q: -4}) == -36)
claim("(29.12) where the node scheme takes 72", node.subs({p: 2, q: -4}) == 72)

# ---- (29.13): L quadratic, g linear: E falls by the work, in each step
M = Matrix(2, 2, [Symbol("m11"), Symbol("m12"), Symbol("m12"), Symbol("m22")])
K = Matrix(2, 2, [Symbol("k11"), Symbol("k12"), Symbol("k12"), Symbol("k22")])
row = Matrix(symbols("r1 r2"))
start = M * slope + h / 2 * K * middle + h / 2 * row * lam
end = M * slope - h / 2 * K * middle - h / 2 * row * lam


def energy(momentum, place):
    return ((momentum.T * M.inv() * momentum) / 2 + (place.T * K * place) / 2)[0]


prove("(29.13) energy and work add up in each step",
      simplify(energy(end, xn) - energy(start, xk) + lam * (row.T * (xn - xk))[0]))

# ---- (29.15): a spring in series with a springpot
spring, pot, o = symbols("k P o", positive=True)
prove("(29.15) in series they are Zener's law", simplify(1 / (1 / spring + 1 / pot) - pot / (1 + pot / spring)))

# ---- (29.17): no oscillation remains, and a line stays a line
for values, wanted in (((1, -1, 1), 0), ((1, 1, 1), 1), ((0, -1, -2), 0)):
    prove("(29.17) the line through the last two means", Rational(3 * values[0] + 2 * values[1] - values[2], 4) - wanted)

# ---- (29.4): a rod of length 1 that turns satisfies the hidden constraint
th, om = symbols("theta omega")
place, speed = Matrix([sin(th), -cos(th)]), om * Matrix([cos(th), sin(th)])
prove("(29.4) the rod's velocity keeps to it", simplify((place.T * speed)[0]))

# ---- (29.20), (29.21), (29.22): impacts, of masses M in three coordinates with one constraint whose gradient is c
m, v3, n3, q3, e, c_t, Z_t = symbols("m1:4", positive=True), *(symbols(f"{letter}1:4") for letter in "vnq"), *symbols("e c_t Z_t")
M3, n, c = diag(*m), Matrix(n3), Matrix(q3)
Mi = M3.inv()
P = Mi - Mi * c * c.T * Mi / (c.T * Mi * c)[0]
v = Matrix(v3)


def dot(left, right):
    return (left.T * right)[0]


lam = -(1 + e) * (dot(n, v) + Z_t) / dot(n, P * n)
after = v + lam * P * n
prove_rational("(29.22) the constraint's velocity does not jump", dot(c, after - v))
prove_rational("(29.22) the speed of Z turns round", dot(n, after) + Z_t + e * (dot(n, v) + Z_t))
w_tie = lam * dot(c, Mi * n) / dot(c, Mi * c)
prove_rational("(29.22) the jump of p is one along n and one along c", *(M3 * (after - v) - lam * n + w_tie * c))
free = v - (1 + e) * (dot(n, v) + Z_t) / dot(n, Mi * n) * Mi * n
prove_rational("(29.21) without a constraint", dot(n, free) + Z_t + e * (dot(n, v) + Z_t))
held = P * M3 * v                                    # any velocity with c . v = 0
bounced = held - 2 * dot(n, held) / dot(n, P * n) * P * n
prove_rational("with e = 1 no energy is lost", dot(bounced, M3 * bounced) - dot(held, M3 * held))
# In coordinates of the surface, x = phi(q) with two slopes T, c . T = 0, the impact is (29.21) of T^T M T and T^T n.
T = Matrix([[c[1], c[2]], [-c[0], 0], [0, -c[0]]])
prove("the slopes lie in the surface", *(c.T * T))
prove_rational("(29.22) is (29.21) in coordinates of the surface", *(P - T * (T.T * M3 * T).inv() * T.T))
tau, push = Matrix([Rational(1, 2), sqrt(3) / 2]), Matrix([-1, 0])
hit = 2 * tau - Rational(3, 2) * dot(push, 2 * tau) / dot(push, tau)**2 * tau * dot(tau, push)
prove("the bob of the page", *(hit + tau), -Rational(3, 2) * dot(push, 2 * tau) / dot(push, tau)**2 - 6)

header("verify/lagrangian/lagrangian.py")


def relaxation(digits):
    """Return the integral to t = 2 of 0.7 t^-0.6 / Gamma(0.4), for the doubles nearest to 0.7 and 0.6."""
    mp.dps = digits + 10
    order = 2 * mpf(0.3)
    return mpf(0.7) * mpf(2)**(1 - order) / gamma(2 - order)


print("/* The impulse of a springpot 0.7 s^0.6 that is pulled to 1 at t = 0, up to t = 2. */")
print(f"static const double relaxation_impulse = {hexd_real(relaxation)};")
