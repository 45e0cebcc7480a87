"""H 2. Proved with symbols, with the potential U open wherever possible:
  (2.1), (2.2)  Hamilton's principle and the energy balance;
  (2.6), (2.7)  the slopes of L_d, and the discrete Euler-Lagrange equations as
                the gradient of the action, which sympy computes, N = 4, d = 1 and 2;
  (2.8), (2.9)  the same with forces, and that matched momenta are equivalent;
  (2.10)        the equation of a step, for Algorithms 1 and 2 and implicit Euler;
  (2.12)        how a step changes areas, d = 1 and 2, any discrete Lagrangian;
  (2.13)        Euler's methods;
  (2.14)        the recurrence has order 2 for every kappa, the start does not;
and that the elliptic functions of the tests solve their equations.

Reference values: potentials and L_d from their formulas, which sympy differentiates.
Trajectories: discrete_mechanics_runs.py."""
from sympy import (Function, Matrix, Rational, cos, diff, expand, euler_equations, eye, ratsimp,
                   sin, solve, symbols, together, zeros)

from shared.refgen import header, hexd, hexd_real, prove, table

h, m, rho, kappa, c, t = symbols("h m rho kappa c t", positive=True)


# ---- U is any function: its derivatives are functions without a formula, too ----

class V(Function):
    """A derivative of U, whose order is given by its last arguments."""
    def fdiff(self, argindex=1):
        d = len(self.args) // 2
        z, order = self.args[:d], list(self.args[d:])
        order[argindex - 1] += 1
        return V(*z, *order)


def U(*z):
    return V(*z, *(0 for _ in z))


def gradient(*z):
    return [V(*z, *(int(i == j) for j in range(len(z)))) for i in range(len(z))]


# ---- continuous time ----

x = Function("x")(t)
v = diff(x, t)
F = Function("F")(t)
motion = -gradient(x)[0] - rho * v + F                                  # m x''
hamilton = euler_equations(m * v**2 / 2 - U(x), x, t)[0]
prove("(2.1) without forces: Hamilton's principle",
      hamilton.lhs - (-gradient(x)[0] - m * diff(x, t, 2)))
E = m * v**2 / 2 + U(x)
prove("(2.4) the energy balance",
      expand(diff(E, t).subs(diff(x, t, 2), motion / m).doit() - (-rho * v**2 + F * v)))

# ---- the action of N = 4 steps, in d = 1 and d = 2 dimensions ----

N = 4


def setting(d):
    mass, damp = symbols(f"m0:{d}", positive=True), symbols(f"rho0:{d}", positive=True)
    q = [symbols(f"q{k}_0:{d}") for k in range(N + 1)]
    return mass, damp, q


def lagrangian(mass, a, b):
    S = [kappa * p + (1 - kappa) * q for p, q in zip(a, b)]
    return sum(w * (q - p)**2 for w, p, q in zip(mass, a, b)) / (2 * h) - h * U(*S)   # (2.5)


def slopes(mass, a, b):
    """Return the slopes (2.6) as the chapter prints them."""
    g = gradient(*(kappa * p + (1 - kappa) * q for p, q in zip(a, b)))
    D1 = [-w * (q - p) / h - kappa * h * f for w, p, q, f in zip(mass, a, b, g)]
    D2 = [w * (q - p) / h - (1 - kappa) * h * f for w, p, q, f in zip(mass, a, b, g)]
    return D1, D2


#> action
for d in (1, 2):
    mass, damp, q = setting(d)
    action = sum(lagrangian(mass, q[k], q[k + 1]) for k in range(N))
    for k in range(1, N):
        D1, D2 = slopes(mass, q[k], q[k + 1])[0], slopes(mass, q[k - 1], q[k])[1]
        for i in range(d):
            prove("(2.7) is the gradient of the action",
                  expand(diff(action, q[k][i]) - (D1[i] + D2[i])))
    for i in range(d):
        prove("p_0 and p_N are its slopes at the ends",
              expand(diff(action, q[0][i]) - slopes(mass, q[0], q[1])[0][i]),
              expand(diff(action, q[N][i]) - slopes(mass, q[N - 1], q[N])[1][i]))
#< action

