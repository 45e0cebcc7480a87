"""Systems that are more than masses and a potential: mechanisms, which are texts, and structures, which are matrices."""
from __future__ import annotations

from typing import Any, NamedTuple, Optional, Sequence

import numpy as np

from ._arguments import Array, check_rows, choice, described, numbers
from ._fvi import ffi, lib
from ._library import error_of, failure, is_interrupted, keep, succeed, understand
from ._system import law


def texts(what: str, given: Any) -> tuple:
    """A text or several."""
    found = (given,) if isinstance(given, str) else tuple(given)
    for each in found:
        if not isinstance(each, str):
            raise TypeError(f"{what}: {described(each)} is no text")
    return found


class Place:
    """A coordinate that a function of t prescribes."""

    def __init__(self, name: str, function: Any):
        self.name, self.function = name, function


@ffi.def_extern(error=-1, onerror=keep)
def ask_imposed(t, function, u, rate):
    if is_interrupted():
        return -1
    of = ffi.from_handle(function)
    given = of.function(t)
    try:
        u[0], rate[0] = given
    except (TypeError, ValueError, OverflowError) as error:
        raise TypeError(f"impose: {of.name} gave {described(given)}, not a place and a velocity") from error
    return 0


LOOKS, NEAR = 9, 1e-6  # so often is a velocity compared with differences of the places, and over such a part of the motion


def is_number(given: Any) -> bool:
    return isinstance(given, (int, float, np.number)) and not isinstance(given, bool)


def check_velocity(name: str, function: Any, last: float) -> None:
    """Is the velocity that a function gives that of its places? Where it differs from their differences at most of
    some times, by more than these differ from each other, it is not."""
    wrong, near = [], NEAR * last
    for k in range(LOOKS):
        t = last * (NEAR + (0.05 + 0.618034 * k) % 1 * (1 - 2 * NEAR))
        told = [function(at) for at in (t, t - near, t + near, t - near / 2, t + near / 2)]
        if not all(isinstance(one, (tuple, list)) and len(one) == 2 and all(map(is_number, one)) for one in told):
            return  # the run says what is wrong
        rate, u = float(told[0][1]), [float(one[0]) for one in told]
        coarse, fine = (u[2] - u[1]) / (2 * near), (u[4] - u[3]) / near
        allowed = 1e-4 * (abs(rate) + abs(fine)) + 10 * abs(fine - coarse) + 1e-14 * max(map(abs, u)) / near
        if abs(rate - fine) > allowed:
            wrong.append((t, rate, fine))
    if len(wrong) > LOOKS // 2:
        t, rate, fine = wrong[0]
        raise ValueError(f"impose: {name}: at t = {t:.6g} the function gives the velocity {rate:.6g}, and its places change "
                         f"with {fine:.6g}")


class Imposed:
    """The coordinates that rows prescribe, whose velocities are those of cubics."""

    def __init__(self, own: Any):
        self.own, self.rows = own, []  # type: Any, list

    def add(self, i: int, name: str, t: Array, x: Array) -> None:
        self.rows.append((i, int(name.strip()[1:] or 1) - 1, t, x))

    def velocities(self, v0: Array) -> Array:
        """v0 with the velocity of the cubics where what is given is no farther from that than the slope of the parabola
        through the first three rows: the rows do not know it better."""
        found, u, rate = v0.copy(), ffi.new("double *"), ffi.new("double *")
        for i, on, t, x in self.rows:
            lib.imposed_places_at(self.own, i, 0.0, u, rate)
            one, two = np.diff(x[:3]) / np.diff(t[:3])
            parabola = one - (two - one) / (t[2] - t[0]) * (t[1] - t[0])
            if abs(v0[on] - rate[0]) <= abs(parabola - rate[0]) + 1e-9 * abs(rate[0]):
                found[on] = rate[0]
        return found


