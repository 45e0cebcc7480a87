"""Chapter 23. Steps of any length: derivatives of chains of five masses on a given mesh.

The memory is the power of one matrix, (22.1), by Parlett's recurrence, variable_steps_power.py,
and its derivative by the order a difference of two such powers, 2 10^-30 apart, in 130 digits;
the run and its slopes are those of adjoint_chain.py, in dual numbers of 72 digits, with rows
within the steps, (22.18), and a force that is changed along lines between the rows."""
from functools import cache
from random import Random

import mpmath
from mpmath import mp, mpf
from sympy import Rational

from shared.adjoint_chain import D5, Chain, away, numbers
from shared.arithmetic import BITS, ONE, ZERO, Dual, dual, fixed, line, real_function
from shared.refgen import claim, header, hexd, table
from shared.variable_steps_power import dense

mp.dps = 72
DIGITS, APART, UNIT = 100, 30, 2**-20


class Mesh(Chain):
    """A run over steps of given lengths, h; rows at every `row`."""

    def __init__(self, s, damped, past, alpha, q, h, row):
        self.lengths, self.steps, self.row, self.known = h, len(h), mpf(row), {}
        self.ends = [mpf(sum(h[:k])) for k in range(len(h) + 1)]
        if alpha <= 0.5:  # above, they are too rough for such steps
            self.struck = {k: [dual(mpf(v)) for v in I] for k, I in IMPULSES.items()}
        super().__init__(s, damped, past, alpha, q, h[0])

    def memory(self, q, turn):
        return blocks(self.s, tuple(self.lengths), 2 * self.alpha0 - 1, turn), ONE

    def begin(self, k):
        self.hold(mpf(self.lengths[k]))

    def block(self, W, n, o):
        return W[n][o]

    def force(self, q, k, i, j):
        if (k, i) not in self.known:
            at = (self.ends[k] + self.nodes[i] * self.step) / self.row
            n = min(int(at), len(q["F"]) // D5 - 2)
            self.known[k, i] = n, dual(n + 1 - at), dual(at - n), dual(mpmath.cos(1.25 * at * self.row) / 5)
        n, left, right, given = self.known[k, i]
        return given + q["F"][n * D5 + j] * left + q["F"][(n + 1) * D5 + j] * right

    def cost(self, q, k, before, V, x):
        """The rows in the step, by (22.18)."""
        total = ZERO
        for n in range(1, int(self.ends[-1] / self.row) + 1):
            theta = (n * self.row - self.ends[k]) / self.step
            if 0 < theta <= 1:
                r, at = [fixed(v) for v in shape(self.s, theta, self.step)], []
                for x0, p, mass, stages in zip(*before, q["mass"], V):
                    v = p / mass
                    at.append(x0 + dual(theta * self.step) * v + line(r, [u - v for u in stages]))
                total += away(at, n * self.row, dual(self.row))
        return total


@cache
def shape(s, theta, step):
    """h^2 int_0^theta (theta - u) x''(u) du by V - v = h A x'', (22.18)."""
    nodes, inverse, q = numbers(s)[0], numbers(s)[3], []
    for j in range(s):
        l = [mpf(1)]                    # by powers of u
        for i in range(s):
            if i != j:
                f = nodes[j] - nodes[i]
                l = [((l[k - 1] if k else 0) - (nodes[i] * l[k] if k < len(l) else 0)) / f
                     for k in range(len(l) + 1)]
        q.append(sum(c * theta ** (n + 2) / ((n + 1) * (n + 2)) for n, c in enumerate(l)))
    return [step * sum(q[j] * inverse[j, i] for j in range(s)) for i in range(s)]


def whole(M):
    return [[fixed(v) for v in row] for row in M.tolist()]


@cache
def powers(s, steps, beta):
    """DD^beta, and its derivative by beta."""
    with mp.workdps(mp.dps):
        mp.dps = DIGITS
        e = mpf(10) ** -APART
        W, above, below = (dense(s, steps, beta + v, DIGITS) for v in (0, e, -e))
        rate = [{o: (row[o] - below[k][o]) / (2 * e) for o in row} for k, row in enumerate(above)]
        return [[{o: whole(M) for o, M in row.items()} for row in F] for F in (W, rate)]


@cache
def blocks(s, steps, beta, turn):
    """DD^beta, tilted by turn."""
    return [{o: [[Dual(w, turn * r) for w, r in zip(*rows)] for rows in zip(W[o], rate[o])] for o in W}
            for W, rate in zip(*powers(s, steps, beta))]


# The first step is shorter than the method's own first one would be, and each is shorter than
# what the one before allows: so the method takes those that end where it is told to.
UNITS = [57, 58, 121, 262, 563, 1208, 2600, 5571, 11980, 23000, 40000, 60000, 90000, 130000, 158868]
# Small impulses at the start, at the beginning of a step with a row in it, and at the end.
IMPULSES = {k: [(-1) ** (j + k) * (j + 1) * 2.0**-17 for j in range(D5)] for k in (0, 11, 15)}
ROWS, CASES = 4, [("held", 0.0), ("held", 0.05), ("held", 0.35), ("rl", 0.5),
                  ("caputo", 0.7), ("caputo", 0.95), ("caputo", 1.0)]


def nearest(v):
    return hexd(Rational(mpmath.nstr(v, 30, min_fixed=0, max_fixed=0)))


def literal(values):
    return "{ " + ", ".join(nearest(v) for v in values) + " }"


def chain(random, past, alpha):
    uniform = lambda a, b: round(random.uniform(a, b) * 2**20) / 2**20
    data = dict(x0=[uniform(-1, 1) for _ in range(D5)], p0=[uniform(-1, 1) for _ in range(D5)],
                mass=[uniform(0.5, 2) for _ in range(D5)],
                rho=[0.0 if i == 2 else uniform(0, 0.4) for i in range(D5)],
                cg=[uniform(0.5, 2), uniform(0.2, 1)])
    q = {k: [dual(mpf(v)) for v in w] for k, w in data.items()}
    q["F"] = [ZERO] * ((ROWS + 1) * D5)
    run = Mesh(8, 1, past, alpha, q, [u * UNIT for u in UNITS], sum(UNITS) * UNIT / ROWS)
    want = run.slopes([(name, i) for name in ("x0", "p0", "mass", "rho") for i in range(D5)]
                      + [("cg", 0), ("cg", 1), ("alpha", 0)]
                      + [("F", i) for i in (0, 12, len(q["F"]) - 1)])
    return ([f"FVI_PAST_{dict(rl='RIEMANN_LIOUVILLE').get(past, past.upper())}", repr(alpha)]
            + [literal(map(mpf, data[k])) for k in ("x0", "p0", "mass", "rho", "cg")] + [literal(want)])


random = Random(2316)
runs = [chain(random, past, alpha) for past, alpha in CASES]

# (23.18): what a step has of itself, for the last one of the last run
h, block = mpf(UNITS[-1]) * UNIT, powers(8, tuple(u * UNIT for u in UNITS), mpf(1))[1][-1][len(UNITS) - 1]
own = real_function(numbers(8)[3], lambda v: v * (mpmath.log(v) - mpmath.log(h))) / h
claim("(23.18) the block of a step itself", max(abs(mpmath.ldexp(block[i][j], -BITS) - own[i, j])
                                                for i in range(8) for j in range(8)) < mpf(10) ** -24 * mpmath.norm(own))
header("verify/adjoint/adjoint_mesh.py")
print("\n/* Where steps end but for the first, from t = 0, and the last; whole multiples of 2^-20 */")
print("static const double ref_mesh_ends[] = { "
      + ", ".join(hexd(Rational(sum(UNITS[:k + 1]), 2**20)) for k in range(len(UNITS))) + " };")
print("""
/* Where an impulse acts, and what it adds to the momenta; where alpha <= 1/2 */""")
table("ref_mesh_impulses", "double t, J[5];",
      [[hexd(Rational(sum(UNITS[:k]), 2**20)), literal(map(mpf, I))] for k, I in IMPULSES.items()])
print("""
/* Five masses, F = cos(5t/4)/5 on each, four rows; dJ, J as in to_sine, by x0, p0, mass, rho, c,
   g, alpha, and by F_1 of row 0, F_3 of row 2, F_5 of row 4, the force changed along lines */""")
table("ref_meshes", "fvi_past past; double alpha, x0[5], p0[5], mass[5], rho[5], cg[2], want[26];", runs)
