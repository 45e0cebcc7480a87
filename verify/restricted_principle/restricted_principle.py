"""H 3. The restricted Hamilton's principle in continuous time.

Proved here, d = 1 unless stated otherwise (the proofs for all curves are in
the chapter; these are instances, each with alpha symbolic):
  (3.6)  and (3.21), the first variation after integration by parts, for cubic curves
         and references with symbolic coefficients, U cubic, along three bumps;
  (3.7)  restricted and unrestricted equations: the variation of every quadratic
         Lagrangian without (D_- x)^2 and (D_+ y)^2, quadratic curves, two bumps;
  (3.9)  the series solves the equation, term against term, all symbolic;
  (3.10) pairs that are stationary but solve neither equation, exactly;
  (3.11) the change of variables, d = 2, symbolic; a constant under Riemann-Liouville;
  (3.12) D_+ J = J D_-, a change of variables in the integral, generic x;
  (3.22) the derivative of x - zeta, on powers; (3.23) its boundary terms, cubic
         curves; (3.24) the bracket at the start if a constant is left in x - zeta;
  (3.14) to (3.17) Legendre, Hamiltonian, Hamilton's equations, the mirror of the
         momenta, and the printed forms that fail;
  (3.19) the flow at alpha = 1/2: the pulled back two-form in closed form, Bateman's
         form preserved, symbolically.
The power rule (1.6), integration by parts (1.7) for all powers and the sum of two
orders (1.9) are proved in verify/fractional_derivative/fractional_derivative.py.
Printed: exact values of powers, of the action (by Beta functions), of the series
(by an inverse Laplace transform), and of the pulled back form."""
import mpmath
from sympy import (Function, Integer, Matrix, Poly, Rational, Symbol, cos,
                   diff, exp, expand, eye, gamma, gammasimp, hessian, integrate,
                   limit, oo, sin, solve, sqrt, symbols, zeros)

from shared.refgen import array, claim, header, hexd, hexd_real, prove, table
from shared.restricted_principle_powers import (CUBE, DAMPING, MASS, SPRING, D, a, action, ddt, first_variation,
                                                integral, plus, power, powered, real, sizes)

t, e = symbols("t e", positive=True)
m, rho, c = symbols("m rho c", positive=True)

half = Rational(1, 2)
prove("(3.13) and d/ds at alpha = 1/2", gammasimp(power(half, e) * power(half, e - half)) - e)
prove("no chain rule: D^(1/2) t^2 is 2/3 of 2 t D^(1/2) t",
      power(half, Integer(2)) - Rational(2, 3) * 2 * power(half, Integer(1)))

# ---- (3.6): the whole first variation, polynomials with symbolic coefficients ----
#> variation
A, B = symbols("A0:4"), symbols("B0:4")  # x = sum A_i t^i, y = sum B_i (1-t)^i
z0, zv, b0, bw = symbols("zeta_0 zeta_1 bar_0 bar_1")  # zeta = z0 + zv t, bar = b0 + bw (1-t)
s = Symbol("s")


def U(z):
    return c * z ** 2 / 2 + z ** 3 / 3


def polynomial(z):
    """Return {exponent: coefficient} of a polynomial in s."""
    return {Integer(p): v for (p,), v in Poly(z, s).terms()}


def mechanical(z, eta):
    """Return the integrand m z' eta' - U'(z) eta, with z and eta from the same end."""
    return (m * diff(z, s) * diff(eta, s) - diff(U(s), s).subs(s, z) * eta).expand()


x, y = (sum(C[i] * s ** i for i in range(4)) for C in (A, B))
X, Y = polynomial(x - z0 - zv * s), polynomial(y - b0 - bw * s)  # the arguments of the coupling
one = {Integer(0): 1}
for p, q in ((1, 1), (2, 1), (2, 3)):
    eta = expand(s ** p * (1 - s) ** q)  # the variation in t; below, in 1 - t
    other = expand(eta.subs(s, 1 - s))
    E_, O_ = map(polynomial, (eta, other))
    xi_part = (integral(polynomial(mechanical(x, eta)), one) - rho * integral(D(E_), D(Y)))
    eta_part = (integral(polynomial(mechanical(y, other)), one) - rho * integral(D(X), D(O_)))
    equation_a = polynomial(expand((-m * diff(x, s, 2) - diff(U(s), s).subs(s, x)) * eta))
    equation_b = polynomial(expand((-m * diff(y, s, 2) - diff(U(s), s).subs(s, y)) * other))
    difference = [
        xi_part - integral(equation_a, one) + rho * integral(E_, D(Y, 2)),
        eta_part - integral(equation_b, one) + rho * integral(D(X, 2), O_)]
    for d in difference:
        for coefficient in Poly(d, *A, *B, z0, zv, b0, bw, m, rho, c).coeffs():
            prove(f"(3.6), (3.21) along t^{p} (1-t)^{q}", gammasimp(coefficient))
