"""H 6. The non-local discrete action and its restricted variation.

Proved here; sympy differentiates the action itself. These are instances: N = 4 and d = 1, unless stated otherwise;
the chapter has the proofs for all N and d. U is any function, the weights are any numbers, h, rho and kappa are
symbols.
  (6.3)  the ranges of the sums in Proposition 4.1, generic L^i, N = 5, and the
         coefficients of the end variations;
  (6.5)  the gradient of the damped action;
  (6.6)  also for d = 2, N = 2, U a general cubic and quartic polynomial;
  (6.7)  Theorem 4.1 with its end terms, for the four ranges of the fractional
         sum; the terms at alpha = 1/3 as rationals;
  (6.11) the same with given references, where no end term remains, four ranges;
  (6.8)  the mirror image with kappa -> 1 - kappa;
  (6.9)  the defect of the mirror image with the same kappa, and where it vanishes.
Printed: action and gradient for d = 1 and d = 2 from the symbolic derivatives: exact if the data are short binary
fractions, else rounded once."""
from fractions import Fraction
from itertools import product

import mpmath
from sympy import (QQ, Function, Rational, Symbol, binomial, diff, expand,
                   expand_func, factor, solve, symbols)
from sympy.polys.rings import PolyRing

from shared.refgen import array, claim, header, hexd, hexd_real, prove, table

N = 4
h, rho, kappa, m, g = symbols("h rho kappa m g")  # g stands for h^(-2 alpha)
w = symbols(f"w0:{N + 1}")  # the weights alpha_n, any numbers
x, y = symbols(f"x0:{N + 1}"), symbols(f"y0:{N + 1}")
s = Symbol("s")
U = Function("U")


def force(z):
    """Return U'(z), in the form in which sympy writes its own derivatives."""
    return diff(U(s), s).subs(s, z)


# ---- Proposition 4.1: which L^i contain x_k, and which contain y_k ----------
#> ranges
M = 5
X, Y = symbols(f"x0:{M + 1}"), symbols(f"y0:{M + 1}")
L = [Function(f"L{i}")(*X[:i + 2], *Y[i:]) for i in range(M)]
S = sum(L)
for k in range(1, M):
    prove(f"(6.3) restricted, N = {M}, k = {k}",
          diff(S, X[k]) + diff(S, Y[k])
          - sum(diff(L[i], X[k]) for i in range(k - 1, M))
          - sum(diff(L[i], Y[k]) for i in range(k + 1)))
#< ranges
prove("the coefficient of the variation at N",
      diff(S, X[M]) - diff(L[M - 1], X[M]), diff(S, Y[M]) - sum(diff(l, Y[M]) for l in L))
prove("the coefficient of the variation at 0",
      diff(S, X[0]) - sum(diff(l, X[0]) for l in L), diff(S, Y[0]) - diff(L[0], Y[0]))


# ---- the damped action --------------------------------------------------------
#> action
def step(p, q, U=U):
    """Return L_d(p, q)."""
    return m * (q - p) ** 2 / (2 * h) - h * U(kappa * p + (1 - kappa) * q)


def minus(z, k):
    """Return h^alpha Delta_- z_k. (`plus` returns h^alpha Delta_+ z_k.)"""
    return sum(w[n] * z[k - n] for n in range(k + 1))


def plus(z, k):
    return sum(w[n] * z[k + n] for n in range(N - k + 1))


def action(first, last, U=U, left=x, right=y):
    """Return the action (6.2), or (6.10) if left = x - zeta and right = y - zeta_bar."""
    return (sum(step(x[k], x[k + 1], U) + step(y[k], y[k + 1], U) for k in range(N))
            - h * rho * g * sum(minus(left, k) * plus(right, k) for k in range(first, last + 1)))
#< action


def slopes(z, k):
    """Return D1 L_d(z_k, z_{k+1}) + D2 L_d(z_{k-1}, z_k), written out."""
    return (m * (2 * z[k] - z[k - 1] - z[k + 1]) / h
            - h * kappa * force(kappa * z[k] + (1 - kappa) * z[k + 1])
            - h * (1 - kappa) * force(kappa * z[k - 1] + (1 - kappa) * z[k]))


def twice(one, z, k):
    """Return h^(2 alpha) Delta Delta z_k; `one` is minus or plus."""
    return one([one(z, j) for j in range(N + 1)], k)


