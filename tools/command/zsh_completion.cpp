// SPDX-License-Identifier: BSD-3-Clause
#include <string_view>

#include "tools/command/completion.hpp"
#include "tools/command/help_text.hpp"
#include "tools/command/shell_words.hpp"

namespace waitpoint::tools {
namespace {

/// Text inside of a specification of _arguments or _describe.
std::string zsh_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

std::string zsh_action(const Option& option) {
  const OfferedValues offered = offered_values(option);
  if (offered.commands) return "_waitpoint_commands";
  switch (offered.files) {
    case OfferedValues::Files::all: return "_files";
    case OfferedValues::Files::folders: return "_files -/";
    case OfferedValues::Files::scenarios: return "_waitpoint_scenarios";
    case OfferedValues::Files::none: break;
  }
  std::string words;
  for (const std::string& word : offered.words) words += (words.empty() ? "" : " ") + zsh_text(word);
  return words.empty() ? " " : "(" + words + ")";
}

/// The arguments of _arguments for one command, each on a line of its own.
std::string specifications(const Command& command) {
  std::string text;
  const auto add = [&](const Option& option, const std::string& name) {
    const OptionValue& value = option.value;
    std::string word = (value.is_repeated ? "*" : "") + name + (value.is_flag ? "" : "=");
    word += "[" + zsh_text(option.summary()) + "]";
    if (!value.is_flag)
      word += (value.omitted.empty() ? ":" : "::") + zsh_text(value.placeholder) + ":" + zsh_action(option);
    text += " \\\n        " + in_quotation_marks(word);
  };
  for (const auto& options : {help_options(), command.options})
    for (const Option& option : options) {
      if (option.name == "--help") add(option, "-h");
      add(option, option.name);
    }
  for (const Option& argument : command.arguments)
    text += " \\\n        " + in_quotation_marks(std::string(argument.details.is_required ? ":" : "::") +
                                                 zsh_text(argument.name) + ":" + zsh_action(argument));
  return text + "\n";
}

}  // namespace

std::string zsh_completion(const DeclaredProgram& program) {
  std::string text =
      "#compdef waitpoint\n# Written by `waitpoint completion zsh`.\n\n_waitpoint_commands() {\n"
      "  local -a commands=(\n";
  for (const auto& command : program.commands)
    text += "    " + in_quotation_marks(command->name + ":" + zsh_text(command->description)) + "\n";
  text += R"(  )
  _describe command commands
}

_waitpoint_scenarios() {
  local -a shipped=(${commands[waitpoint]:h}/../share/waitpoint/scenarios/*.yaml(N:t))
  _files -g '*.yaml'
  compadd -a shipped
}

_waitpoint() {
  local state
  _arguments -C ':command:->command' '*::argument:->argument')";
  text += specifications(program.own);
  text += R"(  case $state in
  command) _waitpoint_commands ;;
  argument)
    # Behind "--" is a program with its arguments.
    local -i dashes=${words[(i)--]}
    if ((dashes < CURRENT)); then
      shift $dashes words
      ((CURRENT -= dashes))
      _normal
      return
    fi
    case $words[1] in
)";
  for (const auto& command : program.commands)
    text += "    " + command->name + ")\n      _arguments" + specifications(*command) + "      ;;\n";
  return text + "    esac\n    ;;\n  esac\n}\n\n_waitpoint \"$@\"\n";
}

}  // namespace waitpoint::tools
