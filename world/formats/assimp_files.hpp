// SPDX-License-Identifier: BSD-3-Clause
// The files that a mesh read by Assimp refers to, such as the buffers of a glTF.
#pragma once

#include <assimp/IOSystem.hpp>
#include <cstddef>
#include <optional>
#include <string>

#include "core/error.hpp"

namespace waitpoint::world {

/// Gives Assimp the files beside a mesh's file, for reading only. As other files that input names they are confined
/// (core/confinement.hpp), regular, and at most tree_bytes_max long, all of a mesh together. No exception passes
/// through Assimp: a refused file is as missing to it, and require_none_refused() tells of it after the read.
class AssimpFiles final : public Assimp::IOSystem {
 public:
  explicit AssimpFiles(std::string mesh_file);

  /// True for files that Open() may read.
  bool Exists(const char* name) const override;
  char getOsSeparator() const override { return '/'; }
  /// Null for a file that is missing, empty or refused, and for any mode but reading.
  Assimp::IOStream* Open(const char* name, const char* mode) override;
  void Close(Assimp::IOStream* stream) override;
  bool CreateDirectory(const std::string&) override { return false; }
  bool ChangeDirectory(const std::string&) override { return false; }
  bool DeleteFile(const std::string&) override { return false; }

  /// BadInput, naming the first file that was refused.
  void require_none_refused() const;

 private:
  std::string contents_of(const std::string& file);

  std::string mesh_file_;
  std::size_t bytes_ = 0;  ///< that were read
  std::optional<BadInput> refused_;
};

}  // namespace waitpoint::world
