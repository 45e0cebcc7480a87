"""H 22. Runs with variable steps, by the matrix DD^beta itself.

The power of DD is that of variable_steps_power.py, at 100 and 140 digits. Modes, lattices
and quadratures occur only where they are compared with it. Checked, for
meshes with ratios up to 50:
  DD^a DD^b = DD^(a+b); (22.2) the diagonal blocks; (22.3) by parts, for powers;
  (22.4) sym(BB DD^beta) has a Cholesky factor; (22.6), (22.7), (22.10) to (22.13):
  the modes of the program, in 40 digits, on a mesh that grows 2.8-fold and drops;
  (21.13) the energy of form D, every term, and that its damping never adds energy.
Printed: DD^beta v on a mesh; runs of form D (linear spring, four steps); exact
solutions by power series; I(a, S) of the hand-over and the singular part."""
import random
from functools import cache

import mpmath
from mpmath import mp, mpf
from sympy import Rational

from variable_steps import variable_steps as one
from shared.refgen import claim, header, hexd, table
from shared.variable_steps_power import dense, dense_sums, product


rng = random.Random(22)
for s, digits in ((2, 100), (3, 100), (5, 100), (8, 100)):
    steps = tuple(mpf(v) / 1000 for v in (100, 283, 800, 16, 45))
    N, b = len(steps), one.rule(s, digits)[1]
    for beta in (mpf(-7) / 10, mpf(1) / 2, mpf(9) / 10):
        F, H = dense(s, steps, beta, digits), dense(s, steps, beta / 2, digits)
        whole = dense(s, steps, mpf(1), digits)
        size = max(mpmath.mnorm(F[k][k]) for k in range(N))
        mirrored = dense(s, steps[::-1], beta, digits)
        for k in range(N):
            claim("(22.2) the diagonal block", mpmath.mnorm(
                F[k][k] - one.power(s, beta, digits) / steps[k]**beta) < size * mpf(10)**-25)
            for j in range(k + 1):
                claim("orders add", mpmath.mnorm(product(H, H, s, k, j) - F[k][j]) < size * mpf(10)**-25)
                for i in range(s):
                    for l in range(s):
                        adjoint = F[k][j][i, l] * steps[k] * b[i] / (steps[j] * b[l])
                        turned = mirrored[N - 1 - j][N - 1 - k][s - 1 - l, s - 1 - i]
                        claim("(22.3) of a power", abs(adjoint - turned) < size * mpf(10)**-25)
        for k in range(1, N):
            claim("DD^1 is DD", abs(whole[k][k - 1][0, s - 1] * steps[k] * b[0] + 1) < mpf(10)**-25)
        symmetric = mpmath.matrix(N * s, N * s)
        for k in range(N):
            for j in range(k + 1):
                for i in range(s):
                    for l in range(s):
                        symmetric[k * s + i, j * s + l] += steps[k] * b[i] * F[k][j][i, l] / 2
                        symmetric[j * s + l, k * s + i] += steps[k] * b[i] * F[k][j][i, l] / 2
        mpmath.cholesky(symmetric)      # fails if the matrix is not positive definite

# -- modes ---------------------------------------------------------------------------
MESH = [-12, -8, -4, -1, 0, -11, -7, None, -6, -2]      # h = e^(0.26 k); None: a step off the lattice


def steps_of_mesh():
    """Return the steps of the mesh as doubles."""
    mp.dps = 60
    return tuple(mpf(float(mpmath.exp(mpf(26) * k / 100))) if k is not None else mpf(0.09375) for k in MESH)


def stages_of_mesh(s, rough):
    """Return stage values of cos 2t as doubles; or, with rough, multiples of 1/1024 that follow no smooth path."""
    draw, start, stages = random.Random(s), mpf(0), []
    for h in steps_of_mesh():
        stages.append([mpf(draw.randrange(-1024, 1025)) / 1024 if rough
                       else mpf(float(mpmath.cos(2 * (start + h * c)))) for c in one.rule(s, 60)[0]])
        start += h
    return stages


