// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>

#include "core/error.hpp"
#include "core/nearest_name.hpp"
#include "tools/command/former_spellings.hpp"
#include "tools/command/help_text.hpp"
#include "tools/command/option_values.hpp"
#include "tools/command/shell_words.hpp"

namespace waitpoint::tools {
namespace {

using Words = std::vector<std::string>;

constexpr const char* where = "command line";

std::string name_of(const std::string& word) { return word.substr(0, word.find('=')); }

/// One line for a word that is not known, with the nearest known name.
BadInput unknown_word(const std::string& kind, const std::string& word, const Words& names, const std::string& hint) {
  const std::vector<std::string_view> known(names.begin(), names.end());
  const std::string near = did_you_mean(word, known);
  return BadInput(where, "unknown " + kind + " '" + word + "'" + (near.empty() ? "; " + hint : near));
}

Words names_of(const Command& command) {
  Words names = {"--help", "--help-all"};
  for (const Option& option : command.options) names.push_back(option.name);
  return names;
}

/// An option of another command is not spelt wrongly.
BadInput unknown_option(const DeclaredProgram& program, const Command& command, const std::string& word) {
  const std::string name = name_of(word);
  Words others;
  for (const auto& other : program.commands)
    if (std::ranges::find(other->options, name, &Option::name) != other->options.end()) others.push_back(other->name);
  if (others.empty())
    return unknown_word("option", name, names_of(command), "--help-all lists those of " + command.name);
  std::string all;
  for (const std::string& other : others) all += (all.empty() ? " " : ", ") + other;
  return BadInput(name, "is not an option of " + command.name + ", but of" + all);
}

/// What remains is too much: words of a program without "--" before them, an unknown option or another argument.
BadInput unexpected(const DeclaredProgram& program, const Command& command, const Words& words,
                    const Words& remaining) {
  if (remaining.front().starts_with('-')) return unknown_option(program, command, remaining.front());
  if (!command.takes_program || !command.arguments.empty())
    return BadInput(command.name, "expected no further argument, found '" + remaining.front() + "'" +
                                      (command.takes_program ? "; a program stands behind '--'" : ""));
  const Words before(words.begin(), words.end() - static_cast<std::ptrdiff_t>(remaining.size()));
  return BadInput(command.name, "expected '--' before the program: " + program.name + " " + command.name +
                                    quoted(before) + " --" + quoted(remaining));
}

/// A flag followed by "=" and a value, which CLI11 takes for true, or for none of its words.
void refuse_values_of_flags(const Command& command, const Words& words) {
  for (const std::string& word : words) {
    const std::string name = name_of(word);
    if (!word.starts_with("--") || name == word) continue;
    const auto found = std::ranges::find(command.options, name, &Option::name);
    const bool is_help = name == "--help" || name == "--help-all";
    if (is_help || (found != command.options.end() && found->value.is_flag))
      throw BadInput(name, "expected no value, found '" + word.substr(name.size() + 1) + "'");
  }
}

/// The texts of the options and arguments among the words.
Command::Given given_among(const DeclaredProgram& program, const Command& command, const Words& words) {
  CLI::App app;
  app.set_help_flag();
  app.allow_extras();
  if (command.takes_program && command.arguments.empty()) app.prefix_command();
  Command::Given texts;
  std::vector<std::pair<const Option*, CLI::Option*>> all;
  for (const Option& option : command.options) {
    if (option.value.is_flag) {
      all.emplace_back(&option, app.add_flag(option.name));
      continue;
    }
    CLI::Option* const added = app.add_option(option.name, texts[option.name]);
    added->expected(option.value.omitted.empty() ? 1 : 0, 1)->take_all()->allow_extra_args(false);
    all.emplace_back(&option, added);
  }
  std::map<std::string, std::string> words_of_arguments;
  for (const Option& argument : command.arguments) {
    CLI::Option* const added = app.add_option(argument.name, words_of_arguments[argument.name]);
    all.emplace_back(&argument, added->expected(1)->required(argument.details.is_required));
  }
  try {
    app.parse(Words(words.rbegin(), words.rend()));
  } catch (const CLI::ParseError& error) {
    if (Words remaining = app.remaining(); !remaining.empty()) throw unexpected(program, command, words, remaining);
    const std::string message = error.what();
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr)
      throw BadInput(message.substr(0, message.find(':')), "expected a value");
    throw BadInput(where, message);
  }
  if (const Words remaining = app.remaining(); !remaining.empty()) throw unexpected(program, command, words, remaining);
  Command::Given given;
  for (const auto& [option, parsed] : all) {
    if (parsed->count() == 0) continue;
    Words& found = given[option->name] = option->value.is_flag ? Words{""} : parsed->results();
    const bool lacks_value =
        !option->value.omitted.empty() && (found.empty() || found.back().empty() || found.back() == "{}");
    if (lacks_value) found = {option->value.omitted};
  }
  return given;
}

/// "run, check or manual"
std::string all_commands(const DeclaredProgram& program) {
  std::string names;
  for (const auto& command : program.commands)
    names += (command == program.commands.front()  ? ""
              : command == program.commands.back() ? " or "
                                                   : ", ") +
             command->name;
  return names;
}

}  // namespace

