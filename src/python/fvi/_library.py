"""Calls of the library: what a code, a warning and a function that raised become."""
from __future__ import annotations

import math
import os
import sys
import threading
import warnings
from typing import Any, Callable, Optional

from ._fvi import ffi, lib
from .errors import Error, FviWarning


# the codes of a step that failed
STOPPED = (lib.FVI_ERUNAWAY, lib.FVI_EOVRFLW, lib.FVI_EMAXITER, lib.FVI_ESING, lib.FVI_EBADFUNC)


def text_of(pointer: Any) -> str:
    return ffi.string(pointer).decode()


def own_code(code: int) -> str:
    """The number of a code that is none of the library's."""
    is_own = text_of(lib.fvi_error_name(code)) == text_of(lib.fvi_error_name(-1))  # which is never the library's
    return f", code {code}" if is_own else ""


def failure(code: int, where: str = "", said: Any = None) -> Error:
    """The exception for a code that the last call returned; said: the fvi_error of a run whose step may have failed."""
    why = said.text if said and said.code == code else lib.reason_of_code(code)
    words = text_of(lib.fvi_error_name(code) if why == ffi.NULL else why)
    return Error(words + own_code(code) + where, code)


IN_PYTHON = {"damper": "dampers", "constraint": "constraints", "force-on": "force_on", "event": "events", "law": "damping"}


def field_of(error: Any) -> Optional[str]:
    """The argument of which a fvi_error speaks, by its name in this package."""
    if error.field == ffi.NULL:
        return None
    field = text_of(error.field)
    return IN_PYTHON.get(field, field)


def error_of(error: Any, status: int) -> Error:
    """The exception for a code with the words of a fvi_error, its field, number and index."""
    found = Error(text_of(error.text) + own_code(status), status)
    found.field = field_of(error)
    found.value = None if math.isnan(error.value) else error.value
    if found.field is None and status in STOPPED:
        found.step = error.index
    return found


def warn(text: str) -> None:
    """Said of the line that called this package; of a sweep, when all motions are there."""
    if waiting.heard is not None:
        waiting.heard.append(text)
        return
    level, frame = 1, sys._getframe()
    while frame.f_back and frame.f_globals.get("__name__", "").partition(".")[0] == __name__.partition(".")[0]:
        level, frame = level + 1, frame.f_back
    warnings.warn(text, FviWarning, stacklevel=level)


class Waiting(threading.local):
    """What was raised while the library ran in this thread, until it has returned; and what a thread of a sweep was
    warned of."""
    raised: Optional[BaseException] = None
    heard: Optional[list] = None


waiting = Waiting()


def keep(kind: Any, error: BaseException, trace: Any) -> int:
    """Of all that is raised, the first; but an interrupt before all."""
    if waiting.raised is None or not isinstance(error, Exception):
        waiting.raised = error.with_traceback(trace)
    return -1


def is_interrupted() -> bool:
    """Then a search of many runs has to end, too."""
    return waiting.raised is not None and not isinstance(waiting.raised, Exception)


@ffi.def_extern(error=-1, onerror=keep)
def check_signals() -> int:
    """A run in the main thread calls this, but not twice in 25 ms: Python then sees Ctrl-C."""
    return 0


def ask(function: Callable[..., int], *arguments: Any) -> int:
    """The code that a function of the library returns; or what was raised meanwhile comes out."""
    outer, waiting.raised = waiting.raised, None
    lib.begin()
    try:
        status = function(*arguments)
    finally:
        raised, waiting.raised = waiting.raised, outer
    if raised is not None:
        lib.begin()
        try:
            raise raised
        finally:
            raised = None  # no circle of references
    return status


def succeed(status: int, where: str = "") -> None:
    if status:
        raise failure(status, where)


def understand(function: Callable[..., int], *arguments: Any) -> None:
    """A function of fvi/parse.h, whose last argument says what was wrong: text that is none of the library's
    is a ValueError, a number out of its range an Error, each with the library's words behind the field."""
    error = ffi.new("fvi_error *")
    status = function(*arguments, error)
    if not status:
        return
    field = f"{field_of(error)}: "
    words = field + text_of(error.text).replace("\n", "\n" + " " * len(field))
    if status == lib.FVI_ENOMEM:
        raise MemoryError(words)
    if status == lib.FVI_EINVAL:
        raise ValueError(words)
    found = error_of(error, status)
    found.args = (words,)
    raise found


def ask_for_warning(function: Callable[..., int], *arguments: Any) -> bool:
    """Was there something to warn of? It is what a function of fvi/warnings.h writes into its
    last argument. A function of the caller's that raises is the run's affair, which may never
    ask it."""
    text = ffi.new("char[]", lib.FVI_WARNING_ROOM)
    try:
        found = ask(function, *arguments, lib.FVI_WARNING_ROOM, text)
    except Exception:
        return False
    if found < 0:
        raise MemoryError(text_of(text))
    if found:
        warn(text_of(text))
    return bool(found)


def ask_for_constant_warning(function: Callable[..., int], *arguments: Any) -> None:
    """Likewise of a function whose last argument becomes a text of the library's own."""
    text = ffi.new("const char **")
    found = ask(function, *arguments, text)
    if found < 0:
        raise MemoryError(text_of(text[0]))
    if found:
        warn(text_of(text[0]))


def warn_of_memory(method: Any, run: Any) -> None:
    """Of a memory or a tolerance that the run does not read."""
    ask_for_warning(lib.fvi_warning_of_memory, method, run)


def warn_of_start(method: Any, run: Any) -> Any:
    """What the program says before the first step. Returns how to watch what comes after it."""
    warn_of_memory(method, run)
    if method.paper_convention:
        ask_for_constant_warning(lib.fvi_warning_of_initial_history, run)
    is_unstable = ask_for_warning(lib.fvi_warning_of_step, method, run)
    return ffi.new("fvi_watch *", lib.fvi_watch_begin(method, run, is_unstable))


def listen() -> None:
    lib.set_main_thread(threading.main_thread().ident)


listen()
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=listen)  # whose main thread may be another
