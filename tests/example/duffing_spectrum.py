"""Duffing's oscillator under a periodic force, and its spectrum."""
#> example
import fvi
import numpy as np

problem = fvi.Problem("duffing:1,1", alpha=0.3, rho=0.3, force="cosine:2,0.6", x0=0, p0=0, time=400)
s = fvi.solve(problem, error=1e-6, steps=4000)
late = s.x[2000:, 0]  # after the motion from the start has died out
size = 2 * abs(np.fft.rfft(late * np.hanning(late.size)) / late.size)
omega = 2 * np.pi * np.fft.rfftfreq(late.size, d=0.1)
for line in (0.6, 1.8, 3.0):
    print(f"at omega = {line}: {size[abs(omega - line) < 0.1].max():.4f}")
#< example
