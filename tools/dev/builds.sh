#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
#
# Compares runs of several builds of the program: builds.sh [BUILD...]. A BUILD is one of
#
#   COMPILER[-libc++]-LEVEL[-v3]   like clang++-O0, clang++-libc++-O3-v3: built in build-BUILD/. With libc++ the C++
#                                  libraries come from subprojects/, so that the whole program uses it; v3 is
#                                  x86-64-v3: processors with AVX2 and FMA
#   portable                       the default build with -Dportable=true, in build-portable/
#   build                          the default build
#   build-no-fma                   the same program without the processor's FMA and AVX2
#   build-plain-path               the same program without the kernel's fast paths
#
# Each runs the office for the 120 s in which the robot meets the blocked door. Digest and math fingerprint must equal
# those of the first. Status 77 if a compiler or libc++ is missing.
#
#   builds.sh --outcome FOLDER     prints "digest fingerprint" of the program built in FOLDER
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
source "$root/tools/dev/packages.sh"
source "$root/tools/dev/build.sh"

all_builds=({g++,clang++,clang++-libc++}-O{0,2,3} {g++,clang++,clang++-libc++}-O3-v3 portable build-no-fma build-plain-path)

# glibc selects its sine by the processor's features; python uses glibc's.
no_fma=glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2
sines() { python3 -c 'import math; print(hash(tuple(math.sin(k) for k in range(1, 50000))))'; }

# Prints "digest fingerprint" of the program in FOLDER: outcome FOLDER
outcome() {
  # Status 1 only means that 120 s are too short for the scenario's expectations.
  local status=0
  rm -f "$1/summary.json"
  "$1/tools/waitpoint" run "$root/scenarios/office.yaml" --until 120 --summary "$1/summary.json" >"$1/run.log" 2>&1 ||
    status=$?
  if ((status > 1)) || [[ ! -e $1/summary.json ]]; then
    tail -n 20 "$1/run.log" >&2
    return 1
  fi
  python3 -c 'import json, sys; print(json.load(open(sys.argv[1]))["digest"], end=" ")' "$1/summary.json"
  "$1/tools/waitpoint" --version | sed -n 's/^math *//p'
}

# Builds BUILD in build-BUILD/ and shows the log on failure: build_one BUILD
build_one() {
  local build=$root/build-$1 log=$root/build-$1.log words=$1 options=()
  if [[ $words == portable ]]; then
    words=g++-O2
    options+=(-Dportable=true)
  fi
  if [[ $words == *-v3 ]]; then
    words=${words%-v3}
    options+=(-Dcpp_args=-march=x86-64-v3)
  fi
  local compiler=${words%-O?} level=${words##*-O}
  if [[ $compiler == *-libc++ ]]; then
    compiler="${compiler%-libc++} -stdlib=libc++"
    options+=(-Dforce_fallback_for=fcl,fmt,tinyxml2,yaml-cpp,cli11,nlohmann_json -Dbullet=disabled -Dassimp=disabled)
  fi
  # Warnings depend on the level; only the default build checks them.
  if ! {
    if [[ $compiler == *libc++ ]]; then
      python3 "$root/tools/dev/wraps.py" "$root/build-wraps" || return
      local root=$root/build-wraps/tree
    fi
    options+=(-Ddefault_library=static -Doptimization="$level" -Dwerror=false -Dtests=disabled -Dbenchmarks=disabled -Drosbag=disabled)
    CXX=$compiler configure "${options[@]}" &&
      compile tools/waitpoint
  } >"$log" 2>&1; then
    tail -n 20 "$log" >&2
    return 1
  fi
  rm "$log"
}

outcome_of() {
  case $1 in
    build) outcome "$root/build" ;;
    build-no-fma) GLIBC_TUNABLES=$no_fma outcome "$root/build" ;;
    build-plain-path) WAITPOINT_FAST_PATHS=0 outcome "$root/build" ;;
    *) build_one "$1" && outcome "$root/build-$1" ;;
  esac
}

if [[ ${1-} == --outcome ]]; then
  outcome "$2"
  exit
fi

(($#)) || set -- "${all_builds[@]}"
for name; do
  [[ $name != build* && $name != portable ]] || continue
  compiler=${name%%+*}++
  command -v "$compiler" >/dev/null || { say "$compiler is not installed" && exit 77; }
  [[ $name != *libc++* ]] || echo '#include <vector>' | clang++ -stdlib=libc++ -fsyntax-only -x c++ - 2>/dev/null ||
    { say 'libc++ is not installed' && exit 77; }
done
if [[ " $* " == *' build-no-fma '* && $(sines) == $(GLIBC_TUNABLES=$no_fma sines) ]]; then
  say 'FMA cannot be switched off on this processor or in this C library'
fi

passed=0
failed=0
expected=
printf '%-24s %-6s %6s  %-22s %s\n' build '' 's' digest 'fingerprint of the math'
for name; do
  say "building and running $name"
  start=$SECONDS
  if found=$(outcome_of "$name") && [[ $found == wp*:*\ ?* ]]; then
    expected=${expected:-$found}
  else
    found='neither -'
  fi
  if [[ $found == "$expected" ]]; then
    verdict=equal passed=$((passed + 1))
  else
    verdict=FAILED failed=$((failed + 1))
  fi
  printf '%-24s %-6s %6d  %-22s %s\n' "$name" "$verdict" $((SECONDS - start)) "${found%% *}" "${found#* }"
done
echo "$passed passed, $failed failed"
((failed == 0 && passed > 0))
