"""The Python package: how it calls torch and jax, whether they are here or not; and its recipe for conda.

Small modules in their place check each call as their manuals have it. What only the packages themselves can show
is tested where they are (test_python_gradient.py, test_python_examples.py)."""
import importlib
import os
import pathlib
import re
import subprocess
import sys
import textwrap
import types

import fvi
import numpy as np
import pytest

SOURCES = pathlib.Path("src/python")
JAX = textwrap.dedent('''
    """jax.custom_vjp, pure_callback and grad of one call, with the checks that jax makes."""
    import numpy as np
    class ShapeDtypeStruct:
        def __init__(self, shape, dtype):
            self.shape, self.dtype = shape, np.dtype(dtype)
    class config:
        def update(name, value):
            assert (name, value) == ("jax_enable_x64", True)
    def pure_callback(host, result, *arguments, vmap_method):
        assert vmap_method == "sequential"
        given = host(*map(np.asarray, arguments))
        assert np.shape(given) == result.shape and np.asarray(given).dtype == result.dtype
        return np.asarray(given)
    class Traced:
        def __init__(self, value, back):
            self.value, self.back = value, back
        def __getitem__(self, at):
            bar = np.zeros(self.value.shape)
            bar[at] = 1
            return Traced(self.value[at], lambda: self.back(bar))
    class custom_vjp:
        differentiates = False
        def __init__(self, function, nondiff_argnums):
            assert nondiff_argnums == (0,)
            self.function = function
        def defvjp(self, forward, backward):
            self.forward, self.backward = forward, backward
        def __call__(self, first, *rest):
            if not custom_vjp.differentiates:
                return self.function(first, *rest)
            custom_vjp.differentiates = False
            value, kept = self.forward(first, *rest)  # which takes all arguments, as the function does
            def back(bar):
                found = self.backward(first, kept, bar)  # those that have no derivative stand first
                assert isinstance(found, tuple) and len(found) == len(rest)
                return found[0]
            return Traced(value, back)
    def grad(of):
        def slope(at):
            custom_vjp.differentiates = True
            return of(np.float64(at)).back()
        return slope
''')


def test_the_recipe_for_jax_keeps_to_its_conventions(tmp_path):
    """The lines of the manual, with the gradient that vjp has."""
    (tmp_path / "jax.py").write_text(JAX)
    run = subprocess.run([sys.executable, "tests/example/motion_for_jax.py"], capture_output=True, text=True,
                         env={**os.environ, "PYTHONPATH": f"{tmp_path}{os.pathsep}{pathlib.Path(fvi.__file__).parent.parent}"})
    assert run.returncode == 0, run.stderr
    s = fvi.solve(fvi.Problem(rho=0.4, alpha=0.3), h=0.1, method="fvi-lobatto4")
    last = np.zeros(s.x.shape)
    last[-1] = 1
    assert run.stdout.strip() == f"by alpha {fvi.vjp(s, x=last)['alpha']:.4f}"


class Tensor:
    """What of a tensor fvi.torch asks for."""

    def __init__(self, value, dtype="float64", device="cpu"):
        self.value, self.dtype, self.device = np.asarray(value, dtype=float), dtype, device
        self.shape = self.value.shape

    def detach(self):
        return Tensor(self.value, self.dtype, self.device)

    def cpu(self):
        return Tensor(self.value, self.dtype)

    def double(self):
        return Tensor(self.value, "float64", self.device)

    def numpy(self):
        assert (self.dtype, self.device) == ("float64", "cpu")
        return self.value

    def reshape(self, shape):
        return Tensor(self.value.reshape(shape), self.dtype, self.device)

    def to(self, device, dtype=None):
        return Tensor(self.value, dtype or self.dtype, device)


class Function:
    @classmethod
    def apply(cls, *arguments):
        ctx = types.SimpleNamespace(count=len(arguments))
        Function.latest = lambda *bars: cls.backward(ctx, *bars)
        return *cls.forward(ctx, *arguments), Function.latest


def stub_of_torch():
    torch = types.ModuleType("torch")
    torch.autograd = types.SimpleNamespace(Function=Function, function=types.SimpleNamespace(once_differentiable=lambda f: f))
    torch.float64, torch.from_numpy = "float64", Tensor
    torch.as_tensor = lambda value, dtype: Tensor(value, dtype)
    return torch


