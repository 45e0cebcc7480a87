"""Gradients of motions: one adjoint run gives the derivatives by all that determines them."""
from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Callable, Iterable, Optional, Sequence, cast

import numpy as np

from ._arguments import Array, Numbers, described, function, names as names_of, number, numbers, spelt
from ._fvi import ffi, lib
from ._library import ask, failure, succeed, understand, warn
from ._observe import as_run, begin, refuse_between
from ._problem import Problem
from ._solution import Solution
from ._solve import Motion, solve
from ._system import by_law, numbers_of_laws

ALL = ("x0", "p0", "v0", "mass", "rho", "alpha", "order", "potential", "let", "damping", "force", "M", "K", "C", "dampers", "laws")
MOST_PARTS = 1 << 12  # of the time, for rows that have a common step


def steps_of_rows(t: Array, time: float) -> int:
    """The fewest steps from 0 to the time that end at each of the rows."""
    for steps in range(1, MOST_PARTS + 1):
        parts = t * (steps / time)
        if (abs(parts - np.round(parts)) <= 1e-9 * np.maximum(parts, 1)).all():
            return steps
    raise ValueError("t_eval: these times have no common step of which the time has at most "
                     f"{MOST_PARTS}; a gradient needs one")


class AdjointRun:
    """The run of a solution as the adjoint takes it, and where its rows are among the steps."""

    def __init__(self, s: Solution):
        how, self.motion = s.how, Motion(s.problem, s.how)
        run, self.method = self.motion.run, self.motion.method
        self.is_dense = bool(lib.is_dense(self.method))
        if s.status:
            raise ValueError("solution: it ended early; it has no gradient")
        as_run(self.motion, s)
        if self.is_dense and how.t_eval is not None:
            run.steps = steps_of_rows(s.t, s.problem.time)
        run.h = s.problem.time / run.steps if how.h is None else how.h
        if how.t_eval is not None and not self.is_dense:
            refuse_between(s.t, run.h, how.method, "gradient")
        self.rows = np.round(s.t / run.h).astype(int)
        self.d, self.steps = self.motion.system.d, run.steps
        self.per = self.method.stages - 1 if self.method.stages else 1

    def spread(self, what: str, given: Any, shape: tuple) -> Array:
        """A cotangent of the rows as one of all steps."""
        a = numbers(what, given)
        if len(shape) == 2 and a.shape == shape[:1] and shape[1] == 1:
            a = a[:, None]
        try:
            a = np.broadcast_to(a, shape)
        except ValueError as error:
            raise ValueError(f"{what}: the shape {a.shape} is not {shape}") from error
        for k in np.flatnonzero(~np.isfinite(a).reshape(shape[0], -1).all(axis=1))[:1]:
            raise ValueError(f"{what}: row {k} is not finite")
        full = np.zeros((self.steps + 1, *shape[1:]))
        full[self.rows] = a  # each row is another step
        return full

    def spread_dampers(self, what: str, given: Optional[Mapping[str, Any]], of: Callable[[], Mapping[str, Array]]) -> Any:
        """Cotangents of forces or impulses, by the names of the dampers, as C has them; NULL of none."""
        if not given:
            return ffi.NULL
        if not isinstance(given, Mapping):
            raise TypeError(f"{what}: {described(given)} is no dict of names of dampers and derivatives by their rows")
        told = self.told(what, given, of)
        by = np.concatenate([self.spread(f"{what}: {name}", given.get(name, 0.0), rows.shape)
                             for name, rows in told.items()], axis=1)
        return ffi.from_buffer("double[]", np.ascontiguousarray(by))

    def told(self, what: str, names: Iterable[str], of: Callable[[], Mapping[str, Array]]) -> Mapping[str, Array]:
        """What all dampers tell, of which these are some."""
        if self.is_dense:
            raise ValueError(f"{what}: fvi-adaptive has no derivatives of the forces and impulses of dampers; solve with h=..., "
                             "method=\"fvi-lobatto4\", or another one whose steps have one length")
        told = of()
        for name in names:
            if name not in told:
                raise ValueError(f"{what}: '{name}' is none of the dampers " + ", ".join(told))
        return told

    def times(self) -> Array:
        """When the forces act by which the adjoint differentiates."""
        s = self.method.stages
        c = [lib.fvi_lobatto_abscissa(s, i) for i in range(s - 1)] if s else [0.0]
        return np.append((np.arange(self.steps)[:, None] + np.array(c)).reshape(-1), self.steps) * self.motion.run.h


    def sides(self) -> tuple:
        """The same from within the steps beside a node: methods of order 2 or more take both sides of a jump there."""
        at, per = self.times(), max(1, self.per)
        if self.method.highest == 1:
            return at, at
        node = np.arange(at.size) % per == 0
        before, after = (np.where(node, at * (1 + side * 4 * np.finfo(float).eps), at) for side in (-1, 1))
        after[0] = before[0] = np.finfo(float).tiny
        after[-1] = before[-1]
        return before, after

    def mean_of_sides(self, name: str, before: Array, after: Array) -> Array:
        """Half of either; of form D, whose sides count differently, a jump leaves no derivative: NaN, and a warning."""
        if self.method.damped_inertia and (abs(before - after) > 1e-9 * (abs(before) + abs(after))).any():
            warn(f"{name}: no derivative by it: what acts jumps at a row, where the two sides of form D count differently")
            return np.full(before.size, np.nan)
        return (before + after) / 2


