"""Collects the site's pages: the repository's Markdown, folders that it links to, the gallery, the page of keys.

    pages.py COMMAND FOLDER CACHE   the atrapos command; where mkdocs.yml and pages/ go; where pictures are kept
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

import yaml

import gallery
import keys_page
import repository
from repository import ROOT

LINK = re.compile(r"(\]\()([^)\s#]+)(#[^)\s]*)?(\))")
command, folder, cache = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
target = folder / "pages"
known = {str(f) for f in repository.files()}
folders = set()


def copy(name):
    (target / name).parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(ROOT / name, target / name)


def linked(page):
    """The page's text, links to folders made links to their pages; what it links to besides is copied."""
    def replace(match):
        before, link, anchor, after = match.groups()
        path = os.path.normpath(page.parent / link)
        if "://" in link or path.startswith(".."):
            return match.group(0)
        if path in known and not path.endswith(".md"):
            copy(path)
        elif (ROOT / path).is_dir():
            own = "README.md" if f"{path}/README.md" in known else "index.md"
            folders.add(pathlib.PurePosixPath(path))
            link = f"{link.rstrip('/')}/{own}"
        return before + link + (anchor or "") + after

    return LINK.sub(replace, (ROOT / page).read_text())


def heading(page):
    return re.search(r"^# (.*)", (target / page).read_text(), re.M).group(1)


def write(name, text):
    (target / name).parent.mkdir(parents=True, exist_ok=True)
    (target / name).write_text(text)


def listing(where):
    """A folder that is linked to and has no page: what is in it."""
    inside = sorted(name for name in known if name.startswith(f"{where}/"))
    text = f"# {where}\n\n"
    for name in inside:
        own = name[len(str(where)) + 1:]
        if name.endswith(".md"):
            text += f"- [{heading(name)}]({own})\n"
        else:
            copy(name)
            text += f"- [{own}]({own})\n"
    return text


def main():
    shutil.rmtree(target, ignore_errors=True)
    pages = repository.pages()
    for page in pages:
        write(page, linked(page))
    for f in repository.files():
        if f.parts[0] in ("docs", "examples") and f.suffix != ".md":
            copy(f)

    by_folder = {}
    for deck in repository.decks():
        by_folder.setdefault(deck.parent, []).append(deck)
    for where, decks in by_folder.items():
        write(where / "index.md", gallery.folder_page(where, decks, target / where, command, cache))
    write("examples/index.md", "# Gallery\n\nDecks that run, folder by folder.\n\n" +
          "".join(f"- [{heading(where / 'index.md')}]({where.relative_to('examples')}/index.md): " +
                  ", ".join(deck.stem for deck in decks) + "\n" for where, decks in by_folder.items()))
    for where in sorted(folders):
        if not any((target / where / name).exists() for name in ("README.md", "index.md")):
            write(where / "index.md", listing(where))

    lines = subprocess.run([command, "keys"], check=True, capture_output=True, text=True).stdout.splitlines()
    write("docs/deck_keys.md", keys_page.page(lines))

    libraries = [page for page in pages if page.parts[0] == "packages"]
    write("packages/index.md", "# Libraries\n\nAll classes and functions: [the API pages](../api/index.html).\n\n" +
          "".join(f"- [{heading(page)}]({page.relative_to('packages')})\n" for page in libraries))

    def named(names):
        return [{heading(name): str(name)} for name in names]

    made = {"docs/theory": named(sorted(p for p in pages if str(p.parent) == "docs/theory")),
            "examples": named(["examples/index.md"] + [w / "index.md" for w in by_folder]),
            "packages": named(["packages/index.md"] + libraries)}
    plan = yaml.safe_load((pathlib.Path(__file__).parent / "mkdocs.yml").read_text())
    plan["nav"] = [{k: made.get(v, v) if isinstance(v, str) else v for k, v in item.items()} for item in plan["nav"]]
    guide = next(item["Guide"] for item in plan["nav"] if "Guide" in item)
    guide.insert(1, {"All keys of a deck": "docs/deck_keys.md"})
    (folder / "mkdocs.yml").write_text(yaml.safe_dump(plan, sort_keys=False))


main()
