"""H 14. Which steps are stable.

Proved here, all parameters symbolic:
  (14.1)  for quadratic U the three-term equation is (1 + q W) second difference
          + W x_k + R memory, q = kappa (1 - kappa);
  (14.2)  its symbol; its values at z = 1 and z = -1;
  (14.3)  polar form of 1 - z on the unit circle, 1/z - 2 + z there, P(-1);
          in R^d, v* P(z) v is the scalar symbol with v*Mv, v*Kv, v*rho v;
          alpha = 1, kappa = 1/2: the bound is rho < m for every step.
  (14.11) Caputo's past: the forcing of the distance from the line, its zero -kappa / (1 - kappa),
          and Q'(-1) on the edge.
  (14.7)  Euler's explicit step of x' = v, m v' = -c x - rho v: its matrix is 1 + h A, and
          (14.8), |1 + h s| < 1 for both roots s, is b < a and 2 a - b < 4,
          a = h rho / m, b = h^2 c / m, by Jury's conditions; at random rationals, too.
  (14.9)  det S of Lobatto's form M from the eigenvalues of Delta(z): S = E* B f(Delta) E, and
          the determinant, at 30 digits for s = 2 to 8, random z, alpha, W and R;
  (14.10) alpha = 1/2, s = 2 to 8: the coefficients, with every sign, as polynomials in W, R.
Printed: growth factors 1/|z| from the root of Q in (-1, 0), at 50 digits."""
import random
from fractions import Fraction

import mpmath
from sympy import (I, Matrix, Poly, Rational, binomial, cos, diff, exp, expand, expand_complex, eye,
                   factorial, pi, simplify, sin, symbols, trigsimp)

from shared.arithmetic import function_of, spectrum
from shared.refgen import claim, header, hexd, hexd_real, prove, table

alpha, kappa, W, R, h, m, c = symbols("alpha kappa W R h m c", positive=True)
xm, x0, xp = symbols("x_- x_0 x_+", real=True)
z = symbols("z")
f = symbols("f", positive=True)
q = kappa * (1 - kappa)

#> recurrence
S_after = kappa * x0 + (1 - kappa) * xp    # S x_k
S_before = kappa * xm + (1 - kappa) * x0   # S x_{k-1}
three_terms = (m * (xp - 2 * x0 + xm) / h**2
               + kappa * c * S_after + (1 - kappa) * c * S_before)
prove("(14.1) the local part of the recurrence",
      expand((three_terms * h**2 / m).subs(c, W * m / h**2)
             - ((1 + q * W) * (xp - 2 * x0 + xm) + W * x0)))
#< recurrence

P = (1 + q * W) * (1 / z - 2 + z) + W + R * (1 - z) ** (2 * alpha)
prove("(14.2) P(1) = W", (P - R * (1 - z) ** (2 * alpha)).subs(z, 1) - W)
#> ends
prove("(14.3) P(-1) = W (1 - 2 kappa)^2 + 4^alpha R - 4",
      P.subs(z, -1) - (W * (1 - 2 * kappa) ** 2 + 4**alpha * R - 4))
#< ends

#> line
# (14.11): Caputo's past, alpha > 1/2. The memory acts on z_k = x_k - x_0 - k V, V = h v_0, so z_0 = 0, and the
# second difference of x_k is that of z_k. The sum of z^(k+1) times (14.1) over k >= 1 is
#   Q Z - (1 + q W) z_1 z + W z sum_{k >= 1} (x_0 + k V) z^k = 0.
X0, V = symbols("X0 V")
z_1 = -kappa * W * (X0 + (1 - kappa) * V) / (1 + q * W)
prove("(14.11) z_1 from p_0 = -D_1 L_d(x_0, x_1)", simplify(
    V - (V + z_1) - kappa * W * (X0 + (1 - kappa) * (V + z_1))))
driven = (1 + q * W) * z_1 * z - W * z * (X0 * z / (1 - z) + V * z / (1 - z) ** 2)
prove("(14.11) what drives the distance from the line", simplify(driven + W * z * (
    kappa + (1 - kappa) * z) / (1 - z) * (X0 + V * (1 - kappa + kappa * z) / (1 - z))))
