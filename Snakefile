"""Every figure of the paper: programs write data/<quality>/<panel>/*.h5, scripts draw them.

What runs again is decided by content (workflow/provenance/chain.py): all inputs are `ancient`, so that their times do
not count, and a job that is stale is forced when it enters the DAG. When the run starts, stale products are moved to
build/replaced; a dry run only names them.
"""

import json
import re
import sys

from snakemake.exceptions import WorkflowError
from snakemake.logging import logger

sys.path.insert(0, workflow.basedir)
from workflow.lib.plan import QUALITIES, ConfigurationError, data_of, drawings_of, load_plan
from workflow.provenance.chain import Chain
from workflow.provenance.stale import REPLACED, replace, retire, unasked

QUALITY = config.get("quality", "standard")
try:
    PANELS = load_plan(QUALITY)
except ConfigurationError as error:
    raise WorkflowError(str(error))
CHAIN = Chain(QUALITY, PANELS)


include: "workflow/rules/common.smk"


wildcard_constraints:
    quality=QUALITY,
    panel="|".join(PANELS),
    run="|".join({re.escape(run.name) for panel in PANELS.values() for run in panel.runs}),


rule figures:
    input:
        all_figures,


include: "workflow/rules/simulate.smk"
include: "workflow/rules/draw.smk"
