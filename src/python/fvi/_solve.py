"""The motion of a problem: one call, whatever the method; and many such calls."""
from __future__ import annotations

import math
import os
import sys
from dataclasses import dataclass
from typing import Any, Callable, Mapping, NamedTuple, Optional, Sequence, Union

import numpy as np

from ._arguments import Array, Numbers, choice, described, function, nearest, number, numbers, spelt, whole, word
from ._checkpoint import Checkpoint, rows_by_stepper
from ._events import Event, Events, Happened, listed
from ._fvi import ffi, lib
from ._library import ask, ask_for_warning, error_of, failure, keep, succeed, text_of, understand, warn, warn_of_memory, warn_of_start
from ._mechanism import Mechanism, Structure, own_law
from ._problem import Problem
from ._run import MEMORIES, PASTS, length, methods, refused
from ._solution import Solution
from ._system import System
from .errors import Error

Progress = Union[None, bool, Callable[[int, int], Any]]
MOST_TOGETHER = 1 << 22  # rows of all motions that take their steps together
NEEDS_ROWS = 200  # steps between the rows, where nobody says how many


@dataclass(frozen=True)
class Numerics:
    """How a problem is solved, as it was asked for."""
    method: str
    h: Optional[float]
    steps: int
    kappa: float
    error: Optional[float]
    step_error: Optional[float]
    longest: Optional[float]
    most_steps: int
    memory: str
    tolerance: float
    t_eval: Optional[Array]
    events: tuple = ()
    checkpoint: Optional[str] = None


class Motion:
    """A problem and its numerics as the library takes them: `run`, which has a row at each step."""

    def __init__(self, problem: Problem, how: Numerics):
        q, is_structure = problem, problem.kind == "structure"
        rho = (0.2 if q.damping is None else 1.0) if q.rho is None else q.rho
        x0 = (0.0 if is_structure else 1.0) if q.x0 is None else q.x0
        p0 = q.p0 if q.p0 is not None else q.v0 if q.v0 is not None else 0.0 if is_structure else 0.5
        if q.order is not None and not 0 <= q.order <= 2:
            raise refused("order", q.order, "must be in [0, 2]")
        for v in np.atleast_1d(0.0 if q.v0 is None else q.v0).flat:
            if not math.isfinite(v):
                raise refused("v0", v, "must be finite")
        alpha = q.order / 2 if q.order is not None else 0.5 if q.alpha is None else q.alpha
        is_mechanism = q.kind == "mechanism" or (q.kind == "masses" and any(e.is_contact for e in how.events))
        mechanism = Mechanism(q.lagrangian, q.dampers, q.constraints, q.impose, q.force_on, own_law(
            alpha, q.damping, q.past)) if is_mechanism else None
        structure = Structure(q.M, q.K, q.C, q.dampers, PASTS) if is_structure else None
        self.problem, self.time = q, q.time
        self.system = s = System(q.potential, q.force, 1.0 if is_structure else q.mass, 0.0 if is_structure else rho, x0,
                                 p0, q.let, q.time, q.damping, mechanism, structure, q.ground, q.along,
                                 Events(how.events) if how.events else None, "p0" if q.v0 is None else "v0")
        if q.v0 is not None:
            self.put_velocity(is_structure)
        self.method = lib.fvi_method_find(how.method.encode())
        run = self.run = ffi.new("fvi_run *")
        run.system, run.x0, run.p0 = s.system, s.pointer(s.x0), s.pointer(s.p0)
        run.steps, run.h = how.steps, how.h if how.h is not None else q.time / how.steps
        run.kappa, run.tolerance, run.memory = how.kappa, how.tolerance, MEMORIES[how.memory]
        run.alpha = alpha
        run.past, run.law, run.failure = choice("past", q.past, PASTS), s.law, s.failure
        has_rows = how.h is not None or (how.error is not None and how.t_eval is None)  # at which every method asks
        s.check_force(self.method, run.h, run.steps if has_rows else 0)
        run.step_error, run.longest = length("step_error", how.step_error), length("longest", how.longest)
        run.most_steps = how.most_steps
        run.events, run.event_count = s.events or ffi.NULL, len(how.events)

    def put_velocity(self, is_structure: bool) -> None:
        """p0 of the v0 that stands in its place."""
        s = self.system
        if is_structure:
            raise ValueError("v0: a structure begins with p0 = M v0")
        p0 = np.empty(s.d)
        if s.imposed is not None:
            s.p0 = s.imposed.velocities(s.p0)
        succeed(ask(lib.fvi_momentum_of_velocity, s.system, 0.0, s.pointer(s.x0), s.pointer(s.p0.copy()),
                    ffi.from_buffer("double[]", p0)))
        v0, s.p0 = s.p0, p0
        understand(lib.fvi_check_start_velocity, s.system, s.pointer(s.x0), s.pointer(v0), s.pointer(p0))

    def solve(self, how: Numerics, time: float, t: Optional[Array], x: Array, p: Array, count: Any) -> tuple:
        """fvi_solve: x and p at the times t, or at each row. What it returned, with its report and its error."""
        r = self.run
        problem = ffi.new("fvi_problem *", {"system": r.system[0], "x0": r.x0, "p0": r.p0, "T": time,
                                            "alpha": r.alpha, "law": r.law, "past": r.past,
                                            "events": r.events, "event_count": r.event_count})
        options = ffi.new("fvi_solve_options *", {
            "method": self.method, "h": how.h or 0.0, "kappa": ffi.addressof(r, "kappa"), "longest": r.longest,
            "step_error": r.step_error, "history": r.memory, "history_tolerance": r.tolerance})
        accuracy = ffi.new("fvi_accuracy *", {"tolerance": how.error or 0.0, "most_steps": how.most_steps})
        outputs = ffi.new("fvi_outputs *", {
            "rows": len(x), "t": ffi.NULL if t is None else ffi.from_buffer("double[]", t),
            "x": ffi.from_buffer("double[]", x), "p": ffi.from_buffer("double[]", p),
            "row": ffi.addressof(lib, "count_row"), "params": count,
            "event": ffi.addressof(lib, "count_event") if how.events else ffi.NULL})
        report, error = ffi.new("fvi_report *"), ffi.new("fvi_error *")
        return ask(lib.fvi_solve, problem, options, accuracy, outputs, report, error), report, error


