"""The same motions by scipy's solve_ivp and by fvi. Prints a table; a minute.

    PYTHONPATH=build/python/site python3 tests/bench/bench_scipy.py > tests/bench/bench_scipy.tsv

A Duffing oscillator, m = c = 1, g = 1/2, rho = 0.4, 201 rows to t = 20. With alpha = 1/2 the damping is a dashpot,
and solve_ivp takes the two equations as they are. With alpha = 0.3 it has no memory: D^0.6 x is written as an integral
over decaying modes, y_r' = x' - r y_r, at 60 rates that grow by a factor, and solve_ivp takes 62 equations; what is
slower is a spring, what is faster a dashpot. Times are
the least of several, in milliseconds; errors max |x - x(t)| against a run of fvi-lobatto8 with 4000 steps."""
import platform
import time

import fvi
import numpy as np
import scipy
from scipy.integrate import solve_ivp

T = np.linspace(0, 20, 201)


def least(call, times=5):
    best = np.inf
    for _ in range(times):
        start = time.perf_counter()
        x = call()
        best = min(best, time.perf_counter() - start)
    return x, 1e3 * best


def dashpot(t, y):
    return y[1], -y[0] - 0.5 * y[0]**3 - 0.4 * y[1]


step = 0.5
rates = np.exp(np.arange(-16, 14, step))
shares = np.sin(np.pi * 0.6) / np.pi * rates**0.6 * step
slow, fast = rates[0] * np.exp(-step / 2), rates[-1] * np.exp(step / 2)  # slower modes are springs, faster ones dashpots
spring, dash = np.sin(np.pi * 0.6) / np.pi * np.array([slow**0.6 / 0.6, fast**-0.4 / 0.4])


def modes(t, y):
    f = -y[0] - 0.5 * y[0]**3 - 0.4 * (shares @ y[2:] + spring * (y[0] - 1) + dash * y[1])
    return np.concatenate([[y[1], f], y[1] - rates * y[2:]])


def row(what, call, truth):
    x, ms = least(call)
    print(f"{what:34s}\t{abs(np.ravel(x) - truth).max():.0e}\t{ms:.1f}", flush=True)


print("# tests/bench/bench_scipy.py: milliseconds")
print(f"# machine: {platform.machine()}; python {platform.python_version()}, numpy {np.__version__}, scipy {scipy.__version__}")
for alpha, f, y0, solvers in ((0.5, dashpot, [1, 0.5], ("RK45", "DOP853", "LSODA")),
                              (0.3, modes, [1, 0.5] + [0] * len(rates), ("LSODA", "BDF", "Radau"))):
    q = fvi.Problem("duffing:1,0.5", alpha=alpha, rho=0.4)
    truth = fvi.solve(q, T, h=0.005, method="fvi-lobatto8").x[:, 0]
    print(f"#> alpha{10 * alpha:.0f}\n# alpha = {alpha}\terror\tms")
    for error in (1e-4, 1e-8):
        for method in solvers:
            row(f"solve_ivp {method} rtol={error:.0e}",
                lambda: solve_ivp(f, (0, 20), y0, method, T, rtol=error, atol=error / 100).y[0], truth)
        row(f"fvi.solve error={error:.0e}", lambda: fvi.solve(q, T, error=error).x, truth)
    row("fvi.solve h=0.1 fvi-lobatto4", lambda: fvi.solve(q, h=0.1, method="fvi-lobatto4").x, truth)
    print(f"#< alpha{10 * alpha:.0f}")
