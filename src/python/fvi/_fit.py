"""Parameters from a measured motion."""
from __future__ import annotations

from typing import Any, NamedTuple, Optional, Union

import numpy as np

from ._arguments import Array, Numbers, choice, number, numbers, spelt, whole, word
from ._fvi import ffi, lib
from ._library import ask, ask_for_warning, failure, succeed, text_of, warn
from .errors import Error
from ._system import Potential
from ._run import prepare


class Fit(NamedTuple):
    """What a motion says of its parameters: `estimate`, `sd` and `interval` (95 %, of the profile) by name;
    `correlation`, an array in the order of the names; `chi2` with `sigma`, which is
    estimated if it was not given, and its `probability` (1 then); how many starts `agree`;
    `curve`, the fitted x at the times of the data; `neighbours`, the correlation of
    neighbouring residuals, near 0 if the model is right; `grave`, nonzero where a flag says that
    the answer is not to be believed."""
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
    grave: int


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


@spelt(prepare)
def fit(t: Numbers, x: Numbers, potential: Union[str, Potential] = "harmonic:1", *,
        which: str = "alpha,rho", sigma: Optional[float] = None, starts: int = 20,
        method: str = "fvi-lobatto4", h: float = 0.0, **options: Any) -> Fit:
    """Parameters of one mass from its measured motion, by least squares from several starts.

    t, x       the data: increasing times >= 0, and positions
    which      any of alpha, rho, mass, x0, p0, offset and drift of the sensor, and the potential's c, g or names of `let`
    sigma      standard deviation of each x, a length > 0; None: estimated
    starts     how many searches, a whole number >= 2, the first from the values given; 20
    h          the longest step, a time > 0; 0: found
    method     as for `run`, best one of high order, as its error counts as one of the data; "fvi-lobatto4"
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
    starts = whole("starts", starts, 2)
    times, xs = (np.ascontiguousarray(numbers(name, a)) for name, a in (("t", t), ("x", x)))
    if times.ndim != 1 or times.shape != xs.shape or times.size == 0:
        raise ValueError(f"t and x are two arrays of one length >= 1; they have the shapes {times.shape} and {xs.shape}")
    for name in ("steps", "time"):
        if name in options:
            raise ValueError(f"{name}: not for a fit, whose times are those of the data")
    problem, model, found = prepare(potential, float(times[-1]), method=method, **options)
    places = {"alpha": lib.FVI_FREE_PARAMETER_ALPHA, "rho": lib.FVI_FREE_PARAMETER_RHO, "mass": lib.FVI_FREE_PARAMETER_MASS,
              "x0": lib.FVI_FREE_PARAMETER_X0, "p0": lib.FVI_FREE_PARAMETER_P0, "offset": lib.FVI_FREE_PARAMETER_OFFSET,
              "drift": lib.FVI_FREE_PARAMETER_DRIFT}
    places.update((name, lib.FVI_FREE_PARAMETER_CONSTANT + i) for i, name in enumerate(problem.names))
    names = word("which", which).split(",")
    chosen = ffi.new("fvi_free_parameter[]", [int(choice("which", name, places)) for name in names])
    question = ffi.new("fvi_estimation *")
    question.method, question.run, question.n = found, model, times.size
    question.t, question.x = problem.pointer(times), problem.pointer(xs)
    if problem.constants is not None:
        question.constants = problem.pointer(problem.constants)
    question.sigma = 0.0 if sigma is None else number("sigma", sigma)
    question.parameters, question.which = len(names), chosen
    question.starts, question.h = starts, number("h", h)
    box = np.empty((2, len(names)))
    low, high = (problem.pointer(side) for side in box)
    succeed(ask(lib.fvi_estimate_box, question, low, high))
    for j, name in enumerate(names):  # the library knows nothing of the constants of an expression
        if problem.constants is problem.values and name in problem.let:
            k = problem.let[name]
            box[:, j] = sorted((k / 10, 10 * k)) if k else (-1, 1)  # as the program
    question.low, question.high = low, high
    curve, f = np.empty_like(times), ffi.new("fvi_estimate *")
    status = ask(lib.fvi_estimate_multistart, question, ffi.from_buffer("double[]", curve), f)
    text = ffi.new("char[]", lib.FVI_WARNING_ROOM)
    has_reason = lib.fvi_estimate_reason(status, question, f, which.encode(), b"", lib.FVI_WARNING_ROOM, text)
    if status not in (0, lib.FVI_EMAXITER, lib.FVI_ETOL, lib.FVI_ESING):
        raise Error(text_of(text), status) if has_reason else failure(status)
    e = ffi.new("fvi_examination *")
    if status != lib.FVI_ESING:
        succeed(ask(lib.fvi_estimate_examine, question, f, e))
    P = range(len(names))
    answer = Fit({n: f.estimate[j] for j, n in enumerate(names)}, {n: f.sd[j] for j, n in enumerate(names)},
                 {n: (e.lower[j], e.upper[j]) for j, n in enumerate(names)},
                 np.array([[f.correlation[i][j] for j in P] for i in P]),
                 f.chi2, f.sigma, f.probability, f.agree, f.neighbours, curve, e.grave)
    if status != lib.FVI_ESING:
        warn_of(question, f, e, names)
    if status:
        error = Error(text_of(text), status)
        error.fit = answer
        raise error
    return answer
