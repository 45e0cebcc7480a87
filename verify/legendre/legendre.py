"""H 8. Proved with symbols (alpha, kappa, kappa~, m, rho, h, the sequences and the potential are all open; N = 4):
  (8.3)   the Legendre transformation of the definition, read as a vector, gives
          (8.1), (8.2), and momentum matching is the recurrence, for x and for y;
          as printed it is one number, and its first operand lacks a term;
  (8.5)   statement 2 of the proposition, kappa = 0;
  (8.6)   statement 3, alpha = 1/2, and its determinant 1 - h rho / m, generic U;
  (8.7)   kappa~ changes the start and the momenta, but not the recurrence;
  (8.8), (8.9)  three momenta on a smooth path, and the mass m - rho h / 2.
Reference values: (8.1), (8.2) in exact rationals, with U's gradient from sympy. The errors of the three momenta on
the paper's problem, for h and rho that are doubles: the three-term equation against the exact solution in 40 and 55
digits."""
from functools import cache

import mpmath
from sympy import Function, Matrix, Rational, cos, diff, exp, expand, sin, symbols

from shared.refgen import claim, header, hexd, prove, table

h, m, rho, kappa, alpha, tilde = symbols("h m rho kappa alpha kappa~", positive=True)
half = Rational(1, 2)


class V(Function):
    """The derivative of U whose order is the last argument. U is any function."""
    def fdiff(self, argindex=1):
        return V(self.args[0], self.args[1] + 1)


U, g = (lambda z: V(z, 0)), (lambda z: V(z, 1))


def weight(order, n):
    w = order * 0 + 1
    for j in range(1, n + 1):
        w = w * (j - 1 - order) / j
    return w


N = 4
x, y = symbols("x0:5"), symbols("y0:5")
a, b = symbols("a b")
Ld = m * (b - a)**2 / (2 * h) - h * U(kappa * a + (1 - kappa) * b)
L = lambda p, q: Ld.subs({a: p, b: q}, simultaneous=True)
D1 = lambda p, q: diff(Ld, a).subs({a: p, b: q}, simultaneous=True)
D2 = lambda p, q: diff(Ld, b).subs({a: p, b: q}, simultaneous=True)


def minus_op(z, order=alpha):
    """Return Delta_-^order of a whole sequence."""
    return [h**-order * sum(weight(order, n) * z[k - n] for n in range(k + 1))
            for k in range(len(z))]


def plus_op(z, order=alpha):
    return [h**-order * sum(weight(order, n) * z[k + n] for n in range(len(z) - k))
            for k in range(len(z))]


xx, yy = minus_op(minus_op(x)), plus_op(plus_op(y))     # two derivatives of order alpha

# The Lagrangian of a step in which the intermediate variables u = Delta_-^alpha x and w = Delta_+^alpha y are
# variables of their own. The proposition has kappa~ = 0.
u, w = symbols("u0:5"), symbols("w0:5")


def intermediate(k):
    return (L(x[k], x[k + 1]) + L(y[k], y[k + 1])
            - tilde * h * u[k] * rho * w[k] - (1 - tilde) * h * u[k + 1] * rho * w[k + 1])


insert = lambda e: expand(e.subs(dict(zip(u, minus_op(x)))).subs(dict(zip(w, plus_op(y)))))
# D_{x^alpha} and D_{y^alpha} as sequences. `share` is kappa~ at the beginning of a step and 1 - kappa~ at its end.
slope_u = cache(lambda share: [insert(-share * h * rho * w[k]) for k in range(N + 1)])
slope_w = cache(lambda share: [insert(-share * h * rho * u[k]) for k in range(N + 1)])
for k in range(N):
    for share, j in ((tilde, k), (1 - tilde, k + 1)):
        prove("these are the slopes in the intermediate variables",
              insert(diff(intermediate(k), u[j])) - slope_u(share)[j],
              insert(diff(intermediate(k), w[j])) - slope_w(share)[j])


