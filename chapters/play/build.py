"""The live page as one file.      build.py OUT     (make play)

clang compiles play.c and the modules of src/ to WebAssembly, with GSL's headers
and gsl.c instead of GSL; the bytes, deflated, and the scripts go into page.html,
so that OUT/index.html opens from a disk and asks nobody for anything. The C library
is wasi-libc's, 12.5 kB of the page, but for its allocator: that would be 4.8 kB more,
and malloc.c does what the page needs."""
import base64
import pathlib
import subprocess
import sys
import zlib

HERE = pathlib.Path(__file__).parent
OUT = pathlib.Path(sys.argv[1])
MODULES = """band error newton newton_stages system coefficients convolution_quadrature lobatto_memory
    lobatto_rules lobatto_weights memory past trajectory convolution_quadrature_stability stability
    stability_step convolution_quadrature_methods damping discrete_mechanics fvi loads lobatto
    lobatto_damped lobatto_start pull exact_inverse exact_pole exact_solution""".split()
# Small code, linked as a whole. As the Makefile has it: no contraction to fma, or the
# last digits would differ.
FLAGS = ("--target=wasm32-wasi -std=c11 -Oz -flto -mbulk-memory -mnontrapping-fptoint -ffp-contract=off "
         "-Wall -Wextra -Wconversion -Wshadow -pedantic -nostartfiles -Isrc "
         "-Wl,--no-entry,--strip-all,--compress-relocations,-z,stack-size=131072").split()


def compile_to(wasm):
    headers = subprocess.run(["pkg-config", "--variable=includedir", "gsl"],
                             check=True, capture_output=True, text=True).stdout.strip()
    modules = [next(pathlib.Path("src").glob(f"*/{name}.c")) for name in MODULES]
    sources = [HERE / "play.c", HERE / "gsl.c", HERE / "malloc.c", *modules]
    subprocess.run(["clang", *FLAGS, "-idirafter", headers, *sources, "-o", wasm], check=True)


def main():
    OUT.mkdir(parents=True, exist_ok=True)
    compile_to(OUT / "play.wasm")
    code = (OUT / "play.wasm").read_bytes()
    page = (HERE / "page.html").read_text()
    for name in ("model.js", "plot.js", "play.js"):
        page = page.replace("{" + name + "}", (HERE / name).read_text().strip())
    packed = zlib.compress(code, 9)
    page = page.replace("{wasm}", base64.b64encode(packed).decode())
    (OUT / "index.html").write_text(page)
    print(f"{OUT}/index.html: {len(page)} bytes; WebAssembly {len(code)}, deflated {len(packed)}")


main()
