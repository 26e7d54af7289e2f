#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
#
# Runs a scenario and explores its schedules; prints a summary in Markdown, with the command that repeats a failure:
#   simulate.sh SCENARIO [OPTIONS of waitpoint explore]
# Those that waitpoint run has, too, are for both: --until, --seed, --set, --confined, --allow.
# Exit status 0 if both passed, 1 if not, 2 if one could not begin. Leaves run.json and explore.json in the current folder.
# Needs waitpoint and jq.
set -u
scenario=${1:?simulate.sh SCENARIO [OPTIONS of waitpoint explore]}
shift
command -v jq > /dev/null || { echo 'simulate.sh: jq is needed, and is not there' >&2; exit 2; }

# A command of waitpoint, whose document is FILE: begin FILE COMMAND...
begin() {
  file=$1
  shift
  waitpoint "$@" --json > "$file" 2> "$file.text"
  status=$?
  [ -s "$file" ] && return
  printf '**waitpoint %s did not begin:**\n\n    %s\n' "$*" "$(tail -n 1 "$file.text")"
  exit 2
}

# The run of the scenario, with the options that are for both.
begin_run() {
  left=$#
  while [ "$left" -gt 0 ]; do
    case $1 in
      --until | --seed | --set | --allow)
        set -- "$@" "$1"
        shift
        left=$((left - 1))
        [ "$left" -gt 0 ] || break
        set -- "$@" "$1" ;;
      --until=* | --seed=* | --set=* | --allow=* | --confined) set -- "$@" "$1" ;;
    esac
    shift
    left=$((left - 1))
  done
  begin run.json run "$scenario" "$@"
}

failed=0
printf '## %s\n\n' "$scenario"

begin_run "$@"
jq -r 'def metres: if . == null then "-" else "\(. * 1000 | round / 1000) m" end;
  .result | "| goals | collisions | greatest position error | digest |\n|---|---|---|---|\n" +
  "| \(.goals_reached) of \(.goals) | \(.collisions // "-") | \(.position_error_max_m | metres) | `\(.digest)` |\n"' run.json
if [ "$status" -ne 0 ]; then
  failed=1
  jq -r '.result | "**The run failed:** \((.unmet // []) | join("; ")) (\(.outcome)). It is repeated by\n\n    \(.replay)\n"' run.json
fi

begin explore.json explore "$scenario" "$@"
if [ "$status" -eq 0 ]; then
  jq -r '.result.search.schedules | "\(.) schedule\(if . == 1 then "" else "s" end) passed."' explore.json
elif [ "$(jq '.result.failure == null' explore.json)" = true ]; then
  failed=1
  jq -r '"**Exploring ended early:** \(.result.outcome), after \(.result.search.schedules) schedules."' explore.json
else
  failed=1
  jq -r '.result.failure | "**\(.schedule) fails:** \(.message | split("\n")[0]). It is repeated by\n\n    \(.replay)\n"' explore.json
fi
exit "$failed"
