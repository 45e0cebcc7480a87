"""H 23. The discrete adjoint of a fractional variational integrator.

Proved here:
  (23.2)  P B^T P = B#: generic weights, kappa, Hessians and shift (N = 5); also for kappa = 1/2, d = 2 and full
          symmetric M, C and G (N = 7), in integers, together with the conditions without which it fails;
  (23.3)  the adjoint run solves B^T lambda = -J_x (N = 4, all symbols, a quartic U), and
          (23.6), every derivative of J + lambda . R, for three pasts, with (23.7) for the shift;
  (23.8)  the two variations of the unrestricted action are the run and its adjoint (N = 4);
  (23.9)  the derivatives of the weights with respect to their order: the recurrence, for a symbolic
          order, and the generating function ln(1 - z) (1 - z)^beta, n <= 12;
  (23.11) the derivative of the density of (12.5) with respect to nu;
  (23.27) lambda jumps at the nodes k where J depends on p_k: Algorithm 3, N = 3, kappa = 1, with symbols for
          weights, Hessians and slopes; and kappa = 1/3 in fractions.
Printed: the derivatives of the weights, from the definition, which is a product; and derivatives of runs as
differences of runs with 178 bits (adjoint_runs.py), which are right to 21 digits."""
from fractions import Fraction

import mpmath
from mpmath import mp
from sympy import (Matrix, Rational, cos, diff, exp, expand, log, pi,
                   series, sin, symbols)

from shared.adjoint_runs import BITS, fixed, in_step, real
from shared.refgen import METHODS, initial_history, claim, header, hexd, hexd_real, nearest, prove, short, table

# ---- the transpose ----

kappa, h, m, c, theta = symbols("kappa h m c theta")


def jacobian(M, C, G, w, kappa, h, theta):
    """Return d(R_0, ..., R_{N-1}) / d(x_1, ..., x_N) in blocks of size d. w[n] are the weights, and theta is that of
    (13.7), with which H_{k+1} enters R_k."""
    N, d = len(G), M.shape[0]
    B = Matrix.zeros(N * d, N * d)

    def add(k, j, block):  # add the block to row k, column of x_j
        if j > 0:
            B[k * d:(k + 1) * d, (j - 1) * d:j * d] += block

    for k in range(N):
        add(k, k, M / h - h * kappa**2 * G[k])
        add(k, k + 1, -M / h - h * kappa * (1 - kappa) * G[k])
        if k > 0:
            add(k, k, M / h - h * (1 - kappa) ** 2 * G[k - 1])
            add(k, k - 1, -M / h - h * kappa * (1 - kappa) * G[k - 1])
        for j in range(1, k + 2):
            add(k, j, -C * ((1 - theta) * (w[k - j] if j <= k else 0) + theta * w[k + 1 - j]))
    return B


def reversal(N, d):
    P = Matrix.zeros(N * d, N * d)
    for k in range(N):
        P[k * d:(k + 1) * d, (N - 1 - k) * d:(N - k) * d] = Matrix.eye(d)
    return P


#> transpose
w5, G5 = symbols("w0:6"), [Matrix([[g]]) for g in symbols("G0:5")]
one, P5 = Matrix([[1]]), reversal(5, 1)
B = jacobian(m * one, c * one, G5, w5, kappa, h, theta)
sharp = jacobian(m * one, c * one, G5[::-1], w5, 1 - kappa, h, theta)
prove("(23.2) P B^T P = B#, generic", *(P5 * B.T * P5 - sharp).expand())
#< transpose

numbers = iter([7 * k * k % 23 - 9 for k in range(1, 400)])


def symmetric():
    a, off, e = (next(numbers) for _ in range(3))
    return Matrix([[a, off], [off, e]])


M2, C2, G2 = symmetric(), symmetric(), [4 * symmetric() for _ in range(7)]
w2, P2, half = [next(numbers) for _ in range(8)], reversal(7, 2), Rational(1, 2)
B = jacobian(M2, C2, G2, w2, half, 1, 0)
claim("(23.2) in integers", all(v.is_integer for v in B)
      and P2 * B.T * P2 == jacobian(M2, C2, G2[::-1], w2, half, 1, 0))
claim("the Hessians in the same order will not do",
      P2 * B.T * P2 != jacobian(M2, C2, G2, w2, half, 1, 0))
