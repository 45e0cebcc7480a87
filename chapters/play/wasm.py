"""C to WebAssembly, for the live page and for the figures of the book that move."""
import base64
import pathlib
import subprocess
import zlib

PLAY = pathlib.Path(__file__).parent
# What a run of the page takes of src/.
MODULES = """band error expression expression_parse newton newton_stages system tape coefficients convolution_quadrature lobatto_memory
    lobatto_nodes lobatto_rules lobatto_weights memory memory_direct past impulses trajectory
    convolution_quadrature_stability stability stability_explicit stability_step
    convolution_quadrature_methods damping discrete_mechanics fvi loads lobatto lobatto_damped
    lobatto_start pull exact_inverse exact_pole exact_solution""".split()
# Small code, linked as a whole; what a page never calls need not be there, and traps. As the
# Makefile has it: no contraction to fma, or the last digits would differ.
FLAGS = ("--target=wasm32-wasi -std=c11 -Oz -flto -mbulk-memory -mnontrapping-fptoint -ffp-contract=off "
         "-Wall -Wextra -Wconversion -Wshadow -pedantic -nostartfiles -Isrc "
         "-Wl,--no-entry,--strip-all,--compress-relocations,--unresolved-symbols=ignore-all,-z,stack-size=131072").split()


def compile_to(wasm, sources, modules):
    """sources: C files; modules: names of files in the rooms of src/. Returns the bytes."""
    headers = subprocess.run(["pkg-config", "--variable=includedir", "gsl"],
                             check=True, capture_output=True, text=True).stdout.strip()
    files = [*sources, *(next(pathlib.Path("src").glob(f"*/{name}.c")) for name in modules)]
    subprocess.run(["clang", *FLAGS, "-idirafter", headers, *files, "-o", wasm], check=True)
    return wasm.read_bytes()


def packed(code):
    """Deflated, in base64: text for a script."""
    return base64.b64encode(zlib.compress(code, 9)).decode()


