"""The wheel of the Python package `fvi`, with the library inside.

`make python` lays out build/python/package: these files, the headers and the compiled
library; from there it makes the wheel, and `pip install build/python/package` works, too.

One wheel serves every Python from 3.10 on (the limited API). GSL travels along: its two
shared objects lie beside the module and are found there before any others."""
import os
import pathlib
import re
import shutil
import subprocess

from setuptools import setup

HERE = pathlib.Path(__file__).resolve().parent
os.chdir(HERE)
if not (HERE / "libfvi.a").exists():
    raise SystemExit("the library is not here: type `make python` in the top folder of the project")


def bring_gsl():
    """The shared objects of GSL, copied into the package under the names that are asked for."""
    flags = subprocess.run(["pkg-config", "--variable=libdir", "gsl"], check=True,
                           capture_output=True, text=True).stdout.split()
    for stem in ("libgsl", "libgslcblas"):
        real = (pathlib.Path(flags[0]) / f"{stem}.so").resolve()
        text = subprocess.run(["objdump", "-p", real], check=True, capture_output=True, text=True).stdout
        shutil.copy(real, HERE / "fvi" / re.search(r"SONAME\s+(\S+)", text)[1])


version = re.search(r'FVI_VERSION "(.*)"', (HERE / "include" / "fvi" / "version.h").read_text())[1]
bring_gsl()
setup(
    name="fvi",
    version=version,
    description="Fractional variational integrators",
    license="GPL-3.0-or-later",
    packages=["fvi"],
    package_data={"fvi": ["py.typed", "libgsl*.so.*"]},
    cffi_modules=["interface.py:ffi"],
    install_requires=["cffi>=1.15", "numpy"],
    python_requires=">=3.10",
    options={"bdist_wheel": {"py_limited_api": "cp310"}},
)