class Bar:
    """A line on standard error that says how far a call is; it goes when the call is over."""

    def __init__(self) -> None:
        self.is_there, self.percent = False, -1

    def __call__(self, rows: int, all: int) -> None:
        if 100 * rows // all == self.percent:
            return
        self.percent = 100 * rows // all
        done = 30 * rows // all
        sys.stderr.write(f"\r[{'#' * done}{'.' * (30 - done)}] {100 * rows // all:3d} %")
        sys.stderr.flush()
        self.is_there = True

    def clear(self) -> None:
        if self.is_there:
            sys.stderr.write("\r" + " " * 40 + "\r")
            sys.stderr.flush()


@ffi.def_extern(error=-1, onerror=keep)
def report_progress(rows: int, all: int, tell: Any) -> int:
    ffi.from_handle(tell)(rows, all)
    return 0


def chosen(problem: Problem, t_eval: Optional[Numbers], error: Optional[float], method: Optional[str],
           h: Optional[float], steps: Optional[int], kappa: Optional[float], step_error: Optional[float],
           longest: Optional[float], most_steps: Optional[int], memory: str, tolerance: float, events: tuple = (),
           checkpoint: Union[None, str, os.PathLike] = None) -> Numerics:
    """What the arguments of `solve` mean together."""
    if not isinstance(problem, Problem):
        raise TypeError(f"problem: {described(problem)} is no fvi.Problem")
    if not 0 < problem.time < math.inf:
        raise ValueError(f"time: {problem.time} is not above 0, or not finite")
    for name, value in (("h", h), ("steps", steps), ("error", error), ("step_error", step_error), ("longest", longest),
                        ("kappa", kappa), ("most_steps", most_steps)):
        if value is not None:
            number(name, value)
    if steps is not None and t_eval is not None and (error is not None or method in (None, "fvi-adaptive")):
        raise ValueError("steps: not together with t_eval, which says where the rows are; the steps between them are found")
    if checkpoint is not None and error is not None:
        raise ValueError("checkpoint: not together with error")
    for name, one, others in (("error", error, ("h", "step_error")), ("step_error", step_error, ("h",))):
        for other in others:
            if one is not None and {"h": h, "step_error": step_error}[other] is not None:
                raise ValueError(f"{other}: not together with {name}")
    chooses = error is not None or step_error is not None or longest is not None
    is_open = h is None  # nobody said which steps; how many rows there are is another matter
    if method is None and (events or (problem.kind == "mechanism" and (chooses or is_open))):
        method = "fvi-adaptive"
    if method is None and problem.kind == "structure" and (chooses or is_open) and takes_any_steps(problem):
        method = "fvi-adaptive"
    if method is None and problem.kind != "masses":
        method = "fvi-stable"
        if is_open and not chooses:
            warn(f"{NEEDS_ROWS if steps is None else steps} steps of fvi-stable, as neither h nor error is given: how far x "
                 "is off is not estimated")
    if method is None:
        method = "fvi" if h is not None else "fvi-adaptive"
        if error is not None and problem.damping is not None:
            method = method_for_error(problem, error, kappa, memory, tolerance)
            if method != "fvi-adaptive" and not has_common_step(t_eval, problem.time):
                method = "fvi-lobatto4"  # which knows the body between its steps
    found = lib.fvi_method_find(word("method", method).encode())
    if found == ffi.NULL:
        names = [m.name for m in methods()]
        raise ValueError(f"method: '{method}' is none of " + ", ".join(names) + nearest(method, names))
    if kappa is not None and not found.takes_kappa:
        raise ValueError(f"kappa: {method} has none")
    for name, value in (("step_error", step_error), ("longest", longest if error is None else None)):
        if value is not None and not lib.is_dense(found):
            raise ValueError(f"{name}: not for {method}, whose steps are given; fvi-adaptive chooses its own")
    if most_steps is not None and error is None and not lib.is_dense(found):
        raise ValueError(f"most_steps: not for {method}, whose steps are given")
    if h is not None:
        h = number("h", h)
        if not 0 < h < math.inf:
            raise ValueError(f"h: {h} is not above 0, or not finite")
        parts = problem.time / h
        if steps is not None or abs(parts - round(parts)) > 1e-9 * parts:
            raise ValueError("steps: not together with h; the time is the problem's" if steps is not None else
                             f"h: {problem.time:g} is not a whole number of steps of {h:g}")
        steps = round(parts)
    count = NEEDS_ROWS if steps is None else whole("steps", steps, 1)
    if h is None and error is None and not lib.is_dense(found):
        h = problem.time / count
    times = None
    if t_eval is not None:
        times = np.ascontiguousarray(np.atleast_1d(numbers("t_eval", t_eval)))
        if times.ndim != 1 or times.size == 0:
            raise ValueError(f"t_eval: the shape {times.shape} is not (n,), n >= 1")
        times.flags.writeable = False
    if error is not None and not 0 < number("error", error) < math.inf:
        raise ValueError(f"error: {error} is not above 0, or not finite")
    return Numerics(method, h, count, 0.5 if kappa is None else number("kappa", kappa), error, step_error, longest,
                    0 if most_steps is None else whole("most_steps", most_steps, 1),
                    next(name for name in MEMORIES if choice("memory", memory, MEMORIES) == MEMORIES[name]),
                    number("tolerance", tolerance), times, events,
                    None if checkpoint is None else path("checkpoint", checkpoint))


