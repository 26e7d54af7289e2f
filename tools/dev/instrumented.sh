#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
#
# Tests in programs that watch themselves: instrumented.sh TOOL [OPTIONS], TOOL being
#
#   address, undefined, thread   a sanitizer: built with it in build-TOOL/
#   valgrind                     the programs of build/, under memcheck
#
# The programs are those of core and fibers, or what --programs NAME,... names; further OPTIONS are run_tests.py's.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
source "$root/tools/dev/packages.sh"
source "$root/tools/dev/build.sh"

tool=$1
shift
programs=core,fibers
if [[ ${1-} == --programs ]]; then
  programs=$2
  shift 2
fi
names=(${programs//,/ })
build=$root/build
options=(-Dtests=enabled)
under=()
# What cannot be tried with the tool, or not in reasonable time.
without=
# These go through some hundred thousand schedules, each of which makes its tasks' shadows anew; what they try of the
# primitives the others try too.
campaigns='Strategies.*:Strategies/*:Timed.*:Dpor.*:Polling.*'
patience=10
case $tool in
  address | undefined | thread)
    build=$root/build-$tool
    # The program's own messages at a crash are tested: the sanitizers leave the signal alone.
    export ASAN_OPTIONS=handle_segv=0:detect_stack_use_after_return=1
    # The tests' tasks share plain variables, which virtual time orders and this sanitizer cannot see. What it is to report
    # and what not, the tests of it turn on for themselves.
    export TSAN_OPTIONS=handle_segv=0:report_bugs=0
    export UBSAN_OPTIONS=print_stacktrace=1
    options+=(-Db_sanitize="$tool" -Db_lundef=false -Db_pch=false -Ddefault_library=static -Doptimization=1 -Dwerror=false -Dbenchmarks=disabled -Dfast_path_checks=true)
    [[ $tool != undefined ]] || options+=(-Dcpp_args=-fno-sanitize-recover=undefined)
    # ThreadSanitizer knows 8 000 threads at most.
    [[ $tool == undefined ]] || without=$campaigns
    [[ $tool != thread ]] || without+=:ManyTasks.*
    ;;
  valgrind)
    # Death tests are processes of their own, which end as they like.
    under=(--under 'valgrind --quiet --error-exitcode=99 --leak-check=no --max-stackframe=8000000')
    without="$campaigns:*HundredThousand*:*Million*:ManyTasks.*:*DeathTest.*"
    patience=60
    ;;
esac
configure "${options[@]}"
compile "${names[@]/#/tests/test-}"
[[ ! $without ]] || without=--gtest_filter=-$without
exec python3 "$root/tools/dev/run_tests.py" "$build" --programs "$programs" --patience "$patience" "${under[@]}" \
  ${without:+"$without"} "$@"
