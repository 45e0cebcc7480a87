"""Each example in the comments of the public headers compiles, and what can stand alone runs.

    header_examples.py BUILD        (make test-headers, a part of make text)

An example is a paragraph of a comment that is indented by five blanks, names something of the library, and ends with
a semicolon or a brace. It becomes the body of a function, and all of them one program. A #line with its header and line
stands above it, so the compiler names the place of a mistake. An example may use what the text above it speaks of:
AROUND and FOREIGN declare it, and OWN where a name means something else in one header. An example that needs AROUND
alone is run, and the numbers in a comment at its end, `// 1.5, -2, 0.5` or `// order = 2`, must be what it has
computed. CC, FLAGS and LIBS come from the Makefile. Only Python's standard library is used."""
import os
import pathlib
import re
import shlex
import subprocess
import sys

BUILD = pathlib.Path(sys.argv[1])
HEADERS = sorted(pathlib.Path("src/fvi").rglob("*.h"))
COMPILE = [*shlex.split(os.environ["CC"]), "-Isrc", *shlex.split(os.environ.get("FLAGS", ""))]
STRICT = ["-std=c11", "-pedantic-errors", "-Wall", "-Wextra", "-Werror", "-Wno-unused", "-Wno-uninitialized"]

# One body on a spring, its run of four steps, and room for what is computed. N, 4, is the number of steps.
AROUND = """
enum { N = 4 };
const double h = 0.1, alpha = 0.3, T = 1, t = 0.2, omega = 2, W = 1, R = 1;
const double one_mass = 1, one_damping = 0.2, one_spring = 4;
double x0[] = { 1 }, p0[] = { 0.5 }, v0[] = { 0.5 }, x[N + 1] = { 0 }, p[N + 1] = { 0 }, y[N + 1] = { 0 };
double dx[N + 1] = { 0 }, u[N + 1] = { 0 }, v[N + 1] = { 0 }, w[N + 1] = { 0 }, H[N + 1] = { 0 }, force, first, re, im;
char text[4000] = "";
int status = 0;
fvi_error error = { 0 };
fvi_system system = { .d = 1, .mass = &one_mass, .damping = &one_damping,
                      .potential = fvi_potential_harmonic(&one_spring) };
fvi_run run = fvi_run_default(&system, x0, p0, h, N);
fvi_stepper *s = NULL, *stepper = NULL;
const fvi_method *method = &fvi_fractional;
const fvi_kernel_term springpot_term = { .kind = FVI_KERNEL_POWER, .rho = 1, .alpha = 0.3 };
const fvi_kernel law = { 1, &springpot_term }, springpot = law;
fvi_error_bound bound;
if (fvi_stepper_start(method, &run, &s, &error)) return -1;
"""

# What examples only speak of: functions, files, and answers of examples before them.
FOREIGN = """
double by_x0[1], by_damping[1], row[N + 1], storage[N + 1], loss[N + 1], C[N + 1], half_integral[N + 1], next[N + 1];
int is_stable, every_row_is_stored, params;
size_t n;
FILE *file;
fvi_objective nothing;
fvi_sensitivities gradients;
fvi_kernel zener, dashpot;
fvi_symbols names;
fvi_linear_oscillator problem;
fvi_accuracy accuracy;
fvi_outputs outputs;
fvi_user_parameters parameters;
fvi_typed_columns *c;
fvi_observer *o;
fvi_observation now;
fvi_control_result found;
fvi_expression *e;
fvi_history *memory;
fvi_directory *directory;
fvi_typed_damping damping;
fvi_exact_motion *motion;
fvi_estimation fit, plan;
fvi_estimate fitted, planned;
fvi_examination examined;
fvi_ground *ground;
fvi_response *response;
fvi_material material;
fvi_structure *structure;
"""

# Where a name means something else in one header.
OWN = {
    "batch.h": "fvi_run run[1600];",
    "damping_laws.h": "double x, dx, H;",
    "discrete_mechanics.h": "double x, y;",
    "error.h": "fvi_error *error;",
    "exact_solution.h": "double x, swing, tail;",
    "existence.h": "fvi_picard_problem problem;",
    "experiments.h": "fvi_force force;",
    "fractional_derivative.h": "double sine(double t, const void *params), cosine(double t, const void *params);",
    "identification.h": "double t[N + 1];",
    "integration_by_parts.h": "size_t d; double f[N + 1], g[N + 1], delta_minus_f[N + 1], delta_plus_g[N + 1];",
    "lagrangian.h": "int pendulum_on_a_cart(double t, size_t d, const double *x, const double *v, void *params, "
                    "double *L, double *Lx, double *Lv, double *Lxx, double *Lxv, double *Lvv);",
    "parse.h": "double r[1]; fvi_typed_force *force; "
               "int acceleration_of_the_table(double t, size_t d, void *params, double *F);",
    "restricted_principle.h": "fvi_powers x;",
    "spring_bound.h": "fvi_spring_bound bound;",
    "structures.h": "double k, roof[1]; fvi_sparse M, K, C, isolators;",
}


def examples(header):
    """(line, code) of each example; line is the number of its first line."""
    lines = header.read_text().split("\n")
    n = 0
    while n < len(lines):
        first = n
        while n < len(lines) and lines[n].startswith(" *     "):
            n += 1
        code = [re.sub(r"\s*\*/$", "", line[7:]) for line in lines[first:n]]
        if code and lines[first - 1].strip() == "*" and re.search(r"[;}]$", re.sub(r"\s*//.*", "", code[-1])) \
                and "fvi_" in "\n".join(code):
            yield first + 1, code
        n = max(n, first + 1)


