"""One panel from its runs: figures/<quality>/<panel>.{pdf,png,svg,csv}."""


rule draw:
    input:
        data=lambda wildcards: data_of(PANELS, wildcards.panel, wildcards.quality),
        sources=lambda wildcards: sources_of(f"workflow/scripts/{PANELS[wildcards.panel].script}.py"),
        lock="requirements.lock",
    output:
        multiext("figures/{quality}/{panel}", ".pdf", ".png", ".svg", ".csv"),
    log:
        "build/logs/{quality}/{panel}.log",
    benchmark:
        "build/benchmarks/{quality}/{panel}.tsv"
    conda:
        "../environment/conda.yaml"
    params:
        module=lambda wildcards: f"workflow.scripts.{PANELS[wildcards.panel].script}",
        configuration=lambda wildcards: PANELS[wildcards.panel].hash(),
        stem="figures/{quality}/{panel}",
    shell:
        ".venv/bin/python -m {params.module} --configuration {params.configuration}"
        " --sources {input.sources} --lock {input.lock}"
        " --output {params.stem} --data {input.data} 2> {log}"
