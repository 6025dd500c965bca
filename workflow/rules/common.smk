"""What the rules share: products and runs of panels."""


def products_of(panel):
    """Results too: Snakemake does not remake a missing intermediate whose products are there."""
    return [*data_of(PLAN, panel, QUALITY), *drawings_of(QUALITY, panel)]


def run_of(wildcards):
    return PLAN[wildcards.panel].run(wildcards.run)


def priority_of_run(wildcards):
    """The paper's panels first, one after the other, and of a panel the longest runs first."""
    later = [*PLAN].index(wildcards.panel) + len(PLAN) * wildcards.panel.startswith("ext")
    return seconds_of_run(wildcards.panel, run_of(wildcards)) - 1e6 * later


@cache
def sources_digest(script):
    return digest_of_files([*sources_of(f"workflow/figures/{script}.py"), PACKAGES])


def runs_shown_by(panel):
    """Their configurations and builds: inputs that an earlier, interrupted invocation remade are no trigger."""
    panels = with_used(PLAN, panel)
    return [
        *(one.hash() for one in panels),
        *sorted({BUILDS[run.program] for one in panels for run in one.runs}),
    ]
