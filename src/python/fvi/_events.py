"""Events of a motion: marks, stops, impacts, contacts."""
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Callable, Optional, Sequence, Union

import numpy as np

from ._arguments import Array, described, function, number, spelt, word
from ._fvi import ffi, lib
from ._library import keep, understand
from ._system import Asked


@dataclass(frozen=True)
class Event:
    """What is watched along a motion: when a number z passes 0.

        floor = fvi.Event("x", "impact:0.8")
        lowest = fvi.Event("v", "mark", direction=1)
        near = fvi.Event(lambda t, x, p: x - 0.1, "stop")

    value      z: an expression in x, v, p and t, or in x1, ..., v1, ..., p1, ..., t; or a function z(t, x, p). x and p are
               arrays of d numbers, or numbers where the start is one. z of an impact knows x and t alone
    action     "mark", the time is noted; "stop", the motion ends; "impact:E", the momentum jumps along the normal dz/dx, and
               the speed with which z changes is then -E times what it was, 0 <= E <= 1. A body that comes to rest there ends
               the motion before `time`: see `message`, and len(t) for the rows that there are. "contact:E", an impact, but a
               body that comes to rest stays on the surface and may slide along it, until a force pulls it off: the time of
               that is noted, too
    gradient   of an impact or a contact whose z is a function: a function of (t, x) that gives dz/dx, d numbers, and dz/dt
    direction  1: z must rise through 0; -1: fall; 0: either
    rest       of an impact or a contact: a body that would rise no higher than this is at rest, a length of x; 0: what a
               step may be off by, or the `error` of `solve`
    """
    value: Union[str, Callable[..., float]]
    action: str = "mark"
    gradient: Optional[Callable[..., tuple]] = None
    direction: int = 0
    rest: float = 0.0

    def __post_init__(self) -> None:
        word("events: action", self.action)
        if not (isinstance(self.value, str) or callable(self.value)):
            raise TypeError(f"events: {described(self.value)} is no text and no function of t, x, p")
        if isinstance(self.direction, bool) or self.direction not in (-1, 0, 1):
            raise ValueError(f"events: direction: {described(self.direction)} is none of -1, 0, 1")
        if self.gradient is not None and isinstance(self.value, str):
            raise ValueError("events: gradient: a text has its own")
        if not 0 <= number("events: rest", self.rest) < math.inf:
            raise ValueError(f"events: rest: {self.rest} is not in [0, inf)")
        if self.gradient is not None:
            function("events: gradient", self.gradient, "of t and x")

    @property
    def text(self) -> str:
        """As the library reads it; of a function the action alone is read."""
        return f"{self.value if isinstance(self.value, str) else 'x1'} : {self.action}"

    @property
    def is_contact(self) -> bool:
        return self.action.partition(":")[0].strip() == "contact"

    @property
    def name(self) -> str:
        return self.value.strip() if isinstance(self.value, str) else getattr(self.value, "__name__", "a function")


Event.__init__ = spelt()(Event.__init__)  # type: ignore


def listed(given: Any) -> tuple:
    """One text or event, or several."""
    each = (given,) if isinstance(given, (str, Event)) else given
    if not isinstance(each, (list, tuple)):
        raise TypeError(f"events: {described(given)} is no text, no fvi.Event and no list of such")
    return tuple(event_of(one) for one in each)


def event_of(given: Any) -> Event:
    if isinstance(given, Event):
        return given
    if not isinstance(given, str):
        raise TypeError(f"events: {described(given)} is no text 'Z : WHAT' and no fvi.Event")
    value, colon, action = given.rpartition(" : ")
    if not colon:
        raise ValueError(f"events: '{given}' is not 'Z : WHAT', with blanks around the colon")
    return Event(value, action.strip())


class Watched:
    """An event that is a function, as the library asks it."""

    def __init__(self, event: Event, scalar: bool):
        self.event, self.asked = event, Asked(None, None, scalar)


@ffi.def_extern(error=-1, onerror=keep)
def ask_event(t, d, x, p, params, z):
    watched = ffi.from_handle(params)
    asked = watched.asked
    given = watched.event.value(t, asked.at(x, d), asked.at(p, d))
    try:
        z[0] = given
    except (TypeError, OverflowError) as error:
        raise TypeError(f"events: {watched.event.name} gave {described(given)}, not a number") from error
    return 0


