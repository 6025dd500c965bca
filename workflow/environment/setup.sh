#!/bin/bash
# System packages, and the locked Python packages in .venv; with "dev" also those of tests, checks and benchmarks.
# uv installs them: from PATH, or a pinned version in .cache/uv.
set -euo pipefail
bash workflow/environment/system_packages.sh "$@"

uv=$(command -v uv || echo .cache/uv/bin/uv)
if [ ! -x "$uv" ]; then
  echo 'Installing uv into .cache/uv'
  python3 -m venv --clear .cache/pip
  # A target or user scheme in pip's configuration has no effect; its index and certificates have.
  .cache/pip/bin/pip install --quiet --disable-pip-version-check --no-user --target .cache/uv --require-hashes --requirement workflow/environment/uv.txt
fi

if [ "${1-}" = dev ]; then groups=--dev; else groups=--no-dev; fi
if [ -L .venv ]; then # another folder's
  "$uv" sync --quiet --frozen --inexact --check $groups 2>/dev/null && compgen -G '.venv/lib/python3*/site-packages/project.pth' >/dev/null && exit
  echo ".venv is a link to $(readlink .venv), which lacks packages of uv.lock and is not changed from here: run make setup${1:+-dev} there, or rm .venv" >&2
  exit 1
fi
config=${XDG_CONFIG_HOME:-$HOME/.config}/uv/uv.toml
if [ -z "${UV_NO_CONFIG-}" ] && grep -qsE '^ *(target|prefix) *=' "$config" /etc/uv/uv.toml; then
  echo "$config sets a target or prefix, into which uv would install the packages instead of .venv: run UV_NO_CONFIG=1 make setup${1:+-dev}" >&2
  exit 1
fi
# A relocatable environment may be copied and moved. Without its interpreter it is created again.
if ! { grep -qx 'relocatable = true' .venv/pyvenv.cfg && .venv/bin/python -c ''; } 2>/dev/null; then
  "$uv" venv --quiet --clear --relocatable .venv
fi
for packages in .venv/lib/python3*/site-packages; do
  echo ../../../.. >"$packages/project.pth" # the folder that the environment is in
done
# From the index in use, which may be a mirror, with the locked hashes. Additional packages of the user stay.
"$uv" export --quiet --frozen --no-emit-project $groups >.venv/locked.txt
"$uv" pip install --quiet --require-hashes --requirement .venv/locked.txt
touch .venv/complete
