"""What the rules share: runs of panels, products, and their records."""

from workflow.lib.closure import hashes_of
from workflow.lib.files import file_hash, project_files
from workflow.lib.identity import identity

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


def without_foreign_parents(record):
    """The path of a record, which is removed if a result that it names has changed since, so that both are made again."""
    if record.exists():
        parents = read_panel(record)["parents"].data.items()
        if any(Path(path).exists() and file_hash(Path(path)) != one["sha256"] for path, one in parents):
            record.unlink()
    return record


def set_aside(path):
    """Renames a damaged or edited result that is about to be read, so that it is made again."""
    from workflow.lib.load import FormatError, load  # 0.3 s, where a panel is rendered

    try:
        whole = not Path(path).exists() or bool(load(path))
    except FormatError:
        whole = False
    except OSError:  # unreadable is not damaged
        whole = True
    if not whole:
        print(f"{path} is edited or damaged and is made again; it is kept as {path}.damaged", file=sys.stderr)
        Path(path).rename(f"{path}.damaged")


def run_of(wildcards):
    return PLAN[wildcards.panel].run(wildcards.run)


def limit_of_run(wildcards):
    """Seconds after which a run with a target error starts no replica: with HOURS, its share of the time by estimated cost."""
    if EFFORT.hours is None:
        return None
    panels = {panel.name: panel for name in PANELS or PLAN for panel in with_used(PLAN, name)}
    runs = [(name, run) for name, panel in panels.items() for run in panel.runs]
    share = seconds_of_run(wildcards.panel, run_of(wildcards)) / sum(seconds_of_run(*run) for run in runs)
    return 3600 * EFFORT.hours * (min(1, share * workflow.cores) if workflow.cores else 1)


def priority_of_run(wildcards):
    """Runs that the paper's panels show first, one panel after the other, and of a panel the longest runs first."""
    users = (name for name, panel in PLAN.items() if wildcards.panel in (name, *panel.uses))
    later = min([*PLAN].index(name) + len(PLAN) * name.startswith("ext") for name in users)
    return seconds_of_run(wildcards.panel, run_of(wildcards)) - 1e6 * later


def identity_of(script, *inputs):
    return identity(script, [*map(str, inputs)], hashes_of(script))


def words_of(module, record):
    """Command that writes a product with its record."""
    return f".venv/bin/python -m {module} --quality {QUALITY} --identity {record.suffixes[-2].strip('.')}"


def archive(wildcards):
    """Path of the crate, which has the records of the panels and all sources."""
    records = [str(RECORDS[panel]) for panel in PANELS or PLAN]
    content = identity(records, {path: file_hash(Path(path)) for path in project_files()})
    return f"build/crate/lorentz-gas-{PACKED}.{content}.zip"


PRODUCTS = [path for panel in PLAN for path in products_of(panel)]
PACKED = "-".join([QUALITY, *PANELS])
BUILDS = sorted({build_id(run.program) for one in PLAN.values() for run in one.runs})
REPORT, GALLERY, TRADEOFF = (
    record_path(Path(stem), identity_of(script, *inputs))
    for stem, script, inputs in (
        (f"figures/{QUALITY}/report", "workflow/report/write.py", RECORDS.values()),
        ("docs/gallery/gallery", "workflow/report/gallery.py", RECORDS.values()),
        ("figures/tradeoff/tradeoff", "workflow/tradeoff/tradeoff.py", BUILDS),
    )
)
