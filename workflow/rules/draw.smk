"""One panel from its results: figures/<quality>/<panel>.{pdf,png,svg,csv,json}."""


def script_of(panel):
    return f"workflow/figures/{PLAN[panel].script}.py"


@cache
def sources_digest(script):
    return digest_of_files([*sources_of(script), PACKAGES])


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
    params:
        script=lambda wildcards: PLAN[wildcards.panel].script,
        sources=lambda wildcards: sources_digest(script_of(wildcards.panel)),
        configuration=lambda wildcards: PLAN[wildcards.panel].hash(),
        stem=lambda wildcards: f"figures/{QUALITY}/{wildcards.panel}",
    priority: 10**9  # before any run
    shell:
        ".venv/bin/python -P -m workflow.figures.{params.script} --configuration {params.configuration}"
        " --output {params.stem:q} --data {input:q} 2> {log:q}"
