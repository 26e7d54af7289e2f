// SPDX-License-Identifier: BSD-3-Clause
#include "tools/check/system_threads.hpp"

#include <filesystem>
#include <fstream>

#include "core/number_text.hpp"

namespace waitpoint::tools {
namespace {

std::map<int, std::string> threads() {
  std::map<int, std::string> result;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/task", error)) {
    std::uint64_t id = 0;
    if (!parse_number(entry.path().filename().string(), id)) continue;
    std::ifstream file(entry.path() / "comm");
    std::getline(file, result[static_cast<int>(id)]);
  }
  return result;
}

}  // namespace

SystemThreads::SystemThreads() : earlier_(threads()) {}

void SystemThreads::look() {
  for (const auto& [id, name] : threads())
    if (!earlier_.contains(id)) came_.insert("'" + name + "'");
}

std::vector<std::string> SystemThreads::found() const { return {came_.begin(), came_.end()}; }

}  // namespace waitpoint::tools
