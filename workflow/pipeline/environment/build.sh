#!/bin/bash
# Configures if necessary and compiles the given targets in build or $BUILD, with $CXX, as c++ or `ccache g++`.
set -euo pipefail
build=${BUILD:-build}
case $PWD in *['#";$']*) echo "CMake cannot compile in the folder $PWD: rename it without # \" ; and $" >&2; exit 1 ;; esac
mkdir -p "$build"
read -ra words <<<"${CXX:-c++}"
launcher=("${words[@]:0:${#words[@]}-1}")
for word in "${words[@]}"; do
  command -v "$word" >/dev/null || { echo "CXX=$CXX: $word is not installed; install it or choose another" >&2; exit 1; }
done
compiler=$(command -v "${words[-1]}")
# CMake keeps the compiler and the folder of its first configuration.
inputs="$PWD ${launcher[*]} $compiler $("$compiler" --version | head -n 1)"
forget() { rm -rf "$build/CMakeCache.txt" "$build/CMakeFiles" "$build/sums"; }
[ "$(cat "$build/configured" 2>/dev/null)" = "$inputs" ] || forget
find cpp tests/cpp workflow/pipeline/sources.py -type f -exec cksum {} + | sort >"$build/sums.new"
if ! cmp -s "$build/sums" "$build/sums.new"; then
  # ninja compares times. A source whose content differs from that of the last build is newer than it, also if it was copied or restored
  # with an old time; and hashes of the sources change with added and removed ones.
  if [ -f "$build/sums" ]; then
    comm -13 "$build/sums" "$build/sums.new" | while read -r _ _ file; do touch "$file"; done
  fi
  cmake -S cpp --preset release -B "$build" -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_COMPILER_LAUNCHER="$(IFS=';'; echo "${launcher[*]}")" >"$build/cmake.log" 2>&1 ||
    { forget; cat "$build/cmake.log" >&2; exit 1; }
  touch "$build/build_info/template"
  echo "$inputs" >"$build/configured"
  mv "$build/sums.new" "$build/sums"
fi
if [ -t 1 ]; then quiet=; else quiet=--quiet; fi
ninja -C "$build" -k 0 $quiet "$@" # a program that does not compile blocks no other
