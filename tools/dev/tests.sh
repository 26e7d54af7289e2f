# SPDX-License-Identifier: BSD-3-Clause
# `./dev test`, and the tests that take longer, each by an option: sourced by ./dev, which has `root`, `build` and the
# functions of packages.sh and build.sh.

run_tests() {
  if [[ ${1-} == --packages ]]; then
    require package packages
    "$root/tools/dev/package.sh" "$build/packages" >&2
    local again=()
    if [[ ${2-} == --twice ]]; then
      again=("$build/packages-again")
      "$root/tools/dev/package_again.sh" "${again[@]}" >&2
    fi
    python3 "$root/tests/packages/built_test.py" "$build/packages" "${again[@]}"
    exec python3 "$root/tests/packages/fresh_root_test.py" "$build/packages"
  fi
  if [[ ${1-} == --docker ]]; then
    require packages
    exec python3 "$root/tests/packages/docker_test.py" "${@:2}"
  fi
  require run "${parts[@]}" test
  case ${1-} in
    --builds) require builds && exec "$root/tools/dev/builds.sh" "${@:2}" ;;
    --build-systems)
      python3 "$root/tests/packages/build_systems_test.py"
      exec python3 "$root/tests/packages/recipes_test.py" --long
      ;;
    --minimal) exec "$root/tools/dev/minimal.sh" "${@:2}" ;;
    --wraps) require wraps && exec "$root/tools/dev/wraps.sh" "${@:2}" ;;
    --sanitize=address | --sanitize=undefined | --sanitize=thread)
      exec "$root/tools/dev/instrumented.sh" "${1#*=}" "${@:2}"
      ;;
    --valgrind) require valgrind && exec "$root/tools/dev/instrumented.sh" valgrind "${@:2}" ;;
    --arm64) require arm64 && exec "$root/tools/dev/arm64/arm64.sh" "${@:2}" ;;
    --fuzz) exec "$root/tools/dev/fuzz.sh" "${@:2}" ;;
    --agreement)
      configure -Dtests=enabled
      compile tests/test-world
      WAITPOINT_PLACEMENTS=${2:-1000000} exec "$build/tests/test-world" \
        --gtest_filter='Surfaces.CollideWhereFclDoes*:Octree.CollidesWhereFclsDoes'
      ;;
    --zoo)
      configure -Dtests=enabled
      compile tests/zoo-table
      exec "$build/tests/zoo-table" "${@:2}"
      ;;
    --completeness)
      configure -Dtests=enabled
      compile tests/completeness tests/completeness-program tests/completeness-pairs tools/waitpoint libwaitpoint-exec.so
      if [[ ${2-} == --pairs ]]; then
        exec python3 "$root/tests/fibers/explore/completeness/pairs.py" "$build" "${@:3}"
      fi
      exec "$build/tests/completeness" "${@:2}"
      ;;
    --endurance)
      configure
      compile tools/waitpoint
      exec python3 "$root/tools/dev/endurance.py" "$build" "${@:2}"
      ;;
    --real)
      configure
      compile tools/waitpoint
      exec python3 "$root/tests/real/campaign.py" "$build" "${@:2}"
      ;;
    --exec)
      configure -Dtests=enabled
      compile tools/waitpoint libwaitpoint-exec.so
      exec python3 "$root/tests/exec/debian_test.py" "$build" --long
      ;;
    --docs)
      configure -Dtests=enabled
      compile all
      exec python3 "$root/tests/docs/pages_test.py" "$build" --long "${@:2}"
      ;;
    --view)
      require view
      configure
      compile tools/waitpoint
      exec python3 "$root/tests/view/browser_test.py" "$build" --install
      ;;
    --ros)
      build_for_ros
      python3 "$root/tests/exec/ros_test.py" "$build" --long
      exec python3 "$root/tests/programs/nodes_test.py" "$build" --long
      ;;
    --replay-bags)
      build_for_ros
      exec python3 "$root/tests/programs/bags_test.py" "$build" --replay-bags "${@:2}"
      ;;
    --ros2)
      build_for_ros2
      python3 "$root/tests/programs/dds_test.py" "$build"
      (($# < 2)) || exec python3 "$root/tests/programs/rclcpp_test.py" "$build" "$2"
      ;;
    --pocolibs)
      configure -Dtests=enabled
      compile all
      exec python3 "$root/tests/exec/pocolibs_test.py" "$build" "${2:?--pocolibs takes the folder of its sources}"
      ;;
    --ranks)
      configure -Dtests=enabled
      compile all
      exec python3 "$root/tests/programs/ranks_test.py" "$build" --long
      ;;
    --exec-zoo)
      configure -Dtests=enabled
      compile tools/waitpoint libwaitpoint-exec.so exec-zoo
      exec python3 "$root/tests/exec/zoo_test.py" "$build" --long
      ;;
    --found-again)
      configure
      compile tools/waitpoint libwaitpoint-exec.so libwaitpoint-exec-races.so libtsan.so.2
      exec python3 "$root/tests/found_again/found_again.py" "$build" "${@:2}"
      ;;
    --faults)
      configure -Dtests=enabled
      compile program libwaitpoint-exec.so tests/faults/failing-calls
      exec python3 "$root/tests/faults/faults_test.py" "$build" --all
      ;;
    --flakes)
      configure -Dtests=enabled
      compile all all-tests
      exec python3 "$root/tools/dev/flakes.py" "$build" "${@:2}"
      ;;
    --replays) exec "$root/tools/dev/replays.sh" ;;
    --sanitize*)
      say '--sanitize takes address, undefined or thread: --sanitize=address'
      exit 2
      ;;
  esac
  configure -Dtests=enabled
  compile all all-tests
  exec python3 "$root/tools/dev/run_tests.py" "$build" "$@"
}
