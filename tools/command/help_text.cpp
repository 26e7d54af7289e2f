// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/help_text.hpp"

#include <algorithm>
#include <sstream>

namespace waitpoint::tools {
namespace {

constexpr std::size_t line_width = 100, text_column = 28;

/// Breaks lines before `width`, and indents all but the first. Lines that begin with a space stay as they are.
std::string wrapped(const std::string& text, std::size_t indent) {
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    if (!result.empty()) result += "\n" + std::string(indent, ' ');
    if (line.starts_with(' ')) {
      result += line;
      continue;
    }
    std::istringstream words(line);
    std::size_t at = indent;
    bool is_first = true;
    for (std::string word; words >> word; is_first = false) {
      if (!is_first && at + 1 + word.size() > line_width) {
        result += "\n" + std::string(indent, ' ') + word;
        at = indent + word.size();
        continue;
      }
      result += (is_first ? "" : " ") + word;
      at += word.size() + (is_first ? 0 : 1);
    }
  }
  return result;
}

/// "  LABEL   text", the text in a column of its own.
std::string row(const std::string& label, const std::string& text) {
  std::string line = "  " + label;
  if (line.size() + 2 > text_column) line += "\n" + std::string(text_column, ' ');
  if (line.size() < text_column) line.resize(text_column, ' ');
  return line + wrapped(text, text_column) + "\n";
}

std::string option_rows(const Command& command, Extent extent) {
  std::string text, rare;
  for (const std::vector<const Option*>& section : sections_of(command)) {
    std::string rows;
    for (const Option* option : section) {
      if (option->details.is_rare && extent == Extent::common) {
        rare += (rare.empty() ? "" : ", ") + option->name;
        continue;
      }
      const bool has_more = extent == Extent::all && !option->details.more.empty();
      rows += row(option->label(), (extent == Extent::all ? option->summary() : option->brief()) +
                                       (has_more ? "\n" + option->details.more : ""));
    }
    const std::string title = section.front()->section.empty() ? "Options" : section.front()->section;
    if (!rows.empty()) text += "\n" + title + ":\n" + rows;
  }
  if (!rare.empty()) text += "\n" + wrapped("More, explained by --help-all: " + rare, 2) + "\n";
  return text;
}

}  // namespace

std::vector<std::vector<const Option*>> sections_of(const Command& command) {
  std::vector<std::vector<const Option*>> sections;
  for (const Option& option : command.options) {
    const auto same = [&](const auto& section) { return section.front()->section == option.section; };
    const auto found = std::ranges::find_if(sections, same);
    if (found == sections.end())
      sections.push_back({&option});
    else
      found->push_back(&option);
  }
  return sections;
}

const std::vector<Option>& help_options() {
  static const std::vector<Option> options = {{"--help", {.is_flag = true}, "print a short help", {}, ""},
                                              {"--help-all", {.is_flag = true}, "print all options", {}, ""}};
  return options;
}

std::vector<std::string> usages_of(const Command& command) {
  if (!command.usages.empty()) return command.usages;
  std::string usage = command.options.empty() ? "" : "[OPTIONS]";
  for (const Option& argument : command.arguments)
    usage += (usage.empty() ? "" : " ") + (argument.details.is_required ? argument.name : "[" + argument.name + "]");
  if (command.takes_program) usage += " -- PROGRAM [ARGUMENTS ...]";
  return {usage};
}

std::string command_help(const DeclaredProgram& program, const Command& command, Extent extent) {
  const std::string own = program.name + " " + command.name + " ";
  std::string text = wrapped(command.description, 0) + "\n";
  if (!command.examples.empty()) text += "\nExample:\n";
  for (const std::string& example : command.examples) text += "  " + own + example + "\n";
  text += "\n";
  const std::vector<std::string> usages = usages_of(command);
  for (const std::string& usage : usages)
    text += (usage == usages.front() ? "Usage: " : "       ") + own + usage + "\n";
  for (const Option& argument : command.arguments) text += row(argument.name, argument.summary());
  text += option_rows(command, extent);
  if (!command.notes.empty()) text += "\n" + wrapped(command.notes, 0) + "\n";
  return text;
}

std::string program_help(const DeclaredProgram& program) {
  std::string text = wrapped(program.own.description, 0) + "\n\nExample:\n";
  for (const std::string& example : program.own.examples) text += "  " + program.name + " " + example + "\n";
  text += "\nUsage: " + program.name + " COMMAND [OPTIONS] ...\n\nCommands:\n";
  for (const auto& command : program.commands) text += row(command->name, command->description);
  text += option_rows(program.own, Extent::all);
  return text + "\n" + wrapped(program.own.notes, 0) + "\n";
}

}  // namespace waitpoint::tools