def like(given: Any, by: Array) -> Any:
    """The derivative by what was given: one number for all coordinates, or each."""
    return by if np.size(given) == by.size and np.ndim(given) else float(by.sum()) if np.ndim(given) == 0 \
        else np.array([by.sum()])


def of_table(t: Array, columns: int, times: Array, by: Array) -> Array:
    """From the forces at these times to the rows between which they were linear."""
    at = np.clip(times, t[0], t[-1])
    low = np.clip(np.searchsorted(t, at, side="right") - 1, 0, t.size - 2)
    part = ((at - t[low]) / (t[low + 1] - t[low]))[:, None]
    found = np.zeros((t.size, by.shape[1]))
    np.add.at(found, low, (1 - part) * by)
    np.add.at(found, low + 1, part * by)
    return found if columns == by.shape[1] else found.sum(axis=1, keepdims=True)


def known_of(q: Problem, is_expression: bool, is_dense: bool) -> set:
    """By what a problem has derivatives."""
    known = {"x0", "v0" if q.v0 is not None else "p0"} | ({"force"} if isinstance(q.force, tuple) else set())
    inertia = set() if q.ground is not None and is_dense else {"M"} if q.kind == "structure" else {"mass"}
    if q.kind == "structure" and q.dampers:
        return known | inertia | {"K", "dampers"} | (set() if is_dense else {"laws"})
    if q.kind == "mechanism":
        of_laws = {"laws", "alpha", "order"} if is_dense else set()  # steps of any length know their factors alone
        return known | (known_of_mechanism(q, is_expression) - of_laws) | (inertia if q.lagrangian is None else set())
    is_spring = q.kind == "structure" and is_dense and (q.alpha == 0 or q.order == 0)  # there steps of any length have none
    if q.damping is not None or not is_spring:
        known |= {"damping"} if q.damping is not None else {"order" if q.order is not None else "alpha"}
    if q.kind == "structure":
        return known | inertia | {"K"} | ({"C"} if q.C is not None else set())
    known |= inertia | ({"rho"} if q.damping is None else set()) | ({"let"} if q.let else set())
    return known | ({"potential"} if isinstance(q.potential, str) and not is_expression else set())


def known_of_mechanism(q: Problem, is_expression: bool) -> set:
    """Dampers by a factor and the numbers of each; where each coordinate is damped by itself, by rho and the order."""
    found = {"let"} if q.let else set()
    rho = 0.2 if q.rho is None else q.rho
    if len(q.dampers):
        found |= {"dampers", "laws"}
    elif q.lagrangian is None and q.damping is None and np.all(np.asarray(rho) > 0):
        found |= {"rho", "order" if q.order is not None else "alpha"}
    return found | ({"potential"} if q.lagrangian is None and isinstance(q.potential, str) and not is_expression else set())


def wanted_of(q: Problem, wrt: Optional[Sequence[str]], is_expression: bool, is_dense: bool = False) -> set:
    known = known_of(q, is_expression, is_dense)
    if wrt is None:
        return known
    wanted = set(names_of("wrt", wrt))
    for name in sorted(wanted - known):
        raise ValueError((f"wrt: this problem has no {name} to differentiate by; it has " if name in ALL else
                          f"wrt: '{name}' is none of ") + ", ".join(sorted(known)))
    return wanted


