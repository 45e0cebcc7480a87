"""The scripts of the figures that move, into a folder.      Used by book/build.py

kernel.js has the C, live.js what they share; then there is one script a figure, by its
picture's name. What one figure alone needs, structures, is a module of its own, building_kernel.js.
All are classic scripts: a page from a disk may load no others."""
import pathlib
import re
import shutil
import sys

HERE = pathlib.Path(__file__).parent
PLAY = HERE.parent / "play"
sys.path.append(str(PLAY))
import wasm  # noqa: E402

SOURCES = [PLAY / "play.c", PLAY / "gsl.c", HERE / "gsl_modes.c", PLAY / "strtod.c", HERE / "live.c", HERE / "inverse.c", HERE / "pendulum.c"]
MODULES = [*wasm.MODULES, "linearised", "history_modes", "memory_nodes", "integration_by_parts", "half_derivative", "discrete_principle",
           "sensitivity", "adjoint", "checkpointing", "held_dampers", "adjoint_multistep", "adjoint_multipliers", "node_terms", "adjoint_multistep_damping", "adjoint_multistep_alone", "constant_history", "order_filter", "potential_derivatives", "control", "identification_tangent", "tangent", "tangent_dampers", "tangent_nodes"]
# Of the exponentials those of many masses, of gradients those of steps and methods that no figure has.
ABSENT = [*wasm.ABSENT, *"""fvi_kernel_poles fvi_history_tiled_alloc fvi_history_tiled_bytes fvi_adjoint_variable fvi_adjoint_lobatto_end
    fvi_adjoint_lobatto_start fvi_adjoint_lobatto_step
    fvi_impulses_of_slope_alloc fvi_adjoint_lobatto_jump fvi_wanted_check_dampers fvi_kernel_derivative_of fvi_kernel_number_of
    fvi_kernel_derivative_symbol fvi_kernel_derivative_begin_at
    fvi_adjoint_mechanism_check fvi_adjoint_mechanism_run fvi_adjoint_mesh_check fvi_adjoint_mesh_run
    fvi_wanted_check_stage_laws fvi_adjoint_structure_check fvi_adjoint_structure_end fvi_adjoint_structure_free
    fvi_adjoint_structure_jump fvi_adjoint_structure_mesh fvi_adjoint_structure_start fvi_adjoint_structure_step
    fvi_lobatto_matrices_of fvi_stage_dampers_tolerance fvi_stage_terms_start fvi_stage_terms_stop fvi_tangent_stages_step""".split()]
BUILDING = [PLAY / "gsl.c", HERE / "gsl_modes.c", HERE / "building.c"]
BUILDING_MODULES = """structures structure_dampers damping_matrix sparse factors history_space convolution_quadrature_methods convolution_quadrature_dampers
    damping damping_matrices damping_sums initial_history_force kernel_history kernel_modes kernel_classes kernel_fractions symbol_poles kernel_sums kernel_general damping_laws
    coefficients convolution_quadrature history_direct history_modes memory memory_nodes past newton newton_stages band lu
    dampers_check run_check run_damper solution step_force trajectory impulses error system lagrangian""".split()
BUILDING_ABSENT = """fvi_cholmod_alloc fvi_cholmod_solve fvi_events_check fvi_impulses_of_kernel_alloc fvi_impulses_of_kernel_at
    fvi_impulses_of_kernel_copy fvi_impulses_of_kernel_free fvi_history_tiled_alloc fvi_history_tiled_bytes fvi_linearised_force
    fvi_newton_by_linearised fvi_shifted_symbol fvi_stability_number_none fvi_mechanism_start gsl_integration_glfixed_point
    gsl_integration_glfixed_table_alloc gsl_integration_glfixed_table_free gsl_fft_complex_radix2_forward""".split()
SHARED = [PLAY / "model.js", PLAY / "plot.js", HERE / "live.js", HERE / "labels.js", HERE / "address.js", HERE / "orders.js", HERE / "modes.js", HERE / "drawn.js"]
WORDS = "scene, scenes, frame, begin, kernelOf, libraryOf, goOn, again, addressOf, asked, start, settled, axes, span, short, orders, modes, drawn"


def script_of(name):
    """The script with the C of a figure."""
    named = re.search(r'^  kernel: \["(\w+)"', (HERE / f"{name}.js").read_text(), re.M)
    return named[1] if named else "kernel"


def write(out):
    out.mkdir(parents=True)
    for name, const, *what in (("kernel", "FVI_WASM", SOURCES, MODULES, ABSENT),
                               ("building_kernel", "FVI_WASM_BUILDING", BUILDING, BUILDING_MODULES, BUILDING_ABSENT)):
        code = wasm.compile_to(out / f"{name}.wasm", *what)
        (out / f"{name}.wasm").unlink()
        (out / f"{name}.js").write_text(f'const {const} = "{wasm.packed(code)}";\n')
    shared = "\n".join(path.read_text() for path in SHARED)
    (out / "live.js").write_text(f"const FVI_LIVE = (() => {{\n{shared}\nreturn {{ {WORDS} }};\n}})();\n")
    for path in HERE.glob("*.js"):
        if path not in SHARED:
            shutil.copy(path, out)
