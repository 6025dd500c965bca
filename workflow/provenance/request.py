"""What Snakemake is asked for by --config: a quality, a panel, whether all is made anew, and how long a job is on a cluster."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from workflow.lib.plan import Panel, load_plan, panel_named
from workflow.lib.strict_yaml import ConfigurationError
from workflow.provenance.repository import ROOT


@dataclass(frozen=True)
class Request:
    quality: str
    panels: dict[str, Panel]  # the plan
    asked: list[str]  # the panel of the rule of that name, if there is one
    fresh: bool
    batch: float  # minutes that a job on a cluster is to take; 0 on one machine

    @classmethod
    def of(cls, config: Mapping[str, Any]) -> "Request":
        """Raises ConfigurationError."""
        if unknown := {*config} - {"quality", "panel", "fresh", "batch"}:
            raise ConfigurationError(f"--config {min(unknown)}: choose from quality, panel, fresh, batch")
        fresh = config.get("fresh", False)
        if fresh not in (True, False, "yes", "no"):
            raise ConfigurationError(f"--config fresh={fresh}: it must be yes or no")
        batch = config.get("batch", 0)
        if type(batch) not in (int, float) or not 0 <= batch < math.inf:
            raise ConfigurationError(f"--config batch={batch}: it must be a number of minutes")
        quality = str(config.get("quality", "standard"))
        plan = load_plan(quality)
        for panel in plan.values():
            script = f"workflow/figures/{panel.script}.py"
            if not (ROOT / script).is_file():
                raise ConfigurationError(f"paper.yaml: panels.{panel.name}: its script {script} is missing")
        asked = [panel_named(plan, str(config["panel"])).name] if "panel" in config else []
        return cls(quality, plan, asked, fresh in (True, "yes"), batch)
