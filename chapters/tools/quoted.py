"""Hold the numbers in the prose to the files that they come from.

    quoted.py                   write the digits of today    (part of make excerpts)
    quoted.py --check           say what differs, exit 1     (part of make text)
    quoted.py --gather FILE...  what tests saw into tests/harness/seen.tsv    (make seen)

Below a paragraph, a list or a table stands an invisible note, a line for each place:
    <!-- from
    0.019 = experiments_panels/eq_9_3_several_alpha_at_h_one_half/far 0.5
    $10^{-12}$ > fvi/eq_9_4_momentum_form/difference
    0.860, 0.861 = experiments/slopes/x; /p
    -->
On the left is a piece of the block above, word for word; `=` says that each number in
it is the value on the right, rounded to the digits shown, `>` and `<` that it is above
or below. The right names values, in their order, with `;` between them:
    stem/function/name            the largest that tests/*/test_stem.c saw, and
    stem/function/name/least      the least: from tests/harness/seen.tsv
    file/region/row/column        a cell of figures/*/file.tsv, by the first cell of its
                                  row and the head of its column
A value that begins with `/` has the first two parts of the one before it in the note.
Only Python's standard library is used."""
import math
import pathlib
import re
import sys

SEEN = pathlib.Path("tests/harness/seen.tsv")
HEAD = "# stem/function/name\tleast\tlargest\t(what the tests saw: make seen)\n"
NOTE = re.compile(r"^[ \t]*<!-- from\n(.*?)^[ \t]*-->", re.M | re.S)
LINE = re.compile(r"(.+?) ([=<>]) (\S.*)")
NUMBER = re.compile(r"(?<![\w.])([+-]?\d+(?:\.(\d+))?)(?:e([+-]?\d+))?(?![\w^])")


def gather(paths):
    """Merge: of a stem that was run, the old lines go."""
    ran = {path.stem for path in paths}
    extremes = {}
    for path in paths:
        for line in path.read_text().splitlines():
            name, value = line.split("\t")
            name = path.stem + "/" + name.replace("_fn/", "/", 1)
            low, high = extremes.get(name, (float(value),) * 2)
            extremes[name] = min(low, float(value)), max(high, float(value))
    rows = {name: f"{low:.6g}\t{high:.6g}" for name, (low, high) in extremes.items()}
    for name in rows:                                # of the checks' own, largest only
        if name.endswith(("/ulp", "/of the bound")):
            rows[name] = "-" + rows[name][rows[name].index("\t"):]
    for name, least, largest in read(SEEN) if SEEN.exists() else []:
        if name.split("/")[0] not in ran:
            rows[name] = f"{least}\t{largest}"
    SEEN.write_text(HEAD + "".join(f"{name}\t{rows[name]}\n" for name in sorted(rows)))


def read(path):
    """The rows of a table without its comments, cells without padding."""
    for line in path.read_text().splitlines():
        if line and not line.startswith("#"):
            yield [cell.strip() for cell in line.split("\t")]


def cell(path, region, row, column):
    lines = path.read_text().splitlines()
    lines = lines[lines.index(f"#> {region}") + 1:lines.index(f"#< {region}")]
    head = [name.strip() for name in lines[0].lstrip("# ").split("\t")]
    for line in lines[1:]:
        cells = [text.strip() for text in line.split("\t")]
        if cells[0] == row:
            return float(cells[head.index(column)])
    raise ValueError(f"{path}: no row {row} in {region}")


def value_of(key, seen):
    name = key.removesuffix("/least")
    try:
        if name in seen:
            return float(seen[name][0 if key != name else 1])
        table, *place = key.split("/")
        return cell(next(pathlib.Path("figures").glob(f"*/{table}.tsv"), pathlib.Path(table)), *place)
    except (OSError, ValueError, TypeError):
        raise ValueError(f"no such value: {key}")


def in_full(keys, before):
    """The list, with what `/` stands for, and its last full value for the next line."""
    full = []
    for key in (key.strip() for key in keys.split(";")):
        before = before if key.startswith("/") else "/".join(key.split("/")[:2])
        full.append(before + key if key.startswith("/") else key)
    return full, before


