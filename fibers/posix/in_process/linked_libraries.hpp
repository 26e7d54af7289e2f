// SPDX-License-Identifier: BSD-3-Clause
// The files of the libraries that a program is linked to, directly or by another library, or that it asks for, as the
// dynamic linker finds them: by run paths, with $ORIGIN, by LD_LIBRARY_PATH and by its cache.
#pragma once

#include <climits>
#include <cstddef>

namespace waitpoint::posix {

class LinkedLibraries {
 public:
  /// Of a program, or a library; and, unless it is null, a library that it asks for by name.
  explicit LinkedLibraries(const char* program, const char* asked = nullptr) : program_(program), asked_(asked) {}
  ~LinkedLibraries();
  LinkedLibraries(const LinkedLibraries&) = delete;
  LinkedLibraries& operator=(const LinkedLibraries&) = delete;

  using Path = char[PATH_MAX];
  /// Finds the library of this name; false if the dynamic linker does not.
  bool find(const char* name, Path& path);

 private:
  void list();

  const char *program_, *asked_;
  bool is_listed_ = false;
  char* list_ = nullptr;  ///< the dynamic linker's list, see ld.so(8)
  std::size_t size_ = 0;
};

/// True for a library that all programs of a process share, with one state of the process: the C library with its
/// parts, the C++ runtime, the compiler's runtimes, and this project's own.
bool is_shared_by_programs(const char* name);

}  // namespace waitpoint::posix
