# SPDX-License-Identifier: BSD-3-Clause
#
# The packages that each command needs, and their installation. Sourced by `dev`.

# Debian's names, and the upstream names of the same software.
declare -A debian=(
  [run]='meson ninja-build g++ pkg-config python3 libboost-context-dev libfcl-dev libyaml-cpp-dev libcli11-dev libfmt-dev
         nlohmann-json3-dev libpng-dev libtinyxml2-dev zlib1g-dev libbz2-dev liblz4-dev libzstd-dev
         libzydis-dev'
  [bags]='librosbag-storage-dev'
  [bullet]='libbullet-dev'
  [meshes]='libassimp-dev'
  [ranks]='libopenmpi-dev openmpi-bin'
  [tcl]='tcl8.6-dev'
  [test]='libgtest-dev liboctomap-dev clang gdb libz3-dev python3-rosbag zstd xz-utils pigz pbzip2 perl libtbb-dev
         libuv1-dev cmake catch2 doctest-dev python3-jsonschema jq zsh fish cyclonedds-dev cyclonedds-tools libnav-msgs-dev
         libros-rosgraph-msgs-dev libsensor-msgs-dev libtf2-msgs-dev libvisualization-msgs-dev libglib2.0-dev libabsl-dev'
  [ros]='python3-rosmaster libroscpp-dev libstd-msgs-dev libnav-msgs-dev libsensor-msgs-dev libtf2-ros-dev
        libnodeletlib-dev libnodeletlib-tools libvisualization-msgs-dev ros-robot-state-publisher python3-rospy python3-nav-msgs python3-sensor-msgs python3-tf2-ros librosbag-dev python3-rosbag'
  [ros2]='cyclonedds-dev cyclonedds-tools libfastrtps-dev libfastcdr-dev'
  [view]="chromium $(command -v node >/dev/null && command -v npm >/dev/null || echo nodejs npm)"
  [builds]='clang libc++-dev libc++abi-dev'
  [wraps]=''
  [valgrind]='valgrind'
  [arm64]='g++-aarch64-linux-gnu qemu-user mmdebstrap ccache'
  [bench]='libbenchmark-dev'
  [peers]='libsystemc-dev libsimgrid-dev libboost-fiber-dev libembree-dev libbox2d-dev
           libode-dev libcgal-dev'
  [docs]='python3-sphinx python3-myst-parser furo doxygen'
  [package]='git dpkg-dev debhelper xz-utils'
  [packages]='debootstrap lintian'
  [check]='clang-format clang-tidy'
  [format]='clang-format'
)
declare -A upstream=(
  [run]='Meson 1.0, Ninja, a C++20 compiler, pkg-config, Python 3; Boost.Context 1.74, FCL 0.7 with libccd and Eigen 3.4,
         yaml-cpp, CLI11, fmt, nlohmann_json, libpng, TinyXML-2, zlib; for compressed
         logs, if wanted, bzip2, lz4, zstd; on x86-64 Zydis 4'
  [bags]='for recordings as ROS bags: rosbag_storage'
  [bullet]='for the dynamic world: Bullet 3.24 in double precision'
  [meshes]='for meshes of other kinds than STL and OBJ: Assimp 5.2'
  [ranks]='for runs of several processes: Open MPI 4'
  [tcl]='for scripts in Tcl: Tcl 8.6'
  [test]='GoogleTest, OctoMap, g++ and clang++, gdb, Z3; if available: zstd, xz, pigz, pbzip2, Perl, TBB, libuv, CMake, Catch2 2.13 or 3.4, doctest 2.4, jsonschema for Python, jq, zsh, fish, Cyclone DDS 0.10 with idlc, the messages of ROS 1, GLib 2.74, Abseil 20220623, rustc, cargo with Debian'"'"'s crates parking_lot and crossbeam'
  [ros]='of ROS 1: roscpp, rospy, tf2_ros, nodelet, rosbag, robot_state_publisher, rosmaster'
  [ros2]='Cyclone DDS 0.10 with idlc, Fast DDS 2.9'
  [view]='Chromium, Node.js 18, npm'
  [builds]='clang++ with libc++; Debian'"'"'s source packages'
  [wraps]='Debian'"'"'s source packages'
  [valgrind]='valgrind'
  [arm64]='Debian'"'"'s cross compiler for arm64, qemu-user, mmdebstrap, ccache'
  [bench]='Google Benchmark'
  [peers]='SystemC 2.3.4, SimGrid 3.32, Boost.Fiber 1.74, Embree 3.13, Box2D 2.4,
           ODE 0.16, CGAL 5.5 (each is left out where it is missing)'
  [docs]='Sphinx 5.3 with MyST and furo, Doxygen 1.9'
  [package]='Debian 12, git'
  [packages]='debootstrap, lintian'
  [check]='clang-format and clang-tidy 14'
  [format]='clang-format 14'
)
# Required for every build; all libraries except Google Benchmark and its peers come from subprojects/ if missing.
declare -A tools=(
  [bags]='' [bullet]='' [meshes]='' [ranks]='' [tcl]=''
  [run]='meson ninja c++ pkg-config python3' [test]='' [ros]='rosmaster' [ros2]='idlc' [view]='chromium node npm'
  [builds]='clang++ apt-get' [wraps]='apt-get' [valgrind]='valgrind'
  [arm64]='aarch64-linux-gnu-g++ qemu-aarch64 mmdebstrap ccache'
  [bench]='' [peers]='' [docs]='sphinx-build doxygen' [package]='git dpkg-buildpackage' [packages]='debootstrap lintian' [check]='' [format]='clang-format'
)

