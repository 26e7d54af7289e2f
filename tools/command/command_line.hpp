// SPDX-License-Identifier: BSD-3-Clause
// The command line of a program with commands: "waitpoint COMMAND [OPTIONS] ARGUMENT".
//
// Only command_line.cpp instantiates CLI11's templates, which are costly to compile.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/command/program.hpp"

namespace waitpoint::tools {

class CommandLine {
 public:
  /// `program` is its name in texts; `version` has its name in the first line.
  CommandLine(std::string program, const std::string& description, std::string version, std::string (*version_json)());

  /// To be declared, before parse().
  DeclaredProgram& program() { return program_; }
  const DeclaredProgram& program() const { return program_; }
  /// The name of a command in the last version.
  void former_command(std::string former, std::string name) {
    former_.emplace_back(std::move(former), std::move(name));
  }

  /// Stores the values of the command that is given. Former spellings are replaced, each with a line on standard error.
  /// Throws BadInput, one line, for an unknown or missing word and for what Command::take() rejects.
  void parse(int argc, const char* const* argv);
  // After parse(): the text of --help or --version; else the command.
  const std::optional<std::string>& text() const { return text_; }
  const Command* given() const { return given_; }

 private:
  std::optional<std::string> own_text(const std::vector<std::string>& words) const;

  DeclaredProgram program_;
  std::string (*version_json_)();
  std::vector<std::pair<std::string, std::string>> former_;
  std::optional<std::string> text_;
  Command* given_ = nullptr;
};

}  // namespace waitpoint::tools
