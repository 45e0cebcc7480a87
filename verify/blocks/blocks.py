"""H 28. Thirty-two steps at once.

Proved here:
  (28.1)  every term enters every later sum once, at its own lag: the places that (28.1)
          and (28.3) read, enumerated for all k < 200, with generic weights of the window
          and one generic mode;
  (28.2)  one block later, the updated mode is again the sum that defines it (generic terms);
  (28.3)  the table for two groups of eight depends only on the difference of their places.
Printed: sums with weights made of dyadic modes, exact rationals, for the tests."""
from fractions import Fraction

from sympy import expand, symbols

from shared.refgen import array, claim, header, hexd, prove, table

BLOCK, EIGHT, TAIL = 32, 8, 33

# A sum reads each of its terms at one of four places: in its own group of eight, in an earlier group of the same
# block, in the block before, or in a mode, which contains all older terms.
#> places
def places(k):
    """Yield (lag, place) of every term that the sum k reads."""
    begin, eight = k - k % BLOCK, k - k % EIGHT
    for j in range(eight, k + 1):
        yield k - j, "own eight"
    for j in range(begin, eight):
        yield k - j, "own block"
    for j in range(max(begin - BLOCK, 0), begin):
        yield k - j, "block before"
    for j in range(0, begin - BLOCK):
        yield k - j, "mode"
#< places


for k in range(200):
    met = sorted(places(k))
    claim(f"(28.1) each lag once, k = {k}", [lag for lag, _ in met] == list(range(k + 1)))
    claim("the modes have lags from 33 on only", all(lag >= TAIL for lag, at in met if at == "mode"))
    claim("the table ends at lag 63", all(lag < 64 for lag, at in met if at != "mode"))

#> mode
# e stands for e^{-s}. At the begin k0 of a block the mode z is the sum over the lags n >= 33 of e^{n-33} x_{k0-n}.
# (28.2) computes the z of the next block from it.
e = symbols("e")
x = symbols("x0:100")


def mode(begin):
    return sum(e ** (begin - TAIL - j) * x[j] for j in range(0, begin - BLOCK))


for begin in (32, 64):
    update = e ** BLOCK * mode(begin) + sum(e ** (31 - j) * x[begin - BLOCK + j] for j in range(BLOCK))
    prove(f"(28.2) the mode at the begin of the next block, {begin}", expand(update - mode(begin + BLOCK)))
    for r in range(BLOCK):
        seen = sum(e ** (begin + r - j - TAIL) * x[j] for j in range(0, begin - BLOCK))
        prove(f"(28.1) the mode in row {r}", expand(seen - e ** r * mode(begin)))
#< mode

claim("(28.3) the lag is 8 D + r - j",
      all((EIGHT * (g + BLOCK // EIGHT) + r) - (EIGHT * s + j) == EIGHT * (4 + g - s) + r - j
          for g in range(4) for s in range(4) for r in range(8) for j in range(8)))

# ---- exact sums ----

P = [Fraction(1, 2), Fraction(1, 4), Fraction(1, 64), Fraction(1, 1024), Fraction(1), Fraction(0)]
C = [Fraction(-1, 8), Fraction(-1, 16), Fraction(-1, 128), Fraction(-1, 4096), Fraction(-1, 32), Fraction(1, 8192)]
W = [Fraction(1), Fraction(-1, 2)] + [Fraction(-1, n * n).limit_denominator(1 << 12) for n in range(2, 33)]
W = [Fraction(int(w * 4096), 4096) for w in W]
COUNT = 150
TERMS = [(7 * k * k + 3 * k) % 19 - 9 for k in range(COUNT)]


def weight(n):
    return W[n] if n < TAIL else sum(c * (1 - p) ** (n - TAIL) for p, c in zip(P, C))


SUMS = [sum(weight(n) * TERMS[k - n] for n in range(k + 1)) for k in range(COUNT)]
SIZES = [sum(abs(weight(n) * TERMS[k - n]) for n in range(k + 1)) for k in range(COUNT)]

header("verify/blocks/blocks.py")
print("\n/* Modes, weights of the lags 0 to 32, terms; their sums, and those of the moduli. */")
table("ref_modes", "double p, c;", [[hexd(p), hexd(c)] for p, c in zip(P, C)])
array("ref_window", W)
array("ref_terms", TERMS)
table("ref_sums", "double want, size;", [[hexd(a), hexd(b)] for a, b in zip(SUMS, SIZES)])
