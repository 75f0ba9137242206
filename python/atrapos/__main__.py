"""python3 -m atrapos: the atrapos command."""
import os
import pathlib
import shutil
import sys


def main():
    built = [parent / "bin" / "atrapos" for parent in pathlib.Path(__file__).absolute().parents]
    program = next((str(p) for p in built if p.is_file()), None) or shutil.which("atrapos")
    if program is None:
        sys.exit("atrapos: the command is neither beside the module nor in PATH")
    os.execv(program, [program] + sys.argv[1:])


main()
