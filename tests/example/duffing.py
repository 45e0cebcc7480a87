"""The example of README.md, from Python."""
#> example
import fvi

problem = fvi.Problem("duffing:1,0.5", alpha=0.3, rho=0.4, x0=1, p0=0.5, time=20)
solution = fvi.solve(problem, h=0.1, method="fvi-lobatto3")
for t, x in zip(solution.t, solution.x[:, 0]):
    print(t, x, sep="\t")
#< example