#> modes
def history(s, alpha, steps, stages, v0, L=mpf(26) / 100, low=mpf(13) / 2, top=mpf(20000)):
    """Return H before each step by the modes (22.6), (22.7) on the lattice, with both end corrections, and with modes
    that start late. 40 digits are used, so the error is that of the quadrature."""
    mp.dps = 40
    beta = 2 * alpha - 1
    up = beta > 0
    b = one.rule(s, 40)[1]
    s0 = mpmath.exp(-low) / sum(steps)
    number = int(mpmath.ceil(mpmath.log(top / min(steps) / s0) / L)) + 1
    nodes = [s0 * mpmath.exp(L * q) for q in range(number)]
    factor = mpmath.sinpi(min(abs(beta), 1 - abs(beta))) / mpmath.pi * L
    z, awake, ve, before, H = [mpf(0)] * number, number, v0, None, []
    for h, v in zip(steps, stages):
        Q = next(q for q in range(number) if h * nodes[q] >= top) + 1
        if Q > awake:                                           # (22.13)
            for q in range(awake, Q):
                z[q] = moved(before, before[2] if not up else mpf(0), nodes[q], up, b)
        awake = Q
        omega = [factor * node**beta for node in nodes[:Q]]
        for end, nu in ((0, beta if up else 1 + beta), (Q - 1, (2 if up else 1) - beta)):
            base = omega[end]
            c = one.end_correction(L, nu, 40)                   # (22.11), (22.12)
            if end:
                for l in range(6):
                    omega[end - 3 * l] += factor * nodes[end - 3 * l]**beta * c[l] * mpmath.exp(-3 * L * l * nu)
            else:
                for l in range(6):
                    omega[3 * l] += base * c[l] * (1 if up else mpmath.exp(-3 * L * l))
        sums = [mpf(0)] * s
        for q in range(Q):
            for i, a in enumerate(values(s, h * nodes[q])):
                sums[i] += omega[q] * a * z[q]
        H.append(sums)
        before = (h, v, ve)
        z[:Q] = [moved(before, z[q], nodes[q], up, b) for q in range(Q)]
        ve = v[-1]
    return H


@cache
def denominator(s):
    return [one.exactly(k) for k in one.Poly(one.closed(s)[2], one.mu).all_coeffs()[::-1]]


@cache
def values(s, at):
    """Return a(mu) = n/d of (22.8), in 40 digits."""
    n, det = one.numerators(s, 40), one.horner(denominator(s), at)
    return [one.horner(row, at) / det for row in n]


def moved(step, old, node, up, b):
    """Return one mode after one step, by (22.6), (22.7)."""
    h, v, ve = step
    s, at = len(v), h * node
    a = values(s, at)
    p = at * sum(b[i] * a[i] for i in range(s))
    au = sum(a[i] * b[i] * (v[s - 1 - i] - (ve if up else 0)) for i in range(s))
    return old - p * old + (v[-1] - ve - at * au if up else at * au)
#< modes


#> floor
# Bounds for every step that starts no new modes, and for the steps that do. They bound errors of Y, times h^beta if
# beta > 0. A new mode neglects R(mu) < 3e-6 times the mode one step before.
BOUNDS = {False: (2e-15, 4e-12), True: (4e-12, 2e-10)}
for s, alpha, rough in ((4, 0.3, False), (6, 0.05, False), (8, 0.3, False), (6, 0.75, False),
                        (8, 0.75, False), (8, 0.95, False), (8, 0.95, True)):
    steps, stages, v0 = steps_of_mesh(), stages_of_mesh(s, rough), mpf(1)
    alpha = mpf(alpha)
    want = dense_sums(s, alpha, steps, stages, v0, 100)
    got = history(s, alpha, steps, stages, v0)
    beta, ve = 2 * alpha - 1, v0
    for k, (h, v) in enumerate(zip(steps, stages)):
        present = one.power(s, beta, 60) * mpmath.matrix([e - (ve if beta > 0 else 0) for e in v]) / h**beta
        off = max(abs(present[i] + got[k][i] - want[k][i]) * min(h, 1)**max(beta, 0) for i in range(s))
        claim(f"modes and DD^beta, s = {s}, alpha = {alpha}, step {k}: {off}",
              off < BOUNDS[rough][k > 0 and h < steps[k - 1]])
        ve = v[-1]
