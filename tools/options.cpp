// SPDX-License-Identifier: BSD-3-Clause
#include "tools/options.hpp"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "tools/command/command_line.hpp"
#include "tools/command/completion.hpp"
#include "tools/command/manual_page.hpp"
#include "tools/command/option_values.hpp"
#include "tools/command/version.hpp"

namespace waitpoint::tools {
namespace {

/// The commands that describe the others, to man and to shells.
struct TextOptions {
  std::string page, shell;
};

std::string program_name(int argc, const char* const* argv) {
  const std::string name = argc > 0 ? std::filesystem::path(argv[0]).filename().string() : "";
  return name.empty() ? "waitpoint" : name;
}

/// All commands, with the functions that give their options once they are parsed.
class Commands {
 public:
  explicit Commands(DeclaredProgram& program) : program_(program) {}

  template <class Values>
  void add(const char* name) {
    const auto values = std::make_shared<Values>();
    Command& command = program_.add(name);
    declare(command, *values);
    readers_.emplace_back(&command, [values] { return Options(std::move(*values)); });
  }
  void add_texts() {
    const auto values = std::make_shared<TextOptions>();
    add_manual(program_, values->page);
    readers_.emplace_back(program_.commands.back().get(),
                          [this, values] { return ShownText{manual_page(program_, values->page)}; });
    Command& shells = program_.add("completion");
    shells.description = "Prints the script with which a shell completes command lines.";
    shells.examples = {"bash > ~/.local/share/bash-completion/completions/waitpoint"};
    shells.add("bash|zsh|fish", word<std::string>(values->shell, {{"bash", "bash"}, {"zsh", "zsh"}, {"fish", "fish"}}),
               "the shell", {.is_required = true});
    readers_.emplace_back(&shells, [this, values] { return ShownText{completion(program_, values->shell)}; });
  }
  Options options(const Command& command) const {
    return std::ranges::find(readers_, &command, &Reader::first)->second();
  }

 private:
  using Reader = std::pair<const Command*, std::function<Options()>>;

  DeclaredProgram& program_;
  std::vector<Reader> readers_;
};

/// Only the first word after "--" is interpreted; all others belong to gdb or to the program.
void read_program_of_gdb(DebugOptions& options, const DeclaredProgram& program) {
  options.own = program.find(options.words.front()) != nullptr;
  if (options.words.front() != "exec" && options.words.front() != "explore") return;
  std::vector<const char*> inner = {"waitpoint"};
  for (const std::string& word : options.words) inner.push_back(word.c_str());
  const Options read = read_options(static_cast<int>(inner.size()), inner.data(), "");
  if (const auto* const program = std::get_if<ExecOptions>(&read)) options.program = *program;
  if (const auto* const search = std::get_if<ExploreOptions>(&read))
    if (!search->replay.empty() && !search->program.empty() && !search->has_nodes) options.replayed = *search;
}

}  // namespace

Options read_options(int argc, const char* const* argv, const std::string& version) {
  CommandLine line(program_name(argc, argv),
                   "Simulates robots whose software runs as simulated threads: one seed, one run, bit for bit.",
                   version, version_json);
  line.program().own.examples = {"run office --until 60", "explore late-pom --property collisions=0",
                                 "exec -- ./program"};
  line.program().own.notes =
      "COMMAND --help tells more. Exit status: 0 success, 1 a failed expectation of the scenario or a "
      "deadlock, 2 bad input, 130 stopped by a signal.";
  Commands commands(line.program());
  commands.add<RunOptions>("run");
  commands.add<CheckOptions>("check");
  commands.add<PlanOptions>("plan");
  commands.add<DebugOptions>("gdb");
  commands.add<ExploreOptions>("explore");
  commands.add<ExecOptions>("exec");
  commands.add<GenomOptions>("genom");
  commands.add<ReplayOptions>("play");
  commands.add<ScenariosOptions>("scenarios");
  commands.add<FitOptions>("fit");
  commands.add<CompareOptions>("compare");
  commands.add<ViewOptions>("view");
  commands.add<SchemaOptions>("schema");
  commands.add_texts();
  line.former_command("replay", "play");
  line.parse(argc, argv);
  if (line.text()) return ShownText{*line.text()};
  Options options = commands.options(*line.given());
  if (auto* const run = std::get_if<RunOptions>(&options)) run->build = version;
  if (auto* const debug = std::get_if<DebugOptions>(&options)) read_program_of_gdb(*debug, line.program());
  return options;
}

}  // namespace waitpoint::tools
