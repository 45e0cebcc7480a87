"""The scripts of the figures that move, into a folder.      Used by book/build.py

kernel.js has the C, live.js what they share; then there is one script a figure, by its
picture's name. All are classic scripts: a page from a disk may load no others."""
import pathlib
import shutil
import sys

HERE = pathlib.Path(__file__).parent
PLAY = HERE.parent / "play"
sys.path.append(str(PLAY))
import wasm  # noqa: E402

SOURCES = [PLAY / "play.c", PLAY / "gsl.c", PLAY / "strtod.c", HERE / "live.c", HERE / "inverse.c"]
MODULES = [*wasm.MODULES, "linearised", "history_modes", "memory_nodes", "integration_by_parts", "half_derivative", "discrete_principle",
           "sensitivity", "adjoint", "checkpointing", "adjoint_multistep", "adjoint_kernel", "adjoint_multistep_damping", "adjoint_multistep_alone", "adjoint_constant", "adjoint_filter", "adjoint_stages", "control", "identification_tangent"]
# Of the exponentials those of many masses, of gradients those of steps and methods that no figure has.
ABSENT = [*wasm.ABSENT, *"""fvi_kernel_poles fvi_history_tiled_alloc fvi_history_tiled_bytes fvi_adjoint_variable fvi_adjoint_lobatto_end
    fvi_adjoint_lobatto_start fvi_adjoint_lobatto_step fvi_tangent_stages_start fvi_tangent_stages_step
    fvi_impulses_of_slope_alloc fvi_adjoint_lobatto_jump fvi_adjoint_dampers_check fvi_adjoint_dampers_end
    fvi_adjoint_dampers_free fvi_adjoint_dampers_start fvi_adjoint_dampers_step fvi_adjoint_slope_of
    fvi_adjoint_slope_symbol fvi_adjoint_has_slope fvi_adjoint_slope_begin_at
    fvi_adjoint_mechanism_check fvi_adjoint_mechanism_run""".split()]
SHARED = [PLAY / "model.js", PLAY / "plot.js", HERE / "live.js", HERE / "labels.js", HERE / "address.js", HERE / "orders.js", HERE / "modes.js"]
WORDS = "scene, scenes, frame, begin, addressOf, asked, open, start, settled, axes, span, short, readColours, stopsOf, orders, modes"


def write(out):
    out.mkdir(parents=True)
    code = wasm.compile_to(out / "live.wasm", SOURCES, MODULES, ABSENT)
    (out / "live.wasm").unlink()
    (out / "kernel.js").write_text(f'const FVI_WASM = "{wasm.packed(code)}";\n')
    shared = "\n".join(path.read_text() for path in SHARED)
    (out / "live.js").write_text(f"const FVI_LIVE = (() => {{\n{shared}\nreturn {{ {WORDS} }};\n}})();\n")
    for path in HERE.glob("*.js"):
        if path not in SHARED:
            shutil.copy(path, out)
