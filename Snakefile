"""Every figure of the paper: programs write data/<quality>/<panel>/*.h5, scripts draw them.

What runs again is decided by content (workflow/provenance/chain.py): all inputs are `ancient`, so that their times do
not count, and a job that is stale is forced when it enters the DAG. When the run starts, stale products are moved to
build/replaced; a dry run only names them.
"""

import json
import re
import sys
from pathlib import Path

from snakemake.logging import logger

sys.path.append(workflow.basedir)  # last, so that no file here takes the place of a package
from workflow.lib.plan import ConfigurationError, data_of, drawings_of, load_plan, panel_named
from workflow.provenance.chain import Chain
from workflow.provenance.stale import (
    REPLACED,
    forget_partial,
    replace,
    retire,
    set_damaged_lock_aside,
    unasked,
)

if unknown := {*config} - {"quality", "panel", "fresh"}:
    sys.exit(f"--config {min(unknown)}=… is not known: choose from quality, panel, fresh")
if config.get("fresh", "yes") not in (True, False, "yes", "no"):
    sys.exit("--config fresh=… must be yes or no")
QUALITY, PANEL = str(config.get("quality", "standard")), str(config.get("panel") or "")
FRESH = config.get("fresh") in (True, "yes")
try:
    PANELS = load_plan(QUALITY)
    ASKED = [panel_named(PANELS, PANEL).name] if PANEL else []
    CHAIN = Chain(QUALITY, PANELS)
except ConfigurationError as error:
    sys.exit(str(error))
for panel in PANELS.values():
    if not Path(f"workflow/figures/{panel.script}.py").is_file():
        sys.exit(
            f"paper.yaml: panels.{panel.name}: workflow/figures/{panel.script}.py, which draws it, is missing"
        )


include: "workflow/rules/common.smk"


wildcard_constraints:
    quality=QUALITY,
    panel="|".join(PANELS),
    run="|".join({re.escape(run.name) for panel in PANELS.values() for run in panel.runs}),


rule figures:
    input:
        all_figures,


rule panel:
    input:
        [path for name in ASKED for path in drawings_of(QUALITY, name)],


include: "workflow/rules/simulate.smk"
include: "workflow/rules/draw.smk"