def path(what: str, given: Any) -> str:
    try:
        return os.fsdecode(given)
    except TypeError as error:
        raise TypeError(f"{what}: {described(given)} is no name of a file") from error


def method_for_error(problem: Problem, error: float, kappa: Optional[float], memory: str, tolerance: float) -> str:
    """The fastest that takes the law."""
    motion = Motion(problem, Numerics("fvi-bdf2", problem.time, 1, 0.5 if kappa is None else number("kappa", kappa), None, None,
                                      None, 0, "auto" if memory not in MEMORIES else memory, number("tolerance", tolerance), None))
    return text_of(lib.fvi_method_for_error(motion.run, number("error", error)).name)


def has_common_step(t_eval: Optional[Numbers], time: float) -> bool:
    """Can the rows be ends of steps of one length? What is wrong with the times is said elsewhere."""
    if t_eval is None:
        return True
    t = np.ascontiguousarray(np.atleast_1d(numbers("t_eval", t_eval)))
    return t.ndim != 1 or not np.isfinite(t).all() or lib.fvi_common_steps(t.size, ffi.from_buffer("double[]", t), time) > 0


def takes_any_steps(structure: Problem) -> bool:
    """Does fvi-adaptive take it? Not with a damping of order 2."""
    motion = Motion(structure, Numerics("fvi-stable", structure.time, 1, 0.5, None, None, None, 0, "auto", 0.0, None))
    return bool(lib.fvi_variable_step_takes_structure(motion.run.system, motion.run.alpha, motion.run.law))


