"""How much does the last position depend on each parameter?"""
#> example
import fvi
import numpy as np

problem = fvi.Problem("duffing:1,0.5", alpha=0.3, rho=0.4, x0=1, p0=0.5, time=20)
s = fvi.solve(problem, h=0.1, method="fvi-lobatto4")
last = np.zeros(s.x.shape)
last[-1] = 1  # L is the last position; x=..., p=... and energy=... are dL by every row
g = fvi.vjp(s, x=last)
print(f"by alpha {g['alpha']:.4f}, by rho {g['rho']:.4f}, by x0 {g['x0']:.4f}, by c and g {g['potential'].round(4)}")
#< example
