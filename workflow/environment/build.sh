#!/bin/bash
# Configures where needed and compiles the targets given, in build or in $BUILD.
set -euo pipefail
build=${BUILD:-build}
mkdir -p "$build"
# make, ninja and cmake decide by time stamps: a source from the future, of a machine with another clock, would be compiled for ever.
find cpp tests/cpp -newermt '1 minute' -exec touch {} +
if ! cmake -S cpp -B "$build" -G Ninja >"$build/cmake.log" 2>&1; then # as in a folder that was moved
  cmake --fresh -S cpp -B "$build" -G Ninja >"$build/cmake.log" 2>&1 || { cat "$build/cmake.log" >&2; exit 1; }
fi
if [ -t 1 ]; then quiet=; else quiet=--quiet; fi
ninja -C "$build" $quiet "$@"
