// SPDX-License-Identifier: BSD-3-Clause
#include "tools/output/trajectory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/error.hpp"
#include "tests/tools/folder.hpp"
#include "tests/tools/sample_result.hpp"

namespace waitpoint::tools {
namespace {

std::size_t line_count(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST(Trajectory, a_line_has_time_position_and_quaternion) {
  const std::vector<bridge::DatedPose> path = {{Time::from_ns(1'500'000'000), {1, -2.5, 0}}};
  EXPECT_EQ(tum_text(path), "1.500000000 1 -2.5 0 0 0 0 1\n");
}

TEST(Trajectory, the_quaternion_turns_by_the_heading) {
  for (const double heading : {0.3, -1.2, 3.0, exact::pi}) {
    const std::vector<bridge::DatedPose> path = {{Time(), {0, 0, heading}}};
    std::istringstream line(tum_text(path));
    double t, x, y, z, qx, qy, qz, qw;
    line >> t >> x >> y >> z >> qx >> qy >> qz >> qw;
    ASSERT_TRUE(line);
    EXPECT_NEAR(2 * std::atan2(qz, qw), heading, 1e-12);
    EXPECT_NEAR(qz * qz + qw * qw, 1, 1e-12);
  }
}

TEST(Trajectory, one_robot_has_the_name_that_was_asked_for_and_two_beside_it) {
  const Folder folder;
  const std::vector<std::string> names = {"one"};
  TrajectoryFiles files(folder / "out.tum", names);
  files.write(sample_result(1));
  EXPECT_EQ(line_count(folder.read("out.tum")), 41u);
  EXPECT_EQ(line_count(folder.read("out.estimated.tum")), 41u);
  EXPECT_EQ(line_count(folder.read("out.odometry.tum")), 41u);
  EXPECT_NE(folder.read("out.tum"), folder.read("out.odometry.tum"));
  EXPECT_EQ(folder.count(), 3u);
}

TEST(Trajectory, several_robots_have_files_of_their_own) {
  const Folder folder;
  const std::vector<std::string> names = {"one", "second"};
  TrajectoryFiles files(folder / "out.tum", names);
  files.write(sample_result(2));
  EXPECT_EQ(line_count(folder.read("out.second.tum")), 41u);
  EXPECT_EQ(line_count(folder.read("out.one.estimated.tum")), 41u);
  EXPECT_EQ(folder.count(), 6u);
}

TEST(Trajectory, nothing_is_left_of_a_run_that_did_not_end) {
  const Folder folder;
  const std::vector<std::string> names = {"one"};
  { TrajectoryFiles files(folder / "out.tum", names); }
  EXPECT_EQ(folder.count(), 0u);
  EXPECT_THROW(TrajectoryFiles(folder / "no/out.tum", names), BadInput);
}

}  // namespace
}  // namespace waitpoint::tools
