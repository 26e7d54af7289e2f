// SPDX-License-Identifier: BSD-3-Clause
// Limits the files that input may name to some folders: for scenarios of strangers.
//
// While a thread has a Confinement, every reader in it of files that a scenario, a world or a model names calls
// require_allowed() before it touches the file. Symbolic links are followed first, so that none leads out. Code is
// never loaded: robots' programs are refused.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

namespace waitpoint {

class Confinement {
 public:
  /// Allows all files at or below `folders`. BadInput if one of them is no folder. Replaces an outer confinement of
  /// this thread until its own end; other threads are not confined by it.
  explicit Confinement(std::span<const std::filesystem::path> folders);
  ~Confinement();
  Confinement(const Confinement&) = delete;
  Confinement& operator=(const Confinement&) = delete;

  static bool exists();
  /// True without a confinement, and for files in its folders.
  static bool allows(const std::filesystem::path& file);
  /// BadInput, naming the file, unless it is allowed; the existence of the file is not disclosed.
  static void require_allowed(const std::filesystem::path& file);

 private:
  std::vector<std::filesystem::path> folders_;  // canonical
  const Confinement* outer_;
};

}  // namespace waitpoint