# Parts of the program that need a library of their own, and the option and the trace of each in the build.
parts=(bags bullet meshes ranks tcl)
declare -A option_of_part=([bags]=rosbag [bullet]=bullet [meshes]=assimp [ranks]=ranks [tcl]=tcl)
declare -A trace_of_part=(
  [bags]=libwaitpoint-bags.so [bullet]=BulletDynamics [meshes]=libassimp [ranks]=libwaitpoint-mpi.so
  [tcl]=libwaitpoint-tcl.so
)

say() { echo "dev: $*" >&2; }

# Installs the packages that the given commands need: require COMMAND...
require() {
  local missing=()
  if command -v apt-get >/dev/null; then
    mapfile -t missing < <(missing_packages $(needed debian "$@"))
    ((${#missing[@]})) || return 0
    say "needed from Debian: ${missing[*]}"
    if may_become_root; then
      say 'installing them'
      install_packages "${missing[@]}"
      return
    fi
    say "not root, and sudo does not work here. As root: apt-get install --no-install-recommends ${missing[*]}"
  fi
  require_tools "$@"
}

# Entries of table TABLE for the given commands: needed TABLE COMMAND...
needed() {
  local -n table=$1
  shift
  local name
  for name; do echo ${table[$name]}; done
}

# The given packages that are not installed; dpkg-query fails for unknown ones.
missing_packages() {
  local installed
  installed=$( (dpkg-query -W -f '${db:Status-Status} ${Package}\n' "$@" 2>/dev/null || true) | sed -n 's/^installed //p')
  printf '%s\n' "$@" | sort -u | grep -vxF -f <(echo "$installed") || true
}

may_become_root() { ((EUID == 0)) || { command -v sudo >/dev/null && as_root true; }; }

as_root() {
  if ((EUID == 0)); then
    "$@"
  elif [[ -t 0 ]]; then
    sudo "$@"
  else
    sudo -n "$@"
  fi
}

install_packages() {
  local install=(env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 apt-get -o DPkg::Lock::Timeout=300 -o Acquire::Retries=3
    -o Dpkg::Use-Pty=0 -y -q)
  # Package lists are missing on a fresh machine, and name deleted files on an old one.
  if ! apt-cache show "$@" >/dev/null 2>&1 || ! as_root "${install[@]}" install --no-install-recommends "$@" >&2; then
    as_root "${install[@]}" update >&2
    as_root "${install[@]}" install --no-install-recommends "$@" >&2
  fi
}

require_tools() {
  local absent=() tool
  for tool in $(needed tools "$@"); do
    command -v "$tool" >/dev/null || absent+=("$tool")
  done
  if ((${#absent[@]})) || [[ ! -e $build/build.ninja ]]; then
    say 'cannot install packages here; needed are:'
    needed upstream "$@" | sed 's/^/       /' >&2
  fi
  if ((${#absent[@]})); then
    say "cannot continue without: ${absent[*]}"
    exit 1
  fi
  say 'Meson builds missing libraries from subprojects/'
}