#< floor


# -- runs ----------------------------------------------------------------------------
#> run
def run(form, s, alpha, steps, m, c, rho, F, x0, p0, digits):
    """Run form D, (22.14), or form M, (22.15), with U = c x^2/2. Return the rows x, p, and the stages."""
    beta = 2 * alpha - 1
    power = dense(s, steps, beta, digits)
    nodes, b, inverse = one.rule(s, digits)
    D = inverse.copy()
    D[0, 0] -= 1 / b[0]
    A = mpmath.inverse(inverse)
    x, p, rows, kept = mpf(x0), mpf(p0), [], []
    g, shift, ones = [], (p0 / m if beta > 0 else mpf(0)), mpmath.ones(s, 1)
    for k, h in enumerate(steps):
        past = mpmath.matrix(s, 1)
        for j in range(k):
            past += power[k][j] * g[j]
        now = power[k][k]
        if form == "D":
            L = inverse * (m / h) + rho * now + c * h * A
            free = ones * x + mpmath.matrix(nodes) * (h * p / m)
            delta = mpmath.lu_solve(L, ones * F - c * free - rho * (past + now * ones * (p / m - shift)))
            V, X = ones * (p / m) + delta, free + h * A * delta
        else:
            L, right = mpmath.matrix(s, s), mpmath.matrix(s, 1)
            K = D.T * mpmath.diag(b) * D
            coupled = now * D / h
            for i in range(s):
                for j in range(s):
                    L[i, j] = m / h * K[i, j] - h * b[i] * (rho * coupled[i, j] + (c if i == j else 0))
                right[i] = h * b[i] * (c * x + rho * (past - now * ones * shift)[i] - F) - (p if i == 0 else 0)
            inner = mpmath.lu_solve(L[:s - 1, 1:], right[:s - 1])
            e = mpmath.matrix([0] + list(inner))
            V, X = D * e / h, ones * x + e
        g.append(V - ones * shift)
        Y = past + now * g[-1]
        kept.append((V, X, Y, x, p))
        if form == "D":
            x, p = X[s - 1], m * V[s - 1]
        else:
            p -= sum(h * b[i] * (c * X[i] + rho * Y[i] - F) for i in range(s))
            x = X[s - 1]
        rows.append((x, p))
    return rows, kept
#< run


#> energy
# (21.13): E_N = E_0 - the squared jumps of V and X - the work of the damping.
for s, alpha, p0 in ((2, "0.3", 1), (3, "0.45", -2), (4, "0.8", 0), (6, "0.2", 1), (8, "0.7", 0)):
    mp.dps = 100
    steps = tuple(mpf(rng.randrange(10, 4000)) / 1000 for _ in range(6))
    m, c, rho, b = mpf(2), mpf(3), mpf(5), one.rule(s, 100)[1]
    rows, kept = run("D", s, mpf(alpha), steps, m, c, rho, mpf(0), mpf(1), mpf(p0), 100)
    energy = lambda x, p: p * p / (2 * m) + c * x * x / 2
    lost = work = mpf(0)
    for (x, p), (V, X, Y, x_, p_), h in zip(rows, kept, steps):
        lost += m / 2 * (V[0] - p_ / m)**2 + c / 2 * (X[0] - x_)**2
        work += rho * h * sum(b[i] * V[i] * Y[i] for i in range(s))
        claim("(21.13)", abs(energy(x, p) + lost + work - energy(mpf(1), mpf(p0))) < 1e-25)
        claim("(21.13) the damping only takes", work >= 0)
        claim("(21.13) what is lost", energy(x, p) <= energy(mpf(1), mpf(p0)))
