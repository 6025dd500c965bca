"""Every figure of the paper: programs write data/<quality>/<panel>/*.h5, scripts draw them."""

import sys

from snakemake.exceptions import WorkflowError

sys.path.insert(0, workflow.basedir)
from workflow.config.plan import KINDS, QUALITIES, ConfigurationError, data_of, drawings_of, load_plan
from workflow.provenance.sources import sources_of

QUALITY = config.get("quality", "standard")
try:
    PANELS = load_plan(QUALITY)
except ConfigurationError as error:
    raise WorkflowError(str(error))


wildcard_constraints:
    quality="|".join(QUALITIES),
    panel="|".join(PANELS),


rule figures:
    input:
        [drawings_of(QUALITY, panel) for panel in PANELS],


include: "workflow/rules/simulate.smk"
include: "workflow/rules/draw.smk"
