// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/runs/explore_options.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "core/error.hpp"
#include "core/nearest_name.hpp"
#include "core/number_text.hpp"
#include "fibers/explore/schedules/token.hpp"
#include "fibers/explore/strategies/factory.hpp"
#include "modules/run/expectation.hpp"
#include "modules/scenario/scenario.hpp"
#include "tools/command/distinct_files.hpp"
#include "tools/command/installed_part.hpp"
#include "tools/command/option_values.hpp"

namespace waitpoint::tools {
namespace {

constexpr std::uint32_t jobs_max = 1024, snapshots_max = 1000;
constexpr const char* free_port = "a free port";

/// As alternatives of a type: "portfolio|fifo|...".
std::string all_strategies() {
  std::string names;
  for (const char c : exploration::strategy_names())
    if (c != ' ') names += c == ',' ? '|' : c;
  return names;
}

/// The option's text, else the environment variable's; `where` becomes the name of the source used.
std::string text_of(const std::string& option, const char* variable, std::string& where) {
  if (!option.empty()) return option;
  const char* const value = std::getenv(variable);
  if (value == nullptr) return "";
  where = variable;
  return value;
}

template <class Number>
void take(std::string where, const char* variable, const std::string& option, const char* expected, Number least,
          Number& number) {
  const std::string text = text_of(option, variable, where);
  if (text.empty()) return;
  if (!parse_number(text, number) || !(number >= least)) refuse(where, expected, text);
}

Shard shard_of(const std::string& text) {
  Shard shard;
  const std::size_t slash = text.find('/');
  const bool good = slash != std::string::npos && parse_number(std::string_view(text).substr(0, slash), shard.index) &&
                    parse_number(std::string_view(text).substr(slash + 1), shard.count) && shard.index >= 1 &&
                    shard.index <= shard.count;
  if (!good) refuse("--shard", "I/N with 1 <= I <= N", text);
  return shard;
}

constexpr std::string_view topic_mark = "topic:";

/// The --set assignment for all properties of topics: a list.
std::string assignment_of_topics(const std::vector<std::string>& properties) {
  std::string list;
  for (const std::string& property : properties) {
    if (!property.starts_with(topic_mark)) continue;
    const std::string text = property.substr(topic_mark.size());
    scenario::TopicExpectation ignored;
    if (!scenario::parse(text, ignored))
      throw BadInput("--property " + property, scenario::topic_expectation_words(text));
    list += (list.empty() ? "\"" : ", \"") + text + "\"";
  }
  return list.empty() ? "" : "expect.topics=[" + list + "]";
}

/// The --set assignment for this property.
std::string assignment_of(const std::string& property) {
  const std::string option = "--property " + property;
  const std::size_t equals = property.find('=');
  if (equals == std::string::npos || equals == 0) throw BadInput(option, "expected key=value");
  const std::string key = property.substr(0, equals);
  const auto known = scenario::expectation_keys();
  if (std::find(known.begin(), known.end(), key) == known.end()) {
    std::string all;
    for (const std::string_view name : known) all.append(all.empty() ? "" : ", ").append(name);
    throw BadInput(option, "unknown key '" + key + "'" + did_you_mean(key, known) + "; there are " + all);
  }
  const std::string value = property.substr(equals + 1);
  std::uint64_t count = 0;
  double length_m = 0;
  if (key == "position_error_max_m" && (!parse_number(value, length_m) || !(length_m > 0)))
    refuse(option, "a positive number of metres", value);
  if (key == "service_call_max_s" && (!parse_number(value, length_m) || !(length_m >= 0)))
    refuse(option, "a number of seconds", value);
  if ((key == "collisions" || key == "node_failures") && !parse_number(value, count))
    refuse(option, "a whole number", value);
  if (key == "goals_reached" && value != "all" && !parse_number(value, count))
    refuse(option, "a whole number or all", value);
  return "expect." + property;
}

Races races_of(const std::string& option) {
  std::string where = "--races";
  const std::string text = text_of(option, "WAITPOINT_RACES", where);
  const std::optional<Races> meant = races_named(text.empty() ? "report" : text);
  if (!meant) refuse(where, races_words, text);
  return *meant;
}

SwitchAt switch_at_named(const std::string& option) {
  std::string where = "--switch-at";
  const std::string text = text_of(option, "WAITPOINT_SWITCH_AT", where);
  if (text == "calls") return SwitchAt::calls;
  if (text == "accesses") return SwitchAt::accesses;
  if (!text.empty() && text != "auto") refuse(where, "auto, calls or accesses", text);
  return SwitchAt::automatic;
}

Memory memory_of(const std::string& option) {
  std::string where = "--memory";
  const std::string text = text_of(option, "WAITPOINT_MEMORY", where);
  const std::optional<Memory> meant = memory_named(text.empty() ? "sc" : text);
  if (!meant) refuse(where, memory_words, text);
  return *meant;
}

std::optional<std::filesystem::path> file(const std::string& name) {
  return name.empty() ? std::nullopt : std::optional<std::filesystem::path>(name);
}

}  // namespace

ExploreArguments::ExploreArguments(CommandLine& line)
    : command_(line.add_command("explore",
                                "Runs a scenario or a program under many schedules and reports the first failure.")) {
  command_.argument("SCENARIO", scenario_, "the scenario file", Command::Presence::optional);
  command_.flag("--exec", is_program_,
                "explore a program, run as by `waitpoint exec`, instead of a scenario (docs/exec.md):\n"
                "  waitpoint explore --exec [OPTIONS] -- PROGRAM [ARGUMENTS...]\n"
                "failures: a nonzero exit status, a signal, a deadlock or a lack of progress");
  command_.option("--strategy", strategy_, all_strategies().c_str(),
                  "strategy that draws the schedules (default: $WAITPOINT_STRATEGY, or portfolio); those\n"
                  "that enumerate them, for programs alone: bounded:K, dfs and dpor");
  command_.option(
      "--iterations", iterations_, "N",
      "maximum number of schedules (default: $WAITPOINT_ITERATIONS, or 1000, or\nunlimited with a time limit)");
  command_.option("--time-limit", time_limit_, "SECONDS",
                  "start no schedule after this wall clock time (default: $WAITPOINT_TIME_LIMIT,\nor unlimited)");
  command_.option("--schedule-limit", schedule_limit_, "SECONDS",
                  "fail a schedule that takes longer, by the wall clock; 0: unlimited (default:\n"
                  "$WAITPOINT_SCHEDULE_LIMIT, or 60 s plus ten times the default order's time)");
  command_.option("--jobs", jobs_, "J", "number of processes to run at once (default: 1)");
  command_.option("--seed", seed_, "N", "seed of all schedules and noise (default: $WAITPOINT_SEED, or 1)");
  command_.repeated("--property", properties_, "KEY=VALUE",
                    "expectation of every run, overriding the scenario's `expect`; may be repeated:\n"
                    "goals_reached, collisions, position_error_max_m; with nodes of ROS also node_failures,\n"
                    "the most nodes that may die (default: 0); service_call_max_s, the longest call of a\n"
                    "service (10); tests=passed, of the launch files; and topic:/TOPIC.FIELD<=NUMBER, of each\n"
                    "message, with >=, <= or == (docs/ros.md)");
  command_.option("--until", until_, "S", "end runs at virtual time S, in seconds (default: the scenario's until_s)");
  command_.option("--from", from_, "S",
                  "share one run in the default order up to virtual time S, in seconds (default: 0)");
  command_.repeated("--set", assignments_, "KEY=VALUE", "override a value of the scenario, as in waitpoint run");
  confinement_.add(command_);
  command_.option("--shard", shard_, "I/N",
                  "run every N-th schedule from the I-th on, to split a search among machines");
  command_.option("--results", results_, "FILE", "run all schedules, and write number, digest and outcome of each");
  command_.option("--replay", replay_, "TOKEN|FILE", "run only this schedule (default: $WAITPOINT_REPLAY)");
  command_.option("--schedule", schedule_, "FILE", "write the failing schedule, minimised, for --replay");
  command_.option("--trace", trace_, "FILE.json",
                  "write the last seconds before the failure as a trace for Chrome and Perfetto");
  command_.option("--page", page_, "FILE.html",
                  "write the failing schedule beside the nearest passing one as a page for browsers, which opens\n"
                  "offline (docs/view.md)");
  command_.json(json_);
  command_.option("--finding", finding_, "FILE.json", "write the same as data, for `waitpoint view`");
  command_.option_or_flag("--serve", serve_, "ADDRESS:PORT", free_port,
                          "show the search and its finding in a browser, until Ctrl-C: at this address, or at a\n"
                          "free port of the loopback; the page's address is printed (docs/view.md)");
  command_.option("--races", races_, "report|fail|ignore",
                  "data races of a program compiled with -fsanitize=thread (default: $WAITPOINT_RACES, or\n"
                  "report): failures, each reported once, that do not end the search; failures like any\n"
                  "other, the first of which ends it; or no failures");
  command_.option("--switch-at", switch_at_, "auto|calls|accesses",
                  "switch points of a program (default: $WAITPOINT_SWITCH_AT, or auto): simulated\n"
                  "calls; accesses to shared memory, too, as always with -fsanitize=thread; or, after\n"
                  "twenty schedules at calls, ten of each in turn, where that is possible");
  command_.option("--memory", memory_, "sc|weak",
                  "memory of a program compiled with -fsanitize=thread (default: $WAITPOINT_MEMORY, or sc):\n"
                  "atomic loads return the newest value; or, as C++20 allows for their memory orders, older\n"
                  "ones, too");
  command_.flag("--fork-each", forks_each_,
                "of a program: a process of its own for each schedule (default: most schedules are run\n"
                "by a process whose memory is put back to its state before main())");
  command_.option("--snapshots", snapshots_, "N",
                  "of a program: keep at most N stopped copies of its runs, in which schedules with the same\n"
                  "choices up to there begin; for each of the jobs (default: 0)");
  conditions_.add_to(command_);
  command_.repeated("--external", external_, "ROBOT=ADDRESS",
                    "rejected: processes outside take part in paced runs only");
  command_.option("--serve-world", serve_world_, "ADDRESS", "rejected, likewise");
  command_.flag("--no-minimize", keep_all_, "report the failure as found, without minimisation");
  command_.footer(
      "Exit status: 0 no failure found, 1 failure found, 2 bad input, 130 stopped by a signal, after a report of the\n"
      "schedules run. See docs/exploring-scenarios.md.");
}

// These options need a scenario.
void ExploreArguments::check_program() const {
  if (!scenario_.empty())
    throw BadInput("explore",
                   "expected '--' between --exec and the program, or no --exec with the scenario '" + scenario_ + "'");
  if (!from_.empty()) throw BadInput("--from", "cannot be used together with --exec");
  if (!assignments_.empty()) throw BadInput("--set", "cannot be used together with --exec");
  if (!properties_.empty()) throw BadInput("--property", "cannot be used together with --exec");
}

void ExploreArguments::check_exhaustive(const std::string& where, const ExploreOptions& options) const {
  if (!is_program_)
    refuse(where, "a strategy that draws its schedules (a scenario has too many for an exhaustive search)",
           options.strategy);
  for (const auto& [name, value] : {std::pair<const char*, const std::string&>{"--jobs", jobs_}, {"--shard", shard_}})
    if (!value.empty())
      throw BadInput(name, "cannot be used together with " + options.strategy +
                               ", which derives each schedule from the one before");
}

void ExploreArguments::take_program_options(ExploreOptions& options) const {
  for (const auto& [name, is_given] : {std::pair<const char*, bool>{"--races", !races_.empty()},
                                       {"--switch-at", !switch_at_.empty()},
                                       {"--memory", !memory_.empty()},
                                       {"--fork-each", forks_each_},
                                       {"--snapshots", !snapshots_.empty()}})
    if (is_given && !is_program_) throw BadInput(name, "expected --exec and a program");
  options.races = races_of(races_);
  options.switch_at = switch_at_named(switch_at_);
  if (is_program_) options.memory = memory_of(memory_);
  options.forks_each = forks_each_;
  if (!snapshots_.empty() && (!parse_number(snapshots_, options.snapshots) || options.snapshots > snapshots_max))
    refuse("--snapshots", "a whole number from 0 to " + std::to_string(snapshots_max), snapshots_);
}

void ExploreArguments::take_outputs(ExploreOptions& options) const {
  const bool is_file = !replay_.empty() && !exploration::is_token(replay_);
  const std::vector<NamedFile> files = {
      {"--results", results_}, {"--schedule", schedule_}, {"--trace", trace_},
      {"--page", page_},       {"--finding", finding_},   {"--replay", is_file ? replay_ : "", NamedFile::Use::read}};
  check_distinct(files);
  if (json_) check_beside_json(files);
  options.results = file(results_);
  options.trace = file(trace_);
  options.page = file(page_);
  options.finding = file(finding_);
  if (!serve_.empty()) options.serve = serve_ == free_port ? "" : serve_;
  options.schedule = file(schedule_);
  options.json = json_;
}

ExploreOptions ExploreArguments::options(const std::vector<std::string>& words) const {
  ExploreOptions options;
  for (const auto& [name, is_given] :
       {std::pair<const char*, bool>{"--external", !external_.empty()}, {"--serve-world", !serve_world_.empty()}})
    if (is_given)
      throw BadInput(
          name, "expected waitpoint run: processes outside live in real time, in which schedules are not explored");
  if (is_program_) {
    check_program();
    if (words.empty())
      throw BadInput("explore", "expected a program: waitpoint explore --exec [OPTIONS] -- PROGRAM [ARGUMENTS...]");
    if (confinement_.is_confined) throw BadInput("--confined", "expected a scenario, not --exec");
    options.program = words;
    options.conditions = conditions_.conditions(true);
  } else if (scenario_.empty()) {
    throw BadInput("explore", "expected a scenario's file, or --exec and a program");
  } else if (const std::string given = conditions_.first_given(); !given.empty()) {
    throw BadInput(given, "expected --exec and a program: for a scenario, its file sets this");
  }
  options.scenario = find_scenario(scenario_);
  options.confined_to = confinement_.folders(options.scenario);
  options.assignments = assignments_;
  options.sets = assignments_.size();
  options.properties = properties_;
  for (const std::string& property : properties_)
    if (!property.starts_with(topic_mark)) options.assignments.push_back(assignment_of(property));
  if (std::string topics = assignment_of_topics(properties_); !topics.empty())
    options.assignments.push_back(std::move(topics));
  std::string where = "--strategy";
  if (const std::string strategy = text_of(strategy_, "WAITPOINT_STRATEGY", where); !strategy.empty())
    options.strategy = strategy;
  const exploration::Kinds kinds = is_program_ ? exploration::Kinds::all : exploration::Kinds::drawing;
  if (exploration::make_strategy(options.strategy, kinds)->is_exhaustive()) check_exhaustive(where, options);
  take("--time-limit", "WAITPOINT_TIME_LIMIT", time_limit_,
       "a positive number of seconds (omit the option for no limit)", std::numeric_limits<double>::min(),
       options.time_limit_s);
  double schedule_limit_s = -1;
  take("--schedule-limit", "WAITPOINT_SCHEDULE_LIMIT", schedule_limit_, "a number of seconds, 0 for no limit", 0.0,
       schedule_limit_s);
  if (schedule_limit_s >= 0) options.schedule_limit_s = schedule_limit_s;
  if (options.time_limit_s > 0) options.iterations = ~std::uint64_t{0};
  take<std::uint64_t>("--iterations", "WAITPOINT_ITERATIONS", iterations_, "a positive whole number", 1,
                      options.iterations);
  take<std::uint64_t>("--seed", "WAITPOINT_SEED", seed_, "a whole number from 0 to 2^64 - 1", 0, options.seed);
  where = "--seed";
  options.seed_is_asked = !text_of(seed_, "WAITPOINT_SEED", where).empty();
  if (!jobs_.empty() && (!parse_number(jobs_, options.jobs) || options.jobs < 1 || options.jobs > jobs_max))
    refuse("--jobs", "a whole number from 1 to " + std::to_string(jobs_max), jobs_);
  take_program_options(options);
  if (const auto until = positive_seconds("--until", until_)) options.until = Time() + *until;
  options.from = positive_seconds("--from", from_);
  if (options.from && Time() + *options.from >= options.until) refuse("--from", "a time before --until", from_);
  if (!shard_.empty()) options.shard = shard_of(shard_);
  take_outputs(options);
  options.minimize = !keep_all_;
  where = "--replay";
  options.replay = text_of(replay_, "WAITPOINT_REPLAY", where);
  if (options.replay.empty()) return options;
  if (exploration::is_token(options.replay)) (void)exploration::read_token(options.replay);
  for (const auto& [name, value] : {std::pair<const char*, const std::string&>{"--shard", shard_},
                                    {"--results", results_},
                                    {"--jobs", jobs_},
                                    {"--strategy", strategy_},
                                    {"--schedule", schedule_},
                                    {"--page", page_},
                                    {"--finding", finding_},
                                    {"--serve", serve_}})
    if (!value.empty()) throw BadInput(where, std::string("cannot be used together with ") + name);
  return options;
}

}  // namespace waitpoint::tools