# The virtual work of discrete forces, any functions of the two ends of a step.
mass, damp, q = setting(1)
q = [z[0] for z in q]
fminus, fplus = Function("f^-"), Function("f^+")
dq = symbols("dq0:5")
action = sum(lagrangian(mass, [q[k]], [q[k + 1]]) for k in range(N))
work = sum(fminus(q[k], q[k + 1]) * dq[k] + fplus(q[k], q[k + 1]) * dq[k + 1] for k in range(N))
variation = sum(diff(action, q[k]) * dq[k] for k in range(N + 1)) + work
for k in range(1, N):
    D1 = slopes(mass, [q[k]], [q[k + 1]])[0][0]
    D2 = slopes(mass, [q[k - 1]], [q[k]])[1][0]
    forced = D1 + D2 + fminus(q[k], q[k + 1]) + fplus(q[k - 1], q[k])
    prove("(2.8) the forced equations", expand(diff(variation, dq[k]) - forced))
    minus, plus = -D1 - fminus(q[k], q[k + 1]), D2 + fplus(q[k - 1], q[k])
    prove("(2.9) matched momenta are (2.8)", expand(plus - minus - forced))

# (2.10): A d + s grad U(x + theta d) = r, the form that the solver takes.
a, b, r = symbols("a b r")
same_point = lambda e: expand(e.replace(V, lambda z, n: V(expand(z), n)))
prove("(2.10) for p = -D1 L_d: A = m/h, s = kappa h, theta = 1 - kappa, r = p",
      same_point(m / h * (b - a) + kappa * h * gradient(a + (1 - kappa) * (b - a))[0]
                 + slopes([m], [a], [b])[0][0]))
p_new, f_new = m * (b - a) / h, symbols("F1")
prove("(2.10) for implicit Euler: A = m/h + rho, s = h, theta = 1, r = p + h F",
      expand((m / h + rho) * (b - a) + h * gradient(b)[0] - (r + h * f_new)
             - (p_new - (r + h * (-gradient(b)[0] - rho * p_new / m + f_new)))))

# ---- areas ----

#> areas
# The derivatives of any discrete Lagrangian of two variables in R^2: D11 = A,
# D12 = B, D22 = C, and f^+ = -rho (y - x). A change (dx, dy) of the step changes
# p = -D1 L_d by -(A dx + B dy), p+ = D2 L_d + f^+ by B' dx + C dy - rho (dy - dx).
A, C = Matrix(2, 2, symbols("a0 a1 a1 a2")), Matrix(2, 2, symbols("c0 c1 c1 c2"))
B, R = Matrix(2, 2, symbols("b0:4")), Matrix(2, 2, [symbols("r0"), 0, 0, symbols("r1")])
one, two = [[Matrix(2, 1, symbols(f"{n}{i}_0:2")) for n in ("u", "w")] for i in (1, 2)]


def area(first, second):
    """Return sum_i dx_i ^ dp_i of two changes (dx, dp)."""
    return (first[0].T * second[1] - second[0].T * first[1])[0]


begin = [(u, -(A * u + B * w)) for u, w in (one, two)]
end = lambda R: [(w, B.T * u + C * w - R * (w - u)) for u, w in (one, two)]
prove("(2.12) a step without damping keeps the area, in R^2",
      expand(area(*end(zeros(2, 2))) - area(*begin)))
# after * (w, p+) = before * (u, p), so the determinant of the step is a quotient of two determinants.
after = Matrix.vstack(Matrix.hstack(B, zeros(2, 2)), Matrix.hstack(R - C, eye(2)))
before = Matrix.vstack(Matrix.hstack(-A, -eye(2)), Matrix.hstack(B.T + R, zeros(2, 2)))
prove("these are the changes", *(after * Matrix.vstack(*end(R)[0])
                                 - before * Matrix.vstack(*begin[0])).expand())
prove("(2.12) with damping its determinant is det(B' + rho) / det B",
      expand(after.det() - B.det()), expand(before.det() - (B.T + R).det()))
#< areas
D11, D12, D22 = (diff(lagrangian([m], [a], [b]), *w) for w in ((a, a), (a, b), (b, b)))
curve = V(kappa * a + (1 - kappa) * b, 2)
prove("D12 L_d = -(m/h + kappa (1 - kappa) h U'')",
      expand(D12 + m / h + kappa * (1 - kappa) * h * curve))
# Implicit differentiation of p = -D1 L_d(x, y), p+ = D2 L_d(x, y) - rho (y - x).
y_x, y_p = -D11 / D12, -1 / D12
q_x, q_p = D12 + rho + (D22 - rho) * y_x, (D22 - rho) * y_p
prove("(2.12) in one dimension, generic U",
      y_x * q_p - y_p * q_x - (1 - h * rho / (m + kappa * (1 - kappa) * h**2 * curve)))


# ---- linear maps of one step, U = c x^2 / 2 ----

