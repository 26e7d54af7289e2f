// SPDX-License-Identifier: BSD-3-Clause
// The programs of `waitpoint exec`: one with its arguments, or several that share a process, each a shared object with
// a main():
//
//   FILE ARGUMENTS :: NAME=FILE ARGUMENTS :: ...
//
// A program is named after its file by default; equal default names are numbered. Programs are sorted by name, so that
// a run does not depend on the order in which they are given.
#pragma once

#include <string>
#include <vector>

#include "fibers/posix/program/record.hpp"

namespace waitpoint::tools {

class ProgramList {
 public:
  /// Parses the words, at least one. BadInput for an empty part between "::" and for duplicate names.
  explicit ProgramList(const std::vector<std::string>& words);

  /// True for a single program in a process of its own.
  bool is_one_program() const { return programs_.empty(); }
  /// The number of programs that share the process.
  std::uint32_t size() const { return static_cast<std::uint32_t>(programs_.size()); }
  /// A title for messages: the name of a single program, or the number of programs.
  const std::string& title() const { return title_; }
  /// The words of the process, starting with the name of the program or the host.
  const std::vector<std::string>& words() const { return words_; }
  /// The files of the programs that share the process.
  std::vector<std::string> files() const;
  /// Writes their names for the process; there must be room for all.
  void write(posix::Record& record) const;

 private:
  struct Program {
    std::string name;
    std::vector<std::string> words;
    std::uint32_t place = 0;  // among those given
    bool is_named = false;
  };
  void read_several(const std::vector<std::string>& words);
  void name_apart();

  std::vector<Program> programs_;
  std::vector<std::string> words_;
  std::string title_;
};

/// The exit status of each, in one line.
std::string ends_of_programs(const posix::Record& record);
/// The program that ran last; empty for a single one.
std::string program_of_last_turn(const posix::Record& record);

}  // namespace waitpoint::tools
