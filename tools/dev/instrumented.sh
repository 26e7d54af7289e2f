#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
#
# Runs tests with a sanitizer or valgrind: instrumented.sh TOOL [OPTIONS], TOOL being
#
#   address, undefined, thread   a sanitizer: built with it in build-TOOL/
#   valgrind                     the programs of build/, under memcheck
#
# The programs are those of core and fibers, or those of --programs NAME,...; further OPTIONS go to run_tests.py.
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
# Tests that the tool does not support, or that take too long with it.
without=
# Campaigns of some hundred thousand schedules, each of which initialises its tasks' shadow memory again; other tests
# cover the same primitives.
campaigns='Strategies.*:Strategies/*:Timed.*:Dpor.*:Polling.*'
patience=10
case $tool in
  address | undefined | thread)
    build=$root/build-$tool
    # Crash messages of the program itself are tested: sanitizers must not handle the signal.
    export ASAN_OPTIONS=handle_segv=0:detect_stack_use_after_return=1
    # Tests' tasks share plain variables, ordered by virtual time, which this sanitizer cannot see. The sanitizer's own
    # tests enable reports themselves.
    export TSAN_OPTIONS=handle_segv=0:report_bugs=0
    export UBSAN_OPTIONS=print_stacktrace=1
    options+=(-Db_sanitize="$tool" -Db_lundef=false -Db_pch=false -Dgrouped=false -Ddefault_library=static -Doptimization=1 -Dwerror=false -Dbenchmarks=disabled -Dfast_path_checks=true)
    [[ $tool != undefined ]] || options+=(-Dcpp_args=-fno-sanitize-recover=undefined)
    # ThreadSanitizer supports at most 8 000 threads.
    [[ $tool == undefined ]] || without=$campaigns
    [[ $tool != thread ]] || without+=:ManyTasks.*
    ;;
  valgrind)
    # Death tests fork processes that end in their own ways.
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
