"""The failure map of decks: shells, rubber, metal, heat, electricity, reaction, flow and contact, each under many settings of the series and with other slenderness,
meshes and stiffness.

    python3 docs/figures/deck_map.py COMMAND [--folder deck_map] [--only PART-OF-A-NAME]

COMMAND is the atrapos command. Below the folder each deck of `examples` gets its table; a table that is there is kept. Then deck_map.png there, and the runs that do
not reach their end on the screen.
"""
import argparse
import collections
import csv
import shutil
import subprocess
from pathlib import Path

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
ORDERS, DELTAS = "5,10,20,30", "1e-3,1e-5,1e-7"
# deck: what is varied besides
DECKS = {
    "path/hinged_roof": [],
    "path/euler_column_crooked": [],
    "path/three_modes": [],
    "path/hill_top": [],
    "shells/end_shear": ["shells/sections/strip/thickness=[1.0, 0.1, 0.01]"],
    "shells/end_moment": [],
    "shells/hinged_roof_6.35": ["mesh/generate/divisions=[[4, 4], [8, 8]]", "shells/sections/roof/thickness=[4.0, 6.35, 12.7]"],
    "shells/slit_annulus": [],
    "shells/hemisphere": [],
    "rubber/balloon": ["mesh/generate/inner_radius=[0.8, 0.995]"],
    "rubber/biot": ["mesh/generate/divisions=[[4, 6], [8, 12]]"],
    "rubber/cook": ["materials/rubber/bulk_modulus=[10, 7500.25, infinite]"],
    "plasticity/sphere": [],
    "plasticity/springback_shells": ["shells/thickness_points=[3, 5]"],
    "heat/thermistor": ["mesh/generate/divisions=[[4, 1], [8, 2]]"],
    "heat/joule_beam": ["mesh/generate/lengths=[[100, 1], [30, 1]]"],
    "heat/plate": [],
    "heat/strip": [],
    "heat/bimetal": [],
    "electric/elastomer": ["materials/elastomer/bulk_modulus=[10, 1.0e4]"],
    "electric/pull_in": [],
    "electric/electrode": [],
    "reaction/bratu_square": [],
    "reaction/bratu_ball": [],
    "reaction/explosion": [],
    "reaction/schnakenberg": [],
    "reaction/brusselator": [],
    "flow/cavity": ["mesh/generate/divisions=[[6, 6]]"],
    "flow/convection": ["mesh/generate/divisions=[[6, 6]]"],
    "contact/hertz_cylinder": ["contact/cylinder/stiffness=[1.0e3, 1.0e5]"],
    "strip_roll/hard": [],
    "strip_roll/zones_shell": [],
}
COLOURS = {"end": "#4878a8", "ended": "#f6d55c", "limit": "#f2c6a0", "residual": "#b39ddb", "jumped": "#e57373", "turned": "#c2185b"}


def make(command, deck, vary, folder):
    table = folder / (deck.replace("/", "_") + ".csv")
    if table.exists():
        return table
    place = folder / "examples" / Path(deck).parent
    shutil.copytree(EXAMPLES / Path(deck).parent, place, dirs_exist_ok=True)
    name = Path(deck).name
    if (place / f"{name}.inp").exists():
        subprocess.run([command, "import", "-q", f"{name}.inp", "-o", f"{name}.exo"], cwd=place, check=False)
    else:
        subprocess.run([command, "mesh", "-q", f"{name}.yaml"], cwd=place, check=False, capture_output=True)  # models have none
    words = [word for key in vary for word in ("--vary", key)]
    beside = table.with_suffix(".part").resolve()
    done = subprocess.run([command, "map", f"{name}.yaml", "--orders", ORDERS, "--deltas", DELTAS, *words, "-o", beside], cwd=place, capture_output=True, text=True, check=False)
    print(deck, done.stdout.strip(), done.stderr.strip(), flush=True)
    if done.returncode == 0:
        beside.rename(table)
    return table


def draw(rows, file):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    decks = list(rows)
    figure, axis = plt.subplots(figsize=(8, 0.24 * len(decks) + 1))
    left = [0] * len(decks)
    for outcome, colour in COLOURS.items():
        counts = [sum(row["outcome"] == outcome for row in rows[deck]) for deck in decks]
        axis.barh(decks, counts, left=left, color=colour, label=outcome)
        left = [a + b for a, b in zip(left, counts)]
    axis.invert_yaxis()
    axis.margins(y=0.01)
    axis.set_xlabel("runs")
    axis.tick_params(labelsize=8)
    axis.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(file, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("command", type=Path)
    parser.add_argument("--folder", type=Path, default=Path("deck_map"))
    parser.add_argument("--only", default="")
    args = parser.parse_args()
    args.folder.mkdir(exist_ok=True)
    rows = {}
    for deck, vary in DECKS.items():
        if args.only not in deck:
            continue
        table = make(args.command.resolve(), deck, vary, args.folder)
        if table.exists():
            with open(table, encoding="utf-8") as lines:
                rows[deck] = list(csv.DictReader(lines))
    draw(rows, args.folder / "deck_map.png")
    outcomes = collections.Counter(row["outcome"] for all in rows.values() for row in all)
    print(sum(outcomes.values()), dict(outcomes))
    for deck, all in rows.items():
        for row in all:
            if row["outcome"] != "end":
                print(deck, row["values"], "K", row["order"], row["delta"], row["pade"], row["outcome"], row["steps"], row["reason"])
            elif int(row["points"]) != int(row["points_expected"]):
                print(deck, row["values"], "K", row["order"], row["delta"], row["pade"], "points", row["points"], "of", row["points_expected"])


main()
