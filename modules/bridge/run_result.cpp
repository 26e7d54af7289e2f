// SPDX-License-Identifier: BSD-3-Clause
#include "modules/bridge/run_result.hpp"

#include <algorithm>

namespace waitpoint::bridge {

RunTotals totals(const RunResult& result) {
  RunTotals sum;
  for (const RobotResult& robot : result.robots) {
    sum.goals += robot.goals.size();
    sum.goals_reached += robot.goals_reached();
    sum.collisions += robot.collisions;
    sum.distance_m += robot.distance_m;
    sum.position_error_mean_m += robot.position_error_mean_m / static_cast<double>(result.robots.size());
    sum.position_error_max_m = std::max(sum.position_error_max_m, robot.position_error_max_m);
    sum.odometry_error_max_m = std::max(sum.odometry_error_max_m, robot.odometry_error_max_m);
    sum.odometry_error_end_m = std::max(sum.odometry_error_end_m, robot.odometry_error_end_m);
  }
  return sum;
}

}  // namespace waitpoint::bridge
