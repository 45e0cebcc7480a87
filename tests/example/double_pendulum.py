"""A double pendulum with a damper in its elbow."""
#> example
import fvi

L = "v1^2 + v2^2/2 + v1*v2*cos(x1 - x2) + 9.81*(2*cos(x1) + cos(x2))"
arm = fvi.Problem(lagrangian=L, dampers=["elbow=x2 - x1 : power:0.5,0.25"], x0=[2, 2.5], v0=[0, 0], time=20)
s = fvi.solve(arm, h=0.01, method="fvi-lobatto4")
print(f"energy {s.energy[0]:.3f} at the start, {s.energy[-1]:.3f} at the end")
print(f"the elbow took {s.work['elbow'][-1]:.3f}, largest force {abs(s.forces['elbow']).max():.3f}")
#< example
