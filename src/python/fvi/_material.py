"""Laws of damping from what laboratories measure, and what a law gives there."""
from __future__ import annotations

from typing import Any, NamedTuple, Optional, Union

import numpy as np

from ._arguments import Array, Numbers, lines_of_answer, number, numbers, spelt, whole, word
from ._fvi import ffi, lib
from ._library import ask, ask_for_warning, error_of, text_of, understand
from ._system import Law, law as law_of
from .errors import Error

Weights = Union[str, Numbers]


class Material(NamedTuple):
    """The law that is nearest to the data: `estimate`, `sd` and `interval` (95 %, of the profile) by names such as
    "zener2.alpha"; `law`, its text for `Problem(damping=...)`; `sigma`, the relative error, given or estimated, with
    `chi2` and its `probability`; `neighbours`, the correlation of neighbouring residuals; how many starts `agree`;
    `curve`, the law at the data, of moduli complex; `grave`, nonzero where a flag says that it is not to be believed.

    As damping a law acts on x - x0, so a spring in it pulls to the place where the body was held, and a body at rest stays
    there. Of a mass on this material with its rest at 0 put the spring into the potential: for "spring:K + zener:R,A,T"
    fvi.Problem("harmonic:K", damping="zener:R,A,T", ...)."""
    estimate: dict
    sd: dict
    interval: dict
    law: str
    sigma: float
    chi2: float
    probability: float
    neighbours: float
    agree: int
    curve: Array
    grave: int

    def __repr__(self) -> str:
        return lines_of_answer(self.estimate, self.interval, f"law {self.law!r}\nsigma = {self.sigma:.3g}; {self.agree} starts agree"
                      + ("; not to be believed, see the warnings" if self.grave else ""))


def kinds_of(law: str) -> list:
    known: list = []
    while lib.fvi_element_words[len(known)] != ffi.NULL:
        known.append(text_of(lib.fvi_element_words[len(known)]))
    found = [each.strip() for each in word("law", law).split("+")]
    for each in found:
        if each not in known:
            raise ValueError(f"law: '{each}' is none of " + ", ".join(known))
    return [(each, known.index(each)) for each in found]


def names_of(kind: int) -> list:
    found: list = []
    while len(found) < 4:
        name = lib.fvi_element_number(kind, len(found), ffi.NULL)
        if name == ffi.NULL:
            break
        found.append(text_of(name))
    return found


def refusal(error: Any, status: int, at: str) -> Error:
    """Of the numbers `at`, which have a name of their own here, or of the law."""
    found = error_of(error, status)
    if found.field == "at":
        found.field, found.args = at, (f"{at}: {found.args[0]}",)
    return found


def fit_material(test: int, at: tuple, first: tuple, second: Optional[tuple], law: str, weights: Weights,
                 sigma: Optional[float], load: float, starts: int) -> Material:
    rows = [(name, np.ascontiguousarray(numbers(name, a))) for name, a in (at, first, *([second] if second else []))]
    for name, a in rows:
        if a.ndim != 1 or a.shape != rows[0][1].shape:
            raise ValueError(f"{name}: the shape {a.shape} is not {rows[0][1].shape}")
    n, kinds = rows[0][1].size, kinds_of(law)
    room = [ffi.from_buffer("double[]", a) for _, a in rows]
    unit: Any = ffi.NULL
    if isinstance(weights, str):
        if weights not in ("relative", "absolute"):
            raise ValueError(f"weights: '{weights}' is neither relative nor absolute")
        if weights == "absolute":
            unit = ffi.new("double[]", [1.0] * n)
    else:
        each = np.broadcast_to(numbers("weights", weights), (n,))
        unit = ffi.new("double[]", each.tolist())
    kind = ffi.new("fvi_element[]", [k for _, k in kinds])
    data = ffi.new("fvi_material_data *", {
        "test": test, "n": n, "at": room[0], "first": room[1], "second": room[2] if second else ffi.NULL, "unit": unit,
        "sigma": 0.0 if sigma is None else number("sigma", sigma), "load": number("load", load), "elements": len(kinds),
        "kind": kind, "starts": whole("starts", starts, 2)})
    curve, m, error = np.empty((2 if second else 1, n)), ffi.new("fvi_material *"), ffi.new("fvi_error *")
    status = ask(lib.fvi_material_fit, data, ffi.from_buffer("double[]", curve), m, error)
    if status:
        raise refusal(error, status, at[0])
    names, parts, j = [], [], 0
    for i, (text, k) in enumerate(kinds, 1):
        own = names_of(k)
        names += [f"{text}{i}.{name}" for name in own]
        parts.append(text + ":" + ",".join(repr(m.estimate[j + l]) for l in range(len(own))))
        j += len(own)
    for bit in range(m.flags.bit_length()):
        ask_for_warning(lib.fvi_material_flag_text, data, m, 1 << bit)
    return Material(dict(zip(names, m.estimate)), dict(zip(names, m.sd)),
                    {name: (m.lower[i], m.upper[i]) for i, name in enumerate(names)}, " + ".join(parts), m.sigma, m.chi2,
                    m.probability, m.neighbours, m.agree, curve[0] + 1j * curve[1] if second else curve[0], m.grave)


