// SPDX-License-Identifier: BSD-3-Clause
// A folder of this process for inputs that are read by their file's name; removed at the end.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace waitpoint::fuzz {

class InputFolder {
 public:
  InputFolder() : path_(std::filesystem::temp_directory_path() / ("waitpoint-fuzz-" + std::to_string(getpid()))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_ / "inputs");
  }
  /// With the corpora beside it: an input that is in a corpus finds the others from here, too.
  explicit InputFolder(const std::filesystem::path& corpora) : InputFolder() {
    for (const std::filesystem::directory_entry& corpus : std::filesystem::directory_iterator(corpora))
      std::filesystem::create_directory_symlink(corpus.path(), path_ / corpus.path().filename());
  }
  ~InputFolder() {
    std::error_code none;
    std::filesystem::remove_all(path_, none);
  }
  InputFolder(const InputFolder&) = delete;
  InputFolder& operator=(const InputFolder&) = delete;

  std::filesystem::path file(const std::string& name, const std::string& contents) const {
    std::ofstream(path_ / "inputs" / name, std::ios::binary) << contents;
    return path_ / "inputs" / name;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace waitpoint::fuzz
