"""The exercises by experiment: which answers are accepted.

Each function measures what its exercise asks for, by build/fvi or from a figure's data,
over the choices that the exercise leaves open, and gives for each number asked the least
and the largest that came out. `accepted` makes that wider by its own width and one per
cent. Only Python's standard library is used."""
import math
import pathlib
import subprocess
import sys

import workshop_run as runner

BUILD = pathlib.Path(sys.argv[1])


def fvi(command, **options):
    """The rows of a table, up to where a run ends: fvi("run", alpha=0.3, steps=10)."""
    words = [f"--{name.replace('_', '-')}={value}" for name, value in options.items()]
    done = subprocess.run([BUILD / "fvi", command, *words], capture_output=True, text=True)
    if done.returncode and "no longer finite" not in done.stderr:
        sys.exit(f"fvi {command} {' '.join(words)}: {done.stderr}")
    return [[float(word) for word in line.split()] for line in done.stdout.splitlines() if not line.startswith("#")]


def head(command, name, **options):
    """A number of the head: `# steps taken = 66`."""
    words = [f"--{key.replace('_', '-')}={value}" for key, value in options.items()]
    text = subprocess.run([BUILD / "fvi", command, *words], capture_output=True, text=True).stdout
    return float(next(line for line in text.splitlines() if line.startswith(f"# {name} = ")).rsplit("= ", 1)[1])


def column(command, **options):
    return [row[0] for row in fvi(command, **options)]


def end(**options):
    """x at the end of a run."""
    return column("run", columns="x", every=options["steps"], **options)[-1]


def weights(alpha, count):
    return [row[1] for row in fvi("coefficients", alpha=alpha, count=count)]


def orders(values):
    """The order that each three values say, from steps that were halved."""
    return [math.log2(abs((b - a) / (c - b))) for a, b, c in zip(values, values[1:], values[2:])]


def span(values):
    return min(values), max(values)


def half_derivative_of_t():
    slopes = []
    for shift in (0, 0.25):  # alpha/2 of a step
        errors = []
        for N in (50, 100, 200, 400):
            h, w = 1 / N, weights(0.5, N + 1)
            value = sum(w[n] * (1 - n * h) for n in range(N + 1)) / math.sqrt(h)
            errors.append(abs(value - 2 * math.sqrt((1 - shift * h) / math.pi)))
        slopes.append([math.log2(a / b) for a, b in zip(errors, errors[1:])])
    return [span(s) for s in slopes]


def energy_band():
    ratios = {0: [], 0.5: []}
    for kappa, found in ratios.items():
        widths = []
        for h in (0.2, 0.1, 0.05):
            energy = column("run", columns="energy", kappa=kappa, rho=0, potential="duffing:1,1", h=h,
                            steps=round(200 / h))
            widths.append(max(energy) - min(energy))
        found += [a / b for a, b in zip(widths, widths[1:])]
    return [span(found) for found in ratios.values()]


def first_power():
    slopes, early = [], (1e-3, 1e-2, 1e-1)
    missing = [t - column("exact", columns="x", alpha=0.3, potential="free", x0=0, p0=1, rho=1, time=t, steps=1)[-1]
               for t in early]
    slopes = [math.log10(b / a) for a, b in zip(missing, missing[1:])]
    return [span(slopes)]


def half_of_the_sum():
    total, n = 0, 0
    for n, w in enumerate(weights(0.1, 2000)):
        total += w
        if total < 0.5:
            break
    return [(n, n)]


def constant_of_a_constant():
    found = []
    for N in (100, 200, 400):
        found.append((sum(weights(0.5, N + 1)) * math.sqrt(N) - 1 / math.sqrt(math.pi)) * N)
    return [span(found)]


def end_term():
    size = [abs(weights(0.25, N + 1)[N]) / N ** 0.5 for N in (50, 100, 1000, 2000)]
    return [span([math.log2(size[0] / size[1]), math.log10(size[1] / size[2]), math.log2(size[2] / size[3])])]


