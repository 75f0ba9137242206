"""Has `atrapos check` look at every deck of examples, and at the whole decks that stand in the docs.

    check_decks.py COMMAND JOBS    the atrapos command; says what is wrong, a line each, and exits with 1
"""
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import yaml

import gallery
import repository
from repository import CHARTS, ROOT

command, jobs = os.path.realpath(sys.argv[1]), int(sys.argv[2])
# The library of examples/embedding/plugin, where the tests of this build made it.
PLUGIN = pathlib.Path(command).parents[1] / "src/test/libplugin_soap.so"


def refusal(folder, name):
    """What the command says against the deck of this name; None where nothing. Its mesh is made first."""
    text = (folder / name).read_text()
    steps = [line.split() for line in gallery.commands(folder / name, text).split("\n")]
    steps[-1] = ["atrapos", "check", name]
    if (yaml.safe_load(text) or {}).get("plugins"):
        steps[-1] += ["--plugin", str(PLUGIN)]
    for step in steps:
        done = subprocess.run([command] + step[1:], cwd=folder, capture_output=True, text=True)
        if done.returncode:
            return done.stderr.strip()
    return None


def example(deck, examples):
    if str(deck).startswith(CHARTS):
        other = yaml.safe_load((ROOT / deck).read_text())["deck"]
        return None if (ROOT / deck.parent / other).is_file() else f"there is no deck {other}"
    return refusal(examples / deck.parent.relative_to("examples"), deck.name)


def blocks(text):
    """The indented and fenced blocks of code, with the line that each begins at."""
    lines = text.split("\n") + [""]
    code = repository.prose(text).split("\n") + [""]
    begin = None
    for i, line in enumerate(lines):
        inside = line.strip() and not code[i].strip()
        if inside and begin is None:
            begin = i
        if begin is not None and not inside and (line.strip() or not lines[i + 1:i + 2] or
                                                 not lines[i + 1].startswith("    ")):
            body = [b for b in lines[begin:i] if not b.lstrip().startswith("```")]
            indent = min((len(b) - len(b.lstrip()) for b in body if b.strip()), default=0)
            yield begin + 1, "\n".join(b[indent:] for b in body)
            begin = None


def whole_decks():
    for page in repository.pages():
        for line, block in blocks((ROOT / page).read_text()):
            if not re.search(r"^path:", block, re.M) or not re.search(r"^(mesh|problem):", block, re.M):
                continue
            # Decks in two columns side by side, or with dots for what is left out, are no decks.
            yield f"{page}:{line}", block


def in_docs(place, block):
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "deck.yaml").write_text(block)
        return refusal(pathlib.Path(folder), "deck.yaml")


with tempfile.TemporaryDirectory() as copy, concurrent.futures.ThreadPoolExecutor(jobs) as pool:
    # Meshes of one name are made by several decks of a folder: folder after folder, each in one piece.
    shutil.copytree(ROOT / "examples", copy, dirs_exist_ok=True)
    folders = {}
    for deck in repository.decks():
        folders.setdefault(deck.parent, []).append(deck)
    examples = pathlib.Path(copy)
    done = list(pool.map(lambda decks: [(str(d), example(d, examples)) for d in decks], folders.values()))
    docs = list(whole_decks())
    done.append([(place, in_docs(place, block)) for place, block in docs])

told = [f"{place}: {why}" for group in done for place, why in group if why]
print("\n".join(told), end="\n" if told else "")
if not docs:
    raise SystemExit("docs-site: no whole deck was found in the docs; README.md has one")
sys.exit(1 if told else 0)
