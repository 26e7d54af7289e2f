// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run/run_options.hpp"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <string_view>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "tools/command/distinct_files.hpp"
#include "tools/command/installed_part.hpp"
#include "tools/command/shell_words.hpp"
#include "tools/output/output_file.hpp"
#include "tools/output/trajectory.hpp"
#include "tools/run/pacing.hpp"

namespace waitpoint::tools {
namespace {

constexpr const char* free_port = "127.0.0.1:0";

/// A picture's format does not follow from its name: a viewer would take it for another.
void check_picture(const std::string& name) {
  constexpr std::string_view others[] = {".png", ".jpg",  ".jpeg", ".gif", ".webp", ".bmp",
                                         ".tif", ".tiff", ".ppm",  ".pdf", ".ps",   ".eps"};
  std::string kind = std::filesystem::path(name).extension();
  std::transform(kind.begin(), kind.end(), kind.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (std::find(std::begin(others), std::end(others), kind) != std::end(others))
    refuse("--picture", "a name that ends in .svg, the format of pictures", name);
}

/// As a text of YAML.
std::string in_quotation_marks_of_yaml(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "''" : std::string(1, c);
  return quoted + "'";
}

std::vector<NamedFile> files_of(const RunOptions& options, std::span<const std::string> robots) {
  const auto name = [](const std::optional<std::filesystem::path>& file) { return file ? file->string() : ""; };
  std::vector<NamedFile> files = {
      {"--summary", name(options.summary)}, {"--picture", name(options.picture)}, {"--page", name(options.page)}};
  if (options.trajectory)
    for (const std::filesystem::path& path : trajectory_names(*options.trajectory, robots))
      files.push_back({"--trajectory", path.string()});
  files.insert(files.end(), {{"--record", name(options.record)},
                             {"--digests", name(options.digests)},
                             {"--events", name(options.events)},
                             {"--decisions", name(options.decisions)},
                             {"--record-durations", name(options.record_durations)},
                             {"--journal", name(options.journal)},
                             {"SCENARIO", options.scenario.string(), NamedFile::Use::read},
                             {"--replay-journal", name(options.replay_journal), NamedFile::Use::read},
                             {"--replay-durations", name(options.replay_durations), NamedFile::Use::read}});
  return files;
}

}  // namespace

bool RunOptions::writes_standard_output() const {
  if (json) return true;
  for (const auto* file :
       {&summary, &picture, &page, &record, &digests, &events, &decisions, &record_durations, &journal})
    if (*file && is_standard_output(**file)) return true;
  return false;
}

void check_files(const RunOptions& options, std::span<const std::string> robots) {
  check_distinct(files_of(options, robots));
}

std::string replay_line(const RunOptions& options, std::uint64_t seed) {
  std::string line =
      quoted(options.program) + " run " + quoted(options.scenario.string()) + " --seed " + std::to_string(seed);
  if (options.order == kernel::Order::seeded) line += " --order seeded";
  if (options.until) line += " --until " + to_string(Time() + *options.until);
  if (options.is_brief) line += " --brief";
  if (options.replay_durations) line += " --replay-durations " + quoted(options.replay_durations->string());
  // A replay has to read the journal that this run writes.
  if (const auto& journal = options.journal ? options.journal : options.replay_journal)
    line += " --replay-journal " + quoted(journal->string());
  if (!options.confined_to.empty()) line += " --confined";
  for (std::size_t i = 1; i < options.confined_to.size(); ++i)
    line += " --allow " + quoted(options.confined_to[i].string());
  for (const std::string& assignment : options.assignments) line += " --set " + in_quotation_marks(assignment);
  if (options.partners.any() && !options.journal)
    line += "  # without what came from outside: --journal FILE records it";
  else if ((options.interactive || options.tcl) && !options.journal)
    line += "  # without the prompt's commands: --journal FILE records them";
  return line;
}

void ScenarioArguments::add_file(Command& command) {
  command.argument("SCENARIO", file, "the scenario file", Command::Presence::required);
}

void ScenarioArguments::add_set(Command& command) {
  command.repeated("--set", assignments, "KEY=VALUE",
                   "override a value of the scenario; may be repeated. KEY is keys joined by dots,\n"
                   "elements of lists by their index from 0 or their name; VALUE is YAML. A file\n"
                   "named here is relative to the current directory. For example:\n"
                   "  robots.0.goals=[[1,2],[3,4]]\n"
                   "  robot_types.rackham.modules.segloc.enabled=false");
  confinement.add(command);
}

RunArguments::RunArguments(CommandLine& line)
    : command_(line.add_command("run", "Simulates a scenario and prints a summary with the digest.")) {
  scenario_.add_file(command_);
  command_.option("--seed", seed_, "N",
                  "seed of the random streams and of the seeded order (default:\n$WAITPOINT_SEED, or 1)");
  command_.option("--seeds", seeds_, "A..B",
                  "run each seed from A to B and print a row for each; of the output files\nonly --summary is allowed, "
                  "for all runs");
  command_.option("--jobs", jobs_, "N", "with --seeds: make N runs at once, each in a process of its own (default: 1)");
  command_.option("--ranks", ranks_, "N",
                  "divide the robots among N processes, started by mpirun of Open MPI, also on\n"
                  "other hosts: mpirun ... waitpoint run ...; the run and its digest are the same");
  command_.option("--play", play_, "BAG",
                  "publish the topics of this bag to the scenario's nodes of ROS at their times, with\n"
                  "no world: play.bag of the scenario (docs/ros-bags.md)");
  command_.option("--order", order_, "fifo|seeded",
                  "order of events of one instant: fifo, or seeded: by hashes of the seed\n(default: fifo)");
  command_.option("--until", until_, "S", "end at virtual time S, in seconds (default: the scenario's until_s)");
  command_.option("--speed", speed_, "X", "throttle to X simulated seconds per second; 0: unthrottled (default: 0)");
  command_.option("--watchdog", watchdog_, "S",
                  "report a task that reaches no event for S seconds of the wall clock, and end\n"
                  "the run after six times that; 0: never (default: 10)");
  command_.option("--idle", idle_, "S",
                  "at the end, list tasks that have waited without a timeout for S seconds of\n"
                  "virtual time; 0: none (default: 60)");
  command_.flag("--brief", is_brief_,
                "with nodes of ROS: end the run when an expectation cannot be met any more, and\n"
                "kill nodes at its end, as in waitpoint explore");
  command_.flag("--interactive", interactive_,
                "read commands from standard input: step, stop at a time or a condition, change\n"
                "the speed, send requests, move robots and obstacles; help lists them");
  command_.flag("--tcl", tcl_,
                "read commands in Tcl from standard input, for the first robot's modules\n(docs/laas-tcl.md)");
  command_.repeated("--external", partners_.external, "'ROBOT=ADDRESS [KEY=VALUE ...]'",
                    "move this robot's body by position reports from a process outside, which\n"
                    "connects to unix:PATH or tcp:PORT of the loopback; needs --speed 1; may be\n"
                    "repeated. KEY: between, jump_m, silent_s, late_s (docs/external.md)");
  command_.option("--serve-world", partners_.serve_world, "ADDRESS",
                  "serve base and lasers of robots without modules to software in other processes\n"
                  "at unix:PATH or tcp:PORT of the loopback; needs --speed 1 (docs/external.md)");
  command_.flag("--outside-faults-end", partners_.faults_end,
                "end the run, with status 1, at the first fault of a process outside");
  command_.option_or_flag("--serve", serve_, "ADDRESS:PORT", free_port,
                          "show the run in a browser, also after its end, until Ctrl-C: at this address, or\n"
                          "at a free port of the loopback, which is printed (docs/view.md)");
  command_.flag("--serve-control", serve_control_,
                "viewers may pause and pace the run, and try in branches what interventions do");
  command_.option("--journal", journal_, "FILE",
                  "write the interventions of the prompt, shell and outside with their virtual times");
  command_.option("--replay-journal", replay_journal_, "FILE",
                  "repeat the interventions of a journal and verify that the run ends with its\ndigest");
  add_outputs();
  command_.flag("--check", check_,
                "run twice in this process and once in a perturbed one (addresses,\n"
                "memory, environment, clocks, directories) and compare event by event:\n"
                "report the first difference, with status 1, or none\n"
                "(docs/determinism.md)");
  scenario_.add_set(command_);
}

void RunArguments::add_outputs() {
  command_.option("--summary", summary_, "FILE.json",
                  "write the summary as JSON; -: to standard output, in place of the text");
  command_.json(json_);
  command_.option("--picture", picture_, "FILE.svg", "draw the floor and the paths");
  command_.option("--page", page_, "FILE.html",
                  "write a page for browsers that shows the run: floor, timeline of tasks, plots,\n"
                  "modules; one file, which needs no network (docs/view.md)");
  command_.option("--trajectory", trajectory_, "FILE.tum",
                  "write the paths in TUM format: the true one to FILE.tum, the others to\n"
                  "FILE.estimated.tum and FILE.odometry.tum; several robots: with their names");
  command_.option("--record", record_, "FILE.mcap",
                  "write scans, poses, frames, requests and the world over time for Foxglove; as\n"
                  "FILE.bag a ROS 1 bag, as FILE.log a log for CARMEN's tools");
  command_.option("--digests", digests_, "FILE", "write a digest per robot and simulated second");
  command_.option("--events", events_, "FILE", "write every event as a line of text");
  command_.option("--decisions", decisions_, "FILE",
                  "write every decision of the robots' execution control as a line of text\n"
                  "(docs/laas-control.md)");
  command_.option("--record-durations", record_durations_, "FILE",
                  "write the durations that local clocks measured, counted or drew (docs/clocks.md)");
  command_.option(
      "--replay-durations", replay_durations_, "FILE",
      "take these durations from a record of the same scenario and seed; the run and\nits digest are the same");
}

/// Options that concern a single run are not allowed for many runs.
void RunArguments::check_of_many(const char* option) const {
  if (interactive_) throw BadInput(option, "cannot be used together with --interactive");
  if (tcl_) throw BadInput(option, "cannot be used together with --tcl");
  if (partners_.any()) throw BadInput(option, std::string("cannot be used together with ") + partners_.name());
  check_not_together(option, {{"--journal", journal_},
                              {"--replay-journal", replay_journal_},
                              {"--picture", picture_},
                              {"--page", page_},
                              {"--trajectory", trajectory_},
                              {"--record", record_},
                              {"--digests", digests_},
                              {"--events", events_},
                              {"--decisions", decisions_},
                              {"--record-durations", record_durations_}});
}

// A run in one process can be viewed, once.
void RunArguments::take_served(RunOptions& options) const {
  if (serve_.empty()) {
    if (serve_control_) throw BadInput("--serve-control", "expected --serve, whose viewers it concerns");
    return;
  }
  check_not_together("--serve", {{"--seeds", seeds_},
                                 {"--ranks", ranks_},
                                 {"--replay-durations", replay_durations_},
                                 {"--record-durations", record_durations_}});
  if (check_) throw BadInput("--serve", "cannot be used together with --check");
  if (partners_.any())
    throw BadInput("--serve", std::string("cannot be used together with ") + partners_.name() +
                                  ": what is outside has no past to go back to");
  options.serve = serve_ == free_port ? "" : serve_;
  options.serve_control = serve_control_;
}

/// A self-check compares runs and writes no files.
void RunArguments::check_writes_nothing() const {
  check_not_together("--check", {{"--seeds", seeds_}, {"--speed", speed_}, {"--summary", summary_}});
  check_of_many("--check");
}

/// A range of seeds makes many runs, for which only one summary is written.
void RunArguments::check_alone() const {
  check_not_together("--seeds", {{"--seed", seed_}, {"--replay-durations", replay_durations_}});
  check_of_many("--seeds");
}

/// Takes --json, too: standard output is for the document alone, and not for who asks for commands there.
void RunArguments::check_outputs(RunOptions& options) const {
  check_files(options, {});
  if (options.record_durations && options.replay_durations)
    throw BadInput("--record-durations", "cannot be used together with --replay-durations");
  if (!json_) return;
  if (interactive_) throw BadInput("--json", "cannot be used together with --interactive");
  if (tcl_) throw BadInput("--json", "cannot be used together with --tcl");
  check_beside_json(files_of(options, {}));
  options.json = true;
}

/// What is measured, compared or written per process is not there for several.
void RunArguments::check_for_ranks() const {
  check_not_together("--ranks", {{"--seeds", seeds_},
                                 {"--decisions", decisions_},
                                 {"--page", page_},
                                 {"--record-durations", record_durations_},
                                 {"--replay-durations", replay_durations_}});
  if (check_) throw BadInput("--ranks", "cannot be used together with --check");
  if (partners_.any())
    throw BadInput(partners_.name(), "cannot be used together with --ranks: processes outside meet one process");
}

/// What is outside lives in real time, and takes part once.
void RunArguments::check_partners(double speed) const {
  if (!partners_.any()) {
    if (partners_.faults_end)
      throw BadInput("--outside-faults-end", "expected --external or --serve-world, whose faults they are");
    return;
  }
  if (speed != 1)
    refuse(partners_.name(), "--speed 1: processes outside live in real time",
           speed_.empty() ? "a run as fast as possible" : speed_);
  if (!replay_journal_.empty())
    throw BadInput(partners_.name(),
                   "cannot be used together with --replay-journal, which repeats what came from outside");
}

RunOptions RunArguments::options() const {
  RunOptions options;
  options.scenario = find_scenario(scenario_.file);
  options.confined_to = scenario_.confinement.folders(options.scenario);
  options.assignments = scenario_.assignments;
  if (!play_.empty()) options.assignments.push_back("play.bag=" + in_quotation_marks_of_yaml(play_));
  const char* const environment = std::getenv("WAITPOINT_SEED");
  if (!seed_.empty()) {
    options.seed = seed_of("--seed", seed_);
  } else if (environment != nullptr && *environment != '\0') {
    options.seed = seed_of("WAITPOINT_SEED", environment);
  }
  options.check = check_;
  if (options.check) check_writes_nothing();
  if (!seeds_.empty()) {
    check_alone();
    options.seeds = seed_range_of("--seeds", seeds_);
  }
  if (order_ == "seeded") {
    options.order = kernel::Order::seeded;
  } else if (!order_.empty() && order_ != "fifo") {
    refuse("--order", "fifo or seeded", order_);
  }
  constexpr std::uint32_t jobs_max = 1024;
  if (!jobs_.empty() && (!parse_number(jobs_, options.jobs) || options.jobs < 1 || options.jobs > jobs_max))
    refuse("--jobs", "a whole number from 1 to 1024", jobs_);
  if (!jobs_.empty() && seeds_.empty()) throw BadInput("--jobs", "expected --seeds, whose runs it makes at once");
  constexpr int ranks_max = 4096;
  if (!ranks_.empty() && (!parse_number(ranks_, options.ranks) || options.ranks < 1 || options.ranks > ranks_max))
    refuse("--ranks", "a whole number from 1 to 4096", ranks_);
  if (options.ranks > 1) check_for_ranks();
  options.until = positive_seconds("--until", until_);
  if (!speed_.empty() && (!parse_number(speed_, options.speed) || !is_speed(options.speed)))
    refuse("--speed", speeds, speed_);
  check_partners(options.speed);
  options.partners = partners_;
  if (!watchdog_.empty() &&
      (!parse_number(watchdog_, options.watchdog_s) || !(options.watchdog_s >= 0 && options.watchdog_s <= 1e6)))
    refuse("--watchdog", "seconds from 0 to 1000000", watchdog_);
  if (!idle_.empty()) options.idle = idle_ == "0" ? Duration() : *positive_seconds("--idle", idle_);
  const auto file = [](const std::string& name) {
    return name.empty() ? std::nullopt : std::optional<std::filesystem::path>(name);
  };
  take_served(options);
  options.is_brief = is_brief_;
  options.interactive = interactive_;
  options.tcl = tcl_;
  if (tcl_ && interactive_) throw BadInput("--tcl", "cannot be used together with --interactive");
  options.journal = file(journal_);
  options.replay_journal = file(replay_journal_);
  if ((options.interactive || options.tcl) && options.replay_journal)
    throw BadInput("--replay-journal",
                   std::string("cannot be used together with --") + (options.tcl ? "tcl" : "interactive"));
  check_picture(picture_);
  if (is_standard_output(trajectory_))
    refuse("--trajectory", "a name that ends in .tum: it writes three files", trajectory_);
  options.summary = file(summary_);
  options.picture = file(picture_);
  options.page = file(page_);
  options.trajectory = file(trajectory_);
  options.record = file(record_);
  options.digests = file(digests_);
  options.decisions = file(decisions_);
  options.events = file(events_);
  options.record_durations = file(record_durations_);
  options.replay_durations = file(replay_durations_);
  check_outputs(options);
  return options;
}

}  // namespace waitpoint::tools
