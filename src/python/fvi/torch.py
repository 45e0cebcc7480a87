"""Motions for torch: what a network or a tensor of parameters leads to, with its gradient.

    import fvi.torch
    problem = fvi.Problem("k*x^2/2", let={"k": 1}, alpha=0.3, time=20)
    x, p = fvi.torch.solve(problem, {"alpha": alpha, "rho": rho, "k": k}, h=0.1)
    ((x - data)**2).mean().backward()

The motion is computed in double precision on the processor, and so is its gradient, by one mirrored run
(`fvi.vjp`); both then go to where the tensors are. There are no second derivatives.
"""
from __future__ import annotations

from typing import Any, Mapping, cast

import numpy as np
import torch

from ._arguments import spelt
from ._gradient import vjp
from ._problem import Problem
from ._solution import Solution
from ._solve import solve as solve_problem

FIELDS = ("x0", "p0", "v0", "mass", "rho", "alpha", "order", "force")


def double(tensor: Any) -> Any:
    return tensor.detach().to("cpu", torch.float64).numpy()


class Motion(torch.autograd.Function):
    """x and p of every row."""

    @staticmethod
    def forward(ctx: Any, problem: Problem, options: dict, names: tuple, kept: list,  # type: ignore[override]
                *tensors: Any) -> Any:
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
        kept.append(ctx.solution)
        return tuple(torch.from_numpy(np.array(a)).to(tensors[0].device) for a in (ctx.solution.x, ctx.solution.p))

    @staticmethod
    @torch.autograd.function.once_differentiable
    def backward(ctx: Any, x: Any, p: Any) -> Any:
        let = ctx.solution.problem.let or {}
        wrt = {"let" if name in let else name for name in ctx.names}
        by = vjp(ctx.solution, x=double(x), p=double(p), wrt=sorted(wrt))
        found = []
        for name, (shape, kind, device) in zip(ctx.names, ctx.like):
            value = by["let"][name] if name in let else by[name]
            found.append(torch.as_tensor(value, dtype=torch.float64).reshape(shape).to(device, kind))
        return (None, None, None, None, *found)


@spelt(solve_problem)
def solve(problem: Problem, tensors: Mapping[str, Any], **options: Any) -> tuple:
    """The motion of a problem some of whose numbers are tensors.

    problem  the rest of it
    tensors  by the names of fields of the problem: x0, p0 or v0, mass, rho, alpha or order; force, the F of measured
             rows, whose t are the problem's; or of a number in its `let`, which are scalars
    options  as for `fvi.solve`

    Returns x and p, (n, d) tensors in double precision.
    """
    let = problem.let or {}
    for name in tensors:
        if name not in FIELDS and name not in let:
            raise ValueError(f"tensors: '{name}' is none of " + ", ".join((*FIELDS, *let)))
    if "force" in tensors and not isinstance(problem.force, tuple):
        raise ValueError("tensors: a force has a gradient where the problem's is a pair (t, F)")
    if not tensors:
        raise ValueError("tensors: there is none; fvi.solve needs no torch")
    kept: list[Solution] = []
    return Motion.apply(problem, options, tuple(tensors), kept, *tensors.values())
