"""Decks: files, or dicts with the keys of docs/deck.md."""
import json
import os
import pathlib

from . import _atrapos
from .results import Result


def write(deck, file):
    """Writes a deck that is a dict to a file; numpy numbers and arrays are as good as Python's."""
    def plain(value):
        if hasattr(value, "tolist"):
            return value.tolist()
        if isinstance(value, os.PathLike):
            return os.fspath(value)
        raise TypeError(f"a deck has maps, lists, texts and numbers, not {type(value).__name__}")

    text = json.dumps(deck, indent=1, ensure_ascii=False, allow_nan=False, default=plain)  # JSON is YAML
    pathlib.Path(file).write_text(text + "\n", encoding="utf-8")
    return pathlib.Path(file)


def _file(deck, file=None):
    """The file of a deck; a dict is written to `file` (deck.yaml here), and its mesh is made."""
    if not isinstance(deck, dict):
        return os.fspath(deck)
    file = os.fspath(write(deck, file or "deck.yaml"))
    if "generate" in deck.get("mesh", {}):
        _atrapos.mesh(file, "")
    return file


def mesh(deck, output=None):
    """Makes the mesh that the deck generates, in its mesh/file or another one; one line on what it is.

    A dict is written to deck.yaml in the working folder.
    """
    file = os.fspath(write(deck, "deck.yaml")) if isinstance(deck, dict) else os.fspath(deck)
    return _atrapos.mesh(file, "" if output is None else os.fspath(output))


def check(deck):
    """What would be solved, as `atrapos check` prints it. Raises DeckError where the deck is wrong.

    A dict is written to deck.yaml in the working folder, and its mesh made, where it has mesh/generate.
    """
    return _atrapos.check(_file(deck))


def run(deck, results=None, restart=None, on_step=None, quiet=True):
    """Follows the path of a deck and returns its Result.

    deck: a file, or a dict; a dict is written to `<results>.yaml` and its mesh made, where it has mesh/generate.
    results: folder (default: <deck>_results). restart: folder of a run that goes on.
    on_step: called after every step with a dict (branch, step, order, radius, length, path_length, load_factor,
    residual, and the monitors by name); False ends the run, which can be restarted.
    quiet: False prints the lines of the command.

    Raises DeckError where the deck is wrong. A path that could not be followed to a stop is a Result too, with
    `reached_stop` False and the reason in `text`.
    """
    if isinstance(deck, dict):
        results = pathlib.Path(results or restart or "deck_results")
        file = _file(deck, results.with_name(results.name + ".yaml"))
    else:
        file = os.fspath(deck)
        results = pathlib.Path(results or restart or pathlib.Path(file).stem + "_results")
    again = "" if restart is None else os.fspath(restart)
    reached, text = _atrapos.run(file, os.fspath(results), again, quiet, on_step)
    return Result(results, reached_stop=reached, text=text)
