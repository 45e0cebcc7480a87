"""What fvi raises, and what it warns of."""
from __future__ import annotations

from typing import Any, Optional


class Error(Exception):
    """The library returned a code. The text says why.

    code    its number (fvi/error.h), or what a compiled function of yours returned
    field   the argument that was refused, None if it is no single one
    value   the number that was refused, or None
    step    the number of the step that failed, or None
    time    of the last row before it, or None
    rows    a Solution of the rows before it, or None
    fit     what a fit found that is not to be believed, or None

    It pickles with all of that.
    """
    __module__ = "fvi.errors"

    def __init__(self, text: str = "", code: int = 0):
        super().__init__(text)
        self.code = code
        self.field: Optional[str] = None
        self.value: Optional[float] = None
        self.step: Optional[int] = None
        self.time: Optional[float] = None
        self.rows: Any = None
        self.fit: Any = None


class FviWarning(UserWarning):
    """The numbers are those of the method, but not those of a motion: what the program says
    with `fvi: warning:`, by warnings.warn."""


Warning = FviWarning  # its name in older programs