def equations(k):
    """Return the left sides of (6.6a) and (6.6b)."""
    return (slopes(x, k) - h * rho * g * twice(minus, x, k),
            slopes(y, k) - h * rho * g * twice(plus, y, k))


RANGES = ((0, N - 1), (1, N), (0, N))
for first, last in RANGES + ((1, N - 1),):
    A = action(first, last)
    for k in range(1, N):
        prove(f"(6.5) gx_k, N = {N}, d = 1, range {first}..{last}, k = {k}",
              expand(diff(A, x[k]) - slopes(x, k) + h * rho * g * sum(
                  w[i - k] * plus(y, i) for i in range(max(k, first), last + 1))))
        prove(f"(6.5) gy_k, N = {N}, d = 1, range {first}..{last}, k = {k}",
              expand(diff(A, y[k]) - slopes(y, k) + h * rho * g * sum(
                  w[k - i] * minus(x, i) for i in range(first, min(k, last) + 1))))
        #> ends
        a, b = equations(k)
        end = h * rho * g * w[0] * (int(first > 0) * w[k] * x[0]
                                    + int(last < N) * w[N - k] * y[N])
        prove(f"(6.7) N = {N}, d = 1, range {first}..{last}, k = {k}",
              expand(diff(A, x[k]) + diff(A, y[k]) - a - b - end))
        #< ends
        if (first, last) == (0, N):
            prove(f"unrestricted variations couple the curves, N = {N}, d = 1, k = {k}",
                  expand(diff(A, x[k]) - slopes(x, k) + h * rho * g * twice(plus, y, k)),
                  expand(diff(A, y[k]) - slopes(y, k) + h * rho * g * twice(minus, x, k)))


#> references
# zeta_0 = x_0 and bar_N = y_N. The other values of the references are any numbers.
zeta, bar = symbols(f"zeta1:{N + 1}"), symbols(f"bar0:{N}")
z = (0, *(x[k] - zeta[k - 1] for k in range(1, N + 1)))
t = (*(y[k] - bar[k] for k in range(N)), 0)
for first, last in product((0, 1), (N - 1, N)):
    A = action(first, last, left=z, right=t)
    for k in range(1, N):
        a = slopes(x, k) - h * rho * g * twice(minus, z, k)
        b = slopes(y, k) - h * rho * g * twice(plus, t, k)
        prove(f"(6.11) N = {N}, d = 1, range {first}..{last}, k = {k}",
              expand(diff(A, x[k]) + diff(A, y[k]) - a - b))
#< references


def weight(order, n):
    return (-1) ** n * expand_func(binomial(order, n))


#> third
third = [weight(Rational(1, 3), n) for n in range(N + 1)]
residual = [Rational(1, 2) * Rational(3, 5) * third[N - k] for k in range(1, N)]
claim("the end terms of Theorem 4.1 at alpha = 1/3, h = 1/2, rho = 3/5",
      residual == [Rational(-1, 54), Rational(-1, 30), Rational(-1, 10)])
#< third

# ---- d = 2, U the general polynomial with cubic and quartic terms --------------
u = {(i, j): Symbol(f"u{i}{j}") for i, j in product(range(5), repeat=2) if 2 <= i + j <= 4}


def U2(z):
    return sum(c * z[0] ** i * z[1] ** j for (i, j), c in u.items())


z2 = symbols("z_0:2")
grad2 = [diff(U2(z2), v) for v in z2]
mass, damping = symbols("m_0:2"), symbols("rho_0:2")
N2 = 2
xs, ys = ([symbols(f"{c}{k}_0:2") for k in range(N2 + 1)] for c in "xy")


def point(p, q):
    return [kappa * p[j] + (1 - kappa) * q[j] for j in range(2)]


def step2(p, q):
    return sum(mass[j] * (q[j] - p[j]) ** 2 / (2 * h) for j in range(2)) - h * U2(point(p, q))


def gradient2(p, q):
    return [e.subs(dict(zip(z2, point(p, q))), simultaneous=True) for e in grad2]


def component(z, j):
    return [p[j] for p in z]


def action2(first, last):
    """Return the action for d = 2. The sequences are short, so minus and plus have their own N."""
    total = sum(step2(z[k], z[k + 1]) for z in (xs, ys) for k in range(N2))
    for k in range(first, last + 1):
        for j in range(2):
            X, Y = component(xs, j), component(ys, j)
            total -= h * g * damping[j] * (
                sum(w[n] * X[k - n] for n in range(k + 1))
                * sum(w[n] * Y[k + n] for n in range(N2 - k + 1)))
    return total