class Derivatives:
    """By which numbers of the library a problem is differentiated, for the names that were asked for."""

    def __init__(self, q: Problem, adjoint: AdjointRun, names: set, is_chosen: bool):
        system, d = adjoint.motion.system, adjoint.d
        self.q, self.adjoint, self.names, self.lets = q, adjoint, names, list(q.let or {})
        self.shared, self.sizes, self.parts = ffi.new("fvi_sensitivities *"), {}, []  # fields of the library, by names
        whole, is_mechanism, count = q.kind == "structure", q.kind == "mechanism", lib.dampers_of(system.system)
        for field, size, by in (("x0", d, {"x0"}), ("p0", d, {"p0", "v0"}), ("mass", 1 if whole else d, {"mass", "M"}),
                                ("damping", len(q.dampers) or 1 if whole else count if is_mechanism else d, {"rho", "C", "dampers"}),
                                ("alpha", 1, set() if is_mechanism else {"alpha", "order"})):
            if by & names or (field == "p0" and q.v0 is not None and names & {"mass", "x0", "let"}):
                self.sizes[field] = size
        self.laws = system.laws_of_dampers if "laws" in names else [system.law] if "damping" in names else []
        if is_mechanism:
            self.laws = [lib.kernel_of(system.system, j) for j in range(count)] if names & {"laws", "alpha", "order"} else []
        self.want_laws(is_mechanism, is_chosen)
        self.want_parameters(whole)
        self.want_names()

    def want_laws(self, is_mechanism: bool, is_chosen: bool) -> None:
        parts = numbers_of_laws(self.laws, self.adjoint.is_dense) if self.laws else []
        if "damping" in self.names and self.adjoint.is_dense and (
                not parts or self.laws[0].term[0].kind == lib.FVI_KERNEL_MAXWELL2):
            why = "no derivative by it: fvi-adaptive has only that by the factor of a law that stands alone, not of maxwell2"
            if is_chosen:
                raise ValueError(f"damping: {why}")
            warn(f"damping: {why}")
            parts = []
        if is_mechanism and "laws" not in self.names:
            parts = parts and ["orders"]
        for field in parts:
            self.sizes[field] = sum(law.count for law in self.laws)
        self.parts = parts

    def want_parameters(self, whole: bool) -> None:
        system, to = self.adjoint.motion.system, self.shared
        if self.q.lagrangian is not None:
            to.sensitivity.count, to.lagrangian = len(self.lets), ffi.addressof(lib, "fvi_typed_lagrangian_column")
        elif system.is_expression:
            to.sensitivity.count, to.sensitivity.column = len(self.lets), ffi.addressof(lib, "by_parameter")
        elif system.typed_potential is not None and not whole:
            to.sensitivity = lib.fvi_parameter_gradient_of(ffi.addressof(system.system, "potential"))
        if "K" in self.names or (to.sensitivity.count and {"let", "potential"} & self.names):
            self.sizes["parameters"] = 1 if whole else to.sensitivity.count

    def want_names(self) -> None:
        """The numbers in forces, elongations and constraints."""
        system, adjoint, q = self.adjoint.motion.system, self.adjoint, self.q
        self.used = [system.parameters.used[j] for j in range(len(self.lets))]
        has_force = "let" in self.names and any(u & lib.FVI_USED_BY_FORCE for u in self.used)
        if "let" in self.names and any(u & lib.FVI_USED_BY_DAMPING for u in self.used):
            raise ValueError("let: a law that is an expression has no derivative by its names; leave let out of wrt")
        if "let" in self.names and any(u & lib.FVI_USED_BY_MECHANISM for u in self.used):
            self.columns = ffi.new("fvi_mechanism_columns *",
                                   lib.fvi_typed_mechanism_columns(system.typed_mechanism, len(self.lets)))
            self.shared.columns = self.columns
            self.sizes["names"] = len(self.lets)
        if has_force and adjoint.is_dense:
            raise ValueError("let: fvi-adaptive asks for the force between the rows, and has no derivative by a name in it")
        if has_force or "force" in self.names or (q.ground is not None and self.names & {"mass", "M"}):
            self.sizes["force"] = (adjoint.per * adjoint.steps + 1 if not adjoint.is_dense else adjoint.steps + 1) * adjoint.d

    def outputs(self, found: dict) -> Any:
        """Where the library writes these arrays, or reads them."""
        to = ffi.new("fvi_sensitivities *", self.shared[0])
        for field, array in found.items():
            setattr(to, field, ffi.cast("double *", array.ctypes.data))
        return to


