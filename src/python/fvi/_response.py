"""Linear motions by frequency: responses, poles; how long a step may be; from here to there."""
from __future__ import annotations

import math
from typing import Any, NamedTuple, Optional

import numpy as np

from ._arguments import Array, Numbers, choice, number, numbers, spelt, whole
from ._fvi import ffi, lib
from ._library import ask, ask_for_constant_warning, ask_for_warning, error_of, succeed, warn_of_start
from ._problem import Problem
from ._solve import Motion, Numerics, chosen

KINDS = {"receptance": lib.FVI_RESPONSE_RECEPTANCE, "mobility": lib.FVI_RESPONSE_MOBILITY,
         "accelerance": lib.FVI_RESPONSE_ACCELERANCE, "ground": lib.FVI_RESPONSE_GROUND}


class Linear:
    """A problem made linear at a place, with room for its factors."""

    def __init__(self, problem: Problem, about: Optional[Numbers], along: Optional[Numbers] = None):
        how = chosen(problem, None, None, "fvi-stable", None, 1, None, None, None, None, "auto", 0.0)  # no step is taken
        self.motion = Motion(problem, how)
        system, run = self.motion.system, self.motion.run
        at = system.x0 if about is None else np.ascontiguousarray(np.broadcast_to(numbers("about", about), (system.d,)))
        self.d = system.d
        ground = np.ones(system.d) if along is None else np.ascontiguousarray(np.broadcast_to(numbers("along", along), (system.d,)))
        question = ffi.new("fvi_linear_motion *", {"system": system.system, "alpha": run.alpha, "law": run.law,
                                                   "at": system.pointer(at), "along": system.pointer(ground)})
        out, error = ffi.new("fvi_response **"), ffi.new("fvi_error *")
        check(ask(lib.fvi_response_alloc, question, out, error), error)
        self.response = ffi.gc(out[0], lib.fvi_response_free)
        ask_for_constant_warning(lib.fvi_response_warning_of_place, system.system, question.at)


def check(status: int, error: Any) -> None:
    if status:
        raise error_of(error, status)


def coordinate(what: str, given: Any, d: int) -> int:
    i = whole(what, given, 1)
    if i > d:
        raise ValueError(f"{what}: {given} is no coordinate from 1 to {d}")
    return i - 1


@spelt()
def response(problem: Problem, omega: Numbers, of: str = "receptance", *, at: int = 1, by: int = 1, hertz: bool = False,
             about: Optional[Numbers] = None, along: Optional[Numbers] = None) -> Array:
    """What a shaker test measures: complex numbers, one for each frequency.

    problem  made linear; its force is not read
    omega    frequencies > 0, in radians per unit of time
    of       "receptance", the place by a force of 1; "mobility", the velocity; "accelerance", the acceleration;
             "ground", the acceleration by one of 1 of the ground
    at, by   the coordinate that is measured and the one that is pushed, from 1; by is not read for the ground
    hertz    True: the frequencies are in periods per unit of time
    about    the place at which it is made linear, one number or d of them; None: x0
    along    how each coordinate moves with the ground, one number or d of them; None: 1

    Warns by fvi.FviWarning of a place that is no equilibrium.
    """
    w = np.ascontiguousarray(np.atleast_1d(numbers("omega", omega)) * (2 * math.pi if hertz else 1.0))
    linear, H, error = Linear(problem, about, along), np.empty(w.size, complex), ffi.new("fvi_error *")
    check(ask(lib.fvi_response_at, linear.response, choice("of", of, KINDS), w.size, ffi.from_buffer("double[]", w),
              coordinate("at", at, linear.d), coordinate("by", by, linear.d),
              ffi.cast("double *", H.ctypes.data), error), error)
    return H.reshape(np.shape(omega))


class Poles(NamedTuple):
    """The free motions exp(s t): `pole`, complex s with Im s > 0 and Re s <= 0, |s| increasing; `frequency` |s|/(2 pi)
    and `damping`, the ratio -Re s/|s|; `shape`, (n, d) complex, v v^T the residue; `residual` of each; `expected`, how many there are,
    None if that is not known."""
    pole: Array
    frequency: Array
    damping: Array
    shape: Array
    residual: Array
    expected: Optional[int]