A2 = action2(0, N2)
for j in range(2):
    p, q = gradient2(xs[1], xs[2])[j], gradient2(xs[0], xs[1])[j]
    r, t = gradient2(ys[1], ys[2])[j], gradient2(ys[0], ys[1])[j]
    X, Y = component(xs, j), component(ys, j)
    W = [w[0] ** 2, 2 * w[0] * w[1]]  # Delta Delta on two terms
    want = (mass[j] / h * (2 * X[1] - X[0] - X[2] + 2 * Y[1] - Y[0] - Y[2])
            - h * (kappa * (p + r) + (1 - kappa) * (q + t))
            - h * g * damping[j] * (W[0] * X[1] + W[1] * X[0] + W[0] * Y[1] + W[1] * Y[2]))
    prove(f"(6.6) d = 2, N = 2, component {j}",
          expand(diff(A2, X[1]) + diff(A2, Y[1]) - want))

# ---- the mirror image -------------------------------------------------------------
#> mirror
mirrored = dict(zip(y, reversed(x)))
for k in range(1, N):
    b = equations(k)[1].subs(mirrored, simultaneous=True)
    a = equations(N - k)[0]
    prove(f"(6.8) N = {N}, d = 1: y_k = x_(N-k) turns (b, kappa) into (a, 1 - kappa), k = {k}",
          expand((b - a.subs(kappa, 1 - kappa)).doit()))
#< mirror
#> defect
back, here, ahead = symbols("x_- x_0 x_+")


def potential_force(z, k, dU, kappa=kappa):
    """Return kappa U'(S z_k) + (1 - kappa) U'(S z_{k-1})."""
    return (kappa * dU(kappa * z[k] + (1 - kappa) * z[k + 1])
            + (1 - kappa) * dU(kappa * z[k - 1] + (1 - kappa) * z[k]))


square = lambda z: z ** 2  # U = z^3 / 3
x_side, y_side = (potential_force(z, 1, square) for z in ((back, here, ahead), (ahead, here, back)))
prove("(6.9)", expand(x_side - y_side - kappa * (kappa - 1) * (2 * kappa - 1)
                      * (back - ahead) * (2 * here - back - ahead)))
values = {kappa: Rational(1, 4), back: 0, here: 0, ahead: 1}
claim("at kappa = 1/4: 9/64 and 3/64",
      (x_side.subs(values), y_side.subs(values)) == (Rational(9, 64), Rational(3, 64)))
linear = lambda z: m * z + s
prove("a quadratic U has no defect", expand(
    potential_force((back, here, ahead), 1, linear) - potential_force((ahead, here, back), 1, linear)))
#< defect

#> only
# L_d(p, q) - L_d(q, p) has the form phi(q) - phi(p) if and only if its mixed derivative is 0, which is -h kappa (1 -
# kappa) (U''(kappa p + (1-kappa) q) - U''(kappa q + (1-kappa) p)).
p, q = symbols("p q")
mixed = diff(step(p, q) - step(q, p), p, q).doit()
second = diff(U(s), s, 2)
prove("the mixed derivative", expand(mixed + h * kappa * (1 - kappa) * (
    second.subs(s, kappa * p + (1 - kappa) * q) - second.subs(s, kappa * q + (1 - kappa) * p))))
# For kappa != 1/2 the two arguments are independent, so U'' must be constant.
determinant = factor(kappa ** 2 - (1 - kappa) ** 2)
claim("independent unless kappa = 1/2", solve(determinant, kappa) == [Rational(1, 2)])
#< only

# ---- exact values ------------------------------------------------------------------
header("verify/discrete_principle/discrete_principle.py")
D = Rational
DATA = [  # alpha, kappa, h; the first five are exact in doubles
    (D(1, 2), D(1, 4), D(1, 4)), (D(1, 4), D(3, 4), D(1, 16)), (D(3, 4), D(1, 2), D(1, 16)),
    (D(0), D(1), D(1, 2)), (D(1), D(0), D(1, 2)),
    (D(0.3), D(0.3), D(0.1)), (D(0.8), D(0.9), D(0.03))]
EXACT = 5


