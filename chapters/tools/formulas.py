"""Formulas within a line that GitHub would spoil are written with backticks.

    formulas.py            write them so, in every page
    formulas.py --check    exit 1 if one is not (part of make text)

GitHub reads $...$ as Markdown first, and takes a backslash before a punctuation mark away: $a\\,b$
loses its space, and a matrix its rows. Of $`...`$ it takes nothing. Only Python's standard
library is used."""
import pathlib
import re
import sys

PAGES = [pathlib.Path("README.md"), *sorted(pathlib.Path("chapters").glob("**/*.md"))]
# What stands as it is: blocks of code, notes, formulas with backticks, code within a line.
KEPT = re.compile(r"^ *```.*?^ *```$|<!--.*?-->|\$`.+?`\$|(?<!`)(`+)(?!`).+?(?<!`)\1(?!`)", re.M | re.S)
FORMULA = re.compile(r"(?<![\\$])\$(?! )((?:[^$\n\\]|\\.|\n(?!\n))+?)(?<! )\$(?!\d)")
SPOILT = re.compile(r"\\[!-/:-@\[-`{-~]")


def mended(text):
    """The page with backticks where they are needed, and the lines of these formulas."""
    lines, out, end = [], [], 0

    def mend(start, piece):
        def with_backticks(match):
            if not SPOILT.search(match[1]):
                return match[0]
            lines.append(text.count("\n", 0, start + match.start()) + 1)
            return f"$`{match[1]}`$"
        return FORMULA.sub(with_backticks, piece)

    for kept in KEPT.finditer(text):
        out += [mend(end, text[end:kept.start()]), kept[0]]
        end = kept.end()
    return "".join([*out, mend(end, text[end:])]), lines


def main():
    faults = []
    for page in PAGES:
        text, lines = mended(page.read_text())
        if sys.argv[1:] == ["--check"]:
            faults += [f"{page}:{line}: GitHub takes backslashes out of this formula; write $`...`$" for line in lines]
        elif lines:
            page.write_text(text)
    sys.exit("\n".join(faults) or 0)


main()
