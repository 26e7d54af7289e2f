// SPDX-License-Identifier: BSD-3-Clause
// A file that is either written whole or not at all.
//
// It is opened before the run starts, so that a name that cannot be written is told at once. What is written goes to a
// temporary file beside it, which takes the name on commit(); without commit() nothing is left and what was there
// stays. A name that is no regular file (/dev/null, a pipe) is written directly.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace waitpoint::tools {

class OutputFile {
 public:
  /// Throws BadInput if the file cannot be written.
  explicit OutputFile(const std::filesystem::path& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  OutputFile(OutputFile&&) = default;

  const std::filesystem::path& path() const { return path_; }
  /// The file that takes the name on commit(), for a library that opens files by name.
  const std::filesystem::path& written_to() const { return temporary_.empty() ? path_ : temporary_; }
  /// Appends. Throws BadInput if the medium is full.
  void write(std::string_view text);
  /// Gives the file its name; nothing can be written afterwards. Throws BadInput if that fails.
  void commit();

 private:
  struct Close {
    void operator()(std::FILE* stream) const { std::fclose(stream); }
  };
  [[noreturn]] void fail() const;

  std::filesystem::path path_;  ///< as asked for
  std::filesystem::path target_, temporary_;
  std::unique_ptr<std::FILE, Close> stream_;
};

/// Throws BadInput if anything printed so far could not be written.
void flush_standard_output();

}  // namespace waitpoint::tools