#< variation

# ---- (3.22), (3.23): the past as a datum ---------------------------------------------
#> references
prove("(3.22) s, the part of a velocity that the reference does not have", gammasimp(
    power(a, Integer(1)) * power(a, 1 - a) - 1 / gamma(2 - 2 * a)))
prove("(3.22) s^e: Caputo's derivative of order 2 alpha, I^(2-2 alpha) of the second derivative",
      gammasimp(power(a, e) * power(a, e - a) - e * (e - 1) * power(2 * a - 2, e - 2)))
# (3.23): delta = sum E_j (1-t)^j need not vanish at the end; the reference of y moves with delta(1).
E = symbols("E0:4")
bump = {Integer(i): E[i] for i in range(4)}
moved = {i: v for i, v in bump.items() if i > 0}
f = {Integer(i): A[i] for i in range(1, 4)}  # x - zeta
dressed = {p + 1 - a: v * power(a - 1, p) for p, v in D(f).items()}  # I^(1-alpha) D f
claim("(3.23) its powers are positive for alpha < 1: it vanishes at t = 0",
      all(p.subs(a, 0) > 0 and p.subs(a, 1) >= 0 for p in dressed))
boundary = sum(dressed.values()) * E[0]  # times delta at t = 1
coupling = integral(D(f), D(moved)) - integral(D(f, 2), bump) + boundary
for coefficient in Poly(coupling, *A, *E).coeffs():
    prove("(3.23) the boundary term of the coupling", gammasimp(coefficient))
kick = {p + 1 - a: v * power(a - 1, p) for p, v in D(one).items()}
prove("(3.24) with a constant left in f, it is s^(1-2 alpha)/Gamma(2-2 alpha) of it",
      gammasimp(kick[1 - 2 * a] - 1 / gamma(2 - 2 * a)))
#< references

# ---- (3.7), (3.8): every quadratic Lagrangian of the six arguments --------------------
#> equations
# A function is a pair: a sum of powers of t, and one of powers of 1 - t.
def flip(z):
    """Return a polynomial in t as a polynomial in 1 - t, and vice versa."""
    return polynomial(expand(sum(v * (1 - s) ** p for p, v in z.items())))


def inner(f, bump):
    """Return int f bump dt. The bump is a polynomial, given from both ends."""
    return integral(f[0], bump[1]) + integral(bump[0], f[1])


xs = {Integer(i): A[i] for i in (1, 2)}  # x(0) = 0
ys = {Integer(i): B[i] for i in (1, 2)}  # y(1) = 0
slots = [(xs, {}), ({}, ys), (ddt(xs), {}), ({}, ddt(ys, -1)), (D(xs), {}), ({}, D(ys))]
# L = q.Q q / 2, q = (x, y, x', y', X, Y), X = D_- x, Y = D_+ y. Without X^2 and Y^2 the partial derivative by Y is a
# sum of powers of t, so the power rule gives its D_-. The same holds for the derivative by X.
Q = Matrix(6, 6, lambda i, j: 0 if i == j > 3 else Symbol(f"q{min(i, j)}{max(i, j)}"))
partial = [[plus(*((Q[i, j], slots[j][end]) for j in range(6))) for end in (0, 1)]
           for i in range(6)]
