"""Pages of the gallery: the decks of a folder of examples with what they show, a picture and the command."""
import hashlib
import html
import pathlib
import re
import subprocess
import tempfile

import yaml

from repository import CHARTS, ROOT

# Pictures of the docs that show one deck; other decks have the path that `atrapos run` draws.
PICTURES = {
    "examples/path/hinged_roof.yaml": "docs/figures/hinged_roof.png",
    "examples/strip_roll/solid.yaml": "docs/figures/strip_roll_shape.png",
    "examples/strip_roll/shell.yaml": "docs/figures/strip_roll_shell.png",
    "examples/strip_roll/tapered.yaml": "docs/figures/strip_roll_tapered.png",
    "examples/strip_buckling/tapered.yaml": "docs/figures/strip_buckling_shape.png",
    "examples/shells/hinged_roof_12.7.yaml": "docs/figures/limit_point.png",
    "examples/shells/wrinkling_sheet.yaml": "docs/figures/wrinkling.png",
}
TITLES = {"path": "Paths, folds and branches", "shells": "Shells", "strip_roll": "A strip over a roll",
          "strip_buckling": "Strips that buckle over a roll", "contact": "Contact", "rubber": "Rubber",
          "plasticity": "Metal", "heat": "Heat", "electric": "Electric fields", "reaction": "Reaction and diffusion",
          "flow": "Flow", "charts": "Accuracy over work", "embedding": "Programs"}


def comment(text):
    """The lines of comment that a deck begins with, as paragraphs without the commands."""
    lines = []
    for line in text.split("\n"):
        if not line.startswith("#"):
            break
        lines.append(line[1:].strip())
    told = [line for line in lines if not re.match(r"(cd|mpirun|atrapos) ", line)]
    return "\n".join(told).strip()


def title(deck, text):
    """A deck's own title, else its file's name in words."""
    return (yaml.safe_load(text) or {}).get("title") or deck.stem.replace("_", " ").capitalize()


def commands(deck, text):
    """What makes the deck's mesh and follows its path, a line each, in its own folder (deck: relative to the root, or absolute)."""
    data = yaml.safe_load(text)
    if str(deck).startswith(CHARTS):
        return f"atrapos chart {deck.name}"
    mesh = data.get("mesh", {})
    lines = [f"atrapos mesh {deck.name}"] if "generate" in mesh else []
    model = ROOT / deck.parent / (pathlib.PurePosixPath(mesh.get("file", "none")).stem + ".inp")
    if mesh and not lines and model.is_file():
        lines.append(f"atrapos import {model.name} -o {mesh['file']}")
    plugin = " --plugin FILE" if data.get("plugins") else ""
    return "\n".join(lines + [f"atrapos run {deck.name}{plugin}"])


def drawn(deck, text, command, cache):
    """The picture of the path of a deck with a model problem, which runs in a blink."""
    if "problem" not in yaml.safe_load(text):
        return None
    digest = hashlib.sha256(text.encode()).hexdigest()[:12]
    picture = cache / f"{deck.parent.name}_{deck.stem}_{digest}.png"
    if not picture.is_file():
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([command, "run", "-q", ROOT / deck, "-o", folder], capture_output=True, text=True)
            if done.returncode:
                raise SystemExit(f"docs-site: {deck}: {done.stderr.strip()}")
            cache.mkdir(parents=True, exist_ok=True)
            picture.write_bytes((pathlib.Path(folder) / "path.png").read_bytes())
    return picture


def entry(deck, text, picture):
    """One deck: `picture` is a link from the folder's page, or nothing."""
    shown = f"![{deck.stem}]({picture})\n\n" if picture else ""
    said = re.sub(r"([*_<])", r"\\\1", comment(text))
    indented = "\n".join("    " + line for line in [f"cd {deck.parent}"] + commands(deck, text).split("\n"))
    return (f"## {title(deck, text)}\n\n{said}\n\n{shown}{indented}\n\n"
            f"<details><summary><a href=\"{deck.name}\">{deck.name}</a></summary>"
            f"<pre><code>{html.escape(text)}</code></pre></details>\n\n")


def folder_page(folder, decks, target, command, cache):
    """The page of a folder of examples; pictures that are made are put beside it in `target`."""
    words = TITLES.get(folder.name, folder.name.replace("_", " ").capitalize())
    text = f"# {words}: examples\n\n"
    for deck in decks:
        content = (ROOT / deck).read_text()
        up = "../" * len(folder.parts)
        chart = f"docs/charts/{deck.stem}.png" if str(deck).startswith(CHARTS) else None
        picture = PICTURES.get(str(deck), chart)
        if picture:
            picture = up + picture
        else:
            made = drawn(deck, content, command, cache)
            if made:
                picture = f"{deck.stem}.png"
                (target / picture).write_bytes(made.read_bytes())
        text += entry(deck, content, picture)
    return text
