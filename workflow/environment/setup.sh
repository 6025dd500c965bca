#!/bin/bash
# System packages, and the locked Python packages in .venv; with "dev" also those of tests, checks and benchmarks.
# uv installs them: from PATH, or a pinned version in .cache/uv.
set -euo pipefail
bash workflow/environment/system_packages.sh "$@"

uv=$(command -v uv || echo .cache/uv/bin/uv)
if [ ! -x "$uv" ]; then
  echo 'Installing uv into .cache/uv'
  python3 -m venv --clear .cache/uv
  .cache/uv/bin/pip install --quiet --require-hashes --requirement workflow/environment/uv.txt
fi

# The scripts of a virtual environment contain its absolute path: after a move, or without its interpreter, it is created again.
if [ -e .venv ] && ! { .venv/bin/python -c '' && grep -qF "$PWD/.venv/bin" .venv/bin/snakemake; } 2>/dev/null; then
  "$uv" venv --quiet --clear .venv
fi
if [ "${1-}" = dev ]; then groups=--dev; else groups=--no-dev; fi
# Inexact: additional packages of the user stay.
"$uv" sync --quiet --frozen --inexact $groups