def step_matrix(equations, old, new):
    """Return the matrix of the map old -> new that the linear equations define."""
    answer = solve(equations, new, dict=True)[0]
    return Matrix([[diff(answer[n], o) for o in old] for n in new])


x0, p0, x1, p1 = symbols("x0 p0 x1 p1")
S = kappa * x0 + (1 - kappa) * x1
lda = step_matrix([m * (x1 - x0) / h + kappa * h * c * S - p0,
                   m * (x1 - x0) / h - (1 - kappa) * h * c * S - rho * (x1 - x0) - p1],
                  (x0, p0), (x1, p1))
prove("(2.12), U = c x^2/2, kappa symbolic",
      together(lda.det() - (1 - h * rho / (m + kappa * (1 - kappa) * h**2 * c))),
      together(lda.subs(rho, 0).det() - 1))
midpoint = lda.subs({rho: 0, kappa: Rational(1, 2)})
metric = Matrix([[c, 0], [0, 1 / m]])                       # 2 E = z' metric z
prove("kappa = 1/2 conserves a quadratic energy",
      *(midpoint.T * metric * midpoint - metric))
# Three formulas for the flow of (x, p): by F^- and by F^+, each as (x_0, x_1) -> (x, p), and from step to step.
x2 = symbols("x2")
rows = lambda *forms: Matrix([[diff(f, z) for z in (x0, x1)] for f in forms])
minus, plus = m * (x1 - x0) / h + kappa * h * c * S, m * (x1 - x0) / h - (1 - kappa) * h * c * S
Fm, Fp = rows(x0, minus), rows(x1, plus)
later = minus.subs({x0: x1, x1: x2}, simultaneous=True)
shift = rows(x1, solve(plus - later, x2)[0])
for form in (Fp * Fm.inv(), Fp * shift * Fp.inv(), Fm * shift * Fm.inv()):
    prove("three formulas for one flow", *(form - lda.subs(rho, 0)).applyfunc(ratsimp))

#> euler
explicit = step_matrix([x1 - x0 - h * p0 / m, p1 - p0 - h * (-c * x0 - rho * p0 / m)],
                       (x0, p0), (x1, p1))
implicit = step_matrix([x1 - x0 - h * p1 / m, p1 - p0 - h * (-c * x1 - rho * p1 / m)],
                       (x0, p0), (x1, p1))
prove("(2.13) explicit Euler", expand(explicit.det() - (1 - h * rho / m + h**2 * c / m)))
prove("(2.13) implicit Euler", implicit.det() * (1 + h * rho / m + h**2 * c / m) - 1)
grown = 1 + h**2 * c / m
for matrix, factor_of_energy in ((explicit, grown), (implicit, 1 / grown)):
    change = matrix.T * metric * matrix - factor_of_energy * metric
    prove("(2.13) rho = 0: what a step does to the energy",
          *change.subs(rho, 0))
#< euler

# ---- order: insert a smooth solution into the equations ----

#> order
X = Function("X")
u1, u2 = diff(X(t), t), diff(X(t), t, 2)
path = lambda s, n: sum(diff(X(t), t, i) * s**i / (1, 1, 2, 6, 24)[i] for i in range(n + 1))


def grad_at(dx):
    """Return grad U(X + dx) to second order in dx."""
    g0, g1, g2 = (V(X(t), n) for n in (1, 2, 3))
    return g0 + g1 * dx + g2 * dx**2 / 2


S_next = (1 - kappa) * (path(h, 3) - X(t))          # S^kappa x_k - x_k
S_last = kappa * (path(-h, 3) - X(t))               # S^kappa x_{k-1} - x_k
residual = (m * (path(h, 4) - 2 * X(t) + path(-h, 4)) / h**2 + kappa * grad_at(S_next)
            + (1 - kappa) * grad_at(S_last))
start = m * (path(h, 3) - X(t)) / h + kappa * h * grad_at(S_next)
for power, want in ((0, m * u2 + V(X(t), 1)), (1, 0)):
    prove("(2.14) the recurrence: nothing at order h, any kappa, any U",
          expand(residual).coeff(h, power) - want)
newton = expand(start).subs(u2, -V(X(t), 1) / m)
for power, want in ((0, m * u1), (1, (kappa - Rational(1, 2)) * V(X(t), 1))):
    prove("(2.14) the start: (kappa - 1/2) h U'", newton.coeff(h, power) - want)
#< order

