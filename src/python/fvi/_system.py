"""From what a user writes to the library's structs: potentials, forces, starts."""
from __future__ import annotations

import math
import numbers
from collections.abc import Mapping
from typing import Any, Callable, Optional, Sequence, Union

import numpy as np

from . import _arguments as arguments
from ._arguments import Array, Numbers
from ._fvi import ffi, lib
from ._library import is_interrupted, keep, text_of, understand

Law = Union[None, str, Sequence[str], Callable[[complex], complex]]


def formulas() -> str:
    size = lib.fvi_formulas_write(0, ffi.NULL) + 1
    text = ffi.new("char[]", size)
    lib.fvi_formulas_write(size, text)
    return text_of(text)


formulas.__doc__ = "What each word of a problem stands for, as a text.\n\n" + formulas()


class Potential:
    """U: R^d -> R with its gradient and Hessian; made by `potential`."""

    def __init__(self, value: Any, gradient: Any, hessian: Any, quadratic: bool, diagonals: int):
        self.value, self.gradient, self.hessian = value, gradient, hessian
        self.quadratic, self.diagonals = quadratic, diagonals


@arguments.spelt()
def potential(value: Any, gradient: Any, hessian: Any, *, quadratic: bool = False,
              diagonals: int = 0) -> Potential:
    """A potential of your own.

    value, gradient, hessian
        Three functions of x: U, a number; the d numbers dU/dx_i; the Hessian, d x d numbers,
        or as `diagonals` says. x is an array of d numbers, a copy that the function may keep;
        where the start is one number, x is one, too, and all three give a number.
        Or the addresses of three compiled functions, as integers (numba's
        ``cfunc(...).address``): each is the C function
        ``int f(size_t d, const double *x, void *, double *out)`` that returns 0; they
        cost no more than the library's own.
    quadratic
        True promises that U is quadratic: its Hessian is then asked for once.
    diagonals
        0: the Hessian is full. K > 0: only the main diagonal and K - 1 on either side are
        not zero, and hessian gives an array (d, K) with d^2U/dx_i dx_{i+k} at [i, k].

    What a function of Python's raises ends the run and comes out of it.
    """
    if not isinstance(quadratic, bool):
        raise TypeError(f"quadratic: {arguments.described(quadratic)} is neither True nor False")
    given = (value, gradient, hessian)
    if not (all(callable(f) for f in given) or all(isinstance(f, numbers.Integral) for f in given)):
        raise TypeError("value, gradient and hessian are three functions, or three addresses")
    return Potential(value, gradient, hessian, bool(quadratic), arguments.whole("diagonals", diagonals, 0))


class Asked:
    """The functions of one run; `what` the force is, a force or the acceleration of the ground."""

    def __init__(self, U: Optional[Potential], F: Optional[Callable[[float], Numbers]], scalar: bool,
                 what: str = "force"):
        self.U, self.F, self.scalar, self.what = U, F, scalar, what
        self.views: dict = {}  # the library asks with the same few arrays again and again

    def view(self, pointer: Any, n: int) -> Array:
        """n doubles of the library's as an array, which is theirs and goes with them."""
        where = (int(ffi.cast("uintptr_t", pointer)), n)
        view = self.views.get(where)
        if view is None:
            if len(self.views) > 64:
                self.views.clear()  # another thread may look here, too
            self.views[where] = view = np.frombuffer(ffi.buffer(pointer, 8 * n))
        return view

    def at(self, x: Any, d: int) -> Any:
        """x as the functions take it: a number, or an array of their own."""
        return x[0] if self.scalar else self.view(x, d).copy()

    def answer(self, what: str, out: Any, shape: tuple, given: Any) -> int:
        """What a function gave, into the library's array."""
        if self.scalar:
            try:
                out[0] = given
            except (TypeError, OverflowError) as error:
                raise TypeError(f"{what} gave {arguments.described(given)}, not a number") from error
            return 0
        if given is None:
            raise TypeError(f"{what} gave None, not numbers")
        given, n = np.asarray(given, dtype=float), math.prod(shape)
        if given.size != n and (given.ndim or len(shape) > 1 and shape[1] > 1):
            raise ValueError(f"{what} gave {given.size} numbers, not {n}")
        if given.ndim > 1 and len(shape) > 1 and given.shape != shape:
            raise ValueError(f"{what} gave an array {given.shape}, not {shape}")
        self.view(out, n)[:] = given.reshape(-1)  # a single number goes everywhere but in a matrix
        return 0


