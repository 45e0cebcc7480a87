"""Parameters from a measured motion."""
from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple, Optional, Sequence, Union

import numpy as np

from ._arguments import Array, Numbers, described, lines_of_answer, names as names_of, number, numbers, row, spelt, whole, word
from ._fvi import ffi, lib
from ._library import ask, ask_for_warning, failure, succeed, text_of, understand, warn, warn_of_memory
from .errors import Error
from ._problem import Problem
from ._run import prepare
from ._solve import Motion, Numerics
from ._system import Potential, typed_force


class Fit(NamedTuple):
    """What a motion says of its parameters: `estimate`, `sd` and `interval` (95 %, of the profile) by name;
    `correlation`, an array in the order of the names; `chi2` with `sigma`, which is
    estimated if it was not given, an array for several columns, and its `probability` (1 then); how many starts
    `agree`; `curve`, what the fitted motion shows at the times of the data, as x, or a list of such for several
    records; `neighbours`, the correlation of neighbouring residuals, near 0 if the model is right; `grave`, nonzero
    where a flag says that the answer is not to be believed."""
    estimate: dict
    sd: dict
    interval: dict
    correlation: Array
    chi2: float
    sigma: Union[float, Array]
    probability: float
    agree: int
    neighbours: float
    curve: Union[Array, list]
    grave: int

    def __repr__(self) -> str:
        sigma = ", ".join(f"{each:.3g}" for each in np.atleast_1d(self.sigma))
        return lines_of_answer(self.estimate, self.interval, f"chi2 = {self.chi2:.4g} (probability {self.probability:.2g}), sigma = {sigma}; "
                      f"{self.agree} starts agree" + ("; not to be believed, see the warnings" if self.grave else ""))


def warn_of(question: Any, f: Any, e: Any, names: list) -> None:
    """What the program says below its answer."""
    texts = [ffi.new("char[]", name.encode()) for name in names]
    spelt_out = ffi.new("char *[]", texts)
    for i, name in enumerate(names):
        for j, other in enumerate(names[:i]):
            ask_for_warning(lib.fvi_estimate_warning_of_pair, f, j, i, other.encode(), name.encode())
    for which in range(2):
        ask_for_warning(lib.fvi_estimate_warning_of_unseen, question, f, e, which, spelt_out)
    past = lib.fvi_estimate_warning_of_initial_history(question, f)
    if past != ffi.NULL:
        warn(text_of(past))
    for flag in range(e.flags.bit_length()):
        ask_for_warning(lib.fvi_estimate_flag_text, question, f, e, 1 << flag, spelt_out)


class Record(NamedTuple):
    """One test: its times and columns, and what it has of its own."""
    t: Array
    x: Array  # (columns, n)
    shape: tuple
    own: Mapping


def record_of(what: str, t: Numbers, x: Numbers, own: Mapping) -> Record:
    times, xs = (np.ascontiguousarray(numbers(name, a)) for name, a in (("t", t), ("x", x)))
    if times.ndim != 1 or times.size == 0 or xs.shape[:1] != times.shape or xs.ndim > 2:
        raise ValueError(f"{what}t and x are two arrays of one length >= 1; they have the shapes {times.shape} and {xs.shape}")
    return Record(times, np.ascontiguousarray(xs.reshape(times.size, -1).T), xs.shape, own)


def records_of(t: Numbers, x: Numbers, records: Sequence[Mapping]) -> list:
    if not isinstance(records, (list, tuple)):
        raise TypeError(f"records: {described(records)} is no list of dicts")
    found = [record_of("", t, x, {})]
    for k, each in enumerate(records):
        if not isinstance(each, Mapping) or not {"t", "x"} <= set(each) <= {"t", "x", "x0", "p0", "force"}:
            raise TypeError(f"records: {described(each)} is no dict of t, x and, if they are its own, x0, p0 and force")
        found.append(record_of(f"records[{k}]: ", each["t"], each["x"],
                               {name: each[name] for name in ("x0", "p0", "force") if name in each}))
        if len(found[-1].x) != len(found[0].x):
            raise ValueError(f"records[{k}]: it has {len(found[-1].x)} columns, and the first {len(found[0].x)}")
    return found


def sensors_of(system: Any, shows: Optional[Sequence[str]], columns: int) -> tuple:
    """The names of the columns, and what they show."""
    if shows is None:
        if columns > 1 or system.d > 1:
            raise ValueError(f"shows: a body of {system.d} masses, and {columns} columns: what does each show? "
                             "shows=['x1', 'x2-x1']")
        return [], [ffi.NULL]
    texts = names_of("shows", shows)
    if len(texts) != columns:
        raise ValueError(f"shows: {len(texts)} for {columns} columns")
    found: tuple[list, list] = ([], [])
    name, out = ffi.new("char[]", lib.FVI_SENSOR_ROOM), ffi.new("fvi_expression **")
    for text in texts:
        understand(lib.fvi_parse_sensor, b"shows", word("shows", text).encode(), system.d, system.parameters, name, out)
        found[0].append(text_of(name))
        found[1].append(ffi.gc(out[0], lib.fvi_expression_free))
    return found


