"""From moduli that a rheometer measured to a motion."""
#> example
import fvi
import numpy as np

rng = np.random.default_rng(1)
omega = np.geomspace(0.1, 100, 31)
G = fvi.moduli("spring:2 + power:1.5,0.3", omega) * (1 + 0.01 * rng.standard_normal(31))  # the measurement
found = fvi.fit_moduli(omega, G.real, G.imag, "spring+power")
for name, (low, high) in found.interval.items():
    print(f"{name} = {found.estimate[name]:.3f}, with 95 % between {low:.3f} and {high:.3f}")
mass = fvi.Problem("free", damping=found.law, x0=0, p0=1, time=10)  # a mass on the sample, after a hit
s = fvi.solve(mass, h=0.01, method="fvi-lobatto4")
print(f"it goes as far as {s.x.max():.3f}")
#< example
