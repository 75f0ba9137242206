"""Where the atrapos command is."""
import pathlib
import shutil
import sys


def program():
    """The command of the same build or installation, else the one in PATH; ends the program where there is none."""
    built = [parent / "bin" / "atrapos" for parent in pathlib.Path(__file__).absolute().parents]
    found = next((str(p) for p in built if p.is_file()), None) or shutil.which("atrapos")
    if found is None:
        sys.exit("atrapos: the command is neither beside the module nor in PATH")
    return found
