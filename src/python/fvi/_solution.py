"""What a problem has become: rows, and what can be asked of them."""
from __future__ import annotations

from typing import Any, Optional

import numpy as np

from ._arguments import Array, Numbers, numbers, word
from ._checkpoint import rows_by_stepper
from ._fvi import ffi, lib
from ._library import ask, error_of, failure, succeed
from ._problem import Problem
from .errors import Error


class Solution:
    """A motion: rows at the times `t`.

    t           n times
    x, p, v     positions, momenta and velocities, (n, d)
    energy      p^2/(2m) + U(x), or v L_v - L, n numbers
    a           accelerations, (n, d)
    forces      of each damper, a dict by its name, "d1", ... if it has none: (n, its number of forces)
    impulses    their integrals, likewise
    work        what each damper has taken, a dict by names of n numbers, and "force" what the force has given. Of several
                dampers of matrices "fvi-lobatto4d" and its kin know forces and work, and "fvi-adaptive" does not
    multipliers of the constraints, (n, their number); reactions: what moves each coordinate that is imposed, a dict, "x1", ...
    ag          acceleration of the ground, n numbers, 0 if it does not move
    t_events    of each event an array of its times, of a contact also those at which a body lifts off; x_events, p_events:
                x and p there, (k, d), p behind an impact; status_events: "at rest", "lifts off" or "" for each of these times
    balance     energy + work of the dampers - work of the force: that of the start
    status      0; or the code with which the run ended, of the rows of an Error
    message     in words
    steps       how many steps were taken, None of a run that failed
    step        their length, of "fvi-adaptive" that of the longest
    estimate    of the largest error of x, where one was asked for
    problem     what was solved

    A call, solution(t), gives x at other times, (d,) or (n, d), and state(t) x and p, by the polynomials of the method's own
    steps: "fvi-adaptive" is as right there as at its rows, "fvi-lobattoS" of order S at most; methods without stages
    know the ends of their steps. Each call is a run; so ask
    for many times at once. A Solution pickles with its problem."""

    def __init__(self, problem: Problem, how: Any, t: Array, x: Array, p: Array, status: int, message: str,
                 steps: Optional[int], step: float, estimate: Optional[float], events: Optional[tuple] = None,
                 step_error: Optional[float] = None):
        self.problem, self.how = problem, how
        self.t, self.x, self.p = t, x, p
        self.status, self.message, self.steps, self.estimate = status, message, steps, estimate
        self.step, self.step_error = step, step_error
        self.t_events, self.x_events, self.p_events, self.status_events = ([], [], [], []) if events is None else events
        self._motion: Any = None
        self._energy: Optional[Array] = None
        self._v: Optional[Array] = None
        self._observed: dict = {}

    def __getstate__(self) -> dict:
        return {**self.__dict__, "_motion": None}

    def __repr__(self) -> str:
        return (f"<fvi.Solution: {len(self.t)} rows, d = {self.x.shape[1]}, t = {self.t[0]:g} ... {self.t[-1]:g}; "
                f"{self.message}>")

    @property
    def success(self) -> bool:
        return self.status == 0

    @property
    def motion(self) -> Any:
        """The problem as the library takes it, made when it is needed."""
        if self._motion is None:
            from ._solve import Motion
            self._motion = Motion(self.problem, self.how)
        return self._motion

    def arrays(self) -> list:
        """t, x and p for C."""
        return [ffi.from_buffer("double[]", np.ascontiguousarray(a)) for a in (self.t, self.x, self.p)]

    @property
    def v(self) -> Array:
        if self.problem.kind == "mechanism":  # the run knows more of them than x and p
            return self.observed("v")
        if self._v is None:
            self._v = np.empty(self.x.shape)
            succeed(ask(lib.velocities, self.motion.run.system, len(self.t), self.arrays()[2],
                        ffi.from_buffer("double[]", self._v)), " (velocities)")
        return self._v

    @property
    def energy(self) -> Array:
        if self._energy is None:
            energy, done = np.empty(len(self.t)), ffi.new("size_t *")
            succeed(ask(lib.energies, self.motion.run.system, len(self.t), *self.arrays(),
                        ffi.from_buffer("double[]", energy), done), f" (energy of row {done[0]})")
            self._energy = energy
        return self._energy

    def observed(self, name: str) -> Any:
        """What an observer says; all of it at once, but for what is not known with events."""
        found: dict = self._observed
        if name not in found:
            from ._observe import observe
            wanted = lib.FVI_OBSERVE_VELOCITY if name == "v" else lib.FVI_OBSERVE_ACCELERATION | lib.FVI_OBSERVE_MULTIPLIER
            if name != "v" and (name not in ("a", "multipliers", "reactions") or not self.how.events):
                wanted |= lib.FVI_OBSERVE_FORCE | lib.FVI_OBSERVE_IMPULSE | lib.FVI_OBSERVE_WORK
            found.update(observe(self, wanted))
        return found[name]

    @property
    def a(self) -> Array:
        return self.observed("a")

    @property
    def forces(self) -> dict:
        return self.observed("forces")

    @property
    def impulses(self) -> dict:
        return self.observed("impulses")

    @property
    def work(self) -> dict:
        return self.observed("work")

    @property
    def balance(self) -> Array:
        return self.observed("balance")

    @property
    def multipliers(self) -> Array:
        return self.observed("multipliers")

    @property
    def reactions(self) -> dict:
        return self.observed("reactions")

    @property
    def ag(self) -> Array:
        found = np.zeros(len(self.t))
        if self.problem.ground is not None:
            succeed(ask(lib.accelerations_of_ground, self.motion.system.ground, len(self.t), self.arrays()[0],
                        ffi.from_buffer("double[]", found)), " (ground)")
        return found

    def __call__(self, t: Numbers) -> Array:
        return self.state(t, momenta=False)[0]

    def state(self, t: Numbers, *, momenta: bool = True) -> tuple:
        """Places and momenta at other times, x and p, (d,) or (n, d) each: of "fvi-adaptive" and of methods with stages at
        any time, of other methods at the ends of their steps. Between the ends of steps of "fvi-lobattoS" p is of
        order S - 1. momenta: False: x alone; p is None.

            x, p = solution.state([1.5, 2.5])
        """
        times = numbers("t", t)
        wanted, back = np.unique(times, return_inverse=True)
        x, p = np.empty((2, wanted.size, self.x.shape[1]))
        count = ffi.new("row_count *", {"all": wanted.size})
        if self.how.events:
            self.check(wanted)
            from ._observe import as_run
            as_run(self.motion, self)
            raised, _, stepper = rows_by_stepper(self.motion, self.how.events, None, wanted, x, p, count)
            last = max(float(of_one[-1]) for of_one in self.t_events if len(of_one)) if any(map(len, self.t_events)) else 0
            if raised is None and count.rows < wanted.size and wanted[-1] <= last:  # the other run ends a rounding before
                x[count.rows:], p[count.rows:] = (np.frombuffer(ffi.buffer(a, 8 * self.x.shape[1])) for a in (stepper.x, stepper.p))
            elif raised is None and count.rows < wanted.size:
                raise ValueError(f"t: {wanted[count.rows]:g} is behind the end of the motion, t = {stepper.t:g}")
        elif self.motion.method.stages:
            raised = self.within_steps(wanted, x, p if momenta else None)
        else:
            status, _, error = self.motion.solve(self.how, self.problem.time, np.ascontiguousarray(wanted), x, p, count)
            raised = None if not status else error_of(error, status) if error.code == status else failure(status)
        if raised is not None:
            raise raised
        shape = times.shape + (self.x.shape[1],)
        return x[back.reshape(-1)].reshape(shape), p[back.reshape(-1)].reshape(shape) if momenta else None

    def check(self, t: Array) -> None:
        """Do increasing times lie within the motion?"""
        end = self.problem.time
        if not (t.size == 0 or 0 <= t[0] <= t[-1] <= end):
            raise ValueError(f"t: {t[0] if not t[0] >= 0 else t[-1]:g} is not within the motion, 0 ... {end:g}")

    def within_steps(self, t: Array, x: Array, p: Optional[Array]) -> Optional[Error]:
        """x at increasing times, by the polynomials of the stages; p by their slopes, and at the ends of steps as it is."""
        from ._observe import as_run
        self.check(t)
        out, error = ffi.new("fvi_stepper **"), ffi.new("fvi_error *")
        status = ask(lib.fvi_stepper_start, self.motion.method, as_run(self.motion, self), out, error)
        if not status:
            stepper = ffi.gc(out[0], lib.fvi_stepper_free)
            status = ask(lib.positions_within, stepper, t.size, ffi.from_buffer("double[]", np.ascontiguousarray(t)),
                         ffi.from_buffer("double[]", x), ffi.NULL if p is None else ffi.from_buffer("double[]", p))
        return None if not status else error_of(error, status) if error.code == status else failure(status)

    def table(self, columns: str) -> dict:
        """Columns as the program has them, "t, drift=x2-x1, floor=a2+ag, d1.force", a dict by names of arrays (n,).

        The names are t, x, p, v, a, F, ag, energy, work, balance, those of dampers, d1.force, d1.impulse, d1.work, with
        numbers in more dimensions: x1, ..., d1.force1, ..., and those of events: event1.count and event1.last, how often the
        first has happened and when the last time, and of a contact event1.force, how strongly it pushes. NAME=... gives a
        name. The motion is run again for it."""
        from ._observe import Columns
        return Columns(self, word("columns", columns)).table()

    def reduce(self, reductions: str, columns: Optional[str] = None) -> dict:
        """What becomes of columns over all rows, "peak(x2-x1), at(peak(x2-x1)), rms(v1)", a dict by names of numbers.

        min, max, absmax, mean, rms, first, last, and peak, which is absmax refined by the parabola through three rows;
        at(...) is the time of it. They may use the names of `columns`. The motion is run again for it."""
        from ._observe import Columns
        return Columns(self, None if columns is None else word("columns", columns), word("reduce", reductions)).reduced()

    # ---- for others ----

    def columns(self) -> dict:
        """t, x1, ..., p1, ..., v1, ... as a dict of arrays; x, p, v of one coordinate."""
        d = self.x.shape[1]
        found = {"t": self.t}
        for name in ("x", "p", "v"):
            found.update({name + (str(i + 1) if d > 1 else ""): getattr(self, name)[:, i] for i in range(d)})
        return found

    def to_pandas(self) -> Any:
        """A pandas.DataFrame with the index t."""
        import pandas  # type: ignore
        return pandas.DataFrame(self.columns()).set_index("t")

    def to_xarray(self) -> Any:
        """An xarray.Dataset of x, p, v over t and the coordinate i, from 1."""
        import xarray  # type: ignore
        return xarray.Dataset({name: (("t", "i"), getattr(self, name)) for name in ("x", "p", "v")},
                              {"t": self.t, "i": np.arange(1, self.x.shape[1] + 1)},
                              {"problem": repr(self.problem), "message": self.message})

    def plot(self, axes: Any = None, **options: Any) -> Any:
        """x over t by matplotlib, on these axes or on new ones, which are returned."""
        if axes is None:
            import matplotlib.pyplot  # type: ignore
            axes = matplotlib.pyplot.subplots()[1]
        labels = [f"x{i + 1}" if self.x.shape[1] > 1 else "x" for i in range(self.x.shape[1])]
        for i, label in enumerate(labels):
            axes.plot(self.t, self.x[:, i], **{"label": label, **options})
        axes.set_xlabel("t")
        axes.set_ylabel("x")
        if len(labels) > 1:
            axes.legend()
        return axes
