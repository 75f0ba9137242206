"""The notebooks of examples/python, cell by cell."""
import json
import os
import pathlib
import tempfile
import unittest

import matplotlib

matplotlib.use("Agg")

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "examples" / "python"


class Notebooks(unittest.TestCase):
    def execute(self, name):
        cells = json.loads((FOLDER / name).read_text(encoding="utf-8"))["cells"]
        names = {}
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                for i, cell in enumerate(cells):
                    if cell["cell_type"] == "code":
                        self.assertEqual(cell["outputs"], [], "outputs are not kept")
                        exec(compile("".join(cell["source"]), f"{name}, cell {i + 1}", "exec"), names)
            finally:
                os.chdir(before)
        return names

    def test_all(self):
        notebooks = sorted(path.name for path in FOLDER.glob("*.ipynb"))
        self.assertEqual(notebooks, ["arch.ipynb", "column.ipynb"])
        for name in notebooks:
            with self.subTest(name):
                self.execute(name)


if __name__ == "__main__":
    unittest.main()
