// SPDX-License-Identifier: BSD-3-Clause
// The programs of `waitpoint exec`: one with its arguments, or a session of several, each a process of its own:
//
//   FILE ARGUMENTS :: after:CONDITION NAME=FILE ARGUMENTS :: ...
//
// A program is named after its file by default; equal default names are numbered. Programs are sorted by name, so that
// a run does not depend on the order in which they are given. Conditions: see core/hosting/start_condition.hpp.
#pragma once

#include <string>
#include <vector>

namespace waitpoint::tools {

class ProgramList {
 public:
  struct Program {
    std::string name;
    std::vector<std::string> conditions;
    std::vector<std::string> words;  ///< the file, and its arguments
    int place = 0;                   ///< among those given
    bool is_named = false;
  };

  /// Parses the words, at least one. BadInput for an empty part between "::", duplicate names, and conditions that
  /// cannot become true.
  explicit ProgramList(const std::vector<std::string>& words);

  bool is_session() const { return is_session_; }
  const std::vector<Program>& programs() const { return programs_; }
  /// A title for messages: the name of a single program, or the number of programs.
  std::string title() const;
  /// The arguments of waitpoint-session. `loader` runs the programs that are shared objects.
  std::vector<std::string> words_of_session(const std::string& loader, bool quiet) const;

 private:
  void read(const std::vector<std::string>& words);
  void name_apart();
  void check_conditions() const;

  bool is_session_ = false;
  std::vector<Program> programs_;
};

}  // namespace waitpoint::tools
