// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/manual_page.hpp"

#include <sstream>
#include <string_view>

#include "core/error.hpp"
#include "tools/command/help_text.hpp"
#include "tools/command/option_values.hpp"

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

std::string option_text(const Option& option) {
  std::string text = ".TP\n" + std::string(option.name == "--help" ? bold("-h") + ", " : "") + bold(option.name);
  const std::string& placeholder = option.value.placeholder;
  if (!option.is_argument() && !option.value.is_flag)
    text += option.value.omitted.empty() ? " " + italic(placeholder) : " [" + italic(placeholder) + "]";
  if (option.value.is_repeated) text += " ...";
  const std::string& more = option.details.more;
  return text + "\n" + paragraphs(option.summary() + (more.empty() ? "" : "\n" + more));
}

std::string options_text(const Command& command) {
  std::string text = ".SH OPTIONS\n";
  for (const std::vector<const Option*>& section : sections_of(command)) {
    if (!section.front()->section.empty()) text += ".SS " + escaped(section.front()->section) + "\n";
    for (const Option* option : section) text += option_text(*option);
  }
  text += ".SS Help\n";
  for (const Option& option : help_options()) text += option_text(option);
  return text;
}

std::string synopsis(const DeclaredProgram& program, const Command& command) {
  if (command.name.empty())
    return bold(program.name) + " [" + italic("OPTIONS") + "] [" + italic("COMMAND") + " ...]\n";
  std::string text;
  for (const std::string& usage : usages_of(command))
    text += (text.empty() ? "" : ".br\n") + bold(program.name + " " + command.name) + " " + escaped(usage) + "\n";
  return text;
}

const Command& named(const DeclaredProgram& program, const std::string& name) {
  if (name.empty()) return program.own;
  if (const Command* const command = program.find(name)) return *command;
  throw BadInput("manual", "expected a command of " + program.name + ", found '" + name + "'; --help lists them");
}

std::string commands_text(const DeclaredProgram& program) {
  std::string text = ".SH COMMANDS\n";
  for (const auto& command : program.commands)
    text += ".TP\n" + bold(program.name + "-" + command->name) + "(1)\n" + escaped(command->description) + "\n";
  return text;
}

std::string examples_text(const DeclaredProgram& program, const Command& command) {
  if (command.examples.empty()) return "";
  const std::string own = program.name + " " + command.name + (command.name.empty() ? "" : " ");
  std::string text = ".SH EXAMPLES\n.nf\n";
  for (const std::string& example : command.examples) text += escaped(own + example) + "\n";
  return text + ".fi\n";
}

}  // namespace

void add_manual(DeclaredProgram& program, std::string& page) {
  Command& manual = program.add("manual");
  manual.description = "Prints the man page of a command, or of the program, in roff.";
  manual.examples = {"run | man -l -"};
  manual.add("COMMAND", text(page, ""), "the command", {.usual = "the program"});
}

std::string manual_page(const DeclaredProgram& program, const std::string& command) {
  const Command& page = named(program, command);
  const std::string name = command.empty() ? program.name : program.name + "-" + command;
  std::string title = name;
  for (char& c : title) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  std::string summary = page.description.substr(0, page.description.find('\n'));
  if (summary.ends_with('.')) summary.pop_back();
  // Without a date: the same program gives the same page.
  std::string text = ".TH " + escaped(title) + " 1 \"\" \"" + escaped(program.version_line()) + "\" \"\"\n.SH NAME\n" +
                     escaped(name) + " \\- " + escaped(summary) + "\n.SH SYNOPSIS\n" + synopsis(program, page) +
                     ".SH DESCRIPTION\n" + paragraphs(page.description) + examples_text(program, page);
  if (command.empty()) text += commands_text(program);
  if (!page.arguments.empty()) text += ".SH ARGUMENTS\n";
  for (const Option& argument : page.arguments) text += option_text(argument);
  text += options_text(page);
  if (!page.notes.empty()) text += ".SH NOTES\n" + paragraphs(page.notes);
  if (!command.empty()) text += ".SH SEE ALSO\n" + bold(program.name) + "(1)\n";
  return text;
}

}  // namespace waitpoint::tools