claim("a C that is not symmetric has to be transposed",
      P2 * jacobian(M2, C2 + Matrix([[0, 1], [0, 0]]), G2, w2, half, 1, 0).T * P2
      == jacobian(M2, C2 + Matrix([[0, 0], [1, 0]]), G2[::-1], w2, half, 1, 0))
third = Rational(1, 3)
claim("nor will the same kappa",
      P2 * jacobian(M2, C2, G2, w2, third, 1, 0).T * P2
      != jacobian(M2, C2, G2[::-1], w2, third, 1, 0))

# ---- every momentum ----


def by_momenta(N, w, G, Jp, m, c, h, kappa, x0, p0):
    """Return J = sum_k Jp_k p_k of a run of a held body with the Hessians G, and the derivative of J with respect to
    p0. The derivative comes from the adjoint run (23.4) with the jumps (23.27)."""
    x, p, J = [x0], p0, Jp[0] * p0
    for k in range(N):
        inertia = m / h + kappa * (1 - kappa) * h * G[k]
        d = (p - kappa * h * G[k] * x[k]) / inertia
        x.append(x[k] + d)
        p = p - h * G[k] * (x[k] + (1 - kappa) * d)
        p -= c * sum(w[n] * (x[k + 1 - n] - x0) for n in range(k + 2))
        J += Jp[k + 1] * p
    mu, q = [Jp[N]], 0
    for k in reversed(range(N)):
        inertia = m / h + kappa * (1 - kappa) * h * G[k]
        q -= c * sum(w[n] * mu[-1 - n] for n in range(len(mu)))
        d = (q - (1 - kappa) * h * G[k] * mu[-1]) / inertia
        q -= h * G[k] * (mu[-1] + kappa * d)
        mu.append(mu[-1] + d + Jp[k])  # the last one, k = 0, is the derivative with respect to p0
    return J, mu[-1]


w3, G3, Jp3, x03, p03 = symbols("w0:4"), symbols("G0:3"), symbols("Jp0:4"), *symbols("x0 p0")
J, by_p0 = by_momenta(3, w3, G3, Jp3, m, c, h, 1, x03, p03)
prove("(23.27) lambda jumps by J_p", expand((J - J.subs(p03, 0) - by_p0 * p03) * m**3))
take = [Fraction(next(numbers), 5) for _ in range(12)]
runs = [by_momenta(3, take[:4], take[4:7], take[7:11], Fraction(2), Fraction(3, 7), Fraction(1, 2),
                   Fraction(1, 3), Fraction(1), Fraction(value)) for value in (0, 1)]
claim("(23.27) in fractions", runs[1][0] - runs[0][0] == runs[0][1])

# ---- the adjoint run, and the derivatives that it gives ----

N4 = 4
x, lam, F = symbols("x0:5"), symbols("lambda0:5"), symbols("F0:5")
Jx, w4 = symbols("J0:5"), symbols("w0:5")
p0, pN, rho, al, end, k0, g = symbols("p0 pN rho alpha e k0 g")


def spring(S):  # a potential whose third and fourth derivatives are not zero
    return k0 * S**2 / 2 + g * S**4 / 4


def lagrangian(a, b):
    return m / 2 * (b - a) ** 2 / h - h * spring(kappa * a + (1 - kappa) * b)


A = sum(lagrangian(x[k], x[k + 1]) for k in range(N4))
MM = [kappa * lam[k] + (1 - kappa) * lam[k + 1] for k in range(N4)]


Hess = [k0 + 3 * g * (kappa * x[k] + (1 - kappa) * x[k + 1]) ** 2 for k in range(N4)]


def lagrange(past, theta, end, cc):
    """Return sum_k lambda_k R_k of (13.7), the differences z, and the multipliers nu. Algorithm 3 is theta = 0, end =
    1."""
    origin = 0 if past == "rl" else x[0]
    drift = h * p0 / m if past == "caputo" else 0
    z = [x[j] - origin - j * drift for j in range(N4 + 1)]
    H = [sum(w4[n] * z[k - n] for n in range(k + 1)) for k in range(N4 + 1)]
    nu = [0] + [(1 - theta) * lam[k] + theta * lam[k - 1] for k in range(1, N4)]
    nu.append(end * lam[N4] + theta * lam[N4 - 1])
    # lambda . (slopes of the action), and the terms with the given momenta at the start and the end
    total = sum(lam[k] * diff(A, x[k]) for k in range(N4 + 1)) + lam[0] * p0 - lam[N4] * pN
    total += sum(-cc * nu[k] * H[k] + h * lam[k] * F[k] for k in range(1, N4 + 1))
    return total, z, nu


