// SPDX-License-Identifier: BSD-3-Clause
#include "tools/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <map>
#include <string_view>

#include "core/nearest_name.hpp"
#include "core/number_text.hpp"
#include "tools/command/option_values.hpp"
#include "tools/run/pacing.hpp"

namespace waitpoint::tools {
namespace {

/// As the arguments are written, before their values are understood.
struct Arguments {
  std::string scenario, seed, seeds, order, until, speed, journal, replay_journal;
  std::string summary, picture, trajectory, record, digests, events;
  std::string record_durations, replay_durations;
  bool interactive = false;
  std::vector<std::string> assignments;
  bool check = false;
};

void add_scenario(CLI::App& command, Arguments& arguments) {
  command.add_option("SCENARIO", arguments.scenario, "the scenario file")->required()->type_name(" ");
}

void add_set(CLI::App& command, Arguments& arguments) {
  command
      .add_option("--set", arguments.assignments,
                  "set a value of the scenario, as often as needed. KEY is keys joined by dots,\n"
                  "elements of lists by their number from 0 or their name; VALUE is YAML. A file\n"
                  "named here is relative to the current directory. For example:\n"
                  "  robots.0.goals=[[1,2],[3,4]]\n"
                  "  robot_types.rackham.modules.segloc.enabled=false")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

CLI::App* add_run(CLI::App& app, Arguments& arguments) {
  CLI::App* run = app.add_subcommand("run", "Simulates a scenario; a summary and the digest at the end.");
  const auto add = [run](const char* name, std::string& value, const char* type, const char* description) {
    run->add_option(name, value, description)->type_name(type);
  };
  add_scenario(*run, arguments);
  add("--seed", arguments.seed, "N",
      "seed of the random streams and of the seeded order (default:\n$WAITPOINT_SEED, or 1)");
  add("--seeds", arguments.seeds, "A..B",
      "run each seed from A to B and print a row for each; of the files, only\n--summary can be written, of all runs");
  add("--order", arguments.order, "ORDER",
      "order of events of one instant: fifo, the default, or seeded, by hashes\nof the seed");
  add("--until", arguments.until, "S", "end at this virtual time, in seconds (default: the scenario's until_s)");
  add("--speed", arguments.speed, "X", "pace to X simulated seconds a second; 0, the default, is as fast as it goes");
  run->add_flag("--interactive", arguments.interactive,
                "take commands from standard input: step, stop at a time or a condition, change\n"
                "the speed, send requests, move robots and obstacles; type help there")
      ->disable_flag_override();
  add("--journal", arguments.journal, "FILE", "write what was done at the prompt, each at its virtual time");
  add("--replay-journal", arguments.replay_journal, "FILE",
      "do again what a journal says, and check that the run comes to its digest");
  add("--summary", arguments.summary, "FILE.json", "write the summary as JSON");
  add("--picture", arguments.picture, "FILE.svg", "draw the floor and the paths");
  add("--trajectory", arguments.trajectory, "FILE.tum",
      "write the paths in TUM format: the true one to FILE.tum, beside it\n"
      "FILE.estimated.tum and FILE.odometry.tum; with the robots' names if several");
  add("--record", arguments.record, "FILE.mcap",
      "write scans, poses, frames, requests and the world over time for Foxglove, or\n"
      "with a name FILE.bag as a ROS 1 bag, with FILE.log for CARMEN's tools");
  add("--digests", arguments.digests, "FILE", "write a digest per robot and simulated second");
  add("--events", arguments.events, "FILE", "write every event as a line of text");
  add("--record-durations", arguments.record_durations, "FILE",
      "write what local clocks measured, counted or chose (docs/clocks.md)");
  add("--replay-durations", arguments.replay_durations, "FILE",
      "take these durations from a record of the same scenario and seed:\nthe same run again, with the same digest");
  run->add_flag("--check", arguments.check,
                "run it twice in this process and once in a perturbed one (addresses,\n"
                "memory, environment, clocks, directories) and compare event by event:\n"
                "tells the first event that differs, with status 1, or that none does\n"
                "(docs/determinism.md)");
  add_set(*run, arguments);
  return run;
}

using Given = std::initializer_list<std::pair<const char*, const std::string&>>;

void check_not_together(const char* option, const Given& others) {
  for (const auto& [name, value] : others) {
    if (!value.empty()) throw BadInput(option, std::string("cannot be used together with ") + name);
  }
}

/// What is written of a single run, or done to it, has no place where the runs are many.
void check_of_many(const char* option, const Arguments& arguments) {
  if (arguments.interactive) throw BadInput(option, "cannot be used together with --interactive");
  check_not_together(option, {{"--journal", arguments.journal},
                              {"--replay-journal", arguments.replay_journal},
                              {"--picture", arguments.picture},
                              {"--trajectory", arguments.trajectory},
                              {"--record", arguments.record},
                              {"--digests", arguments.digests},
                              {"--events", arguments.events},
                              {"--record-durations", arguments.record_durations}});
}

/// A self-check compares runs and writes nothing of them.
void check_writes_nothing(const Arguments& arguments) {
  check_not_together("--check",
                     {{"--seeds", arguments.seeds}, {"--speed", arguments.speed}, {"--summary", arguments.summary}});
  check_of_many("--check", arguments);
}

/// A range of seeds is many runs, of which one summary is written.
void check_alone(const Arguments& arguments) {
  check_not_together("--seeds", {{"--seed", arguments.seed}, {"--replay-durations", arguments.replay_durations}});
  check_of_many("--seeds", arguments);
}

/// What a name stands for, links followed as far as there is something. Empty for what is no regular file, such as
/// /dev/null: it can be written more than once.
std::filesystem::path meant_by(const std::string& name) {
  std::error_code error;
  if (std::filesystem::exists(name, error) && !std::filesystem::is_regular_file(name, error)) return {};
  const std::filesystem::path path = std::filesystem::weakly_canonical(std::filesystem::absolute(name, error), error);
  return error ? std::filesystem::path(name) : path;
}

/// Each file takes its name when it is complete: of two with one name, the first would be lost. So would be a journal
/// that is read.
void check_distinct(const Arguments& arguments) {
  const std::pair<const char*, const std::string&> files[] = {{"--summary", arguments.summary},
                                                              {"--picture", arguments.picture},
                                                              {"--trajectory", arguments.trajectory},
                                                              {"--record", arguments.record},
                                                              {"--digests", arguments.digests},
                                                              {"--events", arguments.events},
                                                              {"--record-durations", arguments.record_durations},
                                                              {"--journal", arguments.journal},
                                                              {"--replay-journal", arguments.replay_journal}};
  std::map<std::filesystem::path, const char*> options;
  for (const auto& [option, name] : files) {
    const std::filesystem::path path = name.empty() ? std::filesystem::path() : meant_by(name);
    if (path.empty()) continue;
    const auto [other, is_new] = options.emplace(path, option);
    if (!is_new) throw BadInput(option, "'" + name + "' is the file that " + other->second + " writes");
  }
}

RunOptions run_options(const Arguments& arguments) {
  RunOptions options;
  options.scenario = arguments.scenario;
  options.assignments = arguments.assignments;
  const char* const environment = std::getenv("WAITPOINT_SEED");
  if (!arguments.seed.empty()) {
    options.seed = seed_of("--seed", arguments.seed);
  } else if (environment != nullptr && *environment != '\0') {
    options.seed = seed_of("WAITPOINT_SEED", environment);
  }
  options.check = arguments.check;
  if (options.check) check_writes_nothing(arguments);
  if (!arguments.seeds.empty()) {
    check_alone(arguments);
    options.seeds = seed_range_of("--seeds", arguments.seeds);
  }
  if (arguments.order == "seeded") {
    options.order = kernel::Order::seeded;
  } else if (!arguments.order.empty() && arguments.order != "fifo") {
    refuse("--order", "fifo or seeded", arguments.order);
  }
  options.until = positive_seconds("--until", arguments.until);
  if (!arguments.speed.empty() && (!parse_number(arguments.speed, options.speed) || !is_speed(options.speed)))
    refuse("--speed", speeds, arguments.speed);
  check_distinct(arguments);
  const auto file = [](const std::string& name) {
    return name.empty() ? std::nullopt : std::optional<std::filesystem::path>(name);
  };
  options.interactive = arguments.interactive;
  options.journal = file(arguments.journal);
  options.replay_journal = file(arguments.replay_journal);
  if (options.interactive && options.replay_journal)
    throw BadInput("--replay-journal", "cannot be used together with --interactive");
  options.summary = file(arguments.summary);
  options.picture = file(arguments.picture);
  options.trajectory = file(arguments.trajectory);
  options.record = file(arguments.record);
  options.digests = file(arguments.digests);
  options.events = file(arguments.events);
  options.record_durations = file(arguments.record_durations);
  options.replay_durations = file(arguments.replay_durations);
  if (options.record_durations && options.replay_durations)
    throw BadInput("--record-durations", "cannot be used together with --replay-durations");
  return options;
}

std::vector<std::string> commands_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

/// None of the words is looked at but the one that says what is to be run: they are gdb's and the program's.
DebugOptions debug_options(const std::vector<std::string>& words, const std::vector<std::string>& commands) {
  DebugOptions options;
  const auto dashes = std::find(words.begin(), words.end(), "--");
  if (dashes == words.end() || dashes + 1 == words.end())
    throw BadInput("gdb", "expected what to run: waitpoint gdb -- run SCENARIO ..., or waitpoint gdb -- PROGRAM ...");
  options.gdb_options.assign(words.begin(), dashes);
  options.words.assign(dashes + 1, words.end());
  options.own = std::find(commands.begin(), commands.end(), options.words.front()) != commands.end();
  return options;
}

/// What CLI11 did not understand, in one line that says what was probably meant.
BadInput bad_argument(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App* command = app.get_subcommands().empty() ? &app : app.get_subcommands().front();
  const std::string where = "command line";
  const std::vector<std::string> extra = app.remaining(true);
  if (extra.empty()) return BadInput(where, error.what());
  std::vector<std::string> names;
  for (const CLI::Option* option : command->get_options()) names.push_back(option->get_name());
  if (command == &app) {
    for (const std::string& name : commands_of(app)) names.push_back(name);
  }
  const std::vector<std::string_view> known(names.begin(), names.end());
  const std::string word = extra.front().substr(0, extra.front().find('='));
  const std::string hint = did_you_mean(word, known);
  const std::string kind = word.starts_with('-') ? "option" : command == &app ? "command" : "argument";
  return BadInput(where,
                  "unknown " + kind + " '" + word + "'" + (hint.empty() ? "; --help lists what there is" : hint));
}

// Mostly a variable of a script that is not set: the default is not what was meant.
void refuse_empty_words(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options())
    for (const std::string& word : option->results())
      if (word.empty()) throw BadInput(option->get_name(), "expected a value, found ''");
}

}  // namespace

Options read_options(int argc, const char* const* argv, const std::string& version) {
  CLI::App app("Simulates robots whose software runs as simulated threads: one seed, one run, bit for bit.",
               "waitpoint");
  app.set_help_flag("-h,--help", "print this text");
  app.set_version_flag("--version", version, "print version, compiler, flags and the fingerprint of the math");
  Arguments arguments;
  CLI::App* run = add_run(app, arguments);
  CLI::App* check =
      app.add_subcommand("check", "Reads a scenario and tells what is wrong with it, without running it.");
  add_scenario(*check, arguments);
  add_set(*check, arguments);
  app.add_subcommand("gdb",
                     "Starts gdb with commands that see the simulated threads (docs/gdb.md):\n"
                     "  waitpoint gdb [OPTIONS OF GDB] -- run SCENARIO ...\n"
                     "  waitpoint gdb [OPTIONS OF GDB] -- PROGRAM ...");
  ExploreArguments explore(app);
  ExecArguments exec(app);
  // After the commands are added, which would inherit it.
  app.footer(
      "waitpoint COMMAND --help tells more. Exit status: 0 as the scenario expects, 1 an expectation failed or a\n"
      "deadlock was found, 2 bad input, 130 stopped by a signal.");
  app.require_subcommand(0, 1);
  const std::vector<std::string> words(argv + std::min(argc, 2), argv + argc);
  if (argc > 1 && std::string_view(argv[1]) == "gdb") {
    if (words.empty() || (words[0] != "--help" && words[0] != "-h")) return debug_options(words, commands_of(app));
    argc = 3;  // the rest is not ours
  }
  std::vector<std::string> program;
  const auto dashes = std::find(words.begin(), words.end(), "--");
  const bool is_explored =
      argc > 1 && std::string_view(argv[1]) == "explore" && std::find(words.begin(), dashes, "--exec") != dashes;
  if (is_explored || (argc > 1 && std::string_view(argv[1]) == "exec")) {
    if (dashes != words.end()) program.assign(dashes + 1, words.end());
    argc = 2 + static_cast<int>(dashes - words.begin());  // the rest is not ours
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return ShownText{app.help()};
  } catch (const CLI::CallForVersion&) {
    return ShownText{version + "\n"};
  } catch (const CLI::ParseError& error) {
    throw bad_argument(app, error);
  }
  for (const CLI::App* command : app.get_subcommands()) refuse_empty_words(*command);
  if (run->parsed()) return run_options(arguments);
  if (explore.parsed()) return explore.options(program);
  if (exec.parsed()) return exec.options(program);
  if (check->parsed()) return CheckOptions{arguments.scenario, arguments.assignments};
  throw BadInput("command line", "expected a command, run, check, explore or exec; waitpoint --help tells more");
}

}  // namespace waitpoint::tools
