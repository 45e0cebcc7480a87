"""Chains of five masses, adjoint_chain.py, on a given mesh.

The memory is the power of one matrix, (22.1), by Parlett's recurrence, variable_steps_power.py. Value and derivative
by the order are the mean and the difference of two such powers, 2 10^-18 apart, in 80 digits. Rows lie within the
steps, (22.18), and a change of the force is linear between the rows."""
from functools import cache

import mpmath
from mpmath import mp, mpf

from shared.adjoint_chain import D5, Chain, away, numbers
from shared.arithmetic import BITS, ONE, ZERO, Dual, dual, fixed, line
from shared.refgen import nearest
from shared.variable_steps_power import whole_dense

# The differences have an error of 10^-36, times a third power of logarithms. With 100 and 30 here no derivative
# changed by more than 7 10^-34 of itself.
DIGITS, APART = 50, 18


class Mesh(Chain):
    """A run over steps of the given lengths h, with a row at every multiple of `row`."""

    def __init__(self, s, damped, past, alpha, q, h, row, impulses):
        self.lengths, self.steps, self.row, self.known = h, len(h), mpf(row), {}
        self.ends = [mpf(sum(h[:k])) for k in range(len(h) + 1)]
        self.struck = {k: [dual(mpf(v)) for v in I] for k, I in impulses.items()}
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
        """Return the contribution to J of the rows in the step, by (22.18)."""
        total = ZERO
        for n in range(1, int(self.ends[-1] / self.row) + 1):
            theta = (n * self.row - self.ends[k]) / self.step
            if 0 < theta <= 1:
                r, at = [fixed(v) for v in shape(self.s, theta, self.step)], []
                for x0, p, mass, stages, more in zip(*before, q["mass"], V, self.besides(n)):
                    v = p / mass
                    at.append(x0 + dual(theta * self.step) * v + line(r, [u - v for u in stages]) + more)
                total += away(at, n * self.row, dual(self.row))
        return total

    def besides(self, n):
        """Return the part of x in row n of this step that does not come from the stages."""
        return [ZERO] * D5


@cache
def shape(s, theta, step):
    """Return h^2 int_0^theta (theta - u) x''(u) du as a row that acts on V - v = h A x'', (22.18)."""
    nodes, inverse, q = numbers(s)[0], numbers(s)[3], []
    for j in range(s):
        l = [mpf(1)]                    # coefficients of the powers of u
        for i in range(s):
            if i != j:
                f = nodes[j] - nodes[i]
                l = [((l[k - 1] if k else 0) - (nodes[i] * l[k] if k < len(l) else 0)) / f
                     for k in range(len(l) + 1)]
        q.append(sum(c * theta ** (n + 2) / ((n + 1) * (n + 2)) for n, c in enumerate(l)))
    return [step * sum(q[j] * inverse[j, i] for j in range(s)) for i in range(s)]


@cache
def powers(s, steps, beta):
    """Return DD^beta, and its derivative by beta."""
    with mp.workdps(DIGITS):
        e = mpf(10) ** -APART
        (above, bits), (below, _) = (whole_dense(s, steps, beta + v, DIGITS) for v in (e, -e))
    half = bits - BITS + 1      # mean and rate are halves of the following sums
    mean = lambda a, b: a + b >> half
    rate = lambda a, b: (a - b) * 10**APART >> half
    return [[{o: [list(map(f, *rows)) for rows in zip(up[o], down[o])] for o in up} for up, down in zip(above, below)]
            for f in (mean, rate)]


@cache
def blocks(s, steps, beta, turn):
    """Return DD^beta as dual numbers, with the derivative by beta times turn as slope."""
    return [{o: [[Dual(w, turn * r) for w, r in zip(*rows)] for rows in zip(W[o], rate[o])] for o in W}
            for W, rate in zip(*powers(s, steps, beta))]


def literal(values):
    return "{ " + ", ".join(nearest(v) for v in values) + " }"
