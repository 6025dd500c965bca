#!/bin/bash
# Finds missing packages of Debian and Ubuntu, and installs them with apt if root; otherwise prints the command to do so. Elsewhere CMake
# names what it misses. With "dev" also the packages for tests and checks.
set -euo pipefail
needed='g++ cmake ninja-build libgsl-dev libhdf5-dev zlib1g-dev librandom123-dev
  libsleef-dev libfmt-dev python3-venv'
for group; do
  if [ "$group" = dev ]; then needed+=' libgtest-dev clang'; fi
done
command -v dpkg-query >/dev/null || exit 0
installed=$(dpkg-query --show --showformat='${db:Status-Status} ${Package}\n' | sed -n 's/^installed //p')
missing=$(comm -13 <(sort <<<"$installed") <(printf '%s\n' $needed | sort) | tr '\n' ' ')
[ -n "$missing" ] || exit 0

if [ "$(id -u)" -ne 0 ]; then
  # The build may find them elsewhere, as those of a cluster.
  echo "Missing packages: sudo apt-get install $missing" >&2
  exit 0
fi
echo "Installing system packages: $missing"
log=$(mktemp)
waiting='-o DPkg::Lock::Timeout=600' # for another installation on this machine
{ apt-get update && DEBIAN_FRONTEND=noninteractive apt-get install $waiting -y --no-install-recommends $missing; } >"$log" 2>&1 || {
  tail -n 20 "$log" >&2
  echo "apt-get failed (whole log: $log): fix the cause, or install the packages yourself, then run make again" >&2
  exit 1
}