@ffi.def_extern(error=-1, onerror=keep)
def ask_value(d, x, params, value):
    asked = ffi.from_handle(params)
    return -1 if is_interrupted() else asked.answer("value", value, (1,), asked.U.value(asked.at(x, d)))


@ffi.def_extern(error=-1, onerror=keep)
def ask_gradient(d, x, params, grad):
    asked = ffi.from_handle(params)
    return -1 if is_interrupted() else asked.answer("gradient", grad, (d,), asked.U.gradient(asked.at(x, d)))


@ffi.def_extern(error=-1, onerror=keep)
def ask_hessian(d, x, params, H):
    asked = ffi.from_handle(params)
    return -1 if is_interrupted() else asked.answer("hessian", H, (d, asked.U.diagonals or d),
                                                    asked.U.hessian(asked.at(x, d)))


@ffi.def_extern(error=-1, onerror=keep)
def ask_force(t, d, params, F):
    asked = ffi.from_handle(params)
    return -1 if is_interrupted() else asked.answer(asked.what, F, (d,), asked.F(t))


@ffi.def_extern(error=0)
def ask_quadratic(params):
    return 1


KINDS = {lib.FVI_POTENTIAL_HARMONIC: ["c"], lib.FVI_POTENTIAL_DUFFING: ["c", "g"],
         lib.FVI_POTENTIAL_PENDULUM: ["g"], lib.FVI_POTENTIAL_CHAIN: ["c", "g"]}  # names of their constants


def keep_of_void(kind: Any, error: BaseException, trace: Any) -> None:
    keep(kind, error, trace)


@ffi.def_extern(onerror=keep_of_void)
def ask_symbol(re, im, params, C_re, C_im):
    given = ffi.from_handle(params)(complex(re, im))
    try:
        C = complex(given)
    except (TypeError, ValueError, OverflowError) as error:
        raise TypeError(f"damping gave {arguments.described(given)}, not a number") from error
    C_re[0], C_im[0] = C.real, C.imag


def law(given: Any, parameters: Any = ffi.NULL) -> tuple:
    """What a function C(s), or the terms "zener:1,0.3,2", a text or several, have become, and what they point to."""
    damping = ffi.gc(ffi.new("fvi_typed_damping *"), lib.fvi_typed_damping_free)
    if callable(given):
        kept = ffi.new_handle(given)
        damping.function.value, damping.function.params = lib.ask_symbol, kept
        damping.function.term.kind, damping.function.term.rho = lib.FVI_KERNEL_SYMBOL, 1.0
        damping.law = lib.fvi_kernel_of_function(ffi.addressof(damping, "function"))
        return damping, kept
    if not isinstance(given, str) and not (isinstance(given, (list, tuple))
                                           and all(isinstance(each, str) for each in given)):
        raise TypeError(f"damping: {arguments.described(given)} is no text, no list of texts and no function of s")
    for text in [given] if isinstance(given, str) else given:
        understand(lib.fvi_parse_damping, text.encode(), parameters, damping)
    return damping, parameters


FIELDS_OF_LAW = ("terms", "orders", "times", "ends")  # of fvi_sensitivities, in the order of the numbers of a term


def numbers_of_laws(laws: Sequence, is_dense: bool) -> list:
    """By which fields laws have derivatives: on steps of any length by the factor of one term."""
    if is_dense:
        return ["terms"] if sum(law.count for law in laws) == 1 else []
    return list(FIELDS_OF_LAW)


def names_of_term(term: Any) -> dict:
    """The names of the numbers of a term, as in a fit, by the fields of their derivatives."""
    if term.kind == lib.FVI_KERNEL_SYMBOL:
        return {"terms": "rho"}
    power = term.kind == lib.FVI_KERNEL_POWER  # a spring and a dashpot have an order, too
    kind = lib.FVI_ELEMENT_POWER if power else lib.fvi_element_of(ffi.addressof(term))
    names, field = {}, ffi.new("size_t *")
    while (name := lib.fvi_element_number(kind, len(names), field)) != ffi.NULL:
        names[FIELDS_OF_LAW[field[0]]] = text_of(name)
    return names


def by_term(term: Any, by: dict, is_exchanged: bool) -> dict:
    """The derivatives of one term by the names of its numbers; those of two springpots in series are named as in a fit."""
    if term.kind == lib.FVI_KERNEL_MAXWELL2 and "times" in by and term.rho > 0:
        part = term.time / term.rho  # 1 over rho2
        parts = [(by["terms"] + part * by["times"], by["orders"]), (-term.time * part * by["times"], by["ends"])]
        (rho1, alpha1), (rho2, alpha2) = reversed(parts) if is_exchanged else parts
        return {"rho1": float(rho1), "alpha1": float(alpha1), "rho2": float(rho2), "alpha2": float(alpha2)}
    if term.kind == lib.FVI_KERNEL_MAXWELL2:  # rho of the kernel alone is no number of it
        return {}
    return {name: float(by[f]) for f, name in names_of_term(term).items() if f in by}


