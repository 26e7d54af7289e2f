// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/runs/explore_options.hpp"

#include <unistd.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "core/error.hpp"
#include "core/nearest_name.hpp"
#include "core/number_text.hpp"
#include "fibers/explore/schedules/token.hpp"
#include "fibers/explore/strategies/factory.hpp"
#include "modules/run/expectation.hpp"
#include "modules/scenario/scenario.hpp"
#include "tools/command/option_values.hpp"
#include "tools/command/options/schedule.hpp"
#include "tools/command/options/time_limits.hpp"
#include "tools/command/shell_words.hpp"

namespace waitpoint::tools {
namespace {

constexpr std::uint32_t snapshots_max = 1000, observed_max = 1'000'000;

/// A strategy is checked once it is known whether there is a program.
OptionValue strategy_value(std::string& into) {
  OptionValue value = text(into, "NAME");
  std::string names;
  for (const char c : exploration::strategy_names() + ",")
    if (c == ',')
      value.words.push_back(std::exchange(names, {}));
    else if (c != ' ')
      names += c;
  return value;
}

OptionValue schedule_limit_value(std::optional<double>& into) {
  OptionValue value{.placeholder = "S"};
  value.take = [&into](const std::string& source, const std::string& text) {
    double limit_s = 0;
    number(limit_s, 0, std::numeric_limits<double>::max(), "S", "a number of seconds, 0 for no limit")
        .take(source, text);
    into = limit_s;
  };
  return value;
}

OptionValue replay_value(std::string& into) {
  OptionValue value{.placeholder = "TOKEN|FILE", .file = OptionValue::File::read};
  value.take = [&into](const std::string&, const std::string& text) {
    if (exploration::is_token(text)) (void)exploration::read_token(text);
    into = text;
  };
  value.files = [](const std::string& text) {
    return exploration::is_token(text) ? std::vector<std::string>() : std::vector{text};
  };
  return value;
}

OptionValue shard_value(Shard& into) {
  OptionValue value{.placeholder = "I/N"};
  value.take = [&into](const std::string& source, const std::string& text) {
    const std::size_t slash = text.find('/');
    const bool is_good = slash != std::string::npos &&
                         parse_number(std::string_view(text).substr(0, slash), into.index) &&
                         parse_number(std::string_view(text).substr(slash + 1), into.count) && into.index >= 1 &&
                         into.index <= into.count;
    if (!is_good) refuse(source, "I/N with 1 <= I <= N", text);
  };
  return value;
}

/// A word, behind `accesses` with the names of libraries.
OptionValue switch_at_value(ExploreOptions& options) {
  OptionValue value = word<SwitchAt>(
      options.switch_at, {{"auto", SwitchAt::automatic}, {"calls", SwitchAt::calls}, {"accesses", SwitchAt::accesses}});
  value.placeholder = "auto|calls|accesses[:LIBRARY,...]";
  value.take = [&options, take = std::move(value.take)](const std::string& source, const std::string& text) {
    constexpr std::string_view mark = "accesses:";
    const bool has_names = text.starts_with(mark);
    take(source, has_names ? "accesses" : text);
    options.libraries.clear();
    if (!has_names) return;
    for (std::size_t at = mark.size(); at <= text.size();) {
      const std::size_t end = std::min(text.size(), text.find(',', at));
      options.libraries.push_back(text.substr(at, end - at));
      if (options.libraries.back().empty()) refuse(source, "names of libraries, separated by commas", text);
      at = end + 1;
    }
  };
  return value;
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

void declare_search(Command& command, ExploreOptions& options) {
  declare_seed(command, options.seed, "seed of all schedules and noise");
  command.add("--strategy", strategy_value(options.strategy), "how schedules are drawn; --help-all lists them",
              {.usual = "portfolio",
               .environment = "WAITPOINT_STRATEGY",
               .more = "One of " + exploration::strategy_names() +
                       "; bounded:K, dfs and dpor enumerate the schedules, of programs alone."});
  command.add(
      "--property", texts(options.properties, "KEY=VALUE"),
      "an expectation of every run, overriding the scenario's; may be repeated",
      {.more = "goals_reached, collisions, position_error_max_m; with nodes of ROS also node_failures, the most "
               "nodes that may die (default: 0); service_call_max_s, the longest call of a service (10); "
               "tests=passed, of the launch files; and topic:/TOPIC.FIELD<=NUMBER, of each message, with >=, "
               "<= or == (docs/ros.md)."});
  command.section("Extent of the search");
  command.add("--iterations", whole(options.iterations, std::uint64_t{1}, ~std::uint64_t{0}), "the most schedules",
              {.usual = "1000, or unlimited with a time limit", .environment = "WAITPOINT_ITERATIONS"});
  command.add("--time-limit",
              number(options.time_limit_s, std::numeric_limits<double>::min(), std::numeric_limits<double>::max(), "S",
                     "a positive number of seconds (omit the option for no limit)"),
              "the most wall clock time, with the report",
              {.usual = "unlimited", .environment = "WAITPOINT_TIME_LIMIT"});
  command.add("--schedule-limit", schedule_limit_value(options.schedule_limit_s),
              "fail a schedule that takes longer, by the wall clock; 0: unlimited",
              {.usual = "60 s plus ten times the default order's time",
               .environment = "WAITPOINT_SCHEDULE_LIMIT",
               .is_rare = true});
  declare_jobs(command, options.jobs);
  command.add("--shard", shard_value(options.shard), "run every N-th schedule from the I-th on",
              {.more = "This splits a search among machines.", .is_rare = true});
  command.add("--from", seconds(options.from), "share one run in the default order up to virtual time S",
              {.usual = "0", .is_rare = true});
}

void declare_results(Command& command, ExploreOptions& options) {
  command.section("Results");
  command.json(options.json);
  command.add("--results", written_file(options.results, "FILE"),
              "run all schedules, and write number, digest and outcome of each", {.is_rare = true});
  command.add("--schedule", written_file(options.schedule, "FILE"),
              "write the failing schedule, minimised, for --replay");
  command.add("--replay", replay_value(options.replay), "run only this schedule, of a token or a file",
              {.environment = "WAITPOINT_REPLAY"});
  declare_trace(command, options.trace, "write the last seconds before the failure for Chrome and Perfetto");
  declare_page(command, options.page, "write the failing schedule beside the nearest passing one (docs/view.md)");
  declare_serve(command, options.serve, "show the search and its finding in a browser");
  command.add("--finding", written_file(options.finding, "FILE.json"), "write the finding as data, for waitpoint view");
  command.add("--no-minimize", flag(options.keep_all), "report the failure as found", {.is_rare = true});
}

void declare_program(Command& command, ExploreOptions& options) {
  declare_conditions(command, options.conditions, Repetition::needed);
  command.section("Exploration of a program");
  command.add("--races",
              word<Races>(options.races, {{"report", Races::report}, {"fail", Races::fail}, {"ignore", Races::ignore}}),
              "data races, of programs compiled with -fsanitize=thread",
              {.usual = "report",
               .environment = "WAITPOINT_RACES",
               .more = "report: each is a failure, reported once, and the search goes on; fail: the first one ends the "
                       "search; ignore: none is a failure."});
  command.add("--switch-at", switch_at_value(options),
              "switch points of a program: its simulated calls, or accesses to shared memory, too",
              {.usual = "auto",
               .environment = "WAITPOINT_SWITCH_AT",
               .more = "Accesses are switch points in any case with -fsanitize=thread. auto: after twenty schedules at "
                       "calls, ten of each in turn, where that is possible; from the first on, if the threads wait by "
                       "futexes of their own, or call nothing that waits. accesses:LIBRARY: those of the library, too; "
                       "it is named as by the program, with or without its version, or by a path.",
               .is_rare = true});
  command.add("--observe", whole(options.observed, 0u, observed_max),
              "observe accesses to memory in N schedules before all orderings are said to be tried",
              {.usual = "20",
               .more = "If no call orders two accesses, it is not said. 0: none; the assumption is named.",
               .is_rare = true});
  command.add("--memory", word<Memory>(options.memory, {{"sc", Memory::sc}, {"weak", Memory::weak}}),
              "memory of a program compiled with -fsanitize=thread",
              {.usual = "sc",
               .environment = "WAITPOINT_MEMORY",
               .more = "sc: atomic loads return the newest value; weak: or older ones, as C++20 allows for their "
                       "memory orders.",
               .is_rare = true});
  command.add("--fork-each", flag(options.forks_each), "a process of its own for each schedule",
              {.more = "By default most schedules are run by a process whose memory is put back to its state before "
                       "main().",
               .is_rare = true});
  command.add("--snapshots", whole(options.snapshots, 0u, snapshots_max), "keep at most N stopped copies of its runs",
              {.usual = "0",
               .more = "Schedules with the same choices up to a copy begin in it. Each of the jobs has N.",
               .is_rare = true});
}

std::vector<Rule> rules_of_explore() {
  constexpr Rule::Kind excludes = Rule::Kind::excludes, needs = Rule::Kind::needs;
  std::vector<Rule> rules = {
      {"--replay",
       excludes,
       {"--shard", "--results", "--jobs", "--strategy", "--schedule", "--page", "--finding", "--serve"}},
  };
  for (const char* option : {"SCENARIO", "--set", "--property", "--from", "--confined"})
    rules.push_back({option, excludes, {"--"}});
  for (const char* option : {"--races", "--switch-at", "--observe", "--memory", "--fork-each", "--snapshots", "--clock",
                             "--call-cost", "--children", "--speed", "--idle-limit", "--own-machine", "--loss",
                             "--delay", "--isolate", "--trap-rdtsc", "--strict", "--trap-libc"})
    rules.push_back({option, needs, {"--"}, "not a scenario"});
  return rules;
}

/// An exhaustive strategy derives each schedule from the one before.
void check_strategy(const Command& command, const ExploreOptions& options) {
  const bool has_program = !options.program.empty();
  const exploration::Kinds kinds = has_program ? exploration::Kinds::all : exploration::Kinds::drawing;
  if (!exploration::make_strategy(options.strategy, kinds)->is_exhaustive()) return;
  if (!has_program)
    refuse("--strategy", "a strategy that draws its schedules (a scenario has too many for an exhaustive search)",
           options.strategy);
  for (const char* name : {"--jobs", "--shard"})
    if (command.is_given(name))
      throw BadInput(name, "cannot be used together with " + options.strategy +
                               ", which derives each schedule from the one before");
}

void finish(const Command& command, ExploreOptions& options, const std::optional<Duration>& until) {
  options.program = command.program();
  if (options.program.empty() && options.scenario.empty())
    throw BadInput("explore",
                   "expected a scenario or a program: waitpoint explore SCENARIO, or waitpoint explore -- "
                   "PROGRAM [ARGUMENTS ...]");
  if (!options.scenario.empty() && options.scenario.extension() != ".yaml" &&
      std::filesystem::is_regular_file(options.scenario) && access(options.scenario.c_str(), X_OK) == 0)
    throw BadInput("explore", "expected '--' before the program: waitpoint explore [OPTIONS] -- " +
                                  quoted(options.scenario.string()));
  options.sets = options.assignments.size();
  for (const std::string& property : options.properties)
    if (!property.starts_with(topic_mark)) options.assignments.push_back(assignment_of(property));
  if (std::string topics = assignment_of_topics(options.properties); !topics.empty())
    options.assignments.push_back(std::move(topics));
  check_strategy(command, options);
  options.minimize = !options.keep_all;
  if (options.program.empty()) options.memory = Memory::sc;  // $WAITPOINT_MEMORY is for programs
  options.seed_is_asked = command.has_value("--seed");
  if (options.time_limit_s > 0 && !command.has_value("--iterations")) options.iterations = ~std::uint64_t{0};
  if (until) options.until = Time() + *until;
  if (options.from && Time() + *options.from >= options.until)
    refuse("--from", "a time before --until", command.text("--from"));
}

}  // namespace

void declare(Command& command, ExploreOptions& options) {
  command.description = "Runs a scenario or a program under many schedules and reports the first failure.";
  command.examples = {"late-pom --property collisions=0 --page finding.html", "-- ./queue_test"};
  command.usages = {"[OPTIONS] SCENARIO", "[OPTIONS] -- PROGRAM [ARGUMENTS ...]"};
  command.takes_program = true;
  command.former_flags = {"--exec"};
  command.notes =
      "Failures of a program: a nonzero exit status, a signal, a deadlock, a lack of progress.\n"
      "Exit status: 0 no failure, 1 failure, 2 bad input, 3 no schedule ended, 130 stopped by a signal.";
  declare_scenario(command, options, ScenarioArgument::optional);
  declare_search(command, options);
  const auto until = std::make_shared<std::optional<Duration>>();
  declare_until(command, *until, "Extent of the search");
  declare_results(command, options);
  declare_program(command, options);
  for (Rule& rule : rules_of_explore()) command.rules.push_back(std::move(rule));
  command.finally([&command, &options, until] { finish(command, options, *until); });
}

}  // namespace waitpoint::tools
