#!/bin/bash
# Finds out which system packages are missing and installs them with apt when root; otherwise says how.
# With "dev" also those that tests, checks and benchmarks need.
# Each line: a probe (a command, a header, or the venv module), then the package on Debian, Fedora, Homebrew.
set -euo pipefail

probes='
command:g++            g++                gcc-c++          gcc
command:cmake          cmake              cmake            cmake
command:ninja          ninja-build        ninja-build      ninja
header:Eigen/Dense     libeigen3-dev      eigen3-devel     eigen
header:gsl/gsl_math.h  libgsl-dev         gsl-devel        gsl
header:hdf5.h          libhdf5-dev        hdf5-devel       hdf5
header:zlib.h          zlib1g-dev         zlib-devel       zlib
header:CLI/CLI.hpp     libcli11-dev       cli11-devel      cli11
header:toml++/toml.h   libtomlplusplus-dev tomlplusplus-devel tomlplusplus
header:nlohmann/json.hpp nlohmann-json3-dev json-devel nlohmann-json
header:Random123/philox.h librandom123-dev Random123-devel random123
header:sleef.h         libsleef-dev       sleef-devel      sleef
header:fmt/format.h    libfmt-dev         fmt-devel        fmt
venv:                  python3-venv       python3          python
'
for_developers='
header:gtest/gtest.h   libgtest-dev       gtest-devel      googletest
header:benchmark/benchmark.h libbenchmark-dev google-benchmark-devel google-benchmark
command:clang++        clang              clang            llvm
command:doxygen        doxygen            doxygen          doxygen
command:ccache         ccache             ccache           ccache
'
[ "${1-}" != dev ] || probes+=$for_developers

includes=(-I/usr/include/hdf5/serial -I/usr/include/eigen3 -I/opt/homebrew/include -I/opt/homebrew/include/eigen3)

present() {
  case $1 in
    command:*) command -v "${1#command:}" >/dev/null ;;
    header:*) g++ -fsyntax-only -std=c++20 "${includes[@]}" -include "${1#header:}" -x c++ /dev/null 2>/dev/null ;;
    venv:) python3 -c 'import ensurepip, venv' 2>/dev/null ;;
  esac
}

debian=() fedora=() homebrew=()
while read -r probe on_debian on_fedora on_homebrew; do
  if [ -n "$probe" ] && ! present "$probe"; then
    debian+=("$on_debian") fedora+=("$on_fedora") homebrew+=("$on_homebrew")
  fi
done <<<"$probes"
[ ${#debian[@]} -gt 0 ] || exit 0

if [ "$(id -u)" -eq 0 ] && command -v apt-get >/dev/null; then
  echo "Installing system packages: ${debian[*]}"
  log=$(mktemp)
  export DEBIAN_FRONTEND=noninteractive
  waiting=(-o DPkg::Lock::Timeout=600) # for another installation on this machine
  if { apt-get update && apt-get install "${waiting[@]}" -y --no-install-recommends "${debian[@]}"; } >"$log" 2>&1; then
    rm "$log"
    exit 0
  fi
  tail -n 20 "$log" >&2
  echo "apt-get could not install them; the whole log is in $log" >&2
  exit 1
fi

cat >&2 <<EOF2
System packages are missing. Install them and run make again:
  Debian, Ubuntu:  sudo apt-get install ${debian[*]}
  Fedora:          sudo dnf install ${fedora[*]}
  Homebrew:        brew install ${homebrew[*]}
EOF2
exit 1
