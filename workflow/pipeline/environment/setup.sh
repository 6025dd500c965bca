#!/bin/bash
# System packages, and the locked Python packages in .venv; with "dev" also those of tests and checks, with "slurm" those of PROFILE=slurm.
# uv installs them: from PATH, or a fixed version in .cache/uv.
set -euo pipefail
bash workflow/pipeline/environment/system_packages.sh "$@"

uv=$(command -v uv || echo .cache/uv/bin/uv)
if [ ! -x "$uv" ]; then
  echo 'Installing uv into .cache/uv'
  python3 -I -m venv --clear .cache/uv
  .cache/uv/bin/pip install --quiet --disable-pip-version-check uv==0.13.9
fi

groups='--no-default-groups'
for name; do case $name in dev | slurm) groups+=" --group $name" ;; esac; done
# A relocatable environment may be copied and moved. Without its interpreter it is created again.
.venv/bin/python -I -c '' 2>/dev/null || "$uv" venv --quiet --clear --relocatable .venv
for packages in .venv/lib/python3*/site-packages; do
  echo ../../../.. >"$packages/project.pth" # from the folder that the environment is in
done
# `uv sync` would need the index in uv.lock; this installs from a mirror, too, with the locked hashes. Other packages of the user stay.
"$uv" export --quiet --frozen --no-emit-project $groups >.venv/locked.txt
"$uv" pip install --quiet --python .venv --require-hashes --requirement .venv/locked.txt
