// SPDX-License-Identifier: BSD-3-Clause
// Enforcement of --confined by the system: Landlock (landlock(7)), in the version of the kernel.
//
//   before input is read    reads: the allowed folders, the files that options name, the system's, the program's own;
//                           writes: the folders of outputs; no TCP and no abstract sockets
//   after it is read        of the allowed folders only the files of the list (core/file_list.hpp)
//
// A right that is taken away does not come back, for this process and the processes that it starts. What is open stays
// open.
#pragma once

#include <filesystem>
#include <vector>

namespace waitpoint::tools {

/// The rights of a confined command.
struct SystemConfinement {
  std::vector<std::filesystem::path> folders;   ///< of input, with all below; without those that are not listed, later
  std::vector<std::filesystem::path> inputs;    ///< files that options name
  std::vector<std::filesystem::path> writable;  ///< folders with all below
  bool uses_network = false;
};

/// Once in a process, before input is read. If the kernel cannot restrict it, a line on the error stream says so.
void confine_by_system(SystemConfinement confinement);
/// After input is read. Nothing if the system does not confine this process, or if it was called before.
void confine_to_listed_files();

}  // namespace waitpoint::tools
