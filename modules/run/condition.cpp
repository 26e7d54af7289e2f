// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/condition.hpp"

#include <vector>

#include "core/nearest_name.hpp"
#include "core/number_text.hpp"
#include "modules/scenario/words.hpp"

namespace waitpoint::run {
namespace {

using Figure = double (*)(const bridge::Robot& robot, const world::BodyState& body);

struct NamedFigure {
  std::string_view name;
  Figure value;
};

constexpr NamedFigure figures[] = {
    {"goals",
     [](const bridge::Robot& robot, const world::BodyState&) { return static_cast<double>(robot.goals_reached()); }},
    {"collisions",
     [](const bridge::Robot&, const world::BodyState& body) { return static_cast<double>(body.collisions); }},
    {"travelled_m", [](const bridge::Robot&, const world::BodyState& body) { return body.travelled_m; }},
    {"x_m", [](const bridge::Robot&, const world::BodyState& body) { return body.pose.x; }},
    {"y_m", [](const bridge::Robot&, const world::BodyState& body) { return body.pose.y; }},
    {"stalled", [](const bridge::Robot&, const world::BodyState& body) { return body.stalled ? 1.0 : 0.0; }},
};

using Compare = bool (*)(double, double);

struct NamedComparison {
  std::string_view name;
  Compare holds;
};

// A name before its own prefixes.
constexpr NamedComparison comparisons[] = {
    {">=", [](double a, double b) { return a >= b; }}, {"<=", [](double a, double b) { return a <= b; }},
    {"==", [](double a, double b) { return a == b; }}, {">", [](double a, double b) { return a > b; }},
    {"<", [](double a, double b) { return a < b; }},
};

Figure figure_of(std::string_view name, const scenario::Location& written) {
  std::vector<std::string_view> known;
  for (const NamedFigure& figure : figures) {
    if (figure.name == name) return figure.value;
    known.push_back(figure.name);
  }
  throw written.bad("there is no figure '" + std::string(name) + "'" + did_you_mean(name, known));
}

}  // namespace

Condition parse_condition(std::string_view text, const Experiment& experiment, const scenario::Location& written) {
  const std::size_t at = text.find_first_of("<>=");
  const std::string_view left = scenario::trimmed(text.substr(0, at));
  const std::size_t dot = left.rfind('.');
  if (at == std::string_view::npos || dot == std::string_view::npos)
    throw written.bad("expected ROBOT.FIGURE >= NUMBER, found '" + std::string(scenario::trimmed(text)) + "'");
  Compare holds = nullptr;
  std::string_view right = text.substr(at);
  for (const NamedComparison& comparison : comparisons) {
    if (!right.starts_with(comparison.name)) continue;
    holds = comparison.holds;
    right = scenario::trimmed(right.substr(comparison.name.size()));
    break;
  }
  double number = 0;
  if (holds == nullptr || !parse_number(right, number))
    throw written.bad("expected a comparison with a number, found '" + std::string(scenario::trimmed(text.substr(at))) +
                      "'");
  const std::size_t robot = bridge::index_of(left.substr(0, dot), experiment.robots(), written);
  const Figure figure = figure_of(left.substr(dot + 1), written);
  return [&experiment, robot, figure, holds, number] {
    return holds(figure(*experiment.robots()[robot], experiment.world().body(world::BodyId(robot))), number);
  };
}

}  // namespace waitpoint::run