#< energy


# -- exact solutions -----------------------------------------------------------------
#> series
def exact(alpha, m, c, rho, F, x0, v0, past, at, digits):
    """Return x and p of m x'' + c x + rho D^(2 alpha) x = F by powers of t^(1/q), alpha = n/(2 q)."""
    mp.dps = digits + 60
    two, q = 2 * alpha, (2 * alpha).q
    shift, most = 2 * q - two.p, 240 * q
    a, ratios = [mpf(0)] * most, {}
    a[0] = mpf(x0)
    remembered = lambda j: past == "rl" or not (j == 0 or (j == q and two > 1))
    for j in range(1, most):
        if j == q:
            a[j] += mpf(v0)
        elif j > q or j >= shift:
            total = mpf(F) * (j == 2 * q)
            total -= c * a[j - 2 * q] if j >= 2 * q else 0
            if j >= shift and remembered(j - shift):
                if j - q in ratios and j > 2 * q:   # Gamma((j - shift)/q + 1) / Gamma(j/q - 1)
                    ratios[j] = ratios[j - q] * (j - shift) / (j - 2 * q)
                else:
                    ratios[j] = mpmath.gamma(mpf(j - shift) / q + 1) * mpmath.rgamma(mpf(j) / q - 1)
                total -= rho * a[j - shift] * ratios[j]
            a[j] += total * q**2 / (m * j * (j - q))
    root = mpmath.root(at, q)
    x = mpmath.polyval(a[::-1], root)
    slope = mpmath.polyval([j * e / q for j, e in enumerate(a)][:0:-1], root) * root**(1 - q)
    return x, m * slope
#< series


def hand_over(a, S, digits):
    """Return I(a, S) = int_0^1 e^(-S(1-u)) u^(a-1) du."""
    mp.dps = digits + 20
    return mpmath.exp(-S) * mpmath.hyp1f1(a, a + 1, S) / a


def doubles(make):
    lists = []
    for digits in (100, 140):
        mp.dps = digits + 30
        lists.append([hexd(Rational(mpmath.nstr(v, 40))) for v in make(digits)])
    claim("the nearest doubles at both precisions", lists[0] == lists[1])
    return lists[0]


#> falling
# (22.23): v = v0 E_e(-z), z = (rho/m) t^e, e = 2 - 2 alpha, has the terms of (22.19). Long after t1, v / v0 =
# sum_{n>=1} -(-1/z)^n / Gamma(1 - n e), up to the first term that is left out. The modes that receive this v agree
# with those of (22.19): int e^(-S(1-u)) dv by both expansions.
mp.dps = 120
into_mode = lambda a, S: mpmath.exp(-S) * mpmath.hyp1f1(a, 1 + a, S) / a   # I(a, S), all a
for gap, z, J in ((mpf(27) / 100, mpf(3), 60), (mpf(41) / 100, mpf(4), 26)):
    grown = [(-z)**k * mpmath.rgamma(1 + k * gap) for k in range(1500)]
    left = [-(-1 / z)**n * mpmath.rgamma(1 - n * gap) for n in range(J + 1)]
    bound = 4 * z**-(J + 1) * mpmath.gamma((J + 1) * gap)
    claim("(22.23) falling powers", abs(sum(grown) - sum(left[1:])) < bound < 1e-8)
    felt = [(d, k * gap) for k, d in enumerate(grown) if k and abs(d) > mpf(10)**-40]     # a I(a, S) < 1
    for S in (mpf(1) / 10, mpf(3), mpf(20)):
        told = mpmath.exp(-S) + sum(d * a * into_mode(a, S) for d, a in felt)
        by_falling = sum(-d * n * gap * into_mode(-n * gap, S) for n, d in enumerate(left) if n)
        claim("(22.20) for falling powers", abs(told - by_falling) < 1e3 * bound)
