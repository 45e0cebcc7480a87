"""Expressions: values, gradients and Hessians of random expressions.

Printed: texts with their values and first two derivatives at doubles. sympy computes them from the text as Python's
own grammar reads it (** for ^), and they are rounded once. Each number comes with the bound of the rounding errors of
the C code in units of 2^-53, to first order: the script follows every operation of the formulas on jets, with the
errors of its operands and one rounding of its own (two if it calls a function of the C library; sums by the sizes of
their terms). The formulas here only bound the errors; no reference value comes from them."""
import random
from functools import cache

import mpmath
from sympy import Abs, DiracDelta, I, Symbol, diff, lambdify, nan, oo, pi, zoo
from sympy.parsing.sympy_parser import (parse_expr, rationalize,
                                        standard_transformations)

from shared.refgen import claim, header, hexd, hexd_real, table

FUNCTIONS = {name: getattr(__import__("sympy"), name) for name in
             "sin cos tan asin acos atan sinh cosh tanh exp log sqrt".split()}
FUNCTIONS["abs"] = Abs


class Number:
    """A value, and the bound of its error in units of 2^-53."""

    def __init__(self, value, error=0.0):
        self.v, self.e = mpmath.mpf(value), mpmath.mpf(error)

    def __add__(self, o):
        return Number(self.v + o.v, self.e + o.e + abs(self.v) + abs(o.v))

    def __sub__(self, o):
        return self + o * Number(-1)

    def __mul__(self, o):
        if 0 in (self.v, o.v) and self.e == o.e == 0:
            return Number(0)
        return Number(self.v * o.v, abs(self.v) * o.e + abs(o.v) * self.e + abs(self.v * o.v))

    def __truediv__(self, o):
        q = self.v / o.v
        return Number(q, (self.e + abs(q) * o.e) / abs(o.v) + abs(q))

    def by(self, f, slope):
        """Return f of the number. The C library computes f to an ulp, which is two units."""
        value = f(self.v)
        return Number(value, abs(slope(self.v)) * self.e + 2 * abs(value))


ONE, TWO = Number(1), Number(2)


def function(name, u):
    """Return f, f', f'' as src/expression/tape.c computes them."""
    m = mpmath
    minus = Number(-1)
    if name in ("sin", "cos"):
        sin, cos = u.by(m.sin, m.cos), u.by(m.cos, m.sin)
        return (sin, cos, minus * sin) if name == "sin" else (cos, minus * sin, minus * cos)
    if name == "tan":
        f = u.by(m.tan, lambda x: 1 + m.tan(x) ** 2)
        return f, ONE + f * f, TWO * f * (ONE + f * f)
    if name in ("asin", "acos"):
        f = u.by(getattr(m, name), lambda x: 1 / m.sqrt(1 - x * x))
        w = (ONE - u) * (ONE + u)
        g = (ONE if name == "asin" else minus) / w.by(m.sqrt, lambda x: 0.5 / m.sqrt(x))
        return f, g, u * g / w
    if name == "atan":
        g = ONE / (ONE + u * u)
        return u.by(m.atan, lambda x: 1 / (1 + x * x)), g, TWO * u * g * g
    if name in ("sinh", "cosh"):
        sinh, cosh = u.by(m.sinh, m.cosh), u.by(m.cosh, m.sinh)
        return (sinh, cosh, sinh) if name == "sinh" else (cosh, sinh, cosh)
    if name == "tanh":
        cosh = u.by(m.cosh, m.sinh)
        f, g = u.by(m.tanh, lambda x: 1 / m.cosh(x) ** 2), ONE / (cosh * cosh)
        return f, g, TWO * f * g
    if name == "exp":
        f = u.by(m.exp, m.exp)
        return f, f, f
    if name == "log":
        return u.by(m.log, lambda x: 1 / x), ONE / u, minus / u / u
    if name == "sqrt":
        f = u.by(m.sqrt, lambda x: 0.5 / m.sqrt(x))
        return f, Number(0.5) / f, Number(0.5) / f / u
    sign = Number(m.sign(u.v))
    return Number(abs(u.v), u.e), sign, Number(0)


def chain(f, u):
    return f[0], f[1] * u[1], f[1] * u[2], f[2] * u[1] * u[2] + f[1] * u[3]


def jet(tree, point, i, j):
    """Return (u, u_i, u_j, u_ij), each as a Number."""
    op, *rest = tree
    if op == "number":
        return Number(rest[0]), Number(0), Number(0), Number(0)
    if op == "name":
        return Number(point[rest[0]]), Number(rest[0] == i), Number(rest[0] == j), Number(0)
    u = jet(rest[0], point, i, j)
    if op in FUNCTIONS:
        return chain(function(op, u[0]), u)
    if op == "-1":
        return tuple(Number(-1) * c for c in u)
    if op == "^":
        n = rest[1]
        p = [Number(1)]
        for _ in range(n):
            p.append(p[-1] * u[0])
        return chain((p[n], Number(n) * p[n - 1], Number(n * (n - 1)) * p[n - 2]), u)
    w = jet(rest[1], point, i, j)
    if op == "+":
        return tuple(a + b for a, b in zip(u, w))
    if op == "-":
        return tuple(a - b for a, b in zip(u, w))
    if op == "*":
        return (u[0] * w[0], u[1] * w[0] + u[0] * w[1], u[2] * w[0] + u[0] * w[2],
                u[3] * w[0] + u[1] * w[2] + u[2] * w[1] + u[0] * w[3])
    q = u[0] / w[0]
    a, b = (u[1] - q * w[1]) / w[0], (u[2] - q * w[2]) / w[0]
    return q, a, b, (u[3] - a * w[2] - b * w[1] - q * w[3]) / w[0]


