// SPDX-License-Identifier: BSD-3-Clause
#include "core/confinement.hpp"

#include <algorithm>
#include <utility>

#include "core/error.hpp"

namespace waitpoint {
namespace {

namespace fs = std::filesystem;

constinit thread_local const Confinement* innermost = nullptr;

bool is_below(const fs::path& folder, const fs::path& file) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

}  // namespace

Confinement::Confinement(std::span<const fs::path> folders) {
  for (const fs::path& folder : folders) {
    std::error_code error;
    folders_.push_back(fs::canonical(folder.empty() ? "." : folder, error));
    if (error || !fs::is_directory(folders_.back(), error))
      throw BadInput("--confined", "there is no folder '" + folder.string() + "'");
  }
  outer_ = std::exchange(innermost, this);
}

Confinement::~Confinement() { innermost = outer_; }

bool Confinement::exists() { return innermost != nullptr; }

bool Confinement::allows(const fs::path& file) {
  if (innermost == nullptr) return true;
  std::error_code error;
  const fs::path followed = fs::weakly_canonical(file, error);
  const auto is_parent = [&](const fs::path& folder) { return is_below(folder, followed); };
  return !error && std::any_of(innermost->folders_.begin(), innermost->folders_.end(), is_parent);
}

void Confinement::require_allowed(const fs::path& file) {
  if (!allows(file)) throw BadInput(file.string(), "lies outside of the folders that --confined allows");
}

}  // namespace waitpoint