# Euler's transformation about P: c_n times w_n, the probability of more than n heads in N + 1 throws.
for p, N in ((Rational(3, 5), 7), (Rational(1, 3), 12)):
    for n in range(N + 1):
        heads = sum(one.binomial(N + 1, k) * (1 - p)**k * p**(N + 1 - k) for k in range(n + 1))
        claim("(22.23) w_n", sum(one.binomial(k, n) * (1 - p)**(n + 1) * p**(k - n) for k in range(n, N + 1)) == 1 - heads)
gap, P, N = mpf(1) / 500, mpf(5) / 4, 14
weight = lambda n: sum(mpmath.binomial(k, n) * (P / (1 + P))**(k - n) for k in range(n, N + 1)) / (1 + P)**(n + 1)
for t in (mpf(10)**-30, mpf(10)**-12, mpf(1) / 10):
    z = P * t**gap      # E(-z) has the transform s^(gap - 1) / (s^gap + P), inverted by Talbot's contour
    turned = sum((-z)**n * weight(n) * mpmath.rgamma(1 + n * gap) for n in range(N + 1))
    direct = mpmath.invertlaplace(lambda s: s**(gap - 1) / (s**gap + P), t, method="talbot", degree=60)
    claim("(22.23) by Euler", abs(turned - direct) < 2 * (P / (1 + P) * (1 - z / P + mpf(1) / 50))**(N + 1) + mpf(10)**-25)
#< falling


