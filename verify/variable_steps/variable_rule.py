"""The constants of src/stages/variable_rule.c, from their definitions.   [H 22]

Unlike the other proofs this one prints a header of the library's: every constant of the
method with variable steps is computed here, correct to the last bit."""
from textwrap import wrap

from mpmath import mp, mpf, matrix, eye, diag, legendre, polyroots, taylor, log, exp

from shared.refgen import claim, header

SPACING = mpf(26) / 100  # of the lattice: steps and modes are powers of exp(SPACING)
ENDS = 6                 # corrections at each end of the modes,
APART = {1: 3, 2: 2}     # distance of correction nodes if every, or every second, lattice point is a mode


def rule(s):
    """Return c, b, D of the s Lobatto nodes of [0, 1].                               (17.1)"""
    slope = taylor(lambda x: legendre(s - 1, x), 0, s - 1)
    slope = [n * a for n, a in enumerate(slope)][:0:-1]  # coefficients of P_{s-1}', from the highest power on
    inner = sorted(mp.re(z) for z in polyroots(slope, maxsteps=500, extraprec=400))
    x = [mpf(-1)] + inner + [mpf(1)]
    claim("the nodes are different", all(x[i + 1] - x[i] > mpf(1) / 100 for i in range(s - 1)))
    c = [(1 + t) / 2 for t in x]
    b = [1 / (s * (s - 1) * legendre(s - 1, t) ** 2) for t in x]
    D = matrix(s, s)
    for i in range(s):
        for j in range(s):
            if i != j:
                top = mp.fprod(c[i] - c[l] for l in range(s) if l not in (i, j))
                D[i, j] = top / mp.fprod(c[j] - c[l] for l in range(s) if l != j)
        D[i, i] = mp.fsum(1 / (c[i] - c[l]) for l in range(s) if l != i)
    return c, b, D


def resolvent(s, M, b):
    """Return the coefficients of det(mu + M), then those of the s numerators of (mu + M)^-1 e_1 / b_1 = sum_n mu^n
    N_n e_1 / b_1 / det(mu + M), by Faddeev and LeVerrier."""
    N, det, powers = eye(s), [mpf(0)] * s + [mpf(1)], {}
    for n in range(s - 1, -1, -1):
        powers[n] = [N[i, 0] / b[0] for i in range(s)]
        MN = M * N
        det[n] = mp.fsum(MN[i, i] for i in range(s)) / (s - n)
        N = det[n] * eye(s) - MN
    claim("Cayley and Hamilton", mp.norm(N, mp.inf) < mpf(10) ** (30 - mp.dps))
    claim("det(mu + A^-1) has whole coefficients", all(abs(d - mp.nint(d)) < mpf(10) ** (30 - mp.dps) for d in det))
    return [mp.nint(d) for d in det], powers


def constants(s):
    """Return a dictionary: name -> list, or list of lists; matrices are stored column by column."""
    c, b, D = rule(s)
    M = D.copy()
    M[0, 0] += 1 / b[0]
    A = M ** -1
    claim("A 1 = c, and the last row of A is b",
          max(abs(mp.fsum(A[i, :]) - c[i]) + abs(A[s - 1, i] - b[i]) for i in range(s)) < mpf(10) ** (20 - mp.dps))
    det, powers = resolvent(s, M, b)
    # Form M, (17.8) without damping: X = x + c h v + h^2 R f, R = -(K reduced)^-1 B.
    K = D.T * diag(b) * D
    reduced = matrix([[K[i, j] for j in range(1, s)] for i in range(s - 1)]) ** -1
    R = matrix(s, s)
    for i in range(1, s):
        for j in range(s - 1):
            R[i, j] = -reduced[i - 1, j] * b[j]
    claim("R 1 = c^2 / 2", max(abs(mp.fsum(R[i, :]) - c[i] ** 2 / 2) for i in range(s)) < mpf(10) ** (20 - mp.dps))
    # Legendre coefficients of the polynomial through s values at c.
    P = matrix([[(2 * n + 1 if n < s - 1 else s - 1) * b[i] * legendre(n, 2 * c[i] - 1) for i in range(s)] for n in range(s)])
    back = matrix([[legendre(n, 2 * c[i] - 1) for n in range(s)] for i in range(s)])
    claim("they give the values back", mp.norm(back * P - eye(s), mp.inf) < mpf(10) ** (20 - mp.dps))
    # The contribution of the last Legendre coefficient of x'' to V and to X, (22.16).
    top = matrix([legendre(s - 1, 2 * t - 1) for t in c])
    last, stages = A * top, A * (A * top)
    claim("(22.16) its integral is 0 at all nodes",
          all(abs(legendre(s, 2 * t - 1) - legendre(s - 2, 2 * t - 1)) < mpf(10) ** (20 - mp.dps) for t in c))
    claim("(22.16) no stage of X moves more than the first", abs(stages[0]) == max(abs(t) for t in stages))
    claim("(22.16) 1/(s - 1) and 1/(2 (s - 1)^2)", abs(abs(last[0]) - mpf(1) / (s - 1))
          + abs(abs(stages[0]) - mpf(1) / (2 * (s - 1) ** 2)) < mpf(10) ** (20 - mp.dps))
    # M = sum lambda P_lambda, P_lambda = v w^T, w = B (v backwards), w^T v = 1.
    roots = [-z for z in polyroots(det[::-1], maxsteps=500, extraprec=400)]
    upper = sorted((z for z in roots if mp.im(z) > 0), key=mp.im)
    claim("all eigenvalues are complex", 2 * len(upper) == s)
    vectors, square = [], matrix(s, s)
    for z in upper:
        v = [mp.fsum(powers[n][i] * (-z) ** n for n in range(s)) for i in range(s)]
        size = mp.sqrt(mp.fsum(b[i] * v[s - 1 - i] * v[i] for i in range(s)))
        v = [t / size for t in v]
        vectors.append(v)
        for i in range(s):
            for j in range(s):
                square[i, j] += 2 * mp.re(z * z * v[i] * b[j] * v[s - 1 - j])
    claim("the projectors give M^2", mp.norm(square - M * M, mp.inf) < mpf(10) ** (30 - mp.dps))
    columns = lambda Z: [[Z[i, l] for i in range(s)] for l in range(s)]
    return {"c": c, "b": b, "A": columns(A), "inverse": columns(M), "form_m": columns(R * M), "legendre": columns(P * M),
            "last": list(last), "stage": abs(stages[0]), "alias": alias(6),
            "det": det, "numerator": [[powers[n][i] for n in range(s)] for i in range(s)],
            "lambda_re": [mp.re(z) for z in upper], "lambda_im": [mp.im(z) for z in upper],
            "log_modulus": [log(abs(z)) for z in upper], "angle": [mp.arg(z) for z in upper],
            "re": [[mp.re(t) for t in v] for v in vectors], "im": [[mp.im(t) for t in v] for v in vectors]}


