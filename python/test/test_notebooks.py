"""The notebooks of examples/python, cell by cell."""
import json
import pathlib
import unittest

import matplotlib

from folders import InFolder

matplotlib.use("Agg")

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "examples" / "python"


class Notebooks(InFolder):
    def test_all(self):
        notebooks = sorted(path.name for path in FOLDER.glob("*.ipynb"))
        self.assertEqual(notebooks, ["arch.ipynb", "column.ipynb"])
        for name in notebooks:
            with self.subTest(name):
                names = {}
                for i, cell in enumerate(json.loads((FOLDER / name).read_text(encoding="utf-8"))["cells"]):
                    if cell["cell_type"] == "code":
                        self.assertEqual(cell["outputs"], [], "outputs are not kept")
                        exec(compile("".join(cell["source"]), f"{name}, cell {i + 1}", "exec"), names)


if __name__ == "__main__":
    unittest.main()
