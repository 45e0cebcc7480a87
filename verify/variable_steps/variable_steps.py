"""H 22. The memory of variable steps: one matrix on every mesh.

DD is block lower bidiagonal on all stages of all steps (k,k): A^(-1)/h_k,
(k,k-1): -e_1 e_s^T/(h_k b_1); BB is diagonal, h_k b_i. Proved here, exactly:
  (22.1)  BB DD = S does not contain a step; DD (x - x_0) = v on continuous paths;
          DD^(-1) v, the path of form D (three steps, symbols; s = 2, 3, 4);
  (22.3)  BB^(-1) DD^T BB is DD of the reversed mesh, reversed;
  (22.4)  v^T S v is half a sum of squares;
  (22.5)  the resolvent (sigma + DD)^(-1), and its moving forms (22.6), (22.7);
  (22.8)  n(mu), d(mu) in closed form; d is the characteristic polynomial of -A^(-1),
          its coefficients and those of n_s are integers, s = 2 to 8;
  (22.16) the contribution of the last Legendre coefficient of x'' (60 digits, s = 2 to 8);
  (22.21) the restricted variation with the inertia as a term of order 1, its powers
          open (two steps, s = 2, 3).
In 60 digits, s = 2 to 8: the rule, (17.2), (22.8) and (22.9) against A^(-1) itself.
Printed for the stages that the method takes, from the definitions: nodes, weights,
A^(-1), n, d, (A^(-1))^beta, a(mu), the end corrections, the weights of the dense output."""
from functools import cache

import mpmath
from mpmath import mp, mpf
from sympy import (Function, Matrix, Poly, Rational, binomial, diag, diff, expand, eye,
                   factorial, gcd, integrate, legendre, ones, simplify, sqrt, symbols, zeros)

from shared.refgen import claim, header, hexd, prove, table

mu, t, x = symbols("mu t x")
STAGES = range(2, 9)


#> closed
@cache
def closed(s):
    """Return n and d of (22.8): n(t) = sum_k (-1)^k mu^(s-1-k) q^(k)(t), q = ell_1/b_1; and d = mu^s + n(0)."""
    q = (1 - t) * diff(legendre(s - 1, 2 * t - 1), t)
    q = expand(q * s * (s - 1) / q.subs(t, 0))
    n = expand(sum((-1)**k * mu**(s - 1 - k) * diff(q, t, k) for k in range(s)))
    return q, n, expand(mu**s + n.subs(t, 0))
#< closed

r5 = sqrt(5)
NODES = {2: [0, 1], 3: [0, Rational(1, 2), 1], 4: [0, (5 - r5) / 10, (5 + r5) / 10, 1]}
h = symbols("h1:4", positive=True)


@cache
def exact_rule(s):
    """Return b and D by integrating and differentiating the Lagrange polynomials."""
    c, ell = NODES[s], []
    for i in range(s):
        p = 1
        for j in range(s):
            p *= (x - c[j]) / (c[i] - c[j]) if j != i else 1
        ell.append(expand(p))
    b = [simplify(integrate(p, (x, 0, 1))) for p in ell]
    return b, Matrix(s, s, lambda i, j: simplify(diff(ell[j], x).subs(x, c[i])))


def blocks(s, steps):
    """Return DD and the diagonal of BB."""
    b, D = exact_rule(s)
    inverse = D + eye(s)[:, 0] * eye(s)[0, :] / b[0]
    N = len(steps)
    DD = zeros(N * s, N * s)
    for k, step in enumerate(steps):
        DD[k * s:k * s + s, k * s:k * s + s] = inverse / step
        if k:
            DD[k * s, k * s - 1] = -1 / (step * b[0])
    return DD, diag(*[step * b_ for step in steps for b_ in b]), b, D


def zero(what, matrix):
    prove(what, *[expand(e) for e in matrix])


# -- numbers -----------------------------------------------------------------------
def precisely(function):
    """Decorate a function whose last argument is the number of digits."""
    @cache
    def careful(*arguments):
        with mp.workdps(arguments[-1] + 20):
            return function(*arguments)
    return careful


def exactly(number):
    return mpf(int(Rational(number).p)) / int(Rational(number).q)


