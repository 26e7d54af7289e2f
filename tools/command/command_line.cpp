// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>

#include "core/error.hpp"
#include "core/nearest_name.hpp"
#include "tools/command/shell_words.hpp"

namespace waitpoint::tools {
namespace {

std::vector<std::string> commands_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

constexpr const char* where = "command line";

/// One line for a word that is not known, with the nearest known name.
BadInput unknown_word(const CLI::App& app, const std::vector<std::string>& extra) {
  const CLI::App* command = app.get_subcommands().empty() ? &app : app.get_subcommands().front();
  std::vector<std::string> names;
  for (const CLI::Option* option : command->get_options()) names.push_back(option->get_name());
  if (command == &app) {
    for (const std::string& name : commands_of(app)) names.push_back(name);
  }
  const std::vector<std::string_view> known(names.begin(), names.end());
  const std::string word = extra.front().substr(0, extra.front().find('='));
  const std::string hint = did_you_mean(word, known);
  const std::string kind = word.starts_with('-') ? "option" : command == &app ? "command" : "argument";
  return BadInput(where, "unknown " + kind + " '" + word + "'" + (hint.empty() ? "; --help lists them all" : hint));
}

/// One line for the words of a program without "--" before them, with the command line that has it.
BadInput missing_dashes(const CLI::App& command, int argc, const char* const* argv) {
  const std::vector<std::string> program = command.remaining();
  const std::vector<std::string> options(argv + 1, argv + argc - program.size());
  return BadInput(command.get_name(),
                  "expected '--' before the program: waitpoint" + quoted(options) + " --" + quoted(program));
}

// Usually an unset variable of a script, where the default is not intended.
void refuse_empty_words(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options())
    for (const std::string& word : option->results())
      if (word.empty()) throw BadInput(option->get_name(), "expected a value, found ''");
}

/// A flag followed by "=" and a value, which CLI11 takes for true, or for none of its words.
void refuse_values_of_flags(const CLI::App& program, int argc, const char* const* argv) {
  const CLI::App* of = &program;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    const std::size_t equals = word.find('=');
    for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
      if (of == &program && command->get_name() == word) of = command;
    if (!word.starts_with("--") || equals == word.npos) continue;
    const std::string name(word.substr(0, equals));
    const CLI::Option* const option = of->get_option_no_throw(name);
    if (option != nullptr && option->get_items_expected_max() == 0)
      throw BadInput(name, "expected no value, found '" + std::string(word.substr(equals + 1)) + "'");
  }
}

DescribedOption described_option(const CLI::Option& option) {
  DescribedOption described;
  if (option.get_positional()) described.names.push_back(option.get_name(true));
  for (const std::string& name : option.get_snames()) described.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) described.names.push_back("--" + name);
  const bool has_value = option.get_items_expected_max() > 0;
  if (has_value && !option.get_positional()) described.type = option.get_type_name();
  described.description = option.get_description();
  described.required = option.get_required();
  described.repeated = option.get_expected_max() > 1;
  described.may_lack_value = has_value && option.get_items_expected_min() == 0;
  return described;
}

DescribedCommand described_command(const CLI::App& app) {
  DescribedCommand described;
  described.name = app.get_parent() == nullptr ? "" : app.get_name();
  described.description = app.get_description();
  described.footer = app.get_footer();
  described.takes_program = app.get_prefix_command();
  for (const CLI::Option* option : app.get_options())
    (option->get_positional() ? described.arguments : described.options).push_back(described_option(*option));
  return described;
}

constexpr const char* json_flag = "--json";

}  // namespace

void Command::argument(const char* name, std::string& value, const char* description, Presence presence) {
  app_->add_option(name, value, description)->required(presence == Presence::required)->type_name(" ");
}

void Command::option(const char* name, std::string& value, const char* type, const std::string& description) {
  app_->add_option(name, value, description)->type_name(type);
}

void Command::option_or_flag(const char* name, std::string& value, const char* type, const std::string& usual,
                             const std::string& description) {
  app_->add_option(name, value, description)->type_name(type)->expected(0, 1)->default_str(usual);
}

void Command::repeated(const char* name, std::vector<std::string>& values, const char* type,
                       const std::string& description) {
  app_->add_option(name, values, description)->type_name(type)->allow_extra_args(false);
}

void Command::flag(const char* name, bool& value, const std::string& description) {
  app_->add_flag(name, value, description)->disable_flag_override();
}

void Command::json(bool& value) {
  flag(json_flag, value, "print the result as JSON to standard output, and the text to standard error (docs/json.md)");
}

void Command::takes_program() { app_->prefix_command(); }

void Command::footer(const std::string& text) { app_->footer(text); }

bool Command::parsed() const { return app_->parsed(); }

CommandLine::CommandLine(const std::string& program, const std::string& description)
    : app_(std::make_unique<CLI::App>(description, program)) {
  app_->set_help_flag("-h,--help", "print this text");
  app_->require_subcommand(0, 1);
}

CommandLine::~CommandLine() = default;

Command CommandLine::add_command(const char* name, const char* description) {
  return Command(*app_->add_subcommand(name, description));
}

std::vector<std::string> CommandLine::commands() const { return commands_of(*app_); }

DescribedProgram CommandLine::described() const {
  DescribedProgram program{app_->get_name(), app_->version(), described_command(*app_), {}};
  program.version.resize(std::min(program.version.size(), program.version.find('\n')));
  for (const CLI::App* command : app_->get_subcommands([](const CLI::App*) { return true; }))
    program.commands.push_back(described_command(*command));
  return program;
}

void CommandLine::version(const std::string& text, const char* description, std::string (*json)()) {
  app_->set_version_flag("--version", text, description);
  app_->add_flag(json_flag)->description("with --version: as JSON");
  version_as_json_ = json;
}

void CommandLine::footer(const std::string& text) { app_->footer(text); }

std::optional<std::string> CommandLine::parse(int argc, const char* const* argv) {
  refuse_values_of_flags(*app_, argc, argv);
  try {
    app_->parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return app_->help();
  } catch (const CLI::CallForVersion&) {
    return (app_->count(json_flag) > 0 ? version_as_json_() : app_->version()) + "\n";
  } catch (const CLI::ParseError& error) {
    const std::vector<std::string> extra = app_->remaining(true);
    throw extra.empty() ? BadInput(where, error.what()) : unknown_word(*app_, extra);
  }
  if (version_as_json_ != nullptr && app_->count(json_flag) > 0)
    throw BadInput(json_flag, "expected --version, or a command before it: waitpoint COMMAND --json ...");
  for (const CLI::App* command : app_->get_subcommands()) {
    refuse_empty_words(*command);
    const std::vector<std::string> extra = command->remaining();
    if (!extra.empty()) throw extra[0][0] == '-' ? unknown_word(*app_, extra) : missing_dashes(*command, argc, argv);
  }
  return std::nullopt;
}

}  // namespace waitpoint::tools
