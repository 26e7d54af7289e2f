// SPDX-License-Identifier: BSD-3-Clause
// The result of a run as values: the source of summary, picture and trajectory files.
//
// Poses, goals and segments are in the world's frame. Errors are distances between estimated and true position at the
// same instant. Wall-clock figures are for display; nothing that is hashed depends on them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/digest.hpp"
#include "core/pose.hpp"
#include "core/time.hpp"
#include "modules/bridge/path.hpp"
#include "world/description.hpp"

namespace waitpoint::bridge {

/// The reason for the end of a run.
enum class Outcome : std::uint8_t {
  finished,     ///< every executive has ended its round
  time_limit,   ///< the limit on virtual time
  deadlock,     ///< a cycle of waiting tasks, or no task can ever run again
  no_progress,  ///< tasks spin while virtual time stands still
  interrupted,  ///< a signal, at the end of the step
  left,         ///< `quit`, end of input at the prompt, or a partner outside has ended it
  crashed,      ///< the process died in a task
};

constexpr std::string_view to_string(Outcome outcome) {
  constexpr std::string_view names[] = {"finished",    "time limit", "deadlock", "no progress",
                                        "interrupted", "left",       "crashed"};
  return names[static_cast<std::size_t>(outcome)];
}

/// The result for one goal, over all rounds.
struct GoalResult {
  Point position;
  std::string name;          ///< may be empty
  std::uint64_t visits = 1;  ///< one per round; in rounds without end, those that have ended
  std::uint64_t times_reached = 0;
  Time date;           ///< of the report
  std::string report;  ///< of the last visit that missed it, or else the last: "reached", "no way", ...

  bool reached() const { return times_reached > 0 && times_reached == visits; }
};

struct Line {
  Point start, end;
};

/// A periodic task that missed deadlines.
struct LateTask {
  std::string name;  ///< "module.task"
  Duration period;
  std::int64_t missed_deadlines = 0;  ///< wake-ups whose work ended after the next one was due
  std::int64_t missed_periods = 0;    ///< wake-ups skipped because of that
  Duration greatest_lateness;         ///< after its deadline
};

/// The final state of a battery.
struct BatteryResult {
  double charge = 0;  ///< of its capacity
  double volts = 0;
  std::optional<Time> empty_at = {};  ///< when it was exhausted
};

/// A program of a robot.
struct ProgramResult {
  std::string name;
  std::optional<int> exit_status;  ///< none while it runs
};

/// A temporal plan, as far as it was executed.
struct PlanResult {
  std::string name;
  bool completed = false;
  std::string end;               ///< "completed", "under way", or the reason of its abort
  std::vector<std::string> log;  ///< a line each, with the date
};

/// Virtual time at which reports of a robot outside were taken in, after their dates.
struct ReportLag {
  Duration least, median, most;
};

/// A robot outside of the simulation, as its reports moved it.
struct ExternalFigures {
  std::uint64_t reports = 0;   ///< that were taken in, at most one in a step of the world
  std::uint64_t late = 0;      ///< of these, by more than the limit
  std::uint64_t jumps = 0;     ///< farther than its motion explains
  std::uint64_t refused = 0;   ///< jumps to a place that was taken
  std::uint64_t silences = 0;  ///< longer than the limit
  std::optional<ReportLag> lag;
};

/// The figures that mean something: others are 0.
struct FiguresPresent {
  bool motion = true;    ///< distance and collisions: of a robot with a base
  bool position = true;  ///< errors of the fused position: it was compared with the true one
  bool odometry = true;  ///< likewise
};

struct RobotResult {
  std::string name;
  Digest digest;
  world::Shape shape;  ///< of the body, in its own frame

  std::vector<GoalResult> goals;  ///< all of them, in the order of the round
  FiguresPresent present;
  std::uint64_t collisions = 0;
  double distance_m = 0;                                            ///< true distance driven
  double position_error_mean_m = 0;                                 ///< of the fused position
  double position_error_max_m = 0;                                  ///< of the fused position
  double odometry_error_max_m = 0;                                  ///< of the odometry alone
  double odometry_error_end_m = 0;                                  ///< of the odometry alone, at the end
  std::vector<DatedPose> true_path, estimated_path, odometry_path;  ///< if they were kept
  std::vector<LateTask> late_tasks;                                 ///< in the order of the modules
  std::optional<BatteryResult> battery;                             ///< if the robot has one that is simulated
  std::vector<ProgramResult> programs;                              ///< in the order of the scenario
  std::optional<PlanResult> plan;                                   ///< if the robot has one
  std::optional<ExternalFigures> external;                          ///< if reports from outside moved it
  std::vector<Line> segments;                                       ///< the map built by localisation

  /// Visits to goals, and those that reached one.
  std::uint64_t goal_visits() const {
    std::uint64_t count = 0;
    for (const GoalResult& goal : goals) count += goal.visits;
    return count;
  }
  std::uint64_t goals_reached() const {
    std::uint64_t count = 0;
    for (const GoalResult& goal : goals) count += goal.times_reached;
    return count;
  }
};

/// Delay of a paced run behind the wall clock, in wall-clock seconds, sampled at each synchronisation with it.
struct Lag {
  double mean_s = 0, max_s = 0;
};

/// Wall-clock figures of one of several processes of a run.
struct RankFigures {
  double computing_s = 0;  ///< processor time of windows
  double world_s = 0;      ///< of these, of the world's steps, which every rank makes
  double exchange_s = 0;   ///< in exchanges, and waiting there for others
};

struct RunResult {
  std::string scenario;  ///< its name
  std::uint64_t seed = 0;
  Digest digest, environment_digest;
  std::vector<RobotResult> robots;  ///< in the order of the scenario
  Outcome outcome = Outcome::finished;
  std::string trouble;                ///< the report of a deadlock or of no progress, several lines; otherwise empty
  std::vector<std::string> warnings;  ///< one line each
  std::string idle;  ///< a line for each task that waits without a timeout, with its places; may be empty
  std::uint64_t events = 0;
  Duration simulated;
  double wall_s = 0, real_time_factor = 0;
  std::optional<Lag> lag;                  ///< of a paced run
  std::vector<RankFigures> ranks;          ///< of a run of several processes
  std::vector<std::string> outside;        ///< one line for each partner outside, of the run that it took part in
  std::string outside_fault;               ///< that ended the run; may be empty
  std::vector<std::string> outside_unmet;  ///< what partners outside have found not to be as the scenario expects
};

/// Figures over all robots that have them: sums of counts and distances, maxima of maxima, means of means.
struct RunTotals {
  std::uint64_t goals = 0, goals_reached = 0;  ///< of all visits
  std::uint64_t collisions = 0;
  double distance_m = 0;
  double position_error_mean_m = 0, position_error_max_m = 0;
  double odometry_error_max_m = 0, odometry_error_end_m = 0;
  FiguresPresent present;
  std::uint64_t plans = 0, plans_completed = 0;
};
RunTotals totals(const RunResult& result);

}  // namespace waitpoint::bridge
