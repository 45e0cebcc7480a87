"""What moves, as data."""
from __future__ import annotations

import dataclasses
import re
import textwrap
from collections.abc import Mapping
from dataclasses import KW_ONLY, dataclass
from typing import Any, Callable, Optional, Sequence, Union

import numpy as np

from ._arguments import Array, Numbers, described, number, numbers, spelt
from ._mechanism import matrix, texts
from ._system import Law, Potential, formulas

Force = Union[None, str, Callable[[float], Numbers], tuple[Sequence[float], Numbers]]
NUMERIC = ("t_eval", "error", "method", "h", "steps", "kappa", "progress", "step_error", "longest", "most_steps",
           "memory", "tolerance", "events", "checkpoint")
OTHERS = {"derivative": "past", "U": "potential", "m": "mass", "F": "force", "T": "time", "M": "mass", "beta": "order"}


def listed(what: str, given: Any) -> tuple:
    """One text or several members."""
    if given is None or isinstance(given, (str, list, tuple)):
        return () if given is None else (given,) if isinstance(given, str) else tuple(given)
    raise TypeError(f"{what}: {described(given)} is no text and no list")


def imposed(given: Any) -> Any:
    """'x1=EXPRESSION', or of a name with a text, a function or a pair of arrays."""
    if isinstance(given, str):
        return given
    if not (isinstance(given, (tuple, list)) and len(given) == 2 and isinstance(given[0], str)):
        raise TypeError(f"impose: {described(given)} is no text 'x1=...', and no name of a coordinate with what it follows")
    name, what = given
    if not re.fullmatch(r"x\d*", name):
        raise ValueError(f"impose: '{name}' is no coordinate, x1, x2, ...")
    if isinstance(what, str):
        return f"{name}={what}"
    if isinstance(what, (tuple, list)) and len(what) == 2:
        return name, tuple(frozen(f"impose: {name}: {of}", a) for of, a in zip("tx", what))
    if not callable(what):
        raise TypeError(f"impose: {name}: {described(what)} is no text, no function of t and no pair (t, x) of arrays")
    return name, what


def frozen(what: str, given: Any) -> Union[float, Array]:
    """A number, or an array that nobody changes."""
    a = numbers(what, given)
    if a.ndim == 0:
        return float(a)
    a.flags.writeable = False
    return a


