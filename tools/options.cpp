// SPDX-License-Identifier: BSD-3-Clause
#include "tools/options.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string_view>

#include "core/error.hpp"
#include "core/word_list.hpp"
#include "tools/command/command_line.hpp"
#include "tools/command/completion.hpp"
#include "tools/command/distinct_files.hpp"
#include "tools/command/installed_part.hpp"
#include "tools/command/manual_page.hpp"
#include "tools/command/shell_words.hpp"
#include "tools/command/version.hpp"

namespace waitpoint::tools {
namespace {

constexpr const char* statuses =
    "See waitpoint COMMAND --help. Exit status: 0 success, 1 a failed expectation of the scenario or a deadlock,\n"
    "2 bad input, 130 stopped by a signal.";

/// Only the first word after "--" is interpreted; all others belong to gdb or to the program.
DebugOptions debug_options(const std::vector<std::string>& words, const std::vector<std::string>& commands) {
  DebugOptions options;
  const auto dashes = std::find(words.begin(), words.end(), "--");
  if (dashes == words.end() || dashes + 1 == words.end())
    throw BadInput("gdb",
                   "expected a command to run: waitpoint gdb -- run SCENARIO ..., or waitpoint gdb -- PROGRAM ...");
  options.gdb_options.assign(words.begin(), dashes);
  options.words.assign(dashes + 1, words.end());
  options.own = std::find(commands.begin(), commands.end(), options.words.front()) != commands.end();
  if (options.words.front() == "exec") {
    std::vector<const char*> inner = {"waitpoint"};
    for (const std::string& word : options.words) inner.push_back(word.c_str());
    const Options read = read_options(static_cast<int>(inner.size()), inner.data(), "");
    if (const auto* const program = std::get_if<ExecOptions>(&read)) options.program = *program;
  }
  return options;
}

void add_genom(CommandLine& line, GenomOptions& options, std::optional<Command>& command) {
  command =
      line.add_command("genom", "Generates a module from its description in GenoM's language (docs/laas-gen.md).");
  command->argument("FILE", options.file, "the description: NAME.gen", Command::Presence::required);
  command->option("--out", options.out, "FOLDER", "folder of the generated files (default: that of FILE)");
  command->repeated("--include", options.folders, "FOLDER", "where included files are searched, beside FILE's folder");
  command->flag("--check", options.check_only, "validate the description, and write nothing");
  command->flag("--documentation", options.documentation_only,
                "write its page of requests and posters to standard output");
  command->json(options.json);
}

class PlanArguments {
 public:
  explicit PlanArguments(CommandLine& line)
      : command_(line.add_command("plan", "Checks a temporal plan, and prints the windows of its actions.")) {
    command_.argument("PLAN", file_, "YAML file (docs/laas-plans.md)", Command::Presence::required);
    command_.option("--svg", picture_, "FILE", "writes a picture of the plan");
    command_.json(json_);
  }

  bool parsed() const { return command_.parsed(); }
  PlanOptions options() const {
    if (json_) check_beside_json({{"--svg", picture_}});
    return {file_, picture_, json_};
  }

 private:
  Command command_;
  std::string file_, picture_;
  bool json_ = false;
};

class SchemaArguments {
 public:
  explicit SchemaArguments(CommandLine& line)
      : command_(line.add_command("schema",
                                  "Prints the JSON Schema (2020-12) of a kind of file, for editors and validators:\n"
                                  "  waitpoint schema scenario > scenario.json")) {
    command_.argument("KIND", kind_, "scenario (the default), robot (a file of robot types), plan or floor",
                      Command::Presence::optional);
  }

  bool parsed() const { return command_.parsed(); }
  SchemaOptions options() const {
    if (std::find(std::begin(schema_kinds), std::end(schema_kinds), kind_) == std::end(schema_kinds))
      throw BadInput("KIND", "expected " + word_list(schema_kinds) + ", found '" + kind_ + "'");
    return {kind_};
  }

 private:
  Command command_;
  std::string kind_ = "scenario";
};

/// The commands that describe the others, to man and to shells.
class TextArguments {
 public:
  explicit TextArguments(CommandLine& line)
      : manual_(add_manual(line, page_)),
        completion_(line.add_command("completion", "Prints the script with which a shell completes command lines.")) {
    completion_.argument("bash|zsh|fish", shell_, "the shell", Command::Presence::required);
  }

