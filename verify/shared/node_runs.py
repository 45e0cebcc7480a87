"""H 23. Chains of five masses by the methods without stages, in dual numbers of 45 digits.

The runs follow Algorithm 3 and (13.7) as the chapters print them. Each input has slope 1 in its own direction, so the
slopes of the results are the derivatives."""
import mpmath
from mpmath import mp, mpc, mpf

from .adjoint_chain import D5, away, spring_forces
from .arithmetic import BITS, HALF, ONE, TINY, ZERO, Dual, dual, factorised, slopes, solved
from .refgen import METHODS, initial_history, hexd, nearest
from sympy import Rational

mp.dps = 72
N, STEP = 12, mpf(1) / 16


def by(v, n):
    """Return v / n for a whole n."""
    return v / Dual(n * ONE.v)


def weights(method, alpha, turn):
    """Return w_n(2 alpha), the coefficients of (1 - z)^order. BDF2: multiplied by those of ((3 - z)/2)^order; stable:
    multiplied by (1 + order)/2 + z (1 - order)/2."""
    order = dual(mpc(2 * alpha, 2 * TINY), turn)
    plain, g = [ONE], [dual(mpf(1.5) ** mpc(2 * alpha, 2 * TINY), turn)]
    for n in range(1, N + 1):
        factor = Dual((n - 1) * ONE.v) - order
        plain.append(by(plain[-1] * factor, n))
        g.append(by(g[-1] * factor, 3 * n))
    if method == "stable":
        return [HALF * ((ONE + order) * v + (ONE - order) * u) for v, u in zip(plain, [ZERO] + plain)]
    if method == "bdf2":
        return [total(g[j] * plain[n - j] for j in range(n + 1)) for n in range(N + 1)]
    return plain


def total(terms):
    sum_ = ZERO
    for v in terms:
        sum_ += v
    return sum_


def impulses(e, turn):
    """Return (19.5) at both ends of each step k: h^(1 + e) times the integrals of (1 - s) and of s times (k + s)^e /
    Gamma(1 + e). The slope of e is -2 turn."""
    e, out = mpc(e, -2 * TINY), []
    unit = mpmath.rgamma(1 + e) * STEP ** (1 + e)
    power = [mpf(0)] + [mpf(k) ** e for k in range(1, N + 1)]
    for k in range(N):
        whole = ((k + 1) * power[k + 1] - k * power[k]) / (1 + e)
        moment = ((k + 1) ** 2 * power[k + 1] - k**2 * power[k]) / (2 + e)
        out.append((dual(unit * (whole - moment + k * whole), turn), dual(unit * (moment - k * whole), turn)))
    return out


