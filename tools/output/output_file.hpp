// SPDX-License-Identifier: BSD-3-Clause
// A file that is written completely or not at all, unless it is to be shown before.
//
// Opened before the run starts, so that an unwritable name is reported at once. Data goes to a temporary file beside
// it, FILE.waitpoint-PROCESS-NUMBER, which commit() renames; without commit() the temporary file is removed and the old
// file stays. Its writer holds a lock on it: temporary files of FILE without one are leftovers of processes that were
// killed, which the next writer removes. A name of a special file (/dev/null, a pipe) is written directly; "-" is
// standard output.
//
// A file that input names is refused, at the opening and, if it is read later, at the renaming (core/file_list.hpp).
//
// A file belongs to the process that made it. In a forked copy, such as the child of a task's fork(), nothing is
// written, renamed or removed, unless the copy has taken the files over.
//
// Every error of the system is reported, also one of the closing; a write that a signal interrupts, or that takes only
// a part of the data, is continued. Errors of writing are reported by commit(): files are written by the kernel's
// watches, through which no exception may pass, and in a forked copy of a dying process.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace waitpoint::tools {

class OutputFile {
 public:
  /// In a forked copy: from now on it writes all its files in place of the process that made them, which is dying.
  static void take_over();

  /// Throws BadInput if the file cannot be written.
  explicit OutputFile(const std::filesystem::path& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  OutputFile(OutputFile&& other) noexcept;

  /// The file that commit() renames, for a library that opens files by name.
  const std::filesystem::path& written_to() const { return temporary_.empty() ? target_ : temporary_; }
  /// Appends.
  void write(std::string_view text);
  /// Hands over to the system the text written so far, as write() does with larger parts.
  void flush();
  /// Renames the file already now, with the text written so far: others can read it while it grows, and it stays if
  /// this process is killed. Throws BadInput if it cannot be written.
  void show();
  /// Renames the file; nothing can be written afterwards. Throws BadInput if it could not be written, also earlier.
  void commit();

 private:
  void open_temporary();
  bool rename_temporary();
  bool is_own() const;
  [[noreturn]] void fail() const;

  std::string name_;  ///< as requested, for messages
  std::filesystem::path target_;
  std::filesystem::path temporary_;  ///< empty for a special file, and once it has its name
  std::string buffer_;
  pid_t process_;        ///< that made the file
  int descriptor_ = -1;  ///< -1: committed
  int error_ = 0;        ///< the first error of writing
};

/// True for the names that OutputFile takes for standard output.
bool is_standard_output(const std::filesystem::path& path);

/// Writes the text to standard output, after earlier output of stdio. Throws BadInput if it cannot be written.
void write_standard_output(std::string_view text);

/// Throws BadInput if earlier output of stdio could not be written.
void flush_standard_output();

}  // namespace waitpoint::tools
