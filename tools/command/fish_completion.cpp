// SPDX-License-Identifier: BSD-3-Clause
#include <string_view>

#include "tools/command/completion.hpp"
#include "tools/command/help_text.hpp"

namespace waitpoint::tools {
namespace {

std::string fish_quoted(std::string_view text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') result += '\\';
    result += c;
  }
  return result + "'";
}

/// The arguments of `complete` for values.
std::string fish_values(const Option& option) {
  const OfferedValues offered = offered_values(option);
  std::string words;
  for (const std::string& word : offered.words) words += (words.empty() ? "" : " ") + word;
  std::string text = words.empty() ? "" : " -a " + fish_quoted(words);
  if (offered.commands) text += " -a '(__waitpoint_commands)'";
  switch (offered.files) {
    case OfferedValues::Files::all: text += " -F"; break;
    case OfferedValues::Files::folders: text += " -a '(__fish_complete_directories)'"; break;
    case OfferedValues::Files::scenarios: text += " -a '(__waitpoint_scenarios)'"; break;
    case OfferedValues::Files::none: break;
  }
  return text;
}

std::string fish_lines(const std::string& beginning, const Command& command) {
  std::string text;
  for (const auto& options : {help_options(), command.options})
    for (const Option& option : options) {
      text += beginning + (option.name == "--help" ? " -s h" : "") + " -l " + option.name.substr(2);
      if (!option.value.is_flag) {
        const bool is_file = offered_values(option).files == OfferedValues::Files::all;
        text += (option.value.omitted.empty() ? is_file ? " -r" : " -x" : "") + fish_values(option);
      }
      text += " -d " + fish_quoted(option.summary()) + "\n";
    }
  for (const Option& argument : command.arguments)
    if (const std::string values = fish_values(argument); !values.empty()) text += beginning + values + "\n";
  return text;
}

constexpr const char* functions = R"(
end

function __waitpoint_scenarios
  set -l word (commandline -ct)
  for file in $word*.yaml
    echo $file
  end
  __fish_complete_directories $word
  set -l program (command -s waitpoint); or return
  for shipped in (dirname $program)/../share/waitpoint/scenarios/*.yaml
    basename $shipped
  end
end

# The command is the first word; behind "--" is a program with its arguments.
function __waitpoint_has
  set -l words (commandline -opc)
  test (count $words) -ge 2; and test $words[2] = $argv[1]; and not contains -- -- $words
end

function __waitpoint_has_program
  contains -- -- (commandline -opc)
end

function __waitpoint_program
  set -l words (commandline -opc)
  set -l dashes (contains -i -- -- $words)
  complete -C (string join ' ' -- (string escape -- $words[(math $dashes + 1)..]) (commandline -ct))
end

complete -c waitpoint -f
complete -c waitpoint -n __waitpoint_has_program -a '(__waitpoint_program)'
)";

}  // namespace

std::string fish_completion(const DeclaredProgram& program) {
  std::string text =
      "# Completion of waitpoint for fish; written by `waitpoint completion fish`.\n"
      "function __waitpoint_commands\n  printf '%s\\n'";
  for (const auto& command : program.commands) text += " " + command->name;
  text += functions + fish_lines("complete -c waitpoint -n __fish_use_subcommand", program.own);
  for (const auto& command : program.commands) {
    text += "complete -c waitpoint -n __fish_use_subcommand -a " + command->name + " -d " +
            fish_quoted(command->description) + "\n";
    text += fish_lines("complete -c waitpoint -n '__waitpoint_has " + command->name + "'", *command);
  }
  return text;
}

}  // namespace waitpoint::tools
