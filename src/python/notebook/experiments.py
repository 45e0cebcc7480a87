# %% [markdown]
# # A damping that remembers, from Python
#
# The oscillator of the paper's numerical section, $m x'' + c x + \rho D^{2\alpha} x = 0$ with
# $m = c = 1$, $\rho = 0.2$, held at $x_0 = 1$ and let go with $p_0 = 0.5$: first what the order of
# the damping does, then the way back, from a measured motion to the order. Each number and each picture below
# was computed when this notebook was built (`make notebook`).

# %%
import fvi
import numpy as np


class picture:
    """Curves (x, y, name, dots or not) as an SVG, without any library."""
    colours = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#777777"]

    def __init__(self, title, *curves):
        self.title, self.curves = title, curves

    def _repr_svg_(self):
        x, y = (np.concatenate([np.asarray(c[i], float) for c in self.curves]) for i in (0, 1))
        across = lambda v: 50 + 560 * (v - x.min()) / np.ptp(x)
        up = lambda v: 330 - 290 * (v - y.min()) / np.ptp(y)
        lines = [f'<svg xmlns="http://www.w3.org/2000/svg" width="740" height="380" font-family="sans-serif" font-size="12">'
                 f'<rect width="740" height="380" fill="#fff"/><text x="50" y="20" font-size="14">{self.title}</text>'
                 f'<path d="M50 40V330H610" fill="none" stroke="#000"/>']
        for v in np.linspace(x.min(), x.max(), 6):
            lines.append(f'<text x="{across(v):.0f}" y="348" text-anchor="middle">{v:.3g}</text>')
        for v in np.linspace(y.min(), y.max(), 6):
            lines.append(f'<text x="44" y="{up(v) + 4:.0f}" text-anchor="end">{v:.2g}</text>')
        for i, (a, b, name, dots) in enumerate(self.curves):
            colour = self.colours[i % len(self.colours)]
            points = [(across(p), up(q)) for p, q in zip(a, b)]
            if dots:
                lines += [f'<circle cx="{p:.1f}" cy="{q:.1f}" r="2.5" fill="{colour}"/>' for p, q in points]
            else:
                path = " ".join(f"{p:.1f},{q:.1f}" for p, q in points)
                lines.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="1.5"/>')
            lines.append(f'<text x="620" y="{50 + 18 * i}" fill="{colour}">{name}</text>')
        return "\n".join([*lines, "</svg>"])


# %% [markdown]
# ## Seven orders of damping
#
# The first panel of H 10, with the paper's long steps, $h = 1/2$. At $\alpha = 0$ the damping is a second
# spring, at $\alpha = 1/2$ ordinary friction, at $\alpha = 1$ a second mass.

# %%
orders = [0, 0.25, 0.4, 0.5, 0.6, 0.75, 1]
runs = {alpha: fvi.run(alpha=alpha, rho=0.2, h=0.5, steps=30) for alpha in orders}
fine = np.linspace(0, 15, 301)
picture("x against t", (fine, fvi.exact(fine, alpha=0.5, rho=0.2)[0], "exact, α = 0.5", False),
        *((r.t, r.x, f"α = {alpha}", True) for alpha, r in runs.items()))

# %% [markdown]
# How far are they from the exact motion?

# %%
for alpha, r in runs.items():
    exact = fvi.exact(r.t, alpha=alpha, rho=0.2)[0]
    print(f"alpha = {alpha:4}   largest error {abs(r.x - exact).max():.1e}")

# %% [markdown]
# The steps are long, and the order is 1. Or one asks for an error, and leaves the steps to the program:

# %%
r = fvi.run(alpha=0.3, rho=0.2, error=1e-10, time=15, steps=30)
print(f"estimate {r.estimate:.0e}, error {abs(r.x - fvi.exact(r.t, alpha=0.3, rho=0.2)[0]).max():.0e}")

# %% [markdown]
# ## Which alpha was it?
#
# A measured motion: 200 positions of a body that is damped by $\alpha = 0.3$, $\rho = 0.4$, each with an error of
# 0.02. Nothing but the positions is known to the fit.

# %%
t = 0.1 * np.arange(1, 201)
noise = np.random.default_rng(1).normal(0, 0.02, t.size)
data = fvi.exact(t, alpha=0.3, rho=0.4, x0=1, v0=0.25)[0] + noise
found = fvi.fit(t, data, which="alpha,rho,c,p0")
for name, truth in (("alpha", 0.3), ("rho", 0.4), ("c", 1.0), ("p0", 0.25)):
    low, high = found.interval[name]
    print(f"{name:5}  {found.estimate[name]:.3f}   95 %: {low:.3f} to {high:.3f}   truth {truth}")
print(f"noise {found.sigma:.3f}, {found.agree} of the starts agree")
picture("measured, and fitted", (t, data, "data", True), (t, found.curve, "fit", False))