def lines_outside(code):
    """How many lines of an example stand before its function: up to the end of the last function that it has itself."""
    ends = [n for n, line in enumerate(code) if line == "}" or re.match(r"static .*\) \{.*\}$", line)]
    return ends[-1] + 1 if ends and re.match(r"(static|typedef) ", code[0]) else 0


def expected(code):
    """(array or variable, its numbers as texts) of each number that the comment at the end says."""
    comment = re.search(r"//(?:.*:)?\s*([^:]*)$", code[-1])
    number = r"-?\d+(?:\.\d+(?:\.\.\.)?)?(?:e-?\d+)?"
    names = re.findall(r"\bdouble (?:\w+, )*(\w+)\[", "\n".join(code))
    if comment and names and re.fullmatch(rf"{number}(, {number})*", comment[1]):
        return [(names[-1], comment[1].split(", "))]
    if comment and re.fullmatch(rf"[\w.]+ = {number}(, (?:[\w.]+ = )?{number})*", comment[1]):
        each = re.findall(rf"([\w.]+) = ({number}(?:, {number})*)", comment[1])
        return [(name, numbers.split(", ")) for name, numbers in each]
    return []


def checks(header, line, code):
    """Comparisons of what an example has computed with the numbers in its comment."""
    for name, numbers in expected(code):
        for i, text in enumerate(numbers):
            what = f"{name}[{i}]" if len(numbers) > 1 else name
            digits = len(re.sub(r"^-?0\.0*|e.*|\D", "", text))
            near = 0.5 * 10.0**(1 - digits) if "..." in text or "e" in text else 1e-12
            yield f'expect("{header}:{line}", "{what}", {what}, {text.rstrip(".")}, {near});'


def function(number, header, line, code, foreign):
    """One example as a function of C. Its names are those of the innermost braces."""
    outside, place = lines_outside(code), f'"{header}"'
    around = [FOREIGN, "{", OWN.get(header.name, "")] if foreign else ["{"]
    return [f"#line {line} {place}", *code[:outside], f"static int example_{number}(void) {{", AROUND, "{", *around,
            "{", f"#line {line + outside} {place}", *code[outside:], *([] if foreign else checks(header, line, code)),
            "}}} return 0; }"]


HEAD = [f"#include <{header.relative_to('src')}>" for header in HEADERS] + """
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
static void expect(const char *place, const char *what, double got, double want, double near)
{
    if (!(fabs(got - want) <= near * (fabs(want) + (want == 0)))) {
        fprintf(stderr, "%s: %s is %.10g, and the comment says %g\\n", place, what, got, want);
        exit(1);
    }
}
""".split("\n")


def compiled(name, text, *options):
    """What the compiler says of this program."""
    source = BUILD / "headers" / name
    source.parent.mkdir(parents=True, exist_ok=True)
    source.write_text("\n".join(text) + "\n")
    return subprocess.run([*COMPILE, *STRICT, str(source), *options], capture_output=True, text=True,
                          env=dict(os.environ, LC_ALL="C")).stderr


def main():
    found = [(header, line, code) for header in HEADERS for line, code in examples(header)]
    if len(found) < 100:
        sys.exit(f"{len(found)} examples in headers: most are not seen")
    whole = [line for n, example in enumerate(found) for line in function(n, *example, True)]
    wrong = compiled("all.c", HEAD + whole + ["int main(void) { return 0; }"], "-fsyntax-only")
    if wrong:
        sys.exit(wrong + "an example in a header does not compile")
    runs, wrong_lines = range(len(found)), {None}
    while wrong_lines:  # clang says the first 20 mistakes only
        alone = [line for n in runs for line in function(n, *found[n], False)]
        said = compiled("alone.c", HEAD + alone + ["int main(void) { return 0; }"], "-fsyntax-only")
        wrong_lines = {(place, int(n))
                       for place, n in re.findall(r"^(src/fvi/[\w/]+\.h):(\d+):\d+: error", said, re.M)}
        runs = [n for n in runs for header, line, code in [found[n]]
                if not any((str(header), at) in wrong_lines for at in range(line, line + len(code)))]
    calls = [f'fputs("@ {found[n][0]}:{found[n][1]}\\n", stderr); if (example_{n}() < 0) return 1;' for n in runs]
    bodies = [line for n in runs for line in function(n, *found[n], False)]
    text = HEAD + bodies + ["int main(void) {", *calls, "return 0; }"]
    program = BUILD / "headers" / "examples"
    program.unlink(missing_ok=True)
    wrong = compiled("runs.c", text, "-O0", "-Wno-error", "-o", str(program), str(BUILD / "libfvi.a"),
                     *shlex.split(os.environ["LIBS"]))
    done = subprocess.run([program], capture_output=True, text=True) if program.exists() else None
    if not done or done.returncode:
        sys.exit((done.stderr if done else wrong) + "an example in a header fails")
    print(f"examples in headers: {len(found)} compile, {len(runs)} run, "
          f"{sum(len(numbers) for n in runs for _, numbers in expected(found[n][2]))} numbers are as they say")


main()
