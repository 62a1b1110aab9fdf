#!/usr/bin/env bash
# Makes this checkout ready to run on Debian 12: installs the packages that are missing, configures
# and builds in build/. What is done already is not done again. Environment: BUILD_DIR, JOBS.
set -euo pipefail
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build_dir=${BUILD_DIR:-$source_dir/build}
log=$build_dir/setup.log

# paraview-dev does not bring what its own CMake files ask for, hence the long list. Clang is for the
# fuzzer alone.
packages=(
  g++ cmake make clang-14 libclang-rt-14-dev
  paraview paraview-dev python3-paraview python3-numpy python3-h5py
  libcgal-dev libeigen3-dev libhdf5-dev libgtest-dev libopenmpi-dev openmpi-bin python3-dev
  qtbase5-dev qttools5-dev qttools5-dev-tools qtxmlpatterns5-dev-tools
  libboost-dev libdouble-conversion-dev libexpat1-dev libfmt-dev libfreetype-dev libgl-dev
  libglew-dev libjpeg-dev libjsoncpp-dev liblz4-dev liblzma-dev libpng-dev libprotobuf-dev
  libpugixml-dev libtiff-dev libutfcpp-dev protobuf-compiler zlib1g-dev
  xauth xvfb)

say() { echo "setup: $*"; }
fail() { echo "setup: error: $*" >&2; exit 1; }

# Runs a command with its output in the log; shows the end of the log when it fails.
logged() {
  if ! "$@" >>"$log" 2>&1; then
    tail -n 40 "$log" >&2
    fail "'$1 ${2:-}' failed; all of its output is in $log"
  fi
}

missing_packages() {
  local package
  for package in "${packages[@]}"; do
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] ||
      echo "$package"
  done
}

install_packages() {
  command -v dpkg-query >/dev/null || { say "no dpkg here; taking the packages for granted"; return; }
  local missing as_root=()
  mapfile -t missing < <(missing_packages)
  [ ${#missing[@]} -gt 0 ] || return 0
  if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null || fail "not root and no sudo; ask for these packages: ${missing[*]}"
    as_root=(sudo)
  fi
  say "installing ${#missing[@]} Debian packages (a few minutes): ${missing[*]}"
  logged "${as_root[@]}" apt-get update -q
  logged "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -q --no-install-recommends "${missing[@]}"
}

# As many compilers at once as there are processors and gigabytes.
job_count() {
  local processors gigabytes
  processors=$(nproc)
  gigabytes=$(awk '/MemAvailable/ { print int($2 / 1048576) + 1 }' /proc/meminfo)
  echo "${JOBS:-$((processors < gigabytes ? processors : gigabytes))}"
}

build() {
  if [ ! -f "$build_dir/CMakeCache.txt" ]; then
    say "configuring in $build_dir"
    logged cmake -S "$source_dir" -B "$build_dir"
  fi
  say "building in $build_dir"
  logged cmake --build "$build_dir" -j "$(job_count)"
}

mkdir -p "$build_dir"
: >"$log"
install_packages
build
