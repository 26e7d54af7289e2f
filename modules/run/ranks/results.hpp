// SPDX-License-Identifier: BSD-3-Clause
// Results that the first rank gathers from the others to report on the whole run.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/digest.hpp"
#include "core/time.hpp"
#include "modules/bridge/run_result.hpp"

namespace waitpoint::run {

/// The kernel's record of a robot (kernel::Robot), where its tasks are.
struct RobotRecord {
  std::uint32_t robot = 0;
  PairDigest digest;
  std::uint64_t outputs = 0;
  bool ended = false;
  Time end_time;
};

/// The records of a rank's robots.
struct Records {
  std::vector<RobotRecord> robots;
  std::uint64_t pairs_after_ends = 0;  ///< Roster::pairs_after_ends()
};

/// The results of a rank's robots, and its own figures.
struct Results {
  bridge::RankFigures figures;
  std::vector<std::uint32_t> robots{};
  std::vector<bridge::RobotResult> results{};  ///< of these
};

/// Of a robot, in words: list_tasks().
struct RobotTasks {
  std::uint32_t robot = 0;
  std::string lines;
};

void carry(auto& archive, RobotTasks& tasks) { archive(tasks.robot, tasks.lines); }
void carry(auto& archive, RobotRecord& record) {
  archive(record.robot, record.digest, record.outputs, record.ended, record.end_time);
}
void carry(auto& archive, Records& records) { archive(records.robots, records.pairs_after_ends); }

void carry(auto& archive, bridge::GoalResult& goal) {
  archive(goal.position, goal.name, goal.visits, goal.times_reached, goal.date, goal.report);
}
void carry(auto& archive, bridge::Line& line) { archive(line.start, line.end); }
void carry(auto& archive, bridge::LateTask& task) {
  archive(task.name, task.period, task.missed_deadlines, task.missed_periods, task.greatest_lateness);
}
void carry(auto& archive, bridge::BatteryResult& battery) { archive(battery.charge, battery.volts, battery.empty_at); }
void carry(auto& archive, bridge::ProgramResult& program) { archive(program.name, program.exit_status); }
void carry(auto& archive, bridge::PlanResult& plan) { archive(plan.name, plan.completed, plan.end, plan.log); }
void carry(auto& archive, bridge::FiguresPresent& present) {
  archive(present.motion, present.position, present.odometry);
}
void carry(auto& archive, bridge::DatedPose& at) { archive(at.date, at.pose); }
/// Without its shape, which the scenario has.
void carry(auto& archive, bridge::RobotResult& result) {
  archive(result.name, result.digest, result.goals, result.present, result.collisions, result.distance_m,
          result.position_error_mean_m, result.position_error_max_m, result.odometry_error_max_m,
          result.odometry_error_end_m, result.true_path, result.estimated_path, result.odometry_path, result.late_tasks,
          result.battery, result.programs, result.segments, result.plan);
}
/// Of a run of one process, without warnings and the shapes of robots.
void carry(auto& archive, bridge::RunResult& result) {
  archive(result.scenario, result.seed, result.digest, result.environment_digest, result.robots, result.outcome,
          result.trouble, result.events, result.simulated, result.wall_s, result.real_time_factor);
}
void carry(auto& archive, bridge::RankFigures& figures) {
  archive(figures.computing_s, figures.world_s, figures.exchange_s);
}
void carry(auto& archive, Results& results) { archive(results.figures, results.robots, results.results); }

}  // namespace waitpoint::run