by_X = plus((1, flip(plus(*((Q[4, j], slots[j][0]) for j in range(4))))), (1, partial[4][1]))
by_Y = plus((1, partial[5][0]), (1, flip(plus(*((Q[5, j], slots[j][1]) for j in range(4))))))
for p, q in ((1, 1), (1, 2)):
    dt = polynomial(expand(s ** p * (1 - s) ** q))
    bump, slope = (dt, flip(dt)), (ddt(dt), ddt(flip(dt), -1))
    dS = (inner(partial[0], bump) + inner(partial[1], bump)  # delta is the variation of both curves
          + inner(partial[2], slope) + inner(partial[3], slope)
          + integral(D(dt), by_X) + integral(by_Y, D(flip(dt))))
    left_sides = [inner((ddt(partial[i + 2][0]), ddt(partial[i + 2][1], -1)), bump)
                  - inner(partial[i], bump) - inner(fractional, bump)
                  for i, fractional in enumerate([(D(by_Y), {}), ({}, D(by_X))])]
    for coefficient in Poly(dS + sum(left_sides), *Q.free_symbols, *A, *B).coeffs():
        prove(f"(3.7) along t^{p} (1-t)^{q}: minus the sum of both left sides",
              gammasimp(coefficient))
#< equations

# ---- (3.9): the series --------------------------------------------------------------
#> series
j, k = symbols("j k", integer=True, positive=True)
C, R = symbols("C R")


def term(j, k):
    """Return the coefficient of t^(1 + 2 j + (2 - 2 alpha) k)."""
    return ((-1) ** (j + k) * gamma(j + k + 1) / gamma(j + 1) / gamma(k + 1) * C ** j * R ** k
            / gamma(2 + 2 * j + (2 - 2 * a) * k))


def acceleration(j, k):
    """Return the coefficients of the power of t lower by two in x'', C x and R D^(2 alpha) x."""
    top = 1 + 2 * j + (2 - 2 * a) * k
    return (top * (top - 1) * term(j, k) + C * term(j - 1, k)
            + R * term(j, k - 1) * power(2 * a, top - (2 - 2 * a)))


prove("(3.9), j and k at least 1", gammasimp(acceleration(j, k) / term(j, k)))
for n in range(1, 5):
    prove("(3.9), k = 0", gammasimp((2 * n + 1) * 2 * n * term(n, 0) + C * term(n - 1, 0)))
    top = 1 + (2 - 2 * a) * n
    prove("(3.9), j = 0", gammasimp(
        top * (top - 1) * term(0, n) + R * term(0, n - 1) * power(2 * a, top - (2 - 2 * a))))
#< series

# ---- (3.10): sufficient, not necessary ------------------------------------------------
#> stationary
# alpha = 1/2 on [0, 1], U = 0: x = t, y = -(1 - t), m = 1. The powers are those of (3.2).
def at_half(z):
    return {p.subs(a, half): v.subs(a, half) for p, v in z.items()}


t_, y_end = {Integer(1): Integer(1)}, {Integer(1): Integer(-1)}
prove("D_- D_- x = 1 and D_+ D_+ y = -1", at_half(D(t_, 2))[0] - 1, at_half(D(y_end, 2))[0] + 1)
for p, q in ((1, 1), (2, 1), (1, 3)):
    eta = expand(s ** p * (1 - s) ** q)
    E_, O_ = polynomial(eta), polynomial(expand(eta.subs(s, 1 - s)))
    x_alone = integral(ddt(E_), one) - rho * integral(at_half(D(E_)), at_half(D(y_end)))
    y_alone = integral(ddt(O_), {Integer(0): Integer(-1)}) - rho * integral(
        at_half(D(t_)), at_half(D(O_)))
    prove(f"along t^{p} (1-t)^{q}: + rho and - rho times the integral of the bump",
          gammasimp(x_alone - rho * integral(E_, one)),
          gammasimp(y_alone + rho * integral(E_, one)))
# With a spring: u = x + y and w = x - y. A u with one condition gives a w with x(0) = 0 and y(1) = 0.
u = t * (1 - t) * (1 - 2 * t)
w_ = -(diff(u, t) - diff(u, t).subs(t, 0) + c * integrate(expand(u), t)) / rho
xx, yy = (u + w_) / 2, (u - w_) / 2
prove("the pair begins and ends at 0", xx.subs(t, 0), expand(yy.subs(t, 1)))
res = diff(xx, t, 2) + c * xx + rho * diff(xx, t), diff(yy, t, 2) + c * yy - rho * diff(yy, t)
prove("the pair is stationary, m = 1", expand(sum(res)))
claim("that solves neither equation", expand(res[0]) != 0)
#< stationary

