// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run/run_options.hpp"

#include <algorithm>
#include <filesystem>

#include "core/error.hpp"
#include "tools/command/option_values.hpp"
#include "tools/command/options/time_limits.hpp"
#include "tools/command/shell_words.hpp"
#include "tools/output/output_file.hpp"
#include "tools/output/trajectory.hpp"

namespace waitpoint::tools {
namespace {

constexpr int ranks_max = 4096;
constexpr double watchdog_s_max = 1e6;

/// As a text of YAML.
std::string in_quotation_marks_of_yaml(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "''" : std::string(1, c);
  return quoted + "'";
}

/// The bag of --play is a value of the scenario, as those of --set.
OptionValue played_bag(std::vector<std::string>& assignments) {
  OptionValue value{.placeholder = "BAG"};
  value.take = [&assignments](const std::string&, const std::string& text) {
    assignments.push_back("play.bag=" + in_quotation_marks_of_yaml(text));
  };
  return value;
}

/// It names three files.
OptionValue trajectory_files(OptionalFile& into) {
  OptionValue value = written_file(into, "FILE.tum");
  value.take = [&into](const std::string& source, const std::string& text) {
    if (is_standard_output(text)) refuse(source, "a name that ends in .tum: it writes three files", text);
    into = text;
  };
  value.files = [](const std::string& text) {
    std::vector<std::string> names;
    for (const std::filesystem::path& path : trajectory_names(text, {})) names.push_back(path.string());
    return names;
  };
  return value;
}

/// Seconds, of which 0 are none.
OptionValue idle_seconds(Duration& into) {
  OptionValue value{.placeholder = "S"};
  value.take = [&into](const std::string& source, const std::string& text) {
    std::optional<Duration> duration = Duration();
    if (text != "0") seconds(duration).take(source, text);
    into = *duration;
  };
  return value;
}

void declare_times(Command& command, RunOptions& options, std::optional<double>& speed) {
  declare_until(command, options.until);
  declare_speed(command, speed);
  command.add("--watchdog", number(options.watchdog_s, 0, watchdog_s_max, "S", "seconds from 0 to 1000000"),
              "report a task that reaches no event for S seconds of the wall clock",
              {.usual = "10", .more = "The run ends after six times that. 0: never.", .is_rare = true});
  command.add("--idle", idle_seconds(options.idle),
              "list tasks that have waited without a timeout for S seconds of virtual time",
              {.usual = "60", .more = "The list comes at the end; 0: no list.", .is_rare = true});
  command.add("--brief", flag(options.is_brief), "with nodes of ROS: end when an expectation cannot be met any more",
              {.more = "The nodes are killed at the end, as in waitpoint explore.", .is_rare = true});
}

void declare_results(Command& command, RunOptions& options) {
  declare_summary(command, options.summary, options.json);
  declare_picture(command, options.picture, "draw the floor and the paths");
  declare_page(command, options.page, "write a page for browsers (docs/view.md)");
  command.add(
      "--trajectory", trajectory_files(options.trajectory), "write the paths in TUM format",
      {.more = "The true path goes to FILE.tum, the others to FILE.estimated.tum and FILE.odometry.tum; of several "
               "robots with their names.",
       .is_rare = true});
  command.add("--record", written_file(options.record, "FILE.mcap"),
              "write scans, poses, requests and the world for Foxglove",
              {.more = "FILE.bag: a ROS 1 bag; FILE.log: a log for CARMEN's tools (docs/recording.md)."});
  command.section("Events, and their comparison");
  declare_event_files(command, options.digests, "write a digest per robot and simulated second", options.events);
  command.add("--decisions", written_file(options.decisions, "FILE"),
              "write every decision of the robots' execution control (docs/laas-control.md)", {.is_rare = true});
  command.add("--record-durations", written_file(options.record_durations, "FILE"),
              "write the durations that local clocks measured, counted or drew (docs/clocks.md)", {.is_rare = true});
  command.add("--replay-durations", read_file(options.replay_durations, "FILE"),
              "take these durations from a record of the same scenario and seed", {.is_rare = true});
  declare_verify(command, options.verify,
                 {"--seeds", "--speed", "--summary", "--interactive", "--tcl", "--external", "--serve-world", "--serve",
                  "--journal", "--replay-journal", "--picture", "--page", "--trajectory", "--record", "--digests",
                  "--events", "--decisions", "--record-durations"});
}

void declare_interaction(Command& command, RunOptions& options) {
  command.section("Interaction");
  command.add("--interactive", flag(options.interactive), "read commands from standard input; help lists them");
  command.add("--tcl", flag(options.tcl), "read commands in Tcl for the first robot's modules (docs/laas-tcl.md)",
              {.is_rare = true});
  command.add("--journal", written_file(options.journal, "FILE"), "write the interventions with their virtual times");
  command.add("--replay-journal", read_file(options.replay_journal, "FILE"),
              "repeat those of a journal, and verify the digest at the end");
  declare_serve(command, options.serve, "show the run in a browser, until Ctrl-C");
  command.add("--serve-control", flag(options.serve_control),
              "viewers may pause and pace the run, and try interventions in branches of it", {.is_rare = true});
  command.section("Processes");
  command.add("--ranks", whole(options.ranks, 1, ranks_max), "divide the robots among N processes (docs/ranks.md)",
              {.usual = "1",
               .more = "They are started by mpirun of Open MPI, also on other hosts: mpirun ... waitpoint run ...; the "
                       "run and its digest are the same.",
               .is_rare = true});
  command.add("--external", texts(options.partners.external, "'ROBOT=ADDRESS [KEY=VALUE ...]'"),
              "move this robot's body by position reports from a process outside; may be repeated",
              {.more = "It connects to unix:PATH or tcp:PORT of the loopback. KEY: between, jump_m, silent_s, late_s "
                       "(docs/external.md).",
               .is_rare = true});
  command.add("--serve-world", text(options.partners.serve_world, "ADDRESS"),
              "serve base and lasers of robots without modules to software in other processes",
              {.more = "ADDRESS: unix:PATH or tcp:PORT of the loopback (docs/external.md).", .is_rare = true});
  command.add("--outside-faults-end", flag(options.partners.faults_end),
              "end the run, with status 1, at the first fault of a process outside", {.is_rare = true});
  command.add("--play", played_bag(options.assignments),
              "publish the topics of this bag to the scenario's nodes of ROS, with no world",
              {.more = "It is the scenario's play.bag (docs/ros-bags.md).", .is_rare = true});
}

/// Which options do not go together.
std::vector<Rule> rules_of_run() {
  constexpr Rule::Kind excludes = Rule::Kind::excludes, needs = Rule::Kind::needs;
  return {
      {"--seeds",
       excludes,
       {"--seed", "--replay-durations", "--interactive", "--tcl", "--external", "--serve-world", "--journal",
        "--replay-journal", "--picture", "--page", "--trajectory", "--record", "--digests", "--events", "--decisions",
        "--record-durations"}},
      {"--jobs", needs, {"--seeds"}, "whose runs it makes at once"},
      {"--ranks",
       excludes,
       {"--seeds", "--decisions", "--page", "--record-durations", "--replay-durations", "--verify"},
       "",
       "1"},
      {"--ranks", excludes, {"--external", "--serve-world"}, "processes outside meet one process", "1"},
      {"--outside-faults-end", needs, {"--external", "--serve-world"}, "whose faults they are"},
      {"--external", excludes, {"--replay-journal"}, "which repeats what came from outside"},
      {"--serve-world", excludes, {"--replay-journal"}, "which repeats what came from outside"},
      {"--serve-control", needs, {"--serve"}, "whose viewers it concerns"},
      {"--serve", excludes, {"--seeds", "--replay-durations", "--record-durations"}},
      {"--serve", excludes, {"--ranks"}, "a run of several processes is not viewed"},
      {"--serve", excludes, {"--external", "--serve-world"}, "what is outside has no past to go back to"},
      {"--tcl", excludes, {"--interactive"}},
      {"--replay-journal", excludes, {"--interactive", "--tcl"}},
      {"--record-durations", excludes, {"--replay-durations"}},
      {"--json", excludes, {"--interactive", "--tcl"}, "both need standard output"},
  };
}

/// What is outside lives in real time.
double speed_of(const PartnerOptions& partners, std::optional<double> asked) {
  if (!partners.any()) return asked.value_or(0);
  if (asked.value_or(1) != 1)
    throw BadInput(partners.name(), "expected --speed 1: processes outside live in real time");
  return 1;
}

}  // namespace

void declare(Command& command, RunOptions& options) {
  command.description = "Simulates a scenario and prints a summary with the digest.";
  command.examples = {"office --until 60 --picture floor.svg"};
  command.notes = "Exit status: 0 as expected, 1 not, or a deadlock, 2 bad input, 130 stopped by a signal.";
  declare_scenario(command, options);
  declare_schedule(command, options, "run each seed from A to B and print a row for each", "fifo");
  declare_jobs(command, options.jobs);
  command.removed = {{"--place", "each rank has an equal part of the robots, in the order of the scenario"},
                     {"--reports", "settings follow the address: --external 'ROBOT=ADDRESS KEY=VALUE ...'"},
                     {"--serve-origin", "--serve shows the run in a browser, Foxglove opens a --record FILE.mcap"}};
  const auto speed = std::make_shared<std::optional<double>>();
  declare_times(command, options, *speed);
  declare_results(command, options);
  declare_interaction(command, options);
  for (Rule& rule : rules_of_run()) command.rules.push_back(std::move(rule));
  command.finally([&command, &options, speed] {
    options.speed = speed_of(options.partners, *speed);
    options.program = command.invocation().program;
    options.arguments = command.invocation().words;
    options.arguments.insert(options.arguments.begin(), command.name);
    options.files = command.files();
    options.given = command.given_options();
  });
}

bool RunOptions::writes_standard_output() const {
  const auto is_written_there = [](const NamedFile& file) {
    return file.use == NamedFile::Use::written && is_standard_output(file.name);
  };
  return json || std::ranges::any_of(files, is_written_there);
}

void check_files(const RunOptions& options, std::span<const std::string> robots) {
  std::vector<NamedFile> files;
  bool has_trajectories = false;
  for (const NamedFile& file : options.files) {
    if (file.option != "--trajectory") {
      files.push_back(file);
    } else if (!std::exchange(has_trajectories, true)) {
      for (const std::filesystem::path& path : trajectory_names(*options.trajectory, robots))
        files.push_back({file.option, path.string()});
    }
  }
  check_distinct(files);
}

void check_none_given(const RunOptions& options, std::span<const char* const> names, const std::string& message) {
  for (const char* const name : names)
    if (std::ranges::find(options.given, name) != options.given.end()) throw BadInput(name, message);
}

std::string replay_line(const RunOptions& options, std::uint64_t seed) {
  std::string line =
      quoted(options.program) + " run " + quoted(options.scenario.string()) + " --seed " + std::to_string(seed);
  if (options.order == kernel::Order::seeded) line += " --strategy random";
  if (options.until) line += " --until " + to_string(Time() + *options.until);
  if (options.is_brief) line += " --brief";
  if (options.replay_durations) line += " --replay-durations " + quoted(options.replay_durations->string());
  // A replay has to read the journal that this run writes.
  if (const auto& journal = options.journal ? options.journal : options.replay_journal)
    line += " --replay-journal " + quoted(journal->string());
  if (!options.confined_to.empty()) line += " --confined";
  for (const std::string& folder : options.allowed) line += " --allow " + quoted(folder);
  for (const std::string& assignment : options.assignments) line += " --set " + in_quotation_marks(assignment);
  if (options.partners.any() && !options.journal)
    line += "  # without what came from outside: --journal FILE records it";
  else if ((options.interactive || options.tcl) && !options.journal)
    line += "  # without the prompt's commands: --journal FILE records them";
  return line;
}

}  // namespace waitpoint::tools