def by_law(law: Any, found: dict, parameters: Any, first: int = 0, terms: int = 0) -> list:
    """A dict for each term of a law, whose numbers begin at `first` of those of all terms; the law was parsed with
    `parameters`."""
    return [by_term(law.term[i], {f: v[first + i] for f, v in found.items()},
                    bool(lib.fvi_pair_is_exchanged(parameters, first + i, terms or law.count))) for i in range(law.count)]


def typed_force(text: str, d: int, parameters: Any, last: float) -> Any:
    out = ffi.new("fvi_typed_force **")
    understand(lib.fvi_parse_force, text.encode(), d, parameters, last, out)
    return ffi.gc(out[0], lib.fvi_typed_force_free)


class System:
    """A system and its start as the library wants them. Whatever C points to is kept here."""

    def __init__(self, potential: Union[str, Potential], force: Any, mass: Numbers, rho: Numbers,
                 x0: Numbers, p0: Numbers, let: Optional[Mapping[str, float]] = None, last: float = math.inf,
                 damping: Any = None, mechanism: Any = None, structure: Any = None, ground: Any = None,
                 along: Optional[Numbers] = None, events: Any = None, start: str = "p0"):
        self.keep: list = []
        self.failure = ffi.new("fvi_error *")  # of a step that fails; the runs keep the pointer
        self.laws_of_dampers: list = []
        if let is not None and not (isinstance(let, Mapping) and all(isinstance(name, str) for name in let)):
            raise TypeError(f"let: {arguments.described(let)} is no dict of names and numbers")
        self.let = {name: arguments.number(f"let: {name}", value) for name, value in (let or {}).items()}
        self.parameters = ffi.new("fvi_user_parameters *")
        for name, value in self.let.items():
            understand(lib.fvi_user_parameters_set, self.parameters, name.encode(), value)
        self.values = np.frombuffer(ffi.buffer(self.parameters.value, 8 * max(1, len(self.let))))
        self.last = last
        self.typed_force: Any = None
        self.texts = {"force": force, "ground": ground}
        self.typed_potential: Any = None
        self.typed_mechanism: Any = None
        self.constants: Optional[Array] = None  # of the potential, by names
        self.names: list = []
        rows = {name: arguments.numbers(name, given)
                for name, given in (("mass", mass), ("rho", rho), ("x0", x0), ("p0", p0))}
        self.scalar = rows["x0"].ndim == 0 and rows["p0"].ndim == 0
        self.d = max(a.size for a in rows.values())
        if mechanism is not None:
            self.d = max(self.d, mechanism.dimension(potential))
        if structure is not None:
            self.d = structure.n
        U = ffi.new("fvi_potential *")[0] if structure is not None else self.potential(potential)
        self.scalar &= self.d == 1
        self.asked = Asked(potential if isinstance(potential, Potential) else None,
                           force if callable(force) else None, self.scalar)
        self.handle = ffi.new_handle(self.asked)
        if isinstance(potential, Potential) and callable(potential.value):
            U.params = self.handle
        self.x0, self.p0 = (arguments.row(told, rows[name], self.d) for name, told in (("x0", "x0"), ("p0", start)))
        self.imposed: Any = None  # what functions and rows prescribe
        self.system = ffi.new("fvi_system *")
        self.system.d = self.d
        self.system.mass = self.pointer(arguments.row("mass", rows["mass"], self.d))
        self.system.damping = self.pointer(arguments.row("rho", rows["rho"], self.d))
        self.system.potential = U
        self.system.force = self.force(force)
        self.law = ffi.NULL
        if damping is not None and mechanism is None:
            self.keep.append(law(damping, self.parameters))
            self.law = ffi.addressof(self.keep[-1][0], "law")
        if structure is not None:
            structure.put(self)
        if mechanism is not None:
            mechanism.put(self)
        self.ground: Any = None
        if ground is not None:
            self.put_ground(ground, 1.0 if along is None else along)
        self.events: Any = ()
        if events is not None:
            events.put(self)
        understand(lib.fvi_user_parameters_are_used, self.parameters)

    @property
    def is_expression(self) -> bool:
        """Is the potential an expression?"""
        return self.typed_potential is not None and self.typed_potential.expression != ffi.NULL

    def pointer(self, a: Array) -> Any:
        self.keep.append(a)
        return ffi.cast("double *", a.ctypes.data)

    def potential(self, given: Union[str, Potential]) -> Any:
        if isinstance(given, Potential):
            return self.own_potential(given)
        if callable(given):
            raise TypeError("potential: a function alone has no gradient and no hessian: "
                            "fvi.potential(value, gradient, hessian) takes all three")
        if not isinstance(given, str):
            raise TypeError(f"potential: {arguments.described(given)} is no text, and not what fvi.potential makes")
        typed = ffi.gc(ffi.new("fvi_typed_potential *"), lib.fvi_typed_potential_free)
        understand(lib.fvi_parse_potential, given.encode(), self.d if self.d > 1 else 0, self.parameters, typed)
        self.typed_potential = typed
        self.d = max(self.d, typed.d)
        if typed.kind == lib.FVI_POTENTIAL_EXPRESSION:
            self.constants, self.names = self.values, list(self.let)
        elif typed.kind in KINDS:
            self.names = KINDS[typed.kind]
            self.constants = np.frombuffer(ffi.buffer(typed.constants, 8 * len(self.names)))
        return lib.fvi_potential_typed(typed)

    def own_potential(self, given: Potential) -> Any:
        U = ffi.new("fvi_potential *")
        if callable(given.value):
            U.value, U.gradient, U.hessian = lib.ask_value, lib.ask_gradient, lib.ask_hessian
        else:
            for name in ("value", "gradient", "hessian"):
                setattr(U, name, ffi.cast(ffi.typeof(getattr(U, name)), int(getattr(given, name))))
        U.quadratic = lib.ask_quadratic if given.quadratic else ffi.NULL
        U.diagonals = given.diagonals
        return U[0]

    def measured(self, given: Any, what: str, name: str, d: int) -> Any:
        """(t, F): rows of a table, linear in between; they reach from 0 to the end."""
        t, F = (np.ascontiguousarray(arguments.numbers(f"{what}: {each}", a)) for each, a in zip(("t", name), given))
        if t.ndim != 1 or t.size < 2 or F.shape not in ((t.size,), (t.size, 1), (t.size, d)):
            raise ValueError(f"{what}: t and {name} have the shapes {t.shape} and {F.shape}, not (n,), n >= 2, and (n,) "
                             f"or (n, {d})")
        arguments.check_rows(what, name, t, F, self.last)
        rows = ffi.new("fvi_force_rows *", {"n": t.size, "columns": F.size // t.size, "t": self.pointer(t),
                                            "F": self.pointer(F)})
        self.keep.append(rows)
        return lib.fvi_force_table(rows)

    def put_ground(self, given: Any, along: Numbers) -> None:
        """The ground moves with the acceleration that is given; what acts besides is there already."""
        out, r = ffi.new("fvi_ground **"), self.pointer(arguments.row("along", arguments.numbers("along", along), self.d))
        if isinstance(given, str):
            understand(lib.fvi_parse_ground, given.encode(), self.system, r, self.parameters, self.last, out)
        else:
            acceleration = ffi.new("fvi_force *")
            if isinstance(given, tuple):
                acceleration[0] = self.measured(given, "ground", "a", 1)
            else:
                self.keep.append(ffi.new_handle(Asked(None, given, True, "ground")))
                acceleration.value, acceleration.params = lib.ask_force, self.keep[-1]
            understand(lib.fvi_ground_alloc, acceleration, self.system, r, out)
        self.ground = ffi.gc(out[0], lib.fvi_ground_free)
        self.system.force = lib.fvi_ground_force(self.ground)

    def check_force(self, method: Any, h: float, steps: int) -> None:
        """A text that is not finite where the steps of a run ask for it is refused; steps = 0: at t = 0 alone."""
        ground = self.ground and lib.fvi_ground_typed(self.ground)
        for field, typed in (("force", self.typed_force), ("ground", ground)):
            if typed and isinstance(self.texts[field], str):
                understand(lib.fvi_check_force, method, h, steps, field.encode(), self.texts[field].encode(), typed)

    def force(self, given: Any) -> Any:
        F = ffi.new("fvi_force *")
        if given is None:
            return F[0]
        if isinstance(given, tuple) and len(given) == 2:
            return self.measured(given, "force", "F", self.d)
        if callable(given):
            F.value, F.params = lib.ask_force, self.handle
            return F[0]
        if not isinstance(given, str):
            raise TypeError(f"force: {arguments.described(given)} is no text, no function of t and no pair (t, F) "
                            "of arrays")
        self.typed_force = typed_force(given, self.d, self.parameters, self.last)
        return lib.fvi_force_typed(self.typed_force)
