"""A problem, its motion, and the questions that a solution answers."""
#> example
import fvi

problem = fvi.Problem("duffing:1,0.5", alpha=0.3, rho=0.4, x0=1, p0=0.5, time=20)
s = fvi.solve(problem, error=1e-6)
print(f"x(20) = {s.x[-1, 0]:.6f}, off by {s.estimate:.0e} at most, by an estimate")
print(f"x(3.21) = {s(3.21)[0]:.6f}")
print(f"energy {s.energy[0]:.3f} and {s.energy[-1]:.3f}; the damper took {s.work['d1'][-1]:.3f}")
#< example
