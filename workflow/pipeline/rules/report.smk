"""Products of all panels: the report of a quality, and the gallery in docs."""


rule report:
    input:
        inputs_of(PLAN),
        ancient(f"{REPORT}.html"),
    params:
        stems=[*STEMS.values(), REPORT],
    shell:
        ".venv/bin/python -m workflow.pipeline.publish {params.stems:q}"


rule report_page:
    input:
        inputs_of(PLAN),
    output:
        f"{REPORT}.html",
    log:
        f"build/logs/{QUALITY}/report.log",
    shell:
        ".venv/bin/python -m workflow.report.write --quality {QUALITY:q} --output {output:q} 2> {log:q}"


# Always executed: it changes no file that is up to date.
rule gallery:
    input:
        inputs_of(PLAN),
    log:
        f"build/logs/{QUALITY}/gallery.log",
    shell:
        ".venv/bin/python -m workflow.report.write --quality {QUALITY:q} 2> {log:q}"