@precisely
def rule(s, digits):
    """Return c, b, A^(-1) with this number of digits: zeros of P'_{s-1}, barycentric differences."""
    slope = Poly(diff(legendre(s - 1, 2 * t - 1), t), t).all_coeffs()
    inner = mpmath.polyroots([mpf(int(k)) for k in slope], maxsteps=500, extraprec=400) if s > 2 else []
    c = [mpf(0)] + sorted(r.real for r in inner) + [mpf(1)]
    b = [1 / (s * (s - 1) * mpmath.legendre(s - 1, 2 * v - 1)**2) for v in c]
    weight = [mpf(1) / mpmath.fprod(c[i] - c[j] for j in range(s) if j != i) for i in range(s)]
    D = mpmath.matrix(s, s)
    for i in range(s):
        for j in range(s):
            if i != j:
                D[i, j] = weight[j] / weight[i] / (c[i] - c[j])
        D[i, i] = -sum(D[i, j] for j in range(s) if j != i)
    for i in range(s):
        for j in range(s):
            end = (i == j == s - 1) - (i == j == 0)
            claim("(17.2) for every s", abs(b[i] * D[i, j] + b[j] * D[j, i] - end) < mpf(10)**-digits)
    inverse = D.copy()
    inverse[0, 0] += 1 / b[0]
    return c, b, inverse


@precisely
def numerators(s, digits):
    """Return n_i by powers of mu, mu^0 first."""
    c, _, _ = rule(s, digits)
    rows = Poly(closed(s)[1], mu).all_coeffs()[::-1]
    return [[mpmath.polyval([exactly(k) for k in Poly(row, t).all_coeffs()], node) for row in rows]
            for node in c]


def horner(coefficients, value):
    return mpmath.polyval(coefficients[::-1], value)


@precisely
def eigen(s, digits):
    """Return the eigenvalues of A^(-1), upper half plane first, and v, v w^T = P_lambda; (22.9)."""
    c, b, inverse = rule(s, digits)
    d = [exactly(k) for k in Poly(closed(s)[2], mu).all_coeffs()]
    n = numerators(s, digits)
    roots = mpmath.polyroots(d, maxsteps=500, extraprec=400)
    values = sorted([-r for r in roots if r.imag <= 0], key=lambda v: (v.imag, v.real))
    found = []
    for value in values:
        value = value.real if abs(value.imag) < mpf(10)**-digits else value
        v = [horner(n[i], -value) for i in range(s)]
        w = [b[i] * v[s - 1 - i] for i in range(s)]
        product = sum(v[i] * w[i] for i in range(s))
        claim("(22.9) v is an eigenvector", all(
            abs(sum(inverse[i, j] * v[j] for j in range(s)) - value * v[i])
            < mpf(10)**-digits * max(map(abs, v)) * 1000 for i in range(s)))
        found.append((value, mpmath.matrix(s, s)))
        for i in range(s):
            for j in range(s):
                found[-1][1][i, j] = v[i] * w[j] / product
    return found


@precisely
def power(s, beta, digits):
    """Return (A^(-1))^beta."""
    total = mpmath.matrix(s, s)
    for value, P in eigen(s, digits):
        twice = 1 if mpmath.im(value) == 0 else 2
        total += (P * value**beta).apply(lambda e: twice * mpmath.re(e))
    return total


@precisely
def last_coefficient(s, beta, digits):
    """Return the terms of (22.16): A P_{s-1}; |b . W0 A P_{s-1}|; the largest entry of A A P_{s-1}; b . P_{2s-2}; and
    the last one times tanh(0.26)^(s-1)."""
    c, b, inverse = rule(s, digits)
    P = mpmath.matrix([mpmath.legendre(s - 1, 2 * v - 1) for v in c])
    once = mpmath.lu_solve(inverse, P)
    twice = mpmath.lu_solve(inverse, once)
    by_b = lambda v: sum(x * y for x, y in zip(b, v))
    beyond = by_b([mpmath.legendre(2 * s - 2, 2 * v - 1) for v in c])
    return list(once) + [abs(by_b(power(s, beta, digits) * once)), max(map(abs, twice)), beyond,
                         beyond * mpmath.tanh(mpf(26) / 100)**(s - 1)]