def mirrored(nu):
    return [sum(w4[k - j] * nu[k] for k in range(j, N4 + 1)) for j in range(N4 + 1)]


#> gradients
for past, th, en in (("held", 0, 1), ("caputo", 0, 1), ("rl", 0, 1), ("caputo", theta, end)):
    L, z, nu = lagrange(past, th, en, c)
    n = mirrored(nu)
    prove(f"(23.7) sum nu H = sum z N, {past}",
          expand(sum(nu[k] * sum(w4[i] * z[k - i] for i in range(k + 1)) for k in range(1, N4 + 1))
                 - sum(z[j] * n[j] for j in range(N4 + 1))))
    # The adjoint run (23.4), node by node.
    q = Jx[N4] - c * n[N4]
    for j in range(N4, 0, -1):
        by_x = diff(L, x[j]) + Jx[j]
        equation = q - (m / h * (lam[j - 1] - lam[j]) + h * (1 - kappa) * Hess[j - 1] * MM[j - 1])
        prove(f"(23.4) node {j}, {past}", expand(by_x - equation))
        # Solve the equation of the step for lambda_{j-1}, then update q.
        q = (m / h * (lam[j - 1] - lam[j]) - h * kappa * Hess[j - 1] * MM[j - 1]
             + Jx[j - 1] - c * n[j - 1] * (1 if j > 1 else 0))
    origin = -c * n[0] if past == "rl" else c * sum(n[1:])
    drift = c * h / m * sum(j * n[j] for j in range(1, N4 + 1)) if past == "caputo" else 0
    prove(f"(23.6) by x_0, {past}", expand(diff(L, x[0]) + Jx[0] - (q + origin)))
    prove(f"(23.6) by p_0, {past}", expand(diff(L, p0) - (lam[0] + drift)))
    prove(f"(23.6) by m, {past}",
          expand(diff(L, m) - (sum((x[k + 1] - x[k]) * (lam[k + 1] - lam[k]) for k in range(N4)) / h
                               - drift * p0 / m)))
    prove(f"(23.6) by a parameter, {past}",
          expand((diff(L, k0) + h * sum((kappa * x[k] + (1 - kappa) * x[k + 1]) * MM[k]
                                        for k in range(N4)))))
    prove(f"(23.6) by c, {past}", expand(diff(L, c) + sum(z[j] * n[j] for j in range(N4 + 1))))
    prove(f"(23.6) by F, {past}", *[diff(L, F[k]) - h * lam[k] for k in range(1, N4 + 1)])
step = symbols("h", positive=True)
prove("(23.6) h^(1 - 2 alpha) by alpha", diff(rho * step ** (1 - 2 * al), al)
      + 2 * log(step) * rho * step ** (1 - 2 * al))
#< gradients

#> action
held = [v - x[0] for v in x]
coupled = sum(lam[k] * diff(A, x[k]) for k in range(1, N4)) + sum(h * lam[k] * F[k] for k in range(1, N4))
coupled -= c * sum(lam[k] * sum(w4[n] * held[k - n] for n in range(k + 1)) for k in range(1, N4))
for k in range(1, N4):
    prove("(23.8) by lambda: the run", expand(
        diff(coupled, lam[k]) - (diff(A, x[k]) + h * F[k]
                                 - c * sum(w4[n] * held[k - n] for n in range(k + 1)))))
    ends = {lam[0]: 0, lam[N4]: 0}
    prove("(23.8) by x: its adjoint, with U'' along x", expand(
        diff(coupled, x[k]).subs(ends) - (
            m / h * (2 * lam[k] - lam[k - 1] - lam[k + 1]) - h * kappa * Hess[k] * MM[k]
            - h * (1 - kappa) * Hess[k - 1] * MM[k - 1]
            - c * sum(w4[j - k] * lam[j] for j in range(k, N4))).subs(ends)))
# If the end x_N and the momentum p_0 may vary too, the derivatives by lambda_0 and x_N are the equations of the start
# of both runs.
L, _, nu = lagrange("held", 0, 1, c)
whole = (sum(lam[k] * diff(A, x[k]) for k in range(N4 + 1))
         + sum(lam[k] * (h * F[k] - c * sum(w4[n] * held[k - n] for n in range(k + 1)))
               for k in range(1, N4 + 1)))
