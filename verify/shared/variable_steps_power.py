"""The power DD^beta of the matrix of (22.1) for steps of any length, and its product with given stages.

The power is taken as for any triangular matrix, by Parlett's recurrence in the eigenvectors of A^(-1). No modes,
lattices or quadratures occur here."""
from functools import cache
from operator import mul

import mpmath
from mpmath import mp, mpf

from variable_steps import variable_steps as one


# Sums of products are taken in integers, in units of 2^-(prec + 100), as lists of real and of imaginary parts.
def parts(row):
    whole = lambda e: int(mpmath.ldexp(e, mp.prec + 100))
    return [whole(mpmath.re(e)) for e in row], [whole(mpmath.im(e)) for e in row]


def dot(a, b):
    total = lambda u, v: sum(map(mul, u, v))
    return (total(a[0], b[0]) - total(a[1], b[1]) >> mp.prec + 100,
            total(a[0], b[1]) + total(a[1], b[0]) >> mp.prec + 100)


def real_dot(a, b):
    return mpmath.ldexp(sum(map(mul, a[0], b[0])) - sum(map(mul, a[1], b[1])), -2 * (mp.prec + 100))


@cache
def eigen(s, digits):
    """Return A^(-1) = V diag(lam) W. The vectors of conjugate eigenvalues are conjugate, so only the first `own` rows
    are computed. twin[e] is the conjugate of e; if e is real, it is e itself and counts half."""
    found = one.eigen(s, digits)
    upper = [e for e, (value, _) in enumerate(found) if mpmath.im(value) > 0]
    pairs = found + [(mpmath.conj(found[e][0]), found[e][1].apply(mpmath.conj)) for e in upper]
    own = len(found)
    twin = [own + upper.index(e) if e in upper else e for e in range(own)] + upper
    half = [mpf(1) / 2 if twin[e] == e else mpf(1) for e in range(own)]
    # P = v w^T: v is a column of P, w^T is a row divided by the common entry
    V = [[P[i, 0] for i in range(s)] for _, P in pairs]
    W = [[P[0, j] / P[0, 0] for j in range(s)] for _, P in pairs]
    left = [parts([2 * half[a] * V[a][i] for a in range(own)]) for i in range(s)]
    right = [parts(column) for column in zip(*W)]
    return [value for value, _ in pairs], V, W, own, twin, half, left, right


def apart(steps, digits):
    """Return the exact steps, each moved by 10^-30 of itself (at 140 digits by 10^-40), so that no two eigenvalues
    are equal."""
    return [mpf(h) * (1 + k * mpf(10)**(-30 if digits < 140 else -40)) for k, h in enumerate(steps)]


@cache
def gaps(s, steps, digits):
    """Return 1 / (lam_e / h_j - lam_a / h_k), row by row."""
    lam, own, hs = eigen(s, digits)[0], eigen(s, digits)[3], apart(steps, digits)
    return {(k, j): [list(zip(*parts([1 / (v / hs[j] - lam[a] / hs[k]) for v in lam]))) for a in range(own)]
            for k in range(len(hs)) for j in range(k)}


#> parlett
@cache
def modal(s, steps, beta, digits):
    """Return the blocks F[k][j] of DD^beta in the eigenvectors of A^(-1), own rows only."""
    mp.dps = digits + 30
    bits, hs = mp.prec + 100, apart(steps, digits)
    lam, V, W, own, twin, half, _, _ = eigen(s, digits)
    b, between = one.rule(s, digits)[1], gaps(s, steps, digits)
    g, f = [w[0] / b[0] for w in W], [v[s - 1] for v in V]   # the rows of e_1/b_1 and of e_s^T
    all_g, own_f = parts(g), parts([h * v for h, v in zip(half, f)])
    blocks = []
    for k, h in enumerate(hs):
        row = {k: [parts([lam[a]**beta / h**beta if a == e else mpf(0) for e in range(s)]) for a in range(own)]}
        here = list(zip(*parts([v / h for v in g[:own]])))
        for j in range(k - 1, -1, -1):
            above = [dot(own_f, column) for column in
                     zip(zip(*(re for re, _ in blocks[k - 1][j])), zip(*(im for _, im in blocks[k - 1][j])))]
            past = [(re + above[e][0], im - above[e][1]) for e, (re, im) in zip(twin, above)]
            there, block = list(zip(*parts([v / hs[j + 1] for v in f]))), []
            for a in range(own):        # block (k, j) of F DD = DD F
                (n, m), (u, v), entries = dot(row[j + 1][a], all_g), here[a], []
                for (p, q), (x, y), (c, d) in zip(there, past, between[k, j][a]):
                    re, im = n * p - m * q - u * x + v * y >> bits, n * q + m * p - u * y - v * x >> bits
                    entries.append((re * c - im * d >> bits, re * d + im * c >> bits))
                block.append(tuple(map(list, zip(*entries))))
            row[j] = block
        blocks.append(row)
    return blocks
#< parlett


@cache
def whole_dense(s, steps, beta, digits):
    """Return the blocks of DD^beta itself, row by row, and the bits behind the point."""
    mp.dps = digits + 30
    blocks = modal(s, steps, beta, digits)
    left, right = eigen(s, digits)[-2:]

    def back(block):
        middle = [tuple(zip(*(dot(row, column) for row in block))) for column in right]
        return [[sum(map(mul, row[0], column[0])) - sum(map(mul, row[1], column[1])) for column in middle]
                for row in left]
    return [{j: back(block) for j, block in row.items()} for row in blocks], 2 * (mp.prec + 100)


@cache
def dense(s, steps, beta, digits):
    """Return the same blocks in mpmath numbers."""
    blocks, bits = whole_dense(s, steps, beta, digits)
    return [{j: mpmath.matrix([[mpmath.ldexp(v, -bits) for v in line] for line in block])
             for j, block in row.items()} for row in blocks]


def product(F, G, s, k, j):
    total = mpmath.matrix(s, s)
    for l in range(j, k + 1):
        total += F[k][l] * G[l][j]
    return total


def dense_sums(s, alpha, steps, stages, v0, digits):
    """Return Y = DD^beta (v - [beta > 0] v0), step by step."""
    mp.dps = digits + 30
    beta = 2 * alpha - 1
    blocks = modal(s, steps, beta, digits)
    left, right = eigen(s, digits)[-2:]
    turned = []                         # v_j in the eigenvectors
    for row in stages:
        v = parts([e - (v0 if beta > 0 else 0) for e in row])
        turned.append(tuple(zip(*(dot(w, v) for w in zip(zip(*(re for re, _ in right)), zip(*(im for _, im in right)))))))
    Y = []
    for k, row in enumerate(blocks):
        shares = [[dot(entries, turned[j]) for entries in row[j]] for j in range(k + 1)]
        total = tuple(zip(*([sum(part) for part in zip(*share)] for share in zip(*shares))))
        Y.append([real_dot(out, total) for out in left])
    return Y
