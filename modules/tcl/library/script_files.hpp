// SPDX-License-Identifier: BSD-3-Clause
// The files that a script may name: those at and below its folders, and for reading also Tcl's own library. Symbolic
// links are followed first, so that none leads out.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace waitpoint::tcl {

enum class FileUse { read, write };

class ScriptFiles {
 public:
  /// Called for each file that is opened or written; false: a script may not use it.
  using Take = std::function<bool(const std::string& file, FileUse use)>;

  /// `folders` are absolute; relative names are in the first. None: no file may be named.
  ScriptFiles(const std::vector<std::string>& folders, const std::string& library, Take take);

  /// The file's path without symbolic links; none if a script may not use it so.
  std::optional<std::string> find(const std::string& name, FileUse use) const;
  /// The same, of a file that is used now.
  std::optional<std::string> take(const std::string& name, FileUse use) const;
  /// That of relative names; empty: none.
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> own_;  // canonical
  std::filesystem::path library_;
  Take take_;
};

}  // namespace waitpoint::tcl
