"""The derivatives of every x of a motion, or of every force of a damper."""
from __future__ import annotations

from typing import Any, Optional, Sequence

import numpy as np

from ._arguments import described, names as names_of, spelt
from ._fvi import ffi, lib
from ._gradient import Derivatives, AdjointRun, named, short_rows, vjp, wanted_of
from ._library import ask, failure, warn
from ._solution import Solution


def tangents(by: Derivatives, n: int) -> Optional[np.ndarray]:
    """How x of the rows changes with each number of the library, side by side with the run, (24.6): (rows, numbers, d).
    None where the library has no such run, or an adjoint run for each of the n numbers x of all rows costs less."""
    adjoint, q, sizes = by.adjoint, by.q, by.sizes
    count = sum(sizes.values())
    if (adjoint.is_dense or q.kind == "mechanism" or {"names", "force"} & set(sizes) or count > n
            or (adjoint.method.stages and q.damping is None and not q.dampers and adjoint.motion.run.alpha == 1)):
        return None
    if count == 0:  # a potential without constants
        return np.empty((len(adjoint.rows), 0, adjoint.d))
    along, kept, first = ffi.new("fvi_sensitivities[]", count), [], 0
    for field, size in sizes.items():
        for unit in np.eye(size):
            kept.append(unit.copy())
            along[first] = by.outputs({field: kept[-1]})[0]
            first += 1
    x, dx = np.empty((adjoint.steps + 1) * adjoint.d), np.empty((adjoint.steps + 1, count, adjoint.d))
    status = ask(lib.fvi_directional_derivatives, adjoint.method, adjoint.motion.run, count, along,
                 ffi.from_buffer("double[]", x), ffi.NULL, ffi.from_buffer("double[]", dx), ffi.NULL)
    if status:
        raise failure(status, said=adjoint.motion.run.failure)
    return dx[adjoint.rows]


def by_numbers(by: Derivatives, dx: np.ndarray) -> list:
    """The gradient of each x of each row, one after another."""
    answers, ends = [], np.cumsum([0, *by.sizes.values()])
    for row in dx:
        for i in range(row.shape[1]):
            found = {field: row[first:first + size, i].copy() for (field, size), first in zip(by.sizes.items(), ends)}
            answers.append(named(by, found))
    return answers


def flat(found: Any) -> Any:
    """A gradient's member as an array."""
    if isinstance(found, dict):
        return np.array(list(found.values()))
    if isinstance(found, list):
        return np.array([v for each in found for term in (each if isinstance(each, list) else [each])
                         for v in term.values()])
    return np.asarray(found)


def of_forces(solution: Solution, names: list, damper: str) -> dict:
    """The same of the forces of a damper, by an adjoint run for each; NaN where they have none."""
    if not isinstance(damper, str):
        raise TypeError(f"forces: {described(damper)} is no name of a damper")
    found: dict = {}
    adjoint = AdjointRun(solution)
    shape = adjoint.told("forces", [damper], lambda: solution.forces)[damper].shape
    short = short_rows(solution)
    known = [k for k in range(len(solution.t)) if adjoint.rows[k] not in short]
    for at in np.ndindex(shape):
        if at[0] not in known:
            continue
        one = np.zeros(shape)
        one[at] = 1
        for name, g in vjp(solution, forces={damper: one}, wrt=names).items():
            by = flat(g)
            found.setdefault(name, np.full(shape + by.shape, np.nan))[at] = by
    if len(known) < len(solution.t):
        warn(f"forces: the derivatives of rows {short.start} to {short.stop - 1} are NaN, because these forces come from steps shorter than those of "
             "the run")
    return found


@spelt()
def jacobian(solution: Solution, wrt: Sequence[str], *, forces: Optional[str] = None) -> dict:
    """The derivatives of every x of every row: for least squares.

        J = fvi.jacobian(s, ["alpha", "rho"])
        J["alpha"].shape == (len(s.t), d)
        J = fvi.jacobian(s, ["alpha"], forces="d1")
        J["alpha"].shape == s.forces["d1"].shape

    solution  of `solve`
    wrt       fields of the problem, as `vjp` has them
    forces    None; or the name of a damper, and the derivatives are those of its forces, as `s.forces` has them, by an adjoint
              run for each. Not by "fvi-adaptive", nor with events; NaN, with a warning, of first rows that come from
              shorter steps, as with an order above 1

    Returns a dict by names of arrays (n, d) and the shape of the field; of "let" and "damping" in the order of
    their numbers. With equal steps the derivatives go side by side with the run, (24.6): the cost of a run for each number.
    Of "fvi-adaptive", of mechanisms, by measured forces and by more numbers than there are x, there is an adjoint run
    for each x: ask for few rows then.
    """
    if not isinstance(solution, Solution):
        raise TypeError(f"solution: {described(solution)} is no Solution")
    names = names_of("wrt", wrt)
    q, adjoint = solution.problem, AdjointRun(solution)
    wanted = wanted_of(q, names, adjoint.motion.system.is_expression, adjoint.is_dense)
    if forces is not None:
        return of_forces(solution, names, forces)
    n, d = solution.x.shape
    by = Derivatives(q, adjoint, wanted, True)
    dx = tangents(by, n * d)
    rows: dict = {name: [] for name in names}
    ones = np.eye(n * d) if dx is None else np.zeros((0, 0))
    for g in by_numbers(by, dx) if dx is not None else (vjp(solution, x=one.reshape(n, d), wrt=names) for one in ones):
        for name in names:
            rows[name].append(flat(g[name]))
    return {name: np.array(each).reshape((n, d) + each[0].shape) for name, each in rows.items()}