star = -kappa / (1 - kappa)  # the zero of the factor; there Q is (1 - z)^2 + R z (1 - z)^(2 alpha)
prove("(14.11) there spring and inertia cancel in Q", simplify(q * (1 - star) ** 2 + star))
prove("(14.11) the derivative of Q = z P at -1 is P(-1) + alpha R 4^alpha",
      simplify((diff(z * P, z) - P - alpha * R * 4**alpha).subs(z, -1)))
#< line

#> circle
on_circle = exp(-I * f)
polar = 2 * sin(f / 2) * exp(I * (pi - f) / 2)
prove("(14.3) 1 - e^{-if} = 2 sin(f/2) e^{i (pi - f)/2}",
      expand_complex(1 - on_circle - polar).rewrite(cos).simplify())
prove("(14.3) 1/z - 2 + z is real on the circle: -4 sin^2(f/2)",
      trigsimp(expand_complex(1 / on_circle - 2 + on_circle) + 4 * sin(f / 2) ** 2))
#< circle
# So Im P = R (2 sin(f/2))^{2 alpha} sin(alpha (pi - f)), positive for 0 < f < pi,
# 0 < alpha <= 1: both factors are, as 0 < alpha (pi - f) < pi.

# In R^d: for every vector v, v* P(z) v has the same form as the scalar symbol.
u1, u2, M1, M2, K11, K12, K22, r1, r2, k4 = symbols("u1 u2 M1 M2 K11 K12 K22 r1 r2 k4")
v = [u1, u2]
quadratic = lambda A: sum(A[i][j] * v[i] * v[j] for i in (0, 1) for j in (0, 1))
mass, stiff, damp = [[M1, 0], [0, M2]], [[K11, K12], [K12, K22]], [[r1, 0], [0, r2]]
D2, D = symbols("D2 D")  # the values of 1/z - 2 + z and of (1 - z)^{2 alpha}
matrix = [[(mass[i][j] + q * h**2 * stiff[i][j]) * D2 + h**2 * stiff[i][j] + k4 * damp[i][j] * D
           for j in (0, 1)] for i in (0, 1)]
prove("(14.3) v*P(z)v is the scalar symbol of v*Mv, v*Kv, v*rho v",
      expand(quadratic(matrix) - ((quadratic(mass) + q * h**2 * quadratic(stiff)) * D2
                                  + h**2 * quadratic(stiff) + k4 * quadratic(damp) * D)))

random.seed(14)
bound = (W * (1 - 2 * kappa) ** 2 + 4**alpha * R - 4).subs({alpha: 1, kappa: Rational(1, 2)})
prove("(14.3) alpha = 1, kappa = 1/2: R < 1, and R = rho/m has no h", bound - 4 * (R - 1))

#> explicit
# (14.8). The step multiplies (x, v) by 1 + h A, where A is the matrix of the motion.
v0_, rho_, lam, s_ = symbols("v_0 rho_0 lambda s")
x_next, v_next = x0 + h * v0_, v0_ + h * (-c * x0 - rho_ * v0_) / m
step = Matrix(2, 2, lambda i, j: diff((x_next, v_next)[i], (x0, v0_)[j]))
motion = Matrix([[0, 1], [-c / m, -rho_ / m]])
prove("(14.7) the step is 1 + h A", *(step - eye(2) - h * motion))
prove("(14.7) the exponents of the motion",
      m * (s_ * eye(2) - motion).det() - (m * s_**2 + rho_ * s_ + c))
a, b = symbols("a b", positive=True)
of_step = expand((lam * eye(2) - step).det().subs({rho_: a * m / h, c: b * m / h**2}))
prove("(14.8) the polynomial of a step", of_step - ((lam - 1) ** 2 + a * (lam - 1) + b))
# Jury: both roots in |lambda| < 1 if and only if p(1) > 0, p(-1) > 0 and |p(0)| < 1.
prove("(14.8) p(1) = b, p(-1) = 4 - 2 a + b, p(0) = 1 - a + b",
      of_step.subs(lam, 1) - b, of_step.subs(lam, -1) - (4 - 2 * a + b),
      of_step.subs(lam, 0) - (1 - a + b))
