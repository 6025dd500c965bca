#!/bin/bash
# Configures if necessary and compiles the given targets in build or $BUILD, with $CXX or c++.
set -euo pipefail
build=${BUILD:-build}
mkdir -p "$build"
# ninja and cmake decide by time stamps. Sources whose content differs from the last build are newer than it, also a former version that
# was restored with its old time; none has a future time, of a machine with another clock, with which it would always be compiled.
sums() { find cpp tests/cpp -type f -exec cksum {} + | sort; }
if [ -f "$build/sums" ]; then sums | comm -13 "$build/sums" - | while read -r _ _ file; do touch "$file"; done; fi
find cpp tests/cpp -newermt '1 minute' -exec touch {} +
sums >"$build/sums"

compiler=$(command -v "${CXX:-c++}") || { echo "the compiler CXX=${CXX:-c++} is not installed; install it or choose another" >&2; exit 1; }
# CMake never looks for another compiler or other libraries than at first. So these start a new configuration, as does a failure.
version=$("$compiler" --version) || { echo "CXX=${CXX:-c++} is not a compiler: --version fails; choose another" >&2; exit 1; }
inputs="$compiler ${version%%$'\n'*} ${CONDA_PREFIX-} ${CMAKE_PREFIX_PATH-}"
configure() { cmake -S cpp -B "$build" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" >"$build/cmake.log" 2>&1; }
forget() { rm -rf "$build/CMakeCache.txt" "$build/CMakeFiles"; }
[ "$(cat "$build/configured" 2>/dev/null)" = "$inputs" ] || forget
if ! configure; then # for example after the folder was moved
  forget
  configure || { forget; cat "$build/cmake.log" >&2; exit 1; }
fi
echo "$inputs" >"$build/configured"
if [ -t 1 ]; then quiet=; else quiet=--quiet; fi
ninja -C "$build" $quiet "$@"
