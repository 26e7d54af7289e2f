#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
#
# Failures found by exploration are replayed by the program that found them, and by builds of the same code with another
# optimisation level or compiler. Each replay must be the same run, by its digest.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
source "$root/tools/dev/packages.sh"
source "$root/tools/dev/build.sh"

build=$root/build
configure -Dtests=enabled
compile tests/zoo-failures
stored=$(mktemp)
trap 'rm -f "$stored"' EXIT
"$build/tests/zoo-failures" store "$stored"
status=0
for name in '' g++-O0 clang++-O2; do
  if [[ $name ]]; then
    command -v "${name%-O?}" >/dev/null || { say "${name%-O?} is not installed" && continue; }
    build=$root/build-replays-$name
    CXX=${name%-O?} configure -Doptimization="${name##*-O}" -Dwerror=false -Dtests=enabled -Dbenchmarks=disabled
    compile tests/zoo-failures
  fi
  printf '%-11s ' "${name:-this build}"
  "$build/tests/zoo-failures" replay "$stored" || status=1
done
exit $status
