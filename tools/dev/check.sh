#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
#
# The rules for the repository's sources: check.sh [--all] [PART...]. All parts are run, even after failures. Static
# analysis covers files changed since the parent of the last commit (or since $CHECK_SINCE); with --all, every file.
# Exit status: 0 passed, 1 violations, 77 (of a single part) its tool is not installed.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=$root/build
source "$root/tools/dev/packages.sh"
source "$root/tools/dev/build.sh"
cd "$root"

formatting() {
  command -v clang-format >/dev/null || { say 'clang-format is not installed' && return 77; }
  # Lists each file once; `./dev format` repairs them all.
  local unformatted
  unformatted=$(list_sources | xargs -0 clang-format --dry-run 2>&1 | awk -F: '/warning:/ && !seen[$1]++ {print $1 ":" $2}')
  if [[ $unformatted ]]; then
    sed 's/$/: not formatted (dev format repairs it)/' <<<"$unformatted"
    return 1
  fi
  echo "$(list_sources | tr -cd '\0' | wc -c) files formatted according to .clang-format"
}

# clang-tidy analyses each file by itself, with the flags of a set-up of its own, and again only after changes; .clang-tidy
# gives the reason for each group.
analysis() {
  command -v clang-tidy >/dev/null || { say 'clang-tidy is not installed' && return 77; }
  local count quiet=()
  local since=${CHECK_SINCE-HEAD~1}
  if ((all)); then
    since=
  elif ! git rev-parse --quiet --verify "$since^{commit}" >/dev/null 2>&1; then
    echo "no commit $since to compare with; check --all reads every file" && return
  fi
  local separate=$build/separate
  if [[ ! -e $separate/build.ninja ]]; then
    meson setup "$separate" "$root" --buildtype=debugoptimized -Dgrouped=false -Db_pch=false -Dtests=enabled >/dev/null
  fi
  ninja -C "$separate" build.ninja >/dev/null  # after changes of a meson.build
  count=$(python3 tools/dev/check/analysis.py "$separate" ${since:+"$since"})
  ((count)) || { echo "no source changed since $since" && return; }
  # These generated headers are included by the kernel's benchmark and by examples.
  local generated
  for generated in tests/bench/installed_headers.hpp examples/dds/reading.h; do
    if grep -qE "^build .*$generated( |:)" "$separate/build.ninja"; then ninja -C "$separate" "$generated" >/dev/null; fi
  done
  [[ -t 1 ]] || quiet=(--quiet)
  ninja -C "$separate" -f analysis/build.ninja -j "$(nproc)" -k 0 "${quiet[@]}"
  echo "$count files conform to .clang-tidy"
}

dependencies() { python3 tools/dev/check/dependencies.py "$root"; }

symbols() {
  local objects
  mapfile -t objects < <(for room in fibers/switch fibers/kernel fibers/clocks; do
    python3 tools/dev/check/compiled.py objects "$build" "$room"
  done)
  compile "${objects[@]}"
  (cd "$build" && python3 "$root/tools/dev/check/symbols.py" "${objects[@]}")
}

# What threads share, in the libraries of this build.
state() {
  local libraries=(libwaitpoint.a tools/libwaitpoint-robots.a tools/libaround-runs.a)
  compile "${libraries[@]}"
  python3 tools/dev/check/state.py "${libraries[@]/#/$build/}"
}

cycles() { python3 tools/dev/check/cycles.py "$root"; }

functions() { python3 tools/dev/check/functions.py "$root"; }

assertions() { python3 tools/dev/check/assertions.py "$root"; }

files() { python3 tools/dev/check/files.py "$root"; }

names() { python3 tools/dev/check/names.py "$root"; }

sensors() { python3 tools/dev/check/sensors.py "$root"; }

test_names() { python3 tools/dev/check/test_names.py "$root"; }

words() { python3 tools/dev/check/words.py "$root"; }

# Of the commits that the main branch does not have yet.
subjects() {
  local since=${CHECK_SINCE-origin/main} long
  if ! git rev-parse --quiet --verify "$since^{commit}" >/dev/null 2>&1; then
    echo "no commit $since to compare with" && return
  fi
  long=$(git log --format='%h %s' "$since..HEAD" | awk '{subject = substr($0, index($0, " ") + 1)} length(subject) > 72')
  [[ ! $long ]] || { sed 's/$/: a subject of more than 72 characters/' <<<"$long" && return 1; }
  echo "$(git rev-list --count "$since..HEAD") commits since $since have subjects of at most 72 characters"
}

parts=(formatting dependencies cycles functions assertions files names sensors test_names words subjects symbols state analysis)
all=0
if [[ ${1-} == --all ]]; then
  all=1
  shift
fi
(($#)) || set -- "${parts[@]}"
failed=()
status=1
for part; do
  if [[ " ${parts[*]} " != *" $part "* ]]; then
    say "unknown part '$part'; parts: ${parts[*]}"
    exit 2
  fi
  echo "== $part"
  # A subshell with its own `set -e`: `if` and `||` would switch that off within it.
  set +e
  (set -e; "$part")
  part_status=$?
  set -e
  ((part_status == 0)) || failed+=("$part")
  ((part_status != 77)) || status=77
done
if ((${#failed[@]})); then
  echo "violated: ${failed[*]}"
  (($# == 1)) || status=1
  exit "$status"
fi
