"""Runs: whole trajectories, single steps."""
from __future__ import annotations

import math
import threading
from typing import Any, Callable, NamedTuple, Optional, Union

import numpy as np

from ._arguments import Array, Numbers, choice, nearest, number, numbers, row, spelt, whole, word
from ._fvi import ffi, lib
from ._library import STOPPED, ask, ask_for_warning, error_of, failure, succeed, text_of, warn_of_memory, warn_of_start
from .errors import Error
from ._system import Law, Potential, System

PASTS = {"held": lib.FVI_INITIAL_HISTORY_HELD, "caputo": lib.FVI_INITIAL_HISTORY_CAPUTO,
         "rl": lib.FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE}
MEMORIES = {"auto": lib.FVI_HISTORY_AUTO, "direct": lib.FVI_HISTORY_DIRECT,
            "exponentials": lib.FVI_HISTORY_MODES}


def version() -> str:
    """The version of the library inside."""
    return text_of(lib.fvi_version())


class Method(NamedTuple):
    """An integrator: `order` and `memory` in words, `lowest` and `highest` order of x at a
    fixed time over all alpha (of "fvi-adaptive", in the number of its steps), which alpha it knows, whether it has a kappa and solves an
    equation in each step."""
    name: str
    order: str
    memory: str
    lowest: int
    highest: int
    alpha: tuple
    kappa: bool
    implicit: bool


def methods() -> list:
    """Every integrator that `run` knows, as a list of Method."""
    table: list[Method] = []
    while lib.fvi_methods[len(table)] != ffi.NULL:
        m = lib.fvi_methods[len(table)]
        table.append(Method(text_of(m.name), text_of(m.order), text_of(m.memory), m.lowest, m.highest, (m.alpha_least, m.alpha_most),
                            bool(m.takes_kappa), bool(m.implicit)))
    return table


CHUNK = 4096  # steps after which another thread may have a Stepper


def length(what: str, given: Optional[float]) -> float:
    """0 of what is not given."""
    if given is not None and not 0 < number(what, given) < math.inf:
        raise ValueError(f"{what}: {given} is not above 0, or not finite")
    return given or 0.0


def refused(what: str, value: float, why: str) -> Error:
    """Of a number that is out of its range."""
    found = Error(f"{what} is {value:g}; it {why}", lib.FVI_EDOM)
    found.field, found.value = what, None if math.isnan(value) else value
    return found


def positive(what: str, given: Any) -> float:
    """A number that the library would refuse by a name of its own if it were not > 0 and finite."""
    value = number(what, given)
    if 0 < value < math.inf:
        return value
    raise refused(what, value, "must be finite and positive")