def plain(text):
    """One line; formulas without backticks, powers of ten as e, thousands without gaps."""
    text = text.replace("$`", "$").replace("`$", "$")
    text = re.sub(r"\s*\\cdot\s*10\^\{?(-?\d+)\}?", r"e\1", " ".join(text.split()))
    text = re.sub(r"\b10\^\{?(-?\d+)\}?", r"1e\1", text)
    return re.sub(r"(?<=\d) (?=\d{3}\b)", "", text)


def same(number, value):
    """Whether value, rounded to the digits that are shown, is the number shown;
    a bare power of ten is an order of magnitude."""
    digits, fraction, exponent = number.groups()
    if digits == "1" and exponent:
        return value > 0 and abs(math.log10(value) - int(exponent)) <= 0.5
    place = 10.0 ** (int(exponent or 0) - len(fraction or ""))
    return abs(float(number[0]) - value) <= 0.5000001 * place


def amended(text, numbers, i, value):
    """The text with as many digits of value in the place of number i."""
    digits, fraction, exponent = numbers[i].groups()
    sign = "+" if digits.startswith("+") else ""
    new = f"{value / 10.0 ** int(exponent or 0):{sign}.{len(fraction or '')}f}"
    nth = sum(number[1] == digits for number in numbers[:i])
    place = list(re.finditer(rf"(?<![\w.]){re.escape(digits)}(?!\w|\.\d)", text))[nth]
    return text[:place.start()] + new + text[place.end():]


def faults_of_line(text, relation, keys, block, seen):
    """What is wrong with a line of a note, and how the text should be, if that is known."""
    if plain(text) not in plain(block):
        yield f"'{text}' is not in the text above", None
        return
    numbers = list(NUMBER.finditer(plain(text)))
    if len(numbers) != len(keys):
        yield f"'{text}' has {len(numbers)} numbers for {len(keys)} values", None
        return
    for i, (number, key) in enumerate(zip(numbers, keys)):
        value = value_of(key, seen)
        holds = {"=": same(number, value), "<": float(number[0]) < value, ">": float(number[0]) > value}
        if not holds[relation]:
            yield (f"'{number[0]} {relation} {key}' does not hold: that is {value:.6g}",
                   amended(text, numbers, i, value) if relation == "=" else None)


def faults_of(text, seen):
    """(line, fault, where its note is, the words, how they should be) of a page."""
    for note in NOTE.finditer(text):
        start = text.count("\n", 0, note.start()) + 2
        above = [block for block in re.split(r"\n\s*\n", text[:note.start()]) if block.strip()]
        before = left = ""
        for number, line in enumerate(note[1].splitlines(), start):
            try:
                left, relation, right = LINE.fullmatch(line.strip()).groups()
                keys, before = in_full(right, before)
                for fault, better in faults_of_line(left, relation, keys, above[-1], seen):
                    yield number, fault, note, left, better
            except AttributeError:
                yield number, f"not a line of a note: {line}", note, left, None
            except ValueError as error:
                yield number, error, note, left, None


def rewrite(page, seen):
    """Put right what can be put right, one number after the other, and say so."""
    text = page.read_text()
    for _ in range(text.count(" = ")):
        fault = next((fault for fault in faults_of(text, seen) if fault[4]), None)
        if not fault:
            break
        number, what, note, left, better = fault
        print(f"{page}:{number}: {what}; now: {better}")
        words = re.compile(r"\s+".join(map(re.escape, left.split())))
        place = list(words.finditer(text, 0, note.start()))[-1]
        gaps = re.findall(r"\s+", place[0]) + [""]   # the words may go over two lines
        new = "".join(word + gap for word, gap in zip(better.split(), gaps))
        text = (text[:place.start()] + new + text[place.end():note.start()]
                + note[0].replace(f"{left} = ", f"{better} = ", 1) + text[note.end():])
    page.write_text(text)


def main():
    if sys.argv[1:2] == ["--gather"]:
        return gather([pathlib.Path(name) for name in sys.argv[2:]])
    seen = {name: (least, float(largest)) for name, least, largest in read(SEEN)}
    pages = [pathlib.Path("README.md"), *sorted(pathlib.Path("chapters").glob("**/*.md"))]
    for page in pages if sys.argv[1:] != ["--check"] else []:
        rewrite(page, seen)
    sys.exit("\n".join(f"{page}:{fault[0]}: {fault[1]}" for page in pages
                       for fault in faults_of(page.read_text(), seen)) or 0)


main()
