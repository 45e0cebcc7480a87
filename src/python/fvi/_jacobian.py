"""The derivatives of every x of a motion."""
from __future__ import annotations

from typing import Any, Optional, Sequence

import numpy as np

from ._arguments import described, names as names_of, spelt
from ._fvi import ffi, lib
from ._gradient import Mirror, vjp, wanted_of
from ._library import ask, succeed
from ._solution import Solution


def tangents(s: Solution, names: Sequence[str]) -> Optional[dict]:
    """By (24.6), side by side with the run: of one mass by Algorithm 3. None where the library has no such run."""
    mirror = Mirror(s)
    places = {"alpha": lib.FVI_FREE_PARAMETER_ALPHA, "rho": lib.FVI_FREE_PARAMETER_RHO,
              "mass": lib.FVI_FREE_PARAMETER_MASS, "x0": lib.FVI_FREE_PARAMETER_X0, "p0": lib.FVI_FREE_PARAMETER_P0}
    if (mirror.method != lib.fvi_method_find(b"fvi") or mirror.d > 1 or s.problem.damping is not None
            or not set(names) <= set(places) or s.problem.v0 is not None):
        return None
    which = ffi.new("fvi_free_parameter[]", [int(places[name]) for name in names])
    x, slope = np.empty(mirror.steps + 1), np.empty((mirror.steps + 1, len(names)))
    succeed(ask(lib.fvi_tangent, mirror.motion.run, len(names), which, ffi.from_buffer("double[]", x),
                ffi.from_buffer("double[]", slope)))
    given = {name: getattr(s.problem, name) for name in names}
    return {name: slope[mirror.rows, j].reshape((len(s.t), 1) + np.shape(given[name] if given[name] is not None else 0))
            for j, name in enumerate(names)}


def flat(found: Any) -> Any:
    """A gradient's member as an array."""
    if isinstance(found, dict):
        return np.array(list(found.values()))
    if isinstance(found, list):
        return np.array([v for each in found for term in (each if isinstance(each, list) else [each])
                         for v in term.values()])
    return np.asarray(found)


@spelt()
def jacobian(solution: Solution, wrt: Sequence[str]) -> dict:
    """The derivatives of every x of every row: for least squares.

        J = fvi.jacobian(s, ["alpha", "rho"])
        J["alpha"].shape == (len(s.t), d)

    solution  of `solve`
    wrt       fields of the problem, as `vjp` has them

    Returns a dict by names of arrays (n, d) and the shape of the field; of "let" and "damping" in the order of
    their numbers. One coordinate by "fvi" goes by tangents, (24.6), side by side with the run: the cost of a run for each
    name. Else there is a mirrored run for each x: ask for few rows then.
    """
    if not isinstance(solution, Solution):
        raise TypeError(f"solution: {described(solution)} is no Solution")
    names = names_of("wrt", wrt)
    wanted_of(solution.problem, names, solution.motion.system.is_expression)
    found = tangents(solution, names)
    if found is not None:
        return found
    n, d = solution.x.shape
    rows: dict = {name: [] for name in names}
    for k in range(n * d):
        one = np.zeros(n * d)
        one[k] = 1
        g = vjp(solution, x=one.reshape(n, d), wrt=names)
        for name in names:
            rows[name].append(flat(g[name]))
    return {name: np.array(each).reshape((n, d) + each[0].shape) for name, each in rows.items()}