@precisely
def stage_values(s, at, digits):
    """Return a(mu) by solving its equations, not by n/d."""
    _, b, inverse = rule(s, digits)
    right = mpmath.matrix(s, 1)
    right[0] = 1 / b[0]
    return mpmath.lu_solve(inverse + at * mpmath.eye(s), right)


@precisely
def end_correction(L, nu, digits, apart=3):
    """Return the c_l of (22.11): sum_l c_l r^(apart l n) = 1/(r^(nu + n) - 1), n = 0, ..., 5, r = e^L."""
    M, right = mpmath.matrix(6, 6), mpmath.matrix(6, 1)
    for n in range(6):
        right[n] = 1 / mpmath.expm1(L * (nu + n))
        for l in range(6):
            M[n, l] = mpmath.exp(apart * L * l * n)
    return mpmath.lu_solve(M, right)


@precisely
def dense_weights(s, theta, digits):
    """Return the weights of (22.18): the integrals of ell_i and of (theta - u) ell_i from 0 to theta."""
    c, _, _ = rule(s, digits)
    once, twice = [], []
    for i in range(s):
        p = [mpf(1)]                            # highest power first
        for j in range(s):
            if j != i:
                p = [e / (c[i] - c[j]) for e in
                     [u - c[j] * v for u, v in zip(p + [0], [0] + p)]]
        p = p[::-1]
        once.append(sum(e * theta**(k + 1) / (k + 1) for k, e in enumerate(p)))
        twice.append(sum(e * theta**(k + 2) / ((k + 1) * (k + 2)) for k, e in enumerate(p)))
    return once + twice


DIGITS = (60, 90)


def doubles(make, *arguments):
    """Return the nearest doubles of a list. They must be the same at both precisions."""
    lists = []
    for digits in DIGITS:
        mp.dps = digits + 20
        lists.append([hexd(Rational(mpmath.nstr(v, digits))) if abs(v) > mpf(10)**-40 else "0"
                      for v in make(*arguments, digits)])
    claim("the nearest doubles at both precisions", lists[0] == lists[1])
    return lists[0]


def braces(values):
    return "{ " + ", ".join(values) + " }"


