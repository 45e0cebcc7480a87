"""Chains of five masses by the equations (17.8) and (17.24) as the chapter prints them, in dual numbers.

Each input is a dual number with slope 1 in its own direction, so the slopes of the results are the derivatives. Real
numbers have the precision that the importing script has set."""
from functools import cache
from operator import mul

import mpmath
from mpmath import mpf

from shared.arithmetic import (BITS, ONE, ZERO, HALF, TINY, Dual, circle, coefficients, dot, dual,
                              factorised, fixed, line, slopes, solved)

# Weights of few steps by Cauchy's integral. Aliasing leaves an error of 2^-160 of W_{n + 16}, and the digits lost are
# 2^(10 n) < 10^16.
CIRCLE, RADIUS = 16, mpf(1) / 1024


@cache
def numbers(s):
    """Return c, b, D and A of s nodes, from the zeros of Legendre's derivative, and A's inverse."""
    poly = [mpmath.binomial(s - 1, k) * mpmath.binomial(s - 1 + k, k) * (k if k else 0)
            for k in range(s)]  # coefficients of t P'(1 - 2 t) in powers of -t
    inner = [] if s == 2 else mpmath.polyroots(
        [(-1) ** k * poly[k] for k in range(s - 1, 0, -1)], maxsteps=300, extraprec=300)
    nodes = [mpf(0), *sorted(mpmath.re(v) for v in inner), mpf(1)]
    D, A, b = (mpmath.matrix(s, s) for _ in range(3))
    b = [1 / (mpf(s) * (s - 1) * mpmath.legendre(s - 1, 2 * v - 1) ** 2) for v in nodes]
    scale = [mpmath.fprod(v - w for w in nodes if w != v) for v in nodes]
    for i in range(s):
        for j in range(s):
            if i != j:
                D[i, j] = scale[i] / scale[j] / (nodes[i] - nodes[j])
        D[i, i] = -sum(D[i, j] for j in range(s) if j != i)
    base = D.copy()
    base[0, 0] += 1 / b[0]
    return nodes, b, D, base, mpmath.inverse(base)


@cache
def matrices(s, step):
    """Return K, D, A and its inverse for steps of this length, in whole numbers."""
    _, b, D, inverse, A = numbers(s)
    return [[[fixed(v) for v in row] for row in M.tolist()]
            for M in (D.T * mpmath.diag(b) * D / step, D / step, A * step, inverse)]


@cache
def points(s, radius=RADIUS, count=CIRCLE):
    _, b, _, base, _ = numbers(s)

    def delta(z):
        M = base.copy()
        M[0, s - 1] -= z / b[0]
        return M
    return circle(delta, radius, count)


D5, N = 5, 6


log = cache(mpmath.log)


@cache
def power(v, beta):
    return mpmath.exp(beta * log(v))


class Tilted:
    """The weights w_k + w'_k eps of the order beta + eps."""
    @staticmethod
    @cache
    def weights(s, beta):
        around = points(s)
        w = coefficients(around, lambda v: power(v, beta), range(N))
        r = coefficients(around, lambda v: power(v, beta) * log(v), range(N))
        return [[[Dual(fixed(a), fixed(b)) for a, b in zip(x, y)]
                 for x, y in zip(w[n].tolist(), r[n].tolist())] for n in range(N)]