def prepare(potential: Union[str, Potential] = "harmonic:1", last: Optional[float] = None, /, *, alpha: Optional[float] = None,
            rho: Optional[Numbers] = None, damping: Law = None, mass: Numbers = 1.0,
            force: Union[None, str, Callable[[float], Numbers]] = None, let: Optional[dict] = None,
            derivative: str = "held", kappa: float = 0.5, x0: Numbers = 1.0, p0: Numbers = 0.5,
            h: Optional[float] = None, steps: int = 200, time: Optional[float] = None, method: str = "fvi",
            memory: str = "auto", tolerance: float = 0.0, step_error: Optional[float] = None,
            longest: Optional[float] = None, most_steps: Optional[int] = None) -> tuple:
    if damping is not None and not (alpha is None and rho is None):
        raise ValueError("damping: not together with alpha or rho")
    default = 0.2 if damping is None else 1.0  # a law has its own
    steps = whole("steps", steps, 1)
    if h is not None and time is not None:
        raise ValueError("h: not together with time")
    h = positive("time", time) / steps if time is not None else positive("h", 0.1 if h is None else h)
    end = steps * h if last is None else last
    problem = System(potential, force, mass, default if rho is None else rho, x0, p0, let, end, damping)
    found = lib.fvi_method_find(word("method", method).encode())
    if found == ffi.NULL:
        names = [m.name for m in methods()]
        raise ValueError(f"method: '{method}' is none of " + ", ".join(names) + nearest(method, names))
    problem.check_force(found, h, steps if last is None else 0)  # a fit takes the times of its data
    if not found.takes_kappa and kappa != 0.5:
        raise ValueError(f"kappa: {method} has none")
    for name, value in (("step_error", step_error), ("longest", longest), ("most_steps", most_steps)):
        if value is not None and found != lib.fvi_method_find(b"fvi-adaptive"):
            raise ValueError(f"{name}: not for {method}, whose steps are given; fvi-adaptive chooses its own")
    run = ffi.new("fvi_run *")
    run.step_error, run.longest = length("step_error", step_error), length("longest", longest)
    run.most_steps = 0 if most_steps is None else whole("most_steps", most_steps, 1)
    run.system = problem.system
    run.x0, run.p0 = problem.pointer(problem.x0), problem.pointer(problem.p0)
    run.h, run.steps = h, steps
    run.failure = problem.failure
    run.kappa, run.tolerance = number("kappa", kappa), number("tolerance", tolerance)
    run.alpha = number("alpha", 0.5 if alpha is None else alpha)
    run.law = problem.law
    run.past = choice("derivative", derivative, PASTS)
    run.memory = choice("memory", memory, MEMORIES)
    return problem, run, found


