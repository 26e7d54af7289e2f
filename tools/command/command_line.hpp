// SPDX-License-Identifier: BSD-3-Clause
// The command line of a program with commands: "waitpoint COMMAND [OPTIONS] ARGUMENT".
//
// Every value is kept as the text that was given; option_values.hpp reads numbers. CLI11's templates are costly to
// compile and are instantiated here only.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace waitpoint::tools {

/// One command. The variables given to it receive the values in CommandLine::parse(), and must not move before that.
/// Descriptions are shown by --help as they are, with their line breaks.
class Command {
 public:
  explicit Command(CLI::App& app) : app_(&app) {}

  enum class Presence { required, optional };
  /// The positional argument.
  void argument(const char* name, std::string& value, const char* description, Presence presence);
  /// "NAME VALUE"; --help shows `type` in the place of the value.
  void option(const char* name, std::string& value, const char* type, const std::string& description);
  /// An option that may be given several times, with one value each.
  void repeated(const char* name, std::vector<std::string>& values, const char* type, const std::string& description);
  /// An option without a value.
  void flag(const char* name, bool& value, const std::string& description);
  /// The last lines of its --help.
  void footer(const std::string& text);

  /// Whether it is the command of the command line; known after CommandLine::parse().
  bool parsed() const;

 private:
  CLI::App* app_;
};

class CommandLine {
 public:
  CommandLine(const std::string& program, const std::string& description);
  ~CommandLine();

  Command add_command(const char* name, const char* description);
  /// The names of all commands, in the order in which they were added.
  std::vector<std::string> commands() const;
  /// Adds --version with this text.
  void version(const std::string& text, const char* description);
  /// The last lines of the program's own --help. To be called after the commands are added: they would inherit it.
  void footer(const std::string& text);

  /// Reads the arguments. Returns the text to be shown if they ask for --help or --version. Throws BadInput, one clear
  /// line, for an unknown word, a missing one, or an empty value.
  std::optional<std::string> parse(int argc, const char* const* argv);

 private:
  std::unique_ptr<CLI::App> app_;
};

}  // namespace waitpoint::tools
