"""What build/fvi_petsc -o FILE wrote, as text.             petsc_vectors.py FILE

Prints a row for each unknown: its number, x and p, as the file of `fvi run --snapshot` has
them. read(FILE) gives the vectors as tuples. PETSc's binary format of a vector is a mark and
the length, four bytes each, then the numbers, all big-endian. Only the standard library is
used."""
import struct
import sys

MARK = 1211214


def read(file):
    """All vectors of the file, in their order."""
    with open(file, "rb") as stream:
        data = stream.read()
    vectors, at = [], 0
    while at < len(data):
        mark, n = struct.unpack_from(">ii", data, at) if at + 8 <= len(data) else (0, 0)
        if mark != MARK or at + 8 + 8 * n > len(data):
            raise ValueError(f"{file}: no vector in PETSc's binary format at byte {at}")
        vectors.append(struct.unpack_from(f">{n}d", data, at + 8))
        at += 8 + 8 * n
    return vectors


if __name__ == "__main__":
    x, p = read(sys.argv[1])
    print("# unknown\tx\tp")
    for number, row in enumerate(zip(x, p), 1):
        print(number, *map(repr, row), sep="\t")