def teller(progress: Progress) -> Any:
    """Who is told how far a call is; or None."""
    if progress is True:
        return Bar()
    return None if progress is None or progress is False else function("progress", progress, "of what is done and of all, nor True")


class Found(NamedTuple):
    """What a run has left: how many rows stand, and why it ended."""
    error: Optional[Error]
    rows: int
    said: str
    steps: Optional[int]
    step: float
    estimate: Optional[float] = None
    events: Optional[tuple] = None
    step_error: Optional[float] = None


def solved(problem: Problem, how: Numerics, progress: Progress) -> Solution:
    tell = teller(progress)
    motion = Motion(problem, how)
    watch = (warn_of_start if how.error is None else warn_of_memory)(motion.method, motion.run)
    rows, d = how.steps + 1 if how.t_eval is None else how.t_eval.size, motion.system.d
    x, p = np.full((2, rows, d), np.nan)
    handle = ffi.new_handle(tell)
    count = ffi.new("row_count *", {"all": rows, "tell": ffi.NULL if tell is None else handle})
    t = np.arange(rows) * motion.run.h if how.t_eval is None else how.t_eval.copy()
    try:
        found = by_stepper(motion, how, t, x, p, count) if (how.events and how.error is None) or how.checkpoint else \
            by_library(motion, how, x, p, count)
    finally:
        if isinstance(tell, Bar):
            tell.clear()
    return finished(motion, how, watch, t, x, p, found)


def finished(motion: Motion, how: Numerics, watch: Any, t: Array, x: Array, p: Array, found: Found) -> Solution:
    """What a motion is warned of behind its end, and its Solution; or its error is raised."""
    problem, rows = motion.problem, len(t)
    raised, done, solution = found.error, found.rows, None
    if watch is not None and watch.next <= how.steps:
        ask_for_warning(lib.warn_along_rows, watch, motion.method, motion.run, rows, ffi.from_buffer("double[]", t),
                        ffi.from_buffer("double[]", x))
    if problem.lagrangian is not None:
        ask_for_warning(lib.fvi_warning_of_inertia_in_rows, motion.run.system, done, *(
            ffi.from_buffer("double[]", a) for a in (t, x, p)))
    if raised is None or done:
        solution = Solution(problem, how, t[:done], x[:done], p[:done], 0 if raised is None else raised.code,
                            found.said if raised is None else str(raised), found.steps, found.step, found.estimate,
                            found.events, found.step_error)
    if raised is None:
        assert solution is not None
        return solution
    if solution is not None:
        raised.time, raised.rows = float(t[done - 1]), solution
    raise raised


def rows_of_steps(how: Numerics) -> Optional[Array]:
    """At which steps the rows are; None if not each of them is at one."""
    if how.t_eval is None:
        return np.arange(how.steps + 1)
    try:
        check_times(how.t_eval, how.steps * how.h, how.h)  # type: ignore[operator]
    except ValueError:
        return None
    return np.rint(how.t_eval / how.h).astype(int)


def go_together(how: Numerics) -> bool:
    """Has it steps of a given length, and nothing that only a run by itself has?"""
    return how.error is None and not how.events and how.checkpoint is None and not lib.is_dense(
        lib.fvi_method_find(how.method.encode()))


