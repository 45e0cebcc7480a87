"""Run what H 16 says, row by row: the counterexample, or the repair, in numbers.

    errata.py FVI 17      one row, as the table has it, and its numbers   (make erratum-17)
    errata.py FVI         all rows; exit 1 if a claim does not hold, or if a row of the
                          table has no numbers here                       (make errata)

FVI is the program, for the rows that are about runs. Fractions are exact; what is not is
computed from formulas with math.gamma, and never by the library. The rows stand in
errata_continuous.py and errata_discrete.py. Only Python's standard library is used."""
import pathlib
import re
import sys

import errata_discrete                               # its rows register themselves
from errata_continuous import ROWS

PAGE = pathlib.Path("chapters/handbook/16-errata.md")


def table():
    """{number: (place, printed, right)} of H 16."""
    rows = re.findall(r"^\| (\d+) \| (.*) \|$", PAGE.read_text(), re.M)
    return {int(n): re.sub(r"\]\([^)]*\)", "]", cells).replace("`", "").split(" | ")[:3] for n, cells in rows}


def show(number, cells):
    print(f"{number}. {cells[0]}\n  printed: {cells[1]}\n  right:   {cells[2]}")
    if number in ROWS:
        ROWS[number]()
    else:
        print("  lettering, with nothing to run")


def main():
    rows = table()
    if set(rows) - {7} != set(ROWS):
        sys.exit(f"rows without numbers, or numbers without a row: {sorted((set(rows) - {7}) ^ set(ROWS))}")
    for number in [int(n) for n in sys.argv[2:]] or sorted(rows):
        if number not in rows:
            sys.exit(f"there is no erratum {number}: H 16 has 1 to {max(rows)}")
        show(number, rows[number])


main()
