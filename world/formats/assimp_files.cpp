// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/assimp_files.hpp"

#include <assimp/MemoryIOWrapper.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>
#include <utility>

#include "core/confinement.hpp"
#include "core/file_contents.hpp"
#include "world/formats/beside.hpp"
#include "world/formats/limits.hpp"

namespace waitpoint::world {
namespace {

namespace fs = std::filesystem;

/// Also true for an empty file, which file_contents() would refuse.
bool is_missing(const std::string& file) {
  std::error_code error;
  return !fs::exists(file, error) || (fs::is_regular_file(file, error) && fs::is_empty(file, error));
}

/// A stream that owns a copy of the bytes.
Assimp::IOStream* stream_of(std::string_view bytes) {
  auto copy = std::make_unique<std::uint8_t[]>(bytes.size());
  std::copy(bytes.begin(), bytes.end(), copy.get());
  auto* stream = new Assimp::MemoryIOStream(copy.get(), bytes.size(), true);
  copy.release();
  return stream;
}

}  // namespace

AssimpFiles::AssimpFiles(std::string mesh_file) : mesh_file_(std::move(mesh_file)) {}

bool AssimpFiles::Exists(const char* name) const {
  const std::string file = beside(mesh_file_, name);
  std::error_code error;
  return Confinement::allows(file) && fs::is_regular_file(file, error);
}

std::string AssimpFiles::contents_of(const std::string& file) {
  Confinement::require_allowed(file);
  if (is_missing(file)) return "";
  std::string contents = file_contents(file, "a file of a mesh", tree_bytes_max);
  bytes_ += contents.size();
  if (bytes_ > tree_bytes_max)
    throw BadInput(file, "expected at most " + std::to_string(tree_bytes_max >> 20) + " MiB in all files that '" +
                             mesh_file_ + "' refers to");
  return contents;
}

Assimp::IOStream* AssimpFiles::Open(const char* name, const char* mode) {
  // Once a file is refused, the mesh is, too: nothing more is read for it.
  if (refused_ || !std::string_view(mode).starts_with('r')) return nullptr;
  try {
    const std::string contents = contents_of(beside(mesh_file_, name));
    return contents.empty() ? nullptr : stream_of(contents);
  } catch (const BadInput& error) {
    refused_ = error;
    return nullptr;
  }
}

void AssimpFiles::Close(Assimp::IOStream* stream) { delete stream; }

void AssimpFiles::require_none_refused() const {
  if (refused_) throw BadInput(*refused_);
}

}  // namespace waitpoint::world
