#!/bin/bash
# Configures if necessary and compiles the given targets in build or $BUILD, with $CXX or c++.
set -euo pipefail
build=${BUILD:-build}
mkdir -p "$build"
# ninja compares times. A source whose content differs from that of the last build is newer than it, also if it was copied or restored
# with an old time.
sums() { find cpp tests/cpp -type f -exec cksum {} + | sort; }
if [ -f "$build/sums" ]; then sums | comm -13 "$build/sums" - | while read -r _ _ file; do touch "$file"; done; fi
sums >"$build/sums"

compiler=$(command -v "${CXX:-c++}") || { echo "the compiler CXX=${CXX:-c++} is not installed; install it or choose another" >&2; exit 1; }
# CMake keeps the compiler and the folder of its first configuration.
inputs="$PWD $compiler $("$compiler" --version | head -n 1)"
if [ ! -f "$build/build.ninja" ] || [ "$(cat "$build/configured" 2>/dev/null)" != "$inputs" ]; then
  rm -rf "$build/CMakeCache.txt" "$build/CMakeFiles" "$build/build.ninja"
  cmake -S cpp --preset release -B "$build" -DCMAKE_CXX_COMPILER="$compiler" >"$build/cmake.log" 2>&1 || { cat "$build/cmake.log" >&2; exit 1; }
  echo "$inputs" >"$build/configured"
fi
if ! ninja -C "$build" -n "$@" | grep -q 'no work to do'; then
  if [ -t 1 ]; then quiet=; else quiet=--quiet; fi
  ninja -C "$build" $quiet "$@"
fi