@spelt()
def poles(problem: Problem, count: int = 0, *, about: Optional[Numbers] = None) -> Poles:
    """The oscillations of the free motion that do not grow.

    problem  made linear; its force is not read
    count    how many of the lowest; 0: all
    about    the place at which it is made linear, one number or d of them; None: x0

    Warns by fvi.FviWarning of a place that is no equilibrium, and of poles that are not among the rows.
    """
    linear, found, error = Linear(problem, about), ffi.new("fvi_poles *"), ffi.new("fvi_error *")
    check(ask(lib.fvi_poles_find, linear.response, whole("count", count, 0), found, error), error)
    try:
        ask_for_warning(lib.fvi_response_warning_of_poles, found)
        n, d = found.count, found.d

        def copy(pointer: Any, kind: Any, *shape: int) -> Array:
            size = math.prod(shape) * np.dtype(kind).itemsize
            return np.frombuffer(ffi.buffer(pointer, size), kind).reshape(shape).copy() if size else np.empty(shape, kind)
        s = copy(found.pole, complex, n)
        return Poles(s, abs(s) / (2 * math.pi), -s.real / abs(s), copy(found.shape, complex, n, d),
                     copy(found.residual, float, n), None if found.expected == 2**64 - 1 else found.expected)
    finally:
        lib.fvi_poles_free(found)


class ExactMotion(NamedTuple):
    """At each time: `x`, `v`, `a`, (n, d); of all dampers `force` and `impulse`, one column for each along an elongation, else
    d columns."""
    x: Array
    v: Array
    a: Array
    force: Array
    impulse: Array


@spelt()
def exact_motion(problem: Problem, t: Numbers, first: float = 1.0) -> ExactMotion:
    """The exact motion of a linear problem, of one mass or many, all dampers held before t = 0, to about 1e-12.

    problem  a quadratic potential, any dampers along linear elongations; a force None, "step:A,T" or "cosine:A,W"
    t        one time or a list of them, >= 0
    first    where a force is infinite at t = 0, of an order above 1 and a velocity, this has its mean over (0, first]

    Raises fvi.Error where there is no exact motion, and says why.
    """
    if problem.force is not None and not isinstance(problem.force, str):
        raise ValueError("force: it has no exact motion here; None, step:A,T and cosine:A,W have")
    if any(given is not None for given in (problem.ground, problem.lagrangian)) or len(problem.constraints) or len(problem.impose):
        raise ValueError("problem: with ground, lagrangian, constraints or impose it has no exact motion here")
    times = np.atleast_1d(numbers("t", t)).astype(float)
    linear = Linear(problem, 0)
    system, d = linear.motion.system, linear.d
    kind, constants = ffi.new("fvi_forcing *"), ffi.new("double[2]")
    if problem.force is not None and not lib.fvi_typed_force_is_simple(system.typed_force, kind, constants):
        raise ValueError(f"force: '{problem.force}' has no exact motion here; none, step:A,T and cosine:A,W have")
    run = linear.motion.run
    is_like_held = run.alpha <= 0.5 if run.law == ffi.NULL else lib.fvi_kernel_takes_caputo(run.law)
    if run.past == lib.FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE or (run.past == lib.FVI_INITIAL_HISTORY_CAPUTO and not is_like_held):
        raise ValueError("past: the exact motion is that of dampers that were held")
    asked = ffi.new("fvi_exact_problem *", {"x0": run.x0, "p0": run.p0, "forcing": kind[0], "A": constants[0], "T": constants[1],
                                            "w": constants[1]})
    asked.motion.system, asked.motion.alpha, asked.motion.law = system.system, run.alpha, run.law
    out, error = ffi.new("fvi_exact_motion **"), ffi.new("fvi_error *")
    check(ask(lib.fvi_exact_motion_alloc, asked, out, error), error)
    motion = ffi.gc(out[0], lib.fvi_exact_motion_free)
    widths = (d, d, d, lib.fvi_exact_motion_forces(motion), lib.fvi_exact_motion_forces(motion))
    rows = [np.empty((times.size, width)) for width in widths]
    for n, time in enumerate(times):
        places = ffi.new("fvi_exact_outputs *", {name: ffi.cast("double *", row[n:].ctypes.data) for name, row in
                                                 zip(("x", "v", "a", "force", "impulse"), rows)})
        check(ask(lib.fvi_exact_motion_forces_at, motion, number("t", time), number("first", first), places, error), error)
    return ExactMotion(*rows)


class Stability(NamedTuple):
    """`number`: above 1 a mode grows from step to step; `longest`: the longest step for which none does, None where
    that is not known."""
    number: float
    longest: Optional[float]


