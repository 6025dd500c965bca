"""Runs a module: python -P workflow/environment/launch.py MODULE ARGUMENTS.

The project comes last on the path of imports, so that no file in it takes the place of a package.
"""

import runpy
import sys
from pathlib import Path

if __name__ == "__main__":
    sys.path.append(str(Path(__file__).resolve().parents[2]))
    del sys.argv[0]
    runpy.run_module(sys.argv[0], run_name="__main__", alter_sys=True)
