"""H 23. Methods without stages: derivatives of runs of chains of five masses.

The runs follow Algorithm 3 and (13.7) as they are written in the chapters, in dual numbers of 45 digits, for all four
methods, three pasts and five orders."""
from random import Random

from shared.node_runs import FORCES, chain
from shared.refgen import METHODS, header, table

random = Random(236)
runs = [chain(random, method, past, alpha) for method in METHODS for past in ("held", "caputo", "rl")
        for alpha in (0.05, 0.35, 0.5, 0.7, 0.95)]
header("verify/adjoint/adjoint_nodes.py")
print("""
/* Five masses, F = cos(5t/4)/5 on each, h = 1/16, twelve steps; dJ, J as in to_sine, by x0, p0,
   mass, rho, c, g, alpha, and three entries of F */""")
print("static const size_t ref_node_forces[] = { " + ", ".join(map(str, FORCES)) + " };")
table("ref_nodes", "const fvi_method *method; fvi_initial_history past; double alpha, kappa, x0[5], p0[5], mass[5], "
      "rho[5], cg[2], want[26];", runs)