@spelt()
def vjp(solution: Solution, x: Optional[Numbers] = None, p: Optional[Numbers] = None,
        energy: Optional[Numbers] = None, *, forces: Optional[Mapping[str, Numbers]] = None,
        impulses: Optional[Mapping[str, Numbers]] = None, wrt: Optional[Sequence[str]] = None) -> dict:
    """The gradient of a number L that is made of a motion, for one adjoint run.

        s = fvi.solve(problem, h=0.1, method="fvi-lobatto4")
        g = fvi.vjp(s, x=s.x - data)            # of sum |x - data|^2 / 2
        g["alpha"], g["x0"], g["let"]["k"]

    solution  of `solve`; of one with error, or of "fvi-adaptive", see below
    x, p      dL/dx and dL/dp of every row, (n, d) numbers, or (n,) of one coordinate, or one for all
    energy    dL/dE of every row, n numbers
    forces    dL/df of every row of the dampers that L knows, a dict by their names, as `s.forces` has them: n numbers of a
              damper between points or along a row, (n, d) numbers of others. Not by "fvi-adaptive", nor with events; 0 of first
              rows that come from shorter steps, as with an order above 1
    impulses  dL/dJ, likewise, as `s.impulses` has them. There is none of works: without a force and with one damper the
              work is energy[0] - energy
    wrt       by what: fields of the problem; None: by all of them that have a derivative

    Returns a dict by names: "x0", "p0" or "v0", "mass", "rho", "alpha" or "order", each in the shape that the problem
    has it; of matrices "M", "K" and "C", by a factor of each, "dampers", by a factor of the law of each, and
    "laws", for each damper a dict for each term of its law; "let", by names;
    "potential", the derivatives by the constants of a potential that is ready to use;
    "damping", a dict for each term of the law, with rho, alpha, time and end; of maxwell2 rho1, alpha1, rho2
    and alpha2; with rho alone by "fvi-adaptive"; None, with a warning, of
    maxwell2 and of several terms by "fvi-adaptive", which wrt cannot ask for; "force", of measured rows, by each F.

    By x0, p0 or v0 it is NaN, and a warning says so, where other starts have no solution; by an x0 of 0 with the past
    "rl" also of first rows of forces, which come from shorter steps for every other start.

    These are the derivatives of the numbers that `solve` gives, exact but for rounding: no difference is taken. Of
    "fvi-adaptive" the steps are held, and with error they are those of another run as fine.
    Raises fvi.Error where the library has no such derivative (code 23): leave that out of wrt.
    """
    if not isinstance(solution, Solution):
        raise TypeError(f"solution: {described(solution)} is no Solution")
    q, adjoint = solution.problem, AdjointRun(solution)
    system = adjoint.motion.system
    names = wanted_of(q, wrt, system.is_expression, adjoint.is_dense)
    if x is None and p is None and energy is None and not forces and not impulses:
        raise TypeError("x: missing, as p, energy, forces and impulses are: the derivatives of L by the rows")
    shape = solution.x.shape
    Jx = adjoint.spread("x", 0.0 if x is None else x, shape)
    Jp = adjoint.spread("p", 0.0 if p is None else p, shape)
    of_dampers = [adjoint.spread_dampers("forces", forces, lambda: solution.forces),
                  adjoint.spread_dampers("impulses", impulses, lambda: solution.impulses)]
    if forces:
        refuse_short_rows(solution, of_dampers[0], adjoint.steps)
    by_energy = None
    if energy is not None:
        by_energy = adjoint.spread("energy", energy, shape[:1])[adjoint.rows]
        Ex, Ep = np.zeros((2, *shape))
        succeed(ask(lib.energy_slopes, system.system, shape[0], *solution.arrays(),
                    ffi.from_buffer("double[]", np.ascontiguousarray(by_energy)), ffi.from_buffer("double[]", Ex), ffi.from_buffer("double[]", Ep)))
        Jx[adjoint.rows] += Ex
        Jp[adjoint.rows] += Ep
    cotangents = ffi.new("cotangents *", {"Jx": ffi.from_buffer("double[]", Jx), "Jp": ffi.from_buffer("double[]", Jp)})
    objective = ffi.new("fvi_objective *", {"slopes": ffi.addressof(lib, "read_slopes"), "params": cotangents,
                                            "has_momenta": bool(Jp[:-1].any())})
    by = Derivatives(q, adjoint, names, wrt is not None)
    found = {field: np.zeros(size) for field, size in by.sizes.items()}
    if of_dampers == [ffi.NULL, ffi.NULL]:
        status = ask(lib.fvi_adjoint, adjoint.method, adjoint.motion.run, ffi.NULL, ffi.NULL, objective, by.outputs(found))
    else:
        status = ask(lib.fvi_adjoint_forces, adjoint.method, adjoint.motion.run, objective, *of_dampers, by.outputs(found))
    if status:
        raise failure(status, said=adjoint.motion.run.failure)
    add_energy(solution, by_energy, system, found)
    if q.ground is not None and "mass" in found:
        add_ground(system, adjoint, found, q.kind == "structure")
    answer = named(by, found)
    if forces and "x0" in answer:
        beside = short_beside(adjoint, of_dampers[0])
        answer["x0"] = answer["x0"] + like(1.0 if q.x0 is None else q.x0, beside)
    return answer


