#!/bin/sh
# need.sh [--bring] TOOL...   Is everything here that a goal needs?
#
# Says what is missing and ends with 1. With --bring it installs it, from Debian's
# packages, as root or by sudo, and says first what it is about to install.
set -u
bring=
test "${1-}" = --bring && bring=yes && shift

have() {
    case $1 in
    cc) command -v "${CC%% *}" ;;
    gsl | check) pkg-config --exists "$1" ;;
    cerf) pkg-config --exists libcerf ;;
    cholmod) test -e /usr/include/suitesparse/umfpack.h || printf '#include <suitesparse/%s.h>\n' cholmod umfpack | ${CC%% *} -E - ;;
    gnuplot) command -v "$GNUPLOT" ;;
    python) command -v "$PYTHON" ;;
    sympy | numpy | cffi | setuptools | wheel | pytest | nbclient | nbformat | ipykernel | matplotlib) "$PYTHON" -c "from importlib.util import find_spec; raise SystemExit(not find_spec('$1'))" ;;
    Python.h) "$PYTHON" -c "import os, sysconfig; raise SystemExit(not os.path.exists(sysconfig.get_path('include') + '/Python.h'))" ;;
    pdfinfo) command -v pdfinfo && command -v pdftotext ;;
    wasm) command -v clang && command -v wasm-ld && test -e /usr/lib/wasm32-wasi/libc.a && command -v zopfli ;;
    *) command -v "$1" ;;
    esac >/dev/null 2>&1
}

packages() {
    case $1 in
    cc) echo gcc libc6-dev ;;
    gsl) echo pkg-config libgsl-dev ;;
    check) echo pkg-config check ;;
    cerf) echo libcerf-dev ;;
    cholmod) echo libsuitesparse-dev ;;
    gnuplot) echo gnuplot-nox ;;
    python) echo python3 ;;
    Python.h) echo python3-dev ;;
    sympy) echo python3-sympy python3-mpmath python3-gmpy2 ;; # without the last proofs hold, too, a third more slowly
    numpy | cffi | setuptools | wheel | pytest | nbclient | nbformat | ipykernel | matplotlib) echo "python3-$1" ;;
    wasm) echo clang lld wasi-libc libclang-rt-dev-wasm32 zopfli ;;
    node) echo nodejs ;;
    pdfinfo) echo poppler-utils ;;
    *) echo "$1" ;;
    esac
}

lacks=
for tool; do
    have "$tool" || lacks="$lacks $(packages "$tool")"
done
test -z "$lacks" && exit 0

sudo=
test "$(id -u)" = 0 || sudo="sudo "
line="${sudo}apt-get install -y --no-install-recommends$lacks"
if test -z "$bring"; then
    echo "missing:$lacks" >&2
    echo "on Debian, type: $line" >&2
    exit 1
fi
command -v apt-get >/dev/null || { echo "missing; please install (Debian's names):$lacks" >&2; exit 1; }
test -z "$sudo" || command -v sudo >/dev/null || { echo "missing; as root, type: apt-get install -y$lacks" >&2; exit 1; }
echo "this needs$lacks; running: $line" >&2
${sudo}apt-get update -qq && DEBIAN_FRONTEND=noninteractive $line >/dev/null && exit 0
echo "that failed; please type: $line" >&2
exit 1
