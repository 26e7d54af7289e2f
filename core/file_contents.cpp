// SPDX-License-Identifier: BSD-3-Clause
#include "core/file_contents.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "core/confinement.hpp"
#include "core/error.hpp"
#include "core/file_list.hpp"

namespace waitpoint {
namespace {

namespace fs = std::filesystem;

std::string mebibytes(std::size_t bytes) { return std::to_string(bytes >> 20) + " MiB"; }

/// The bytes up to the end, or more than `bytes_max` of them.
std::string read_bytes(std::ifstream& in, std::size_t bytes_max) {
  std::string contents;
  constexpr std::size_t block = std::size_t{1} << 20;
  while (in && contents.size() <= bytes_max) {
    const std::size_t before = contents.size();
    contents.resize(before + std::min(block, bytes_max + 1 - before));
    in.read(contents.data() + before, static_cast<std::streamsize>(contents.size() - before));
    contents.resize(before + static_cast<std::size_t>(in.gcount()));
  }
  return contents;
}

}  // namespace

std::string file_contents(const std::string& file, std::string_view expected, std::size_t bytes_max) {
  Confinement::require_allowed(file);
  // Reading a device may never end, opening a pipe may block.
  std::error_code error;
  if (fs::exists(file, error) && !fs::is_regular_file(file, error)) {
    throw BadInput(file, "expected " + std::string(expected) + ", found no regular file");
  }
  FileList::add(file, FileRole::read);
  std::ifstream in(file, std::ios::binary);
  std::string contents = read_bytes(in, bytes_max);
  if (contents.empty()) throw BadInput(file, "expected " + std::string(expected) + ", found no file or an empty one");
  if (contents.size() > bytes_max)
    throw BadInput(file, "expected " + std::string(expected) + " of at most " + mebibytes(bytes_max));
  return contents;
}

std::string given_file_contents(const fs::path& file, std::size_t bytes_max) {
  std::error_code error;
  if (fs::is_directory(file, error)) throw BadInput(file.string(), "is a folder, expected a file");
  FileList::add(file, FileRole::read);
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  std::string contents = read_bytes(in, bytes_max);
  if (!in.is_open() || in.bad()) throw BadInput(file.string(), std::string("cannot be read: ") + std::strerror(errno));
  if (contents.size() > bytes_max) throw BadInput(file.string(), "expected a file of at most " + mebibytes(bytes_max));
  return contents;
}

}  // namespace waitpoint
