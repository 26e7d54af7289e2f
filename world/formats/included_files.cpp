// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/included_files.hpp"

#include <algorithm>
#include <filesystem>

#include "core/confinement.hpp"
#include "core/error.hpp"
#include "core/file_contents.hpp"

namespace waitpoint::world {
namespace {

std::string canonical(const std::string& file) {
  std::error_code error;
  const std::filesystem::path path = std::filesystem::weakly_canonical(file, error);
  return error ? file : path.string();
}

}  // namespace

IncludedFiles::IncludedFiles(const std::string& file, const std::string& contents, std::size_t bytes_max)
    : open_{canonical(file)}, bytes_(contents.size()), bytes_max_(bytes_max) {}

std::string IncludedFiles::enter(const std::string& file, const std::string& from, int line) {
  Confinement::require_allowed(file);
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    throw BadInput(from, line, "there is no file '" + file + "' to include");
  }
  const std::string path = canonical(file);
  if (std::find(open_.begin(), open_.end(), path) != open_.end()) {
    throw BadInput(from, line, "'" + file + "' includes itself");
  }
  if (open_.size() > depth_max || ++count_ > count_max) {
    throw BadInput(from, line,
                   "expected at most " + std::to_string(count_max) + " included files, nested at most " +
                       std::to_string(depth_max) + " deep");
  }
  std::string contents = file_contents(file, "a file to include", bytes_max_);
  bytes_ += contents.size();
  if (bytes_ > bytes_max_) {
    throw BadInput(from, line,
                   "expected files of at most " + std::to_string(bytes_max_ >> 20) + " MiB in all to be included");
  }
  open_.push_back(path);
  return contents;
}

}  // namespace waitpoint::world
