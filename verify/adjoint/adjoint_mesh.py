"""H 23. Steps of any length: derivatives of runs of chains of five masses on a given mesh.

The runs and their slopes are those of adjoint_steps.py, in dual numbers of 45 digits."""
from random import Random

import mpmath
from mpmath import mp, mpf
from sympy import Rational

from shared.adjoint_chain import D5, numbers
from shared.adjoint_steps import Mesh, literal, powers
from shared.arithmetic import BITS, ZERO, dual, real_function
from shared.refgen import initial_history, claim, header, hexd, table

mp.dps = 72
UNIT = 2**-20


# The first step is shorter than the first step that the method would choose, and each further step is shorter than
# the method allows after the step before it. So the method accepts these steps when it is told where to end them.
UNITS = [57, 58, 121, 262, 563, 1208, 2600, 5571, 11980, 23000, 40000, 60000, 90000, 130000, 158868]
# Small impulses at the start, at the beginning of a step with a row in it, and at the end.
IMPULSES = {k: [(-1) ** (j + k) * (j + 1) * 2.0**-17 for j in range(D5)] for k in (0, 11, 15)}
ROWS, CASES = 4, [("held", 0.0), ("held", 0.05), ("held", 0.35), ("rl", 0.5),
                  ("caputo", 0.7), ("caputo", 0.95), ("caputo", 1.0)]


def chain(random, past, alpha):
    uniform = lambda a, b: round(random.uniform(a, b) * 2**20) / 2**20
    data = dict(x0=[uniform(-1, 1) for _ in range(D5)], p0=[uniform(-1, 1) for _ in range(D5)],
                mass=[uniform(0.5, 2) for _ in range(D5)],
                rho=[0.0 if i == 2 else uniform(0, 0.4) for i in range(D5)],
                cg=[uniform(0.5, 2), uniform(0.2, 1)])
    q = {k: [dual(mpf(v)) for v in w] for k, w in data.items()}
    q["F"] = [ZERO] * ((ROWS + 1) * D5)
    run = Mesh(8, 1, past, alpha, q, [u * UNIT for u in UNITS], sum(UNITS) * UNIT / ROWS,
               IMPULSES if alpha <= 0.5 else {})  # for larger alpha too rough for such steps
    want = run.slopes([(name, i) for name in ("x0", "p0", "mass", "rho") for i in range(D5)]
                      + [("cg", 0), ("cg", 1), ("alpha", 0)]
                      + [("F", i) for i in (0, 12, len(q["F"]) - 1)])
    return ([initial_history(past), repr(alpha)]
            + [literal(map(mpf, data[k])) for k in ("x0", "p0", "mass", "rho", "cg")] + [literal(want)])


random = Random(2316)
runs = [chain(random, past, alpha) for past, alpha in CASES]

# (23.18): the block that a step contributes to itself, for the last step of the last run
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
table("ref_meshes", "fvi_initial_history past; double alpha, x0[5], p0[5], mass[5], rho[5], cg[2], want[26];", runs)
