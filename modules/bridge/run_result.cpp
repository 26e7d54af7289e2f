// SPDX-License-Identifier: BSD-3-Clause
#include "modules/bridge/run_result.hpp"

#include <algorithm>

namespace waitpoint::bridge {

RunTotals totals(const RunResult& result) {
  RunTotals sum;
  sum.present = {false, false, false};
  std::size_t positions = 0;
  for (const RobotResult& robot : result.robots) {
    sum.goals += robot.goal_visits();
    sum.goals_reached += robot.goals_reached();
    sum.plans += robot.plan ? 1 : 0;
    sum.plans_completed += robot.plan && robot.plan->completed ? 1 : 0;
    sum.collisions += robot.collisions;
    sum.distance_m += robot.distance_m;
    sum.position_error_mean_m += robot.position_error_mean_m;
    positions += robot.present.position ? 1 : 0;
    sum.position_error_max_m = std::max(sum.position_error_max_m, robot.position_error_max_m);
    sum.odometry_error_max_m = std::max(sum.odometry_error_max_m, robot.odometry_error_max_m);
    sum.odometry_error_end_m = std::max(sum.odometry_error_end_m, robot.odometry_error_end_m);
    sum.present.motion |= robot.present.motion;
    sum.present.odometry |= robot.present.odometry;
  }
  sum.present.position = positions > 0;
  if (positions > 0) sum.position_error_mean_m /= static_cast<double>(positions);
  return sum;
}

}  // namespace waitpoint::bridge
