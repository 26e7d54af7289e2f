# SPDX-License-Identifier: BSD-3-Clause
#
# Meson's set-up and Ninja's build of build/, each doing nothing when there is nothing to do. Sourced by `dev`.
# What they print goes to stderr: stdout belongs to the program that is run.

# Sets build/ up if it is not, and gives it OPTIONS that it does not have: configure [OPTION...]
configure() {
  if [[ ! -e $build/build.ninja ]]; then
    # What an interrupted set-up left is no start for another one.
    rm -rf "$build/meson-private" "$build/meson-info"
    meson setup "$build" "$root" --buildtype=debugoptimized "$@" >&2
  elif ! grep -qF "\"source\": \"$root\"" "$build/meson-info/meson-info.json"; then
    say 'this folder was moved since build/ was set up: setting it up anew'
    meson setup --wipe "$build" "$root" "$@" >&2
  else
    local option
    for option; do
      option=${option#-D}
      if ! grep -qxF "${option%%=*} = ${option#*=}" "$build/meson-private/cmd_line.txt"; then
        # Not `meson configure`, which knows the options that there were when build/ was set up.
        meson setup --reconfigure "$build" "$root" "$@" >&2
        return
      fi
    done
  fi
}

# Peers of the benchmarks that were installed since build/ was set up: Meson looks for libraries only then.
look_for_peers() {
  local peer
  for peer in kernel-boost-fiber: kernel-simgrid: kernel-systemc: world.p/world_of_embree world.p/world_of_box2d \
    world.p/world_of_bullet world.p/world_of_ode libworld-of-cgal; do
    if ! grep -qF "tests/bench/$peer" "$build/build.ninja"; then
      meson setup --reconfigure "$build" "$root" >&2
      return
    fi
  done
}

compile() { (cd "$build" && ninja -j "$(nproc)" "$@") >&2; }

# Every C++ source of the repository, each ended by a NUL, relative to its root: the current folder.
list_sources() {
  find . \( -name '.?*' -o -path './build*' -o -path ./subprojects \) -prune -o \
    \( -name '*.cpp' -o -name '*.hpp' \) -type f -printf '%P\0' | sort -z
}