class Mechanism:
    """A Lagrangian, dampers between points, constraints, imposed motions and forces of velocity; without dampers each
    coordinate is damped by itself."""

    def __init__(self, lagrangian: Optional[str], dampers: Sequence[str], constraints: Sequence[str],
                 impose: Sequence, force_on: Sequence[str], own: Any = None):
        texts = [each if isinstance(each, str) else f"{each[0]}=0" for each in impose]
        self.lists = {"damper": dampers, "constraint": constraints, "impose": texts, "force_on": force_on}
        self.places = [(len(constraints) + i, *each) for i, each in enumerate(impose) if not isinstance(each, str)]
        self.lagrangian, self.own = lagrangian, own

    def dimension(self, potential: Any) -> int:
        """The largest index in a text."""
        said = [self.lagrangian, potential if self.lagrangian is None else None,
                *(text for each in self.lists.values() for text in each)]
        found = [lib.fvi_largest_index(text.encode()) for text in said if isinstance(text, str)
                 and not text.lower().startswith("chain")]
        on = [text.partition("=")[0].strip(" x") for text in self.lists["force_on"]]
        return max([1, *found, *(int(i) for i in on if i.isdigit() and int(i) <= 10000)])

    def put(self, s: Any) -> None:
        """Onto a System, whose numbers are known."""
        dampers = list(self.lists["damper"])
        if not dampers and self.lagrangian is None and self.own is not None:
            rho = np.frombuffer(ffi.buffer(s.system.damping, 8 * s.d))
            dampers = [f"x{i + 1} : {self.own(float(rho[i]))}" for i in range(s.d) if rho[i] > 0]
        s.system.damping = s.pointer(np.zeros(s.d))
        t = ffi.new("fvi_mechanism_texts *")
        if self.lagrangian is not None:
            s.keep.append(ffi.new("char[]", self.lagrangian.encode()))
            t.lagrangian = s.keep[-1]
            s.constants, s.names = s.values, list(s.let)
        for name, count, given in (("damper", "dampers", dampers), ("constraint", "constraints", self.lists["constraint"]),
                                   ("impose", "imposed", self.lists["impose"]),
                                   ("force_on", "forces_on", self.lists["force_on"])):
            each = [ffi.new("char[]", text.encode()) for text in given]
            all_of = ffi.new("char *[]", each or [ffi.NULL])
            s.keep += [each, all_of]
            setattr(t, name, all_of)
            setattr(t, count, len(each))
        out = ffi.new("fvi_typed_mechanism **")
        understand(lib.fvi_parse_mechanism, t, s.d, s.parameters, out)
        s.keep.append(ffi.gc(out[0], lib.fvi_typed_mechanism_free))
        s.system.mechanism, s.typed_mechanism = lib.fvi_mechanism_typed(out[0]), out[0]
        if self.places:
            self.put_places(s)

    def put_places(self, s: Any) -> None:
        """What functions and rows impose, in the places of texts that impose 0."""
        told = [*self.lists["constraint"], *self.lists["impose"]]
        for at, name, _ in self.places:
            told[at] = name
        names = [ffi.new("char[]", each.encode()) for each in told]
        list_of = ffi.new("char *[]", names)
        made = ffi.gc(lib.imposed_places_alloc(s.system.mechanism, list_of, len(self.places)), lib.imposed_places_free)
        if made == ffi.NULL:
            raise MemoryError("impose")
        s.keep += [names, list_of, made]
        s.imposed = Imposed(made)
        for i, (at, name, given) in enumerate(self.places):
            if callable(given):
                check_velocity(name, given, s.last)
                s.keep.append(ffi.new_handle(Place(name, given)))
                succeed(lib.imposed_places_put(made, i, at, s.keep[-1], 0, ffi.NULL, ffi.NULL))
                continue
            t, x = (np.ascontiguousarray(numbers(f"impose: {name}", a)) for a in given)
            if t.ndim != 1 or t.size < 4 or x.shape != t.shape:
                raise ValueError(f"impose: {name}: t and x have the shapes {t.shape} and {x.shape}, not (n,) with n >= 4")
            check_rows(f"impose: {name}", "x", t, x, s.last)
            succeed(lib.imposed_places_put(made, i, at, ffi.NULL, t.size, s.pointer(t), s.pointer(x)))
            s.imposed.add(i, name, t, x)
        s.system.mechanism = lib.imposed_places_mechanism(made)