#> definition
def transform(k, end):
    """Return (p_x, p_y) at the node k: p^- at the beginning of step k, or with `end` p^+ at the end of step k - 1.
    The operators stand on the diagonal."""
    share, sign, step = (1 - tilde, 1, k - 1) if end else (tilde, -1, k)
    value = intermediate(step)
    nearby = Matrix([insert(diff(value, x[k])), insert(diff(value, y[k]))])
    swapped = slope_w(share), slope_u(share)
    memory = Matrix([minus_op(swapped[0])[k], plus_op(swapped[1])[k]])
    return sign * (nearby + memory)


for k in range(1, N):
    begin, end = transform(k, False), transform(k, True)
    prove("p^- is -D1 L_d and the share kappa~ of the damping",
          expand(begin[0] + D1(x[k], x[k + 1]) - tilde * h * rho * xx[k]),
          expand(begin[1] + D1(y[k], y[k + 1]) - tilde * h * rho * yy[k]))
    prove("p^+ is D2 L_d and the rest of it",
          expand(end[0] - D2(x[k - 1], x[k]) + (1 - tilde) * h * rho * xx[k]),
          expand(end[1] - D2(y[k - 1], y[k]) + (1 - tilde) * h * rho * yy[k]))
    of_x = D1(x[k], x[k + 1]) + D2(x[k - 1], x[k]) - h * rho * xx[k]
    of_y = D1(y[k], y[k + 1]) + D2(y[k - 1], y[k]) - h * rho * yy[k]
    prove("(8.3) matching is the recurrence, for every kappa~",
          expand(end[0] - begin[0] - of_x), expand(end[1] - begin[1] - of_y))
#< definition

#> printed
# As printed, the operators stand in a row: 1 x 2 times 2 x 2 times 2 x 1.
Dm, Dp, su, sw = symbols("Dm Dp s_u s_w", commutative=False)
swap = Matrix([[0, 1], [1, 0]])
row = Matrix([[Dm, Dp]]) * swap * Matrix([su, sw])
claim("the printed product is one number",
      row.shape == (1, 1) and row[0] == Dm * sw + Dp * su)
prove("the operators on the diagonal give the two numbers that are needed",
      *(Matrix([[Dm, 0], [0, Dp]]) * swap * Matrix([su, sw]) - Matrix([Dm * sw, Dp * su])))
# For kappa~ = 0 no step ends at the node 0, so no step has D_{y_0^alpha} as a slope. Without this slope the sum lacks
# its last term, unless x_0 = 0.
for k in range(1, N):
    slopes = slope_w(1)
    without = minus_op([0] + slopes[1:])[k]
    lacking = -rho * h**(1 - 2 * alpha) * weight(alpha, k) * x[0]
    prove("what the missing slope is worth", expand(minus_op(slopes)[k] - without - lacking))
#< printed
# (8.5): kappa = 0. The slopes p^alpha_y = -h rho Delta_-^alpha x are momenta.
zero = lambda e: expand(e).subs(kappa, 0)
for k in range(N - 1):
    p, q = zero(-D1(x[k], x[k + 1])), zero(D2(x[k], x[k + 1]) - h * rho * xx[k + 1])
    p_alpha = [-h * rho * v for v in minus_op(x)]
    prove("(8.5) x_{k+1} = x_k + h p_k / m", expand(x[k] + h * p / m - x[k + 1]))
    prove("(8.5) p_{k+1}", expand(p - h * g(x[k + 1]) + minus_op(p_alpha)[k + 1] - q))

#> half
# (8.6): alpha = 1/2. h Delta Delta x is x_{k+1} - x_k (H 7), and this difference is h p / m.
for k in range(1, N + 1):
    prove("alpha = 1/2", expand(h * xx[k].subs(alpha, half) - (x[k] - x[k - 1])))
X, P = symbols("X P")
X1 = X + h * P / m
P1 = P - h * g(X1) - h * rho / m * P
prove("(8.6) p_{k+1} is F^+ with kappa = 0",
      expand(zero(D2(X, X1) - rho * (X1 - X)) - P1))
determinant = Matrix([X1, P1]).jacobian([X, P]).det()
prove("(8.6) areas shrink by 1 - h rho / m, any U", expand(determinant - (1 - h * rho / m)))
#< half

