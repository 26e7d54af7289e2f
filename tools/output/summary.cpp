// SPDX-License-Identifier: BSD-3-Clause
#include "tools/output/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/number_text.hpp"
#include "tools/output/quantiles.hpp"

namespace waitpoint::tools {
namespace {

using bridge::GoalResult;
using bridge::RobotResult;
using bridge::RunResult;
using bridge::RunTotals;
using Json = nlohmann::ordered_json;

std::string goal_title(const GoalResult& goal, std::size_t index) {
  const std::string name = goal.name.empty() ? "" : " " + goal.name;
  return fmt::format("goal {}{} at ({:.2f}, {:.2f})", index + 1, name, goal.position.x, goal.position.y);
}

std::string unreached_goals(const RobotResult& robot) {
  std::string text;
  for (std::size_t i = 0; i < robot.goals.size(); ++i) {
    const GoalResult& goal = robot.goals[i];
    if (goal.reached()) continue;
    const std::string times =
        goal.visits == 1 ? "" : fmt::format("reached {} of {} times; ", goal.times_reached, goal.visits);
    text += fmt::format(
        "  {}: {}: {}{}\n", robot.name, goal_title(goal, i), times,
        goal.report.empty() ? "not reached" : fmt::format("{} at {:.1f} s", goal.report, goal.date.seconds()));
  }
  return text;
}

std::string late_tasks(const RobotResult& robot) {
  std::string text;
  for (const bridge::LateTask& task : robot.late_tasks)
    text += fmt::format("  {}: task {} missed {} and {} of {:g} ms; at most {:g} ms late\n", robot.name, task.name,
                        counted(task.missed_deadlines, "deadline"), counted(task.missed_periods, "period"),
                        task.period.seconds() * 1e3, task.greatest_lateness.seconds() * 1e3);
  return text;
}

std::string battery(const RobotResult& robot) {
  if (!robot.battery) return "";
  if (robot.battery->empty_at)
    return fmt::format("  {}: battery empty at {:.1f} s, off since then\n", robot.name,
                       robot.battery->empty_at->seconds());
  return fmt::format("  {}: battery {:.1f} % full, {:.2f} V\n", robot.name, 100 * robot.battery->charge,
                     robot.battery->volts);
}

std::string programs(const RobotResult& robot) {
  std::string text;
  for (const bridge::ProgramResult& program : robot.programs)
    text += fmt::format("  {}: program {} {}\n", robot.name, program.name,
                        program.exit_status ? fmt::format("ended with exit status {}", *program.exit_status)
                                            : "was running to the end");
  return text;
}

std::string plan(const RobotResult& robot) {
  if (!robot.plan) return "";
  std::string text = fmt::format("  {}: plan '{}' {}\n", robot.name, robot.plan->name, robot.plan->end);
  for (const std::string& line : robot.plan->log) text += "    " + line + "\n";
  return text;
}

std::string external(const RobotResult& robot) {
  if (!robot.external) return "";
  const bridge::ExternalFigures& figures = *robot.external;
  const std::string lag =
      figures.lag
          ? fmt::format(", lag least {:.1f}, median {:.1f}, greatest {:.1f} ms", figures.lag->least.seconds() * 1e3,
                        figures.lag->median.seconds() * 1e3, figures.lag->most.seconds() * 1e3)
          : "";
  return fmt::format("  {}: external: {}, {} late{}; {}, {} refused, {}\n", robot.name,
                     counted(figures.reports, "report"), figures.late, lag, counted(figures.jumps, "jump"),
                     figures.refused, counted(figures.silences, "silence"));
}

RunTotals figures_of(const RobotResult& robot) {
  return {robot.goal_visits(),
          robot.goals_reached(),
          robot.collisions,
          robot.distance_m,
          robot.position_error_mean_m,
          robot.position_error_max_m,
          robot.odometry_error_max_m,
          robot.odometry_error_end_m,
          robot.present,
          robot.plan ? 1U : 0U,
          robot.plan && robot.plan->completed ? 1U : 0U};
}

const std::string absent = "-";

/// The columns that both a run and a robot have in a table.
struct Columns {
  explicit Columns(const RunTotals& figures) {
    if (figures.goals > 0) goals = fmt::format("{}/{}", figures.goals_reached, figures.goals);
    if (!figures.present.motion) return;
    distance = fmt::format("{:.1f} m", figures.distance_m);
    collisions = std::to_string(figures.collisions);
  }

