"""What the scripts of the site know of the repository: its files, the links of its pages, its decks."""
import pathlib
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[3]
# Decks of `atrapos chart`, which runs other decks.
CHARTS = "examples/charts/"


def files():
    """Paths of all files that git has, and of new ones that it does not ignore, relative to the root."""
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT,
                            check=True, capture_output=True, text=True).stdout
    return [pathlib.PurePosixPath(name) for name in listed.split("\0") if name and (ROOT / name).is_file()]


def pages():
    """The Markdown files that become pages: those at the top, in docs, and each README."""
    return [f for f in files()
            if f.suffix == ".md" and (len(f.parts) == 1 or f.parts[0] == "docs" or f.name == "README.md")]


def decks():
    """The YAML files of examples, charts among them."""
    return [f for f in files() if f.parts[0] == "examples" and f.suffix == ".yaml"]


def prose(text):
    """Markdown without its blocks of code, line by line, so that line numbers stay."""
    lines, fenced, before, listed = [], False, "", False
    for line in text.split("\n"):
        fence = line.lstrip().startswith("```")
        indented = line.startswith("    ")
        # Four spaces are code behind an empty line, but not within a list.
        code = fenced or fence or (indented and not before.strip() and not listed)
        lines.append("" if code else line)
        fenced = fenced != fence
        if line.strip() and not indented:
            listed = re.match(r"([-*]|\d+\.) ", line) is not None
        # A line of code keeps the next one code.
        before = "" if code else line
    return "\n".join(lines)