# p(0) < 1 is b < a, and p(0) > -1 follows: 2 (1 + p(0)) = (4 - 2 a + b) + b.
prove("(14.8) the other side of |p(0)| < 1", 2 * (2 - a + b) - ((4 - 2 * a + b) + b))
# The load: a pair of complex roots has |s|^2 = c / m, -2 Re s = rho / m, so the condition is b / a <= 1. Of two real
# roots the larger one in size, (a + root) / 2 in units of 1/h, gives the condition (a + root) / 4 <= 1.
root = symbols("root", positive=True)  # sqrt(a^2 - 4 b) >= 0
prove("(14.8) two real roots: 4 - a >= root >= 0 is 2 a - b <= 4 and a <= 4",
      expand((4 - a) ** 2 - root**2).subs(root**2, a**2 - 4 * b) - 4 * (4 - 2 * a + b))
#< explicit
for _ in range(2000):
    A, B = (Fraction(random.randrange(1, 6000), 1000) for _ in "ab")
    gap = A * A - 4 * B             # sqrt(gap) <= 4 - A is the same as gap <= (4 - A)^2 if A <= 4
    fits = B <= A if gap < 0 else A <= 4 and gap <= (4 - A)**2
    claim("(14.8) load <= 1 is b <= a and 2 a - b <= 4", fits == (B <= A and 2 * A - B <= 4))


def pade(s, x):
    """Return N and Q of the stability function of Lobatto IIIC, N(x)/Q(x) = e^x + O(x^(2s-1))."""
    part = lambda n, i: factorial(2 * s - 2 - i) * binomial(n, i) / factorial(2 * s - 2)
    return (sum(part(s - 2, i) * x**i for i in range(s - 1)),
            sum(part(s, i) * (-x)**i for i in range(s + 1)))


#> compressed
# (14.9): S is f(Delta) on the paths without a jump; the formula for its determinant.
mpmath.mp.dps = 30
mp = mpmath.mp
for s in range(2, 9):
    leg = lambda t: mpmath.diff(lambda y: mpmath.legendre(s - 1, y), t)
    c_ = [mp.mpf(0), *(sorted((1 + mp.re(t)) / 2 for t in mpmath.polyroots(
        mpmath.taylor(leg, 0, s - 2)[::-1], maxsteps=200, extraprec=100)) if s > 2 else []), mp.mpf(1)]
    b_ = [1 / (s * (s - 1) * mpmath.legendre(s - 1, 2 * t - 1)**2) for t in c_]
    lagrange = lambda j: lambda t: mpmath.fprod((t - c_[i]) / (c_[j] - c_[i])
                                                for i in range(s) if i != j)
    D_ = mpmath.matrix(s, s)
    for i in range(s):
        for j in range(s):
            D_[i, j] = mpmath.diff(lagrange(j), c_[i])
    B_ = mpmath.diag(b_)
    for _ in range(6):
        al, w, r, phi = (mp.mpf(random.random()) for _ in range(4))
        w, r, z_ = 50 * w, 50 * r, mpmath.expj(-3 * phi)
        delta = D_ + 0
        delta[0, 0] += 1 / b_[0]
        delta[0, s - 1] -= z_ / b_[0]                                  # (17.5)
        parts = spectrum(delta)
        lam, bits = parts[0], 2 * parts[3]
        entries = [mpmath.mpc(*(mpmath.ldexp(v, -bits) for v in e)) for e in function_of(parts, lambda t: t**(2 * al))]
        power = mpmath.matrix([entries[s * i:s * i + s] for i in range(s)])
        E = mpmath.matrix(s, s - 1)
        for i in range(s - 1):
            E[i, i] = 1
        E[s - 1, 0] = 1 / z_
        S = E.H * (-D_.H * B_ * D_ + w * B_ + r * B_ * power) * E      # (17.18)
        f_ = lambda t: t * t + w + r * t**(2 * al)
        total = sum(mpmath.fprod(lam[j] + mpmath.conj(t) for t in lam)
                    * mpmath.fprod(f_(lam[i]) / (lam[j] - lam[i]) for i in range(s) if i != j)
                    for j in range(s))
        want = b_[0] * mpmath.fprod(b_[:-1]) * total
        compressed = E.H * B_ * (delta**2 + w * mpmath.eye(s) + r * power) * E
        claim("(14.9) the symbol", mpmath.mnorm(S - compressed) < 1e-18 * mpmath.mnorm(S))
        claim("(14.9) its determinant", abs(mpmath.det(S) - want) < 1e-15 * (abs(want) + 1))


