// SPDX-License-Identifier: BSD-3-Clause
// The libraries of a program, as far as their files tell: which it is linked to, by what their threads wait, and of
// which accesses to memory are switch points.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace waitpoint::tools {

struct LinkedLibrary {
  std::string name;  ///< as the program names it: "libz.so.1"
  std::filesystem::path file;
};

/// Those that the dynamic linker loads with the program; empty if it does not say.
std::vector<LinkedLibrary> linked_libraries(const std::filesystem::path& program);

/// By what the threads of a program wait for each other.
struct Waits {
  bool by_futexes = false;  ///< of its own, or of a library other than the C library: locks are atomics there
  bool by_calls = false;    ///< of the C library, such as pthread_mutex_lock()
  bool has_threads = false;

  /// Calls show little of the order of the threads: accesses to memory do.
  bool are_at_accesses() const { return has_threads && (by_futexes || !by_calls); }
};
/// Of the program, with all that it is linked to. `layer` is the library put in front of it, which has libraries that
/// are simulated, or its own. Of a script or a shared object, nothing is known.
Waits waits_of(const std::filesystem::path& program, const std::filesystem::path& layer);

/// The libraries whose accesses are switch points, without repetition: those `named` by a name, which may lack its
/// version, or by a path, in their order; then those that wait by futexes of their own. BadInput for a name that is
/// none, and for libraries that the layer itself uses.
std::vector<LinkedLibrary> watched_libraries(const std::filesystem::path& program, const std::filesystem::path& layer,
                                             const std::vector<std::string>& named);

}  // namespace waitpoint::tools
