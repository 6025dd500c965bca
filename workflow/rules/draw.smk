"""One panel from its results: figures/<quality>/<panel>.{pdf,png,svg,csv,json}."""


rule draw:
    input:
        lambda wildcards: data_of(PLAN, wildcards.panel, QUALITY),
    output:
        multiext("figures/{quality}/{panel}", ".pdf", ".svg", ".csv", ".json"),
        png=report(
            "figures/{quality}/{panel}.png",
            caption="../report/caption.rst",
            category="{quality}",
            labels={"panel": "{panel}"},
        ),
    log:
        "build/logs/{quality}/{panel}.log",
    wildcard_constraints:
        panel="(?!ext)[^/]+",
    priority: 10**9  # before any run
    params:
        command=lambda wildcards: drawing_command(
            PLAN, QUALITY, wildcards.panel, f"figures/{QUALITY}/{wildcards.panel}"
        ),
        sources=lambda wildcards: sources_digest(PLAN[wildcards.panel].script),
        runs=lambda wildcards: runs_shown_by(wildcards.panel),
    shell:
        "{params.command} 2> {log:q}"


use rule draw as draw_extension with:
    wildcard_constraints:
        panel="ext[^/]+",