# ---- (3.11): changes of variables -------------------------------------------------------
#> invariance
# sympy differentiates the Lagrangian of (z, w, z', D_- z, D_+ w), d = 2, U any function.
Lam = Matrix(2, 2, symbols("l00 l01 l10 l11"))
M_, R_ = (Matrix.diag(*symbols(f"{n}0 {n}1")) for n in "mr")
pos, vel, dm, dp, old = (Matrix(symbols(f"{n}0 {n}1")) for n in ("z", "zd", "zD", "wD", "x"))
U2 = Function("U")
there = dict(zip(old, Lam * pos))
L2 = ((Lam * vel).dot(M_ * Lam * vel) / 2 - U2(*old).subs(there)
      - (Lam * dm).dot(R_ * Lam * dp))
force = Matrix([diff(U2(*old), z) for z in old]).subs(there)
prove("(3.11) momentum, force and damping are Lambda^T times the old ones",
      *(Matrix([diff(L2, z) for z in vel]) - Lam.T * M_ * Lam * vel).expand(),
      *(Matrix([diff(L2, z) for z in pos]) + Lam.T * force).doit().expand(),
      *(Matrix([diff(L2, z) for z in dp]) + Lam.T * R_ * Lam * dm).expand())
claim("and its damping matrix need not be diagonal", (Lam.T * R_ * Lam)[0, 1] != 0)
prove("Riemann-Liouville: D D 1 = s^(-2 alpha)/Gamma(1 - 2 alpha), so a shift of x is felt",
      gammasimp(D(one, 2)[-2 * a] - 1 / gamma(1 - 2 * a)))
#< invariance

# ---- (3.12): the mirror image ---------------------------------------------------------------
#> mirror
# D_+^a y(t) = -1/Gamma(1-a) d/dt int_t^b (tau-t)^(-a) y(tau) dtau with y = J x.
# tau = l - sigma (l = a + b): the kernel at (t, tau) becomes that of D_- at (l - t, sigma).
l, tau, sigma = symbols("l tau sigma")
xf = Function("x")
plus, minus = (tau - t) ** (-a) * xf(l - tau), (s - sigma) ** (-a) * xf(sigma)
prove("(3.12) kernels", plus.subs(tau, l - sigma) - minus.subs(s, l - t))
# limits: tau = t -> sigma = l - t, tau = b -> sigma = a; -d/dt = d/ds at s = l - t.
#< mirror
eps = Symbol("epsilon", positive=True)
claim("the kernel (tau - t)^(-2 alpha) is not integrable at alpha = 3/4",
      limit(integrate(tau ** Rational(-3, 2), (tau, eps, 1)), eps, 0) == oo)

# ---- the fractional tangent space ------------------------------------------------------------
#> tangent
# The curves D^(1/2) t^n, n = 1..6, divided by t^(1/2), are independent; more powers give more independent curves.
rows = [[power(half, Integer(n)) * Rational(i) ** (n - 1) for n in range(1, 7)]
        for i in range(1, 7)]
claim("six independent curves", Matrix(rows).rank() == 6)
prove("at t > 0 the curves t e_i give t^(1-alpha) / Gamma(2-alpha) e_i, all of R^d",
      power(a, Integer(1)) - 1 / gamma(2 - a))
claim("at t = 0 they give 0", limit(power(half, Integer(1)) * t ** half, t, 0) == 0)
#< tangent

# ---- Legendre, Hamilton ------------------------------------------------------------------------
#> legendre
Up = Function("U")
x_, y_, v, w, X, Y = symbols("x y v w X Y")  # X = D_- x, Y = D_+ y
px, py, pX, pY = symbols("p_x p_y p_X p_Y")
full = m * v ** 2 / 2 - Up(x_) + m * w ** 2 / 2 - Up(y_) - X * rho * Y
momenta = [diff(full, z) for z in (v, w, X, Y)]  # (m v, m w, -rho Y, -rho X)
back = solve([p - q for p, q in zip((px, py, pX, pY), momenta)], (v, w, X, Y))
H = (px * v + py * w + pX * X + pY * Y - full).subs(back)
prove("(3.15) the Hamiltonian", expand(
    H - px ** 2 / (2 * m) - Up(x_) - py ** 2 / (2 * m) - Up(y_) + pX * pY / rho))
