// SPDX-License-Identifier: BSD-3-Clause
// How a user gets a part that needs a library which this build did not find, or that is not built for a first run: the
// end of the line of a BadInput. Parts in libraries of their own are packages, too; the others are in every packaged
// program.
#pragma once

namespace waitpoint::missing_part {

inline constexpr const char* accesses = "`./dev run` builds them in (Zydis, Debian's libzydis-dev)";
inline constexpr const char* bags = "install the package waitpoint-bags, or `./dev add bags` (rosbag_storage)";
inline constexpr const char* bullet = "`./dev add bullet` builds it in (Debian's libbullet-dev)";
inline constexpr const char* meshes = "`./dev add meshes` builds them in (Assimp, Debian's libassimp-dev)";
inline constexpr const char* nodes = "install the package waitpoint-ros, or `./dev ros` (roscpp)";
inline constexpr const char* programs =
    "install the package waitpoint, or `./dev add programs` (some minutes of compilation)";
inline constexpr const char* ranks = "install the package waitpoint-mpi, or `./dev add ranks` (Open MPI)";
inline constexpr const char* tcl = "install the package waitpoint-tcl, or `./dev add tcl` (Debian's tcl8.6-dev)";

}  // namespace waitpoint::missing_part
