// SPDX-License-Identifier: BSD-3-Clause
// An option as one declaration: from it come the parser, --help, the man pages and the completion of shells.
//
//   command.add("--jobs", whole(jobs, 1, 1024), "runs at once, each in a process of its own", {.usual = "1"});
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace waitpoint::tools {

/// The kind of an option's values, and the variable that they go to: option_values.hpp has the kinds.
struct OptionValue {
  enum class File { none, written, read };

  std::string placeholder = {};         ///< in help; alternatives are joined by '|'; empty: a flag, or an argument
  std::vector<std::string> words = {};  ///< fixed alternatives, for shells
  bool is_flag = false;
  bool is_repeated = false;  ///< may be given several times
  std::string omitted = {};  ///< the value of an option without one; empty: it needs one
  File file = File::none;
  /// Stores a text. Throws BadInput, naming the source: the option or its environment variable.
  std::function<void(const std::string& source, const std::string& text)> take = {};
  /// The files that an option names, where these differ from its text.
  std::function<std::vector<std::string>(const std::string& text)> files = {};
};

/// What most options do without.
struct OptionDetails {
  std::string usual = {};             ///< the default, in words
  const char* environment = nullptr;  ///< the variable that stands for the option where it is not given
  std::string more = {};              ///< further lines of --help-all and the man page
  bool is_rare = false;               ///< --help names it, --help-all explains it
  bool is_required = false;           ///< of an argument
  const char* former = nullptr;       ///< the spelling of the last version
  std::vector<std::pair<std::string, std::string>> former_values = {};  ///< each with today's
};

struct Option {
  std::string name;  ///< "--seed"; of an argument "SCENARIO"
  OptionValue value;
  std::string description;  ///< one line
  OptionDetails details;
  std::string section;  ///< of the help

  bool is_argument() const { return !name.starts_with('-'); }
  /// With its value: "--seed N", "--serve [ADDRESS:PORT]".
  std::string label() const;
  /// With its default: "threads (default: 1)".
  std::string brief() const;
  /// The environment's variable, too: "threads (default: $WAITPOINT_THREADS, or 1)".
  std::string summary() const;
};

/// Values that a shell can offer.
struct OfferedValues {
  enum class Files { none, all, folders, scenarios };
  std::vector<std::string> words;
  Files files = Files::none;
  bool commands = false;  ///< of the program
};

/// By the option's words, and its placeholder or the argument's name: lower-case alternatives are words, up to what
/// stands for a part ("pct:D" is offered as "pct:"); FILE and FOLDER, with or without an ending, are files.
OfferedValues offered_values(const Option& option);

}  // namespace waitpoint::tools
