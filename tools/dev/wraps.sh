#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
#
# Tests a build with every library from subprojects/ and none from the system: the tests of core and fibers must pass,
# and the digest must be that of build/. The wraps' package cache is filled from Debian's source packages (wraps.py), in
# a copy of the tree in build-wraps/.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
source "$root/tools/dev/packages.sh"
source "$root/tools/dev/build.sh"

outcome() { "$root/tools/dev/builds.sh" --outcome "$1"; }

say 'getting the libraries from Debian'"'"'s source packages'
python3 "$root/tools/dev/wraps.py" "$root/build-wraps"
(
  build=$root/build-wraps/build
  root=$root/build-wraps/tree
  configure -Ddefault_library=static -Db_pch=false -Dgrouped=false -Dwrap_mode=forcefallback -Dtests=enabled -Dbenchmarks=disabled -Dbullet=disabled -Dassimp=disabled -Drosbag=disabled -Dwerror=false
  compile tools/waitpoint tests/test-core tests/test-fibers
)
# The compiler's libraries, and optional ones of the tests, may come from the system.
from_system=$(meson introspect --dependencies "$root/build-wraps/build" | python3 -c '
import json, sys
names = {dependency["name"] for dependency in json.load(sys.stdin)}
print(*sorted(names - {"threads", "openmp", "octomap", "z3"}))')
if [[ $from_system ]]; then
  say "from the system: $from_system"
  exit 1
fi
python3 "$root/tools/dev/run_tests.py" "$root/build-wraps/build" --programs core,fibers "$@"
build=$root/build
(configure && compile tools/waitpoint)
expected=$(outcome "$root/build")
found=$(outcome "$root/build-wraps/build")
echo "digest and fingerprint of the math with the system's libraries:  $expected"
echo "                            with those from subprojects/:     $found"
[[ $found == "$expected" && $found ]]
