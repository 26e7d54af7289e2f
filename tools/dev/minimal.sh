#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
#
# Tests a build without any library that only a part of the program needs (`./dev add`), in build-minimal/: the tests of
# core, fibers, world and modules must pass or be skipped, the digest must be that of build/, and what is missing must be
# named with the command that adds it.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
source "$root/tools/dev/packages.sh"
source "$root/tools/dev/build.sh"

outcome() { "$root/tools/dev/builds.sh" --outcome "$1"; }

# What was said must be one line that names a command of ./dev: names_command SAID [COMMAND]
names_command() {
  if [[ $1 != *'`./dev '${2-*}'`'* ]] || [[ $1 == *$'\n'* ]]; then
    say "expected one line that names './dev ${2-...}', found: $1"
    exit 1
  fi
  echo "$1"
}

# `waitpoint run` must be refused, and name the command that adds PART: lacks PART [OPTION...]
lacks() {
  local said status=0
  said=$("$root/build-minimal/tools/waitpoint" run "$root/scenarios/office.yaml" --until 0.1 "${@:2}" 2>&1) || status=$?
  names_command "$said" "add $1"
  if ((status != 2)); then
    say "expected status 2, found $status"
    exit 1
  fi
}

options=("${option_of_part[@]/%/=disabled}")
(
  build=$root/build-minimal
  configure -Dtests=enabled -Dros=disabled "${options[@]/#/-D}"
  compile program tests/test-core tests/test-fibers tests/test-world tests/test-modules
)
python3 "$root/tools/dev/run_tests.py" "$root/build-minimal" --programs core,fibers,world,modules "$@"
# Each scenario runs, or names what it lacks in one line, as do commands for programs.
for scenario in "$root"/scenarios/*.yaml; do
  status=0
  said=$("$root/build-minimal/tools/waitpoint" run "$scenario" --until 0.1 2>&1) || status=$?
  ((status == 2)) || continue
  case $(basename "$scenario") in
    office-floor.yaml | rackham.yaml) ;;  # parts of other scenarios
    fidelity.yaml | office-map.yaml) ;;  # other runs make what they read
    *) names_command "$said" ;;
  esac
done
said=$("$root/build-minimal/tools/waitpoint" exec -- true 2>&1) || names_command "$said"
lacks bags --record "$root/build-minimal/x.bag"
lacks bullet --set world.engine=bullet
lacks ranks --ranks 2
build=$root/build
(configure && compile program)
expected=$(outcome "$root/build")
found=$(outcome "$root/build-minimal")
echo "digest and fingerprint of the math with the libraries of all parts:  $expected"
echo "                                 without:                           $found"
[[ $found == "$expected" && $found ]]
