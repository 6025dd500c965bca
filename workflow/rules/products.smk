"""Products of a whole quality: report, gallery and crate; and the measured tables of accuracy against time."""


ruleorder: report_page > draw > draw_extension


rule report:
    input:
        PRODUCTS,
        ancient(valid(REPORT)),


rule gallery:
    input:
        PRODUCTS,
        ancient(valid(GALLERY)),


rule crate:
    input:
        archive,


rule tradeoff:
    input:
        valid(TRADEOFF),


rule report_page:
    input:
        PRODUCTS,
    output:
        REPORT,
    log:
        "build/logs/report.log",
    params:
        words=words_of("workflow.report.write", REPORT),
    shell:
        "{params.words} 2> {log:q}"


rule gallery_pages:
    input:
        PRODUCTS,
    output:
        GALLERY,
    log:
        "build/logs/gallery.log",
    params:
        words=words_of("workflow.report.gallery", GALLERY),
    shell:
        "{params.words} 2> {log:q}"


rule archive:
    input:
        [path for panel in PANELS or PLAN for path in products_of(panel)],
    output:
        f"build/crate/lorentz-gas-{PACKED}.{{identity}}.zip",
    log:
        "build/logs/crate.{identity}.log",
    params:
        words=f".venv/bin/python -m workflow.provenance.crate --quality {QUALITY}",
        panel=" ".join(f"--panel {name}" for name in PANELS),
    shell:
        "{params.words} {params.panel} --archive {output:q} 2> {log:q}"


rule tradeoff_tables:
    output:
        TRADEOFF,
    log:
        "build/logs/tradeoff.log",
    params:
        words=words_of("workflow.tradeoff.tradeoff", TRADEOFF),
    shell:
        "{params.words} 2> {log:q}"
