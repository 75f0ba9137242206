"""Makes a mesh for decks of a file that meshio reads.

    python3 -m atrapos.from_meshio part.vtu [-o part.exo] [--groups ARRAY] [--shells]
"""
import argparse
import pathlib
import sys

from . import MeshError, import_mesh


def main():
    words = argparse.ArgumentParser(prog="python3 -m atrapos.from_meshio", description=__doc__.split("\n")[0])
    words.add_argument("file", help="mesh that meshio reads: .vtu, .vtk, .med, .cgns, .nas, .xdmf, ...")
    words.add_argument("-o", "--output", help="Exodus file (default: FILE's name with .exo, here)")
    words.add_argument("--groups", metavar="ARRAY", help="array of cell data whose whole numbers are blocks and sets")
    words.add_argument("--shells", action="store_true", help="quadrilaterals in z = 0 are shells")
    given = words.parse_args()
    output = given.output or pathlib.Path(given.file).stem + ".exo"
    try:
        print(import_mesh(given.file, output, given.groups, given.shells), end="")
    except (MeshError, OSError) as error:
        print(f"atrapos.from_meshio: {error}", file=sys.stderr)
        sys.exit(2)


if __name__ == "__main__":
    main()
