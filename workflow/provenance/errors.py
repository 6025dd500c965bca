"""Prints the errors that the runs of a quality or panel have reached, and names those that missed the requested one."""

import sys

from workflow.cluster.cost import LEAST
from workflow.lib.command import command
from workflow.lib.files import ROOT
from workflow.lib.load import NOT_REACHED, FormatError, load_provenance
from workflow.lib.plan import Quality, data_path
from workflow.provenance.build_id import BuildError


def main() -> None:
    options, _, panels = command(__doc__)
    quality = Quality.of(options.quality)
    missed = []
    total = 0
    for panel in panels:
        for run in (run for run in panel.runs if run.target is not None):
            try:
                stated = load_provenance(ROOT / data_path(quality.name, panel.name, run))
            except (FormatError, BuildError) as fault:
                sys.exit(f"{fault}; run make panel PANEL={panel.name} {quality.arguments}")
            error = float(stated["achieved_error"]) / (run.scale or 1)
            line = f"{panel.name}/{run.name}: error {error:.2g} of {stated['target_quantity']}, requested {run.target:g}"
            if error <= (
                run.target or 0
            ):  # the upper bound of the error can still exceed the target [eq. 52]
                line += f", not with 95 % confidence and at least {LEAST} replicas"
            missed += [line] if stated["converged"] == NOT_REACHED else []
            total += 1
    print(f"{total - len(missed)} of {total} runs have reached an error of {quality.error:g}")
    print(*(f"  {line}" for line in missed), sep="\n", end="\n" * bool(missed))


if __name__ == "__main__":
    main()