class Stepper:
    """One trajectory, step by step. Arguments as `run`, but for `columns` and `error`; or an fvi.Problem, with a Lagrangian,
    constraints, dampers or matrices, too, and beside it method, h or steps and the like, as `solve` has them.

        s = fvi.Stepper("pendulum:1", alpha=0.3, x0=2, p0=0)
        while s.k < s.steps and abs(s.x) > 1e-3:
            s.step()
        rod = fvi.Problem(lagrangian="(v1^2+v2^2)/2 - x2", constraints=["x1^2+x2^2-1"], x0=[1, 0], v0=[0, 0])
        s = fvi.Stepper(rod, h=0.1)

    `k` steps are done, `t` is the time, `x` and `p` are numbers, or arrays of d numbers
    of their own. `copy` forks the run with its history, `reset` goes back to
    the start. After a step that failed it is over: reset, or begin anew. "fvi-adaptive" chooses its
    steps, and takes neither h nor steps: `time` is where the motion ends, 20, and k counts the 200 parts of it that
    have passed, so that the same loop ends there.

    Several threads may share one: each call waits until the call of another thread is done. Its
    own potential or force cannot ask it for a step, a copy or a reset: that is a RuntimeError.
    """

    @spelt(prepare)
    def __init__(self, potential: Union[str, Potential] = "harmonic:1", **options: Any):
        if hasattr(potential, "kind") and hasattr(potential, "replace"):
            self._problem, self._run, self._method = self._of(potential, options)
            self._begin(potential.v0 is not None)
            return
        for name in ("h", "steps"):
            if options.get("method") == "fvi-adaptive" and options.get(name) is not None:
                raise ValueError(f"{name}: fvi-adaptive chooses its steps itself, in a Stepper, too; time is where the motion "
                                 "is to end, and longest a step that none exceeds")
        self._problem, self._run, self._method = prepare(potential, **options)
        self._begin()

    @staticmethod
    def _of(problem: Any, options: dict) -> tuple:
        """Those of an fvi.Problem."""
        from ._solve import Motion, chosen
        own = ("method", "h", "steps", "kappa", "step_error", "longest", "most_steps", "memory", "tolerance")
        for name in options:
            if name not in own:
                raise ValueError(f"{name}: the problem says it; problem.replace({name}=...) makes another one" if name in
                                 problem.__dataclass_fields__ else f"{name}: not for a Problem; there are {', '.join(own)}")
        given = {"memory": "auto", "tolerance": 0.0, **options}
        how = chosen(problem, None, None, *(given.get(name) for name in ("method", "h", "steps", "kappa", "step_error",
                                                                        "longest", "most_steps", "memory", "tolerance")))
        motion = Motion(problem, how)
        return motion.system, motion.run, motion.method

    def _begin(self, is_v0: bool = False) -> None:
        """At k = 0."""
        self._lock, self._is_busy, self._taken = threading.RLock(), False, ffi.new("size_t *")
        out, error = ffi.new("fvi_stepper **"), ffi.new("fvi_error *")
        status = ask(lib.fvi_stepper_start, self._method, self._run, out, error)
        if status:
            raised = error_of(error, status)
            if raised.field == "p0" and is_v0:
                raised.field = "v0"
            raise raised
        self._s = ffi.gc(out[0], lib.fvi_stepper_free)
        self._watch = warn_of_start(self._method, self._run)
        self._watch_at_start = ffi.new("fvi_watch *", self._watch[0])[0]
        self.steps: int = self._run.steps

    @property
    def k(self) -> int:
        return self._s.k

    @property
    def t(self) -> float:
        return self._s.t

    @property
    def x(self) -> Union[float, Array]:
        with self._lock:
            return self._row(self._s.x)

    @property
    def p(self) -> Union[float, Array]:
        with self._lock:
            return self._row(self._s.p)

    def _row(self, pointer: Any) -> Union[float, Array]:
        if self._problem.scalar:
            return pointer[0]
        return np.frombuffer(ffi.buffer(pointer, 8 * self._problem.d)).copy()

    def _alone(self, function: Callable, *arguments: Any) -> Any:
        """A call while no other thread, and no function of the run's, makes one."""
        with self._lock:
            if self._is_busy:
                raise RuntimeError("Stepper: a step is under way; what it asks cannot step, copy or reset it")
            self._is_busy = True
            try:
                return function(*arguments)
            finally:
                self._is_busy = False

    def _take(self, count: int) -> int:
        """At most so many steps; how many there were."""
        status = ask(lib.take_steps, self._s, count, self._watch, self._taken)
        if status:
            stopped = failure(status, f" (step {self._s.k + 1})", self._run.failure)
            stopped.step, stopped.time = self._s.k + 1, self._s.t
            raise stopped
        return self._taken[0]

    def step(self, count: int = 1) -> None:
        """So many steps on, 0 or more."""
        left = count if type(count) is int and count >= 0 else whole("count", count, 0)
        while left > 0:
            taken = self._alone(self._take, left if left < CHUNK else CHUNK)
            left -= taken
            if self._s.k >= self._watch.next:
                self._alone(ask_for_warning, lib.fvi_warning_along, self._watch, self._method, self._run,
                            self._s.k, self._s.x)

    def kick(self, J: Numbers) -> None:
        """p += J between two steps, by fvi-adaptive, for each mass or one for all. For alpha > 1/2 the run has
        to know it: with force="impulse:0,0" its steps are short enough."""
        given = row("J", numbers("J", J), self._problem.d)
        succeed(self._alone(ask, lib.fvi_stepper_kick, self._s, ffi.from_buffer("double[]", given)))

    def copy(self) -> "Stepper":
        """The same run again, at the same step; neither knows of the other."""
        other, out = object.__new__(Stepper), ffi.new("fvi_stepper **")
        with self._lock:
            succeed(self._alone(ask, lib.fvi_stepper_copy, self._s, out))
            other.__dict__.update(self.__dict__, _s=ffi.gc(out[0], lib.fvi_stepper_free), _lock=threading.RLock(),
                                  _is_busy=False, _taken=ffi.new("size_t *"),
                                  _watch=ffi.new("fvi_watch *", self._watch[0]))
        return other

    def reset(self) -> None:
        """Back to k = 0."""
        with self._lock:
            succeed(self._alone(ask, lib.fvi_stepper_reset, self._s))
            self._watch[0] = self._watch_at_start


