"""The live page as one file.      build.py OUT     (make play)

clang compiles play.c and the modules of src/ to WebAssembly, with GSL's headers
and gsl.c instead of GSL; the bytes, deflated, and the scripts go into page.html,
so that OUT/index.html opens from a disk and asks nobody for anything. The C library
is wasi-libc's, 12.5 kB of the page, but for its allocator: that would be 4.8 kB more,
and malloc.c does what the page needs."""
import pathlib
import re
import sys

from wasm import ABSENT, MODULES, NO_EXPONENTIALS, NOT_LINEARISED, compile_to, packed

HERE = pathlib.Path(__file__).parent
OUT = pathlib.Path(sys.argv[1])
SOURCES = [HERE / f"{name}.c" for name in ("play", "gsl", "malloc", "strtod")]


def main():
    OUT.mkdir(parents=True, exist_ok=True)
    code = compile_to(OUT / "play.wasm", SOURCES, MODULES, [*ABSENT, *NO_EXPONENTIALS, *NOT_LINEARISED])
    page = (HERE / "page.html").read_text()
    for name in ("theme.js", "model.js", "plot.js", "explain.js", "play.js"):
        script = re.sub(r"^\s*//.*\n", "", (HERE / name).read_text(), flags=re.M)  # the comments stay here
        page = page.replace("{" + name + "}", script.strip())
    text = packed(code)
    page = page.replace("{wasm}", text)
    (OUT / "index.html").write_text(page)
    print(f"{OUT}/index.html: {len(page)} bytes; WebAssembly {len(code)}, packed {len(text)}")


main()