def numbers(S, curves, ranges, parameters):
    """Return value, gradient, and the sizes of their terms, for each row of DATA and each range."""
    rows, gradients, polynomials = [], [], PolyRing([*curves, g], QQ)
    for row, (alpha, kap, step_size) in enumerate(DATA):
        known = {kappa: kap, h: step_size, **parameters,
                 **{w[k]: weight(alpha, k) for k in range(N + 1)}}
        power = known_power(step_size, alpha)
        for first, last in ranges:
            A = polynomials.from_expr(S(first, last).xreplace(known))
            pairs = [rounded(e, curves, power) for e in [A] + [A.diff(i) for i in range(len(curves))]]
            rows.append([hexd(alpha), hexd(kap), hexd(step_size), first, last, int(row < EXACT),
                         pairs[0][0], f"{pairs[0][1]:.3g}", f"{max(p[1] for p in pairs[1:]):.3g}"])
            gradients += [p[0] for p in pairs[1:]]
    return rows, gradients


def known_power(base, alpha):
    """Return a function of the number of digits that computes h^(-2 alpha)."""
    def value(digits):
        with mpmath.workdps(digits + 20):
            return mpmath.power(mpmath.mpf(int(base.p)) / int(base.q),
                                -2 * mpmath.mpf(int(alpha.p)) / int(alpha.q))
    return value


def rounded(e, curves, power):
    """Return the value of the polynomial e = A + B g on the curves, rounded, and the sum of its |terms|."""
    A, size = [Fraction(0), Fraction(0)], 0
    for powers, c in e.terms():
        term = Fraction(int(c.numerator), int(c.denominator))
        for v, i in ((v, i) for v, i in zip(curves, powers) if i):
            term *= Fraction(int(CURVE[v].p), int(CURVE[v].q)) ** i
        A[powers[-1]] += term
        size += abs(float(term)) * float(power(20)) ** powers[-1]

    def value(digits):
        with mpmath.workdps(digits + 20):
            total = (mpmath.mpf(A[0].numerator) / A[0].denominator
                     + power(digits) * mpmath.mpf(A[1].numerator) / A[1].denominator)
            return mpmath.nstr(total, digits)
    return hexd_real(value), size


quarters = lambda *n: [D(i, 4) for i in n]
flat2 = [v for z in (xs, ys) for pair in z for v in pair]
CURVE = dict(zip(x + y, quarters(3, 5, -2, 1, 6) + quarters(-1, 2, 7, -3, 4)))
CURVE.update(zip(flat2, quarters(3, -2, 5, 1, -2, 4, 2, 7, -3, 1, 4, -5)))
FIELDS = ("double alpha, kappa, h; size_t first, last; int exact; "
          "double S, size_S, size_gradient;")

c2, c3, c4 = potential1 = [D(3, 2), D(-1, 2), D(1, 4)]
rows, gradients = numbers(
    lambda first, last: action(first, last, lambda z: c2 * z ** 2 / 2 + c3 * z ** 3 + c4 * z ** 4),
    x + y, RANGES, {m: D(2), rho: D(3, 2)})
array("d1_x", [CURVE[v] for v in x])
array("d1_y", [CURVE[v] for v in y])
array("d1_potential", potential1, "U = c2 z^2/2 + c3 z^3 + c4 z^4; mass 2, damping 3/2")
table("ref_d1", FIELDS, rows)
print("\n/* D_x0 ... D_x4, D_y0 ... D_y4 of each row of ref_d1 */\n"
      "static const double ref_d1_gradient[] = {\n    " + ",\n    ".join(gradients) + ",\n};")

potential2 = {(2, 0): D(1, 2), (0, 2): D(3, 2), (2, 1): D(1, 2), (2, 2): D(1, 4)}
rows, gradients = numbers(action2, flat2, [(0, N2)], {
    mass[0]: D(1), mass[1]: D(2), damping[0]: D(1, 2), damping[1]: D(3, 4),
    **{c: potential2.get(ij, 0) for ij, c in u.items()}})
array("d2_x", [CURVE[v] for v in flat2[:6]])
array("d2_y", [CURVE[v] for v in flat2[6:]])
print("\n/* U = a^2/2 + 3 b^2/2 + a^2 b/2 + (a b)^2/4; masses 1, 2; dampings 1/2, 3/4 */")
table("ref_d2", FIELDS, rows)
print("\n/* D_x0 ... D_x2, D_y0 ... D_y2, two components each */\n"
      "static const double ref_d2_gradient[] = {\n    " + ",\n    ".join(gradients) + ",\n};")