def grow(dice, names, depth):
    """Return a random tree."""
    if depth == 0 or dice.random() < 0.1:
        return (("name", dice.choice(names)) if dice.random() < 0.7 else
                ("number", dice.randint(1, 40) / 8))
    kind = dice.random()
    if kind < 0.3:
        return (dice.choice(sorted(FUNCTIONS)), grow(dice, names, depth - 1))
    if kind < 0.4:
        return ("^", grow(dice, names, depth - 1), dice.randint(2, 6))
    if kind < 0.45:
        return ("-1", grow(dice, names, depth - 1))
    return (dice.choice("++-**/"), grow(dice, names, depth - 1), grow(dice, names, depth - 1))


RANK = {"+": 1, "-": 1, "*": 2, "/": 2, "-1": 3, "^": 4}


def text(tree, dice):
    """Return the text of the tree with the necessary parentheses, and sometimes with one unnecessary pair."""
    op, *rest = tree
    if op == "number":
        return f"{rest[0]:g}"
    if op == "name":
        return rest[0]
    if op in FUNCTIONS:
        return f"{op}({text(rest[0], dice)})"

    def part(sub, least):
        inner = text(sub, dice)
        return inner if RANK.get(sub[0], 9) >= least and dice.random() < 0.9 else f"({inner})"

    if op == "-1":
        return "-" + part(rest[0], 3)
    if op == "^":
        return part(rest[0], 5) + "^" + str(rest[1])
    space = dice.choice(["", " "])
    return part(rest[0], RANK[op]) + space + op + space + part(rest[1], RANK[op] + 1)


def real_and_tame(values):
    return all(isinstance(v, mpmath.mpf) and mpmath.isfinite(v) and abs(v) < 1e6 for v in values)


def cases(seed, names, count, depth):
    """Return a list of (text, point, [(i, j, u, u_i, u_ij, three bounds)])."""
    dice, found = random.Random(seed), []
    symbols = {n: Symbol(n, real=True) for n in names}
    while len(found) < count:
        tree = grow(dice, names, depth)
        words = text(tree, dice)
        point = {n: dice.randint(-64, 64) / 32 + 1 / 64 for n in names}
        if len(words) > 90 or not all(n in words for n in names):
            continue
        pairs = [(i, j) for a, i in enumerate(names) for j in names[a:]]
        rows = []
        try:
            bounds = {}
            with mpmath.workdps(40):        # the cheap check comes first
                for i, j in pairs:
                    bounds[i, j] = [c.e for c in jet(tree, point, i, j)]
                    if any(mpmath.im(b) != 0 or not mpmath.isfinite(b) or b > 1e9 for b in bounds[i, j]):
                        raise ValueError
            expression = parse_expr(words.replace("^", "**"), {**symbols, **FUNCTIONS, "pi": pi},
                                    transformations=standard_transformations + (rationalize,))
            slopes = {i: diff(expression, symbols[i]) for i in names}
            wanted = [w.replace(DiracDelta, lambda *_: 0) for w in (
                expression, *slopes.values(), *(diff(slopes[i], symbols[j]) for i, j in pairs))]
            if any(w.has(zoo, oo, nan, I) for w in wanted):
                raise ValueError
            run = lambdify(list(symbols.values()), wanted, "mpmath")

            @cache
            def exact(digits):
                with mpmath.workdps(digits):
                    return [+v * mpmath.mpf(1) for v in run(*(mpmath.mpf(point[n]) for n in names))]

            if not real_and_tame(exact(40)):
                raise ValueError
            doubles = [hexd_real(lambda n, k=k: mpmath.nstr(exact(n + 20)[k], n)) for k in range(len(wanted))]
            for (i, j), curved in zip(pairs, doubles[1 + len(names):]):
                value, slope, _, curvature = bounds[i, j]
                at = names.index(i)
                rows.append((at, names.index(j), doubles[0], doubles[1 + at], curved,
                             *(f"{float(b):.3g}" for b in (value, slope, curvature))))
        except (ValueError, ZeroDivisionError, TypeError, NameError, mpmath.libmp.NoConvergence):
            continue
        found.append((words, [point[n] for n in names], rows))
    return found


def show(name, names, found):
    d = len(names)
    table(name, f"const char *text; double x[{d}]; int i, j; double want[3], units[3];",
          [(f'"{words}"', "{ " + ", ".join(hexd(p) for p in point) + " }", r[0], r[1],
            "{ " + ", ".join(r[2:5]) + " }", "{ " + ", ".join(r[5:8]) + " }")
           for words, point, rows in found for r in rows])


one, three = cases(1, ["x"], 120, 4), cases(2, ["x1", "x2", "x3"], 40, 4)
claim("every function is met", all(any(f + "(" in c[0] for c in one) for f in FUNCTIONS))
header("verify/expression/expression.py")
show("ref_one", ["x"], one)
show("ref_three", ["x1", "x2", "x3"], three)
