"""Results of a panel: `load_panel("fig05", quality="standard")["paper_sigma=0.5"]["mu"]`."""

from workflow.lib.identity import ROOT
from workflow.lib.load import FormatError, Result, load
from workflow.pipeline.plan import Selection, data_path, load_plan, panel_named


def load_panel(panel: str, quality: str = "standard") -> dict[str, Result]:
    """The results of a panel's own runs by their names, those of the present configuration and sources. Raises FormatError,
    ConfigurationError, OSError."""
    planned = panel_named(load_plan(quality), panel)
    try:
        return {run.name: load(ROOT / data_path(quality, panel, run)) for run in planned.runs}
    except FormatError as error:
        remedy = f"run make panel PANEL={panel} {Selection.of(quality).arguments}"
        raise FormatError(f"{error}; {remedy}") from error
