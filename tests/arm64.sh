#!/bin/bash
# Compiles the programs for arm64: build/arm64/build/bin, to be run by qemu-aarch64 -L build/arm64. build/arm64 is a Debian system
# made by debootstrap, with a cross compiler for arm64 and the libraries of arm64. Needs root, Debian or Ubuntu, and network once.
set -euo pipefail
[ "$(id -u)" -eq 0 ] || { echo 'debootstrap and chroot need root: run the test as root, for example in a container' >&2; exit 1; }
export DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8
install='apt-get -o DPkg::Lock::Timeout=600 install -y --no-install-recommends'
root=build/arm64
packages='cmake ninja-build python3 g++-aarch64-linux-gnu libeigen3-dev libcli11-dev librandom123-dev nlohmann-json3-dev
  libfmt-dev:arm64 libgsl-dev:arm64 libhdf5-dev:arm64 libsleef-dev:arm64 zlib1g-dev:arm64'

command -v debootstrap qemu-aarch64 >/dev/null || { apt-get update; $install debootstrap qemu-user; }
if [ "$(cat $root/complete 2>&1)" != "$packages" ]; then
  rm -rf $root
  mkdir -p $root
  link=$(mktemp -d) && ln -s "$PWD/$root" "$link/root"  # debootstrap fails in a path with a space
  debootstrap --variant=minbase bookworm "$link/root"
  rm -r "$link"
  chroot $root dpkg --add-architecture arm64
  chroot $root apt-get update
  chroot $root $install $packages
  echo "$packages" >$root/complete
fi

mkdir -p $root/source/workflow/pipeline
rm -rf $root/source/cpp
cp -a cpp $root/source
cp -a workflow/pipeline/sources.py $root/source/workflow/pipeline
chroot $root cmake -S source/cpp -B build -G Ninja -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64 \
  -DCMAKE_CXX_COMPILER=aarch64-linux-gnu-g++ -DCMAKE_C_COMPILER=aarch64-linux-gnu-gcc
chroot $root ninja -C build
