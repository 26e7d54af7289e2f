// SPDX-License-Identifier: BSD-3-Clause
// The files of one command: those that its input names, and its outputs.
//
// While a thread has a FileList, each reader calls add() where it opens a file that input names, or hands its name to a
// library or to the system; so the list is complete for what has been read. An output is renamed into place when it is
// complete, and would replace a file of the same name: one file is never both, in whichever order they are named.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace waitpoint {

enum class FileRole : unsigned char {
  read,
  executed,
  written,  ///< by a node or a script
  folder,   ///< whose files a script may read and write
};

struct ListedFile {
  std::string name;  ///< as it was first opened
  FileRole use;
};

class FileList {
 public:
  /// Replaces an outer list of this thread until its own end.
  FileList();
  ~FileList();
  FileList(const FileList&) = delete;
  FileList& operator=(const FileList&) = delete;

  /// Notes a file that input names, unless it is there already with that use. BadInput if it is an output.
  static void add(const std::filesystem::path& file, FileRole use);
  /// Notes an output; a pipe or a device is none. BadInput if input names the file.
  static void add_output(const std::filesystem::path& file);
  /// Of this thread: what add() has noted, in that order. Empty without a list.
  static std::vector<ListedFile> files();

 private:
  std::vector<ListedFile> files_;
  std::map<std::filesystem::path, FileRole> uses_;  // first ones, by canonical path
  std::map<std::filesystem::path, std::string> outputs_;
  FileList* outer_;
};

/// "read", "executed", "written", "folder".
const char* to_string(FileRole use);

}  // namespace waitpoint