class Matrix(NamedTuple):
    """A symmetric matrix in compressed columns."""
    n: int
    start: Array
    row: Array
    entry: Array


def matrix(what: str, given: Any) -> Matrix:
    """Of a matrix of scipy.sparse, or of an array (n, n)."""
    if isinstance(given, Matrix):
        return given
    if hasattr(given, "tocsc"):
        a = given.tocsc().copy()
        a.sum_duplicates()  # which sorts the rows, too
        if a.shape[0] != a.shape[1]:
            raise ValueError(f"{what}: the shape {a.shape} is not square")
        parts = (a.indptr, a.indices, a.data)
    else:
        dense = numbers(what, given)
        if dense.ndim != 2 or dense.shape[0] != dense.shape[1] or dense.shape[0] == 0:
            raise ValueError(f"{what}: the shape {dense.shape} is not (n, n)")
        column, row = np.nonzero(dense.T)
        parts = (np.append(0, np.cumsum(np.count_nonzero(dense, axis=0))), row, dense.T[column, row])
        a = dense
    found = Matrix(a.shape[0], *(np.array(part, kind) for part, kind in zip(parts, (np.int32, np.int32, float))))
    for part in found[1:]:
        part.flags.writeable = False
    return found


class Structure:
    """M, K and C, or dampers of matrices and rows."""

    def __init__(self, M: Matrix, K: Matrix, C: Optional[Matrix], dampers: Sequence[tuple], pasts: dict):
        self.M, self.K, self.C, self.dampers, self.n, self.pasts = M, K, C, dampers, M.n, pasts

    def sparse(self, s: Any, a: Matrix) -> Any:
        s.keep.append(a)
        s.keep.append(ffi.new("fvi_sparse *", {
            "n": a.n, "start": ffi.cast("int *", a.start.ctypes.data), "row": ffi.cast("int *", a.row.ctypes.data),
            "entry": ffi.cast("double *", a.entry.ctypes.data)}))
        return s.keep[-1]

    def damper(self, s: Any, to: Any, given: tuple) -> None:
        of, kernel, past = (*given, "held")[:3]
        s.keep.append(law(kernel, s.parameters))
        s.laws_of_dampers.append(ffi.addressof(s.keep[-1][0], "law"))
        to.kernel, to.past = s.laws_of_dampers[-1], choice("dampers: past", past, self.pasts)
        if isinstance(of, Matrix):
            to.matrix = self.sparse(s, of)
        else:
            to.of.row = s.pointer(of)

    def put(self, s: Any) -> None:
        M, K = self.sparse(s, self.M), self.sparse(s, self.K)
        out, fault, error = ffi.new("fvi_structure **"), ffi.new("char *"), ffi.new("fvi_error *")
        if self.dampers:
            dampers = ffi.new("fvi_damper[]", len(self.dampers))
            s.keep.append(dampers)
            for to, given in zip(dampers, self.dampers):
                self.damper(s, to, given)
            status = lib.fvi_structure_alloc_dampers(M, K, len(self.dampers), dampers, out, error)
            if status:
                found = error_of(error, status)
                found.args = (f"{found.field}: {found.args[0]}" if found.field else found.args[0],)
                raise found
        else:
            C = ffi.NULL if self.C is None else self.sparse(s, self.C)
            status = lib.fvi_structure_alloc(M, K, C, out, fault)
            if status:
                found = failure(status)
                found.field = fault[0].decode() if fault[0] != b"\0" else None
                found.args = (f"{found.field}: {found.args[0]}" if found.field else found.args[0],)
                raise found
        structure = ffi.gc(out[0], lib.fvi_structure_free)
        s.keep.append(structure)
        force = ffi.new("fvi_force *", s.system.force)  # a copy
        s.system[0] = lib.fvi_structure_system(structure)
        s.system.force = force[0]
        s.structure = structure


def own_law(alpha: float, damping: Any, past: str) -> Any:
    """The damper of one coordinate, as a text of its rho."""
    if damping is None:
        return lambda rho: f"power:{rho!r},{alpha!r} : {past}"
    if not isinstance(damping, str):
        raise ValueError("damping: with a mechanism it is one text")
    return lambda rho: f"{damping} : {past}"
