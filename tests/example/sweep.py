"""The height of a resonance for forty frequencies and two orders, on all cores."""
#> example
import fvi
import numpy as np

problem = fvi.Problem("x^2/2 + x^4/20", let={"w": 1}, force="0.2*cos(w*t)", rho=0.2, x0=0, p0=0, time=100)
orders, omega = [0.3, 0.7], np.linspace(0.5, 2, 40)
peak = fvi.sweep(problem, {"alpha": orders, "w": omega}, lambda s: abs(s.x[len(s.t) // 2:]).max(), error=1e-4)
for alpha, row in zip(orders, peak):
    print(f"alpha = {alpha}: the highest is {row.max():.2f}, at omega = {omega[row.argmax()]:.2f}")
#< example
