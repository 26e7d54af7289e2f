// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/manual_page.hpp"

#include <algorithm>
#include <sstream>
#include <string_view>

#include "core/error.hpp"

namespace waitpoint::tools {
namespace {

/// Text that roff shows as it is: its hyphens and quotation marks can be copied into a shell.
std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '\\': result += "\\(rs"; break;
      case '-': result += "\\-"; break;
      case '\'': result += "\\(aq"; break;
      case '`': result += "\\(ga"; break;
      case '^': result += "\\(ha"; break;
      case '~': result += "\\(ti"; break;
      default: result += c;
    }
  }
  return result.starts_with('.') ? "\\&" + result : result;
}

std::string bold(std::string_view text) { return "\\fB" + escaped(text) + "\\fR"; }
std::string italic(std::string_view text) { return "\\fI" + escaped(text) + "\\fR"; }

/// Lines that are indented keep their breaks; all others are filled.
std::string paragraphs(const std::string& text) {
  std::istringstream lines(text);
  std::string result;
  bool is_kept = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("  ") != is_kept) result += is_kept ? ".fi\n" : ".nf\n";
    is_kept = line.starts_with("  ");
    result += escaped(line) + "\n";
  }
  return is_kept ? result + ".fi\n" : result;
}

std::string option_text(const DescribedOption& option) {
  std::string text = ".TP\n";
  for (const std::string& name : option.names) text += (&name == &option.names.front() ? "" : ", ") + bold(name);
  if (!option.type.empty())
    text += option.may_lack_value ? " [" + italic(option.type) + "]" : " " + italic(option.type);
  if (option.repeated) text += " ...";
  return text + "\n" + paragraphs(option.description);
}

std::string synopsis(const DescribedProgram& program, const DescribedCommand& command) {
  const bool is_own = command.name.empty();
  std::string text = bold(is_own ? program.name : program.name + " " + command.name) + " [" + italic("OPTIONS") + "]";
  if (is_own) text += " [" + italic("COMMAND") + " ...]";
  for (const DescribedOption& argument : command.arguments) {
    const std::string name = italic(argument.names.front());
    text += argument.required ? " " + name : " [" + name + "]";
  }
  if (command.takes_program) text += " " + bold("--") + " " + italic("PROGRAM") + " [" + italic("ARGUMENTS") + " ...]";
  return text + "\n";
}

const DescribedCommand& described(const DescribedProgram& program, const std::string& name) {
  if (name.empty()) return program.own;
  const auto found = std::ranges::find(program.commands, name, &DescribedCommand::name);
  if (found == program.commands.end())
    throw BadInput("manual", "expected a command of " + program.name + ", found '" + name + "'; --help lists them");
  return *found;
}

std::string commands_text(const DescribedProgram& program) {
  std::string text = ".SH COMMANDS\n";
  for (const DescribedCommand& command : program.commands)
    text +=
        ".TP\n" + bold(program.name + "-" + command.name) + "(1)\n" + escaped(summary_of(command.description)) + "\n";
  return text;
}

}  // namespace

Command add_manual(CommandLine& line, std::string& page) {
  Command manual = line.add_command("manual", "Prints the man page of a command, or of the program, in roff.");
  manual.argument("COMMAND", page, "the command (default: the program)", Command::Presence::optional);
  return manual;
}

std::string manual_page(const DescribedProgram& program, const std::string& command) {
  const DescribedCommand& page = described(program, command);
  const std::string name = command.empty() ? program.name : program.name + "-" + command;
  std::string title = name;
  for (char& c : title) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  // Without a date: the same program gives the same page.
  std::string text = ".TH " + escaped(title) + " 1 \"\" \"" + escaped(program.version) + "\" \"\"\n.SH NAME\n" +
                     escaped(name) + " \\- " + escaped(summary_of(page.description)) + "\n.SH SYNOPSIS\n" +
                     synopsis(program, page) + ".SH DESCRIPTION\n" + paragraphs(page.description);
  if (command.empty()) text += commands_text(program);
  if (!page.arguments.empty()) text += ".SH ARGUMENTS\n";
  for (const DescribedOption& argument : page.arguments) text += option_text(argument);
  text += ".SH OPTIONS\n";
  for (const DescribedOption& option : page.options) text += option_text(option);
  if (!page.footer.empty()) text += ".SH NOTES\n" + paragraphs(page.footer);
  if (!command.empty()) text += ".SH SEE ALSO\n" + bold(program.name) + "(1)\n";
  return text;
}

}  // namespace waitpoint::tools
