"""python3 -m atrapos: the atrapos command."""
import os
import sys

from .command import program

os.execv(program(), [program()] + sys.argv[1:])
