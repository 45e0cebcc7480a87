"""Mechanics with memory, m x'' + grad U(x) + rho D^{2 alpha} x = F(t), by variational integrators.

    >>> import fvi
    >>> run = fvi.run("duffing:1,0.5", alpha=0.3, rho=0.4, x0=1, p0=0.5, h=0.1, steps=200)
    >>> run.t.shape, run.x.shape, run.p.shape
    ((201,), (201,), (201,))
    >>> print(f"at t = {run.t[200]:g} the body is at {run.x[200]:.5f}")
    at t = 20 the body is at -0.00651

Its options bear the names that they have in the program `fvi run`, and have the same
defaults; `help(fvi.run)` lists those that there are. Lengths, times and masses are in units of your own.

    run         a whole trajectory as arrays
    Stepper     one step after the other: look, fork, go on
    fit         parameters from a measured motion
    exact       the exact solution of the linear problem
    methods     what `method` can be
    weights     the Grunwald-Letnikov weights of any order up to 2
    potential   U from functions of Python's, or compiled ones
    Error       what is raised where the library returns a code
    Warning     what warnings.warn says where the numbers are not those of a motion
"""
from ._fit import Fit, fit
from ._library import Error, Warning
from ._problem import Potential, potential
from ._run import Method, Run, Stepper, exact, methods, run, version, weights

__version__ = version()
__all__ = ["Error", "Fit", "Method", "Potential", "Run", "Stepper", "Warning", "exact", "fit", "methods", "potential",
           "run", "version", "weights"]