@dataclass(frozen=True, eq=False)
class Problem:
    """A motion m x'' + grad U(x) + rho D^order x = F(t), 0 <= t <= time: what moves and how it begins.

        duffing = fvi.Problem("duffing:1,0.5", alpha=0.3, rho=0.4, x0=1, p0=0.5, time=20)
        solution = fvi.solve(duffing, error=1e-6)
        other = duffing.replace(alpha=0.4)

    potential  "harmonic:C", "duffing:C,G", "pendulum:G", "free", "chain:D,C,G"; an expression in x, or in
               x1, x2, ...: "x^4/4 - k*x^2/2"; or what `fvi.potential` makes of three functions; "harmonic:1"
    time       the end of the motion, > 0; 20
    let        the numbers that expressions name: {"k": 3}
    mass       one number > 0 for all coordinates, or d of them; 1
    rho        the damping, one number >= 0 or d of them; 0.2
    alpha      half the order of the derivative in the damping, 0 ... 1; 0.5, a dashpot
    order      or that order itself, 0 ... 2: order = 2 alpha
    damping    instead of alpha and rho a law: "zener:R,A,T", "maxwell:R,T", ..., several with " + " between
               them, a list of such, "symbol:EXPRESSION" in s, or a function C(s) of the complex s; see below
    force      None; a text, "cosine:A,W", "step:A,T", "impulse:J,T", "file:F.tsv" or an expression in t; a pair
               (t, F) of arrays, linear in between, F of one column for all coordinates or of d; or a function of t
    ground     the acceleration of the ground, as a force: a text, a pair (t, a) of arrays, or a function of t. x is then
               relative to the ground, which adds the force -M r a
    along      r, how each coordinate moves with the ground, one number or d of them; 1
    past       what was before t = 0: "held" at x0, "caputo" or "rl"; "held": the damping acts on x - x0, not on x, so
               that a body which rests at x0 feels none of it; see below. Of dampers each has its own
    x0         where it begins, one number or d of them; 1, with M 0
    p0         its momentum there, one number or d of them; 0.5, with M 0
    v0         or its velocity there

    More than masses and a potential:
    lagrangian   L, an expression in x1, ..., v1, ..., t, instead of mass, potential and damping; with x0 and v0 or p0
    dampers      each '[NAME=] G : LAW [: PAST]', on the elongation G, an expression in x1, ...: "x2 - x1 : viscous:1";
                 with M a triple (C, LAW) or (C, LAW, PAST), C a matrix or, of an elongation, a row of d numbers
    constraints  each an expression in x1, ..., t that is 0
    impose       each a coordinate that is prescribed, "x1=sin(t)"; a Solution has the force that it takes, `reactions`.
                 Or a dict by names, {"x1": ...}, of texts, of pairs (t, x) of arrays, with cubics between the rows
                 (a spline), or of functions of t that give the place and the velocity, (sin(t), cos(t)). Of rows v0 need be
                 right as far as three of them tell it: the motion begins with the velocity of the cubics
    force_on     each a force that knows x, v and t, "2=-0.1*v2^3"
    M, K, C      matrices of scipy.sparse or arrays (d, d), M x'' + C D^order x + K x = F, instead of mass, potential, rho

    A problem never changes; `replace` makes another one. What is printed of it has the time, the start and the damping also
    where they were not given. Two are equal if all of their fields are. It pickles if
    its functions do: those that stand in a module.
    """
    potential: Union[str, Potential] = "harmonic:1"
    _: KW_ONLY
    time: float = 20.0
    let: Optional[Mapping[str, float]] = None
    mass: Numbers = 1.0
    rho: Optional[Numbers] = None
    alpha: Optional[float] = None
    order: Optional[float] = None
    damping: Law = None
    force: Force = None
    ground: Union[None, str, Callable[[float], float], tuple[Sequence[float], Numbers]] = None
    along: Optional[Numbers] = None
    past: str = "held"
    x0: Optional[Numbers] = None
    p0: Optional[Numbers] = None
    v0: Optional[Numbers] = None
    lagrangian: Optional[str] = None
    dampers: Sequence = ()
    constraints: Sequence[str] = ()
    impose: Union[str, Sequence, Mapping[str, Any]] = ()
    force_on: Sequence[str] = ()
    M: Any = None
    K: Any = None
    C: Any = None

    def __post_init__(self) -> None:
        def put(name: str, value: Any) -> None:
            object.__setattr__(self, name, value)
        for one, other in (("alpha", "order"), ("p0", "v0"), ("damping", "alpha"), ("damping", "order"),
                           ("damping", "rho")):
            if getattr(self, one) is not None and getattr(self, other) is not None:
                raise ValueError(f"{one}: not together with {other}")
        if isinstance(self.impose, Mapping):
            put("impose", tuple(self.impose.items()))
        for name in ("dampers", "constraints", "impose", "force_on"):
            put(name, listed(name, getattr(self, name)))
        self.check_kind()
        for name in ("time", "alpha", "order"):
            if name == "time" or getattr(self, name) is not None:
                put(name, number(name, getattr(self, name)))
        for name in ("mass", "rho", "x0", "p0", "v0", "along"):
            if name == "mass" or getattr(self, name) is not None:
                put(name, frozen(name, getattr(self, name)))
        if self.let is not None:
            if not isinstance(self.let, Mapping):
                raise TypeError(f"let: {described(self.let)} is no dict of names and numbers")
            put("let", {name: number(f"let: {name}", value) for name, value in self.let.items()})
        for name in ("M", "K", "C"):
            if getattr(self, name) is not None:
                put(name, matrix(name, getattr(self, name)))
        for name in ("constraints", "force_on"):
            put(name, texts(name, getattr(self, name)))
        put("impose", tuple(map(imposed, self.impose)))
        put("dampers", texts("dampers", self.dampers) if self.M is None else tuple(
            self.damper(given) for given in self.dampers))
        if isinstance(self.damping, list):
            put("damping", tuple(self.damping))
        for name, of in (("force", "tF"), ("ground", "ta")):
            given = getattr(self, name)
            if isinstance(given, (tuple, list)):
                if len(given) != 2:
                    raise TypeError(f"{name}: a pair (t, {of[1]}) of arrays has two members, not {len(given)}")
                put(name, tuple(frozen(f"{name}: {each}", a) for each, a in zip(of, given)))
        if self.along is not None and self.ground is None:
            raise ValueError("along: without ground nothing moves along it")
        if not (self.ground is None or isinstance(self.ground, (str, tuple)) or callable(self.ground)):
            raise TypeError(f"ground: {described(self.ground)} is no text, no function of t and no pair (t, a) of arrays")

    def check_kind(self) -> None:
        """Masses and a potential, or a Lagrangian, or matrices."""
        instead = {"lagrangian": ("potential", "mass", "rho", "alpha", "order", "damping", "ground"),
                   "dampers": ("rho", "alpha", "order", "damping", "past"),
                   "M": ("potential", "mass", "rho", "lagrangian", "constraints", "impose", "force_on")}
        fields = {f.name: f.default for f in dataclasses.fields(self)}
        lists = ("dampers", "constraints", "impose", "force_on")
        given = {name for name, default in fields.items()
                 if (len(getattr(self, name)) if name in lists else not alike(getattr(self, name), default))}
        for one, others in instead.items():
            for other in others:
                if one in given and other in given:
                    raise ValueError(f"{one}: not together with {other}")
        if (self.M is None) != (self.K is None) or (self.C is not None and (self.M is None or "dampers" in given)):
            raise ValueError("M: M and K come together, and C with them or dampers")
        if self.lagrangian is not None:
            if not isinstance(self.lagrangian, str):
                raise TypeError(f"lagrangian: {described(self.lagrangian)} is no text")
            if self.p0 is None and self.v0 is None:
                raise ValueError("lagrangian: a start is missing: x0, and v0 or p0")

    @staticmethod
    def damper(given: Any) -> tuple:
        """(C, LAW) or (C, LAW, PAST) of a structure."""
        if not isinstance(given, (tuple, list)) or len(given) not in (2, 3):
            raise TypeError(f"dampers: {described(given)} is no triple (C, LAW, PAST)")
        of, *rest = given
        is_row = not hasattr(of, "tocsc") and not isinstance(of, tuple) and np.ndim(of) == 1
        return (frozen("dampers", of) if is_row else matrix("dampers", of), *rest)

    @property
    def kind(self) -> str:
        """ "structure", "mechanism" or "masses"."""
        if self.M is not None:
            return "structure"
        is_mechanism = (self.lagrangian is not None or len(self.dampers) or len(self.constraints) or len(self.impose)
                        or len(self.force_on) or not np.all(self.mass))
        return "mechanism" if is_mechanism else "masses"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Problem) and all(
            alike(getattr(self, field.name), getattr(other, field.name)) for field in dataclasses.fields(self))

    def __hash__(self) -> int:
        return hash((self.time, self.alpha, self.order, self.past,
                     self.potential if isinstance(self.potential, str) else None))

    def __setstate__(self, state: dict) -> None:
        def freeze(value: Any) -> None:
            for a in value if isinstance(value, tuple) else ():
                freeze(a)
            if isinstance(value, np.ndarray):
                value.flags.writeable = False
        for name, value in state.items():  # arrays come writeable out of a pickle
            freeze(value)
            object.__setattr__(self, name, value)

    def usual(self) -> dict:
        """What stands for fields that were not given, by their names: the start and the damping."""
        is_structure = self.kind == "structure"
        found = {"x0": 0.0 if is_structure else 1.0}
        if self.v0 is None:
            found["p0"] = 0.0 if is_structure else 0.5
        if self.damping is None and self.lagrangian is None and not len(self.dampers) and (not is_structure or self.C is not None):
            found |= ({} if is_structure else {"rho": 0.2}) | ({} if self.order is not None else {"alpha": 0.5})
        return found

    def __repr__(self) -> str:
        """All that was given, and of what was not the potential, the time, the start and the damping that hold then."""
        shown, usual = [], self.usual()
        for field in dataclasses.fields(self):
            value = getattr(self, field.name)
            if value is None and field.name in usual:
                value = usual[field.name]
            elif alike(value, field.default) and not (field.name == "time" or (field.name == "potential" and self.M is None
                                                                              and self.lagrangian is None)):
                continue
            shown.append(f"{field.name}={described(value)}")
        return f"Problem({', '.join(shown)})"

    def replace(self, **changes: Any) -> "Problem":
        """The same but for these fields. Of alpha and order, of p0 and v0, of a damping and rho with alpha, those
        that are given take the place of the others."""
        for one, others in (("alpha", ("order", "damping")), ("order", ("alpha", "damping")), ("rho", ("damping",)),
                            ("damping", ("alpha", "order", "rho")), ("p0", ("v0",)), ("v0", ("p0",))):
            if changes.get(one) is not None:
                for other in others:
                    changes.setdefault(other, None)
        if "ground" in changes and changes["ground"] is None:
            changes.setdefault("along", None)
        if len(changes.get("dampers", ())):
            for other in ("alpha", "order", "rho", "damping", "C"):
                changes.setdefault(other, None)
        return dataclasses.replace(self, **changes)


def alike(a: Any, b: Any) -> bool:
    """Equal, arrays and pairs of them included."""
    if isinstance(a, tuple) and isinstance(b, tuple):
        return len(a) == len(b) and all(map(alike, a, b))
    if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
        return np.shape(a) == np.shape(b) and bool(np.array_equal(a, b))
    return bool(a == b)


Problem.__init__ = spelt(hints=OTHERS, elsewhere={name: "fvi.solve" for name in NUMERIC})(Problem.__init__)  # type: ignore
# The library has them in one place.
Problem.__doc__ = f"{Problem.__doc__}\n" + textwrap.indent("What the words stand for:\n\n" + formulas(), "    ")
