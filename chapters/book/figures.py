"""Copies of the figures that follow the theme of the page.

An SVG in <img> takes prefers-color-scheme from the color-scheme of its place. gnuplot
writes colours as attributes, which selectors in one <style> overrule. The figures that
are committed stay as gnuplot wrote them."""
import colorsys
import pathlib
import re
import sys

# What gnuplot draws with, and the same on a dark ground: 3:1 at least for lines, 4.5:1 for words.
DARK = {"255,255,255": "#17181a", "#ffffff": "#17181a", "221,221,221": "#34383d", "lightgrey": "#34383d",
        "68,68,68": "#9a9da2", "34,34,34": "#dcdcd6", "0,0,0": "#f0f0ea", "black": "#f0f0ea", "gray": "#9a9da2",
        "85,85,85": "#a9a9a1", "102,102,102": "#a9a9a1", "136,136,136": "#9a9da2",
        "128,128,128": "#9a9da2", "140,140,140": "#9a9da2", "153,153,153": "#9a9da2",
        "196,106,155": "#e2a3c7", "46,143,196": "#7cc4ee", "176,122,0": "#e69f00", "122,95,192": "#b3a0ee",
        "0,114,178": "#56b4e9", "213,94,0": "#f2803c", "0,158,115": "#1fc296", "204,121,167": "#e2a3c7",
        "230,159,0": "#e69f00", "86,180,233": "#a5d8f5", "148,0,211": "#c58af9", "212,0,0": "#ff7b72"}
# Two of Okabe and Ito's colours are too light for a line on white; and the ground is that of the page.
LIGHT = {"230,159,0": "#b87a00", "86,180,233": "#2b8cc4", "255,255,255": "#fdfdfb", "#ffffff": "#fdfdfb"}
KEPT = {"identification_landscape", "structures_membrane"}  # a map is the same by night, and so is its scale, of polygons
COLOUR = re.compile(r"""\b(stroke|fill|color|flood-color) ?= ?['"]([^'"]*)['"]""")


def key(value):
    numbers = re.fullmatch(r"rgb\(\s*(\d+),\s*(\d+),\s*(\d+)\s*\)", value)
    return ",".join(numbers.groups()) if numbers else value.lower()


def dark(name):
    """The colour on a dark ground: from the table, or with its lightness turned over."""
    if name in DARK:
        return DARK[name]
    if name.startswith("#"):
        name = ",".join(str(int(name[i:i + 2], 16)) for i in (1, 3, 5))
    hue, light, strength = colorsys.rgb_to_hls(*(int(n) / 255 for n in name.split(",")))
    red, green, blue = colorsys.hls_to_rgb(hue, 0.1 + 0.85 * (1 - light), 0.8 * strength)
    return "#" + "".join(f"{round(255 * part):02x}" for part in (red, green, blue))


def themed(path):
    """The text of an SVG with its colours of the night."""
    svg = path.read_text()
    light, night = [], []
    for name, value in sorted(set(COLOUR.findall(svg))):
        if value in ("none", "currentColor"):
            continue
        rule = f'{":not(polygon)" if path.stem in KEPT and value.startswith("rgb") else ""}[{name}="{value}"]{{{name}:%s}}'
        if key(value) in LIGHT:
            light.append(rule % LIGHT[key(value)])
        if key(value) in DARK or path.stem not in KEPT:
            night.append(rule % dark(key(value)))
    style = f"<style>{''.join(light)}@media (prefers-color-scheme:dark){{{''.join(night)}}}</style>"
    return svg.replace('<g id="gnuplot_canvas">', style + '\n<g id="gnuplot_canvas">', 1)


# ---- on a phone: two panels below each other ----

TEXT = re.compile(r"""<g transform="translate\(([\d.]+),[\d.]+\)( rotate\(-?[\d.]+\))?"[^>]*font-size="([\d.]+)"[^>]*text-anchor="(\w+)"[^>]*>\s*<text>(.*?)</text>""", re.S)
NARROW = set(" .,:;|'()/[]!fijltrI-")  # letters of a third of their size; others have two thirds, at most


def words(svg):
    """Of each text in a figure, where it begins and ends in x, by its letters; and whether it is that of an axis y."""
    for x, turned, size, anchor, inside in TEXT.findall(svg):
        x, size, letters = float(x), float(size), re.sub("<[^>]*>", "", re.sub("&[^;]*;", "x", inside))
        long = size * sum(0.36 if letter in NARROW else 0.62 for letter in letters)
        if turned:
            yield x - size, x + size / 2, True
        else:
            begin = x - long * {"start": 0, "middle": 0.5, "end": 1}[anchor]
            yield begin, begin + long, anchor == "end"


def script_of(path):
    """What draws a figure, with the scripts that it loads."""
    script = path.with_suffix(".gp").read_text() if path.with_suffix(".gp").exists() else ""
    return script + "".join(pathlib.Path(name).read_text() for name in re.findall(r"^load '([^']*)'", script, re.M))


def split(path):
    """Where a vertical line divides the two panels of a figure and cuts no word; None, if it has not two panels."""
    layout = re.search(r"multiplot layout 1,2(?: margins ([\d.]+),([\d.]+),[\d.]+,[\d.]+ spacing ([\d.]+))?", script_of(path))
    if not layout:
        return None
    svg = path.read_text()
    wide = float(re.search(r'viewBox="0 0 (\d+) ', svg)[1])
    left, right, space = (float(part) for part in layout.groups()) if layout[1] else (0.08, 0.98, 0.13)
    end, begin = wide * (left + right - space) / 2, wide * (left + right + space) / 2  # of the panels
    texts = list(words(svg))
    most = min((a for a, b, of_axis in texts if of_axis and end < a and b < begin + 3), default=begin - 12)
    free = [x for x in range(round(end) + 1, round(most) - 1) if not any(a < x < b for a, b, _ in texts)]
    if not free:
        sys.exit(f"{path}: a phone shows the panels one below the other, and words fill the room between them: widen its spacing")
    return free[-1]


def stacked(path, svg):
    """A figure of two panels, the second one below the first; None, if it has not two panels."""
    x = split(path)
    if x is None:
        return None
    wide, high = (int(size) for size in re.search(r'viewBox="0 0 (\d+) (\d+)"', svg).groups())
    head, rest = svg.split('<g id="gnuplot_canvas">', 1)
    head = re.sub(r'width="\d+" height="\d+"\s+viewBox="[^"]*"', f'width="{max(x, wide - x)}" height="{2 * high}" viewBox="0 0 {max(x, wide - x)} {2 * high}"', head, count=1)
    canvas = '<g id="gnuplot_canvas">' + rest.rsplit("</svg>", 1)[0]
    return (f'{head}<svg width="{x}" height="{high}" viewBox="0 0 {x} {high}">{canvas}</svg>'
            f'<svg y="{high}" width="{wide - x}" height="{high}" viewBox="{x} 0 {wide - x} {high}"><use href="#gnuplot_canvas"/></svg></svg>')


def copy_all(out):
    """Copies all; of those with two panels there is a second one, NAME.narrow.svg, for a phone."""
    out.mkdir(parents=True)
    for path in pathlib.Path("figures").glob("*/*.svg"):
        svg = themed(path)
        (out / path.name).write_text(svg)
        if narrow := stacked(path, svg):
            (out / f"{path.stem}.narrow.svg").write_text(narrow)
