"""Runs a module of the project: python -P workflow/environment/launch.py MODULE ARGUMENTS.

`workflow.a.b` is the file workflow/a/b.py and nothing else. No folder, extension module, byte code or `__init__.py`
that lies there takes its place, and no file of the project that of a package. Standard library only.
"""

import contextlib
import os
import resource
import runpy
import signal
import sys
from collections.abc import Sequence
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec, SourceFileLoader
from importlib.util import spec_from_file_location
from pathlib import Path
from types import CodeType, ModuleType

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("workflow", "tests")
# Bytes. Below 0.4 GB the imports of Snakemake and HDF5 fail in many ways, and libraries try again without end.
ADDRESS_SPACE = 1 << 30


class FromSource(SourceFileLoader):
    """Reads no byte code, and writes none."""

    def get_code(self, fullname: str) -> CodeType:
        path = self.get_filename(fullname)
        return self.source_to_code(self.get_data(path), path)


class OfTheProject(MetaPathFinder):
    """Finds the project's modules by their names alone."""

    def find_spec(
        self, name: str, path: Sequence[str] | None = None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Raises ModuleNotFoundError, so that nobody else finds another file for it."""
        place = ROOT.joinpath(*name.split("."))
        if name.partition(".")[0] not in FOLDERS:
            return None
        source = place.with_suffix(".py")
        if place.parent != ROOT and source.is_file():
            return spec_from_file_location(name, source, loader=FromSource(name, str(source)))
        if not place.is_dir():
            raise ModuleNotFoundError(f"{source} is no file", name=name)
        spec = ModuleSpec(name, None, is_package=True)
        spec.submodule_search_locations = [str(place)]
        return spec


sys.meta_path.insert(0, OfTheProject())


def require_address_space() -> None:
    limit, _ = resource.getrlimit(resource.RLIMIT_AS)
    if limit != resource.RLIM_INFINITY and limit < ADDRESS_SPACE:
        sys.exit(
            f"A process may have {limit >> 20} MB of address space here, and the pipeline needs {ADDRESS_SPACE >> 20}: raise the "
            f"limit, as by ulimit -v {ADDRESS_SPACE >> 10}"
        )


def require_font_lists() -> None:
    """matplotlib opens its lists of fonts as soon as it is imported, and would wait for ever at a pipe."""
    for path in Path(os.environ.get("MPLCONFIGDIR", os.devnull)).glob("fontlist-*.json"):
        if not path.is_file():
            sys.exit(f"{path} is no file, and matplotlib would keep its list of fonts there: remove it")


def launch() -> None:
    """What a user does is no fault of the module: a key that stops it, a reader that goes, a full disk behind the output."""
    del sys.argv[0]
    if sys.stdout is None:
        sys.exit("Standard output is closed, and nothing could be said; try >/dev/null")
    if sys.stderr is None:  # as what is started by a clock may have it; the next file would take its number
        sys.stderr = os.fdopen(os.open(os.devnull, os.O_WRONLY), "w")
    require_address_space()
    require_font_lists()
    try:
        runpy.run_module(sys.argv[0], run_name="__main__", alter_sys=True)
        sys.stdout.flush()
    except KeyboardInterrupt:
        sys.exit("Stopped.")
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # what is left is written there
        sys.exit(128 + signal.SIGPIPE)
    except OSError as error:
        from workflow.lib.places import in_one_line, is_limit  # noqa: PLC0415  # it is found by what this module sets up

        if error.filename is not None:
            sys.exit(in_one_line(error))  # where it was noticed says no more
        if not is_limit(error):
            raise
        with contextlib.suppress(OSError):  # where not even that can be opened
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(f"The system does not let this go on: {error.strerror}")
    except MemoryError:
        sys.exit("The system does not let this go on: there is not enough memory")


if __name__ == "__main__":
    launch()
