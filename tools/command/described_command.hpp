// SPDX-License-Identifier: BSD-3-Clause
// A command and its options as values: what --help, the man pages and the completion of shells have in common.
#pragma once

#include <string>
#include <vector>

namespace waitpoint::tools {

struct DescribedOption {
  std::vector<std::string> names;  ///< with their dashes: "-h", "--help"; of an argument its name alone
  std::string type;                ///< what stands for the value; alternatives are joined by '|'; empty: a flag
  std::string description;
  bool required = false;
  bool repeated = false;
  bool may_lack_value = false;
};

/// Values that a shell can offer.
struct OfferedValues {
  enum class Files { none, all, folders, scenarios };
  std::vector<std::string> words;
  Files files = Files::none;
  bool commands = false;  ///< of waitpoint
};

/// By the option's type, or the argument's name: lower-case alternatives are words, up to what stands for a part
/// ("pct:D" is offered as "pct:"); FILE and FOLDER, with or without an ending, are files.
OfferedValues offered_values(const DescribedOption& option);

/// A description in one line: up to what is indented, without the point or colon that ends it.
std::string summary_of(const std::string& description);

struct DescribedCommand {
  std::string name;         ///< empty: the program's own options
  std::string description;  ///< the first line is a sentence; what is indented keeps its line breaks
  std::string footer;
  std::vector<DescribedOption> arguments, options;
  bool takes_program = false;  ///< behind "--"
};

struct DescribedProgram {
  std::string name;
  std::string version;  ///< one line, with the name
  DescribedCommand own;
  std::vector<DescribedCommand> commands;
};

}  // namespace waitpoint::tools