class Nodes:
    """A run. q holds x0, p0, mass, rho, cg and F."""

    def __init__(self, method, past, alpha, kappa, q):
        self.method, self.past, self.alpha, self.q = method, past, mpf(alpha), q
        self.kappa, self.printed = dual(mpf(kappa)), method == "fvi"
        self.above, self.rl = alpha > 0.5, past == "rl"
        self.has_start_impulses = not self.printed and past != "caputo" and alpha != 0.5 and (self.above or self.rl)
        self.moved, self.factors = [], []
        self.run(q, None)

    def of_impulses(self, rows, q, turn):
        """Return the contribution to J of the impulses of the dampers in rows 0 to N, here nothing."""
        return ZERO

    def solve(self, k, x, right, inertia, h, cg):
        """Return dx of inertia dx + kappa h grad U(x + (1 - kappa) dx) = right, and this gradient."""
        share, rest = self.kappa * h, ONE - self.kappa
        real = len(self.moved) == k
        dx = [ZERO] * D5 if real else list(self.moved[k])
        while True:
            grad, stiff = spring_forces([a + rest * b for a, b in zip(x, dx)], *cg)
            if real:
                M = [[0] * D5 for _ in range(D5)]
                for i in range(D5):
                    M[i][i] = (inertia[i] + share * rest * (stiff[i] + stiff[i + 1])).v
                    if i:
                        M[i][i - 1] = M[i - 1][i] = (ZERO - share * rest * stiff[i]).v
                lu = factorised(M)
            else:
                lu = self.factors[k]
            e = [r - a * b - share * g for r, a, b, g in zip(right, inertia, dx, grad)]
            step = solved(lu, e)
            dx = [a + b for a, b in zip(dx, step)]
            if not real or max(abs(v.v) for v in step) < 1 << BITS - 130:  # one more step is exact
                break
        if real:
            self.moved.append(dx)
            self.factors.append(lu)
        return dx, spring_forces([a + rest * b for a, b in zip(x, dx)], *cg)[0]

    def run(self, q, turn):
        """Return J. turn None: the run without slopes, which is stored; else the slope of alpha."""
        turn = turn or 0
        h, printed = dual(STEP), self.printed
        w = weights(self.method, self.alpha, turn)
        unit = dual(STEP ** mpc(1 - 2 * self.alpha, -2 * TINY), turn)
        theta = dict(shifted=dual(mpc(self.alpha, TINY), turn), stable=HALF).get(self.method, ZERO)
        e = (1 if self.above else 0) - 2 * self.alpha
        start_impulses = impulses(e, turn) if self.has_start_impulses else [(ZERO, ZERO)] * N
        c = [r * unit for r in q["rho"]]
        x, p, J = list(q["x0"]), list(q["p0"]), ZERO
        A = [a / m if self.above else b for a, m, b in zip(p, q["mass"], x)]
        drifts = self.above and (not printed or self.past == "caputo")
        drift = [h * a / m if drifts else ZERO for a, m in zip(p, q["mass"])]
        origin = [ZERO] * D5 if printed and self.rl else list(x)
        z, H = [[a - b for a, b in zip(x, origin)]], None
        H = [w[0] * v for v in z[0]]
        taken = [[ZERO] * D5]
        for k in range(N):
            known, right = [], []
            now = list(taken[-1])
            for i in range(D5):
                if not printed:
                    damping = (HALF - theta) * c[i] * H[i] + q["rho"][i] * A[i] * start_impulses[k][0]
                    now[i] += damping
                    p[i] += HALF * h * q["F"][k * D5 + i] - damping
                line = Dual((k + 1) * ONE.v) * drift[i]
                past = total(w[n] * z[k + 1 - n][i] for n in range(1, k + 2))
                known.append(w[0] * (x[i] - origin[i] - line) + past)
                right.append(p[i] - theta * c[i] * known[i])
            inertia = [m / h + theta * v * w[0] for m, v in zip(q["mass"], c)]
            dx, grad = self.solve(k, x, right, inertia, h, q["cg"])
            x = [a + b for a, b in zip(x, dx)]
            H = [a + w[0] * b for a, b in zip(known, dx)]
            z.append([a - b - Dual((k + 1) * ONE.v) * v for a, b, v in zip(x, origin, drift)])
            for i in range(D5):
                force = h * q["F"][(k + 1) * D5 + i]
                damping = c[i] * H[i] if printed else (HALF + theta) * c[i] * H[i] + q["rho"][i] * A[i] * start_impulses[k][1]
                now[i] += damping
                p[i] += (force if printed else HALF * force) - h * grad[i] - damping
            taken.append(now)
            J += away(x, (k + 1) * STEP, h)
        return J + self.of_impulses(taken, q, turn) + total(HALF * v * (ONE + HALF * u * u) for v, u in zip(x, p))


FORCES = [3, 7 * D5 + 1, N * D5 + 4]


def chain(random, method, past, alpha, of=Nodes):
    """Return the row of a random chain, and its derivatives by a run of class `of`."""
    uniform = lambda a, b: round(random.uniform(a, b) * 2**20) / 2**20
    no = past == "rl" and alpha > 0.5 and method != "fvi"  # this past starts from 0 alone
    data = dict(x0=[0.0 if no else uniform(-1, 1) for _ in range(D5)], p0=[uniform(-1, 1) for _ in range(D5)],
                mass=[uniform(0.5, 2) for _ in range(D5)],
                rho=[0.0 if i == 2 else uniform(0, 0.4) for i in range(D5)],
                cg=[uniform(0.5, 2), uniform(0.2, 1)])
    kappa = 0.5 if method == "stable" else uniform(0.2, 0.8)
    q = {k: [dual(mpf(v)) for v in w] for k, w in data.items()}
    q["F"] = [dual(mpmath.cos(1.25 * k * STEP) / 5) for k in range(N + 1) for _ in range(D5)]
    run = of(method, past, alpha, kappa, q)
    want = slopes(run.run, q, [(name, i) for name in ("x0", "p0", "mass", "rho") for i in range(D5)]
                  + [("cg", 0), ("cg", 1), ("alpha", 0)] + [("F", i) for i in FORCES])
    text = ["NAN" if no and i < D5 and data["rho"][i] > 0 else nearest(v) for i, v in enumerate(want)]
    return ([f"&fvi_{METHODS[method]}", initial_history(past),
             repr(alpha), hexd(Rational(kappa))]
            + ["{ " + ", ".join(hexd(Rational(v)) for v in data[k]) + " }"
               for k in ("x0", "p0", "mass", "rho", "cg")]
            + ["{ " + ", ".join(text) + " }"])
