// SPDX-License-Identifier: BSD-3-Clause
// A file that is written completely or not at all.
//
// Opened before the run starts, so that an unwritable name is reported at once. Data goes to a temporary file beside
// it, FILE.waitpoint-XXXXXX, which commit() renames; without commit() the temporary file is removed and the old file
// stays. Its writer holds a lock on it: temporary files of FILE without one are leftovers of processes that were
// killed, which the next writer removes. A name of a special file (/dev/null, a pipe) is written directly; "-" is
// standard output.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace waitpoint::tools {

class OutputFile {
 public:
  /// Throws BadInput if the file cannot be written.
  explicit OutputFile(const std::filesystem::path& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  OutputFile(OutputFile&& other) noexcept
      : path_(std::move(other.path_)),
        target_(std::move(other.target_)),
        temporary_(std::exchange(other.temporary_, {})),
        stream_(std::move(other.stream_)) {}

  const std::filesystem::path& path() const { return path_; }
  /// The file that commit() renames, for a library that opens files by name.
  const std::filesystem::path& written_to() const { return temporary_.empty() ? path_ : temporary_; }
  /// Appends. Throws BadInput if the medium is full.
  void write(std::string_view text);
  /// Renames the file; nothing can be written afterwards. Throws BadInput on failure.
  void commit();

 private:
  struct Close {
    void operator()(std::FILE* stream) const { std::fclose(stream); }
  };
  [[noreturn]] void fail() const;

  std::filesystem::path path_;  ///< as requested
  std::filesystem::path target_;
  std::filesystem::path temporary_;  ///< empty for a special file, and once it has its name
  std::unique_ptr<std::FILE, Close> stream_;
};

/// Throws BadInput if earlier output could not be written.
void flush_standard_output();

}  // namespace waitpoint::tools
