"""A motion that is written down while it is computed, and goes on from there."""
from __future__ import annotations

import dataclasses
import hashlib
import math
import os
import time
from typing import Any, Optional

import numpy as np

from ._arguments import Array
from ._events import Happened
from ._fvi import ffi, lib
from ._library import ask, error_of, failure, succeed
from ._run import version
from ._system import Potential
from .errors import Error

SECONDS = 10.0  # between two times at which it is written


def described_by(given: Any) -> Any:
    """What two equal fields have in common, as bytes: numbers by all their digits, functions by name and code."""
    if isinstance(given, np.ndarray):
        return given.dtype.str.encode() + str(given.shape).encode() + given.tobytes()
    if isinstance(given, (tuple, list)):
        return b"(" + b",".join(map(described_by, given)) + b")"
    if dataclasses.is_dataclass(given):
        return described_by([(f.name, getattr(given, f.name)) for f in dataclasses.fields(given)])
    if callable(given):
        code = getattr(given, "__code__", None)
        return described_by((getattr(given, "__module__", ""), getattr(given, "__qualname__", type(given).__name__),
                             b"" if code is None else code.co_code))
    if isinstance(given, Potential):
        return described_by(sorted(vars(given).items()))
    return repr(given).encode()


class Checkpoint:
    """The file of a motion: the state of its run, and the rows until there."""

    def __init__(self, path: Any, problem: Any, how: Any):
        self.path = os.fspath(path)
        key = described_by([version(), problem, dataclasses.replace(how, checkpoint=None)])
        self.key = np.frombuffer(hashlib.sha256(key).digest(), np.uint8)

    def load(self, stepper: Any, x: Array, p: Array, happened: Happened) -> tuple:
        """How many rows stood, and how many events; the run is where it was."""
        if not os.path.exists(self.path):
            return 0, 0
        try:
            with np.load(self.path, allow_pickle=False) as file:
                key, state, old_x, old_p = (file[name] for name in ("key", "state", "x", "p"))
                events = {name: file[name] for name in happened.flat()}
        except (OSError, ValueError, KeyError, EOFError) as error:
            raise ValueError(f"checkpoint: {self.path} is no checkpoint; remove it, or choose another name") from error
        if not np.array_equal(key, self.key):
            raise ValueError(f"checkpoint: {self.path} is of another motion; remove it, or choose another name")
        rows = len(old_x)
        if rows > len(x) or old_x.shape != old_p.shape or old_x.shape[1:] != x.shape[1:]:
            raise ValueError(f"checkpoint: {self.path} has rows that are not those of this motion")
        succeed(ask(lib.load_stepper, stepper, ffi.from_buffer("unsigned char[]", np.ascontiguousarray(state)), state.size),
                f" (checkpoint {self.path})")
        x[:rows], p[:rows] = old_x, old_p
        return rows, happened.put(events)

    def save(self, stepper: Any, x: Array, p: Array, happened: Happened) -> None:
        """Complete or not at all."""
        size = ffi.new("size_t *")
        succeed(ask(lib.save_stepper, stepper, ffi.NULL, 0, size))
        state = np.empty(size[0], np.uint8)
        succeed(ask(lib.save_stepper, stepper, ffi.from_buffer("unsigned char[]", state), state.size, size))
        new = f"{self.path}.{os.getpid()}.new"
        try:
            with open(new, "wb") as file:
                np.savez(file, key=self.key, state=state, x=x, p=p, **happened.flat())
                file.flush()
                os.fsync(file.fileno())
            os.replace(new, self.path)
        except BaseException:
            if os.path.exists(new):
                os.unlink(new)
            raise


def rows_by_stepper(motion: Any, events: Any, file: Optional[Checkpoint], t: Array, x: Array, p: Array, count: Any) -> tuple:
    """Rows, from where a file has come to if there is one, until an event ends the motion: an error or None, what
    happened, and the stepper."""
    out, error = ffi.new("fvi_stepper **"), ffi.new("fvi_error *")
    happened, known, saved = Happened(events, motion.system.d), 0, time.monotonic()
    status = ask(lib.fvi_stepper_start, motion.method, motion.run, out, error)
    if status:
        return error_of(error, status) if error.code == status else failure(status), happened, None
    stepper = ffi.gc(out[0], lib.fvi_stepper_free)
    if file:
        count.rows, known = file.load(stepper, x, p, happened)
    known = happened.note(stepper, known)
    arrays = [ffi.from_buffer("double[]", a) for a in (t, x, p)]

    def is_done() -> bool:
        is_over = lib.fvi_stepper_is_over(stepper)
        return count.rows == len(t) or bool(is_over and not t[count.rows] <= stepper.t)
    while not is_done():
        status = ask(lib.rows_of_stepper, stepper, len(t), *arrays, count, SECONDS if file else math.inf)
        known = happened.note(stepper, known)
        if status:
            failed: Error = failure(status, f" (step {stepper.k + 1})", motion.run.failure)
            failed.step = stepper.k + 1
            return failed, happened, stepper
        if file and (is_done() or time.monotonic() - saved >= SECONDS):
            file.save(stepper, x[:count.rows], p[:count.rows], happened)
            saved = time.monotonic()
    return None, happened, stepper
