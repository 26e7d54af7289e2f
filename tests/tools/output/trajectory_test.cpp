// SPDX-License-Identifier: BSD-3-Clause
#include "tools/output/trajectory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/error.hpp"
#include "tests/tools/folder.hpp"

namespace waitpoint::tools {
namespace {

std::size_t line_count(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST(Trajectory, LineHasTimePositionAndQuaternion) {
  EXPECT_EQ(tum_line({Time::from_ns(1'500'000'000), {1, -2.5, 0}}), "1.500000000 1 -2.5 0 0 0 0 1\n");
}

TEST(Trajectory, QuaternionRotatesByTheHeading) {
  for (const double heading : {0.3, -1.2, 3.0, exact::pi}) {
    std::istringstream line(tum_line({Time(), {0, 0, heading}}));
    double t, x, y, z, qx, qy, qz, qw;
    line >> t >> x >> y >> z >> qx >> qy >> qz >> qw;
    ASSERT_TRUE(line);
    EXPECT_NEAR(2 * std::atan2(qz, qw), heading, 1e-12);
    EXPECT_NEAR(qz * qz + qw * qw, 1, 1e-12);
  }
}

/// Three samples of the true path, two of the estimated one, one of the odometry.
void drive(bridge::PathSink& sink, double y) {
  using enum bridge::PathKind;
  for (const bridge::PathKind kind : {truth, truth, truth, estimate, estimate, odometry})
    sink.add(kind, {Time(), {1, y, 0}});
}

TEST(Trajectory, OneRobotGivesTheNamedFileAndTwoBesideIt) {
  const Folder folder;
  const std::vector<std::string> names = {"one"};
  TrajectoryFiles files(folder / "out.tum", names);
  drive(files.sink(0), 2);
  files.finish();
  EXPECT_EQ(line_count(folder.read("out.tum")), 3u);
  EXPECT_EQ(line_count(folder.read("out.estimated.tum")), 2u);
  EXPECT_EQ(folder.read("out.odometry.tum"), "0.000000000 1 2 0 0 0 0 1\n");
  EXPECT_EQ(folder.count(), 3u);
}

TEST(Trajectory, SeveralRobotsGiveFilesEach) {
  const Folder folder;
  const std::vector<std::string> names = {"one", "second"};
  TrajectoryFiles files(folder / "out.tum", names);
  drive(files.sink(0), 2);
  drive(files.sink(1), 3);
  files.finish();
  EXPECT_EQ(folder.read("out.one.odometry.tum"), "0.000000000 1 2 0 0 0 0 1\n");
  EXPECT_EQ(folder.read("out.second.odometry.tum"), "0.000000000 1 3 0 0 0 0 1\n");
  EXPECT_EQ(line_count(folder.read("out.second.tum")), 3u);
  EXPECT_EQ(folder.count(), 6u);
}

TEST(Trajectory, CutOffFilesEndWithTheReason) {
  const Folder folder;
  const std::vector<std::string> names = {"one"};
  TrajectoryFiles files(folder / "out.tum", names);
  drive(files.sink(0), 2);
  files.cut_off("killed");
  EXPECT_EQ(folder.read("out.odometry.tum"), "0.000000000 1 2 0 0 0 0 1\n# cut off: killed\n");
  EXPECT_TRUE(folder.read("out.tum").ends_with("\n# cut off: killed\n"));
}

TEST(Trajectory, FullDiskDuringTheRunFailsAtItsEnd) {
  const std::vector<std::string> names = {"one"};
  TrajectoryFiles files("/dev/full", names);
  for (int i = 0; i < 1000; ++i) drive(files.sink(0), 2);
  EXPECT_THROW(files.finish(), BadInput);
}

TEST(Trajectory, UnfinishedRunLeavesNoFiles) {
  const Folder folder;
  const std::vector<std::string> names = {"one"};
  { TrajectoryFiles files(folder / "out.tum", names); }
  EXPECT_EQ(folder.count(), 0u);
  EXPECT_THROW(TrajectoryFiles(folder / "no/out.tum", names), BadInput);
}

}  // namespace
}  // namespace waitpoint::tools
