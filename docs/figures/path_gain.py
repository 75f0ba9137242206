#!/usr/bin/python3
"""What rational series and the automatic order gain on decks.

    python3 docs/figures/path_gain.py DECK...

Each deck is run as it is, but for path/pade and path/order, without fields and into a temporary folder.

Prints a Markdown table: steps (factorizations), seconds, worst residual, of the first path and all branches together. The seconds
are those of the path, without start, mesh and tables, the least of --repeat runs. Meshes have to be there (atrapos mesh DECK). Needs
python3-yaml.
"""
import argparse
import json
import pathlib
import subprocess
import tempfile

import yaml

CASES = {"polynomial": {}, "rational": {"pade": "automatic"}, "order: auto": {"order": "auto"}}


def run(command, deck, changes):
    data = yaml.safe_load(deck.read_text())
    path = data.setdefault("path", {})
    path.pop("pade", None)
    path.pop("order", None)
    path["pade"] = "off"
    path.update(changes)
    path["restart"] = False
    data.get("path", {}).pop("sharpen", None)
    data["output"] = {k: v for k, v in data.get("output", {}).items() if k == "monitors"}
    data["output"]["residuals"] = "points"
    if "mesh" in data:
        data["mesh"] = {"file": str((deck.parent / data["mesh"]["file"]).resolve())}
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "deck.yaml"
        file.write_text(yaml.safe_dump(data, default_flow_style=None))
        done = subprocess.run([command, "run", "-q", str(file)], cwd=folder, capture_output=True, text=True, timeout=560)
        results = list(pathlib.Path(folder).glob("*/summary.json"))
        if not results:
            return "refused: " + done.stderr.strip().splitlines()[-1][:90]
        s = json.loads(results[0].read_text())
        text = f"{s['steps']} ({s['factorizations']}), %s s, {s['worst_residual']:.0e}"
        return (text if done.returncode == 0 else text + " **ended**"), s["seconds"]["total"]


def fastest(command, deck, changes, repeat):
    """The other runs were disturbed more by what else the machine did."""
    runs = [run(command, deck, changes) for _ in range(repeat)]
    if isinstance(runs[0], str):
        return runs[0]
    return runs[0][0] % f"{min(seconds for _, seconds in runs):.2g}"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("decks", nargs="+", type=pathlib.Path)
    parser.add_argument("--atrapos", default="atrapos")
    parser.add_argument("--repeat", default=3, type=int)
    options = parser.parse_args()
    print("| deck | " + " | ".join(CASES) + " |\n|---" + "|---" * len(CASES) + "|")
    for deck in options.decks:
        row = []
        for changes in CASES.values():
            row.append(fastest(options.atrapos, deck, changes, options.repeat))
        print(f"| {deck.stem} | " + " | ".join(row) + " |", flush=True)


if __name__ == "__main__":
    main()
