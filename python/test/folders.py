"""Tests that write files."""
import os
import tempfile
import unittest


class InFolder(unittest.TestCase):
    """Each test runs in an empty folder of its own."""

    def setUp(self):
        self.folder, self.before = tempfile.TemporaryDirectory(), os.getcwd()
        os.chdir(self.folder.name)

    def tearDown(self):
        os.chdir(self.before)
        self.folder.cleanup()