def test_torch_is_called_as_it_wants_to_be(monkeypatch):
    """Each tensor gets a gradient of its own shape, type and place; what is none gets None."""
    motions = importlib.import_module("fvi.torch")
    monkeypatch.setitem(sys.modules, "torch", stub_of_torch())
    motions.motion.cache_clear()
    t = np.linspace(0, 20, 11)
    problem = fvi.Problem("k*x^2/2", let={"k": 1.2}, force=(t, np.sin(t)), mass=[1.0], time=20)
    given = {"alpha": Tensor(0.3, "float32", "cuda"), "k": Tensor(1.3), "force": Tensor(np.cos(t)), "mass": Tensor([2.0])}
    try:
        x, p, backward = motions.solve(problem, given, h=0.1)
        s = fvi.solve(problem.replace(alpha=0.3, let={"k": 1.3}, force=(t, np.cos(t)), mass=[2.0]), h=0.1)
        assert np.array_equal(x.value, s.x) and np.array_equal(p.value, s.p) and x.device == "cuda"
        bar = np.sin(np.arange(s.x.size)).reshape(s.x.shape)
        found = backward(Tensor(bar), Tensor(2 * bar))
        want = fvi.vjp(s, x=bar, p=2 * bar)
        assert found[:5] == (None,) * 5 and len(found) == 9
        for (name, tensor), by in zip(given.items(), found[5:]):
            assert np.array_equal(by.value, want["let"]["k"] if name == "k" else want[name])
            assert (by.shape, by.dtype, by.device) == (tensor.shape, tensor.dtype, tensor.device)
        x, p, forces = motions.solve(problem, {"alpha": Tensor(0.3)}, forces="d1", h=0.1)
        s = fvi.solve(problem.replace(alpha=0.3), h=0.1)
        assert list(forces) == ["d1"] and np.array_equal(forces["d1"].value, s.forces["d1"])
        by = Function.latest(Tensor(bar), Tensor(0 * bar), Tensor(3 * bar))[5]
        assert by.value == fvi.vjp(s, x=bar, forces={"d1": 3 * bar})["alpha"]
        with pytest.raises(ValueError, match="^forces: 'd2' is none of the dampers d1"):
            motions.solve(problem, {"alpha": Tensor(0.3)}, forces=["d2"], h=0.1)
        for wrong, what in ((3, TypeError), ({}, ValueError), ({"gamma": Tensor(1)}, ValueError), ({"alpha": 0.3}, TypeError)):
            with pytest.raises(what, match="^tensors: "):
                motions.solve(problem, wrong, h=0.1)
        with pytest.raises(TypeError, match="there is no argument 'methd'; did you mean 'method'"):
            motions.solve(problem, given, h=0.1, methd="fvi")
    finally:
        motions.motion.cache_clear()


def test_the_recipe_for_conda_is_that_of_the_wheel():
    """Its text is YAML once its names are filled in, and its version, packages and python are those of setup.py."""
    yaml = pytest.importorskip("yaml")
    text, setup = (SOURCES / "meta.yaml").read_text(), (SOURCES / "setup.py").read_text()
    where, pattern = re.search(r'load_file_regex\("(.*?)", \'(.*?)\'', text).groups()
    version = re.search(pattern, (pathlib.Path("src") / where.removeprefix("include/")).read_text())[1]
    assert version == fvi.version() == fvi.__version__
    values = {"version": version, "PYTHON": "python", "compiler('c')": "gcc"}
    filled = re.sub(r"\{\{ (.*?) \}\}", lambda m: values[m[1]], re.sub(r"^\{%.*%\}$", "", text, flags=re.M))
    recipe = yaml.safe_load(filled)
    assert recipe["package"] == {"name": "fvi", "version": version} and recipe["source"] == {"path": "."}
    needs = re.findall(r'"([\w>=.]+)"', re.search(r"install_requires=\[(.*?)\]", setup)[1])
    least = re.search(r'python_requires="(.*?)"', setup)[1]
    plain = [each.replace(" ", "") for each in recipe["requirements"]["run"]]
    assert sorted(plain) == sorted([*needs, f"python{least}"])
    assert {"setuptools", "wheel", "gsl", "suitesparse"} <= set(recipe["requirements"]["host"])
    assert recipe["test"] == {"imports": ["fvi"], "commands": ["python -m fvi --version"]}
    assert "pip install . " in recipe["build"]["script"] and recipe["about"]["license"] in setup


def test_poles_take_no_steps_and_speak_of_none():
    """Also of several dampers, for which solve would choose a method with a warning."""
    import warnings
    frame = fvi.Problem(M=np.eye(2), K=[[2, -1], [-1, 1]], dampers=[([1, 0], "power:0.2,0.3"), ([-1, 1], "zener:1,0.3,2")])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert len(fvi.poles(frame).frequency) > 0 and fvi.response(frame, [1.0, 2.0]).shape == (2,)


def test_the_order_2_says_which_methods_have_its_derivative():
    q = fvi.Problem(alpha=1, rho=0.4, time=2)
    with pytest.raises(fvi.Error, match="^at alpha = 1 fvi-lobatto2 to 8 have no derivative by alpha.*2d to 8d have"):
        fvi.vjp(fvi.solve(q, h=0.1, method="fvi-lobatto4"), x=1.0)
    assert np.isfinite(fvi.vjp(fvi.solve(q, h=0.1, method="fvi-lobatto4d"), x=1.0)["alpha"])
