// SPDX-License-Identifier: BSD-3-Clause
#include "tools/nodes/log_folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

#include "core/error.hpp"

namespace waitpoint::tools {

LogFolder::LogFolder() : maker_(getpid()) {
  std::string name = (std::filesystem::temp_directory_path() / "waitpoint-ros-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw BadInput(name, std::string("cannot be made: ") + std::strerror(errno));
  path_ = name;
}

LogFolder::LogFolder(const LogFolder& around)
    : path_(around.path_ / fmt::format("{:010}", static_cast<int>(getpid()))), maker_(getpid()) {
  std::error_code error;
  std::filesystem::create_directory(path_, error);
  if (error) throw BadInput(path_.string(), "cannot be made: " + error.message());
}

LogFolder::~LogFolder() {
  if (getpid() != maker_) return;
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

void LogFolder::use() const {
  for (const char* const variable : {"ROS_HOME", "ROS_LOG_DIR"}) setenv(variable, path_.c_str(), 1);
}

void LogFolder::clear() const {
  std::error_code ignored;
  for (const std::filesystem::directory_entry& entry : std::filesystem::directory_iterator(path_, ignored))
    std::filesystem::remove_all(entry.path(), ignored);
}

}  // namespace waitpoint::tools
