"""What goes along with a motion: accelerations, forces, work, multipliers."""
from __future__ import annotations

from typing import Any

import numpy as np

from ._fvi import ffi, lib
from ._library import ask, error_of, failure, succeed, text_of
from ._solution import Solution
from ._solve import Motion


def as_run(motion: Motion, s: Solution) -> Any:
    """The run whose steps a solution has. Where an error was asked of "fvi-adaptive" its rows are those of a run with
    a tenth of it as the tolerance of a step, or less."""
    run, how = motion.run, s.how
    if lib.is_dense(motion.method):
        if how.error is not None:
            run.step_error = how.error / 10
    elif how.error is not None and s.step:
        run.steps = round(s.problem.time / s.step)
        run.h = s.problem.time / run.steps
    return run


def observe(s: Solution, wanted: int) -> dict:
    """What an observer that goes along says (fvi/observer.h): the motion is run again for it."""
    motion = Motion(s.problem, s.how)
    run, d, n = as_run(motion, s), motion.system.d, len(s.t)
    out, error = ffi.new("fvi_stepper **"), ffi.new("fvi_error *")
    status = ask(lib.fvi_stepper_start, motion.method, run, out, error)
    if status:
        raise error_of(error, status)
    stepper = ffi.gc(out[0], lib.fvi_stepper_free)
    made = ffi.new("fvi_observer **")
    status = ask(lib.fvi_observer_start, stepper, wanted, made, error)
    if status:
        raise error_of(error, status) if error.code == status else failure(status)
    observer = ffi.gc(made[0], lib.fvi_observer_free)
    widths = [lib.fvi_observer_width(observer, j) for j in range(lib.fvi_observer_dampers(observer))]
    told = [lib.damper_name(motion.system.system, j) for j in range(len(widths))]
    names = [f"d{j + 1}" if name == ffi.NULL else text_of(name) for j, name in enumerate(told)]
    ties = [lib.imposed_on(motion.system.system, i) for i in range(lib.constraints(motion.system.system))]
    rooms = {name: np.empty((n, size)) for name, size, of in (
        ("a", d, wanted), ("force", sum(widths), lib.FVI_OBSERVE_FORCE),
        ("impulse", sum(widths), lib.FVI_OBSERVE_IMPULSE), ("work", len(widths), lib.FVI_OBSERVE_WORK),
        ("work_of_force", 1, lib.FVI_OBSERVE_WORK), ("balance", 1, lib.FVI_OBSERVE_WORK),
        ("multiplier", len(ties), lib.FVI_OBSERVE_MULTIPLIER)) if wanted & of}
    to = ffi.new("observed *", {name: ffi.cast("double *", room.ctypes.data) for name, room in rooms.items()})
    done = ffi.new("size_t *")
    succeed(ask(lib.observe, observer, stepper, n, ffi.from_buffer("double[]", np.ascontiguousarray(s.t)), to, done),
            f" (row {done[0]})")
    cuts = np.cumsum(widths)[:-1]
    found: dict = {"a": rooms["a"]}
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