# cn and sn solve the equations of the tests: their derivatives are polynomials in
# (s, c, d) = (sn, cn, dn), with s^2 + c^2 = 1 and d^2 = 1 - k^2 s^2.
s_, c_, d_, k, w, G = symbols("s c d k omega g", positive=True)
along = lambda e: w * (diff(e, s_) * c_ * d_ - diff(e, c_) * s_ * d_ - diff(e, d_) * k**2 * s_ * c_)
circle = lambda e: expand(expand(e).subs(d_**2, 1 - k**2 * s_**2).subs(s_**2, 1 - c_**2))
accel = along(along(a * c_))
prove("Duffing: x = A cn(omega t + phase), omega^2 = c + g A^2, k^2 = g A^2 / (2 omega^2)",
      circle(accel + (w**2 - G * a**2) * a * c_ + G * a**3 * c_**3).subs(G, 2 * w**2 * k**2 / a**2))
# sin(x/2) = k sn, cos(x/2) = dn, x' = 2 omega k cn; sin x = 2 k s d.
prove("pendulum: sin(x/2) = k sn(omega t + phase), omega^2 = g",
      expand(along(2 * w * k * c_) + w**2 * 2 * k * s_ * d_),
      expand(along(k * s_) - d_ * (2 * w * k * c_) / 2))

# ---- potentials: a formula for U, and sympy's derivatives ----

Z, GC = symbols("z0:3"), symbols("C G")
spring = lambda r: GC[0] * r**2 / 2 + GC[1] * r**4 / 4
stretches = lambda z: [q - p for p, q in zip([0, *z], [*z, 0])]
FORMULA = {
    "HARMONIC": lambda z: sum(GC[0] * v**2 / 2 for v in z),
    "DUFFING": lambda z: sum(spring(v) for v in z),
    "CHAIN": lambda z: sum(spring(r) for r in stretches(z)),
    "PENDULUM": lambda z: sum(GC[0] * (1 - cos(v)) for v in z),
}
POINTS = [(1, (Rational(-3, 2),)), (2, (Rational(5, 4), Rational(-1, 2))),
          (3, (Rational(1, 2), Rational(-7, 4), Rational(3, 8)))]
SWINGS = [(1, (Rational(1, 2**30),)), (3, (Rational(1, 2), Rational(-11, 4), Rational(3, 8)))]


def number(e):
    return hexd(e) if e.is_Rational else hexd_real(lambda n: e.evalf(n + 20))


def derivatives(kind, d, cg, point):
    z = Z[:d]
    u = FORMULA[kind](z)
    at = lambda e: number(e.subs(dict(zip(z, point))).subs(dict(zip(GC, cg))))
    grad = [at(diff(u, p)) for p in z]
    hess = [at(diff(u, p, q)) for p in z for q in z]
    braces = lambda v: "{ " + ", ".join(v) + " }"
    return [kind, d, braces(map(hexd, cg)), braces(map(hexd, point)), at(u), braces(grad),
            braces(hess)]


header("verify/discrete_mechanics/discrete_mechanics.py")
print("\n/* U, its gradient and its Hessian: exact, but for the pendulum's, rounded. */")
table("ref_potentials", "int kind; size_t d; double cg[2], x[3], value, gradient[3], hessian[9];",
      [derivatives(kind, d, (Rational(3, 4), Rational(5, 2)), point)
       for kind in FORMULA for d, point in (POINTS if kind != "PENDULUM" else SWINGS)])

rows = []
for kind, cg in (("HARMONIC", (3, 0)), ("DUFFING", (2, Rational(1, 2))), ("CHAIN", (1, 2))):
    for K in (0, Rational(1, 4), Rational(1, 2), 1):
        step, masses = Rational(1, 4), (1, Rational(3, 2))
        begin_, end_ = (Rational(1, 2), Rational(-1, 4)), (Rational(3, 4), Rational(1, 8))
        free = [symbols("A0:2"), symbols("B0:2")]
        mean = [K * p + (1 - K) * q for p, q in zip(*free)]
        L = sum(w_ * ((q - p) / step)**2 / 2 for w_, p, q in zip(masses, *free)) * step \
            - step * FORMULA[kind](mean).subs(dict(zip(GC, cg)))
        values = {**dict(zip(free[0], begin_)), **dict(zip(free[1], end_))}
        D = [[hexd(diff(L, z).subs(values)) for z in part] for part in free]
        rows.append([kind, hexd(K), "{ " + ", ".join(map(hexd, cg)) + " }", hexd(L.subs(values)),
                     *("{ " + ", ".join(part) + " }" for part in D)])
print("\n/* (2.5): h = 1/4, m = (1, 3/2), from (1/2, -1/4) to (3/4, 1/8). Exact. */")
table("ref_lagrangian", "int kind; double kappa, cg[2], L, D1[2], D2[2];", rows)
