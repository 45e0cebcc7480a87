"""What of the library Python calls, compiled by cffi into fvi._fvi.

The declarations of the folder beside repeat those of src/fvi/*.h, as far as they are needed. In a struct `...;` stands for all other
fields: the compiler finds the places. tests/python/test_python_interface.py compares all of them with the headers."""
import pathlib
import shlex
import subprocess

from cffi import FFI

HERE = pathlib.Path(__file__).resolve().parent

ffi = FFI()
for part in ("run", "problem", "analysis", "own"):
    ffi.cdef((HERE / "declarations" / f"{part}.h").read_text())


def flags(what):
    return shlex.split(subprocess.run(["pkg-config", what, "gsl"], check=True,
                                      capture_output=True, text=True).stdout)


ffi.set_source(
    "fvi._fvi",
    (HERE / "glue.h").read_text(),
    include_dirs=[str(HERE / "include"), str(HERE)],
    extra_compile_args=["-std=c11", "-Werror=incompatible-pointer-types", *flags("--cflags")],
    extra_objects=[str(HERE / "libfvi.a")],
    # GSL's own products come before those of the library that SuiteSparse needs: the program's digits.
    extra_link_args=["-Wl,--no-as-needed", *flags("--libs"), "-lumfpack", "-lcholmod", "-Wl,--disable-new-dtags", "-Wl,-rpath,$ORIGIN"],
    py_limited_api=True,
)
