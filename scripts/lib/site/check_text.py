"""Looks at the repository's Markdown: files that it names in code are there, and the site's plan has each page.

    check_text.py    says what is wrong, a line each, and exits with 1
"""
import re
import sys

import repository
from repository import ROOT

TOP = ("docs", "examples", "packages", "scripts", "src", "test", "python", "cmake")
# `examples/flow/benard.yaml`, `convection.yaml`: the second stands in the folder of the first.
NAMED = re.compile(r"`(?P<path>(?:%s)/[\w./-]+)`(?P<more>(?:, (?:and )?`[\w.]+\.yaml`)*)" % "|".join(TOP))


FILES = [f"/{f}" for f in repository.files()]


def named(name, page):
    """Whether there is such a file or folder: from the root, from the page, or within a package that the page is about."""
    if (ROOT / name).exists() or (ROOT / page.parent / name).exists():
        return True
    return any(f.startswith("/packages/") and f.endswith(f"/{name}") for f in FILES)


def problems(page, text):
    for match in NAMED.finditer(text):
        path = match["path"].rstrip("/")
        line = text[:match.start()].count("\n") + 1
        beside = [f"{path.rpartition('/')[0]}/{name}" for name in re.findall(r"`([^`]+)`", match["more"])]
        for name in [path] + beside:
            if not named(name, page):
                yield f"{page}:{line}: there is no {name}"


def unplanned():
    """Pages of docs that the site's plan does not name; those of theory are listed by themselves."""
    plan = (ROOT / "scripts/lib/site/mkdocs.yml").read_text()
    for page in repository.pages():
        if page.parts[0] == "docs" and str(page.parent) != "docs/theory" and not re.search(f": {page}$", plan, re.M):
            yield f"{page}: scripts/lib/site/mkdocs.yml does not name it"


found = [p for page in repository.pages() for p in problems(page, (ROOT / page).read_text())]
found += unplanned()
print("\n".join(found), end="\n" if found else "")
sys.exit(1 if found else 0)