def away_from_one_half():
    runs = {e: column("run", columns="x", derivative="rl", h=0.5, steps=30, alpha=0.5 - e)
            for e in (0, 0.04, 0.02, 0.01, 0.005)}
    return [span([max(abs(a - b) for a, b in zip(runs[e], runs[0])) / e for e in (0.02, 0.01, 0.005)])]


def which_mass():
    slopes = []
    for share in (0, 0.5):
        errors = []
        for h in (1 / 8, 1 / 16, 1 / 32):
            grid = dict(columns="x", h=h, steps=round(15 / h))
            ours = column("run", **grid)
            true = column("exact", mass=1 - share * 0.2 * h, **grid)
            errors.append(max(abs(a - b) for a, b in zip(ours, true)))
        slopes.append(span([math.log2(a / b) for a, b in zip(errors, errors[1:])]))
    return slopes


def order_and_past():
    return [span(orders([end(alpha=0.8, derivative=past, time=2, steps=N) for N in (80, 160, 320, 640)]))
            for past in ("rl", "caputo")]


def constant_of_the_error():
    found = []
    for N in (600, 1200, 2400):
        grid = dict(columns="x", time=15, steps=N)
        found.append(max(abs(a - b) for a, b in zip(column("run", **grid), column("exact", **grid))) * N / 15)
    return [span(found)]


def tail():
    grid = dict(columns="t,x", alpha=0.3, p0=0, time=1e4, steps=10)
    rows = fvi("exact", **grid)
    return [span([math.log(b[1] / a[1]) / math.log(b[0] / a[0]) for a, b in ((rows[1], rows[10]), (rows[2], rows[4]))])]


def tolerance_kept():
    worst = []
    for alpha in (0.25, 0.75):
        grid = dict(columns="x", alpha=alpha, h=0.01, steps=2000)
        true = column("run", memory="direct", **grid)
        near = column("run", memory="exponentials", tolerance=1e-6, **grid)
        worst.append(max(abs(a - b) for a, b in zip(true, near)))
    return [span(worst)]


def many_at_once():
    worst = []
    for alpha in (0.25, 0.75):
        grid = dict(columns="x", alpha=alpha, potential="chain:32,1,0", h=0.05, steps=1000)
        true = fvi("run", memory="direct", **grid)
        near = fvi("run", memory="exponentials", tolerance=1e-6, **grid)
        worst.append(max(abs(a - b) for row, other in zip(true, near) for a, b in zip(row, other)))
    return [span(worst)]


def orders_of_two():
    return [span(orders([end(method=method, alpha=0.4, time=2, steps=N) for N in (80, 160, 320, 640)]))
            for method in ("fvi", "fvi-shifted")]


def longest_step():
    low, high = 0.5, 4
    while high - low > 1e-3:
        h = (low + high) / 2
        grows = any(abs(x) > 1e3 for x in column("run", columns="x", alpha=0.25, rho=1, kappa=1, h=h, steps=2000))
        low, high = (low, h) if grows else (h, high)
    return [(low, high)]


def velocity_that_is_left():
    return [span([fvi("exact", columns="p", potential="free", rho=0.5, x0=0, p0=1, alpha=alpha, time=1,
                      steps=1)[-1][0] for alpha in (0.998, 0.999, 0.9999)])]


def energy_of_euler():
    rows = column("run", columns="energy", method="euler-explicit", rho=0, h=0.1, steps=10)
    return [span([b / a for a, b in zip(rows, rows[1:])])]


def order_of_lobatto():
    return [span(orders([end(method=method, alpha=0.3, time=2, steps=N) for N in (20, 40, 80, 160)]))
            for method in ("fvi-lobatto2", "fvi-lobatto3d")]


def honest():
    found = []
    for wish in (1e-2, 1e-3):
        grid = dict(columns="x", time=10, steps=10)
        error = max(abs(a - b) for a, b in zip(column("run", method="fvi", error=wish, **grid), column("exact", **grid)))
        found.append(error / head("run", "error estimate", method="fvi", error=wish, **grid))
    return [span(found)]


