"""The motions of many problems, on all cores."""
from __future__ import annotations

import concurrent.futures
import itertools
import os
import queue
from collections.abc import Mapping
from typing import Any, Callable, Optional, Sequence

import numpy as np

from ._arguments import Array, described, function, spelt, whole
from ._fvi import ffi, lib
from ._library import waiting, warn
from ._problem import Problem
from ._solution import Solution
from ._solve import Bar, Progress, planned, solve, solved_together, teller


def warn_of_all(names: Sequence[str], grid: Sequence[tuple], heard: Sequence[list]) -> None:
    """What some of the motions are warned of, once."""
    warned = [i for i, texts in enumerate(heard) if texts]
    if warned:
        first = ", ".join(f"{name} = {value}" for name, value in zip(names, grid[warned[0]]))
        warn(f"{len(warned)} of {len(grid)} motions, the first with {first}: {'; '.join(heard[warned[0]])}")


def axes_of(problem: Problem, vary: Any) -> dict:
    """The values of each name, as lists."""
    if not isinstance(vary, Mapping) or not vary:
        raise TypeError(f"vary: {described(vary)} is no dict of names and their values")
    axes: dict = {}
    for name, values in vary.items():
        if name not in (problem.let or {}) and name not in problem.__dataclass_fields__:
            raise ValueError(f"vary: {described(name)} is no field of the problem and no name of its let")
        if isinstance(values, (str, bytes, Mapping)) or not hasattr(values, "__iter__"):
            raise TypeError(f"vary: {name}: {described(values)} is no list of values")
        axes[name] = list(values)
        if not axes[name]:
            raise ValueError(f"vary: {name}: there is no value")
    return axes


# Problems that differ in these, or in numbers of `let`, may take their steps together; eight at most.
SHARED, TOGETHER = ("rho", "mass", "x0", "p0", "v0", "potential", "force"), 8


def groups_of(names: Sequence[str], shape: Sequence[int], let: Mapping, threads: int) -> list:
    """The motions of the grid, by their numbers, in groups that may go together; there are as many groups as threads, or more."""
    places = list(itertools.product(*map(range, shape)))
    divides = [n for n, name in enumerate(names) if name not in let and name not in SHARED]

    def key(i: int) -> list:
        return [places[i][n] for n in divides]
    most = max(1, min(TOGETHER, len(places) // threads))
    groups: list = []
    for _, same in itertools.groupby(sorted(range(len(places)), key=key), key):
        alike = list(same)
        groups += [alike[n:n + most] for n in range(0, len(alike), most)]
    return groups


@spelt(solve)
def sweep(problem: Problem, vary: Mapping[str, Sequence], of: Optional[Callable[[Solution], Any]] = None, *,
          jobs: Optional[int] = None, progress: Progress = None, **options: Any) -> Array:
    """The motions of many problems, on all cores: an array with an axis for each name of `vary`.

        peak = fvi.sweep(problem, {"alpha": np.linspace(0.1, 0.5, 9), "rho": [0.1, 0.2]}, lambda s: abs(s.x).max())
        peak.shape == (9, 2)

    problem   what is varied
    vary      values by name: of a field of the problem, or of a number in its `let`
    of        what is kept of each Solution; None: the Solution itself
    jobs      how many threads; None: one for each core. Functions of Python's in a problem take turns. If the step is
              given, up to eight similar motions of one coordinate take their steps together on each thread, with the same numbers
    progress  True: a bar; or a function f(motions done, motions)
    the rest  as for `solve`

    The first motion that fails raises its error; Ctrl-C ends all of them. What several motions are warned of is one
    FviWarning, with the values of the first.
    """
    if options.get("checkpoint") is not None:
        raise ValueError("checkpoint: of one motion, not of many")
    if not isinstance(problem, Problem):
        raise TypeError(f"problem: {described(problem)} is no fvi.Problem")
    axes = axes_of(problem, vary)
    names, grid = list(axes), list(itertools.product(*axes.values()))
    shape, let = tuple(map(len, axes.values())), problem.let or {}
    threads = (os.cpu_count() or 1) if jobs is None else whole("jobs", jobs, 1)
    if of is not None:
        function("of", of, "of a Solution")
    stop, tell = ffi.new("int *"), teller(progress)

    def problem_of(values: tuple) -> Problem:
        own = {name: v for name, v in zip(names, values) if name not in let}
        lets = {name: v for name, v in zip(names, values) if name in let}
        return problem.replace(**own, **({"let": {**let, **lets}} if lets else {}))

    def together(group: Sequence[int]) -> Optional[list]:
        """As solved_together. What one of them raises or warns of is said when it is solved by itself."""
        waiting.heard = []
        try:
            problems = [problem_of(grid[i]) for i in group]
            return solved_together(problems, [planned(q, **options) for q in problems]) if len(group) > 1 else None
        except BaseException:  # an interrupt, too, which stop tells the others
            return None
        finally:
            waiting.heard = None

    def one(number: int, ready: Optional[Callable[[], Solution]]) -> Any:
        lib.set_stop_flag(stop)
        waiting.heard = []
        try:
            found = ready() if ready else solve(problem_of(grid[number]), **options)
            return found if of is None else of(found)
        finally:
            heard[number], waiting.heard = waiting.heard or [], None
            lib.set_stop_flag(ffi.NULL)

    answers: list = [None] * len(grid)
    heard: list = [[]] * len(grid)
    groups = groups_of(names, shape, let, threads)
    todo, done = iter(groups), queue.SimpleQueue()  # type: Any, queue.SimpleQueue

    def work() -> None:
        for group in todo:  # which all threads share
            lib.set_stop_flag(stop)
            ready = together(group) or [None] * len(group)
            for i, solution in zip(group, ready):
                if stop[0]:
                    return
                try:
                    done.put((i, one(i, solution), None))
                except BaseException as error:
                    done.put((i, None, error))
    count = min(threads, len(groups))
    with concurrent.futures.ThreadPoolExecutor(count) as pool:
        try:
            for _ in range(count):
                pool.submit(work)
            for n in range(1, len(grid) + 1):
                i, answers[i], failed = done.get()
                if failed is not None:
                    raise failed
                if tell:
                    tell(n, len(grid))
        except BaseException:
            stop[0] = 1
            raise
        finally:
            if isinstance(tell, Bar):
                tell.clear()
    warn_of_all(names, grid, heard)
    if of is None:
        kept = np.empty(len(grid), dtype=object)
        kept[:] = answers
        return kept.reshape(shape)
    made = np.array(answers)
    return made.reshape(shape + made.shape[1:])
