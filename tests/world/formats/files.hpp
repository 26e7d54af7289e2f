// SPDX-License-Identifier: BSD-3-Clause
// Small files for tests of loaders.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "core/error.hpp"

namespace waitpoint::world {

/// A folder of the running test, removed at its end.
class Folder {
 public:
  Folder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::path(testing::TempDir()) /
            (std::string("waitpoint-") + test->test_suite_name() + "-" + test->name());
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string path(const std::string& name) const { return (path_ / name).string(); }
  /// Writes a file; returns its path.
  std::string write(const std::string& name, const std::string& contents) const {
    std::ofstream(path(name), std::ios::binary) << contents;
    return path(name);
  }

 private:
  std::filesystem::path path_;
};

/// True if `read` throws a BadInput of one line that starts with `where` and contains `what`.
inline testing::AssertionResult complains(const std::function<void()>& read, const std::string& where,
                                          const std::string& what) {
  try {
    read();
  } catch (const BadInput& bad) {
    const std::string line = bad.what();
    if (line.starts_with(where) && line.find(what) != std::string::npos && line.find('\n') == std::string::npos) {
      return testing::AssertionSuccess();
    }
    return testing::AssertionFailure() << "it says '" << line << "', not '" << where << "... " << what << "'";
  }
  return testing::AssertionFailure() << "no BadInput";
}

}  // namespace waitpoint::world
