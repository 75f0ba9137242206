"""Solution paths of nonlinear finite-element problems by high-order Taylor series.

Decks (docs/deck.md) as files or dicts: `check`, `mesh`, `run`; what a run wrote: `Result`. Paths of equations
written with numpy: `follow`. docs/python.md has examples.
"""
import atexit as _atexit

from . import _atrapos
from ._atrapos import DeckError, FileError, MeshError
from .decks import check, mesh, run, write
from .meshes import import_mesh
from .problem import Path, follow
from .results import Result, States
from .taylor import Taylor, linear

__version__ = _atrapos.version
__all__ = ["DeckError", "FileError", "MeshError", "Path", "Result", "States", "Taylor", "check", "follow",
           "import_mesh", "linear", "mesh", "run", "write"]

_atexit.register(_atrapos.finalize)
