#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
#
# Builds and tests for 64-bit ARM, by Debian's cross compiler and qemu: arm64.sh [--programs NAME,...] [OPTIONS]
#
# The libraries are Debian's packages of arm64, unpacked in build-arm64-root/ and not installed: nothing of them runs here
# but what the program links. Builds in build-arm64/; runs the tests of the libraries and of the program's commands, or those
# named, each program by qemu; then simulates office and office-10 there and on this machine: the digests must be equal. OPTIONS go to
# run_tests.py.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
source "$root/tools/dev/packages.sh"
source "$root/tools/dev/build.sh"

names=core,fibers,world,modules,control,plan,outside,tools,replay,runs
if [[ ${1-} == --programs ]]; then
  names=$2
  shift 2
fi

libraries=$root/build-arm64-root
if [[ ! -e $libraries/cross.ini ]]; then
  say 'unpacking the libraries of arm64'
  rm -rf "$libraries"
  packages=(libc6-dev libboost-context-dev libfcl-dev libyaml-cpp-dev libcli11-dev libfmt-dev nlohmann-json3-dev libpng-dev
    libtinyxml2-dev zlib1g-dev libbz2-dev liblz4-dev libzstd-dev libgtest-dev liboctomap-dev libz3-dev)
  (
    source /etc/os-release
    IFS=,
    mmdebstrap --quiet --variant=extract --architectures=arm64 --include="${packages[*]}" "$VERSION_CODENAME" "$libraries" >&2
  )
  printf "[constants]\nroot = '%s'\n" "$libraries" >"$libraries/cross.ini"
fi

own=$root/build
(build=$own && configure && compile tools/waitpoint)
build=$root/build-arm64
crossing=()
[[ -e $build/build.ninja ]] || crossing=(--cross-file "$libraries/cross.ini" --cross-file "$root/tools/dev/arm64/cross.ini")
configure -Dtests=enabled "${crossing[@]}"
compile tools/waitpoint $(printf 'tests/test-%s ' ${names//,/ })

# Programs that tests start, too.
in_qemu=$build/waitpoint-in-qemu
printf '#!/bin/sh\nexec qemu-aarch64 -L "%s" "%s" "$@"\n' "$libraries" "$build/tools/waitpoint" >"$in_qemu"
chmod +x "$in_qemu"
# qemu keeps tables for all pages that a process ever reserved, and stacks reserve a part of this.
ulimit -v $((60 << 20))
status=0
python3 "$root/tools/dev/run_tests.py" "$build" --programs "$names" --under "qemu-aarch64 -L $libraries" \
  --program "$in_qemu" --patience 20 "$@" || status=1

digest() { "$@" | sed -n 's/^ *digest *//p'; }
for scenario in office office-10; do
  expected=$(digest "$own/tools/waitpoint" run "$root/scenarios/$scenario.yaml")
  found=$(digest "$in_qemu" run "$root/scenarios/$scenario.yaml")
  printf '%-10s here %s, on arm64 %s\n' "$scenario" "$expected" "$found"
  [[ $expected && $found == "$expected" ]] || status=1
done
exit $status
