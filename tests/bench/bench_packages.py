"""One motion by scipy, by FDEint and by fvi. Prints a table; two minutes.

    PYTHONPATH=build/python/site python3 tests/bench/bench_packages.py > tests/bench/bench_packages.tsv

A Duffing oscillator, m = c = 1, g = 1/2, rho = 0.4, x(0) = 1, v(0) = 1/2, 201 rows to t = 20. Its damping is a dashpot,
2 alpha = 1, or a springpot of order 2 alpha = 1/2. Times are the least of three, in milliseconds; errors
max |x - x(t)| against a run of fvi-lobatto8 with 4000 steps. FDEint is left out if it cannot be imported; it is at
github.com/zimmer-ing/FDEint."""
import importlib.metadata
import platform
import time

#> scipy
import numpy as np
from scipy.integrate import solve_ivp

T = np.linspace(0, 20, 201)
rates = np.exp(np.arange(-16, 14, 0.5))  # 60 modes, y' = x' - rate y
shares = np.sin(np.pi / 2) / np.pi * rates**0.5 * 0.5
slow, fast = rates[0] * np.exp(-0.25), rates[-1] * np.exp(0.25)  # slower modes: a spring; faster modes: a dashpot
spring, dash = np.array([slow**0.5, fast**-0.5]) / 0.5 / np.pi

def modes(t, y):
    force = shares @ y[2:] + spring * (y[0] - 1) + dash * y[1]
    a = -y[0] - 0.5 * y[0]**3 - 0.4 * force
    return np.concatenate([[y[1], a], y[1] - rates * y[2:]])

def by_scipy(method, rtol):
    return solve_ivp(modes, (0, 20), [1, 0.5] + [0] * 60, method, T, rtol=rtol, atol=rtol / 100).y[0]
#< scipy


def by_fdeint(steps):
    #> fdeint
    import torch
    from FDEint import FDEint

    def halves(t, y):  # y, D^(1/2) y, y', D^(1/2) y'
        a = -y[:, :1] - 0.5 * y[:, :1]**3 - 0.4 * y[:, 1:2]
        return torch.cat([y[:, 1:], a], dim=1)
    y0 = torch.tensor([[1, 0, 0.5, 0]], dtype=torch.float64)
    t = torch.linspace(0, 20, 201, dtype=torch.float64)
    half = torch.tensor([0.5], dtype=torch.float64)
    x = FDEint(halves, t, y0, half, h=torch.tensor(20 / steps, dtype=torch.float64), dtype=torch.float64)[0, :, 0]
    #< fdeint
    return x.numpy()


#> fvi
import fvi

problem = fvi.Problem("duffing:1,0.5", order=0.5, rho=0.4, x0=1, p0=0.5, time=20)

def by_fvi(error):
    return fvi.solve(problem, T, error=error).x[:, 0]
#< fvi


def dashpot(t, y):
    return y[1], -y[0] - 0.5 * y[0]**3 - 0.4 * y[1]


def row(what, call, truth, times=3):
    best = np.inf
    for _ in range(times):
        start = time.perf_counter()
        x = call()
        best = min(best, time.perf_counter() - start)
    print(f"{what:34s}\t{abs(x - truth).max():.0e}\t{1e3 * best:.1f}", flush=True)


def exact(q):
    return fvi.solve(q, T, h=0.005, method="fvi-lobatto8").x[:, 0]


def versions():
    print("# tests/bench/bench_packages.py: milliseconds")
    print(f"# machine: {platform.machine()}; python {platform.python_version()}, "
          + ", ".join(f"{name} {importlib.metadata.version(name)}" for name in ("numpy", "scipy")) + f", fvi {fvi.version()}")
    try:
        import FDEint  # noqa: F401
        import torch
    except ImportError:
        print("# FDEint: not here")
        return False
    print(f"# FDEint: run with torch {torch.__version__}, {torch.get_num_threads()} threads")
    return True


if __name__ == "__main__":
    has_fdeint = versions()
    truth = exact(problem.replace(order=1))
    print("#> dashpot\n# 2 alpha = 1\terror\tms")
    for tolerance in (1e-4, 1e-8):
        for method in ("RK45", "DOP853", "LSODA"):
            row(f"solve_ivp {method} rtol={tolerance:.0e}",
                lambda: solve_ivp(dashpot, (0, 20), [1, 0.5], method, T, rtol=tolerance, atol=tolerance / 100).y[0], truth)
        row(f"fvi.solve error={tolerance:.0e}", lambda: fvi.solve(problem.replace(order=1), T, error=tolerance).x[:, 0], truth)
    print("#< dashpot")
    truth = exact(problem)
    print("#> springpot\n# 2 alpha = 1/2\terror\tms")
    for method in ("LSODA", "BDF", "Radau"):
        for tolerance in (1e-4, 1e-8):
            row(f"solve_ivp {method} rtol={tolerance:.0e}", lambda: by_scipy(method, tolerance), truth)
    for steps in (200, 2000, 20000) if has_fdeint else ():
        row(f"FDEint {steps} steps", lambda: by_fdeint(steps), truth, 1 if steps > 2000 else 3)
    for tolerance in (1e-4, 1e-8):
        row(f"fvi.solve error={tolerance:.0e}", lambda: by_fvi(tolerance), truth)
    row("fvi.solve h=0.1 fvi", lambda: fvi.solve(problem, h=0.1).x[:, 0], truth)
    row("fvi.solve h=0.1 fvi-lobatto4", lambda: fvi.solve(problem, h=0.1, method="fvi-lobatto4").x[:, 0], truth)
    print("#< springpot")
