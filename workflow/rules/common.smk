"""What the rules share: runs of panels, products, and their records."""

RECORDS = {
    name: record_path(Path("figures", QUALITY, name), panel_identity(name, panel.script, DATA[name]))
    for name, panel in PLAN.items()
}


def products_of(panel):
    """Results too: Snakemake does not remake a missing result whose figure is there."""
    return [*map(ancient, DATA[panel]), ancient(valid(RECORDS[panel]))]


def valid(record):
    """The path of a record, which is removed if its files are missing or edited, so that they are made again."""
    if record.exists() and not is_whole(record):
        record.unlink()
    return record


def run_of(wildcards):
    return PLAN[wildcards.panel].run(wildcards.run)


def priority_of_run(wildcards):
    """Runs that the paper's panels show first, one panel after the other, and of a panel the longest runs first."""
    users = (name for name, panel in PLAN.items() if wildcards.panel in (name, *panel.uses))
    later = min([*PLAN].index(name) + len(PLAN) * name.startswith("ext") for name in users)
    return seconds_of_run(wildcards.panel, run_of(wildcards)) - 1e6 * later