prove("(23.8) S_a + lambda_0 p_0 is what (23.3) varies, but for lambda_N p_N",
      expand(whole + lam[0] * p0 - (L + lam[N4] * pN)))
prove("(23.8) by lambda_0: the start of the run", expand(
    diff(whole, lam[0]) + p0 - (p0 + diff(lagrangian(x[0], x[1]), x[0]))))
# Without these two equations the start is free: from x_0 = 0 a free body moves on with any velocity v instead of p_0
# / m, and so does its mirror image.
free = {k0: 0, g: 0, c: 0, **{f: 0 for f in F}}
v = symbols("v")
for k in range(1, N4):
    prove("(23.8) 0 < k < N alone: any velocity", expand(diff(whole, lam[k]).subs(free).subs(
        {x[j]: j * h * v for j in range(N4 + 1)})))
    prove("(23.8) 0 < k < N alone: any mirrored velocity", expand(diff(whole, x[k]).subs(free).subs(
        {lam[j]: j * h * v for j in range(N4 + 1)})))
claim("(23.8) which is not p_0 / m", expand((diff(whole, lam[0]) + p0).subs(free).subs(
    {x[j]: j * h * v for j in range(N4 + 1)}) - (p0 - m * v)) == 0)
#< action

# ---- the derivatives of the weights ----

b, z, s, nu = symbols("beta z s nu")


def weight(n):
    """Return w_n(beta) as a polynomial in beta, from its definition."""
    w = Rational(1)
    for j in range(n):
        w = expand(w * (j - b) / (j + 1))
    return w


#> rates
w = [weight(n) for n in range(13)]
rate = [diff(v, b) for v in w]
for n in range(1, 13):
    prove(f"(23.9) the recurrence, n = {n}",
          expand(rate[n] - rate[n - 1] * (n - 1 - b) / n + w[n - 1] / n))
    prove(f"(23.9) rate_n = - sum_j w_(n-j) / j, n = {n}",
          expand(rate[n] + sum(w[n - j] / j for j in range(1, n + 1))))
prove("(23.9) ln(1-z) = - sum z^j / j",
      series(log(1 - z), z, 0, 9).removeO() + sum(z**j / Rational(j) for j in range(1, 9)))
#< rates

#> density
density = -sin(pi * nu) / pi * (exp(s) - 1) ** nu
prove("(23.11) its derivative by nu",
      (diff(density, nu) + (exp(s) - 1) ** nu
       * (cos(pi * nu) + sin(pi * nu) / pi * log(exp(s) - 1))).rewrite(exp))
#< density


def exact_rate(beta, n):
    """Return d w_n / d beta exactly, by differentiating the product of the factors (j - beta) / (j + 1)."""
    top, bottom = Fraction(beta).as_integer_ratio()
    value, slope, under = 1, 0, 1  # w_j and its derivative, over a common denominator
    for j in range(n):
        factor = j * bottom - top
        value, slope = value * factor, slope * factor - value * bottom
        under *= bottom * (j + 1)
    return Rational(*Fraction(slope, under).as_integer_ratio())


def far_rate(beta, n):
    """Return a function of the number of digits that computes d w_n / d beta by the digamma function, w_n (psi(-beta)
    - psi(n - beta))."""
    def at(digits):
        with mp.workdps(digits):
            x = mpmath.mpf(Rational(beta).p) / Rational(beta).q
            value = (mpmath.gammaprod([n - x], [-x, n + 1])
                     * (mpmath.digamma(-x) - mpmath.digamma(n - x)))
            return mpmath.nstr(value, digits - 15, min_fixed=0, max_fixed=0)
    return at


orders = [0.0, 1e-3, 0.3, 0.5, 0.9, 1.0, 1.25, 1.7, 2.0]
rates = []
for beta in orders:
    for n in [0, 1, 2, 3, 7, 20, 32, 33, 100, 500]:
        value = exact_rate(beta, n)
        rates.append([repr(beta), n, hexd(value), short(value)])
    for n in [10**4, 10**6] if beta % 1 else []:
        rates.append([repr(beta), n, hexd_real(far_rate(beta, n), 60)])
claim("the two definitions agree",
      abs(float(far_rate(0.3, 100)(60)) - float(exact_rate(0.3, 100))) < 1e-15)

