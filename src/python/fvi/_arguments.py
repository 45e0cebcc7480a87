"""What a user wrote, checked: each complaint begins with the name of the argument."""
from __future__ import annotations

import difflib
import functools
import inspect
from typing import Any, Callable, Iterable, Mapping, Sequence, TypeVar, Union, cast

import numpy as np

Array = np.ndarray
Numbers = Union[float, Sequence[float], Array]
F = TypeVar("F", bound=Callable[..., Any])


def described(given: Any) -> str:
    """As it was written, or what it is if that is long."""
    text = repr(given)
    return text if len(text) <= 40 and "\n" not in text else f"a {type(given).__name__}"


def spelt(*others: Callable, hints: Mapping[str, str] = {}, elsewhere: Mapping[str, str] = {}) -> Callable[[F], F]:
    """Of a function that hands keywords on to others: one that none of them knows is a TypeError, with the
    nearest that there is; hints has words that are known by another name, elsewhere those of other functions."""
    def decorate(function: F) -> F:
        all_of: tuple[Callable, ...] = (function, *others)
        known = list(dict.fromkeys(name for each in all_of  # several functions may have the same argument
                                   for name, p in inspect.signature(each).parameters.items()
                                   if p.kind in (p.POSITIONAL_OR_KEYWORD, p.KEYWORD_ONLY) and name != "self"))
        own = function.__qualname__.replace(".__init__", "")

        @functools.wraps(function)
        def checked(*arguments: Any, **options: Any) -> Any:
            for name in options:
                if name in known:
                    continue
                near = [hints[name]] if name in hints else difflib.get_close_matches(name.lower(), known, 1)
                raise TypeError(f"{own}: there is no argument '{name}'; " + (
                    f"{elsewhere[name]} takes it" if name in elsewhere else
                    f"did you mean '{near[0]}'?" if near else "there are " + ", ".join(known)))
            return function(*arguments, **options)
        return cast(F, checked)
    return decorate


def word(what: str, given: Any) -> str:
    if not isinstance(given, str):
        raise TypeError(f"{what}: {described(given)} is no text")
    return given


def nearest(given: str, known: Iterable[str]) -> str:
    """A question, if one of the words is like this one."""
    near = difflib.get_close_matches(given.lower(), list(known), 1)
    return f"; did you mean '{near[0]}'?" if near else ""


def choice(what: str, given: Any, known: dict) -> Any:
    if word(what, given) not in known:
        raise ValueError(f"{what}: '{given}' is none of " + ", ".join(known) + nearest(given, known))
    return known[given]


def number(what: str, given: Any) -> float:
    if isinstance(given, (str, bytes, bool, np.bool_)) or given is None:
        raise TypeError(f"{what}: {described(given)} is no number")
    try:
        return float(given)
    except (TypeError, ValueError, OverflowError) as error:
        raise TypeError(f"{what}: {described(given)} is no number") from error


def whole(what: str, given: Any, least: int) -> int:
    n = number(what, given)
    if not least <= n < 2**53 or n != int(n):
        raise ValueError(f"{what}: {given} is no whole number >= {least}")
    return int(n)


def numbers(what: str, given: Any) -> Array:
    """An array of doubles, of whatever shape was given."""
    try:
        raw = np.asarray(given)
        if raw.dtype.kind in "iuf":
            return np.array(raw, dtype=float)
        if raw.dtype.kind == "O":  # fractions, say
            return np.array([number(what, each) for each in raw.flat]).reshape(raw.shape)
    except ValueError as error:
        raise ValueError(f"{what}: {error}") from error
    raise TypeError(f"{what}: {described(given)} is no number and no list of numbers")


def names(what: str, given: Any) -> list:
    """One name or several."""
    found = [given] if isinstance(given, str) else given
    if not isinstance(found, (list, tuple, set, frozenset)) or not all(isinstance(each, str) for each in found):
        raise TypeError(f"{what}: {described(given)} is no name and no list of names")
    if not found:
        raise ValueError(f"{what}: there is no name")
    return list(found)


def lines_of_answer(estimate: Mapping[str, float], interval: Mapping[str, tuple], last: str) -> str:
    """What was found, a line for each name."""
    width = max(map(len, estimate))
    lines = [f"{name:{width}} = {value:.6g}, with 95 % between {interval[name][0]:.6g} and {interval[name][1]:.6g}"
             for name, value in estimate.items()]
    return "\n".join([*lines, last])


def function(what: str, given: Any, of: str) -> Any:
    if not callable(given):
        raise TypeError(f"{what}: {described(given)} is no function {of}")
    return given


def check_rows(what: str, name: str, t: Array, F: Array, last: float) -> None:
    """Rows of a table that is asked for from 0 to the end."""
    if not (np.isfinite(t).all() and np.isfinite(F).all() and (np.diff(t) > 0).all()):
        raise ValueError(f"{what}: t must increase, and t and {name} must be finite")
    if t[0] > 0 or t[-1] < last * (1 - 1e-12):
        raise ValueError(f"{what}: it is known from {t[0]:g} to {t[-1]:g}, and the motion lasts from 0 to {last:g}")


def row(what: str, given: Array, d: int) -> Array:
    """d numbers, of one for all or of d."""
    if given.shape not in ((), (1,), (d,)):
        raise ValueError(f"{what} has the shape {given.shape}, not ({d},)")
    return np.ascontiguousarray(np.broadcast_to(given, (d,)))
