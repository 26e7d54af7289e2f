// SPDX-License-Identifier: BSD-3-Clause
#include "core/file_list.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/error.hpp"

namespace waitpoint {
namespace {

namespace fs = std::filesystem;

constinit thread_local FileList* innermost = nullptr;

/// Without symbolic links; empty for a pipe or a device, which nothing replaces.
fs::path replaceable(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status)) return {};
  fs::path path = fs::weakly_canonical(fs::absolute(file, error), error);
  return error ? file.lexically_normal() : path;
}

[[noreturn]] void refuse(const std::string& output, FileRole use) {
  const char* const reason = use == FileRole::written ? "another output of the scenario" : "also read";
  throw BadInput(output, std::string("cannot be an output: it is ") + reason);
}

}  // namespace

FileList::FileList() : outer_(std::exchange(innermost, this)) {}

FileList::~FileList() { innermost = outer_; }

void FileList::add(const fs::path& file, FileRole use) {
  if (innermost == nullptr) return;
  fs::path path = replaceable(file);
  if (path.empty()) return;
  const auto output = innermost->outputs_.find(path);
  // The output is not renamed into place, either, if the caller goes on.
  if (innermost->uses_.emplace(path, use).second) innermost->files_.push_back({file.string(), use});
  if (output != innermost->outputs_.end() && use != FileRole::folder) refuse(output->second, use);
}

void FileList::add_output(const fs::path& file) {
  if (innermost == nullptr) return;
  fs::path path = replaceable(file);
  if (path.empty()) return;
  const auto input = innermost->uses_.find(path);
  if (input != innermost->uses_.end() && input->second != FileRole::folder) refuse(file.string(), input->second);
  innermost->outputs_.emplace(std::move(path), file.string());
}

std::vector<ListedFile> FileList::files() {
  return innermost == nullptr ? std::vector<ListedFile>() : innermost->files_;
}

const char* to_string(FileRole use) {
  constexpr std::array words = {"read", "executed", "written", "folder"};
  return words[static_cast<std::size_t>(use)];
}

}  // namespace waitpoint
