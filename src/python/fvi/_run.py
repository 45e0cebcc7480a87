"""Runs: whole trajectories, single steps, exact solutions."""
from __future__ import annotations

import math
from typing import Any, Callable, NamedTuple, Optional, Sequence, Union

import numpy as np

from ._fvi import ffi, lib
from ._problem import Array, Error, Numbers, Potential, Problem, law, words

lib.listen()  # the reasons of errors go into the exceptions

PASTS = {"held": lib.FVI_PAST_HELD, "caputo": lib.FVI_PAST_CAPUTO,
         "rl": lib.FVI_PAST_RIEMANN_LIOUVILLE}
MEMORIES = {"auto": lib.FVI_MEMORY_AUTO, "direct": lib.FVI_MEMORY_DIRECT,
            "fft": lib.FVI_MEMORY_FFT, "exponentials": lib.FVI_MEMORY_EXPONENTIALS}


def version() -> str:
    """The version of the library inside."""
    return ffi.string(lib.fvi_version()).decode()


class Method(NamedTuple):
    """An integrator: `order` and `memory` in words, `lowest` and `highest` order of x at a
    fixed time over all alpha, which alpha it knows, whether it has a kappa and solves an
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
    table = []
    while lib.fvi_methods[len(table)] != ffi.NULL:
        m = lib.fvi_methods[len(table)]
        table.append(Method(*(ffi.string(t).decode() for t in (m.name, m.order, m.memory)),
                            m.lowest, m.highest, (m.alpha_least, m.alpha_most),
                            bool(m.takes_kappa), bool(m.implicit)))
    return table


def choice(what: str, given: str, known: dict) -> Any:
    if given not in known:
        raise ValueError(f"{what}: '{given}' is none of " + ", ".join(known))
    return known[given]


def whole(what: str, n: Any, least: int) -> None:
    if not least <= n < 2**53 or n != int(n):
        raise ValueError(f"{what}: {n} is no whole number >= {least}")


class Stepper:
    """One trajectory, step by step. Arguments as `run`, but for `columns`.

        s = fvi.Stepper("pendulum:1", alpha=0.3, x0=2, p0=0)
        while s.k < s.steps and abs(s.x) > 1e-3:
            s.step()

    `k` steps are done, `t` is the time, `x` and `p` are numbers, or arrays of d numbers
    of their own. `copy` forks the run with all that it remembers, `reset` goes back to
    the start. After a step that failed it is over: reset, or begin anew.
    """

    def __init__(self, potential: Union[str, Potential] = "harmonic:1", **options: Any):
        self._problem, self._run, self._method = prepare(potential, **options)
        out = ffi.new("fvi_stepper **")
        self._problem.check(lib.fvi_start(self._method, self._run, out))
        self._s = ffi.gc(out[0], lib.fvi_stop)
        self.steps: int = self._run.steps

    @property
    def k(self) -> int:
        return self._s.k

    @property
    def t(self) -> float:
        return self._s.t

    @property
    def x(self) -> Union[float, Array]:
        return self._row(self._s.x)

    @property
    def p(self) -> Union[float, Array]:
        return self._row(self._s.p)

    def _row(self, pointer: Any) -> Union[float, Array]:
        if self._problem.scalar:
            return pointer[0]
        return np.frombuffer(ffi.buffer(pointer, 8 * self._problem.d)).copy()

    def step(self, count: int = 1) -> None:
        """So many steps on."""
        for _ in range(count):
            self._problem.check(lib.fvi_step(self._s), f" (step {self._s.k + 1})")

    def copy(self) -> "Stepper":
        """The same run again, at the same step; neither knows of the other."""
        other, out = object.__new__(Stepper), ffi.new("fvi_stepper **")
        self._problem.check(lib.fvi_copy(self._s, out))
        other.__dict__.update(self.__dict__, _s=ffi.gc(out[0], lib.fvi_stop))
        return other

    def reset(self) -> None:
        """Back to k = 0."""
        self._problem.check(lib.fvi_reset(self._s))


def prepare(potential: Union[str, Potential] = "harmonic:1", *, alpha: Optional[float] = None,
            rho: Optional[Numbers] = None, damping: Union[None, str, Sequence[str]] = None, mass: Numbers = 1.0,
            force: Union[None, str, Callable[[float], Numbers]] = None, let: Optional[dict] = None,
            derivative: str = "held", kappa: float = 0.5, x0: Numbers = 1.0, p0: Numbers = 0.5,
            h: Optional[float] = None, steps: int = 200, time: Optional[float] = None, method: str = "fvi",
            memory: str = "auto", tolerance: float = 0.0, step_error: Optional[float] = None) -> tuple:
    if damping is not None and not (alpha is None and rho is None):
        raise ValueError("damping: not together with alpha or rho")
    default = 0.2 if damping is None else 1.0  # a law has its own
    problem = Problem(potential, force, mass, default if rho is None else rho, x0, p0, let)
    whole("steps", steps, 1)
    if h is not None and time is not None:
        raise ValueError("h: not together with time")
    if time is not None:
        h = time / int(steps)
    found = lib.fvi_method_named(method.encode())
    if found == ffi.NULL:
        raise ValueError(f"method: '{method}' is none of " + ", ".join(m.name for m in methods()))
    if not found.takes_kappa and kappa != 0.5:
        raise ValueError(f"kappa: {method} has none")
    if step_error is not None and found != lib.fvi_method_named(b"fvi-adaptive"):
        raise ValueError(f"step_error: not for {method}, whose steps are given; fvi-adaptive chooses its own")
    if step_error is not None and not 0 < step_error < math.inf:
        raise ValueError(f"step_error: {step_error} is not above 0, or not finite")
    run = ffi.new("fvi_run *")
    run.step_error = step_error or 0.0
    run.system = problem.system
    run.x0, run.p0 = problem.pointer(problem.x0), problem.pointer(problem.p0)
    run.h, run.steps = 0.1 if h is None else h, int(steps)
    run.kappa, run.alpha, run.tolerance = kappa, 0.5 if alpha is None else alpha, tolerance
    if damping is not None:
        kept = law(damping)
        run.law = kept[0]
        problem.keep.append(kept)
    run.past = choice("derivative", derivative, PASTS)
    run.memory = choice("memory", memory, MEMORIES)
    return problem, run, found


class Run(NamedTuple):
    """A trajectory: `t` of N + 1 times; `x`, `p` of N + 1 numbers, or (N + 1, d) where the
    start was a list or the system has more than one mass; `energy` p^2/(2m) + U of N + 1.
    What was not asked for is None. `estimate`: of the largest error of x, if one was asked for."""
    t: Array
    x: Optional[Array]
    p: Optional[Array]
    energy: Optional[Array]
    estimate: Optional[float] = None


MOST_STEPS = 1 << 24  # as the program


def search(problem: Problem, r: Any, method: Any, error: float, x: Any, p: Any) -> float:
    """Rows with an error of at most that by an estimate, which is returned."""
    if method == lib.fvi_method_named(b"fvi-adaptive"):
        found = ffi.new("fvi_adaptive_found *")
        status = lib.fvi_adaptive_search(r, error, MOST_STEPS, x, p, found)
    else:
        found = ffi.new("fvi_step_found *")
        status = lib.fvi_step_search(method, r, error, MOST_STEPS, x, p, found)
    if status == lib.FVI_ETOL:
        problem.check(0)
        raise Error(status, f": the smallest estimate of the error was {found.estimate:.2g}")
    problem.check(status)
    return found.estimate


STOPPED = (lib.FVI_EOVRFLW, lib.FVI_EMAXITER, lib.FVI_ESING)  # codes of a step that failed


def where_it_stopped(out: list, rows: int) -> str:
    """The first row that is not there, of arrays that were NaN before the run."""
    whole = [np.isfinite(a.reshape(rows, -1)).all(axis=1) for a in out]
    return f" (step {int(np.argmin(np.all(whole, axis=0)))})" if whole else ""


def run(potential: Union[str, Potential] = "harmonic:1", *, columns: str = "t,x,p",
        error: Optional[float] = None, **options: Any) -> Run:
    """A whole trajectory of m x'' + grad U(x) + rho D^{2 alpha} x = F(t).

    potential   "harmonic:C", "duffing:C,G", "pendulum:G", "free", "chain:D,C,G", as the
                program has them; an expression in x, or in x1, x2, ...: "x^4/4 - k*x^2/2";
                or what `fvi.potential` makes
    let         the numbers that expressions name: {"k": 3}; one that none names is a ValueError
    alpha       0 ... 1, the damping is of order 2 alpha; 0.5
    rho, mass   one number, or d of them; 0.2 and 1
    damping     instead of alpha and rho a law, "power:R,A", "zener:R,A,T", "maxwell:R,T" or
                "distributed:R,A,B" as the program has them, or a list of such, which add
    force       None, "step:A,T", "cosine:A,W", "impulse:J,T" (every momentum jumps by J at T),
                an expression in t, or a function of t that gives one number or d of them
    derivative  the past: "held", "caputo" or "rl"
    x0, p0      the start, one number or d of them; 1 and 0.5
    h, steps    the step and how many; 0.1 and 200; time=T instead of h: h = T / steps
    error       instead of h: the rows to `time`, 20, with steps between them so chosen that x is
                right to it by an estimate; by "fvi-adaptive", or "fvi-bdf2" with damping,
                unless another method is named
    step_error  instead of error: what x may be off by in one step of "fvi-adaptive", the method
                then, by the estimate of that step
    method      as `methods()` lists them; "fvi"
    kappa       0 ... 1, where the potential is taken; 0.5
    memory      "auto", "direct", "fft" or "exponentials"
    tolerance   of the compressed memory, relative to the direct sum; 0 stands for 1e-13
    columns     any of t,x,p,energy: only these are computed

    Raises ValueError for what cannot be meant, fvi.Error with the library's code for what
    could not be done, and whatever a function of yours raised.
    """
    wanted = columns.split(",")
    if not set(wanted) <= {"t", "x", "p", "energy"}:
        raise ValueError(f"columns: '{columns}' are not all among t,x,p,energy")
    if error is not None:
        for name in ("h", "step_error"):
            if options.get(name) is not None:
                raise ValueError(f"{name}: not together with error")
        options.setdefault("time", 20.0)
        options.setdefault("method", "fvi-adaptive" if options.get("damping") is None else "fvi-bdf2")
    if options.get("step_error") is not None:
        options.setdefault("method", "fvi-adaptive")
    problem, r, method = prepare(potential, **options)
    rows, d = r.steps + 1, problem.d
    shape = (rows,) if problem.scalar else (rows, d)
    out = {name: np.full((rows,) if name == "energy" else shape, np.nan)
           for name in ("x", "p", "energy") if name in wanted or (error is not None and name != "energy")}
    pointers = [ffi.from_buffer("double[]", out[n]) if n in out else ffi.NULL
                for n in ("x", "p", "energy")]
    estimate = None
    if error is None:
        status = lib.fvi_trajectory(method, r, *pointers)
        problem.check(status, where_it_stopped(list(out.values()), rows) if status in STOPPED else "")
    else:
        estimate = search(problem, r, method, error, *pointers[:2])
        for k in range(rows if "energy" in wanted else 0):
            problem.check(lib.fvi_energy(r.system, *(q + k * d for q in pointers[:2]), pointers[2] + k))
    return Run(np.arange(rows) * r.h, *(out[n] if n in wanted else None for n in ("x", "p", "energy")), estimate)


class Fit(NamedTuple):
    """What a motion says of its parameters: `estimate`, `sd` and `interval` (95 %) by name;
    `correlation`, an array in the order of the names; `chi2` with `sigma`, which is
    estimated if it was not given, and its `probability` (1 then); how many starts `agree`;
    `curve`, the fitted x at the times of the data; `neighbours`, the correlation of
    neighbouring residuals, near 0 if the model is right."""
    estimate: dict
    sd: dict
    interval: dict
    correlation: Array
    chi2: float
    sigma: float
    probability: float
    agree: int
    neighbours: float
    curve: Array


def fit(t: Numbers, x: Numbers, potential: Union[str, Potential] = "harmonic:1", *,
        which: str = "alpha,rho", sigma: Optional[float] = None, starts: int = 20,
        method: str = "fvi-lobatto4", h: float = 0.0, **options: Any) -> Fit:
    """Parameters of one mass from its measured motion, by least squares from several starts.

    t, x       the data: increasing times >= 0, and positions
    which      any of alpha, rho, mass, x0, p0, and the potential's c, g or names of `let`
    sigma      standard deviation of each x; None: estimated
    starts     how many searches, the first from the values given
    h          the longest step; 0: found
    the rest   the model, as for `run`, but for steps and time: those are the data's. With
               damping, rho (from 1) multiplies the law, and alpha is not among `which`

    Raises fvi.Error where fewer than two starts agree on the best (code 11), chi^2 is out of
    range for the given sigma (14) or the data do not determine the parameters (21); the
    exception's `fit` has what was found all the same. What a function of yours raised comes out,
    from whichever motion of the search; where it has no value, let it give nan.
    """
    whole("starts", starts, 2)
    times, xs = (np.ascontiguousarray(a, dtype=float) for a in (t, x))
    if times.ndim != 1 or times.shape != xs.shape:
        raise ValueError("t and x are two arrays of one length")
    for name in ("steps", "time"):
        if name in options:
            raise ValueError(f"{name}: not for a fit, whose times are those of the data")
    problem, model, found = prepare(potential, method=method, **options)
    places = {"alpha": lib.FVI_PARAMETER_ALPHA, "rho": lib.FVI_PARAMETER_RHO, "mass": lib.FVI_PARAMETER_MASS,
              "x0": lib.FVI_PARAMETER_X0, "p0": lib.FVI_PARAMETER_P0}
    places.update((name, lib.FVI_PARAMETER_CONSTANT + i) for i, name in enumerate(problem.names))
    names = which.split(",")
    chosen = ffi.new("fvi_parameter[]", [int(choice("which", name, places)) for name in names])
    question = ffi.new("fvi_fit *")
    question.method, question.run, question.n = found, model, times.size
    question.t, question.x = problem.pointer(times), problem.pointer(xs)
    if problem.constants is not None:
        question.constants = problem.pointer(problem.constants)
    question.sigma = 0.0 if sigma is None else sigma
    question.parameters, question.which = len(names), chosen
    question.starts, question.h = int(starts), h
    box = np.empty((2, len(names)))
    low, high = (problem.pointer(side) for side in box)
    problem.check(lib.fvi_fit_box(question, low, high))
    for j, name in enumerate(names):  # the library knows nothing of the constants of an expression
        if problem.constants is problem.values and name in problem.let:
            k = problem.let[name]
            box[:, j] = sorted((k / 10, 10 * k)) if k else (-1, 1)  # as the program
    question.low, question.high = low, high
    curve, f = np.empty_like(times), ffi.new("fvi_fitted *")
    status = lib.fvi_fit_search(question, ffi.from_buffer("double[]", curve), f)
    problem.check(0 if status in (lib.FVI_EMAXITER, lib.FVI_ETOL, lib.FVI_ESING) else status)
    P = range(len(names))
    answer = Fit({n: f.estimate[j] for j, n in enumerate(names)}, {n: f.sd[j] for j, n in enumerate(names)},
                 {n: (f.estimate[j] - f.quantile * f.sd[j], f.estimate[j] + f.quantile * f.sd[j])
                  for j, n in enumerate(names)},
                 np.array([[f.correlation[i][j] for j in P] for i in P]),
                 f.chi2, f.sigma, f.probability, f.agree, f.neighbours, curve)
    if status:
        error = Error(status)
        error.fit = answer
        raise error
    return answer


def on_grid(t: Array) -> int:
    """How many times, from the first on, are the doubles nearest to 0, h, 2 h, ..."""
    if t.size < 2 or not 0 < t[1] < np.inf:
        return 0
    strays = np.flatnonzero(t != np.arange(t.size) * t[1])
    return int(strays[0]) if strays.size else t.size


def exact(t: Numbers, *, mass: float = 1.0, c: float = 1.0, rho: Optional[float] = None,
          alpha: Optional[float] = None, damping: Union[None, str, Sequence[str]] = None, derivative: str = "held", x0: float = 1.0, v0: float = 0.5,
          force: Optional[str] = None) -> tuple:
    """x(t) and x'(t) of m x'' + c x + rho D^{2 alpha} x = F(t), to about 4e-14 of max |x|, with
    damping to about 2e-13.

    t      one time or an array of them, >= 0, in any order; the times of a grid, as the t of
           a run or of numpy.linspace(0, T, n + 1), more than 513 of them, are computed together,
           to 7e-14, mostly more than ten times as fast
    force  None, "step:A,T" or "cosine:A,W"
    v0     the velocity at 0, not the momentum
    damping  as for `run`, instead of rho (0.2) and alpha (0.5)

    Returns two arrays of the shape of t. Raises fvi.Error where there is no solution
    (derivative="rl" with x0 != 0 and alpha > 1/2), a number is out of its range, or damping
    has another past than "held" or more than three oscillations.
    """
    times = np.array(t, dtype=float)
    flat = np.ascontiguousarray(times.reshape(-1))
    if damping is not None and not (alpha is None and rho is None):
        raise ValueError("damping: not together with alpha or rho")
    kept = law(damping) if damping is not None else (ffi.NULL,)
    default = 0.2 if damping is None else 1.0
    problem = ffi.new("fvi_linear *", {
        "m": mass, "c": c, "rho": default if rho is None else rho, "alpha": 0.5 if alpha is None else alpha, "x0": x0,
        "v0": v0, "past": choice("derivative", derivative, PASTS), "law": kept[0]})
    if force not in (None, "none"):
        name, n = words(force, {"step": 2, "cosine": 2})
        problem.A = n[0]
        if name == "step":
            problem.forcing, problem.T = lib.FVI_FORCING_STEP, n[1]
        else:
            problem.forcing, problem.w = lib.FVI_FORCING_COSINE, n[1]
    x, v = np.empty_like(flat), np.empty_like(flat)
    room = lambda a: ffi.from_buffer("double[]", a)
    count = on_grid(flat) if damping is None else 0
    status = lib.fvi_exact_rows(problem, flat[1], count - 1, 0, room(x), room(v)) if count > 513 else 0
    rest = count if count > 513 else 0
    if not status and rest < flat.size:
        status = lib.fvi_exact(problem, flat.size - rest, room(flat[rest:]), room(x[rest:]), room(v[rest:]))
    if status:
        raise Error(status)
    return x.reshape(times.shape), v.reshape(times.shape)


def weights(order: float, count: int) -> Array:
    """The first weights of (1 - z)^order, 0 <= order <= 2, each to the last bit or next to it."""
    w = np.empty(count)
    status = lib.fvi_coefficients(order, count, ffi.from_buffer("double[]", w))
    if status:
        raise Error(status)
    return w
