"""C to WebAssembly, for the live page and for the figures of the book that move."""
import base64
import pathlib
import subprocess
import sys
import tempfile

PLAY = pathlib.Path(__file__).parent
# What a run of the page takes of src/.
MODULES = """band error expression expression_parse expression_values lagrangian lu newton newton_stages potentials system tape coefficients convolution_quadrature lobatto_history lobatto_modes
    lobatto_nodes lobatto_rules lobatto_weights memory history_direct past impulses run_check solution step_force trajectory
    convolution_quadrature_stability stability stability_explicit stability_step
    convolution_quadrature_dampers convolution_quadrature_methods damping damping_sums discrete_mechanics fvi stability_number lobatto lobatto_damped
    lobatto_start initial_history_force run_damper exact_inverse exact_pole exact_solution""".split()
# What they call and no page reaches: other laws of damping, matrices, many masses at once, the
# stability of the explicit method. It is imported, and says its name if it is called all the same
# (kernel() of model.js); any other name that is missing stops the link.
ABSENT = """fvi_kernel_at fvi_kernel_check fvi_kernel_growth fvi_kernel_history fvi_kernel_symbol
    fvi_kernel_of_function fvi_kernel_takes_caputo fvi_shifted_symbol
    fvi_lobatto_kernel_free fvi_lobatto_kernel_nodes fvi_lobatto_kernel_prepare fvi_lobatto_kernel_weights
    fvi_events_check fvi_lobatto_matrices_start fvi_mechanism_start fvi_damping_begin_matrices fvi_check_dampers_of_matrices
    fvi_impulses_of_kernel_alloc fvi_impulses_of_kernel_at fvi_impulses_of_kernel_at_stages fvi_impulses_of_kernel_copy fvi_impulses_of_kernel_free
    fvi_stability_of_matrices fvi_damping_multiply
    gsl_complex_abs gsl_eigen_nonsymm gsl_eigen_nonsymm_alloc gsl_eigen_nonsymm_free
    gsl_eigen_nonsymm_params
    gsl_vector_complex_alloc gsl_vector_complex_free gsl_vector_complex_get""".split()
# A run of the live page is no linearised one, and keeps its whole past.
NOT_LINEARISED = "fvi_linearised_force fvi_newton_by_linearised".split()
NO_EXPONENTIALS = [f"fvi_history_modes_{act}" for act in "alloc bytes delta plan".split()]
# Small code, linked as a whole. As the Makefile has it: no contraction to fma, or the last digits
# would differ. The stack comes first in memory: what needs more of it ends in a trap, and does not
# write over other numbers. Of the figures that move one needs between 128 and 160 kB.
FLAGS = ("--target=wasm32-wasi -std=c11 -Oz -flto -mbulk-memory -mnontrapping-fptoint -ffp-contract=off "
         "-Wall -Wextra -Wconversion -Wshadow -pedantic -Wno-complex-component-init -nostartfiles -Isrc "
         "-Wl,--no-entry,--strip-all,--compress-relocations,--stack-first,-z,stack-size=262144").split()


def compile_to(wasm, sources, modules, absent):
    """sources: C files; modules: names of files in the rooms of src/; absent: what they may call
    that is missing, and do call. Returns the bytes."""
    headers = subprocess.run(["pkg-config", "--variable=includedir", "gsl"],
                             check=True, capture_output=True, text=True).stdout.strip()
    files = [*sources, PLAY / "no_lanes.c", *(next(pathlib.Path("src").glob(f"*/{name}.c")) for name in modules)]
    names = wasm.with_suffix(".absent")
    names.write_text("\n".join(absent))
    missing = f"-Wl,--error-limit=0,--allow-undefined-file={names}"
    if subprocess.run(["clang", *FLAGS, missing, "-idirafter", headers, *files, "-o", wasm]).returncode:
        sys.exit("the page's C does not link: chapters/play/wasm.py lists its modules and what may be absent")
    names.unlink()
    code = wasm.read_bytes()
    spare = [name for name in absent if bytes([len(name)]) + name.encode() not in code]
    if spare:
        sys.exit(f"listed as absent, and not called: {' '.join(spare)}")
    if b"wasi_snapshot" in code:  # a page has no files: printf and its kin belong into no module above
        sys.exit("the page's C asks for a system: some module prints")
    return code


def packed(code):
    """Deflated, in base64: text for a script. zopfli takes seconds, and a twentieth less room than zlib."""
    with tempfile.NamedTemporaryFile() as file:
        file.write(code)
        file.flush()
        deflated = subprocess.run(["zopfli", "--zlib", "-c", file.name], capture_output=True, check=True).stdout
    return base64.b64encode(deflated).decode()
