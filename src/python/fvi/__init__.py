"""Mechanics with memory, m x'' + grad U(x) + rho D^{2 alpha} x = F(t), by variational integrators.

    >>> import fvi
    >>> problem = fvi.Problem("duffing:1,0.5", alpha=0.3, rho=0.4, x0=1, p0=0.5, time=20)
    >>> solution = fvi.solve(problem, error=1e-6)
    >>> print(f"at t = 20 the body is at {solution.x[-1, 0]:.5f}")
    at t = 20 the body is at -0.00635
    >>> solution(3.21).shape, solution.energy.shape
    ((1,), (201,))

A problem is the mathematics, `solve` the numerics; `help(fvi.Problem)` and `help(fvi.solve)` have all arguments.
Lengths, times and masses are in units of your own.

    Problem     what moves: potential, mass, damping, force, start; never changes, pickles
    solve       its motion: a Solution with t, x, p, v, a, energy, forces, work; any time, tables, peaks, plots
    Event       what is watched along a motion: a mark, a stop, an impact, a contact
    sweep       the motions of many problems, on all cores
    vjp         the gradient of what is made of a motion, by all that determines it
    gradient    a loss and its gradient; `import fvi.torch` has motions for torch
    jacobian    the derivatives of each x, for least squares
    fit         parameters from a measured motion
    fit_moduli  a law of damping from moduli; fit_creep, fit_relaxation; moduli, creep, relaxation of a law
    response    what a shaker test measures; poles: frequencies and damping ratios
    control     the least force that ends a motion at a place; stability: how long a step may be
    formulas    what each word stands for: laws, potentials, forces, the past
    potential   U from functions of Python's, or compiled ones
    exact       the exact solution of the linear problem; exact_motion: of several masses, with accelerations and forces
    methods     what `method` can be
    weights     the Grünwald-Letnikov weights of any order up to 2
    run         a whole trajectory as arrays, its options those of the program `fvi run`
    Stepper     one step after the other: look, fork, go on
    Error       what is raised where the library returns a code
    FviWarning  what warnings.warn says where the numbers are not those of a motion
"""
import importlib as _importlib
from typing import Any as _Any

for _name, _package in (("numpy", "numpy"), ("_cffi_backend", "cffi")):
    try:
        _importlib.import_module(_name)
    except ModuleNotFoundError as _missing:
        raise ModuleNotFoundError(f"fvi needs {_package}, which this Python does not find: python -m pip install {_package}",
                                  name=_package) from _missing

from ._events import Event as Event
from ._exact import SpringBound as SpringBound, exact as exact, spring_bound as spring_bound, weights as weights
from ._fit import Fit as Fit, fit as fit
from ._gradient import gradient as gradient, vjp as vjp
from ._jacobian import jacobian as jacobian
from ._material import (Material as Material, creep as creep, fit_creep as fit_creep, fit_moduli as fit_moduli,
                        fit_relaxation as fit_relaxation, moduli as moduli, relaxation as relaxation)
from ._problem import Problem as Problem
from ._response import (Bound as Bound, Control as Control, Poles as Poles, Stability as Stability, control as control,
                        ExactMotion as ExactMotion, error_bound as error_bound, exact_motion as exact_motion, poles as poles, response as response, stability as stability)
from ._run import Method as Method, Run as Run, Stepper as Stepper, methods as methods, run as run, version as version
from ._solution import Solution as Solution
from ._solve import solve as solve
from ._sweep import sweep as sweep
from ._system import Potential as Potential, formulas as formulas, potential as potential
from .errors import Error as Error, FviWarning as FviWarning, Warning as Warning

__version__ = version()


def __getattr__(name: str) -> _Any:
    """fvi.torch is there without an import, and asks for torch only when it is used."""
    if name == "torch":
        return _importlib.import_module(".torch", __name__)
    raise AttributeError(f"module 'fvi' has no attribute '{name}'")