  std::optional<ShownText> text(const CommandLine& line) const {
    if (manual_.parsed()) return ShownText{manual_page(line.described(), page_)};
    if (completion_.parsed()) return ShownText{completion(line.described(), shell_)};
    return std::nullopt;
  }

 private:
  std::string page_, shell_;
  Command manual_, completion_;
};

BadInput missing_command(const std::vector<std::string>& commands) {
  std::string names;
  for (const std::string& command : commands)
    names += (&command == &commands.front() ? " " : &command == &commands.back() ? " or " : ", ") + command;
  return BadInput("command line", "expected a command:" + names + "; see waitpoint --help");
}

/// A program with modules of its own is named as it was called.
std::string name_in_replay_lines(const std::string& program) {
  const std::string name = std::filesystem::path(program).filename().string();
  return name.empty() || name == "waitpoint" ? "waitpoint" : program;
}

}  // namespace

Options read_options(int argc, const char* const* argv, const std::string& version) {
  CommandLine line("waitpoint",
                   "Simulates robots whose software runs as simulated threads: one seed, one run, bit for bit.");
  line.version(version, "print version, format of digests, compiler, flags and fingerprint of the exact math",
               version_json);
  RunArguments run(line);
  Command check = line.add_command("check", "Validates a scenario without running it.");
  ScenarioArguments checked;
  checked.add_file(check);
  checked.add_set(check);
  bool is_check_json = false;
  check.json(is_check_json);
  PlanArguments plan(line);
  line.add_command("gdb",
                   "Starts gdb with commands for simulated threads (docs/gdb.md):\n"
                   "  waitpoint gdb [OPTIONS OF GDB] -- run SCENARIO ...\n"
                   "  waitpoint gdb [OPTIONS OF GDB] -- PROGRAM ...");
  ExploreArguments explore(line);
  ExecArguments exec(line);
  GenomOptions generated;
  std::optional<Command> genom;
  add_genom(line, generated, genom);
  ReplayArguments replay(line);
  FitArguments fit(line);
  CompareArguments compare(line);
  ViewArguments view(line);
  SchemaArguments schema(line);
  TextArguments texts(line);
  line.footer(statuses);
  const std::vector<std::string> words(argv + std::min(argc, 2), argv + argc);
  if (argc > 1 && std::string_view(argv[1]) == "gdb") {
    if (words.empty() || (words[0] != "--help" && words[0] != "-h")) return debug_options(words, line.commands());
    argc = 3;  // the program's own
  }
  std::vector<std::string> program;
  const auto dashes = std::find(words.begin(), words.end(), "--");
  const bool is_explored =
      argc > 1 && std::string_view(argv[1]) == "explore" && std::find(words.begin(), dashes, "--exec") != dashes;
  if (is_explored || (argc > 1 && std::string_view(argv[1]) == "exec")) {
    if (dashes != words.end()) program.assign(dashes + 1, words.end());
    argc = 2 + static_cast<int>(dashes - words.begin());  // the program's own
  }
  if (const std::optional<std::string> text = line.parse(argc, argv)) return ShownText{*text};
  if (run.parsed()) {
    RunOptions options = run.options();
    options.program = name_in_replay_lines(argv[0]);
    options.arguments.assign(argv + 1, argv + argc);
    options.build = version;
    return options;
  }
  if (explore.parsed()) return explore.options(program);
  if (exec.parsed()) return exec.options(program);
  if (plan.parsed()) return plan.options();
  if (genom->parsed()) return generated;
  if (replay.parsed()) {
    ReplayOptions options = replay.options();
    options.command = quoted(name_in_replay_lines(argv[0])) + quoted(std::vector<std::string>(argv + 1, argv + argc));
    return options;
  }
  if (fit.parsed()) return fit.options();
  if (compare.parsed()) return compare.options();
  if (view.parsed()) return view.options();
  if (schema.parsed()) return schema.options();
  if (const std::optional<ShownText> text = texts.text(line)) return *text;
  if (check.parsed()) {
    const std::filesystem::path scenario = find_scenario(checked.file);
    return CheckOptions{scenario, checked.confinement.folders(scenario), checked.assignments, is_check_json};
  }
  throw missing_command(line.commands());
}

}  // namespace waitpoint::tools
