"""Motions for torch: what a network or a tensor of parameters leads to, with its gradient.

    import torch
    import fvi
    problem = fvi.Problem("k*x^2/2", let={"k": 1}, alpha=0.3, time=20)
    alpha = torch.tensor(0.3, requires_grad=True)
    x, p = fvi.torch.solve(problem, {"alpha": alpha}, h=0.1)
    (x**2).mean().backward()
    alpha.grad

Tensors are x0, p0 or v0, mass, rho, alpha or order, the F of measured forces, and numbers of the problem's `let`.
The motion is computed in double precision on the processor, and so is its gradient, by one adjoint run
(`fvi.vjp`); both then go to where the tensors are. There are no second derivatives.
"""
from __future__ import annotations

import functools
from typing import Any, Mapping, Optional, Sequence, cast

import numpy as np

from ._arguments import described, names as names_of, spelt
from ._gradient import vjp
from ._problem import Problem
from ._solution import Solution
from ._solve import solve as solve_problem

__all__ = ["solve"]
FIELDS = ("x0", "p0", "v0", "mass", "rho", "alpha", "order", "force")


def double(tensor: Any) -> Any:
    return tensor.detach().cpu().double().numpy()


@functools.cache
def motion() -> Any:
    """The function of torch's: x and p of every row."""
    try:
        import torch
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError("fvi.torch needs torch, which this Python does not find: python -m pip install torch; "
                                  "fvi.gradient has the same derivatives without it", name="torch") from error

    class Motion(torch.autograd.Function):
        @staticmethod
        def forward(ctx: Any, problem: Problem, options: dict, names: tuple, kept: list,  # type: ignore[override]
                    dampers: tuple, *tensors: Any) -> Any:
            changes: dict = {}
            let = dict(problem.let or {})
            for name, tensor in zip(names, tensors):
                value = double(tensor)
                if name in let:
                    let[name] = float(value)
                elif name == "force":
                    changes[name] = (cast(tuple, problem.force)[0], value)
                else:
                    changes[name] = float(value) if value.ndim == 0 else value
            if let:
                changes["let"] = let
            ctx.solution = solve_problem(problem.replace(**changes), **options)
            ctx.names, ctx.like = names, [(t.shape, t.dtype, t.device) for t in tensors]
            ctx.dampers = dampers
            kept.append(ctx.solution)
            known = ctx.solution.forces if dampers else {}
            for name in dampers:
                if name not in known:
                    raise ValueError(f"forces: '{name}' is none of the dampers " + ", ".join(known))
            return tuple(torch.from_numpy(np.array(a)).to(tensors[0].device)
                         for a in (ctx.solution.x, ctx.solution.p, *(known[name] for name in dampers)))

        @staticmethod
        @torch.autograd.function.once_differentiable
        def backward(ctx: Any, x: Any, p: Any, *forces: Any) -> Any:
            let = ctx.solution.problem.let or {}
            wrt = {"let" if name in let else name for name in ctx.names}
            by_forces = {name: double(f) for name, f in zip(ctx.dampers, forces)}
            by = vjp(ctx.solution, x=double(x), p=double(p), forces=by_forces, wrt=sorted(wrt))
            found = []
            for name, (shape, kind, device) in zip(ctx.names, ctx.like):
                value = by["let"][name] if name in let else by[name]
                found.append(torch.as_tensor(value, dtype=torch.float64).reshape(shape).to(device, kind))
            return (None, None, None, None, None, *found)
    return Motion


@spelt(solve_problem)
def solve(problem: Problem, tensors: Mapping[str, Any], *, forces: Optional[Sequence[str]] = None, **options: Any) -> tuple:
    """The motion of a problem some of whose numbers are tensors.

    problem  the rest of it
    tensors  by the names of fields of the problem: x0, p0 or v0, mass, rho, alpha or order; force, the F of measured
             rows, whose t are the problem's; or of a number in its `let`, which are scalars
    forces   names of dampers, "d1", whose forces are wanted, too; not by "fvi-adaptive"
    options  as for `fvi.solve`

    Returns x and p, (n, d) tensors in double precision; with forces behind them a dict of the forces by names.

        x, p, f = fvi.torch.solve(problem, {"rho": rho}, forces=["d1"], h=0.1, method="fvi-lobatto4")
        (f["d1"]**2).mean().backward()
    """
    if not isinstance(problem, Problem):
        raise TypeError(f"problem: {described(problem)} is no fvi.Problem")
    if not isinstance(tensors, Mapping):
        raise TypeError(f"tensors: {described(tensors)} is no dict of names and tensors")
    function, let = motion(), problem.let or {}
    for name, tensor in tensors.items():
        if name not in FIELDS and name not in let:
            raise ValueError(f"tensors: '{name}' is none of " + ", ".join((*FIELDS, *let)))
        if not hasattr(tensor, "detach"):
            raise TypeError(f"tensors: {name}: {described(tensor)} is no tensor")
    if "force" in tensors and not isinstance(problem.force, tuple):
        raise ValueError("tensors: a force has a gradient where the problem's is a pair (t, F)")
    if not tensors:
        raise ValueError("tensors: there is none; fvi.solve needs no torch")
    kept: list[Solution] = []
    dampers = () if forces is None else names_of("forces", forces)
    found = function.apply(problem, options, tuple(tensors), kept, tuple(dampers), *tensors.values())
    return found if forces is None else (*found[:2], dict(zip(dampers, found[2:])))