def short_beside(adjoint: AdjointRun, by: Any) -> Array:
    """NaN for each x0 beside which these forces jump or come from steps shorter than those of the run, else 0."""
    told, rows, run = np.zeros(adjoint.d), ffi.new("size_t *"), adjoint.motion.run
    known = np.flatnonzero(np.frombuffer(ffi.buffer(by)).reshape(run.steps + 1, -1).any(axis=1))
    for i in range(adjoint.d if known.size else 0):
        succeed(ask(lib.fvi_observer_short_rows_beside, adjoint.method, run, i, rows))
        if rows[0] and (known <= rows[0]).any():
            told[i] = np.nan
    if np.isnan(told).any():
        warn("x0: no derivative by it: from other starts these forces jump, or come from steps shorter than those of the "
             "run")
    return told


def short_rows(s: Solution) -> range:
    """The first rows of forces that are not told by the steps of the run, and have no derivatives (fvi/observer.h); with
    that at t = 0 if a mass is 0, since its dampers say how it starts."""
    is_massless = s.problem.lagrangian is None and (np.asarray(s.problem.mass) == 0).any()
    return range(0 if is_massless else 1, lib.fvi_observer_short_rows(begin(s, lib.FVI_OBSERVE_FORCE)[2]) + 1)


def refuse_short_rows(s: Solution, by: Any, steps: int) -> None:
    short = short_rows(s)
    if np.frombuffer(ffi.buffer(by)).reshape(steps + 1, -1)[short.start:short.stop].any():
        raise ValueError(f"forces: the forces of rows {short.start} to {short.stop - 1} come from steps shorter than those of the run, because an order is "
                         "above 1, the past jumps, or a coordinate has no mass; they have no derivatives, so give 0 for these rows")