def solved_together(problems: Sequence[Problem], hows: Sequence[Numerics]) -> Optional[list]:
    """For each problem a function that gives its Solution, with its warnings, or None if it failed: the steps of all are taken
    here, together (fvi/batch.h). None if they do not go together."""
    if not all(map(go_together, hows)) or not all(q.kind == "masses" for q in problems):
        return None
    places = [rows_of_steps(how) for how in hows]
    motions = [Motion(q, how) for q, how in zip(problems, hows)]
    count, method = len(motions), motions[0].method
    runs = ffi.new("fvi_run[]", count)
    for i, (motion, k) in enumerate(zip(motions, places)):
        runs[i] = motion.run[0]
        runs[i].steps = 0 if k is None else int(k[-1])  # none behind the last row, of which the memory would know
    if places[0] is None or runs[0].steps == 0 or any(motion.method != method for motion in motions) or \
            any(k is None or not np.array_equal(k, places[0]) for k in places) or \
            lib.fvi_batch_refusal(method, count, runs) != ffi.NULL:
        return None
    k = places[0]
    if k.size * count > MOST_TOGETHER:
        return None
    x, p = np.empty((2, count, k.size, 1))
    pointers = [ffi.new("double *[]", [ffi.from_buffer("double[]", rows) for rows in a]) for a in (x, p)]
    steps, status = np.ascontiguousarray(k, dtype=np.uintp), ffi.new("int[]", count)
    ask(lib.fvi_batch_trajectories, method, count, runs, k.size, ffi.from_buffer("size_t[]", steps), *pointers, status)

    def finish(i: int) -> Callable[[], Solution]:
        def one() -> Solution:
            motion, how = motions[i], hows[i]
            watch = warn_of_start(motion.method, motion.run)
            t = k * motion.run.h if how.t_eval is None else how.t_eval.copy()
            return finished(motion, how, watch, t, x[i], p[i], Found(
                None, k.size, f"{k[-1]} steps of {how.method}", int(k[-1]), motion.run.h))
        return one
    return [None if status[i] else finish(i) for i in range(count)]


def in_words_of(problem: Problem, raised: Error) -> Error:
    """The field of an error is the argument that the problem has."""
    if raised.field == "p0" and problem.v0 is not None:
        raised.field = "v0"
    if raised.field == "dampers" and not len(problem.dampers):
        raised.field = "damping" if problem.damping is not None else "alpha" if problem.order is None else "order"
    return raised


def by_library(motion: Motion, how: Numerics, x: Array, p: Array, count: Any) -> Found:
    happened = Happened(how.events, motion.system.d)
    handle = ffi.new_handle(happened)
    count.happened = handle
    status, report, error = motion.solve(how, motion.time, how.t_eval, x, p, count)
    if status:
        raised = error_of(error, status) if error.code == status else failure(status)
        if str(raised).startswith("t["):
            raised.field, raised.args = "t_eval", (f"t_eval: {raised}",)
        elif raised.field == "tolerance" and how.error is not None and raised.value == how.error:
            raised.field, raised.args = "error", (f"error: {raised}",)
        return Found(in_words_of(motion.problem, raised), count.rows, "", None, motion.run.h)
    estimate = report.error if how.error is not None else None
    said = f"{report.steps} steps of {how.method}" + (f", error {estimate:.2g} by an estimate" if estimate else "") + (
        f", {happened.end}" if happened.end else "")
    return Found(None, report.rows, said, report.steps, report.h, estimate, happened.arrays() if how.events else None,
                 report.step_error)


def check_times(t: Array, time: float, h: Optional[float]) -> None:
    """What fvi_solve asks of the times of rows, in its words; h: of steps of one length."""
    for k in np.flatnonzero(~((t >= 0) & (t <= time)))[:1]:
        raise ValueError(f"t_eval: t[{k}] is {t[k]:.10g}; it must be in [0, {time:g}]")
    for k in np.flatnonzero(np.diff(t) <= 0)[:1]:
        raise ValueError(f"t_eval: t[{k + 1}] is {t[k + 1]:.10g}; the times must increase")
    parts = t / h if h else np.zeros(1)
    for k in np.flatnonzero(abs(parts - np.round(parts)) > 1e-12 * np.maximum(parts, 1))[:1]:
        raise ValueError(f"t_eval: t[{k}] is {t[k]:.10g}; this method gives out multiples of h, because no error is known "
                         "between its steps; fvi-lobatto2d to 8d and fvi-adaptive give out any time")


def by_stepper(motion: Motion, how: Numerics, t: Array, x: Array, p: Array, count: Any) -> Found:
    events, end = None, None
    if how.t_eval is not None:
        check_times(t, motion.time, None if lib.is_dense(motion.method) else motion.run.h)
    file = Checkpoint(how.checkpoint, motion.problem, how) if how.checkpoint else None
    raised, happened, stepper = rows_by_stepper(motion, how.events, file, t, x, p, count)
    if how.events:
        events, end = happened.arrays(), happened.end
    if raised is not None:
        return Found(in_words_of(motion.problem, raised), count.rows, "", None, motion.run.h, None, events)
    steps, longest = stepper.k, motion.run.h
    if lib.is_dense(motion.method):
        counts = ffi.new("fvi_step_statistics *")
        succeed(ask(lib.fvi_stepper_statistics, stepper, counts))
        steps, longest = counts.steps, counts.longest
    return Found(None, count.rows, f"{steps} steps of {how.method}" + (f", {end}" if end else ""), steps, longest, None, events)


