#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
#
# The same run from several builds of the program: builds.sh [BUILD...], a BUILD being COMPILER-LEVEL like clang++-O0.
# Each is built in build-BUILD/, runs the office for the 120 s in which the robot meets the blocked door, and must give the
# digest and the fingerprint of the math that the first one gives. The BUILD called `build` is the one that everyone
# uses, as it is. Status 77 where a compiler is missing.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
source "$root/tools/dev/packages.sh"
source "$root/tools/dev/build.sh"

(($#)) || set -- {g++,clang++}-O{0,1,2,3}
for name; do
  [[ $name == build ]] || command -v "${name%-O?}" >/dev/null || { say "there is no ${name%-O?} here" && exit 77; }
done

# Prints "digest fingerprint" of one build, or nothing when it cannot be built or run: outcome_of BUILD
outcome_of() {
  local compiler=${1%-O?} level=${1##*-O} build=$root/build-$1 log=$root/build-$1.log
  if [[ $1 == build ]]; then
    build=$root/build
  # Warnings differ with the level and are the business of the one build that everyone uses.
  elif ! { CXX=$compiler configure -Doptimization="$level" -Dwerror=false -Dtests=disabled -Dbenchmarks=disabled &&
    compile tools/waitpoint; } >"$log" 2>&1; then
    tail -n 20 "$log" >&2
    return 1
  fi
  # Status 1 only says that 120 s do not meet what the scenario expects of the whole mission.
  local status=0
  rm -f "$build/summary.json"
  "$build/tools/waitpoint" run "$root/scenarios/office.yaml" --until 120 --summary "$build/summary.json" \
    >"$log" 2>&1 || status=$?
  if ((status > 1)) || [[ ! -e $build/summary.json ]]; then
    tail -n 20 "$log" >&2
    return 1
  fi
  python3 -c 'import json, sys; print(json.load(open(sys.argv[1]))["digest"], end=" ")' "$build/summary.json"
  "$build/tools/waitpoint" --version | sed -n 's/^math *//p'
  rm "$log"
}

passed=0
failed=0
expected=
printf '%-12s %-6s  %-70s %s\n' build '' digest 'fingerprint of the math'
for name; do
  say "building and running $name"
  if outcome=$(outcome_of "$name") && [[ $outcome == wp*:*\ ?* ]]; then
    expected=${expected:-$outcome}
  else
    outcome='neither -'
  fi
  if [[ $outcome == "$expected" ]]; then
    verdict=equal passed=$((passed + 1))
  else
    verdict=FAILED failed=$((failed + 1))
  fi
  printf '%-12s %-6s  %-70s %s\n' "$name" "$verdict" "${outcome%% *}" "${outcome#* }"
done
echo "$passed passed, $failed failed"
((failed == 0 && passed > 0))
