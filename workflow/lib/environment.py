"""Environment variables that affect pictures or numbers, with the values that the Makefile sets."""

from collections.abc import MutableMapping

from workflow.lib.figure_metadata import ROOT

SET = {
    "LC_ALL": "C.UTF-8",
    "TZ": "UTC",
    "SOURCE_DATE_EPOCH": "1230768000",
    "PYTHONHASHSEED": "0",
    "PYTHONSAFEPATH": "1",
    "PYTHONNOUSERSITE": "1",
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "MPLBACKEND": "Agg",
    "MPLCONFIGDIR": str(ROOT / ".cache/matplotlib"),
}
UNSET = ("PYTHONPATH", "PYTHONHOME", "MATPLOTLIBRC", "HDF5_PLUGIN_PATH")


def clean(environment: MutableMapping[str, str]) -> None:
    environment.update(SET)
    for name in UNSET:
        environment.pop(name, None)
