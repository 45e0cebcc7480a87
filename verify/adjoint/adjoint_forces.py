"""H 23. Derivatives of the forces and impulses of dampers, of chains by the methods without stages.

The impulses are the sums of the steps, plus the part (13.18) of a start with a velocity. The forces are the
derivatives of the impulses as H 13 computes them: differences of J, with (13.20) in the first rows; after a jump,
differences of J/t^q. Everything is in dual numbers of 45 digits."""
from random import Random

import mpmath
from mpmath import binomial, mpc, mpf

from shared.adjoint_chain import D5
from shared.arithmetic import HALF, ONE, TINY, ZERO, Dual, dual
from shared.node_runs import FORCES, N, STEP, Nodes, by, chain, total, weights
from shared.refgen import METHODS, header, table


def weight(k, i, of):
    """Return the factor in J of the force (of = 0) or of the impulse (of = 4) of mass i in row k."""
    return dual(mpf((3 * k + 5 * i + 4 * of) % 7 - 3) / 8)


class Forces(Nodes):
    def lead(self, turn):
        """Return in every row the exact impulse of a line with velocity 1 and rho = 1, minus the impulse that the
        steps sum."""
        if self.printed or self.alpha > 0.5:
            return [ZERO] * (N + 1)
        w, e = weights(self.method, self.alpha, turn), mpc(2 - 2 * self.alpha, -2 * TINY)
        unit = dual(STEP ** mpc(1 - 2 * self.alpha, -2 * TINY), turn)
        theta = dict(shifted=dual(mpc(self.alpha, TINY), turn), stable=HALF).get(self.method, ZERO)
        H = [total(w[n] * dual((k - n) * STEP) for n in range(k + 1)) for k in range(N + 1)]
        sums, out = ZERO, [ZERO]
        for k in range(N):
            sums += unit * ((HALF - theta) * H[k] + (HALF + theta) * H[k + 1])
            out.append(dual(mpmath.rgamma(1 + e) * ((k + 1) * STEP) ** e, turn) - sums)
        return out

    def start(self, i, q, J):
        """Return the force at t = 0. Where it is infinite, return the mean over the first row."""
        order, x0, v0 = 2 * self.alpha, q["x0"][i], q["p0"][i] / q["mass"][i]
        if order == 1:
            return q["rho"][i] * v0
        if order < 1 and (self.past != "rl" or x0.v == 0):
            return ZERO
        return ZERO if order > 1 and self.past == "caputo" else J[1] / dual(STEP)

    def answers(self, turn):
        """Return G_1 to G_4 of (13.20) for rho = 1, and the sums S_1 to S_3 that the steps make of a jump, of a line
        and of the motion under a constant force."""
        w, t = weights(self.method, self.alpha, turn), [k * STEP for k in range(N + 1)]
        exact = []
        for i in range(4):
            factor = mpmath.rgamma(1 + i - self.tilted)
            exact.append([ZERO] + [dual(factor * t[k] ** (i - self.tilted), turn) for k in range(1, N + 1)])
        unit = dual(STEP ** (1 - self.tilted), turn)
        theta = dict(shifted=dual(mpc(self.alpha, TINY), turn), stable=HALF).get(self.method, HALF if self.printed else ZERO)
        moved = [dual(STEP**2) * (dual(mpf(k * (k - 1)) / 2) + self.kappa * dual(mpf(k))) for k in range(N + 1)]
        summed = []
        for z in ([ONE] * (N + 1), [dual(v) for v in t], moved):
            H = [total(w[n] * z[k - n] for n in range(k + 1)) for k in range(N + 1)]
            summed.append([ZERO])
            for k in range(N):
                summed[-1].append(summed[-1][-1] + unit * ((HALF - theta) * H[k] + (HALF + theta) * H[k + 1]))
        if not self.printed:
            summed[1] = exact[2]  # (13.18)
        return exact, summed

    def compared(self, k, n, J, size, is_moving, answers):
        """Return h times the force of row k by (13.20)."""
        exact, summed = answers
        to = 1 if is_moving and self.alpha > 0.5 else 2
        g = [(J[k - m] - total(size[i] * summed[i][k - m] for i in range(to))) / summed[to][k - m] for m in range(n + 1)]
        slope = total(dual((-1) ** m * binomial(n, m) / m) * (g[m] - g[0]) for m in range(1, n + 1))
        force = total(size[i] * exact[i][k] for i in range(to)) + g[0] * exact[to][k]
        return dual(STEP) * force + exact[to + 1][k] * slope

    def by_power(self, k, n, J, jumps, turn):
        """Return h times the force of row k from J = t^q g(t), by differentiating g."""
        q = (1 if jumps else 2) - self.tilted
        slope = dual(q, turn) * by(J[k], k)
        for m in range(1, n + 1):
            before = J[k - m] * dual((mpf(k) / (k - m)) ** q, turn)
            slope += dual((-1) ** m * binomial(n, m) / m) * (before - J[k])
        return slope

    def of_impulses(self, rows, q, turn):
        degree, first, sum_ = 1 if self.printed else 3, 3 if self.printed else 30, ZERO
        self.tilted = mpc(2 * self.alpha, 2 * TINY)
        lead, answers = self.lead(turn), self.answers(turn)
        for i in range(D5):
            x0, v0, rho = q["x0"][i], q["p0"][i] / q["mass"][i], q["rho"][i]
            J = [row[i] + rho * v0 * more for row, more in zip(rows, lead)]
            jumps, is_moving = self.past == "rl" and x0.v != 0, v0.v != 0
            size = [rho * x0 if jumps else ZERO, rho * v0]
            sum_ += weight(0, i, 0) * self.start(i, q, J)
            for k in range(1, N + 1):
                if k > first:
                    h_f = total(dual((-1) ** m * binomial(degree, m) / m) * (J[k - m] - J[k]) for m in range(1, degree + 1))
                elif jumps and (not self.printed or self.alpha >= 0.5):  # the steps do not sum the impulse of a jump
                    h_f = self.by_power(k, min(k - 1, degree), J, self.alpha < 0.5, turn)
                else:
                    h_f = self.compared(k, min(k - 1, degree), J, size, is_moving, answers)
                sum_ += weight(k, i, 0) * h_f / dual(STEP)
                sum_ += HALF * weight(k, i, 1) * J[k] * J[k]
        return sum_


random = Random(2330)
runs = [chain(random, method, past, alpha, Forces) for method in METHODS for past in ("held", "caputo", "rl")
        for alpha in (0.05, 0.35, 0.5, 0.7, 0.95)]
header("verify/adjoint/adjoint_forces.py")
print("""
/* As ref_nodes, and J has sum_k,i a_ki f_ki + b_ki I_ki^2/2 more, with the forces f and the impulses I of the dampers,
   a_ki = ((3 k + 5 i) mod 7 - 3)/8 and b_ki = ((3 k + 5 i + 4) mod 7 - 3)/8 */""")
print("static const size_t ref_force_entries[] = { " + ", ".join(map(str, FORCES)) + " };")
table("ref_forces", "const fvi_method *method; fvi_initial_history past; double alpha, kappa, x0[5], p0[5], mass[5], "
      "rho[5], cg[2], want[26];", runs)
