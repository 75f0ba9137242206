"""Looks at the pages of a site: dead links and anchors, and Markdown that did not become what it was meant to be.

    check_html.py FOLDER    says what is wrong, a line each, and exits with 1

Links that leave the site are not followed: the network is no part of a test.
"""
import html.parser
import pathlib
import re
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    def __init__(self, file):
        super().__init__()
        self.links, self.anchors, self.odd, self.inside = [], {"", "top"}, [], []
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.anchors.update(given[key] for key in ("id", "name") if given.get(key))
        self.links += [given[key] for key in ("href", "src") if given.get(key)]
        if tag in ("p", "em"):
            self.inside.append([tag, ""])

    def handle_endtag(self, tag):
        if self.inside and self.inside[-1][0] == tag:
            self.judge(*self.inside.pop())

    def handle_data(self, data):
        for element in self.inside:
            element[1] += data

    def judge(self, tag, text):
        """Rows of a table without its head, and formulas whose stars or underscores were taken for emphasis."""
        if tag == "p" and re.search(r"^\|.*\|$", text, re.M):
            self.odd.append(f"not a table: {text[:60]!r}")
        if tag == "em" and re.search(r"^[\s_^*]|[=^|]|[\s_^]$", text):
            self.odd.append(f"emphasis, where a formula should be code: {text[:60]!r}")


def main(folder):
    found = []
    # The API pages are doxygen's, and judged by it.
    pages = {f: Page(f) for f in sorted(folder.rglob("*.html")) if f.relative_to(folder).parts[0] != "api"}
    for file, page in pages.items():
        name = file.relative_to(folder)
        found += [f"{name}: {odd}" for odd in page.odd]
        for link in page.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            path = urllib.parse.unquote(parts.path)
            target = file if not path else pathlib.Path(folder / path[1:] if path[0] == "/" else file.parent / path)
            target = target.resolve()
            if target.is_dir():
                target /= "index.html"
            if not target.is_file():
                found.append(f"{name}: dead link {link}")
            elif target in pages and parts.fragment not in pages[target].anchors:
                found.append(f"{name}: no anchor {link}")
    found = list(dict.fromkeys(found))
    print("\n".join(found), end="\n" if found else "")
    if len(pages) < 50:
        raise SystemExit(f"docs-site: {folder} has {len(pages)} pages; there are 80 or so")
    sys.exit(1 if found else 0)


main(pathlib.Path(sys.argv[1]).resolve())