# (8.7): the start.
prove("(8.7) kappa~ and the start", expand(transform(0, False)[0] + D1(x[0], x[1])
                                           - tilde * rho * h**(1 - 2 * alpha) * x[0]))

# ---- three momenta on a smooth path, alpha = 1/2 ----

#> momenta
t = symbols("t")
Z = Function("Z")(t)
v, acc = diff(Z, t), diff(Z, t, 2)
ahead = lambda s: Z + s * v + s**2 * acc / 2 + s**3 * diff(Z, t, 3) / 6
force = lambda dz: g(Z) + V(Z, 2) * dz          # grad U(Z + dz), to first order
first = lambda e: expand(e).coeff(h, 1)
at_zero = lambda e: expand(e).coeff(h, 0)

recurrence = (m * (ahead(h) - 2 * Z + ahead(-h)) / h**2
              + kappa * force((1 - kappa) * h * v) + (1 - kappa) * force(-kappa * h * v)
              + rho * (Z - ahead(-h)) / h)
prove("(8.9) m x'' + U' + rho x' at order 0",
      at_zero(recurrence) - (m * acc + g(Z) + rho * v))
prove("(8.9) less rho h / 2 x'' at order 1, any kappa, any U",
      first(recurrence) + rho / 2 * acc)

on_path = lambda e: e.subs(acc, (-g(Z) - rho * v) / m)      # m x'' + O(h)
matched = m * (ahead(h) - Z) / h + kappa * h * g(Z)
raw = m * (Z - ahead(-h)) / h - (1 - kappa) * h * g(Z)
quotient = m * (Z - ahead(-h)) / h
for name, p, want in (
        ("matched", matched, -rho / 2 * v + (kappa - half) * g(Z)),
        ("without damping", raw, rho / 2 * v + (kappa - half) * g(Z)),
        ("difference quotient", quotient, rho / 2 * v + half * g(Z))):
    prove(f"(8.8) {name}: m x' at order 0", at_zero(p) - m * v)
    prove(f"(8.8) {name}: the order 1", expand(on_path(first(p)) - want))
#< momenta

# How a wrong mass, or kappa~ = 1, changes U = c x^2 / 2 in the limit, in closed form.
p0, x0, mass, omega = symbols("p0 x0 M omega", positive=True)
gamma_ = rho / (2 * mass)
c = mass * (omega**2 + gamma_**2)
solution = exp(-gamma_ * t) * (x0 * cos(omega * t) + (p0 / mass + gamma_ * x0) / omega
                               * sin(omega * t))
prove("the damped oscillator of the tests",
      expand(mass * diff(solution, t, 2) + c * solution + rho * diff(solution, t)),
      solution.subs(t, 0) - x0, expand(mass * diff(solution, t).subs(t, 0) - p0))

# ---- exact values of (8.1) and (8.2) ----

header("verify/legendre/legendre.py")
A, B = symbols("A0:2"), symbols("B0:2")
spring = lambda r, cg: cg[0] * r**2 / 2 + cg[1] * r**4 / 4
SYSTEMS = [("DUFFING", (2, half), lambda z, cg: sum(spring(r, cg) for r in z)),
           ("CHAIN", (1, 2), lambda z, cg: spring(z[0], cg) + spring(z[1] - z[0], cg)
            + spring(z[1], cg))]
step, masses, damping = Rational(1, 4), (1, 3 * half), (half, Rational(3, 4))
ends = {A[0]: half, A[1]: -step, B[0]: 3 * step, B[1]: Rational(1, 8)}
memory, push = (Rational(5, 4), -half), (Rational(-3, 8), 2)
rows = []
for kind, cg, potential in SYSTEMS:
    for K in (0, step, half, 1):
        S = [K * p + (1 - K) * q for p, q in zip(A, B)]
        action = sum(M * (q - p)**2 for M, p, q in zip(masses, A, B)) / (2 * step) \
            - step * potential(S, cg)
        at = lambda e: e.subs(ends)
        begin = [at(-diff(action, z)) for z in A]
        end = [at(diff(action, z)) for z in B]
        damped = [e - step * r * D for e, r, D in zip(end, damping, memory)]
        forced = [e + step * f for e, f in zip(end, push)]
        both = [e + step * f for e, f in zip(damped, push)]
        braces = lambda v: "{ " + ", ".join(map(hexd, v)) + " }"
        rows.append([kind, hexd(K), *map(braces, (cg, begin, end, damped, forced, both))])
