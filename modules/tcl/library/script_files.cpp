// SPDX-License-Identifier: BSD-3-Clause
#include "modules/tcl/library/script_files.hpp"

#include <algorithm>
#include <utility>

namespace waitpoint::tcl {
namespace {

namespace fs = std::filesystem;

bool is_below(const fs::path& folder, const fs::path& file) {
  return !folder.empty() && std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

// In the kernel's file systems, files that look regular have contents of the machine and the process.
bool is_kernels(const fs::path& file) {
  return is_below("/proc", file) || is_below("/sys", file) || is_below("/dev", file);
}

// Pipes and devices have contents of the moment.
bool is_ordinary(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  return !fs::exists(status) || fs::is_directory(status) || fs::is_regular_file(status);
}

fs::path canonical(const fs::path& folder) {
  std::error_code error;
  const fs::path found = fs::canonical(folder, error);
  return error ? fs::path() : found;
}

}  // namespace

ScriptFiles::ScriptFiles(const std::vector<std::string>& folders, const std::string& library, Take take)
    : library_(canonical(library)), take_(std::move(take)) {
  own_.reserve(folders.size());
  for (const std::string& folder : folders) own_.push_back(canonical(folder));
  if (!own_.empty()) folder_ = own_.front();
}

std::optional<std::string> ScriptFiles::find(const std::string& name, FileUse use) const {
  std::error_code error;
  const fs::path file = fs::weakly_canonical(folder_ / name, error);
  if (error || is_kernels(file) || !is_ordinary(file)) return std::nullopt;
  const bool is_own = std::any_of(own_.begin(), own_.end(), [&](const fs::path& own) { return is_below(own, file); });
  if (!is_own && (use == FileUse::write || !is_below(library_, file))) return std::nullopt;
  return file.string();
}

std::optional<std::string> ScriptFiles::take(const std::string& name, FileUse use) const {
  std::optional<std::string> file = find(name, use);
  if (file && !take_(*file, use)) file.reset();
  return file;
}

}  // namespace waitpoint::tcl