def planned(problem: Problem, t_eval: Optional[Numbers] = None, error: Optional[float] = None, method: Optional[str] = None,
            h: Optional[float] = None, steps: Optional[int] = None, kappa: Optional[float] = None,
            step_error: Optional[float] = None, longest: Optional[float] = None, most_steps: Optional[int] = None,
            memory: str = "auto", tolerance: float = 0.0, events: Union[str, Event, Sequence[Union[str, Event]]] = (),
            checkpoint: Union[None, str, os.PathLike] = None) -> Numerics:
    """The arguments of `solve` but the progress, as a plan."""
    return chosen(problem, t_eval, error, method, h, steps, kappa, step_error, longest, most_steps, memory, tolerance,
                  listed(events), checkpoint)


@spelt()
def solve(problem: Problem, t_eval: Optional[Numbers] = None, error: Optional[float] = None,
          method: Optional[str] = None, h: Optional[float] = None, steps: Optional[int] = None,
          kappa: Optional[float] = None, progress: Progress = None, *, step_error: Optional[float] = None,
          longest: Optional[float] = None, most_steps: Optional[int] = None, memory: str = "auto",
          tolerance: float = 0.0, events: Union[str, Event, Sequence[Union[str, Event]]] = (),
          checkpoint: Union[None, str, os.PathLike] = None) -> Solution:
    """The motion of a problem, from 0 to its time, as a `Solution`.

        fvi.solve(problem)                                  steps are found, each right to 1e-10 of the largest |x|
        fvi.solve(problem, error=1e-6)                      x is right to 1e-6, by an estimate
        fvi.solve(problem, h=0.1, method="fvi-lobatto4")    these steps of this method

    t_eval      the times of the rows, increasing, within 0 ... time; None: evenly, or each step. Any times with "fvi-adaptive", and
                with methods with stages, of which x is of order S between two steps of "fvi-lobattoS", and p of order S - 1.
                With error it holds at these times
    error       how far x may be off at any row and event, a length > 0, by the library's estimate. With events, two runs of
                different accuracy must have the same events, and their times are right to error divided by the largest
                speed, but for those at which a body lifts off; a body whose hops are no higher than error is at rest
    method      as `methods()` lists them. None: "fvi-adaptive"; "fvi" with h, of order 1, beside which "fvi-lobatto4"
                has order 4 and more; with error and a law that
                "fvi-adaptive" does not take, "fvi-lobatto4" or "fvi-bdf2", as measured to be the fastest;
                "fvi-stable" of mechanisms and matrices with h, and, with a warning, for matrices with a damping of order 2
    h           the step, a time > 0 of which the problem's time is a multiple; of "fvi-adaptive", whose steps are its
                own, the time between two rows
    steps       instead of h: how many rows but one, whatever the problem; 200. A method whose steps have one length takes so
                many: one that you name, or "fvi-stable" where it is the method
    kappa       0 ... 1: the potential is taken at kappa x_k + (1 - kappa) x_{k+1}, of methods that have it; 0.5
    progress    True: a bar on standard error; or a function f(rows done, rows), called now and then
    step_error  of "fvi-adaptive": how far x may be off by one step, instead of 1e-10 of the largest |x|
    longest     of "fvi-adaptive", or with error: no step is longer, so that no pulse of a function is passed over
    most_steps  likewise: no run takes more
    events      what is watched, of "fvi-adaptive": 'Z : WHAT' as the program has them, "x : impact:0.8", "v : mark",
                "x : contact:0.8", "x1 - 2 : stop", or an `Event`; one or several. The Solution has their times, t_events
    checkpoint  the name of a file to which the motion is written, every 10 s and at its end. If it is there, the motion
                goes on from it: the numbers are those of a run that was never stopped, to the bit; events, too. Not with error
    memory, tolerance  how the past is summed, "auto", "direct" or "exponentials", and the tolerance of the latter;
                a warning says so where the method does not read them

    Raises TypeError and ValueError for what cannot be meant; fvi.Error with the library's code for what could not
    be done, its `rows` being the motion until then; what a function of yours raised. Warns by fvi.FviWarning.
    """
    return solved(problem, planned(problem, t_eval, error, method, h, steps, kappa, step_error, longest, most_steps,
                                   memory, tolerance, events, checkpoint), progress)