@ffi.def_extern(error=-1, onerror=keep)
def ask_normal(t, d, x, params, normal, rate):
    watched = ffi.from_handle(params)
    given = watched.event.gradient(t, watched.asked.at(x, d))
    if not (isinstance(given, tuple) and len(given) == 2):
        raise TypeError(f"events: gradient gave {described(given)}, not dz/dx and dz/dt")
    watched.asked.answer("events: gradient", normal, (d,), given[0])
    rate[0] = given[1]
    return 0


class Events:
    """Those of a motion, for a System, which keeps what C points to."""

    def __init__(self, events: Sequence[Event]):
        self.events = events

    def put(self, s: Any) -> None:
        texts = [ffi.new("char[]", event.text.encode()) for event in self.events]
        out, count = ffi.new("fvi_typed_events **"), ffi.new("size_t *")
        mass = s.pointer(np.ones(s.d)) if s.system.mass == ffi.NULL else s.system.mass  # NULL: of matrices
        understand(lib.fvi_parse_events, len(texts), ffi.new("char *[]", texts), s.d, mass, s.parameters, out)
        typed = ffi.gc(out[0], lib.fvi_typed_events_free)
        lib.fvi_typed_events_of(typed, s.system.mechanism)
        s.events = ffi.new("fvi_event[]", ffi.unpack(lib.fvi_events_typed(typed, count), len(texts)))
        s.keep.append(typed)
        for event, to in zip(self.events, s.events):
            to.direction, to.rest = event.direction, event.rest
            if isinstance(event.value, str):
                continue
            s.keep.append(ffi.new_handle(Watched(event, s.scalar)))
            to.value, to.params, to.gradient, to.hessian = lib.ask_event, s.keep[-1], ffi.NULL, ffi.NULL
            if event.gradient is not None:
                to.gradient = lib.ask_normal


@ffi.def_extern(error=-1, onerror=keep)
def report_event(at: Any, x: Any, p: Any, happened: Any) -> int:
    ffi.from_handle(happened).add(at, x, p)
    return 0


STATUS = "<U9"  # room for "lifts off"


class Happened:
    """What has happened along a motion: of each event its times, x and p there, behind its impact, and its status."""

    def __init__(self, events: Sequence[Event], d: int):
        self.events, self.d = events, d
        self.rows: list = [[] for _ in events]

    def note(self, stepper: Any, known: int) -> int:
        """Those behind the first `known`; how many there are."""
        count = ffi.new("size_t *")
        at = lib.fvi_stepper_events(stepper, count)
        for i in range(known, count[0]):
            self.add(at[i], stepper.x, stepper.p)
        return count[0]

    def add(self, at: Any, x: Any, p: Any) -> None:
        """One more fvi_event_time, with its place and momentum as C has them."""
        self.rows[at.event].append((at.t, *(np.frombuffer(ffi.buffer(a, 8 * self.d)).copy() for a in (x, p)),
                                    "lifts off" if at.lifts_off else "at rest" if at.at_rest else ""))

    @property
    def end(self) -> str:
        """In words, which event has ended the motion, and where a body is at rest at its end."""
        said = []
        for event, rows in zip(self.events, self.rows):
            t, _, _, status = rows[-1] if rows else (0.0, None, None, "")
            if status == "at rest":
                said.append((t, f"at rest at '{event.name}' from t = {t:.6g}"))
            elif rows and event.action.strip() == "stop":
                said.append((t, f"ended by '{event.name}' at t = {t:.6g}"))
        return ", ".join(text for _, text in sorted(said))

    def flat(self) -> dict:
        """For a file: which event each of all rows is of, and these rows."""
        which = [i for i, rows in enumerate(self.rows) for _ in rows]
        rows = [row for each in self.rows for row in each]
        return {"event": np.array(which, dtype=int), "event_t": np.array([row[0] for row in rows]),
                "event_status": np.array([row[3] for row in rows], dtype=STATUS),
                **{name: np.array([row[k] for row in rows]).reshape(-1, self.d) for k, name in ((1, "event_x"), (2, "event_p"))}}

    def put(self, flat: dict) -> int:
        """From such a file; how many there are."""
        for i, t, x, p, status in zip(*(flat[name] for name in ("event", "event_t", "event_x", "event_p", "event_status"))):
            self.rows[i].append((float(t), x.copy(), p.copy(), str(status)))
        return len(flat["event"])

    def arrays(self) -> tuple:
        """t, x, p and the status: of each event an array."""
        return tuple([np.array([row[i] for row in rows], dtype=STATUS if i == 3 else float).reshape(
            (-1,) + (() if i in (0, 3) else (self.d,))) for rows in self.rows] for i in range(4))
