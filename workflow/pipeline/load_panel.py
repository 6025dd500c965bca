"""Results of a panel: `load_panel("fig05", "standard")["paper_sigma=0.5"]["mu"]`."""

from workflow.lib.identity import ROOT
from workflow.lib.load import FormatError, Result, load
from workflow.pipeline.plan import Plan
from workflow.pipeline.quality import DEFAULT_QUALITY


def load_panel(panel: str, quality: str = DEFAULT_QUALITY) -> dict[str, Result]:
    """The results that a panel plots, in the order in which draw() of its script gets them: those of
    panels in `uses` by PANEL/RUN, then its own by the names of the runs. quality: also with an effort, as
    `smoke_seed=7`. They are those of the present configuration and sources. Raises FormatError,
    ConfigurationError, OSError."""
    plan = Plan(quality)
    own = plan[panel]
    try:
        return {
            run.name if run in own.runs else f"{run.panel}/{run.name}": load(ROOT / run.path)
            for run in own.plotted
        }
    except FormatError as error:
        remedy = f"run make panel PANEL={panel} {plan.quality.arguments}"
        raise FormatError(f"{error}; {remedy}") from error