def put_records(question: Any, system: Any, found: list, shows: list, sigma: Array) -> None:
    """The records as the library wants them."""
    records = ffi.new("fvi_record[]", len(found))
    for to, each in zip(records, found):
        measured = ffi.new("fvi_measured[]", len(shows))
        for column, x, expression, s in zip(measured, each.x, shows, sigma):
            column.x, column.shows, column.sigma = system.pointer(np.ascontiguousarray(x)), expression, s
        to.n, to.t, to.measured = each.t.size, system.pointer(each.t), measured
        for name in ("x0", "p0"):
            if name in each.own:
                setattr(to, name, system.pointer(row(f"records: {name}", numbers(name, each.own[name]), system.d)))
        if "force" in each.own:
            typed = typed_force(word("records: force", each.own["force"]), system.d, system.parameters, each.t[-1])
            to.force = ffi.new("fvi_force *", lib.fvi_force_typed(typed))
            system.keep += [typed, to.force]
        system.keep += [measured]
    system.keep += [records, *shows]
    question.records, question.columns, question.record = len(found), len(shows), records


def model_of(potential: Any, last: float, method: Optional[str], options: dict) -> tuple:
    """The system, its run and the method, of a Problem or of what `run` takes."""
    if not isinstance(potential, Problem):
        return prepare(potential, last, method="fvi-lobatto4" if method is None else method, **options)
    if options:
        raise ValueError(f"{next(iter(options))}: not together with a Problem, which says it")
    default = "fvi-lobatto4d" if potential.kind == "structure" else "fvi-lobatto4"
    motion = Motion(potential.replace(time=last), Numerics(word("method", default if method is None else method), None, 1, 0.5, None, None,
                                                           None, 0, "auto", 0.0, None))
    if motion.method == ffi.NULL:
        raise ValueError(f"method: '{method}' is none that there is")
    return motion.system, motion.run, motion.method


def which_of(system: Any, run: Any, which: Optional[str], columns: list, has_ground: bool) -> tuple:
    """The names of the parameters, and what they mean."""
    names = ffi.new("fvi_free_parameter_names *")
    kept = [ffi.new("char[]", name.encode()) for name in (*columns, *system.names)]
    of_columns = ffi.new("char *[]", kept[:len(columns)] or [ffi.NULL])
    of_constants = ffi.new("char *[]", kept[len(columns):] or [ffi.NULL])
    names.run, names.columns, names.column = run, len(columns), of_columns
    names.constants, names.constant = len(system.names), of_constants
    names.parameters, names.has_ground = system.parameters, has_ground
    if which is None:
        text = ffi.new("char[]", 400)
        which = text_of(lib.fvi_free_parameters_of_laws(run, lib.FVI_ESTIMATION_MOST, 400, text))
    asked, out, found = word("which", which).split(","), ffi.new("fvi_free_parameter *"), []
    for name in asked:
        understand(lib.fvi_parse_free_parameter, b"which", name.encode(), names, out)
        found.append(int(out[0]))
    return asked, found


def put_box(question: Any, system: Any, names: list) -> None:
    """Where to begin: the library knows nothing of the constants of an expression."""
    box = np.empty((2, len(names)))
    low, high = (system.pointer(side) for side in box)
    succeed(ask(lib.fvi_estimate_box, question, low, high))
    for j, name in enumerate(names):
        if system.constants is system.values and name in system.let:
            k = system.let[name]
            box[:, j] = sorted((k / 10, 10 * k)) if k else (-1, 1)  # as the program
    question.low, question.high = low, high


def curves_of(found: list, curve: Array) -> Union[Array, list]:
    """What the fitted motion shows, in the shapes of the data."""
    curves, first = [], 0
    for each in found:
        rows = each.x.size
        curves.append(np.ascontiguousarray(curve[first:first + rows].reshape(each.x.shape).T).reshape(each.shape))
        first += rows
    return curves if len(curves) > 1 else curves[0]


