"""The blocks of docs/python.md run as they stand."""
import pathlib
import re
import unittest

from folders import InFolder

PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs" / "python.md"


class Page(InFolder):
    def test_blocks(self):
        blocks = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
        self.assertGreater(len(blocks), 3)
        names = {}
        for i, block in enumerate(blocks):
            exec(compile(block, f"{PAGE.name}, block {i + 1}", "exec"), names)
        self.assertTrue(names["result"].reached_stop)
        self.assertEqual(len(set(names["loads"])), 3)


if __name__ == "__main__":
    unittest.main()