def two_pasts():
    ends = [column("exact", columns="x", alpha=0.75, time=20, steps=1, derivative=past)[-1]
            for past in ("held", "caputo")]
    return [(e, e) for e in ends]


def error_by_step():
    true = column("exact", columns="x", alpha=0.3, time=2, steps=1)[-1]
    return [span([(end(alpha=0.3, time=2, steps=N) - true) * N / 2 for N in (320, 640, 1280)])]


def pushed():
    found = []
    for push, answer in (("1,0,0", "x3"), ("0,0,1", "x1")):
        place = int(answer[1]) - 1
        found.append(fvi("run", columns="x", potential="chain:3,1,0", rho="0.1,0.2,0.3", alpha=0.3, x0=0, p0=push,
                         h=0.1, steps=100)[-1][place])
    return [(v, v) for v in found]


def steps_by_decade():
    counts = [head("run", "steps taken", method="fvi-adaptive", error=1e-8, alpha=0.3, rho=1, p0=0, time=T, steps=1)
              for T in (1e5, 1e6, 1e7, 1e8)]
    return [span([(counts[2] - counts[0]) / 2, (counts[3] - counts[1]) / 2, (counts[3] - counts[0]) / 3])]


def least_answer():
    best = {}
    for name in ("rho", "alpha"):
        size = {}
        for tenth in range(11):
            out = subprocess.run([BUILD / "fvi", "gradient", f"--alpha={tenth / 10}"], capture_output=True, text=True)
            row = next(line for line in out.stdout.splitlines() if line.startswith(name + "\t"))
            size[tenth / 10] = abs(float(row.split()[1]))
        best[name] = min(size, key=size.get)
    return [(best[name], best[name]) for name in ("rho", "alpha")]


def deviations():
    data = fvi("exact", alpha=0.65, rho=0.4, p0=0.25, columns="t,x")
    found = []
    for every in (1, 2):
        file = BUILD / f"workshop/data_{every}.tsv"
        file.parent.mkdir(exist_ok=True)
        file.write_text("".join(f"{t}\t{x!r}\n" for t, x in data[::every]))
        done = subprocess.run([BUILD / "fvi", "fit", "--p0=0.25", "--fit=alpha,rho", "--sigma=0.02", "--starts=4", file],
                              capture_output=True, text=True)
        row = next(line for line in done.stdout.splitlines() if line.startswith("alpha\t"))
        found.append(float(row.split()[2]))
    return [(found[1] / found[0],) * 2]


def blocks(figure):
    text = (BUILD / f"figures/{figure}.dat").read_text()
    found = [[]]
    for line in text.splitlines():
        try:
            found[-1].append([float(word) for word in line.split()])
        except ValueError:
            continue
        if not line.strip():
            found[-1].pop()
            if found[-1]:
                found.append([])
    return [block for block in found if block]


def creep():
    block = blocks("springpot/springpot_creep")[1]
    near = [t for t, ladder, pot in (row[:3] for row in block) if abs(ladder / pot - 1) <= 0.01]
    early = [t for t, ladder, pot in (row[:3] for row in block) if abs(ladder / pot - 1) > 0.01 and t < near[-1]]
    return [(early[-1], near[0])]


def swing_up():
    source = BUILD / "workshop/control.c"
    source.parent.mkdir(exist_ok=True)
    text = pathlib.Path("figures/control/control.c").read_text()
    if text.count("0.05, N") != 1:
        sys.exit("figures/control/control.c: the step of the pendulum is not 0.05")
    source.write_text(text.replace("0.05, N", "6. / N, N"))
    program = BUILD / "workshop/control"
    subprocess.run([*runner.CC, *runner.FLAGS, "-Isrc", source, BUILD / "libfvi.a", *runner.LIBS, "-o", program],
                   check=True)
    rows = [line.split() for line in subprocess.run([program], capture_output=True, text=True).stdout.split("\n\n\n")[-1]
            .splitlines()]
    u = [float(row[2]) for row in rows if len(row) == 3]
    return [(sum(a * b < 0 for a, b in zip(u, u[1:])),) * 2, (max(map(abs, u)),) * 2]