@spelt(prepare)
def fit(t: Numbers, x: Numbers, potential: Union[str, Potential, Problem] = "harmonic:1", *,
        which: Optional[str] = None, shows: Union[None, str, Sequence[str]] = None, records: Sequence[Mapping] = (),
        sigma: Optional[Numbers] = None, huber: float = 0.0, starts: int = 20, method: Optional[str] = None,
        h: float = 0.0, **options: Any) -> Fit:
    """Parameters of a body from its measured motion, by least squares from several starts.

    t, x       the data: n increasing times >= 0, and what was measured then, n numbers or an array (n, columns)
    potential  as for `run`, or a Problem: masses, dampers or matrices
    which      any of alpha, rho, mass, x0, p0, x0_2 of the second coordinate, d1.rho of a law, NAME.alpha of a damper,
               offset and drift of the sensors, offset.COLUMN of one, and the potential's c, g or names of `let`
    shows      what each column shows, an expression of x1, ..., v1, ..., t, or NAME=EXPRESSION: ["x1", "drift=x2-x1"]
    records    more tests of the same body, each a dict with t and x, and with x0, p0 and force (a text) of its own
    sigma      standard deviation of each x, a length > 0, or one for each column; None: estimated
    huber      0: least squares; K > 0: residuals beyond K sigma count little (Huber's loss), 1.345 is usual; 0
    starts     how many searches, a whole number >= 2, the first from the values given; 20
    h          the longest step, a time > 0; 0: found
    method     as for `run`, best one of high order, as its error counts as one of the data; None: "fvi-lobatto4", or
               "fvi-adaptive" where the data ask for more than 8192 equal steps, or "fvi-lobatto4d" with matrices,
               a mass of 0 or another coordinate without inertia
    the rest   the model, potential and all, as for `run`, but for steps and time: those are the data's. With
               damping, rho (from 1) multiplies the law, and alpha is not among `which`

    Raises fvi.Error with the program's words where fewer than two starts agree on the best (code 11), chi^2 is out of
    range for the given sigma (14) or the data do not determine the parameters (21); the
    exception's `fit` has what was found all the same. What a function of yours raised comes out,
    from whichever motion of the search; where it has no value, let it give nan. Warns by fvi.Warning of
    parameters that the data hardly tell apart, of what the residuals show (a model or a noise that is
    not that of the data, an offset, a drift, no motion, two valleys, a step that is too long) or cannot
    show, and of estimates that no motion has.
    """
    starts, found = whole("starts", starts, 2), records_of(t, x, records)
    for name in ("steps", "time"):
        if name in options:
            raise ValueError(f"{name}: not for a fit, whose times are those of the data")
    last = max(float(each.t[-1]) for each in found)
    system, model, best = model_of(potential, last, method, options)
    columns, shown = sensors_of(system, shows, len(found[0].x))
    has_ground = isinstance(potential, Problem) and potential.ground is not None
    if has_ground and any(record.get("force") is not None for record in records):
        raise ValueError("records: a force of their own would take the place of the ground's")
    names, places = which_of(system, model, which, columns, has_ground)
    deviations = np.zeros(len(shown)) if sigma is None else row("sigma", numbers("sigma", sigma), len(shown))
    question = ffi.new("fvi_estimation *")
    question.method, question.run = best, model
    if len(found) == 1 and shows is None:
        question.n, question.sigma = found[0].t.size, deviations[0]
        question.t, question.x = system.pointer(found[0].t), system.pointer(found[0].x)
    else:
        put_records(question, system, found, shown, deviations)
    if system.constants is not None:
        question.constants = system.pointer(system.constants)
    chosen = ffi.new("fvi_free_parameter[]", places)
    question.parameters, question.which = len(names), chosen
    question.starts, question.h, question.huber = starts, number("h", h), number("huber", huber)
    if method is None and not h and not {"kappa", "memory", "tolerance"} & set(options):
        question.method = lib.fvi_estimate_method(question) or best
    if system.typed_force:
        understand(lib.fvi_check_force_of_fit, question, b"force", system.texts["force"].encode(), system.typed_force)
    warn_of_memory(question.method, model)
    put_box(question, system, names)
    curve, f = np.empty(sum(each.x.size for each in found)), ffi.new("fvi_estimate *")
    status = ask(lib.fvi_estimate_multistart, question, ffi.from_buffer("double[]", curve), f)
    text = ffi.new("char[]", lib.FVI_WARNING_ROOM)
    has_reason = lib.fvi_estimate_reason(status, question, f, ",".join(names).encode(), b"", lib.FVI_WARNING_ROOM, text)
    if status not in (0, lib.FVI_EMAXITER, lib.FVI_ETOL, lib.FVI_ESING):
        raise Error(text_of(text), status) if has_reason else failure(status)
    e = ffi.new("fvi_examination *")
    if status != lib.FVI_ESING:
        succeed(ask(lib.fvi_estimate_examine, question, f, e))
    P = range(len(names))
    answer = Fit({n: f.estimate[j] for j, n in enumerate(names)}, {n: f.sd[j] for j, n in enumerate(names)},
                 {n: (e.lower[j], e.upper[j]) for j, n in enumerate(names)},
                 np.array([[f.correlation[i][j] for j in P] for i in P]), f.chi2,
                 f.sigma if len(shown) == 1 else np.array([f.column_sigma[c] for c in range(len(shown))]),
                 f.probability, f.agree, f.neighbours, curves_of(found, curve), e.grave)
    if status != lib.FVI_ESING:
        warn_of(question, f, e, names)
    if status:
        error = Error(text_of(text), status)
        error.fit = answer
        raise error
    return answer