CommandLine::CommandLine(std::string program, const std::string& description, std::string version,
                         std::string (*version_json)())
    : program_{.name = std::move(program), .version = std::move(version), .commands = {}}, version_json_(version_json) {
  static bool ignored = false;
  Command& own = program_.own;
  own.description = description;
  own.add("--version", flag(ignored), "print version, format of digests, compiler, flags and fingerprint of the math");
  own.add("--json", flag(ignored), "with --version: as JSON");
}

std::optional<std::string> CommandLine::own_text(const Words& words) const {
  refuse_values_of_flags(program_.own, words);
  const auto has = [&](const char* word) { return std::ranges::find(words, word) != words.end(); };
  Words names = names_of(program_.own);
  for (const auto& command : program_.commands) names.push_back(command->name);
  for (const std::string& word : words)
    if (word != "-h" && std::ranges::find(names, word) == names.end())
      throw unknown_word(word.starts_with('-') ? "option" : "command", name_of(word), names, "--help lists them all");
  if (has("-h") || has("--help") || has("--help-all")) return program_help(program_);
  if (has("--version")) return (has("--json") ? version_json_() : program_.version) + "\n";
  if (has("--json"))
    throw BadInput("--json", "expected --version, or a command before it: " + program_.name + " COMMAND --json ...");
  return std::nullopt;
}

void CommandLine::parse(int argc, const char* const* argv) {
  Words words(argv + std::min(argc, 1), argv + argc);
  replace_former_command(words, former_);
  const auto name = std::ranges::find_if(words, [](const std::string& word) { return !word.starts_with('-'); });
  given_ = name == words.end() ? nullptr : program_.find(*name);
  const Words own_words(words.begin(), name == words.end() || given_ != nullptr ? name : name + 1);
  text_ = own_text(own_words);
  if (text_) return;
  if (given_ == nullptr)
    throw BadInput(where, "expected a command: " + all_commands(program_) + "; see " + program_.name + " --help");
  words.erase(words.begin(), name + 1);
  const std::string called = program_.name == "waitpoint" ? program_.name : argv[0];
  const bool begins_with_help = !words.empty() && (words[0] == "-h" || words[0].starts_with("--help"));
  if (given_->takes_all_words && !begins_with_help) return given_->take({}, std::move(words), {called, {}});
  replace_former_spellings(words, *given_);
  const Invocation invocation{called, words};
  Words program;
  if (const auto dashes = std::ranges::find(words, "--"); given_->takes_program && dashes != words.end()) {
    program.assign(dashes + 1, words.end());
    words.erase(dashes, words.end());
  }
  refuse_values_of_flags(*given_, words);
  const auto has = [&](const char* word) { return std::ranges::find(words, word) != words.end(); };
  if (has("-h") || has("--help") || has("--help-all")) {
    text_ = command_help(program_, *given_, has("--help-all") ? Extent::all : Extent::common);
    return;
  }
  given_->take(given_among(program_, *given_, words), std::move(program), invocation);
}

}  // namespace waitpoint::tools