def add_energy(s: Solution, by: Optional[Array], system: Any, found: dict) -> None:
    """What energies have of masses and parameters besides x and p."""
    if by is None:
        return
    if s.problem.kind == "structure":
        still, done, none = np.empty(len(s.t)), ffi.new("size_t *"), np.zeros(s.p.shape)
        succeed(ask(lib.energies, system.system, len(s.t), *s.arrays()[:2], ffi.from_buffer("double[]", none),
                    ffi.from_buffer("double[]", still), done))
        for field, share in (("mass", still - s.energy), ("parameters", still)):
            if field in found:
                found[field] += by @ share
        return
    if s.problem.lagrangian is not None:
        if "parameters" in found:
            succeed(ask(lib.energies_by_lagrangian, system.system, len(s.t), *s.arrays()[:2], *(
                ffi.from_buffer("double[]", np.ascontiguousarray(a)) for a in (s.v, by)), len(found["parameters"]),
                ffi.from_buffer("double[]", found["parameters"])))
        return
    if "mass" in found:
        mass = np.frombuffer(ffi.buffer(system.system.mass, 8 * s.p.shape[1]))
        found["mass"] -= by @ np.divide(s.p, mass, out=np.zeros(s.p.shape), where=mass > 0)**2 / 2
        if not mass.all():
            warn("mass: no derivative of an energy by a mass of 0: it does not know the velocity there")
            found["mass"][mass == 0] = np.nan
    value = ffi.new("double *")
    for j in range(len(found.get("parameters", ()))):
        for k in np.flatnonzero(by):
            row = ffi.from_buffer("double[]", np.ascontiguousarray(s.x[k]))
            succeed(lib.energy_by_parameter(system.typed_potential, s.x.shape[1], j, row, value))
            found["parameters"][j] += by[k] * value[0]


def add_ground(system: Any, adjoint: AdjointRun, found: dict, whole: bool) -> None:
    """The ground adds the force -M r a, in which each mass stands, or a factor of M."""
    d, sides = adjoint.d, []
    load_vector = np.frombuffer(ffi.buffer(lib.fvi_ground_load_vector(system.ground), 8 * d))
    for times in adjoint.sides():
        sides.append(np.empty(times.size))
        succeed(ask(lib.accelerations_of_ground, system.ground, times.size, ffi.from_buffer("double[]", times),
                    ffi.from_buffer("double[]", sides[-1])))
    a = adjoint.mean_of_sides("mass", *sides)
    by = -(a @ found["force"].reshape(-1, d)) * load_vector
    found["mass"] += by.sum() if whole else by / np.frombuffer(ffi.buffer(system.system.mass, 8 * d))


def warn_of_start(name: str, by: Array) -> None:
    """The library leaves NaN where other starts have no solution."""
    if np.isnan(by).any():
        warn(f"{name}: no derivative by it: other starts have no solution")


