"""The order of a damping from a measured motion."""
#> example
import fvi
import numpy as np

true = fvi.Problem("harmonic:1", alpha=0.3, rho=0.4, x0=1, p0=0.25)
t = 0.1 * np.arange(1, 201)
x = fvi.solve(true, error=1e-6)(t)[:, 0] + 0.02 * np.random.default_rng(2).standard_normal(200)
found = fvi.fit(t, x, "harmonic:1", which="alpha,rho,c", p0=0.25, sigma=0.02)
for name in found.estimate:
    low, high = found.interval[name]
    print(f"{name} = {found.estimate[name]:.3f}, with 95 % between {low:.3f} and {high:.3f}")
#< example