class Run(NamedTuple):
    """A trajectory: `t` of N + 1 times; `x`, `p` of N + 1 numbers, or (N + 1, d) where the
    start was a list or the system has more than one mass; `energy` p^2/(2m) + U of N + 1.
    What was not asked for is None. `estimate`: of the largest error of x, if one was asked for."""
    t: Array
    x: Optional[Array]
    p: Optional[Array]
    energy: Optional[Array]
    estimate: Optional[float] = None


def solve(method: Any, r: Any, time: float, tolerance: float, most: int, pointers: list) -> float:
    """Every row of a run into x, p and energy, to a tolerance if there is one: the estimate of the error."""
    problem = ffi.new("fvi_problem *", {"system": r.system[0], "x0": r.x0, "p0": r.p0, "T": time, "alpha": r.alpha,
                                        "law": r.law, "past": r.past})
    options = ffi.new("fvi_solve_options *", {
        "method": method, "h": 0.0 if tolerance else r.h, "kappa": ffi.addressof(r, "kappa"), "longest": r.longest,
        "step_error": r.step_error, "history": r.memory, "history_tolerance": r.tolerance})
    accuracy = ffi.new("fvi_accuracy *", {"tolerance": tolerance, "most_steps": most})
    outputs = ffi.new("fvi_outputs *", dict(zip(("x", "p", "energy"), pointers), rows=r.steps + 1))
    report, error = ffi.new("fvi_report *"), ffi.new("fvi_error *")
    status = ask(lib.fvi_solve, problem, options, accuracy, outputs, report, error)
    if status in STOPPED and not tolerance and status != lib.FVI_EBADFUNC:  # which the library explains
        stopped = failure(status, f" (step {error.index})")
        stopped.step = error.index
        raise stopped
    if status and error.code == status:
        raise error_of(error, status)
    succeed(status)
    return report.error


def by_steps(method: Any, r: Any, out: dict, pointers: list) -> None:
    """Every row, and what is to be said of them; of a run that fails, too."""
    watch = warn_of_start(method, r)
    x = pointers[0]
    if watch.next <= r.steps:  # how stiff is it where it comes to?
        out.setdefault("x", np.full((r.steps + 1) * r.system.d, np.nan))
        x = ffi.from_buffer("double[]", out["x"])
    try:
        solve(method, r, r.steps * r.h, 0.0, r.most_steps, [x, *pointers[1:]])
    finally:
        if watch.next <= r.steps:
            ask_for_warning(lib.warn_along_rows, watch, method, r, r.steps + 1,
                            ffi.from_buffer("double[]", np.arange(r.steps + 1) * r.h), x)