def alias(s):
    """Return the constant of (22.16): the value that the weights give to P_{2s-2}, whose integral is 0, times the
    decay of the Legendre coefficients over s - 1 degrees. For this decay each step is exp(4 SPACING) times the step
    before it, and x'' is singular where the steps began. The Bernstein ellipse through this point has coth(SPACING)
    as the sum of its semi-axes. The constant is that of six stages; eight stages have a 19th of it."""
    c, b, _ = rule(s)
    q = mp.fsum(b[i] * legendre(2 * s - 2, 2 * c[i] - 1) for i in range(s))
    claim("(22.16) of P_{2s-2}", abs(q - mpf(s) / ((s - 1) * (2 * s - 1)) * mp.binomial(4 * s - 4, 2 * s - 2)
                                     / mp.binomial(2 * s - 2, s - 1) ** 2) < mpf(10) ** (20 - mp.dps))
    far = 1 + 2 / (exp(4 * SPACING) - 1)  # from the middle of the step to the singular point, in half steps
    claim("(22.16) coth", abs(far + mp.sqrt(far ** 2 - 1) - mp.coth(SPACING)) < mpf(10) ** (20 - mp.dps))
    return q * mp.tanh(SPACING) ** (s - 1)


def ends(every):
    """Return the inverse of the matrix r^{APART l n}: c_l = sum_n inverse_ln / (r^{nu + n} - 1)."""
    r = exp(every * SPACING)
    V = matrix([[r ** (APART[every] * l * n) for l in range(ENDS)] for n in range(ENDS)])
    inverse = V ** -1
    return [[inverse[l, n] for n in range(ENDS)] for l in range(ENDS)]


def at(digits, make):
    mp.dps = digits
    return make()


def literals(value):
    """Return numbers at two precisions as C literals, if both give the same doubles."""
    first, second = value
    if isinstance(first, (list, tuple)):
        return "{ " + ", ".join(literals(pair) for pair in zip(first, second)) + " }"
    x = float(first)
    claim("two precisions give one double", x == float(second) or abs(first) < mpf(10) ** -40)
    return "0" if abs(first) < mpf(10) ** -40 else repr(int(x) if x == int(x) and abs(x) < 2 ** 53 else x)


header("verify/variable_steps/variable_rule.py")
print("\n/* Included by variable_rule.c: fvi_variable_rule by its fields, and the ends. */")
print(f"\n#define FVI_SPACING {float(SPACING)!r}")
print("\nstatic const fvi_variable_rule rules[] = {")
for s in (6, 8):
    pair = [at(digits, lambda: constants(s)) for digits in (80, 120)]
    print(f"{{ .s = {s},")
    for name in pair[0]:
        value = literals((pair[0][name], pair[1][name]))
        value = "{ " + value + " }" if name in ("A", "inverse", "form_m", "legendre") else value
        print("\n".join(wrap(f"    .{name} = {value},", 96, subsequent_indent=" " * 8)))
    print("},")
print("};\n")
both = [at(digits, lambda: [ends(every) for every in APART]) for digits in (80, 120)]
print("\n".join(wrap("static const double ends[][%d][%d] = " % (ENDS, ENDS) + literals(both) + ";",
                     96, subsequent_indent=" " * 4)))
