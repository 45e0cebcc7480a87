"""The eigenvalues of A^{-1} of Lobatto IIIC, and projectors, from their definitions.   [H 17]

This proof prints a header of the library's. For s = 6 and 8 variable_rule_ref.h has the same."""
from textwrap import wrap

from mpmath import mp, mpc, mpf, matrix, legendre, polyroots, taylor

from shared.refgen import claim, header

STAGES = (2, 3, 4, 5, 7)


def rule(s):
    """Return b and D of the s Lobatto nodes of [0, 1].                               (17.1)"""
    slope = taylor(lambda x: legendre(s - 1, x), 0, s - 1)
    slope = [n * a for n, a in enumerate(slope)][:0:-1]  # coefficients of P_{s-1}', from the highest power on
    inner = sorted(mp.re(z) for z in polyroots(slope, maxsteps=500, extraprec=400)) if s > 2 else []
    c = [(1 + t) / 2 for t in [mpf(-1)] + inner + [mpf(1)]]
    b = [1 / (s * (s - 1) * legendre(s - 1, 2 * t - 1) ** 2) for t in c]
    D = matrix(s, s)
    for i in range(s):
        for j in range(s):
            others = [l for l in range(s) if l not in (i, j)]
            D[i, j] = mp.fsum(1 / (c[i] - c[l]) for l in others) if i == j else (
                mp.fprod(c[i] - c[l] for l in others) / mp.fprod(c[j] - c[l] for l in range(s) if l != j))
    return b, D


def eigenvalues(s):
    """Return 1/A: the zeros of det(1 - y A), the denominator of Padé's approximation (s - 2, s) of exp y."""
    f = mp.factorial
    return polyroots([(-1) ** j * f(2 * s - 2 - j) * f(s) / (f(2 * s - 2) * f(j) * f(s - j)) for j in range(s, -1, -1)],
                     maxsteps=500, extraprec=400)


def pairs(s):
    """Return lambda and v of those eigenvalues with Im >= 0. v w^T with w_i = b_i v_{s-1-i} is the projector."""
    b, D = rule(s)
    M = D.copy()
    M[0, 0] += 1 / b[0]                                                       # (17.3)
    found, unit, square = [], matrix(s, s), matrix(s, s)
    for z in sorted((z for z in eigenvalues(s) if mp.im(z) > -mpf(10) ** (20 - mp.dps)), key=mp.im):
        z = mpc(mp.re(z), 0) if abs(mp.im(z)) < mpf(10) ** (20 - mp.dps) else z
        rows = M - z * mp.eye(s)
        rest = mp.lu_solve(rows[: s - 1, : s - 1], -rows[: s - 1, s - 1])     # v_s = 1
        v = [rest[i] for i in range(s - 1)] + [mpf(1)]
        claim("an eigenvector", abs(mp.fsum(rows[s - 1, i] * v[i] for i in range(s))) < mpf(10) ** (30 - mp.dps))
        size = mp.sqrt(mp.fsum(b[i] * v[s - 1 - i] * v[i] for i in range(s)))
        v = [mpc(t / size) for t in v]
        found.append((z, v))
        twice = 1 if mp.im(z) == 0 else 2
        for i in range(s):
            for j in range(s):
                unit[i, j] += twice * mp.re(v[i] * b[j] * v[s - 1 - j])
                square[i, j] += twice * mp.re(z * z * v[i] * b[j] * v[s - 1 - j])
    claim("the projectors are all of them", mp.norm(unit - mp.eye(s), mp.inf) < mpf(10) ** (30 - mp.dps))
    claim("and give A^-2", mp.norm(square - M * M, mp.inf) < mpf(10) ** (30 - mp.dps))
    claim("all eigenvalues have positive real parts", all(mp.re(z) > 0 for z, _ in found))
    return [[mp.re(z), mp.im(z)] + [part(t) for t in v for part in (mp.re, mp.im)] for z, v in found]


def at(digits, s):
    mp.dps = digits
    return pairs(s)


def literal(first, second):
    claim("two precisions give one double", float(first) == float(second) or abs(first) < mpf(10) ** -40)
    return "0" if abs(first) < mpf(10) ** -40 else repr(float(first))


header("verify/lobatto/lobatto_eigenvalues.py")
print("\n/* Included by lobatto_eigenvalues.c: of each lambda its parts, then those of v. */")
for s in (6, 8):
    at(60, s)  # check the claims for this s without printing
for s in STAGES:
    rows = [", ".join(map(literal, one, two)) for one, two in zip(at(60, s), at(90, s))]
    print(f"\nstatic const double pairs_{s}[][{2 + 2 * s}] = {{")
    for row in rows:
        print("\n".join(wrap("{ " + row + " },", 96, initial_indent="    ", subsequent_indent="      ")))
    print("};")
