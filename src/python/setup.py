"""The wheel of the Python package `fvi`, with the library inside.

`make python` lays out build/python/package: these files, the headers and the compiled
library; from there it makes the wheel, and `pip install build/python/package` works, too.

One wheel serves every Python from 3.10 on (the limited API). GSL and SuiteSparse travel along: their
shared objects lie beside the module and are found there before any others; and so does the program."""
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


SYSTEM_LIBRARIES = re.compile(r"linux-vdso|ld-linux|lib(c|m|dl|rt|pthread|gcc_s)[.]so")


LIBRARY_FOLDER = pathlib.Path(subprocess.run(["pkg-config", "--variable=libdir", "gsl"], check=True,
                                        capture_output=True, text=True).stdout.split()[0])


def bring(name, done):
    """A shared object and what it needs, copied into the package under the names that are asked for."""
    if name in done or SYSTEM_LIBRARIES.match(name):
        return
    done.add(name)
    text = subprocess.run(["objdump", "-p", LIBRARY_FOLDER / name], check=True, capture_output=True, text=True).stdout
    shutil.copy((LIBRARY_FOLDER / name).resolve(), HERE / "fvi" / re.search(r"SONAME\s+(\S+)", text)[1])
    for other in re.findall(r"NEEDED\s+(\S+)", text):
        bring(other, done)


def bring_libraries():
    """GSL, and what factorises sparse matrices: SuiteSparse and what that needs."""
    done = set()
    for name in ("gsl", "gslcblas", "cholmod", "umfpack"):
        text = subprocess.run(["objdump", "-p", LIBRARY_FOLDER / f"lib{name}.so"], check=True, capture_output=True, text=True).stdout
        bring(re.search(r"SONAME\s+(\S+)", text)[1], done)


version = re.search(r'FVI_VERSION "(.*)"', (HERE / "include" / "fvi" / "version.h").read_text())[1]
bring_libraries()
setup(
    name="fvi",
    version=version,
    description="Mechanics with memory: motions with fractional damping by variational integrators, and their gradients",
    long_description=(HERE / "README.md").read_text(),
    long_description_content_type="text/markdown",
    license="GPL-3.0-or-later",
    classifiers=["Development Status :: 4 - Beta", "Intended Audience :: Science/Research", "Operating System :: POSIX :: Linux",
                 "Programming Language :: C", "Programming Language :: Python :: 3", "Topic :: Scientific/Engineering :: Physics",
                 "Typing :: Typed"],
    keywords="fractional derivative, viscoelasticity, springpot, variational integrator, adjoint, gradient",
    extras_require={"torch": ["torch"], "tables": ["pandas", "xarray"], "plot": ["matplotlib"]},
    packages=["fvi"],
    package_data={"fvi": ["py.typed", "_fvi.pyi", "*.so.*", "program"]},
    cffi_modules=["interface.py:ffi"],
    install_requires=["cffi>=1.15", "numpy"],
    python_requires=">=3.10",
    options={"bdist_wheel": {"py_limited_api": "cp310"}},
)