@spelt()
def fit_moduli(omega: Numbers, storage: Numbers, loss: Numbers, law: str = "spring+power", *,
               weights: Weights = "relative", sigma: Optional[float] = None, starts: int = 20) -> Material:
    """A law of damping from moduli, storage + i loss = C(i omega).

    omega          frequencies > 0, in radians per unit of time
    storage, loss  the moduli there
    law            its elements: spring, viscous, power, zener, maxwell, maxwell2, davidson, distributed,
                   havriliak, with + between
    weights        the errors of the data are "relative", in proportion to the moduli, or "absolute", all alike, or in
                   proportion to these numbers
    sigma          the factor of that; None: estimated
    starts         how many searches at most

    Warns by fvi.FviWarning of all that speaks against the answer.
    """
    return fit_material(lib.FVI_MATERIAL_MODULI, ("omega", omega), ("storage", storage), ("loss", loss), law, weights,
                        sigma, 1.0, starts)


@spelt()
def fit_creep(t: Numbers, x: Numbers, law: str = "spring+power", *, load: float = 1.0, weights: Weights = "relative",
              sigma: Optional[float] = None, starts: int = 20) -> Material:
    """A law of damping from a creep test, x(t) under a constant force from t = 0 on; no mass moves.

    t, x  times > 0, and elongations
    load  the force
    law, weights, sigma, starts  as for `fit_moduli`
    """
    return fit_material(lib.FVI_MATERIAL_CREEP, ("t", t), ("x", x), None, law, weights, sigma, load, starts)


@spelt()
def fit_relaxation(t: Numbers, f: Numbers, law: str = "spring+power", *, load: float = 1.0,
                   weights: Weights = "relative", sigma: Optional[float] = None, starts: int = 20) -> Material:
    """A law of damping from a relaxation test, the force f(t) at a constant elongation from t = 0 on.

    t, f  times > 0, and forces
    load  the elongation
    law, weights, sigma, starts  as for `fit_moduli`
    """
    return fit_material(lib.FVI_MATERIAL_RELAXATION, ("t", t), ("f", f), None, law, weights, sigma, load, starts)


def curve(test: int, damping: Law, name: str, at: Numbers, load: float, let: Optional[dict]) -> Array:
    parameters = ffi.new("fvi_user_parameters *")
    for key, value in (let or {}).items():
        understand(lib.fvi_user_parameters_set, parameters, key.encode(), number(f"let: {key}", value))
    kept, points = law_of(damping, parameters), numbers(name, at)
    understand(lib.fvi_user_parameters_are_used, parameters)
    flat = np.ascontiguousarray(points.reshape(-1))
    first, second, error = np.empty(flat.size), np.empty(flat.size), ffi.new("fvi_error *")
    status = ask(lib.fvi_material_curve, test, ffi.addressof(kept[0], "law"), number("load", load), flat.size,
                 ffi.from_buffer("double[]", flat), ffi.from_buffer("double[]", first),
                 ffi.from_buffer("double[]", second), error)
    if status:
        raise refusal(error, status, name)
    return (first + 1j * second if test == lib.FVI_MATERIAL_MODULI else first).reshape(points.shape)[()]


@spelt()
def moduli(damping: Law, omega: Numbers, let: Optional[dict] = None) -> Array:
    """C(i omega) of a law of damping, storage + i loss: what an experiment at one frequency sees.

    damping  as for `Problem`
    omega    frequencies > 0, in radians per unit of time
    let      numbers that an expression names
    """
    return curve(lib.FVI_MATERIAL_MODULI, damping, "omega", omega, 1.0, let)


@spelt()
def creep(damping: Law, t: Numbers, load: float = 1.0, let: Optional[dict] = None) -> Array:
    """The elongation of a law under a constant force, load, at times t > 0; damping and let as for `moduli`."""
    return curve(lib.FVI_MATERIAL_CREEP, damping, "t", t, load, let)


@spelt()
def relaxation(damping: Law, t: Numbers, load: float = 1.0, let: Optional[dict] = None) -> Array:
    """The force of a law at a constant elongation, load, at times t > 0; damping and let as for `moduli`."""
    return curve(lib.FVI_MATERIAL_RELAXATION, damping, "t", t, load, let)