def symbol(s, al, w, r, phi):
    """Return the sum of (14.9)."""
    z_ = mpmath.expj(-phi)
    N_, Q_ = (Poly(e, z).all_coeffs() for e in pade(s, z))
    lam = mpmath.polyroots([mp.mpf(int(t.p)) / int(t.q) - z_ * v for t, v in zip(
        Q_, [0, 0, *(mp.mpf(int(t.p)) / int(t.q) for t in N_)])], maxsteps=500, extraprec=200)
    f_ = [t * t + w + r * t**(2 * al) for t in lam]
    return sum(mpmath.fprod(lam[j] + mpmath.conj(t) for t in lam)
               * mpmath.fprod(f_[i] / (lam[j] - lam[i]) for i in range(s) if i != j)
               for j in range(s))


weak, stiff_ = (symbol(3, mp.mpf("0.1"), w, mp.mpf(1), mp.mpf("0.5")).imag for w in (1, 1000))
claim("(14.9) for s = 3 and alpha = 1/10 the imaginary part has both signs", weak * stiff_ < 0)
#< compressed

#> half
# (14.10): alpha = 1/2, f(x) = (x - p)(x - p'), p + p' = -R, p p' = W. A polynomial that changes its sign when p and
# p' are exchanged is a sum of (p p')^j (p^k - p'^k). Divided by p - p' these terms are W^j U_k.
p_, q_ = symbols("p p'")
U = [Poly(0, W, R), Poly(1, W, R)]
while len(U) < 15:
    U.append(-(U[-1] * R + U[-2] * W))
for s in range(2, 9):
    (N1, Q1), (N2, Q2) = pade(s, p_), pade(s, q_)
    (M1_, P1_), (M2_, P2_) = pade(s, -p_), pade(s, -q_)
    both = {1: P1_ * N2 - P2_ * N1, -1: M1_ * Q2 - M2_ * Q1,
            0: P2_ * Q1 + M2_ * N1 - P1_ * Q2 - M1_ * N2}
    a_ = {}
    for n, e in both.items():
        terms = Poly(e, p_, q_).as_dict()
        prove(f"(14.10) changes its sign with p and p', s = {s}, z^{n}",
              *(v + terms.get((j, i), 0) for (i, j), v in terms.items()))
        a_[n] = sum((U[i - j] * W**j * v for (i, j), v in terms.items() if i > j), U[0])
    claim("(14.10) a_{-1} > 0", all(v > 0 for v in a_[-1].coeffs()))
    claim("(14.10) a_{-1} > a_1", all(v > 0 for v in (a_[-1] - a_[1]).coeffs()))
    if s == 3:
        prove("(14.10) s = 3 at z = 1 and -1", expand((a_[1] + a_[0] + a_[-1]).as_expr() - W * (24 - W) / 48),
              expand((a_[1] - a_[0] + a_[-1]).as_expr() - ((W - 8) * (W - 12) + 8 * R**2) / 48))
#< half

def growth(a, k, w, r, digits):
    mpmath.mp.dps = digits + 15
    a, k, w, r = (mpmath.mpf(t) for t in (a, k, w, r))
    Q = lambda t: (1 + k * (1 - k) * w) * (1 - t) ** 2 + t * (w + r * (1 - t) ** (2 * a))
    low, high = mpmath.mpf(-1), mpmath.mpf(0)
    claim("one change of sign in (-1, 0)", Q(low) < 0 < Q(high))
    for _ in range(4 * (digits + 15)):
        middle = (low + high) / 2
        low, high = (middle, high) if Q(middle) < 0 else (low, middle)
    return mpmath.nstr(-1 / low, digits)


CASES = [(0.5, 0.5, 1, 2.02), (0.5, 0.5, 1, 2.2), (0.25, 0.5, 0.01, 3), (0.75, 0, 1, 1.07),
         (1, 0.5, 1, 1.005), (1, 0.5, 0.1, 20), (0.1, 0.25, 3, 3.5), (0.9, 1, 0.5, 1.5)]
header("verify/stability/stability.py")
table("ref_growth", "double alpha, kappa, W, R, want;",
      [[hexd(t) for t in case] + [hexd_real(lambda n, s=case: growth(*s, n), 50)]
       for case in CASES])
