"""A building of five floors with two dampers in an earthquake of one frequency."""
#> example
import fvi
import numpy as np

n = 5
K = 100 * (2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1))
K[-1, -1] = 100  # nothing above the roof
ground, second = np.eye(n)[0], np.eye(n)[2] - np.eye(n)[1]
building = fvi.Problem(M=np.eye(n), K=K, dampers=[(ground, "power:5,0.3"), (second, "zener:5,0.3,0.1")],
                       force="-sin(3*t)", time=40)
s = fvi.solve(building, h=0.02)
poles = fvi.poles(building)
print(f"first mode: {poles.frequency[0]:.3f} Hz, damping ratio {poles.damping[0]:.3f}")
print(f"largest drift of the roof: {abs(s.x[:, 4] - s.x[:, 3]).max():.4f}")
print(f"the dampers took {s.work['d1'][-1]:.3f} and {s.work['d2'][-1]:.3f} of {s.work['force'][-1]:.3f}")
#< example
