#!/usr/bin/python3
"""coverage.py BUILD LIST: lines that ran, by folder of sources, from gcov's counts in BUILD; LIST gets the lines that end
with an error and never ran. A line counts as run where it ran in any object that has it.
"""
import json
import re
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
ERROR = re.compile(r"\bthrow\b|\bfail\w*\(|\bdamaged\(|\brefuse\w*\(|\bdie\(|require\(.*false")
# Not the headers of packages: most of what they have runs in kernels and tests, which are not counted.
OURS = re.compile(r"^(packages/[^/]+|src/[^/]+)/(?!include/).*\.(cpp|hpp)$")


def counted(build):
    """Source and line to how often it ran."""
    counts = defaultdict(dict)
    objects = [str(f) for f in build.rglob("*.gcda")]
    for first in range(0, len(objects), 20):
        done = subprocess.run(["gcov-12", "--json-format", "--stdout", *objects[first : first + 20]], capture_output=True,
                              check=True, cwd=build)
        for line in done.stdout.decode().splitlines():
            for file in json.loads(line)["files"]:
                path = (build / file["file"]).resolve()
                if not path.is_relative_to(ROOT):
                    continue
                name = str(path.relative_to(ROOT))
                if not OURS.match(name) or "/test/" in name:
                    continue
                lines = counts[name]
                for l in file["lines"]:
                    lines[l["line_number"]] = lines.get(l["line_number"], 0) + l["count"]
    return counts


def main():
    build, target = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
    counts = counted(build)
    folders = defaultdict(lambda: [0, 0])
    missed = []
    for name, lines in sorted(counts.items()):
        source = (ROOT / name).read_text(encoding="utf-8").splitlines()
        total = folders[OURS.match(name).group(1)]
        total[0] += sum(1 for n in lines.values() if n > 0)
        total[1] += len(lines)
        missed += [f"{name}:{l}: {source[l - 1].strip()}" for l, n in sorted(lines.items())
                   if n == 0 and l <= len(source) and ERROR.search(source[l - 1])]
    print("| folder | lines | ran |\n|---|---|---|")
    for folder, (ran, all_) in sorted(folders.items()):
        print(f"| {folder} | {all_} | {100 * ran / all_:.1f} % |")
    target.write_text("".join(line + "\n" for line in missed), encoding="utf-8")
    print(f"{len(missed)} lines that end with an error never ran: {target}")


main()
