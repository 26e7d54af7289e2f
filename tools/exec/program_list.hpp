// SPDX-License-Identifier: BSD-3-Clause
// What `waitpoint exec` is to run: a program with its arguments; or several that share one process, each a shared
// object with a main():
//
//   FILE ARGUMENTS :: NAME=FILE ARGUMENTS :: ...
//
// A program's name is that of its file, if none is given; those that would have one name are numbered. Programs are put
// in the order of their names, so that a run does not depend on the order in which they are written.
#pragma once

#include <string>
#include <vector>

#include "fibers/posix/program/record.hpp"

namespace waitpoint::tools {

class ProgramList {
 public:
  /// Of these words, of which there is at least one. BadInput for an empty part between "::", and for names that are
  /// given twice.
  explicit ProgramList(const std::vector<std::string>& words);

  /// Whether it is one program in a process of its own.
  bool is_one_program() const { return programs_.empty(); }
  /// How many share the process.
  std::uint32_t size() const { return static_cast<std::uint32_t>(programs_.size()); }
  /// What is to be told of them: the name of one, or how many they are.
  const std::string& title() const { return title_; }
  /// The words of the process, the program's name or that of the host first.
  const std::vector<std::string>& words() const { return words_; }
  /// Those that share the process: their files.
  std::vector<std::string> files() const;
  /// Tells the process who they are; there is room for all of them.
  void write(posix::Record& record) const;

 private:
  struct Program {
    std::string name;
    std::vector<std::string> words;
    std::uint32_t place = 0;  // among those that were written
    bool is_named = false;
  };
  void read_several(const std::vector<std::string>& words);
  void name_apart();

  std::vector<Program> programs_;
  std::vector<std::string> words_;
  std::string title_;
};

/// How they ended, each with its exit status: one line.
std::string ends_of_programs(const posix::Record& record);
/// The one whose turn it was last; empty where there are not several.
std::string program_of_last_turn(const posix::Record& record);

}  // namespace waitpoint::tools
