#!/bin/bash
# System packages, and the locked Python packages in .venv; with "dev" also those of tests and checks, with "slurm" those of PROFILE=slurm.
# With "if-missing" an environment stays as it is. uv installs them: from PATH, or a fixed version in .cache/uv.
set -euo pipefail
works() { .venv/bin/python -I -c '' 2>/dev/null; }
if [ "${1:-}" = if-missing ] && [ -e .venv ]; then
  works && exit 0
  echo "$(readlink -m .venv/bin/python), the interpreter of .venv, does not run here: run make setup, which keeps .venv as .venv.former" >&2
  exit 1
fi
# Modules of the folder that an environment is in come before packages of the same name.
first_in_path() {
  for packages in "$1"/lib/python3*/site-packages; do
    echo 'import os, sys; sys.path.insert(0, os.path.dirname(sys.prefix))' >"$packages/project.pth"
  done
}
{ mkdir -p .cache && [ -w . ] && [ -w .cache ]; } 2>/dev/null || {
  echo "$PWD cannot be written: copy the project to a folder of yours" >&2
  exit 1
}
exec 9>.cache/setup.lock
flock 9 # until another command has installed
bash workflow/pipeline/environment/system_packages.sh "$@"

groups='--no-default-groups'
for name; do case $name in dev | slurm) groups+=" --group $name" ;; esac; done
# A complete environment needs neither uv nor a network, as in a copy of the project without .cache.
installed="$(cksum uv.lock)$groups"
if works && grep -qsF -e "$installed" .venv/installed; then
  first_in_path .venv
  exit 0
fi

version=0.13.9
uv=$(command -v uv || true)
if [ -z "$uv" ] || [ "$(printf '%s\n' "$version" "$("$uv" --version | cut -d ' ' -f 2)" | sort -V | head -n 1)" != "$version" ]; then
  uv=.cache/uv/bin/uv # that in PATH is missing or older
fi
if [ ! -x "$uv" ]; then
  echo 'Installing uv into .cache/uv'
  python3 -I -m venv --clear .cache/uv
  .cache/uv/bin/pip install --quiet --disable-pip-version-check uv==$version
fi
# A relocatable environment may be copied and moved. A new one takes its place when it is complete.
folder=.venv
if ! works; then
  folder=.venv.new
  "$uv" venv --quiet --clear --relocatable "$folder"
fi
first_in_path "$folder"
# `uv sync` would need the index in uv.lock; this installs from a mirror, too, with the locked hashes. Other packages of the user stay.
echo 'Installing the locked Python packages into .venv'
"$uv" export --quiet --frozen --no-emit-project $groups >"$folder/locked.txt"
"$uv" pip install --quiet --python "$folder" --require-hashes --requirement "$folder/locked.txt"
if [ "$folder" != .venv ]; then
  if [ -e .venv ] || [ -L .venv ]; then
    rm -rf .venv.former
    mv .venv .venv.former
  fi
  mv "$folder" .venv
fi
echo "$installed" >>.venv/installed
