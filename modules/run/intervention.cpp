// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/intervention.hpp"

#include <algorithm>

#include "core/nearest_name.hpp"
#include "core/number_text.hpp"
#include "modules/genom/settings.hpp"
#include "modules/scenario/shape_reader.hpp"
#include "modules/scenario/words.hpp"

namespace waitpoint::run {
namespace {

constexpr double height_default_m = 2;

using What = decltype(Intervention::what);

std::string require(std::string_view& text, const char* expected, const scenario::Location& written) {
  std::string word = scenario::take_word(text, written);
  if (word.empty()) throw written.bad(std::string("expected ") + expected);
  return word;
}

// In metres and degrees, as in a scenario.
Pose require_pose(std::string_view& text, const scenario::Location& written) {
  std::string list = "[";
  for (int i = 0; i < 3; ++i) {
    const std::string word = scenario::take_word(text, written);
    if (i == 2 && word.empty()) break;
    double number = 0;
    if (!parse_number(word, number)) throw written.bad("expected a place, X Y [HEADING_DEG], found '" + word + "'");
    list += (i == 0 ? "" : ", ") + word;
  }
  scenario::require_end(text, written);
  return scenario::read_pose(scenario::parse_yaml(list + "]", written.text(), false), "the place");
}

std::vector<Setting> parse_settings(std::string_view text, const scenario::Location& written) {
  std::vector<Setting> settings;
  for (std::string word = scenario::take_word(text, written); !word.empty();
       word = scenario::take_word(text, written)) {
    const std::size_t equals = word.find('=');
    if (equals == 0 || equals == std::string::npos) throw written.bad("expected FIELD=VALUE, found '" + word + "'");
    Setting setting{word.substr(0, equals), word.substr(equals + 1), written.file, written.line};
    const auto same = [&](const Setting& other) { return other.key == setting.key; };
    if (std::any_of(settings.begin(), settings.end(), same)) throw written.bad("'" + setting.key + "' is given twice");
    settings.push_back(std::move(setting));
  }
  return settings;
}

What parse_request(std::string_view text, const scenario::Location& written) {
  ModuleRequest request;
  request.robot = require(text, "a robot", written);
  request.module = require(text, "a module", written);
  request.request = require(text, "a request", written);
  request.arguments = parse_settings(text, written);
  return request;
}

What parse_move(std::string_view text, const scenario::Location& written) {
  std::string robot = require(text, "a robot", written);
  return RobotMove{std::move(robot), require_pose(text, written)};
}

What parse_obstacle(std::string_view text, const scenario::Location& written) {
  const scenario::YamlNode node = scenario::parse_yaml(std::string(scenario::trimmed(text)), written.text(), false);
  if (scenario::name_of(node).empty()) throw written.bad("expected {name: ..., ...}, a shape with a name");
  return ObstaclePut{scenario::read_obstacle(node, height_default_m, 1)};
}

What parse_obstacle_move(std::string_view text, const scenario::Location& written) {
  std::string name = require(text, "an obstacle", written);
  return ObstacleMove{std::move(name), require_pose(text, written)};
}

What parse_removal(std::string_view text, const scenario::Location& written) {
  ObstacleRemoval removal{require(text, "an obstacle", written)};
  scenario::require_end(text, written);
  return removal;
}

// At most a day: pushes are exerted by hand.
constexpr double force_n_max = 1e6, time_s_max = 86400;

What parse_push(std::string_view text, const scenario::Location& written) {
  Push push{require(text, "a robot or an obstacle", written), {}, {}};
  const auto number = [&](const char* expected, double low, double high) {
    const std::string word = scenario::take_word(text, written);
    double value = 0;
    if (!parse_number(word, value) || value < low || value > high)
      throw written.bad(std::string("expected ") + expected + ", found '" + word + "'");
    return value;
  };
  push.force_n.x = number("a force, FX_N FY_N, within 1000000 N", -force_n_max, force_n_max);
  push.force_n.y = number("a force, FX_N FY_N, within 1000000 N", -force_n_max, force_n_max);
  push.time = Duration::from_seconds(number("a time in seconds, at most 86400", 0, time_s_max));
  scenario::require_end(text, written);
  return push;
}

What parse_seed(std::string_view text, const scenario::Location& written) {
  const std::string word = require(text, "a seed", written);
  SeedChange change;
  if (!parse_number(word, change.seed)) throw written.bad("expected a seed from 0 to 2^64 - 1, found '" + word + "'");
  scenario::require_end(text, written);
  return change;
}

What parse_shell_command(std::string_view text, const scenario::Location& written) {
  ShellCommand command{require(text, "a robot", written), std::string(scenario::trimmed(text))};
  if (command.command.empty()) throw written.bad("expected a command in Tcl");
  constexpr std::string_view newline = ShellCommand::newline;
  for (std::size_t at = 0; (at = command.command.find(newline, at)) != std::string::npos; ++at)
    command.command.replace(at, newline.size(), "\n");
  return command;
}

What parse_external(std::string_view text, const scenario::Location& written) {
  ExternalDeclaration external{require(text, "a robot", written), {}};
  genom::Settings settings(parse_settings(text, written));
  settings.read(external.settings);
  settings.check_not_negative(external.settings);
  settings.check_all_used();
  if (const std::string& between = external.settings.between; between != "move" && between != "stay")
    settings.reject("between", "move or stay");
  return external;
}

What parse_report_of(std::string_view text, const scenario::Location& written) {
  std::string robot = require(text, "a robot", written);
  return ExternalReport{std::move(robot), parse_report(text, "date_s", written)};
}

What parse_command(std::string_view text, const scenario::Location& written) {
  DriveCommand command{require(text, "a robot", written), {}};
  genom::Settings settings(parse_settings(text, written));
  settings.read(command.velocity);
  settings.check_all_used();
  return command;
}

What parse_pose(std::string_view text, const scenario::Location& written) {
  PublishedPose published{require(text, "a robot", written), {}};
  genom::Settings settings(parse_settings(text, written));
  settings.read(published.pose);
  settings.check_all_used();
  return published;
}

What parse_goal_end(std::string_view text, const scenario::Location& written) {
  GoalEnd end{require(text, "a robot", written)};
  const std::string how = scenario::take_word(text, written);
  scenario::require_end(text, written);
  if (how != "reached" && how != "given-up") throw written.bad("expected reached or given-up, found '" + how + "'");
  end.is_reached = how == "reached";
  return end;
}

struct Verb {
  std::string_view name;
  What (*parse)(std::string_view text, const scenario::Location& written);
};

constexpr Verb verbs[] = {{"request", parse_request},
                          {"move", parse_move},
                          {"obstacle", parse_obstacle},
                          {"move-obstacle", parse_obstacle_move},
                          {"remove-obstacle", parse_removal},
                          {"push", parse_push},
                          {"seed", parse_seed},
                          {"tcl", parse_shell_command},
                          {"external", parse_external},
                          {"report", parse_report_of},
                          {"command", parse_command},
                          {"pose", parse_pose},
                          {"goal", parse_goal_end}};

}  // namespace

bool is_frequent(const Intervention& intervention) {
  return std::holds_alternative<ExternalReport>(intervention.what) ||
         std::holds_alternative<DriveCommand>(intervention.what) ||
         std::holds_alternative<PublishedPose>(intervention.what);
}

std::vector<std::string_view> intervention_verbs() {
  std::vector<std::string_view> names;
  for (const Verb& verb : verbs) names.push_back(verb.name);
  return names;
}

Intervention parse_intervention(std::string_view text, const scenario::Location& written) {
  // An intervention is one line of a journal.
  if (scenario::trimmed(text).find('\n') != std::string_view::npos) throw written.bad("expected one line");
  std::string_view rest = text;
  const std::string word = scenario::take_word(rest, written);
  for (const Verb& verb : verbs)
    if (verb.name == word) return {std::string(scenario::trimmed(text)), written, verb.parse(rest, written)};
  const std::string hint = did_you_mean(word, intervention_verbs());
  throw written.bad("unknown intervention '" + word + "'" +
                    (hint.empty()
                         ? ", expected request, move, obstacle, move-obstacle, remove-obstacle, push, seed, tcl, "
                           "external, report, command, pose or goal"
                         : hint));
}

}  // namespace waitpoint::run