@cache
def impulses(s, e, h):
    """Return h^(1 + e) int l_i(s) (k + s)^e ds / Gamma(1 + e), i = 1, ..., s, k < N, with the slopes by -e."""
    e, nodes = mpmath.mpc(e, -TINY), numbers(s)[0]
    out, size = [], len(nodes)
    poly = []
    for j in range(size):  # l_j by powers of s
        l = [mpf(1)]
        for i in range(size):
            if i != j:
                f = nodes[j] - nodes[i]
                l = [((l[k - 1] if k else 0) - (nodes[i] * l[k] if k < len(l) else 0)) / f
                     for k in range(len(l) + 1)]
        poly.append(l)
    for k in range(N):
        def power(n):
            """Return int_k^{k+1} u^(n + e) du / Gamma(1 + e)."""
            low = mpf(0) if k == 0 else mpf(k) ** (n + 1 + e)
            unit = mpmath.rgamma(2 + e) if n == 0 else mpmath.rgamma(1 + e) / (n + 1 + e)
            return ((k + 1) ** (n + 1 + e) - low) * unit
        u = [power(n) for n in range(size)]
        moment = [sum(mpmath.binomial(n, i) * mpf(-k) ** (n - i) * u[i] for i in range(n + 1))
                  for n in range(size)]
        out.append([dual(h ** (1 + e) * sum(a * b for a, b in zip(l, moment))) for l in poly])
    return out


def spring_forces(x, k1, g3):
    """Return grad U of the chain, and the second derivatives of U of the springs."""
    stretch = [(x[i] if i < D5 else ZERO) - (x[i - 1] if i else ZERO) for i in range(D5 + 1)]
    cubic = [g3 * r * r for r in stretch]
    force = [(k1 + c) * r for c, r in zip(cubic, stretch)]
    stiff = [k1 + c + c + c for c in cubic]
    return [force[i] - force[i + 1] for i in range(D5)], stiff


def away(x, t, h):
    """Return (h/2) |x - sin t|^2."""
    sine, total = dual(mpmath.sin(t)), ZERO
    for v in x:
        total += h * HALF * (v - sine) * (v - sine)
    return total