prove("(3.14) regular iff rho is not 0",
      hessian(full, (v, w, X, Y)).det() + m ** 2 * rho ** 2)
prove("X = dH/dp_X and Y = dH/dp_Y", diff(H, pX) - back[X], diff(H, pY) - back[Y])
there = dict(zip((px, py, pX, pY), momenta))
prove("(3.16) is (3.7): dH/dx = -dL/dx, dH/dy = -dL/dy at the momenta of (3.14)",
      diff(H, x_).subs(there) + diff(full, x_), diff(H, y_).subs(there) + diff(full, y_))
#< legendre
#> hamilton
# The integrand p x' + ... - H, differentiated by p_y: it is y' - dH/dp_y.
integrand = px * v + py * w + pX * X + pY * Y - H
prove("delta p_y multiplies y' - dH/dp_y", diff(integrand, py) - (w - diff(H, py)))
claim("not y' - dH/dy as printed: at y = 1, U = y^2, p_y = 0, y' = 0 that is -2",
      (w - diff(H, y_)).subs(Up(y_), y_ ** 2).doit().subs({y_: 1, w: 0}) == -2
      and diff(integrand, py).subs({py: 0, w: 0}) == 0)
# The mirror image: p_X(t) = -rho D_+ y(t) = -rho D_- x(t~) = p_Y(t~). The paper prints p_x.
prove("p_Y(t) = p_X(a+b-t)", momenta[2].subs(Y, X) - momenta[3])
claim("p_x in its place: 1 against 0 for m = x' = 1, D_- x = 0",
      [z.subs({m: 1, v: 1, X: 0}) for z in (momenta[0], momenta[3])] == [1, 0])
#< hamilton

# ---- (3.18), (3.19): the two-form at alpha = 1/2 ------------------------------------------------
#> flow
G = symbols("gamma", positive=True)  # rho = 2 m gamma
omega = symbols("omega", positive=True)  # c = m (omega^2 + gamma^2)


def flow(g):
    """Return exp(t [[0, 1], [-c/m, -2 g]]), g = gamma for x and -gamma for y."""
    return exp(-g * t) * Matrix([
        [cos(omega * t) + g * sin(omega * t) / omega, sin(omega * t) / omega],
        [-(omega ** 2 + g ** 2) * sin(omega * t) / omega,
         cos(omega * t) - g * sin(omega * t) / omega]])


for g in (G, -G):
    generator = Matrix([[0, 1], [-(omega ** 2 + G ** 2), -2 * g]])
    prove("the flow solves its equation", *(flow(g).diff(t) - generator * flow(g)).expand())
    prove("and starts at the identity", *(flow(g).subs(t, 0) - eye(2)))
F = Matrix.diag(flow(G), flow(-G))  # on (x, x', y, y')


def form(**entries):
    """Return the antisymmetric matrix of a two-form on (x, v, y, w)."""
    J, at = zeros(4), "xvyw"
    for name, value in entries.items():
        p, q = (at.index(n) for n in name)
        J[p, q] += value
        J[q, p] -= value
    return J


printed = form(xv=m, xw=m)  # dx^dx' + dx^dy', times m
pullback = F.T * printed * F
prove("dx^dx' shrinks like exp(-rho t/m)", pullback[0, 1] - m * exp(-2 * G * t))
prove("dx^dy appears", pullback[0, 2] - m * flow(G)[0, 0] * flow(-G)[1, 0])
bateman = form(xw=m, yv=m, xy=-2 * m * G)
prove("(3.19) Bateman's form is preserved", *(F.T * bateman * F - bateman).expand().subs(
    cos(omega * t) ** 2, 1 - sin(omega * t) ** 2).expand())
#< flow
# The same without solving the equations: the derivative along the flow is (k_y - k_x) dx^dy.
kx, ky = symbols("k_x k_y")
gen = Matrix.diag(Matrix([[0, 1], [-kx / m, -rho / m]]), Matrix([[0, 1], [-ky / m, rho / m]]))
J = form(xw=m, yv=m, xy=-rho)
prove("(3.19) needs equal stiffness only",
      *(gen.T * J + J * gen - form(xy=kx - ky)).expand())

