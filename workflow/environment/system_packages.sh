#!/bin/bash
# Finds missing system packages by command or header, and installs them with apt if root; otherwise prints the command to do so. With
# "dev" also the packages for tests, checks and benchmarks.
# Each line: a command or a header, then the package on Debian, Fedora, Homebrew.
set -euo pipefail
compiler=${CXX:-c++}

needed="
$compiler              g++                 gcc-c++           gcc
cmake                  cmake               cmake             cmake
ninja                  ninja-build         ninja-build       ninja
Eigen/Dense            libeigen3-dev       eigen3-devel      eigen
gsl/gsl_math.h         libgsl-dev          gsl-devel         gsl
hdf5.h                 libhdf5-dev         hdf5-devel        hdf5
zlib.h                 zlib1g-dev          zlib-devel        zlib
CLI/CLI.hpp            libcli11-dev        cli11-devel       cli11
nlohmann/json.hpp      nlohmann-json3-dev  json-devel        nlohmann-json
Random123/philox.h     librandom123-dev    Random123-devel   random123
sleef.h                libsleef-dev        sleef-devel       sleef
fmt/format.h           libfmt-dev          fmt-devel         fmt
"
for_developers='
gtest/gtest.h          libgtest-dev        gtest-devel       googletest
benchmark/benchmark.h  libbenchmark-dev    google-benchmark-devel google-benchmark
clang++                clang               clang             llvm
doxygen                doxygen             doxygen           doxygen
chromium               chromium            chromium          chromium
'
[ "${1-}" != dev ] || needed+=$for_developers
includes='-I/usr/include/hdf5/serial -I/usr/include/eigen3 -I/opt/homebrew/include -I/opt/homebrew/include/eigen3'

missing_headers() {
  awk '$1 ~ /\.h|Eigen/ {printf "#if !__has_include(<%s>)\n%s\n#endif\n", $1, $1}' <<<"$needed" |
    "$compiler" -E -P $includes -x c++ - 2>/dev/null || awk '$1 ~ /\.h|Eigen/ {print $1}' <<<"$needed"
}

headers=$(missing_headers)
debian=() fedora=() homebrew=()
while read -r name on_debian on_fedora on_homebrew; do
  case $name in
    '') continue ;;
    *.h* | Eigen*) grep -qxF "$name" <<<"$headers" || continue ;;
    *) ! command -v "$name" >/dev/null || continue ;;
  esac
  debian+=("$on_debian") fedora+=("$on_fedora") homebrew+=("$on_homebrew")
done <<<"$needed"
if ! command -v uv >/dev/null && ! python3 -c 'import ensurepip, venv' 2>/dev/null; then
  debian+=(python3-venv) fedora+=(python3) homebrew+=(python)
fi
[ ${#debian[@]} -gt 0 ] || exit 0

if [ "$(id -u)" -eq 0 ] && command -v apt-get >/dev/null; then
  echo "Installing system packages: ${debian[*]}"
  export DEBIAN_FRONTEND=noninteractive
  waiting='-o DPkg::Lock::Timeout=600' # for another installation on this machine
  if { apt-get update && apt-get install $waiting -y --no-install-recommends "${debian[@]}"; } >"${log:=$(mktemp)}" 2>&1; then
    exit 0
  fi
  tail -n 20 "$log" >&2
  echo "apt-get failed (whole log: $log): fix the cause, or install the packages yourself, then run make again" >&2
  exit 1
fi

cat >&2 <<EOF2
System packages are missing. Install them and run make again:
  Debian, Ubuntu:  sudo apt-get install ${debian[*]}
  Fedora:          sudo dnf install ${fedora[*]}
  Homebrew:        brew install ${homebrew[*]}
EOF2
exit 1