@spelt(prepare)
def run(potential: Union[str, Potential] = "harmonic:1", *, columns: str = "t,x,p",
        error: Optional[float] = None, **options: Any) -> Run:
    """A whole trajectory of m x'' + grad U(x) + rho D^{2 alpha} x = F(t).

    potential   "harmonic:C", "duffing:C,G", "pendulum:G", "free", "chain:D,C,G", as the
                program has them; an expression in x, or in x1, x2, ...: "x^4/4 - k*x^2/2";
                or what `fvi.potential` makes
    let         the numbers that expressions name: {"k": 3}; one that none names is a ValueError
    alpha       0 ... 1, a pure number; the damping is of order 2 alpha; 0.5
    rho, mass   one number, or d of them: rho >= 0 in mass time^(2 alpha - 2), 0.2; mass > 0, 1
    damping     instead of alpha and rho a law, "zener:R,A,T" or another one of those that
                `help(fvi.formulas)` has, several with " + " between them, or a list of such, which add;
                or alone "symbol:EXPRESSION" in s and the names of let, or a function C(s) of the
                complex s: analytic but for s <= 0 (there the limit from above is asked for), real
                for s > 0, and growing no faster than s^2. A pole off the negative axis with
                |arg s| < 165 degrees is refused
    force       None, "step:A,T", "cosine:A,W", "impulse:J,T" (every momentum jumps by J at T), "file:F.tsv",
                an expression in t, or a function of t that gives one number or d of them, in
                mass length / time^2
    derivative  the past, what was before t = 0: "held" at x0, "caputo" or "rl"; "held": the damping acts on x - x0
    x0, p0      the start, one number or d of them: a length, 1; a momentum, mass length / time, 0.5
    h, steps    the step, a time > 0, and how many, a whole number >= 1; 0.1 and 200
    time        instead of h the time > 0 of the last row: h = time / steps
    error       instead of h, a length > 0: the rows to `time`, 20, with steps between them so chosen that x is
                right to it by an estimate; by "fvi-adaptive", or for a law that it does not take
                "fvi-lobatto4" or "fvi-bdf2", unless another method is named
    step_error  instead of error, a length > 0: what x may be off by in one step of "fvi-adaptive", the method
                then, by the estimate of that step; below 1e-17 of the size at the start, which rounding hides, an Error
    longest     no step is longer, of "fvi-adaptive" or where `error` is given: shorter than the shortest
                pulse of a force that is a function, which may be passed over else
    most_steps  of "fvi-adaptive", and with error: no run takes more steps; fvi.Error (10, or 14
                with error) says between which rows it ended
    method      as `methods()` lists them; "fvi"
    kappa       0 ... 1, a pure number: the potential is taken at kappa x_k + (1 - kappa) x_{k+1}; 0.5
    memory      how the past is summed: "auto", "direct" or "exponentials"; "auto"
    tolerance   of the compressed memory, relative to the direct sum, 0 ... 1 (not 1); 0 is 1e-13
    columns     any of t,x,p,energy: only these are computed

    Raises TypeError and ValueError for what cannot be meant, fvi.Error with the library's code
    for what could not be done, and whatever a function of yours raised. Warns by fvi.Warning of
    numbers that are not those of a motion, by a step that is too long or a past without a solution, and of a memory or
    a tolerance that the method does not read.
    """
    wanted = word("columns", columns).split(",")
    if not set(wanted) <= {"t", "x", "p", "energy"}:
        raise ValueError(f"columns: '{columns}' are not all among t,x,p,energy")
    most = 0
    if error is not None:
        for name in ("h", "step_error"):
            if options.get(name) is not None:
                raise ValueError(f"{name}: not together with error")
        options.setdefault("time", 20.0)
        is_open = "method" not in options and options.get("damping") is not None
        options.setdefault("method", "fvi-bdf2" if is_open else "fvi-adaptive")
        if options.get("most_steps") is not None:
            most = whole("most_steps", options.pop("most_steps"), 1)
    if options.get("step_error") is not None or options.get("longest") is not None:
        options.setdefault("method", "fvi-adaptive")
    longest = options.pop("longest", None) if error is not None else None  # of a search by any method
    problem, r, method = prepare(potential, **options)
    if error is not None:
        r.longest = length("longest", longest)
    rows, d = r.steps + 1, problem.d
    shape = (rows,) if problem.scalar else (rows, d)
    out = {name: np.full((rows,) if name == "energy" else shape, np.nan)
           for name in ("x", "p", "energy") if name in wanted}
    pointers = [ffi.from_buffer("double[]", out[n]) if n in out else ffi.NULL
                for n in ("x", "p", "energy")]
    estimate = None
    if error is None:
        by_steps(method, r, out, pointers)
    else:
        if not 0 < number("error", error) < math.inf:
            raise Error(f"error: {error} is not above 0, or not finite", lib.FVI_EDOM)
        if is_open:
            method = lib.fvi_method_for_error(r, number("error", error))
        warn_of_memory(method, r)
        estimate = solve(method, r, number("time", options["time"]), number("error", error), most, pointers)
    x, p, energy = (out[n] if n in wanted else None for n in ("x", "p", "energy"))
    return Run(np.arange(rows) * r.h, x, p, energy, estimate)
