"""What goes along with a motion: accelerations, forces, work, multipliers."""
from __future__ import annotations

from typing import Any, Optional

import numpy as np

from ._fvi import ffi, lib
from ._library import ask, error_of, failure, succeed, text_of, understand
from ._solution import Solution
from ._solve import Motion


def as_run(motion: Motion, s: Solution) -> Any:
    """The run whose steps a solution has. Where an error was asked of "fvi-adaptive" its rows are those of a run with
    a tenth of it as the tolerance of a step, or less; with events the very tolerance, and the height of rest."""
    run, how = motion.run, s.how
    if lib.is_dense(motion.method):
        if how.error is not None:
            run.step_error = how.error / 10 if not how.events or s.step_error is None else s.step_error
            for i in range(len(how.events)):
                motion.system.events[i].rest = how.events[i].rest or how.error
    elif how.error is not None and s.step:
        run.steps = round(s.problem.time / s.step)
        run.h = s.problem.time / run.steps
    return run


def refuse_between(t: Any, h: float, method: str, what: str) -> None:
    """Steps of one length know more than x and p at their ends alone."""
    for k in np.flatnonzero(abs(t / h - np.round(t / h)) > 1e-9 * np.maximum(t / h, 1))[:1]:
        raise ValueError(f"t_eval: t[{k}] is {t[k]:.10g}, within a step of {method}, which has the length {h:.10g}; there is "
                         f"no {what} between two steps, and fvi-adaptive has it at any time")


def begin(s: Solution, wanted: int) -> tuple:
    """The motion from its start, and an observer that goes along (fvi/observer.h)."""
    motion = Motion(s.problem, s.how)
    if s.how.t_eval is not None and not lib.is_dense(motion.method):
        refuse_between(s.t, as_run(motion, s).h, s.how.method, "acceleration, force, multiplier or work")
    out, error = ffi.new("fvi_stepper **"), ffi.new("fvi_error *")
    status = ask(lib.fvi_stepper_start, motion.method, as_run(motion, s), out, error)
    if status:
        raise error_of(error, status)
    stepper = ffi.gc(out[0], lib.fvi_stepper_free)
    made = ffi.new("fvi_observer **")
    status = ask(lib.fvi_observer_start, stepper, wanted, made, error)
    if status:
        raise error_of(error, status) if error.code == status else failure(status)
    return motion, stepper, ffi.gc(made[0], lib.fvi_observer_free)


def times(s: Solution) -> Any:
    """Those of the rows, for C."""
    return ffi.from_buffer("double[]", np.ascontiguousarray(s.t))


def observe(s: Solution, wanted: int) -> dict:
    """What is wanted at the rows: the motion is run again for it."""
    motion, stepper, observer = begin(s, wanted)
    d, n = motion.system.d, len(s.t)
    widths = [lib.fvi_observer_width(observer, j) for j in range(lib.fvi_observer_dampers(observer))]
    told = [lib.damper_name(motion.system.system, j) for j in range(len(widths))]
    names = [f"d{j + 1}" if name == ffi.NULL else text_of(name) for j, name in enumerate(told)]
    ties = [lib.imposed_on(motion.system.system, i) for i in range(lib.constraints(motion.system.system))]
    rooms = {name: np.empty((n, size)) for name, size, of in (
        ("v", d, lib.FVI_OBSERVE_VELOCITY), ("a", d, lib.FVI_OBSERVE_ACCELERATION), ("force", sum(widths), lib.FVI_OBSERVE_FORCE),
        ("impulse", sum(widths), lib.FVI_OBSERVE_IMPULSE), ("work", len(widths), lib.FVI_OBSERVE_WORK),
        ("work_of_force", 1, lib.FVI_OBSERVE_WORK), ("balance", 1, lib.FVI_OBSERVE_WORK),
        ("multiplier", len(ties), lib.FVI_OBSERVE_MULTIPLIER)) if wanted & of}
    to = ffi.new("observed *", {name: ffi.cast("double *", room.ctypes.data) for name, room in rooms.items()})
    done = ffi.new("size_t *")
    succeed(ask(lib.observe, observer, stepper, n, times(s), to, done), f" (row {done[0]})")
    cuts = np.cumsum(widths)[:-1]
    found: dict = {name: rooms[name] for name in ("v", "a") if name in rooms}
    for name, plural in (("force", "forces"), ("impulse", "impulses")):
        if name in rooms:
            found[plural] = dict(zip(names, np.split(rooms[name], cuts, axis=1)))
    if "work" in rooms:
        found["work"] = {**{name: rooms["work"][:, j] for j, name in enumerate(names)}, "force": rooms["work_of_force"][:, 0]}
        found["balance"] = rooms["balance"][:, 0]
    if "multiplier" in rooms:
        found["multipliers"] = rooms["multiplier"][:, [i for i, on in enumerate(ties) if not on]]
        found["reactions"] = {f"x{on}": -rooms["multiplier"][:, i] for i, on in enumerate(ties) if on}
    return found


class Columns:
    """Expressions of what is known along a motion, and what becomes of them, as the program has them (fvi/columns.h)."""

    def __init__(self, s: Solution, columns: Optional[str], reductions: Optional[str] = None):
        system, self.solution = s.motion.system, s
        is_structure = s.problem.kind == "structure"
        is_chain = system.typed_potential is not None and system.typed_potential.kind == lib.FVI_POTENTIAL_CHAIN
        self.source = ffi.new("fvi_column_source *", {
            "d": system.d, "is_numbered": system.d > 1 or is_chain or is_structure, "mechanism": system.system.mechanism,
            "is_structure": is_structure, "events": len(s.how.events),
            "ground": ffi.NULL if system.ground is None else lib.fvi_ground_acceleration(system.ground)})
        out = ffi.new("fvi_typed_columns **")
        understand(lib.fvi_typed_columns_start, self.source, out)
        self.typed = ffi.gc(out[0], lib.fvi_typed_columns_free)
        for parse, text in ((lib.fvi_parse_columns, columns), (lib.fvi_parse_reductions, reductions)):
            if text is not None:
                understand(parse, text.encode(), system.parameters, self.typed)

    def run(self, values: Any) -> None:
        s, done = self.solution, ffi.new("size_t *")
        _, stepper, observer = begin(s, lib.fvi_typed_columns_wanted(self.typed))
        succeed(ask(lib.table_of_run, self.typed, observer, stepper, len(s.t), times(s), values, done), f" (row {done[0]})")

    def table(self) -> dict:
        names = [text_of(lib.fvi_typed_column_name(self.typed, i)) for i in range(lib.fvi_typed_columns_count(self.typed))]
        values = np.empty((len(self.solution.t), len(names)))
        self.run(ffi.from_buffer("double[]", values))
        return {name: values[:, i] for i, name in enumerate(names)}

    def reduced(self) -> dict:
        names = [text_of(lib.fvi_reduction_name(self.typed, i)) for i in range(lib.fvi_reductions_count(self.typed))]
        values = np.empty(len(names))
        self.run(ffi.NULL)
        lib.fvi_reductions_values(self.typed, ffi.from_buffer("double[]", values))
        return dict(zip(names, values.tolist()))