def named(by: Derivatives, found: dict) -> dict:
    """By the names of the problem, in its shapes."""
    answer: dict = {}
    q, names, adjoint, parts, laws, lets, used = by.q, by.names, by.adjoint, by.parts, by.laws, by.lets, by.used
    system, d = adjoint.motion.system, adjoint.d
    mass = np.broadcast_to(np.asarray(q.mass), (d,))
    for name, field in (("M", "mass"), ("C", "damping"), ("K", "parameters")):
        if name in names:
            answer[name] = float(found[field][0])
    if "dampers" in names:
        answer["dampers"] = found["damping"]
    for name, field, given in (("x0", "x0", 1.0 if q.x0 is None else q.x0), ("p0", "p0", 0.5 if q.p0 is None else q.p0),
                               ("rho", "damping", 0.2 if q.rho is None else q.rho)):
        if name in names and not (name == "rho" and q.kind == "mechanism"):
            warn_of_start(name, found[field])
            answer[name] = like(given, found[field])
    if q.lagrangian is not None and q.v0 is not None and "p0" in found:
        by_v0, by_x0, n = np.zeros(d), found.get("x0", np.zeros(d)), len(found.get("parameters", ()))
        parameters = found.get("parameters", np.zeros(1))
        v0 = np.ascontiguousarray(np.broadcast_to(np.asarray(q.v0, dtype=float), (d,)))
        succeed(ask(lib.start_by_velocity, system.system, *(ffi.from_buffer("double[]", each) for each in (
            system.x0, v0, found["p0"], by_x0, by_v0)), n, ffi.from_buffer("double[]", parameters)))
        if "x0" in names:
            answer["x0"] = like(1.0 if q.x0 is None else q.x0, by_x0)
        mass_of_v0 = by_v0
    else:
        mass_of_v0 = mass * found["p0"] if "p0" in found else np.zeros(d)
    if "v0" in names:
        warn_of_start("v0", mass_of_v0)
        answer["v0"] = like(q.v0, mass_of_v0)
    if q.kind == "mechanism" and names & {"rho", "alpha", "order"}:
        rho = np.broadcast_to(np.asarray(0.2 if q.rho is None else q.rho, dtype=float), (d,))
        if "rho" in names:
            answer["rho"] = like(0.2 if q.rho is None else q.rho, found["damping"] / rho)
        for name, share in (("alpha", 1), ("order", 0.5)):
            if name in names:
                answer[name] = share * float(found["orders"].sum())
        names = names - {"rho", "alpha", "order"}
    if "mass" in names:
        of_start = 0 if q.v0 is None or not np.any(q.v0) else found["p0"] * np.asarray(q.v0)  # p0 = m v0
        answer["mass"] = like(q.mass, found["mass"] + of_start)
    if "alpha" in names:
        answer["alpha"] = float(found["alpha"][0])
    if "order" in names:
        answer["order"] = float(found["alpha"][0]) / 2
    if "potential" in names:
        answer["potential"] = found.get("parameters", np.zeros(0))
    by_force = found["force"].reshape(-1, d) if "force" in found else None
    if "let" in names:
        by_let = found["parameters"].copy() if "parameters" in found and (system.is_expression or q.lagrangian is not None) \
            else np.zeros(len(lets))
        by_let += found.get("names", 0.0)
        for j in np.flatnonzero(np.isnan(by_let)):
            warn(f"let: no derivative by {lets[j]}: it stands in a constraint, or in a damper that must "
                 "not be stretched, which the start would have to follow")
        sums = [] if by_force is None or system.typed_force is None else [(system.typed_force, by_force.sum(axis=1))]
        if by_force is not None and isinstance(q.ground, str):
            load_vector = np.frombuffer(ffi.buffer(lib.fvi_ground_load_vector(system.ground), 8 * d))
            sums.append((lib.fvi_ground_typed(system.ground), -by_force @ load_vector))
        for j in range(len(lets)):
            if used[j] & lib.FVI_USED_BY_FORCE:
                for typed, pushed in sums:
                    sides = ([lib.fvi_typed_force_by_parameter(typed, j, t) for t in times] for times in adjoint.sides())
                    by_let[j] += adjoint.mean_of_sides(f"let: {lets[j]}", *map(np.array, sides)) @ pushed
        answer["let"] = dict(zip(lets, by_let.tolist()))
    if "damping" in names:
        answer["damping"] = by_law(system.law, {f: found[f] for f in parts}, system.parameters) if parts else None
    if "laws" in names:
        answer["laws"] = []
        for law, first in zip(laws, np.cumsum([0] + [law.count for law in laws])):
            answer["laws"].append(by_law(law, {f: found[f] for f in parts}, system.parameters, int(first),
                                          sum(law.count for law in laws)))
    if "force" in names:
        t, F = (np.asarray(a) for a in cast(tuple, q.force))
        if adjoint.is_dense and (abs(t / adjoint.motion.run.h - np.round(t / adjoint.motion.run.h)) > 1e-9).any():
            raise ValueError("force: of fvi-adaptive the times of the force must be among those of the rows, by which "
                             "it has derivatives; choose steps")
        times = adjoint.times() if not adjoint.is_dense else np.arange(adjoint.steps + 1) * adjoint.motion.run.h
        answer["force"] = of_table(t, F.size // t.size, times, by_force).reshape(F.shape)
    return answer


@spelt(solve)
def gradient(problem: Problem, loss: Callable[[Solution], tuple], *, wrt: Optional[Sequence[str]] = None,
             **options: Any) -> tuple:
    """A loss and its gradient.

        def loss(s):
            return ((s.x - data)**2).sum() / 2, {"x": s.x - data}
        value, g = fvi.gradient(problem, loss, steps=100)

    problem   what is solved
    loss      of a Solution gives a number and its derivatives by the rows, a dict of x, p, energy, forces and impulses
    wrt       as for `vjp`
    the rest  as for `solve`

    Returns the number and what `vjp` makes of the derivatives.
    """
    s = solve(problem, **options)
    given = function("loss", loss, "of a Solution")(s)
    if not (isinstance(given, tuple) and len(given) == 2 and isinstance(given[1], Mapping) and given[1]
            and set(given[1]) <= {"x", "p", "energy", "forces", "impulses"}):
        raise TypeError(f"loss gave {described(given)}, not a number and a dict of its derivatives by x, p, energy, "
                        "forces, impulses")
    value, by = given
    number("loss", value)
    return value, vjp(s, wrt=wrt, **by)
