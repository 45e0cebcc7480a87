"""H 23. Derivatives of the forces and of the impulses of dampers, of chains by the methods without stages.

The impulses are the sums of the steps, with what a start with a velocity leaves in them (13.18); the forces are their
slopes as H 13 has them: differences of J, in the first rows of J/t^q. In dual numbers of 45 digits."""
from random import Random

import mpmath
from mpmath import binomial, mpc, mpf

from shared.adjoint_chain import D5
from shared.arithmetic import HALF, ONE, TINY, ZERO, Dual, dual
from shared.node_runs import FORCES, N, STEP, Nodes, by, chain, total, weights
from shared.refgen import METHODS, header, table


def weight(k, i, of):
    """What J has of the force or of the impulse of mass i in row k."""
    return dual(mpf((3 * k + 5 * i + 4 * of) % 7 - 3) / 8)


class Forces(Nodes):
    def lead(self, turn):
        """Of a line with the velocity 1 and rho = 1: the exact impulse, less that of the steps."""
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
        """The force at t = 0; where it is infinite, the mean of the first row."""
        order, x0, v0 = 2 * self.alpha, q["x0"][i], q["p0"][i] / q["mass"][i]
        if order == 1:
            return q["rho"][i] * v0
        if order < 1 and (self.past != "rl" or x0.v == 0):
            return ZERO
        return ZERO if order > 1 and self.past == "caputo" else J[1] / dual(STEP)

    def force(self, k, J, jumps, turn):
        """h f at row k > 0 by differences of order 1 or 3; in the first rows J = t^q g(t), and g is differentiated."""
        degree = 1 if self.printed else 3
        is_near = k <= 3 * degree
        n = min(k - 1 if is_near else k, degree)
        q = mpc((1 if jumps else 2) - 2 * self.alpha, -2 * TINY)
        slope = dual(q, turn) * by(J[k], k) if is_near else ZERO
        for m in range(1, n + 1):
            before = J[k - m] * dual((mpf(k) / (k - m)) ** q, turn) if is_near else J[k - m]
            slope += dual((-1) ** m * binomial(n, m) / m) * (before - J[k])
        return slope

    def of_impulses(self, rows, q, turn):
        lead, sum_ = self.lead(turn), ZERO
        for i in range(D5):
            rate = q["rho"][i] * q["p0"][i] / q["mass"][i]
            J = [row[i] + rate * more for row, more in zip(rows, lead)]
            jumps = self.past == "rl" and self.alpha < 0.5 and q["x0"][i].v != 0
            sum_ += weight(0, i, 0) * self.start(i, q, J)
            for k in range(1, N + 1):
                sum_ += weight(k, i, 0) * self.force(k, J, jumps, turn) / dual(STEP)
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