if __name__ == "__main__":
    header("verify/variable_steps/variable_steps_runs.py")

    print("""
/* Y = DD^beta (v - [beta > 0] v0), beta = 2 alpha - 1, v0 = 1, on ten steps h: all but the
 * eighth are e^(0.26 k) for whole k, at most four apart when h grows, with a drop by 17.5.
 * v and Y: stage i of step k is entry k s + i. v is cos 2t, or rough. */""")
    rows = []
    for s, alpha, rough in [(s, alpha, False) for s in (6, 8) for alpha in (0.05, 0.3, 0.75, 0.9)] + [
            (6, 0.3, True), (6, 0.75, True), (8, 0.4999, False)]:
        steps, stages = steps_of_mesh(), stages_of_mesh(s, rough)
        Y = doubles(lambda dg: [e for row in dense_sums(s, mpf(alpha), steps, stages, mpf(1), dg) for e in row])
        rows.append([s, hexd(alpha), int(rough), one.braces([hexd(Rational(float(h))) for h in steps]),
                     one.braces([hexd(Rational(float(e))) for row in stages for e in row]),
                     one.braces(Y), f"alpha = {alpha}"])
    table("ref_mesh", "size_t s; double alpha; int rough; double h[10]; double v[80]; double Y[80];", rows)

    print("""
/* Form D, m = rho = c = 1, F = 8, x0 = 1/4, p0 = 1/2, Caputo; steps 0.5, 0.8, 0.1, 0.1: x and
 * p after the first, the third and the fourth. */""")
    def four_steps(form, s, alpha, digits):
        steps = tuple(mpf(h) for h in (0.5, 0.8, 0.1, 0.1))
        found = run(form, s, mpf(alpha), steps, mpf(1), mpf(1), mpf(1), mpf(8), mpf(1) / 4, mpf(1) / 2, digits)[0]
        return found[0] + found[2] + found[3]
    true = exact(Rational(3, 4), 1, 1, 1, 8, mpf(1) / 4, mpf(1) / 2, "caputo", mpf(14) / 10, 60)
    for form in "DM":
        claim(f"(22.14), (22.15): form {form} ends at the exact motion", all(
            abs(a - e) < 1e-9 for a, e in zip(four_steps(form, 8, 0.75, 100)[2:4], true)))
    # The digits of a prototype, in doubles, by modes on two lattices. It shares no code with this script.
    known = [("M", 4, .75, "1.15543276757847", "2.86188734480110", "4.69981683959738", "4.57990364800413"),
             ("M", 8, .75, "1.15542862981983", "2.86076051985954", "4.69981857242156", "4.57984883723346"),
             ("M", 8, .30, "1.34177627725210", "3.57782797145093", "5.27400172556916", "4.13514953824375"),
             ("D", 4, .75, "1.15547215842212", "2.86021012950984", "4.69982621154874", "4.57982157029260"),
             ("D", 8, .75, "1.15542875545055", "2.86073369172746", "4.69981857247733", "4.57984883609732"),
             ("D", 8, .30, "1.34177627712922", "3.57782798008120", "5.27400172556884", "4.13514953824866")]
    for form, s, alpha, *digits in known:
        claim(f"(22.14), (22.15): form {form} of a prototype, s = {s}", all(
            abs(a - mpf(e)) < mpf(10)**-12 for a, e in zip(four_steps(form, s, alpha, 100), digits)))
    claim("the exact motion of a prototype", abs(true[0] - mpf("4.69981857243382")) + abs(true[1] - mpf("4.57984883661288")) < mpf(10)**-12)
    for alpha, x0, v0, digits in ((Rational(1, 5), 1, .5, "-0.00285877135595053"), (Rational(2, 5), 1, .5, "0.0003661921275045863"),
                                  (Rational(3, 4), 0, 1, "0.02447587880935065")):
        claim("Riemann and Liouville's motion of a prototype", abs(
            exact(alpha, 1, 1, 1, 0, mpf(x0), mpf(v0), "rl", mpf(20), 60)[0] - mpf(digits)) < mpf(10)**-15)
    table("ref_runs", "size_t s; double alpha; double want[6];", [
        [s, hexd(alpha), one.braces(doubles(lambda dg: four_steps("D", s, alpha, dg))), f"alpha = {alpha}"]
        for alpha in (0.1, 0.3, 0.5, 0.75, 0.9) for s in (6, 8)])

    print("""
/* Exact x(t), p(t) by power series, m = rho = c = 1; past: 'c' Caputo, 'r' Riemann-Liouville. */""")
    Q = Rational
    rows = []
    for alpha, F, x0, v0, past, at in ((Q(3, 4), 8, Q(1, 4), Q(1, 2), "caputo", "1.4"), (Q(3, 10), 8, Q(1, 4), Q(1, 2), "caputo", "1.4"),
                                       (Q(3, 4), 8, 0, 0, "caputo", "20"), (Q(1, 5), 0, 1, Q(1, 2), "rl", "20"),
                                       (Q(2, 5), 0, 1, Q(1, 2), "rl", "20"), (Q(1, 20), 0, 1, Q(1, 2), "rl", "20"),
                                       (Q(3, 4), 0, 0, 1, "rl", "20"), (Q(9, 10), 0, 0, 1, "rl", "20")):
        value = doubles(lambda dg: exact(alpha, 1, 1, 1, F, one.exactly(x0), one.exactly(v0), past, mpf(float(at)), dg // 2))
        rows.append([hexd(float(alpha)), F, hexd(x0), hexd(v0), f"'{past[0]}'", hexd(float(at)), *value, f"alpha = {alpha}, t = {at}"])
    table("ref_exact", "double alpha, F, x0, v0; char past; double t, x, p;", rows)

    print("\n/* (22.20): I(a, S) = int_0^1 e^(-S(1-u)) u^(a-1) du. */")
    table("ref_hand_over", "double a, S, want;", [
        [hexd(a), hexd(S), *doubles(lambda dg: [hand_over(mpf(a), mpf(S), dg)]), f"a = {a}, S = {S}"]
        for a in (0.02, 0.2, 0.5, 1.0, 1.4, 3.7) for S in (0.0, 1e-3, 1.0, 12.0, 29.0, 31.0, 300.0, 1e6)])