@spelt()
def stability(problem: Problem, h: float, method: str = "fvi", *, kappa: Optional[float] = None) -> Stability:
    """How much of the stable range a step takes, of small motions about x0.

    problem  what would be solved
    h        the step, > 0
    method   as `methods()` lists them
    kappa    of methods that have one
    """
    step = number("h", h)
    if not 0 < step < math.inf:
        raise ValueError(f"h: {h} is not above 0, or not finite")
    how: Numerics = chosen(problem, None, None, method, None, 1, kappa, None, None, None, "auto", 0.0)
    motion = Motion(problem, how)
    motion.run.h = step
    load, longest = ffi.new("double *"), ffi.new("double *")
    succeed(ask(lib.fvi_stability_number, motion.method, motion.run, load))
    status = ask(lib.fvi_stability_longest_step, motion.method, motion.run, longest)
    if status != lib.FVI_EUNSUP:
        succeed(status)
    return Stability(load[0], None if status else longest[0])


class Control(NamedTuple):
    """`force`, (n, d), at the times `t`, added to the force of the problem; `cost`, half the integral of its square;
    `miss`, the largest distance from the end that was wanted; `iterations`."""
    t: Array
    force: Array
    cost: float
    miss: float
    iterations: int


@spelt()
def control(problem: Problem, x: Numbers, p: Numbers, *, h: Optional[float] = None, steps: Optional[int] = None,
            method: str = "fvi-bdf2", kappa: Optional[float] = None) -> Control:
    """The least force that ends a motion at a place with a momentum.

    problem   the motion without it
    x, p      where it is to end, one number or d of them
    h, steps  as for `solve`
    method    "fvi", "fvi-shifted", "fvi-bdf2" or "fvi-stable"
    kappa     as for `solve`

    Warns by fvi.FviWarning as `solve` does before the first step.
    """
    motion = Motion(problem, chosen(problem, None, None, method, h, steps, kappa, None, None, None, "auto", 0.0))
    run, d = motion.run, motion.system.d
    warn_of_start(motion.method, run)
    end = [np.ascontiguousarray(np.broadcast_to(numbers(name, a), (d,))) for name, a in (("x", x), ("p", p))]
    u, found = np.zeros((run.steps + 1, d)), ffi.new("fvi_control_result *")
    succeed(ask(lib.fvi_control_solve, motion.method, run, *(ffi.from_buffer("double[]", a) for a in end),
                ffi.from_buffer("double[]", u), found))
    return Control(np.arange(run.steps + 1) * run.h, u, found.cost, found.miss, found.iterations)


class Bound(NamedTuple):
    """What `error_bound` returns: |x_k - x(t_k)| <= 2 C h (exp(rate t_k) - 1)/rate for every step below `h`, t_k in place of the
    quotient if rate is 0. Of a bound from `velocity_variation` the right side is 2 C h exp(rate t_k)."""
    C: float
    rate: float
    h: float


@spelt()
def error_bound(*, alpha: float, time: float, damping: float, lipschitz: float, gradient: float, variation: float,
                start: float, speed: float, acceleration: Optional[float] = None, velocity_variation: Optional[float] = None,
                kappa: float = 0.5, room: float = math.inf) -> Bound:
    """How far a run of "fvi" can be from the motion, by the theorem of H 20, from what is known of the motion.

    alpha, kappa, time   of the run
    damping, lipschitz, gradient  the largest rho/m; a Lipschitz constant and a bound of grad U/m
    variation            of F/m, jumps included
    start, speed, acceleration  |v0|, and bounds of |x'| and |x''|
    velocity_variation   of x', in the place of `acceleration`: for a held body with alpha above 1/2 and v0 not 0,
                         whose x'' is infinite at first
    room                 how far from the path these hold; everywhere
    """
    if (acceleration is None) == (velocity_variation is None):
        raise ValueError("acceleration: give either acceleration or velocity_variation")
    motion = ffi.new("fvi_smoothness *", {"T": number("time", time), **{name: number(name, value) for name, value in (
        ("alpha", alpha), ("kappa", kappa), ("damping", damping), ("lipschitz", lipschitz), ("gradient", gradient),
        ("variation", variation), ("start", start), ("speed", speed), ("room", room),
        ("acceleration", 0.0 if acceleration is None else acceleration),
        ("velocity_variation", 0.0 if velocity_variation is None else velocity_variation))}})
    bound = ffi.new("fvi_error_bound *")
    succeed(ask(lib.fvi_error_bound_compute if velocity_variation is None else lib.fvi_position_bound_compute, motion, bound))
    return Bound(bound.C, getattr(bound, "lambda"), bound.h)
