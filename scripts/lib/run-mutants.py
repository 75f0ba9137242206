#!/usr/bin/python3
"""run-mutants.py MUTANTS SEED [BUILD]: whole runs of example decks with numbers changed at random, to three steps.

Each must end with exit code 0, 2 or 3, by no signal, within 10 s of processor time, with no more than one line on stderr
where the code is 2. Prints the counts; exits with 1 where one does not, and says which (its deck is kept). Used by
`scripts/fuzz --runs-of-decks`.
"""
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SECONDS = 10
LITTLE = 1  # of a deck that is changed: a second of processor time
NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?(?![\w.])")
EXTREMES = ["0", "-1", "1", "1e-300", "1e300", "-1e-12", "1e12", "2147483647", "0.5", "3"]


def run(command, words, folder, seconds=SECONDS):
    def limited():
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 5))
        resource.setrlimit(resource.RLIMIT_AS, (16 << 30, 16 << 30))

    return subprocess.run([command, *words], cwd=folder, capture_output=True, text=True, errors="replace",
                          preexec_fn=limited, timeout=600)


def shortened(text):
    """The deck to three steps; None where it has no stop to add to."""
    text, count = re.subn(r"stop: \{(?!.*steps:)", "stop: {steps: 3, ", text, count=1)
    return text if count == 1 else None


def mutant(text, choose):
    for _ in range(choose.randint(1, 3)):
        # Not in comments, and not the number of steps.
        places = [m for m in NUMBER.finditer(text) if not re.search(r"^\s*#|\bsteps: $", text[: m.start()].rsplit("\n", 1)[-1])]
        at = choose.choice(places)
        if choose.random() < 0.5:
            word = choose.choice(EXTREMES)
        else:
            value = float(at.group()) * choose.choice([-1, 0.1, 0.5, 0.999, 1.001, 2, 10, 1000])
            # A count of elements that is a thousand times as large is a long run and no defect.
            whole = re.fullmatch(r"-?\d+", at.group())
            word = str(int(float(at.group()) * choose.choice([-1, 0, 2, 3]))) if whole else repr(value)
        text = text[: at.start()] + word + text[at.end() :]
    return text


def fault(done):
    """What is wrong with how a run ended; empty: nothing."""
    if done.returncode not in (0, 2, 3):
        return f"exit code {done.returncode}"
    if done.returncode == 2 and len(done.stderr.strip().splitlines()) != 1:
        return f"{len(done.stderr.strip().splitlines())} lines of error"
    return ""


def decksThatRun(command, work):
    """Texts of the decks that end in three steps within the time."""
    for deck in sorted(ROOT.glob("examples/*/*.yaml")):
        text = shortened(deck.read_text(encoding="utf-8"))
        if text is None:
            continue
        folder = Path(tempfile.mkdtemp(dir=work))
        (folder / "deck.yaml").write_text(text, encoding="utf-8")
        made = "generate:" not in text or run(command, ["mesh", "-q", "deck.yaml"], folder, LITTLE).returncode == 0
        if made and run(command, ["run", "-q", "deck.yaml"], folder, LITTLE).returncode == 0:
            yield text
        shutil.rmtree(folder)


def main():
    mutants, choose = int(sys.argv[1]), random.Random(int(sys.argv[2]))
    command = str((ROOT / (sys.argv[3] if len(sys.argv) > 3 else "build/release") / "bin/atrapos").resolve())
    work = Path(tempfile.mkdtemp())
    decks = list(decksThatRun(command, work))
    codes, slowest, faults = Counter(), 0.0, 0
    print(f"{len(decks)} decks end within {LITTLE} s", flush=True)
    for number in range(mutants):
        folder = Path(tempfile.mkdtemp(dir=work))
        text = mutant(choose.choice(decks), choose)
        (folder / "deck.yaml").write_text(text, encoding="utf-8")
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = run(command, ["mesh", "-q", "deck.yaml"], folder) if "generate:" in text else None
        if done is None or done.returncode == 0:
            done = run(command, ["run", "-q", "deck.yaml"], folder)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        slowest = max(slowest, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
        codes[done.returncode] += 1
        wrong = fault(done)
        if wrong:
            faults += 1
            kept = f"{work}/mutant-{number}.yaml"
            shutil.copy(folder / "deck.yaml", kept)
            print(f"{kept}: {wrong}: {done.stderr.strip()[:300]}", flush=True)
        shutil.rmtree(folder)
    print(f"{mutants} mutants: exit codes {dict(sorted(codes.items()))}, slowest {slowest:.1f} s of processor time, {faults} faults")
    if faults == 0:
        shutil.rmtree(work)
    return 1 if faults else 0


sys.exit(main())