class Chain:
    """A run of form M or D. q holds x0, p0, mass, rho (lists), alpha, cg (a list) and F."""
    steps, struck = N, {}  # {node: momenta that an impulse adds there}
    by_impulses = True     # the initial history acts by the impulses of its integral over a step

    def __init__(self, s, damped, past, alpha, q, step):
        self.s, self.damped, self.past = s, damped, past
        self.nodes, b = numbers(s)[:2]
        self.b = [dual(v) for v in b]
        self.side, self.alpha0 = (alpha > 0.5) - (alpha < 0.5), mpf(alpha)
        self.heavy = alpha == 1 and not damped  # form M at alpha = 1 adds the damping to the mass, (17.17)
        self.hold(mpf(step))
        self.unknown = range(s) if damped else range(1, s)
        self.q, self.path, self.factors = q, [], []
        self.run(q, None)

    def hold(self, step):
        """Set the matrices of a step of this length."""
        self.step, self.h = step, dual(step)
        self.K, self.D, self.A, self.inverse = matrices(self.s, step)

    def matrix(self, V, xk, W0, scale):
        """Return the factorised derivative of the equations of a step by the unknowns, without slopes."""
        s, h, q, n = self.s, self.h, self.q, len(self.unknown)
        M = [[0] * (n * D5) for _ in range(n * D5)]
        for a, i in enumerate(self.unknown):
            stiff = spring_forces(self.places(V, xk, i), *q["cg"])[1]
            for j in range(D5):
                near = [(j, stiff[j] + stiff[j + 1])]
                near += [(j - 1, ZERO - stiff[j])] if j else []
                near += [(j + 1, ZERO - stiff[j + 1])] if j + 1 < D5 else []
                for l, k in near:
                    if self.damped:
                        by = (h * k).v
                        for cc, v in enumerate(self.A[i]):
                            M[j * n + a][l * n + cc] += by * v >> BITS
                    elif i < s - 1:
                        M[j * n + i][l * n + i - 1] -= (h * self.b[i] * k * self.share(j, q)).v
        columns = list(zip(*self.D))
        memory = [[W0[a][l].v if self.damped else
                   sum(map(mul, [w.v for w in W0[a]], columns[l])) >> BITS for l in self.unknown]
                  for a in range(n)]
        for j in range(D5):
            rho = ZERO if self.heavy else q["rho"][j]
            for a in range(n):
                factor = (h * rho * scale * (ONE if self.damped else self.b[a])).v
                for cc, l in enumerate(self.unknown):
                    damping = factor * memory[a][cc] >> BITS
                    M[j * n + a][j * n + cc] += (
                        (q["mass"][j].v * self.inverse[a][l] >> BITS) + damping if self.damped else
                        (q["mass"][j].v * self.K[a][l] >> BITS) - damping)
        return factorised(M)

    def places(self, V, xk, i):
        return [xk[j] + (line(self.A[i], V[j]) if self.damped else V[j][i]) + self.beside(i, j)
                for j in range(D5)]

    def share(self, j, q):
        return q["mass"][j] / (q["mass"][j] + q["rho"][j]) if self.heavy else ONE

    def step_residual(self, q, k, V, xk, pk, history, W0, scale, v0, amplitude):
        """Return the residuals of a step, the load of each stage, and the velocities. V: X_i - x_k in form M, else
        V_i."""
        s, h = self.s, self.h
        S = [[None] * s for _ in range(D5)]
        speed = V if self.damped else [[line(self.D[i], V[j]) for i in range(s)] for j in range(D5)]
        moved = [[v - v0[j] for v in speed[j]] for j in range(D5)]
        for i in range(s):
            grad = spring_forces(self.places(V, xk, i), *q["cg"])[0]
            for j in range(D5):
                rho = q["rho"][j]
                force = grad[j] - self.force(q, k, i, j)
                if not self.heavy:
                    force += rho * (history[j][i] + scale * dot(W0[i], moved[j]))
                S[j][i] = (h * self.b[i] * force + rho * amplitude[j] * self.impulse[k][i]) * self.share(j, q)
        out = []
        for j in range(D5):
            for a in range(len(self.unknown)):
                if self.damped:
                    vk = pk[j] / q["mass"][j]
                    out.append(q["mass"][j] * line(self.inverse[a], [v - vk for v in V[j]]) + S[j][a] / self.b[a])
                else:
                    out.append((pk[j] if a == 0 else ZERO) - S[j][a] + q["mass"][j] * line(self.K[a], V[j]))
        return out, S, speed

    def memory(self, q, turn):
        """Return W_n, n < N, and the factor of all of them."""
        beta = 2 * self.alpha0 - 1
        W = [[[Dual(w.v, turn * w.d) for w in row] for row in u] for u in Tilted.weights(self.s, beta)]
        return W, dual(self.step ** -mpmath.mpc(beta, TINY), turn)

    def run(self, q, tilt):
        """Return J. tilt None: the run without slopes, whose path is stored; else the slope of alpha."""
        s, real, n = self.s, tilt is None, len(self.unknown)
        turn = 2 * (tilt or 0)
        W, scale = self.memory(q, turn)
        rl = self.past == "rl"
        has_start_impulses = self.by_impulses and self.side and (rl or (self.past == "held" and self.side > 0))
        e = -2 * self.alpha0 + (1 if self.side > 0 else 0)
        self.impulse = ([[Dual(v.v, turn * v.d) for v in row] for row in impulses(s, e, self.step)]
                        if has_start_impulses else [[ZERO] * s] * self.steps)
        A = [p / m if self.side > 0 else x for p, m, x in zip(q["p0"], q["mass"], q["x0"])]
        amplitude = A if has_start_impulses else [ZERO] * D5
        x, p, past, J = list(q["x0"]), list(q["p0"]), [], ZERO
        self.prepare(q, turn)
        for k in range(self.steps):
            self.begin(k)
            x, p = self.enter(q, k, x, p)
            v0 = self.taken(q, k)
            W0 = self.block(W, k, k)
            history = [[ZERO] * s for _ in range(D5)]
            rows = [[w for o in range(k) for w in self.block(W, k, o)[i]] for i in range(s)]
            for j in range(D5) if k and not self.heavy else ():
                before = [v for o in range(k) for v in past[o][j]]
                history[j] = [scale * dot(row, before) + self.told(k, i, j) for i, row in enumerate(rows)]
            V = [[p[j] / q["mass"][j] * (ONE if self.damped else dual(self.nodes[i] * self.step))
                  for i in range(s)] for j in range(D5)] if real else [list(v) for v in self.path[k]]
            left = 40 if real else 1  # one Newton step is exact for the slopes, because their equations are linear
            while left:
                rest = self.step_residual(q, k, V, x, p, history, W0, scale, v0, amplitude)[0]
                lu = self.matrix(V, x, W0, scale) if real else self.factors[k]
                change = solved(lu, rest)
                for j in range(D5):
                    for a, i in enumerate(self.unknown):
                        V[j][i] -= change[j * n + a]
                left -= 1
                if real and max(abs(c.v) for c in change) < 1 << BITS - 130:
                    left = 0
            if real:
                self.path.append([list(v) for v in V])
                self.factors.append(lu)    # the factors belong to a V that differs by less than 2^-130
            speed, S = V, None
            if not self.damped:
                _, S, speed = self.step_residual(q, k, V, x, p, history, W0, scale, v0, amplitude)
            past.append([[v - v0[j] for v in speed[j]] for j in range(D5)])
            before = list(x), list(p)
            for j in range(D5):
                if self.damped:
                    x[j] += line(self.A[s - 1], V[j])
                    p[j] = q["mass"][j] * V[j][s - 1]
                else:
                    x[j] += V[j][s - 1]
                    for v in S[j]:
                        p[j] -= v
            J += self.cost(q, k, before, V, x)
        for v, u in zip(*self.enter(q, self.steps, x, p)):
            J += HALF * v * (ONE + HALF * u * u)
        return J

    def force(self, q, k, i, j):
        return q["F"][(k * (self.s - 1) + i) * D5 + j]

    def hit(self, k, p):
        return [a + b for a, b in zip(p, self.struck[k])] if k in self.struck else p

    def begin(self, k):
        """Prepare step k. Here all steps are alike."""

    def prepare(self, q, turn):
        """Compute everything that does not depend on a step. Here there is nothing."""

    def enter(self, q, k, x, p):
        """Return x and p at the start of step k."""
        return x, self.hit(k, p)

    def taken(self, q, k):
        """Return the velocities that the memory subtracts from those of step k."""
        return [p / m if self.side > 0 else ZERO for p, m in zip(q["p0"], q["mass"])]

    def told(self, k, i, j):
        """Return the contribution to the memory that does not come from steps."""
        return ZERO

    def beside(self, i, j):
        """Return the part of x at stage i of this step that does not come from the stages."""
        return ZERO

    def block(self, W, n, o):
        """Return the weights in step n of the stages of step o."""
        return W[n - o]

    def cost(self, q, k, before, V, x):
        """Return the contribution to J of the rows in a step, here of its end."""
        return away(x, (k + 1) * self.step, self.h)

    def slopes(self, wanted):
        """Return dJ by each wanted (name, i)."""
        return slopes(self.run, self.q, wanted)


class LawChain(Chain):
    """Form D with a law of damping, (26.12). q also holds the factors of the law's terms."""

    def __init__(self, s, symbols, q, step):
        around, step = points(s), mpf(step)
        self.alone = []
        for symbol in symbols:
            w = coefficients(around, lambda v: symbol(v / step) / (v / step), range(N))
            self.alone.append([[[Dual(fixed(a)) for a in row] for row in w[n].tolist()] for n in range(N)])
        super().__init__(s, 1, "held", 0.5, q, step)

    def memory(self, q, turn):
        return [[[dot(q["terms"], [w[n][i][j] for w in self.alone]) for j in range(self.s)]
                 for i in range(self.s)] for n in range(N)], ONE