def prove_all():
    """Run all proofs before anything is printed. Other scripts import only the functions above."""
    mp.dps = 80
    #> determinant
    for s in STAGES:
        q, n, d = closed(s)
        # (mu + D) n = mu^s q. The term n(0) e_1/b_1 turns this into (mu + A^-1) n = d e_1/b_1.
        prove("(22.8) n' + mu n = mu^s q", expand(diff(n, t) + mu * n - mu**s * q))
        prove("(22.8) d", expand(d - sum(binomial(s, i) * factorial(2 * s - 2 - i)
                                         / factorial(s - 2) * mu**i for i in range(s + 1))))
        prove("(22.8) n_s", expand(n.subs(t, 1) - sum(binomial(s - 2, i) * factorial(2 * s - 2 - i)
                                                      / factorial(s - 2) * (-mu)**i for i in range(s - 1))))
        # d divides det(mu + A^-1) n_i for each i; d and n_s have no common factor; both are monic
        claim("(22.8) d is the determinant", gcd(Poly(d, mu), Poly(n.subs(t, 1), mu)).degree() == 0)
    #< determinant

    #> structure
    for s in (2, 3, 4):
        DD, BB, b, D = blocks(s, h)
        S = (BB * DD).applyfunc(simplify)
        claim("(22.1) BB DD has no step in it", not S.free_symbols)
        turn = eye(3 * s)[::-1, :]
        reversed_DD, reversed_BB, _, _ = blocks(s, h[::-1])
        zero("(22.3) S reversed is S transposed", turn * S * turn - S.T)
        zero("(22.3) the adjoint is DD of the reversed mesh, reversed",
             BB.inv() * DD.T * BB - turn * reversed_DD * turn)
        v = Matrix(symbols(f"v:{3 * s}"))
        squares = v[0]**2 + v[3 * s - 1]**2 + sum((v[k * s] - v[k * s - 1])**2 for k in (1, 2))
        prove("(22.4) half a sum of squares", expand((v.T * S * v)[0] - squares / 2))
        #< structure
        # a continuous path of polynomials, from x_0 = v0: DD (x - x_0) is its derivative
        path = [Matrix([v[k * (s - 1) + i] for i in range(s)]) for k in range(3)]
        whole = Matrix([e for X in path for e in X]) - ones(3 * s, 1) * v[0]
        slope = Matrix([e for k, X in enumerate(path) for e in D * X / h[k]])
        zero("(22.1) DD (x - x_0) = v", DD * whole - slope)
        # any v: the path x_k 1 + h A v, x_{k+1} its last stage
        A = (D + eye(s)[:, 0] * eye(s)[0, :] / b[0]).inv().applyfunc(simplify)
        zero("(22.1) A 1 = c, A e_1/b_1 = 1", Matrix.hstack(
            A * ones(s, 1) - Matrix(NODES[s]), A[:, 0] / b[0] - ones(s, 1)))
        start, found = 0, []
        for k in range(3):
            X = ones(s, 1) * start + h[k] * A * v[k * s:k * s + s, :]
            found, start = found + list(X), X[s - 1]
        zero("(22.1) DD^(-1) v", DD * Matrix(found) - v)

    #> forms
    # (22.5): w_k = h N v_k + a w_{k-1,s} solves (sigma + DD) w = v; with p = mu b.a = 1 - R the
    # last stage moves by w <- w - p w + h a.u, u = P B v; and y = sigma w, z = v_e - sigma w.
    # All times d: N is an adjugate, a its first column over b_1.
    step, w, ve, z = symbols("h w v_e z")
    for s in (2, 3, 4):
        b, D = exact_rule(s)
        inverse = D + eye(s)[:, 0] * eye(s)[0, :] / b[0]
        N = (mu * eye(s) + inverse).adjugate().applyfunc(expand)
        d, a, v = closed(s)[2], N[:, 0] / b[0], Matrix(symbols(f"v:{s}"))
        zero("(22.8) d", (mu * eye(s) + inverse) * N - d * eye(s))
        new = step * N * v + a * w
        zero("(22.5) one block row of (sigma + DD) w = v", (mu * eye(s) + inverse) * new
             - eye(s)[:, 0] * w * d / b[0] - step * v * d)
        p = mu * sum(b[i] * a[i] for i in range(s))
        au = lambda f: sum(a[i] * b[i] * f[s - 1 - i] for i in range(s))
        prove("(22.5) the last stage", expand(new[s - 1] - (d * w - p * w + step * au(v))))
        # y = sigma w and z = v_e - sigma w, where sigma = mu/h
        moved = (mu / step * new[s - 1]).subs(w, step * z / mu)
        prove("(22.6)", expand(moved - (d * z - p * z + mu * au(v))))
        moved = d * v[s - 1] - (mu / step * new[s - 1]).subs(w, step * (ve - z) / mu)
        prove("(22.7)", expand(moved - (d * z - p * z + d * (v[s - 1] - ve) - mu * au(v - ones(s, 1) * ve))))
    #< forms

    #> restricted
    # (22.21): -m DD x . DD_+ y - rho DD^a x . DD_+^a y - U(x) - U(y), for any powers:
    # any lower triangular G replaces DD^a, and the restricted variation contains G G.
    m, rho = symbols("m rho")
    U = Function("U")
    for s in (2, 3):
        DD, BB, b, D = blocks(s, h[:2])
        n = 2 * s
        G = Matrix(n, n, lambda i, j: symbols(f"G{i}_{j}") if j // s <= i // s else 0)
        X, Y = Matrix(symbols(f"x:{n}")), Matrix(symbols(f"y:{n}"))
        adjoint = lambda M: BB.inv() * M.T * BB
        action = -(m * ((DD * X).T * BB * adjoint(DD) * Y)[0] + rho * ((G * X).T * BB * adjoint(G) * Y)[0]
                   + sum(BB[i, i] * (U(X[i]) + U(Y[i])) for i in range(n)))
        wanted = m * DD * DD * X + rho * G * G * X
        for i in range(n):      # delta x = delta y; the terms with y are the mirrored equation, so set y = 0
            varied = (diff(action, X[i]) + diff(action, Y[i])).subs({e: 0 for e in Y})
            prove("(22.21)", expand((varied + BB[i, i] * (wanted[i] + diff(U(X[i]), X[i]))).doit()
                                    + BB[i, i] * diff(U(Y[i]), Y[i]).subs(Y[i], 0)))
    #< restricted


    for s in STAGES:
        c, b, inverse = rule(s, 60)
        d = [exactly(k) for k in Poly(closed(s)[2], mu).all_coeffs()[::-1]]
        n = numerators(s, 60)
        for at in (mpf(1) / 1000, mpf(1), mpf(40), mpf(10)**6):
            a = stage_values(s, at, 60)
            claim("(22.8) n/d", all(abs(a[i] - horner(n[i], at) / horner(d, at)) < 1e-50 for i in range(s)))
            claim("(22.5) p", abs(1 - a[s - 1] - at * sum(b[i] * a[i] for i in range(s))) < 1e-50)
            claim("(22.8) det", abs(mpmath.det(inverse + at * mpmath.eye(s)) / horner(d, at) - 1) < 1e-50)
        whole = power(s, 1, 60) - inverse
        half = power(s, mpf(1) / 2, 60)
        claim("(22.9) projectors", mpmath.mnorm(whole) < 1e-50)
        claim("(22.9) (1/2) + (1/2) = 1", mpmath.mnorm(half * half - inverse) < 1e-45)
        # (22.16): the integral of P_{s-1} is 0 at the nodes; A P_{s-1} begins with 1/(s-1) and ends with 0;
        # no entry of A A P_{s-1} exceeds 1/(2 (s-1)^2); and the value that the quadrature gives to P_{2s-2}
        integral = lambda u: mpmath.legendre(s, 2 * u - 1) - mpmath.legendre(s - 2, 2 * u - 1)
        ladder = mpf(26) / 100
        *once, slip, twice, alias, fallen = last_coefficient(s, mpf(0), 60)
        claim("(22.16) int P_{s-1}", all(abs(integral(v)) < 1e-50 for v in c))
        claim("(22.16) A P_{s-1}", abs(abs(once[0]) - mpf(1) / (s - 1)) + abs(once[-1]) < 1e-50)
        claim("(22.16) A A P_{s-1}", s == 2 or abs(twice - mpf(1) / (2 * (s - 1)**2)) < 1e-50)
        claim("(22.16) b . P_{2s-2}", abs(alias - mpf(s) / ((s - 1) * (2 * s - 1)) * mpmath.binomial(4 * s - 4, 2 * s - 2)
                                          / mpmath.binomial(2 * s - 2, s - 1)**2) < 1e-50)
        claim("(22.16) coefficients fall by coth(L) where steps grow by e^(4L)",
              abs(mpmath.coth(ladder) - (lambda z: z + mpmath.sqrt(z * z - 1))(1 + 2 / mpmath.expm1(4 * ladder))) < 1e-50)
        claim("(22.16) no memory of a whole order slips", s < 4 or all(
            last_coefficient(s, mpf(beta), 60)[s] < 1e-45 for beta in (-1, 0, 1)))
    claim("(22.9) traces", all(
        abs(sum(power(s, mpf(-2) / 5, 60)[i, i] for i in range(s)) - mpf(value)) < 1e-14
        for s, value in ((4, "2.1114071119474454"), (6, "2.5765411212565798"), (8, "3.0002105856477434"))))
    # The digits of a prototype, in doubles and long doubles, which shares no code with this script.
    near = lambda found, *digits: all(abs(a - mpf(e)) < mpf(10)**-12 for a, e in zip(found, digits, strict=True))
    values = [value for value, _ in eigen(4, 60)]
    claim("(22.9) eigenvalues", near(sorted(map(mpmath.re, values)), "2.22098003298981", "3.77901996701019")
          and near(sorted(map(mpmath.im, values)), "1.38017652427284", "4.16039144550693"))
    half = power(6, mpf(1) / 2, 60)
    claim("(22.2) a row of W0", near([half[0, j] for j in range(6)], "4.13564415599623", "3.03377634018549", "-1.64363381560008",
                                     "1.05494545053200", "-0.68149661796441", "0.25933494404036"))
    claim("(22.5) a(1)", near(stage_values(4, mpf(1), 60), "0.9985401459854014", "0.7589997884014470", "0.4847958320365092",
                              "0.3678832116788321"))
    claim("(22.11) c(1/2)", near(end_correction(mpf(26) / 100, mpf(1) / 2, 60), "15.6936252692711", "-10.8825646077759",
                                 "2.63163111378275", "-0.248440000367442", "0.00898635862585188", "-0.000100158056912659"))


if __name__ == "__main__":
    prove_all()
    header("verify/variable_steps/variable_steps.py")

    print("\n/* Lobatto's nodes and weights on [0, 1]. */")
    table("ref_rules", "size_t s; double c[8]; double b[8];", [
        [s, braces(doubles(lambda dg: rule(s, dg)[0])), braces(doubles(lambda dg: rule(s, dg)[1]))]
        for s in (6, 8)])

    print("\n/* A^(-1) of Lobatto IIIC, row by row. */")
    table("ref_inverses", "size_t s; double want[64];", [
        [s, braces(doubles(lambda dg: list(rule(s, dg)[2])))] for s in (6, 8)])

    print("\n/* (22.8): d, by powers of mu; n[i * s + j] is the coefficient of mu^j in n_i. */")
    table("ref_numerators", "size_t s; double d[9]; double n[64];", [
        [s, braces([str(int(k)) for k in Poly(closed(s)[2], mu).all_coeffs()[::-1]]),
         braces(doubles(lambda dg: [e for row in numerators(s, dg) for e in row]))] for s in (6, 8)])

    print("\n/* (22.2): W0 = (A^(-1))^beta, row by row. */")
    table("ref_powers", "size_t s; double beta; double want[64];", [
        [s, hexd(beta), braces(doubles(lambda dg: list(power(s, mpf(beta), dg)))), f"beta = {beta}"]
        for s in (6, 8) for beta in (-1.0, -0.9, -0.4, -1e-6, 0.0, 0.02, 0.5, 0.8, 0.98, 1.0)])

    print("\n/* (22.16): A P_{s-1}, |b . W0 A P_{s-1}|, the largest of A A P_{s-1}, b . P_{2s-2},\n * that times tanh(0.26)^(s-1). */")
    table("ref_last", "size_t s; double beta; double want[12];", [
        [s, hexd(beta), braces(doubles(lambda dg: last_coefficient(s, mpf(beta), dg))), f"beta = {beta}"]
        for s in (6, 8) for beta in (-0.9, -0.4, 0.02, 0.5, 0.8, 0.98)])

    print("\n/* (22.5): a(mu), then p = 1 - R = mu b.a. */")
    table("ref_stage_values", "size_t s; double mu; double want[9];", [
        [s, hexd(at), braces(doubles(lambda dg: list(stage_values(s, mpf(at), dg)) + [
            1 - stage_values(s, mpf(at), dg)[s - 1]])), f"mu = {at}"]
        for s in (6, 8) for at in (0.0, 1e-12, 1e-3, 0.3, 1.0, 7.0, 50.0, 2e4, 1e9)])

    print("\n/* (22.11): the end corrections c_l for nodes so many apart on the lattice e^(L q). */")
    table("ref_ends", "size_t apart; double L, nu; double want[6];", [
        [apart, hexd(L), hexd(nu), braces(doubles(lambda dg: list(end_correction(mpf(L), mpf(nu), dg, apart)))),
         f"L = {L}, nu = {nu}"]
        for apart, L in ((3, 0.26), (2, 0.52)) for nu in (0.02, 0.5, 0.7, 1.0, 1.4, 1.98)])

    print("\n/* (22.18): the integrals of ell_i from 0 to theta, then those of (theta - u) ell_i. */")
    table("ref_dense", "size_t s; double theta; double want[16];", [
        [s, hexd(theta), braces(doubles(lambda dg: dense_weights(s, mpf(theta), dg))), f"theta = {theta}"]
        for s in (6, 8) for theta in (0.125, 0.5, 0.9, 1.0)])
