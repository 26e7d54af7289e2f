// SPDX-License-Identifier: BSD-3-Clause
// Writes the journal line by line as the run proceeds, so that it survives a crash.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

namespace waitpoint::tools {

class JournalFile {
 public:
  /// Throws BadInput if the file cannot be written.
  explicit JournalFile(const std::filesystem::path& path);

  /// Appends lines and flushes. Throws BadInput if the medium is full.
  void write(std::string_view lines);

 private:
  struct Close {
    void operator()(std::FILE* stream) const { std::fclose(stream); }
  };
  [[noreturn]] void fail() const;

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, Close> stream_;
};

}  // namespace waitpoint::tools
