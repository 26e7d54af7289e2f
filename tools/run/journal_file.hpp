// SPDX-License-Identifier: BSD-3-Clause
// Writes the journal line by line as the run proceeds, so that its temporary file survives even SIGKILL.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "tools/output/output_file.hpp"

namespace waitpoint::tools {

class JournalFile {
 public:
  /// Throws BadInput if the file cannot be written.
  explicit JournalFile(const std::filesystem::path& path) : file_(path) {}

  /// Appends lines.
  void write(std::string_view lines);
  /// Names the file; nothing can be written afterwards. Throws BadInput if it could not be written, also earlier.
  void commit() { file_.commit(); }
  /// The same with a comment as last line: the run did not end, for `reason`.
  void cut_off(const std::string& reason);

 private:
  OutputFile file_;
};

}  // namespace waitpoint::tools
