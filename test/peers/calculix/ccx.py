"""Runs CalculiX (ccx; Debian: calculix-ccx) for the scripts beside this."""
import os
import subprocess
import tempfile


def rows(lines, timeout=600):
    """What ccx prints of a model (the lines of its input) into its .dat file: the words of each line."""
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "m.inp"), "w") as f:
            f.write("\n".join(lines) + "\n")
        subprocess.run(["ccx", "m"], cwd=folder, check=True, stdout=subprocess.DEVNULL, timeout=timeout)
        with open(os.path.join(folder, "m.dat")) as f:
            return [line.split() for line in f]
