#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
#
# Fuzzes the loaders: fuzz.sh [--seconds N] [NAME...]
#
# Runs each libFuzzer target of tests/fuzz, or each one named, for N seconds (default: 60), built with clang++ in
# build-fuzz/. It starts with the files of tests/fuzz/corpus/NAME; new inputs go to build-fuzz/corpus/NAME. An input
# that crashes, takes more than 10 s or more than 1 GiB is kept in build-fuzz/found, and the status is 1: fix the loader
# and add the input to the corpus. scenario_run also runs what it reads.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
source "$root/tools/dev/packages.sh"
source "$root/tools/dev/build.sh"

seconds=60
if [[ ${1-} == --seconds ]]; then
  seconds=${2-}
  [[ $seconds =~ ^[0-9]+$ ]] || { say 'expected --seconds N'; exit 2; }
  shift 2
fi
names=()
for source in "$root"/tests/fuzz/*.cpp; do
  ! grep -q LLVMFuzzerTestOneInput "$source" || names+=("$(basename "$source" .cpp)")
done
for name; do
  [[ " ${names[*]} " == *" $name "* ]] || { say "unknown target '$name'; targets: ${names[*]}"; exit 2; }
done
(($#)) && names=("$@")

build=$root/build-fuzz
export CC=clang CXX=clang++
configure -Ddefault_library=static -Db_pch=false -Dgrouped=false -Dtests=enabled -Dbenchmarks=disabled -Dwerror=false -Dfast_path_checks=true
compile "${names[@]/#/tests/fuzz/fuzz-}"
mkdir -p "$build/found"
echo leak:fuzzer::FuzzerDriver >"$build/leaks"  # libFuzzer's own
# Inputs that are read as files are written to memory.
[[ ! -w /dev/shm ]] || export TMPDIR=/dev/shm
status=0
# A figure of libFuzzer's last lines.
figure() { sed -n "s/^stat::$1: *//p" <<<"$output"; }
for name in "${names[@]}"; do
  mkdir -p "$build/corpus/$name"
  # Long inputs cost speed and find no more; those of scenario_run are whole scenarios.
  max_len=1024
  [[ $name != scenario_run ]] || max_len=8192
  # An empty current folder: included files of inputs are missing.
  empty=$(mktemp -d)
  if output=$(cd "$empty" && UBSAN_OPTIONS=print_stacktrace=1 LSAN_OPTIONS=suppressions="$build/leaks" \
    "$build/tests/fuzz/fuzz-$name" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=1024 \
    -max_len="$max_len" -print_final_stats=1 -artifact_prefix="$build/found/$name-" \
    "$build/corpus/$name" "$root/tests/fuzz/corpus/$name" 2>&1); then
    echo "$name: $(figure number_of_executed_units) inputs, $(figure average_exec_per_sec) a second, no findings"
  else
    echo "$output" | tail -40
    echo "$name: FAILED"
    status=1
  fi
  rmdir "$empty"
done
exit "$status"