print("\n/* h = 1/4, m = (1, 3/2), rho = (1/2, 3/4), from (1/2, -1/4) to (3/4, 1/8),")
print(" * D = (5/4, -1/2), F = (-3/8, 2): F^-, then F^+ without, with D, with F, with both. */")
table("ref_momenta", "int kind; double kappa, cg[2], minus[2], plus[2], damped[2], forced[2], "
      "both[2];", rows)


# ---- the errors of the three momenta: m = c = 1, x_0 = 1, p_0 = 1/2, kappa = 1/2 ----

def momentum_errors(step):
    """Return the largest errors for t <= 15 of p and of p^2/2 + x^2/2 for three momenta: matched, without damping,
    difference quotient. The positions come from the printed recurrence."""
    hh, r = mpmath.mpf(step), mpmath.mpf(0.2)
    worst = [mpmath.mpf(0)] * 6
    wave = mpmath.sqrt(1 - r**2 / 4)
    last, now = mpmath.mpf(1), (mpmath.mpf(1) / 2 + 1 / hh - hh / 4) / (1 / hh + hh / 4)
    slope, first = (mpmath.mpf(1) / 2 + r / 2) / wave, 1 / hh**2 + mpmath.mpf(1) / 4
    turn, at = mpmath.exp(mpmath.mpc(-r / 2, wave) * hh), mpmath.mpc(1)
    for _ in range(round(15 / step)):
        at *= turn                                     # e^(-rt/2) (cos wave t + i sin wave t)
        z = at.real + slope * at.imag
        v = slope * wave * at.real - wave * at.imag - r / 2 * z
        rate, rest = (now - last) / hh, now * now - v * v - z * z
        end = rate - hh / 4 * (now + last)                                  # D2 L_d
        for i, p in enumerate((end - r * (now - last), end, rate)):
            worst[i] = max(worst[i], abs(p - v))
            worst[3 + i] = max(worst[3 + i], abs(p * p + rest) / 2)
        last, now = now, ((2 * now - last) / hh**2 - now / 2 - last / 4 - r * rate) / first
    return worst


steps = [0.1, 0.05, 0.025, 0.0125, 0.00625]
measured = {}
for digits in (40, 55):
    mpmath.mp.dps = digits
    measured[digits] = [momentum_errors(v) for v in steps]
literal = lambda i, j: hexd(Rational(mpmath.nstr(measured[55][i][j], 30)))
rows = [[hexd(v), *("{ " + ", ".join(literal(i, j) for j in part) + " }"
                    for part in (range(3), range(3, 6)))] for i, v in enumerate(steps)]
claim("40 digits are enough", all(abs(a_ / b_ - 1) < mpmath.mpf(10)**-28 for one, two in
                                  zip(*measured.values()) for a_, b_ in zip(one, two)))
print("\n/* Errors on the paper's problem: matched, without damping, difference quotient. */")
table("ref_errors", "double h, p[3], E[3];", rows)
logs = [mpmath.log(v) for v in steps]
mean = sum(logs) / len(logs)
fit = lambda j: sum((v - mean) * mpmath.log(e[j]) for v, e in zip(logs, measured[55])) \
    / sum((v - mean)**2 for v in logs)
slopes = [fit(j) for j in range(6)]
claim("the slopes that the chapter quotes", [mpmath.nstr(v, 3) for v in slopes]
      == ["0.94", "0.941", "1.0", "0.964", "1.02", "0.949"])
table("ref_slopes", "double p, E;", [[hexd(Rational(mpmath.nstr(slopes[j], 30))),
                                      hexd(Rational(mpmath.nstr(slopes[3 + j], 30))),
                                      f"{mpmath.nstr(slopes[j], 5)}, {mpmath.nstr(slopes[3 + j], 5)}"]
                                     for j in range(3)])