def slopes_of_tails():
    found = []
    for block in blocks("damping_laws/damping_laws_motion"):
        slopes = []
        for first, last in ((200, 1000), (200, 450), (450, 1000)):
            late = [(math.log(t), math.log(abs(x))) for t, x in block if first <= t <= last and x]
            slopes.append((late[-1][1] - late[0][1]) / (late[-1][0] - late[0][0]))
        found.append(span(slopes))
    return found[:2]


def bar(n, lumped):
    """The tip at t = 1 of a bar of n elements, clamped at its other end and let go from sin(pi x / 2)."""
    folder = BUILD / f"workshop/bar_{n}"
    folder.mkdir(parents=True, exist_ok=True)
    for name, middle, beside in (("M", *((1 / 2, 0) if lumped else (1 / 3, 1 / 6))), ("K", n * n, -n * n)):
        entries = [(i, i, middle * (2 if i < n else 1) / n) for i in range(1, n + 1)]
        entries += [(i + 1, i, beside / n) for i in range(1, n)] if beside else []
        (folder / f"{name}.mtx").write_text(f"%%MatrixMarket matrix coordinate real symmetric\n{n} {n} {len(entries)}\n"
                                            + "".join(f"{i} {j} {v!r}\n" for i, j, v in entries))
    start = ",".join(repr(math.sin(math.pi / 2 * i / n)) for i in range(1, n + 1))
    return fvi("run", system=folder, method="fvi-stable", x0=start, p0=0, unknowns=n, time=1, steps=4000, every=4000,
               columns="x")[-1][-1]


def tips():
    tip = {lumped: [bar(n, lumped) for n in (4, 8, 16)] for lumped in (False, True)}
    slopes = [math.log2(a / b) for ends in tip.values() for a, b in zip(ends, ends[1:])]
    return [(tip[False][1],) * 2, (tip[True][1],) * 2, span(slopes)]


def turning():
    """The angular momentum of the elastic pendulum in the last row, with a damper along each axis."""
    words = ["--lagrangian", "(v1^2+v2^2)/2 - 2*(sqrt(x1^2+x2^2)-1)^2", "--damper", "x1 : power:0.1,0.3",
             "--damper", "x2 : power:0.1,0.3", "--x0=1.2,0", "--v0=0.3,0.8", "--method=fvi-lobatto4", "--h=0.05",
             "--steps=1200", "--every=1200", "--columns=x,p"]
    done = subprocess.run([BUILD / "fvi", "run", *words], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"fvi run {' '.join(words)}: {done.stderr}")
    x, y, px, py = map(float, done.stdout.splitlines()[-1].split())
    return [(x * py - y * px,) * 2]


def largest_ratios():
    """The largest damping ratio of the lowest pole, for a springpot and for a dashpot on the first mass."""
    def ratio(R, alpha):
        return fvi("poles", potential="x1^2/2 + (x2-x1)^2/2 + (x3-x2)^2/2", dimension=3, rho=f"{R},0,0", alpha=alpha)[0][3]
    return [(max(ratio(R / 20, alpha) for R in range(20, 60)),) * 2 for alpha in (0.25, 0.5)]


EXPERIMENTS = {
    "00": creep, "25": swing_up, "26": slopes_of_tails,
    "01": half_derivative_of_t, "02": energy_band, "03": first_power, "04": half_of_the_sum,
    "05": constant_of_a_constant, "06": end_term, "07": away_from_one_half, "08": which_mass,
    "09": order_and_past, "10": constant_of_the_error, "11": tail, "12": tolerance_kept,
    "13": orders_of_two, "14": longest_step, "15": velocity_that_is_left, "16": energy_of_euler,
    "17": order_of_lobatto, "18": honest, "19": two_pasts, "20": error_by_step, "21": pushed,
    "22": steps_by_decade, "23": least_answer, "24": deviations, "27": tips, "28": many_at_once, "29": turning,
    "30": largest_ratios,
}
