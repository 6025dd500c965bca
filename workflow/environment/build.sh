#!/bin/bash
# Configures if necessary and compiles the given targets in build or $BUILD.
set -euo pipefail
build=${BUILD:-build}
mkdir -p "$build"
# ninja and cmake decide by time stamps: sources with future times, from a machine with another clock, would always be compiled.
find cpp tests/cpp -newermt '1 minute' -exec touch {} +
if ! cmake -S cpp -B "$build" -G Ninja >"$build/cmake.log" 2>&1; then # for example after the folder was moved
  cmake --fresh -S cpp -B "$build" -G Ninja >"$build/cmake.log" 2>&1 || { cat "$build/cmake.log" >&2; exit 1; }
fi
if [ -t 1 ]; then quiet=; else quiet=--quiet; fi
ninja -C "$build" $quiet "$@"
