"""The failure map of contact: a cantilever pressed onto a tool, under every combination of tool, law, mesh, start gap, order and accuracy.

    python3 docs/figures/contact_map.py COMMAND [--folder contact_map] [--laws ...] [--meshes ...] [--gaps ...] [--orders ...] [--deltas ...]

COMMAND is the atrapos command. Writes contact_map.csv (a row a run) in the folder as it goes; what stands there is not run again. Then
contact_map.png there: for each tool and law how many runs reached their stop, how many were refused, how many ended before.
"""
import argparse
import csv
import json
import subprocess
import sys
import time
from itertools import product
from pathlib import Path

# {z}: top of the tool, below the strip's lower surface by the gap; {t}: as far above its upper one
TOOLS = {
    "plane": "{{type: plane, point: [0, 0, {z}], normal: [0, 0, 1]}}",
    "cylinder": "{{type: cylinder, center: [60, 0, {z} - 20], axis: [0, 1, 0], radius: 20}}",
    "sphere": "{{type: sphere, center: [60, 0, {z} - 20], radius: 20}}",
    "torus": "{{type: torus, center: [62, 0, {z} - 5], axis: [0, 0, 1], radius: 20, tube_radius: 5}}",
    "crowned roll": "{{type: crowned_roll, center: [60, 0, {z} - 20], axis: [0, 1, 0], coefficients: [20, 0, -0.002]}}",
    "moving sphere": "{{type: sphere, center: [80, 0, {t} + 20], radius: 20, motion: {{shift: [0, 0, -10]}}}}",
}
LAWS = {
    "chosen": "",
    "hyperbola": ", law: hyperbola",
    "hyperbola at nodes": ", law: hyperbola, points: nodes",
    "curve": ", unknown: curve",
    "barrier": ", law: barrier",
    "power": ", law: power",
    "exponential": ", law: exponential",
    "penalty": ", law: penalty",
    "hard": ", law: hard",
    "hard at nodes": ", law: hard, points: nodes",
    "zones, linear": ", points: zones, law: linear, stiffness: 1.0e3",
    "zones, m = 2": ", points: zones, law: power_overclosure, exponent: 2, stiffness: 1.0e5",
}
MESHES = {"10 x 2": "[10, 2, 1]", "20 x 4": "[20, 4, 1]"}
GAPS = {"0": 0.0, "1e-6": 1.0e-6, "1": 1.0}
ORDERS = ["5", "10", "20", "30"]
DELTAS = ["1.0e-4", "1.0e-6"]


def deck(tool, law, mesh, gap, order, delta):
    moving = tool.startswith("moving")
    top = GAPS[gap] + 0.5
    text = TOOLS[tool].format(z=repr(-top), t=repr(top))
    for sign in ("- 20", "- 5", "+ 20"):  # numbers in decks are numbers
        a = -top if sign[0] == "-" else top
        text = text.replace(f"{a!r} {sign}", repr(a + float(sign.replace(" ", ""))))
    load = "  tip: {type: surface, set: x_max, total: [0, 0, -20], constant: false}" if not moving else ""
    return f"""title: Cantilever and {tool}
mesh:
  file: strip.exo
  generate: {{shape: strip, length: 100, width: 10, thickness: 1, origin: [0, -5, -0.5], divisions: {MESHES[mesh]}, cell: HEX20, block: strip}}
materials:
  steel: {{law: saint_venant_kirchhoff, youngs_modulus: 210000, poissons_ratio: 0.3, blocks: [strip]}}
supports:
  clamp: {{set: x_min, x: 0, y: 0, z: 0}}
{"loads:" if load else ""}
{load}
tools:
  tool: {text}
contact:
  face: {{tool: tool, set: {"top" if moving else "bottom"}{LAWS[law]}}}
path: {{order: {order}, accuracy: {delta}, residual: {delta}, stop: {{load_factor: 1, steps: 3000}}}}
output:
  monitors:
    tip: {{type: displacement, set: x_max, component: z}}
    force: {{type: contact_force, contact: face, component: normal}}
"""


def run(command, folder, text):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "deck.yaml").write_text(text)
    start = time.time()
    try:
        for words in (["mesh"], ["run"]):
            done = subprocess.run([command, *words, "deck.yaml"], cwd=folder, capture_output=True, text=True, timeout=300)
            if done.returncode not in (0, 3) or done.returncode and words == ["mesh"]:
                break
    except subprocess.TimeoutExpired:
        return {"outcome": "timeout", "seconds": 300}
    row = {"code": done.returncode, "seconds": round(time.time() - start, 2)}
    if done.returncode not in (0, 3):
        return row | {"outcome": "refused" if done.returncode == 2 else "crash", "why": (done.stderr.strip().splitlines() or [""])[-1]}
    out = json.loads((folder / "deck_results/summary.json").read_text())
    last = list(csv.DictReader(open(folder / "deck_results/path.csv")))[-1]
    return row | {
        "outcome": "end" if out["reached_stop"] else out["ended"],
        "why": out["why"],
        "load_factor": out["load_factor"],
        "steps": out["steps"],
        "factorizations": out["factorizations"],
        "residual": out["worst_residual"],
        "tip": last["tip"],
        "force": last["force"],
    }


KEYS = ["tool", "law", "mesh", "gap", "order", "delta"]
FIELDS = KEYS + ["outcome", "steps", "factorizations", "seconds", "load_factor", "tip", "force", "residual", "code", "why"]
COLOURS = {"end": "#4878a8", "refused": "#bbbbbb", "before": "#c44e52"}


def draw(rows, file):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, len(TOOLS), figsize=(14, 4), sharey=True)
    for axis, tool in zip(axes, TOOLS):
        left = [0] * len(LAWS)
        for kind in COLOURS:
            counts = [
                sum(r["tool"] == tool and r["law"] == law and kind == (r["outcome"] if r["outcome"] in COLOURS else "before") for r in rows)
                for law in LAWS
            ]
            axis.barh(list(LAWS), counts, left=left, color=COLOURS[kind], label={"end": "reached its stop", "before": "ended before"}.get(kind, kind))
            left = [a + b for a, b in zip(left, counts)]
        axis.set_title(tool)
        axis.invert_yaxis()
    figure.legend(*axes[0].get_legend_handles_labels(), loc="lower right", ncol=3, fontsize=8)
    axes[0].set_xlabel("runs")
    figure.tight_layout()
    figure.savefig(file, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("command")
    parser.add_argument("--folder", type=Path, default=Path("contact_map"))
    for name, values in (("laws", LAWS), ("meshes", MESHES), ("gaps", GAPS), ("orders", ORDERS), ("deltas", DELTAS)):
        parser.add_argument("--" + name, nargs="+", choices=list(values), default=list(values))
    args = parser.parse_args()
    args.folder.mkdir(exist_ok=True)
    table = args.folder / "contact_map.csv"
    rows = list(csv.DictReader(open(table))) if table.exists() else []
    known = {tuple(r[k] for k in KEYS) for r in rows}
    with open(table, "a", newline="") as file:
        out = csv.DictWriter(file, FIELDS)
        if not rows:
            out.writeheader()
        for case in product(TOOLS, args.laws, args.meshes, args.gaps, args.orders, args.deltas):
            if case in known:
                continue
            row = dict(zip(KEYS, case)) | run(args.command, args.folder / "run", deck(*case))
            rows.append(row)
            out.writerow(row)
            file.flush()
            print(*case, row["outcome"], row.get("steps", ""), row["seconds"], "" if row["outcome"] == "end" else row.get("why", ""), flush=True)
    draw(rows, args.folder / "contact_map.png")


main()
