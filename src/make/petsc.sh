#!/bin/sh
# petsc.sh BUILD   Compile src/petsc/ and let its ranks agree with one machine (make petsc).
#
# PETSc is never brought: where it or MPI is missing, that is said, and all is well.
set -eu
build=$1
for tool in mpicc mpirun; do
    command -v $tool >/dev/null || missing="${missing-} $tool"
done
pkg-config --exists petsc 2>/dev/null || missing="${missing-} petsc"
if test -n "${missing-}"; then
    echo "petsc: left out, program and test, for want of:$missing (Debian: apt-get install petsc-dev)"
    exit 0
fi
# -pedantic and -Wconversion speak of PETSc's own macros. A function that is not of the shape
# that the library calls would read another argument than it was given.
FLAGS="$(echo "$FLAGS" | sed 's/-pedantic//; s/-Wconversion//') -Werror=incompatible-pointer-types"
compile() {
    mpicc $FLAGS -Isrc $(pkg-config --cflags petsc) "$@" "$build"/input/*.o "$build/output/fvi_output.o" "$build/libfvi.a" \
        $LIBS $(pkg-config --libs petsc) -lm
}
compile src/petsc/*.c -o "$build/fvi_petsc"
compile $(ls src/petsc/*.c | grep -v fvi_petsc.c) tests/program/petsc_failures.c -o "$build/petsc_failures"
# Root is let in, more ranks than cores too; else ranks and the threads of BLAS fight.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_mpi_yield_when_idle=1 OPENBLAS_NUM_THREADS=1
"$build/petsc_failures" -malloc_debug
$PYTHON tests/program/test_petsc.py "$build"
$PYTHON tests/program/test_petsc_dampers.py "$build"
test -z "${COST-}" || $PYTHON tests/program/petsc_cost.py "$build" # for figures/blocks/petsc_cost.tsv
