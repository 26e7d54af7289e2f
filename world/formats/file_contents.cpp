// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/file_contents.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/error.hpp"

namespace waitpoint::world {

std::string file_contents(const std::string& file, std::string_view expected, std::size_t bytes_max) {
  // Reading a device may never end, opening a pipe may block.
  std::error_code error;
  if (std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error)) {
    throw BadInput(file, "expected " + std::string(expected) + ", found no regular file");
  }
  std::ifstream in(file, std::ios::binary);
  std::string contents;
  constexpr std::size_t block = std::size_t{1} << 20;
  while (in && contents.size() <= bytes_max) {
    const std::size_t before = contents.size();
    contents.resize(before + std::min(block, bytes_max + 1 - before));
    in.read(contents.data() + before, static_cast<std::streamsize>(contents.size() - before));
    contents.resize(before + static_cast<std::size_t>(in.gcount()));
  }
  if (contents.empty()) throw BadInput(file, "expected " + std::string(expected) + ", found no file or an empty one");
  if (contents.size() > bytes_max) {
    throw BadInput(file,
                   "expected " + std::string(expected) + " of at most " + std::to_string(bytes_max >> 20) + " MiB");
  }
  return contents;
}

std::string beside(const std::string& file, const std::string& path) {
  return (std::filesystem::path(file).parent_path() / path).lexically_normal().string();
}

}  // namespace waitpoint::world