# ---- derivatives of runs, by the definition ----

mp.dps = 70


def objective(q, x, p):
    """Return J = (h/2) sum_{k>=1} (x_k - sin t_k)^2 + x_N/2 + x_N p_N^2/4, x_N and p_N."""
    squares = sum((v - s) ** 2 for v, s in zip(x[1:], q["sine"][1:])) >> BITS
    J = real(squares) * q["h"] / 2 + real(x[-1]) / 2 + real(x[-1]) * real(p) ** 2 / 4
    return J, real(x[-1]), real(p)


def derivatives(q, names, force):
    """Return (J, x_N, p_N), and the derivatives of J as differences over 2^-80 of runs with 178 bits. They are right
    to 21 digits."""
    eps, qs = mpmath.mpf(2) ** -80, [q]
    for name in names + [force]:
        r = dict(q)
        if name == force:
            r["F"] = list(q["F"])
            r["F"][force] += fixed(eps)
        else:
            r[name] = q[name] + eps
        qs.append(r)
    middle, *others = (objective(r, x, p) for r, (x, p) in zip(qs, in_step(qs)))
    return middle, [(J - middle[0]) / eps for J, _, _ in others]


NAMES = ["x0", "p0", "mass", "rho", "alpha", "k", "g"]


def row(method, past, alpha, kappa, N, h, x0, force):
    q = dict(method=method, past=past, alpha=mpmath.mpf(alpha), kappa=mpmath.mpf(kappa), N=N,
             h=mpmath.mpf(h), mass=mpmath.mpf(1), rho=mpmath.mpf(3) / 8, x0=mpmath.mpf(x0),
             p0=mpmath.mpf(1) / 2, k=mpmath.mpf(1), g=mpmath.mpf(1) / 2)
    q["side"] = (alpha > 0.5) - (alpha < 0.5)  # at alpha = 1/2 take the derivative from below
    q["F"] = [fixed(mpmath.cos(k * q["h"]) / 4) for k in range(N + 1)]
    q["sine"] = [fixed(mpmath.sin(k * q["h"])) for k in range(N + 1)]
    names = [n for n in NAMES if not (n == "x0" and method != "fvi" and past == "rl" and alpha > 0.5)]
    (_, x, p), slopes = derivatives(q, names, force)
    if "x0" not in names:
        slopes.insert(0, None)
    return ([f"&fvi_{METHODS[method]}",
             initial_history(past), repr(alpha),
             repr(kappa), N, repr(h), repr(x0), force]
            + [nearest(v) for v in (x, p)]
            + ["NAN" if v is None else nearest(v) for v in slopes])


runs = [row("fvi", past, alpha, kappa, 2000, 1 / 128, 1.0, 777) for past, alpha, kappa in
        [("caputo", 0.3125, 0.5), ("caputo", 0.75, 0.25), ("rl", 0.75, 0.25), ("held", 0.75, 0.25)]]
for method in ("fvi", "shifted", "bdf2", "stable"):
    for past in ("held", "caputo", "rl"):
        for alpha, kappa in ((0.0, 0.5), (0.3, 0.25), (0.5, 0.5), (0.8, 0.3), (0.9 if method == "bdf2" else 1.0, 0.5)):
            if (method, past) != ("fvi", "caputo") or alpha > 0.5:
                x0 = 0.0 if past == "rl" and alpha > 0.5 and method != "fvi" else 0.875
                kappa = 0.5 if method == "stable" else kappa
                runs.append(row(method, past, alpha, kappa, 60, 1 / 16, x0, 23))

header("verify/adjoint/adjoint.py")
print("\n/* beta, n, d w_n / d beta; the exact rational where it is short */")
table("ref_rates", "double beta; size_t n; double want;", rates)

print("""
/* A Duffing oscillator, c = 1, g = 1/2, m = 1, rho = 3/8, p0 = 1/2, F = cos(t)/4; x_N, p_N;
   J = (h/2) sum_{k=1}^N (x_k - sin t_k)^2 + x_N/2 + x_N p_N^2/4, by all that there is */""")
table("ref_slopes", "const fvi_method *method; fvi_initial_history past; double alpha, kappa; size_t N; "
      "double h, x0; size_t force; double x, p, by_x0, by_p0, by_mass, by_rho, by_alpha, "
      "by_c, by_g, by_F;", runs)
