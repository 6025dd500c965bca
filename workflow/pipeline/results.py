"""Results of a panel: `load_panel("fig05", quality="standard")["paper_sigma=0.5"]["mu"]`."""

from workflow.lib.identity import ROOT, panel_of
from workflow.lib.load import FormatError, Result, load
from workflow.pipeline.plan import DEFAULT_QUALITY, Selection, load_plan, panel_named, runs_of


def load_panel(panel: str, quality: str = DEFAULT_QUALITY) -> dict[str, Result]:
    """The results that a panel plots, in the order in which draw() of its script gets them: those of
    panels in `uses` by PANEL/RUN, then its own by the names of the runs. They are those of the present
    configuration and sources. Raises FormatError, ConfigurationError, OSError."""
    load_plan.cache_clear()  # a session may edit the configuration
    plan = load_plan(quality)
    runs = runs_of(plan, [panel_named(plan, panel).name], quality)
    names = {path: (panel_of(path), run.name) for path, run in runs.items()}
    try:
        return {
            run if owner == panel else f"{owner}/{run}": load(ROOT / path)
            for path, (owner, run) in names.items()
        }
    except FormatError as error:
        remedy = f"run make panel PANEL={panel} {Selection.parse(quality).arguments}"
        raise FormatError(f"{error}; {remedy}") from error
