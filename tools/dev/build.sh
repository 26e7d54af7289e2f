# SPDX-License-Identifier: BSD-3-Clause
#
# Meson's set-up and Ninja's build of build/; neither does anything if up to date. Sourced by `dev`. Their output goes
# to stderr: stdout belongs to the program that is run.

# Sets up build/ if necessary, and passes OPTIONS that it does not have: configure [OPTION...]
configure() {
  if [[ ! -e $build/build.ninja ]]; then
    # Remains of an interrupted set-up would confuse the next one.
    rm -rf "$build/meson-private" "$build/meson-info"
    meson setup "$build" "$root" --buildtype=debugoptimized "$@" >&2
  elif ! grep -qF "\"source\": \"$root\"" "$build/meson-info/meson-info.json"; then
    say 'this folder was moved since build/ was set up: setting it up again'
    meson setup --wipe "$build" "$root" "$@" >&2
  else
    local option
    for option; do
      option=${option#-D}
      if ! grep -qxF "${option%%=*} = ${option#*=}" "$build/meson-private/cmd_line.txt"; then
        # `meson configure` only knows the options that existed when build/ was set up.
        set_up_again "$@"
        return
      fi
    done
    # Meson looks for libraries only at set-up.
    part_appeared || return 0
    set_up_again
  fi
}

# Sets up build/ anew with what has been installed since: Meson keeps what it has found, and what it has not.
set_up_again() {
  meson configure --clearcache "$build" >/dev/null
  meson setup --reconfigure "$build" "$root" "$@" >&2
}

# True if packages that build/ lacks have been installed since it was set up: those of a part, or the disassembler.
part_appeared() {
  command -v dpkg-query >/dev/null || return
  local part
  for part in "${parts[@]}"; do
    has_appeared "${trace_of_part[$part]}" "${option_of_part[$part]}" $(needed debian "$part") && return
  done
  [[ $(uname -m) == x86_64 ]] && has_appeared libZydis disassembler libzydis-dev
}

has_appeared() {
  local trace=$1 option=$2
  ! grep -qF "$trace" "$build/build.ninja" && ! grep -qxF "$option = disabled" "$build/meson-private/cmd_line.txt" &&
    [[ ! $(missing_packages "${@:3}") ]]
}

# Finds peers of the benchmarks installed since build/ was set up: Meson looks for libraries only at set-up.
look_for_peers() {
  local peer
  for peer in kernel-boost-fiber: kernel-simgrid: kernel-systemc: world.p/world_of_embree world.p/world_of_box2d \
    world.p/world_of_bullet world.p/world_of_ode libworld-of-cgal; do
    if ! grep -qF "tests/bench/$peer" "$build/build.ninja"; then
      set_up_again
      return
    fi
  done
}

compile() { (cd "$build" && ninja -j "$(nproc)" "$@") >&2; }

# Every C++ source, NUL-terminated, relative to the repository's root, which is the current folder.
list_sources() {
  find . \( -name '.?*' -o -path './build*' -o -path ./subprojects \) -prune -o \
    \( -name '*.cpp' -o -name '*.hpp' \) -type f -printf '%P\0' | sort -z
}
