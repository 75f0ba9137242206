"""The blocks of docs/python.md run as they stand."""
import os
import pathlib
import re
import tempfile
import unittest

PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs" / "python.md"


class Page(unittest.TestCase):
    def test_blocks(self):
        blocks = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
        self.assertGreater(len(blocks), 3)
        names = {}
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                for i, block in enumerate(blocks):
                    exec(compile(block, f"{PAGE.name}, block {i + 1}", "exec"), names)
            finally:
                os.chdir(before)
        self.assertTrue(names["result"].reached_stop)
        self.assertEqual(len(set(names["loads"])), 3)


if __name__ == "__main__":
    unittest.main()