  std::string goals = absent, distance = absent, collisions = absent;
};

std::string robot_table(const RunResult& result) {
  std::size_t width = 5;
  for (const RobotResult& robot : result.robots) width = std::max(width, robot.name.size());
  std::string text = fmt::format("\n  {:{}}  {:>7}  {:>9}  {:>10}  {:>20}  {:>18}  {}\n", "robot", width, "goals",
                                 "driven", "collisions", "position mean / max", "odometry max / end", "digest");
  for (const RobotResult& robot : result.robots) {
    const Columns columns(figures_of(robot));
    const bool has_position = robot.present.position, has_odometry = robot.present.odometry;
    text += fmt::format(
        "  {:{}}  {:>7}  {:>9}  {:>10}  {:>20}  {:>18}  {}\n", robot.name, width, columns.goals, columns.distance,
        columns.collisions,
        has_position ? fmt::format("{:.3f} / {:>6.3f} m", robot.position_error_mean_m, robot.position_error_max_m)
                     : absent,
        has_odometry ? fmt::format("{:.2f} / {:>6.2f} m", robot.odometry_error_max_m, robot.odometry_error_end_m)
                     : absent,
        to_string(robot.digest));
  }
  return text;
}

/// Keys of both a run and each of its robots; figures that are not present are left out.
void put_figures(Json& json, const RunTotals& figures) {
  json["goals"] = figures.goals;
  json["goals_reached"] = figures.goals_reached;
  if (figures.present.motion) {
    json["collisions"] = figures.collisions;
    json["distance_m"] = figures.distance_m;
  }
  if (figures.present.position) {
    json["position_error_mean_m"] = figures.position_error_mean_m;
    json["position_error_max_m"] = figures.position_error_max_m;
  }
  if (figures.present.odometry) {
    json["odometry_error_max_m"] = figures.odometry_error_max_m;
    json["odometry_error_end_m"] = figures.odometry_error_end_m;
  }
}

Json json_of(const RobotResult& robot) {
  Json json;
  json["name"] = robot.name;
  json["digest"] = to_string(robot.digest);
  put_figures(json, figures_of(robot));
  json["goal_reports"] = Json::array();
  for (const GoalResult& goal : robot.goals) {
    Json entry;
    if (!goal.name.empty()) entry["name"] = goal.name;
    entry["x_m"] = goal.position.x;
    entry["y_m"] = goal.position.y;
    entry["reached"] = goal.reached();
    entry["visits"] = goal.visits;
    entry["times_reached"] = goal.times_reached;
    entry["report"] = goal.report;
    if (!goal.report.empty()) entry["time_s"] = goal.date.seconds();
    json["goal_reports"].push_back(std::move(entry));
  }
  if (robot.battery) {
    json["battery_charge"] = robot.battery->charge;
    json["battery_volts"] = robot.battery->volts;
    if (robot.battery->empty_at) json["battery_empty_at_s"] = robot.battery->empty_at->seconds();
  }
  if (!robot.programs.empty()) json["programs"] = Json::array();
  for (const bridge::ProgramResult& program : robot.programs) {
    Json entry;
    entry["name"] = program.name;
    if (program.exit_status) entry["exit_status"] = *program.exit_status;
    json["programs"].push_back(std::move(entry));
  }
  if (robot.plan) {
    json["plan"]["name"] = robot.plan->name;
    json["plan"]["completed"] = robot.plan->completed;
    json["plan"]["end"] = robot.plan->end;
    json["plan"]["log"] = robot.plan->log;
  }
  if (robot.external) {
    Json& external = json["external"];
    external["reports"] = robot.external->reports;
    external["late"] = robot.external->late;
    external["jumps"] = robot.external->jumps;
    external["refused"] = robot.external->refused;
    external["silences"] = robot.external->silences;
    if (const auto& lag = robot.external->lag) {
      external["lag_min_s"] = lag->least.seconds();
      external["lag_median_s"] = lag->median.seconds();
      external["lag_max_s"] = lag->most.seconds();
    }
  }
  if (!robot.late_tasks.empty()) json["late_tasks"] = Json::array();
  for (const bridge::LateTask& task : robot.late_tasks) {
    Json entry;
    entry["name"] = task.name;
    entry["period_ms"] = task.period.seconds() * 1e3;
    entry["missed_deadlines"] = task.missed_deadlines;
    entry["missed_periods"] = task.missed_periods;
    entry["greatest_lateness_ms"] = task.greatest_lateness.seconds() * 1e3;
    json["late_tasks"].push_back(std::move(entry));
  }
  return json;
}

Json json_of(const RunResult& result) {
  Json json;
  json["scenario"] = result.scenario;
  json["seed"] = result.seed;
  json["outcome"] = bridge::to_string(result.outcome);
  json["digest"] = to_string(result.digest);
  put_figures(json, totals(result));
  json["events"] = result.events;
  json["simulated_s"] = result.simulated.seconds();
  json["wall_s"] = result.wall_s;
  json["real_time_factor"] = result.real_time_factor;
  for (const bridge::RankFigures& rank : result.ranks)
    json["ranks"].push_back(
        {{"computing_s", rank.computing_s}, {"world_s", rank.world_s}, {"exchange_s", rank.exchange_s}});
  if (result.lag) {
    json["lag_mean_s"] = result.lag->mean_s;
    json["lag_max_s"] = result.lag->max_s;
  }
  if (!result.outside.empty()) json["outside"] = result.outside;
  if (!result.outside_fault.empty()) json["outside_fault"] = result.outside_fault;
  json["environment_digest"] = to_string(result.environment_digest);
  json["warnings"] = result.warnings;
  if (!result.trouble.empty()) {
    const bool crashed = result.outcome == bridge::Outcome::crashed;
    json[crashed                                          ? "crash"
         : result.outcome == bridge::Outcome::no_progress ? "no_progress"
                                                          : "deadlock"] = result.trouble;
  }
  if (!result.idle.empty()) json["waiting"] = result.idle;
  json["robots"] = Json::array();
  for (const RobotResult& robot : result.robots) json["robots"].push_back(json_of(robot));
  return json;
}

/// Names and messages come from files: invalid UTF-8 is replaced, so that it does not throw at the end of a run.
std::string dumped(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

}  // namespace

std::string summary_text(const RunResult& result) {
  const RunTotals sum = totals(result);
  std::string text = fmt::format("{}, seed {}: {} after {:.1f} s simulated\n\n", result.scenario, result.seed,
                                 bridge::to_string(result.outcome), result.simulated.seconds());
  if (sum.goals > 0) text += fmt::format("  goals reached     {} of {}\n", sum.goals_reached, sum.goals);
  if (sum.present.motion) {
    text += fmt::format("  distance driven   {:.1f} m\n", sum.distance_m);
    text += fmt::format("  collisions        {}\n", sum.collisions);
  }
  if (sum.present.position)
    text += fmt::format("  position error    mean {:.3f} m, greatest {:.3f} m\n", sum.position_error_mean_m,
                        sum.position_error_max_m);
  if (sum.present.odometry)
    text += fmt::format("  odometry alone    greatest {:.2f} m, at the end {:.2f} m\n", sum.odometry_error_max_m,
                        sum.odometry_error_end_m);
  text += fmt::format("  events            {}\n", result.events);
  text += result.wall_s > 0 ? fmt::format("  speed             {:.1f} times real time ({:.2f} s)\n",
                                          result.real_time_factor, result.wall_s)
                            : "";
  if (!result.ranks.empty()) {
    const auto slowest = std::ranges::max_element(result.ranks, {}, &bridge::RankFigures::computing_s);
    text += fmt::format("  ranks             {}, the slowest computes for {:.2f} s, {:.2f} s of it the world\n",
                        result.ranks.size(), slowest->computing_s, slowest->world_s);
  }
  if (result.lag)
    text += fmt::format("  lag               mean {:.1f} ms, greatest {:.1f} ms behind the wall clock\n",
                        result.lag->mean_s * 1e3, result.lag->max_s * 1e3);
  if (result.robots.size() > 1) text += robot_table(result);
  std::string unreached;
  for (const RobotResult& robot : result.robots) unreached += unreached_goals(robot);
  if (!unreached.empty()) text += "\n" + unreached;
  std::string equipment;
  for (const RobotResult& robot : result.robots)
    equipment += battery(robot) + programs(robot) + plan(robot) + external(robot);
  for (const std::string& line : result.outside) equipment += "  " + line + "\n";
  if (!equipment.empty()) text += "\n" + equipment;
  std::string late;
  for (const RobotResult& robot : result.robots) late += late_tasks(robot);
  if (!late.empty()) text += "\n" + late;
  for (const std::string& warning : result.warnings) text += "\nwarning: " + warning;
  if (!result.warnings.empty()) text += "\n";
  if (!result.trouble.empty()) text += "\n" + result.trouble + (result.trouble.back() == '\n' ? "" : "\n");
  if (!result.idle.empty()) text += "\nwaiting without a timeout:" + result.idle + "\n";
  return text + "\n  digest            " + to_string(result.digest) + "\n";
}

std::string summary_json(const RunResult& result) { return dumped(json_of(result)); }

std::string summary_json(std::span<const RunResult> results) {
  Json json;
  json["runs"] = Json::array();
  for (const RunResult& result : results) json["runs"].push_back(json_of(result));
  for (const Quantiles& row : quantiles_of(results))
    json["quantiles"][row.figure] = {
        {"least", row.least}, {"0.1", row.tenth}, {"median", row.median}, {"0.9", row.nine_tenths}, {"most", row.most}};
  return dumped(json);
}

std::string seeds_head() {
  return fmt::format("{:>10}  {:>11}  {:>7}  {:>9}  {:>10}  {:>12}  {:>12}  {:>8}  {}\n", "seed", "outcome", "goals",
                     "driven", "collisions", "position max", "odometry max", "x real", "digest");
}

std::string seeds_row(const RunResult& result) {
  const RunTotals sum = totals(result);
  const Columns columns(sum);
  return fmt::format("{:>10}  {:>11}  {:>7}  {:>9}  {:>10}  {:>12}  {:>12}  {:>8.1f}  {}\n", result.seed,
                     bridge::to_string(result.outcome), columns.goals, columns.distance, columns.collisions,
                     sum.present.position ? fmt::format("{:.3f} m", sum.position_error_max_m) : absent,
                     sum.present.odometry ? fmt::format("{:.2f} m", sum.odometry_error_max_m) : absent,
                     result.real_time_factor, to_string(result.digest));
}

}  // namespace waitpoint::tools
