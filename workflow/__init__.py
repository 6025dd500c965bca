"""Results in Python: `from workflow import load, load_panel`. They are imported when they are used."""

from importlib import import_module
from typing import Any

MODULES = {
    "load": "workflow.lib.load",
    "load_panel": "workflow.pipeline.load_panel",
}


def __getattr__(name: str) -> Any:
    if name not in MODULES:
        raise AttributeError(f"module workflow has no attribute {name}")
    return getattr(import_module(MODULES[name]), name)
