"""One panel from its runs: figures/<quality>/<panel>.{pdf,png,svg,csv}."""


rule draw:
    input:
        data=ancient(lambda wildcards: data_of(PANELS, wildcards.panel, wildcards.quality)),
        sources=ancient(lambda wildcards: sources_of(f"workflow/scripts/{PANELS[wildcards.panel].script}.py")),
        lock=ancient("requirements.lock"),
    output:
        multiext("figures/{quality}/{panel}", *(f".{kind}" for kind in KINDS)),
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
        """
        exec 2> {log}
        .venv/bin/python -m {params.module} --configuration {params.configuration} \
            --sources {input.sources} --lock {input.lock} --output {params.stem} --data {input.data}
        .venv/bin/python -S -m workflow.provenance.lock --quality {wildcards.quality} \
            --job {wildcards.panel} --outputs {output}
        """
