"""Refuse code that gathers a largest or least number so that a NaN is lost.      lost_nan.py

fmax(NaN, 1) is 1, and a comparison with NaN is false. So `worst = fmax(worst, fabs(e))`, with GSL_MAX
too, and `if (e > worst) worst = e` pass over a run of NaN, and the test says yes to it. larger() and
smaller() of src/system/larger.h keep a NaN. Tests and figures judge numbers; there fmax and
fmin are refused altogether. Python's max(1, NaN) is 1, so proofs gather by largest() and smallest() of
verify/shared/refgen.py. Exit 1 with a list of places. Only Python's standard library is used."""
import pathlib
import re
import subprocess
import sys

PLACE = r"(?<![\w.>])(?P<place>\*?[A-Za-z_]\w*(?:\[[^\]]*\]|->\w+|\.\w+)*)"
NOW = r"[^;{}?]+?"
LOSES = [re.compile(pattern) for pattern in (
    rf"{PLACE}\s*=\s*(?:\(\w+\)\s*)?(?:f(?:max|min)[fl]?|GSL_M(?:AX|IN)(?:_DBL|_LDBL)?)\(\s*(?P=place)\s*,",
    rf"{PLACE}\s*=\s*(?:\(\w+\)\s*)?(?:f(?:max|min)[fl]?|GSL_M(?:AX|IN)(?:_DBL|_LDBL)?)\([^;]*,\s*(?P=place)\s*\)\s*;",
    rf"if \((?P<now>{NOW})\s*[<>]=?\s*{PLACE}\)\s*(?:\{{\s*(?P=place)\s*=\s*(?P=now)\s*;\s*\}}|(?P=place)\s*=\s*(?P=now)\s*;)",
    rf"if \({PLACE}\s*[<>]=?\s*(?P<now>{NOW})\)\s*(?:\{{\s*(?P=place)\s*=\s*(?P=now)\s*;\s*\}}|(?P=place)\s*=\s*(?P=now)\s*;)",
    rf"{PLACE}\s*=\s*(?P<now>{NOW})\s*[<>]=?\s*(?P=place)\s*\?\s*(?:(?P=now)\s*:\s*(?P=place)|(?P=place)\s*:\s*(?P=now))\s*;",
    rf"{PLACE}\s*=\s*(?P=place)\s*[<>]=?\s*(?P<now>{NOW})\s*\?\s*(?:(?P=now)\s*:\s*(?P=place)|(?P=place)\s*:\s*(?P=now))\s*;",
)]
PROOF = re.compile(r"(?P<place>\b[A-Za-z_]\w*) = (?:max|min)\((?:(?P=place),|[^\n]*, (?P=place)\)$)", re.M)
ANY = re.compile(r"\b(?:f(?:max|min)|GSL_M(?:AX|IN))\(")


def faults(path, text):
    """(line, code) of each place where a NaN would be lost."""
    judges = path.startswith(("tests/", "figures/"))
    for pattern in [PROOF] if path.endswith(".py") else [*LOSES, *([ANY] if judges else [])]:
        for match in pattern.finditer(text):
            yield text.count("\n", 0, match.start()) + 1, " ".join(match[0].split())


def main():
    examples = ("worst = fmax(worst, fabs(e));", "w[i] = fmin(a, w[i]);", "if (e > worst)\n    worst = e;",
                "if (least > e) { least = e; }", "worst = e > worst ? e : worst;", "m->least = m->least < e ? m->least : e;",
                "n = (int)fmax(n, 2);", "off =\n    GSL_MAX(off, fabs(e));")
    for code in examples:
        if not list(faults("src/example.c", code)):
            sys.exit(f"{sys.argv[0]} does not see {code}")
    if not list(faults("verify/example.py", "worst = max(worst, abs(e))")):
        sys.exit(f"{sys.argv[0]} does not see max in a proof")
    paths = subprocess.run(["git", "ls-files", "*.c", "*.h", "verify/*.py"], capture_output=True, text=True,
                           check=True).stdout.splitlines()
    found = sorted({f"{path}:{line}: {code}" for path in paths if pathlib.Path(path).exists()
                    for line, code in faults(path, pathlib.Path(path).read_text())})
    if found:
        sys.exit("\n".join(found) + "\na NaN is lost here: larger() and smaller() of src/system/larger.h keep it, and "
                 "largest() and smallest() of verify/shared/refgen.py")


main()