# ---- exact values ---------------------------------------------------------------------------------
header("verify/restricted_principle/restricted_principle.py")
Q = Rational


def nearest(value, digits=40):
    """Return value() as a double literal. It is computed at two precisions, and both must round to the same double."""
    def text(n):
        with mpmath.workdps(n + 15):
            return mpmath.nstr(value(), n)
    return hexd_real(text, digits, 10)


rows = []
for order in (Q(0), Q(1, 4), Q(0.3), Q(1, 2), Q(0.9), Q(1)):
    for exponent in (Q(0), Q(1), Q(1.4), Q(3), Q(7.25), Q(40)):
        for at in (Q(1, 8), Q(3)):
            rows.append([hexd(order), hexd(exponent), hexd(at), nearest(
                lambda: powered(order, exponent) * real(at) ** real(exponent - order))])
table("ref_derivative", "double beta, exponent, s, want;", rows)

CURVES = [  # x, y, xi, eta: three terms each
    [{0: Q(1, 2), 1: Q(-1), 3: Q(3, 4)}, {1: Q(2), 2: Q(-1, 2), 5: Q(1, 4)},
     {1: Q(1), 2: Q(-3, 2), 3: Q(1, 2)}, {0: Q(-1, 4), 1: Q(1), 4: Q(1, 8)}],
    [{1: Q(1), Q(3, 2): Q(-1, 2), Q(9, 4): Q(1, 4)}, {0: Q(-1, 4), 1: Q(1), Q(7, 4): Q(1, 2)},
     {0: Q(1), Q(5, 4): Q(-1), 2: Q(1, 2)}, {1: Q(1), 2: Q(-1, 2), Q(11, 4): Q(1)}]]
CURVES = [[{Q(p): v for p, v in z.items()} for z in group] for group in CURVES]
rows = []
for which, group in enumerate(CURVES):
    for alpha in (Q(0), Q(0.1), Q(1, 2), Q(0.6), Q(0.9)):
        for T in (Q(1), Q(5, 2)):
            big = [sizes(z) for z in group]
            rows.append([which, hexd(alpha), hexd(T),
                         nearest(lambda: action(alpha, T, *group[:2])),
                         nearest(lambda: first_variation(alpha, T, *group)),
                         f"{float(action(alpha, T, *big[:2], sign=1)):.3g}",
                         f"{float(first_variation(alpha, T, *big, sign=1)):.3g}"])
array("curve_exponents", [p for group in CURVES for z in group for p in z])
array("curve_coefficients", [v for group in CURVES for z in group for v in z.values()],
      "two groups of x, y, xi, eta, three terms each")
array("action_system", [MASS, DAMPING, SPRING, CUBE], "mass, damping, Duffing's c and g")
table("ref_action", "size_t group; double alpha, T, S, dS, size_S, size_dS;", rows)

# The series against its Laplace transform 1 / (p^2 + R p^(2 alpha) + C), inverted.
rows = []
for alpha in (Q(0.1), Q(1, 4), Q(1, 2), Q(3, 4), Q(0.9)):
    for C_, R_ in ((Q(1), Q(1, 4)), (Q(4), Q(1, 8))):
        for at in (Q(1, 2), Q(2)):
            rows.append([hexd(alpha), hexd(C_), hexd(R_), hexd(at), nearest(
                lambda: mpmath.invertlaplace(
                    lambda p: 1 / (p ** 2 + real(R_) * p ** real(2 * alpha) + real(C_)),
                    real(at), method="talbot", degree=2 * mpmath.mp.dps), 20)])
table("ref_series", "double alpha, C, R, t, want;", rows)

#> pullback
# (3.18) m = c = 1, rho = 1/5, t = 1: the pulled back dx^dx' + dx^dy'.
values = {m: 1, G: Q(1, 10), omega: sqrt(1 - Q(1, 100)), t: 1}
array("ref_pullback", [Q(str((F.T * printed * F)[p, q].subs(values).evalf(40)))
                     for p, q in ((0, 1), (0, 3), (0, 2), (1, 2), (1, 3))],
      "dx^dx', dx^dy', dx^dy, dx'^dy, dx'^dy': 1 1 0 0 0 if the form were preserved")
#< pullback
