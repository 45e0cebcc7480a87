"""Exact solutions of the linear problem, and weights."""
from __future__ import annotations

import math
from typing import Any, NamedTuple, Optional

import numpy as np

from ._arguments import Array, Numbers, choice, number, numbers, spelt, whole, word
from ._fvi import ffi, lib
from ._library import ask, error_of, succeed
from ._run import PASTS
from ._system import Law, law, typed_force


def on_grid(t: Array) -> int:
    """How many times, from the first on, are the doubles nearest to 0, h, 2 h, ..."""
    if t.size < 2 or not 0 < t[1] < np.inf:
        return 0
    strays = np.flatnonzero(t != np.arange(t.size) * t[1])
    return int(strays[0]) if strays.size else t.size


def oscillator(mass: float, c: float, rho: float, alpha: float, derivative: str, x0: float, v0: float, force: Optional[str]) -> Any:
    """The problem in C, its numbers by their names here."""
    problem = ffi.new("fvi_linear_oscillator *", {
        "m": number("mass", mass), "c": number("c", c), "rho": number("rho", rho), "alpha": number("alpha", alpha),
        "x0": number("x0", x0), "v0": number("v0", v0), "past": choice("derivative", derivative, PASTS)})
    if force is not None:
        kind, constants = ffi.new("fvi_forcing *"), ffi.new("double[2]")
        typed = typed_force(word("force", force), 1, ffi.NULL, math.inf)
        if not lib.fvi_typed_force_is_simple(typed, kind, constants):
            raise ValueError(f"force: '{force}' has no exact solution here; none, step:A,T and cosine:A,W have")
        problem.forcing, problem.A, problem.T, problem.w = kind[0], constants[0], constants[1], constants[1]
    return problem


@spelt()
def exact(t: Numbers, *, mass: float = 1.0, c: float = 1.0, rho: Optional[float] = None,
          alpha: Optional[float] = None, damping: Law = None,
          derivative: str = "held", x0: float = 1.0, v0: float = 0.5,
          force: Optional[str] = None) -> tuple:
    """x(t) and x'(t) of m x'' + c x + rho D^{2 alpha} x = F(t), to about 4e-14 of max |x|, with
    damping to about 2e-13.

    t      one time or an array of them, >= 0 and finite, in any order; the times of a grid, as the t of
           a run or of numpy.linspace(0, T, n + 1), more than 513 of them, are computed together,
           to 7e-14, mostly more than ten times as fast
    force  None, "step:A,T" or "cosine:A,W"
    mass, c, rho, alpha  > 0, >= 0, >= 0 and 0 ... 1: 1, 1, 0.2, 0.5, in the units of `run`; c is
           the spring's constant, a force / length
    x0, v0  the start, 1 and 0.5: a length, and the velocity at 0, not the momentum
    derivative  as for `run`
    damping  as for `run`, instead of rho (0.2) and alpha (0.5)

    Returns two arrays of the shape of t. Raises fvi.Error where there is no solution
    (derivative="rl" with x0 != 0 and alpha > 1/2), a number is out of its range, or damping
    has another past than "held", or "caputo" with orders up to 1, or more than three oscillations.
    """
    times = numbers("t", t)
    flat = np.ascontiguousarray(times.reshape(-1))
    if damping is not None and not (alpha is None and rho is None):
        raise ValueError("damping: not together with alpha or rho")
    kept = law(damping) if damping is not None else None
    default = 0.2 if damping is None else 1.0
    problem = oscillator(mass, c, default if rho is None else rho, 0.5 if alpha is None else alpha, derivative, x0, v0, force)
    problem.law = ffi.NULL if kept is None else ffi.addressof(kept[0], "law")
    x, v = np.empty_like(flat), np.empty_like(flat)
    room = lambda a: ffi.from_buffer("double[]", a)
    error = ffi.new("fvi_error *")
    count = on_grid(flat) if damping is None else 0
    status = ask(lib.fvi_exact_grid, problem, flat[1], count - 1, 0, room(x), room(v), error) if count > 513 else 0
    rest = count if count > 513 else 0
    if not status and rest < flat.size:
        status = ask(lib.fvi_exact_at, problem, flat.size - rest, room(flat[rest:]), room(x[rest:]), room(v[rest:]),
                     error)
    if status and error.code == status:
        raise error_of(error, status)
    succeed(status)
    return x.reshape(times.shape), v.reshape(times.shape)


class SpringBound(NamedTuple):
    """What `spring_bound` returns: no x is off by more than `x` at the end of a step, and no p/m by more than `v`."""
    x: float
    v: float


@spelt()
def spring_bound(h: Numbers, stages: int, *, mass: float = 1.0, c: float = 1.0, rho: float = 0.2, alpha: float = 0.5,
                 derivative: str = "held", x0: float = 1.0, v0: float = 0.5, force: Optional[str] = None,
                 memory_error: float = 0.0) -> SpringBound:
    """How far a run of "fvi-lobatto2d" to "8d" on a spring can be from the motion at the end of any step, by (20.19)
    of H 20.

    h       the step; or all steps of a run, of any lengths, as those of "fvi-adaptive" with 6 or 8 stages
    stages  2 to 8
    mass, c, rho, alpha, derivative, x0, v0  as for `exact`, but c and rho are above 0, and alpha is above 0 and below 1.
            The past is "caputo", or "held" with alpha up to 1/2 or v0 = 0
    force   None, or "step:A,T" with T the end of a step
    memory_error  what the memory may be wrong by in each stage, in units of D^{2 alpha} x; 0: exact weights

    Rounding is not in it. The bound does not grow with the time. Raises fvi.Error where there is none, and says why.
    """
    steps = np.ascontiguousarray(numbers("h", h).reshape(-1))
    problem = oscillator(mass, c, rho, alpha, derivative, x0, v0, force)
    bound, error = ffi.new("fvi_spring_bound *"), ffi.new("fvi_error *")
    status = ask(lib.fvi_spring_bound_compute, problem, whole("stages", stages, 0), steps.size, ffi.from_buffer("double[]", steps),
                 number("memory_error", memory_error), bound, error)
    if status and error.code == status:
        raise error_of(error, status)
    succeed(status)
    return SpringBound(bound.x, bound.v)


@spelt()
def weights(order: float, count: int) -> Array:
    """The first `count` weights of (1 - z)^order, 0 <= order <= 2, each to the last bit or next to it."""
    w = np.empty(whole("count", count, 1))
    succeed(ask(lib.fvi_gl_weights, number("order", order), w.size, ffi.from_buffer("double[]", w)))
    return w
