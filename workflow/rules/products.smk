"""Products of a whole quality: report, gallery and crate; and the measured tables of accuracy against time."""

from workflow.lib.closure import hashes_of
from workflow.lib.files import file_hash, project_files
from workflow.lib.identity import identity

PRODUCTS = [path for panel in PLAN for path in products_of(panel)]
PACKED = f"{QUALITY}-{PANEL}" if PANEL else QUALITY


def identity_of(script, *inputs):
    return identity(script, [*map(str, inputs)], hashes_of(script))


def archive(wildcards):
    """Path of the crate, which has the records of the panels and all sources."""
    records = [RECORDS[panel] for panel in ([PANEL] if PANEL else PLAN)]
    content = identity([*map(str, records)], {path: file_hash(Path(path)) for path in project_files()})
    return f"build/crate/lorentz-gas-{PACKED}.{content}.zip"


def builds():
    return {build_id(run.program) for one in PLAN.values() for run in one.runs}


REPORT, GALLERY, TRADEOFF = (
    record_path(Path(stem), identity_of(script, *inputs))
    for stem, script, inputs in (
        (f"figures/{QUALITY}/report", "workflow/report/write.py", RECORDS.values()),
        ("docs/gallery/gallery", "workflow/report/gallery.py", RECORDS.values()),
        ("figures/tradeoff/tradeoff", "workflow/tradeoff/tradeoff.py", sorted(builds())),
    )
)


ruleorder: write_report > draw > draw_extension


rule report:
    input:
        PRODUCTS,
        ancient(valid(REPORT)),


rule gallery:
    input:
        ancient(valid(GALLERY)),


rule crate:
    input:
        archive,


rule tradeoff:
    input:
        valid(TRADEOFF),


rule write_report:
    input:
        PRODUCTS,
    output:
        REPORT,
    params:
        identity=REPORT.suffixes[0].strip("."),
    shell:
        ".venv/bin/python -m workflow.report.write --quality {QUALITY:q} --identity {params.identity}"


rule write_gallery:
    input:
        PRODUCTS,
    output:
        GALLERY,
    params:
        identity=GALLERY.suffixes[0].strip("."),
    shell:
        ".venv/bin/python -m workflow.report.gallery --quality {QUALITY:q} --identity {params.identity}"


rule write_crate:
    input:
        products_of(PANEL) if PANEL else PRODUCTS,
    output:
        f"build/crate/lorentz-gas-{PACKED}.{{identity}}.zip",
    params:
        panel=f"--panel {PANEL}" if PANEL else "",
    shell:
        ".venv/bin/python -m workflow.provenance.crate --quality {QUALITY:q} {params.panel} --archive {output:q}"


rule write_tradeoff:
    output:
        TRADEOFF,
    params:
        identity=TRADEOFF.suffixes[0].strip("."),
    shell:
        ".venv/bin/python -m workflow.tradeoff.tradeoff --identity {params.identity}"
