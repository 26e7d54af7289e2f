// SPDX-License-Identifier: BSD-3-Clause
// Long drives through whole buildings.
#include <gtest/gtest.h>

#include <cstdio>

#include "core/digest.hpp"
#include "tests/modules/segloc/tour.hpp"

namespace waitpoint::synthetic {
namespace {

void print(const TourResult& r) {
  std::printf(
      "[ measured ] %.0f m: error mean %.3f m, greatest %.3f m; odometry %.1f m; NEES %.2f; %zu landmarks; "
      "%.1f segments, %.1f matched, %.1f used; %.1f us a scan, greatest %.0f us\n",
      r.way_m, r.error_m_mean, r.error_m_max, r.odometry_error_m_end, r.nees_mean, r.landmarks_end, r.segments_mean,
      r.matched_mean, r.used_mean, r.observe_us_mean, r.observe_us_max);
}

TEST(OfficeTour, TheFilterHoldsThePoseWhereTheOdometryLosesIt) {
  const Room room = office();
  for (const std::uint64_t seed : {1u, 2u}) {
    TourOptions options;
    options.seed = seed;
    options.walkers = office_walkers();
    options.laser.bias_m = seed == 1 ? 0.004 : -0.004;
    if (seed == 2) options.odometry.drift_rad_per_m *= -1;
    const TourResult r = drive(room, office_way(), options);
    print(r);
    EXPECT_GT(r.way_m, 200);
    EXPECT_GT(r.odometry_error_m_end, 1.0);
    EXPECT_LT(r.error_m_max, 0.3);
    EXPECT_LT(r.error_m_mean, 0.15);
    EXPECT_LT(r.error_m_end, 0.05);  // back at the start, the first walls correct it
    EXPECT_GT(r.nees_mean, 0.05);
    EXPECT_LT(r.nees_mean, 5.0);  // three degrees of freedom
    EXPECT_LT(r.landmarks_max, options.filter.landmarks_max);
    EXPECT_GT(r.landmarks_end, 40u);
    EXPECT_NEAR(1 + r.filter->calibration().travel, 1 / options.odometry.travel_scale, 0.005);
    EXPECT_NEAR(r.filter->calibration().drift_rad_per_m, -options.odometry.drift_rad_per_m, 0.002);
  }
}

TEST(OfficeTour, ABudgetMuchTooSmallForTheFloorCostsTheMapNotThePose) {
  TourOptions options;
  options.filter.landmarks_max = 25;
  const TourResult r = drive(office(), office_way(), options);
  print(r);
  EXPECT_EQ(r.landmarks_max, 25u);
  EXPECT_GT(r.forgotten, 20u);
  EXPECT_LT(r.error_m_max, 0.3);
}

TEST(OfficeTour, OneSeedGivesOneRun) {
  std::vector<Point> way = office_way();
  way.resize(8);
  std::uint64_t digests[2];
  for (std::uint64_t& value : digests) {
    Digest digest;
    TourOptions options;
    options.after_scan = [&](double, const Pose&, const segloc::SegmentMapFilter& filter) {
      add_value(digest, filter.position().pose);
      add_value(digest, filter.position().covariance);
    };
    drive(office(), way, options);
    value = digest.value();
  }
  EXPECT_EQ(digests[0], digests[1]);
}

// A hexagon of raster cells with round pillars, as TurtleBot's arena: few walls, all of them stair-stepped.
TEST(RasterTour, FewWallsOfCellsHoldThePose) {
  Raster raster(0.05, {-4, -4}, 8, 8);
  const auto corner = [](int i) {
    const auto [s, c] = exact::sincos(i * exact::pi / 3);
    return Point{2.9 * c, 2.9 * s};
  };
  for (int i = 0; i < 6; ++i) raster.draw(corner(i), corner(i + 1));
  Room room;
  room.set_raster(raster);
  for (int i = 0; i < 9; ++i) room.add_disc({{1.1 * (i % 3 - 1), 1.1 * (i / 3 - 1)}, 0.15});
  std::vector<Point> way;
  for (int lap = 0; lap < 5; ++lap) {
    for (const Point p : {Point{-1.8, 0.5},
                          {-0.55, 0.55},
                          {-0.5, -0.5},
                          {0.55, -0.55},
                          {1.7, -0.5},
                          {1.6, 0.6},
                          {0.55, 0.55},
                          {0.5, 1.7},
                          {-0.5, 1.7},
                          {-1.6, 0.7}}) {
      way.push_back(p);
    }
  }
  TourOptions options;
  const TourResult r = drive(room, way, options);
  print(r);
  EXPECT_LT(r.error_m_max, 0.15);
  EXPECT_GT(r.odometry_error_m_max, 0.4);
  EXPECT_LT(r.landmarks_max, 30u);
}

// A hall of 3 cm cells with slightly turned shelves, and a stretch of 20 m with only one wall in range.
TEST(RasterTour, DegradesToOdometryWithFewLinesAndRecovers) {
  Raster raster(0.03, {-2, -2}, 54, 34);
  raster.draw({0, 0}, {50, 0.4});
  raster.draw({50, 0.4}, {49.8, 30});
  raster.draw({49.8, 30}, {0.2, 29.7});
  raster.draw({0.2, 29.7}, {0, 0});
  for (const double x : {6.0, 11.0, 16.0}) {
    raster.draw({x, 4}, {x + 0.1, 14});
    raster.draw({x + 0.1, 14}, {x + 2.1, 14.05});
    raster.draw({x + 2.1, 14.05}, {x + 2, 4});
    raster.draw({x + 2, 4}, {x, 4});
  }
  Room room;
  room.set_raster(raster);
  TourOptions options;
  options.laser.range_m_max = 8;
  const TourResult r = drive(room,
                             {{3, 2},
                              {3, 16},
                              {9.5, 16},
                              {9.5, 3},
                              {14.5, 2.5},
                              {14.5, 16},
                              {20, 12},
                              {40, 12},
                              {42, 5},
                              {20, 4},
                              {20, 16},
                              {9.5, 16},
                              {3, 16},
                              {3, 2}},
                             options);
  print(r);
  EXPECT_LT(r.error_m_max, 2.0);  // 1 % of the way and 0.5 degrees a metre, over 20 m in the open
  EXPECT_LT(r.error_m_max, 0.6 * r.odometry_error_m_max);
  EXPECT_LT(r.error_m_end, 0.1);
  EXPECT_LT(r.nees_mean, 12.0);
}

}  // namespace
}  // namespace waitpoint::synthetic
