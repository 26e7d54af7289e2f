// SPDX-License-Identifier: BSD-3-Clause
// The command line of a program with commands: "waitpoint COMMAND [OPTIONS] ARGUMENT".
//
// Values are kept as text; option_values.hpp parses numbers. Only command_line.cpp instantiates CLI11's templates,
// which are costly to compile.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/command/described_command.hpp"

namespace CLI {
class App;
}

namespace waitpoint::tools {

/// One command. CommandLine::parse() stores values in the variables passed here; they must not move before it. --help
/// prints descriptions verbatim, with their line breaks.
class Command {
 public:
  explicit Command(CLI::App& app) : app_(&app) {}

  enum class Presence { required, optional };
  /// The positional argument.
  void argument(const char* name, std::string& value, const char* description, Presence presence);
  /// "NAME VALUE"; --help shows `type` for the value. Alternatives are joined by '|': shells offer them
  /// (described_command.hpp).
  void option(const char* name, std::string& value, const char* type, const std::string& description);
  /// An option whose value may be left out: it is `usual` then.
  void option_or_flag(const char* name, std::string& value, const char* type, const std::string& usual,
                      const std::string& description);
  /// An option that may be given several times, with one value each.
  void repeated(const char* name, std::vector<std::string>& values, const char* type, const std::string& description);
  /// An option without a value.
  void flag(const char* name, bool& value, const std::string& description);
  /// --json, the flag of all commands whose result a machine may read.
  void json(bool& value);
  /// The command runs a program: what follows its options is for the program, and stands behind "--".
  void takes_program();
  /// The last lines of the command's --help.
  void footer(const std::string& text);

  /// True if this command was given; valid after CommandLine::parse().
  bool parsed() const;

 private:
  CLI::App* app_;
};

class CommandLine {
 public:
  CommandLine(const std::string& program, const std::string& description);
  ~CommandLine();

  Command add_command(const char* name, const char* description);
  /// Names of all commands, in the order of addition.
  std::vector<std::string> commands() const;
  /// Names, options and descriptions, for man pages and shells.
  DescribedProgram described() const;
  /// Adds --version with this text, and --json, with which it is what `json` returns.
  void version(const std::string& text, const char* description, std::string (*json)());
  /// The last lines of the program's own --help. Call it after adding the commands, which would inherit it.
  void footer(const std::string& text);

  /// Parses the arguments. Returns the text to show for --help or --version. Throws BadInput, one line, for an unknown
  /// or missing word, an empty value, or the value of a flag.
  std::optional<std::string> parse(int argc, const char* const* argv);

 private:
  std::unique_ptr<CLI::App> app_;
  std::string (*version_as_json_)() = nullptr;
};

}  // namespace waitpoint::tools
