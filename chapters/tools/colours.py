"""Hold the grammar of the figures: every figure loads figures/style.gp, every colour that a
script names stands out from white by 3 to 1 at least, the hues of the methods from black
as well, a key has its reason beside it, and no picture asks for a font without naming
others. Exit 1 with a list of what is wrong. Fills and grids may be paler. Contrast is that of WCAG. Only Python's standard library is used."""
import pathlib
import re
import sys

STYLE = pathlib.Path("figures/style.gp")
PALE = re.compile(r"set grid|fc rgb|palette|background")    # fills and grounds


def luminance(colour):
    parts = (int(colour[i:i + 2], 16) / 255 for i in (1, 3, 5))
    red, green, blue = (v / 12.92 if v <= 0.03928 else ((v + 0.055) / 1.055) ** 2.4 for v in parts)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def on_white(colour):
    return 1.05 / (luminance(colour) + 0.05)


def on_black(colour):
    return (luminance(colour) + 0.05) / 0.05


def faults():
    for script in sorted(pathlib.Path("figures").glob("**/*.gp")):
        text = script.read_text()
        if script != STYLE and not re.search(r"^load 'figures/[\w/]+\.gp'", text, re.M):  # the style, or a drawing that has it
            yield f"{script}: does not load {STYLE}"
        for number, line in enumerate(text.splitlines(), 1):
            if re.match(r"\s*set key(?!.*# )", line) and script != STYLE:
                yield f"{script}:{number}: a key, and no word why the names do not stand at the curves"
            for colour in re.findall(r"#[0-9A-Fa-f]{6}\b", "" if PALE.search(line) else line):
                if on_white(colour) < 3:
                    yield f"{script}:{number}: {colour} has a contrast of {on_white(colour):.2f} on white"
    for name, colour in re.findall(r'(\w+) = "(#[0-9A-Fa-f]{6})"', STYLE.read_text()):
        if name != "BLACK" and on_black(colour) < 3:
            yield f"{STYLE}: {name} has a contrast of {on_black(colour):.2f} on black"
    for picture in sorted(pathlib.Path("figures").glob("*/*.svg")):
        if 'font-family="DejaVu Sans"' in picture.read_text():
            yield f"{picture}: one font, and no other in its place"


sys.exit("\n".join(faults()) or 0)
