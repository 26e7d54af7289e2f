// SPDX-License-Identifier: BSD-3-Clause
#include "modules/sick/segment_extraction.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <vector>

#include "modules/genom/settings.hpp"
#include "tests/modules/sick/synthetic_room.hpp"

namespace waitpoint::sick {
namespace {

using synthetic::LaserModel;
using synthetic::Room;

struct Bench {
  Room room;
  LaserModel laser;
  RandomStream noise{7, "r", "sick.range"};
  std::unique_ptr<posters::Echoes> echoes = std::make_unique<posters::Echoes>();
  std::unique_ptr<posters::Segments> segments = std::make_unique<posters::Segments>();
  std::unique_ptr<SegmentExtraction> extraction = std::make_unique<SegmentExtraction>(SegmentExtractionParameters{});

  const posters::Segments& look(const Pose& robot, std::uint64_t tick = 0) {
    room.scan(compose(robot, echoes->mount), laser, noise, tick, {}, echoes->scan);
    extraction->extract(*echoes, *segments);
    return *segments;
  }
};

// The wall's line as seen from the robot, oriented as a segment's.
struct TrueLine {
  double normal_rad, distance_m;
};
TrueLine seen_from(const Pose& robot, Point a, Point b) {
  const Point p = between(robot, {a.x, a.y, 0}).position(), q = between(robot, {b.x, b.y, 0}).position();
  const Point along = q - p;
  Point n = (1.0 / length(along)) * Point{along.y, -along.x};
  if (dot(n, p) < 0) n = -1.0 * n;
  return {exact::atan2(n.y, n.x), dot(n, p)};
}

// Squared Mahalanobis distance of a segment from its true line.
double squared_error(const posters::Segment& segment, const TrueLine& truth) {
  const double a = exact::wrap_angle(segment.normal_rad - truth.normal_rad);
  const double d = segment.distance_m - truth.distance_m;
  const auto [aa, ad, dd] = segment.covariance;
  return (a * a * dd - 2 * a * d * ad + d * d * aa) / (aa * dd - ad * ad);
}

TEST(SegmentExtraction, FindsTheWallsOfARectangularRoomAndTheirPlaces) {
  Bench bench;
  bench.room.add_box({0, 0, 0}, 8, 6);
  const Pose robot{-1, 0.5, 0.2};
  const auto& segments = bench.look(robot).items;
  ASSERT_EQ(segments.size(), 3u);  // the wall behind is hidden except for its ends
  const std::array<std::pair<Point, Point>, 3> walls{{{{-4, -3}, {4, -3}}, {{4, -3}, {4, 3}}, {{-4, 3}, {4, 3}}}};
  for (std::size_t i = 0; i < 3; ++i) {
    const TrueLine truth = seen_from(robot, walls[i].first, walls[i].second);
    EXPECT_NEAR(exact::wrap_angle(segments[i].normal_rad - truth.normal_rad), 0, 0.003);
    EXPECT_NEAR(segments[i].distance_m, truth.distance_m, 0.006);
  }
  EXPECT_NEAR(length(segments[1].end - segments[1].start), 6.0, 0.15);
}

TEST(SegmentExtraction, EndPointsRunCounterClockwiseAboutTheDeviceAndLieOnTheLine) {
  Bench bench;
  bench.room.add_box({0, 0, 0}, 8, 6);
  bench.echoes->mount = {0.2, -0.1, 0.3};
  for (const auto& s : bench.look({1, 1, -2.5}).items) {
    const Point device = bench.echoes->mount.position();
    EXPECT_GT(cross(s.start - device, s.end - device), 0);
    const auto [sine, cosine] = exact::sincos(s.normal_rad);
    EXPECT_NEAR(cosine * s.start.x + sine * s.start.y, s.distance_m, 1e-9);
    EXPECT_NEAR(cosine * s.end.x + sine * s.end.y, s.distance_m, 1e-9);
    EXPECT_GE(s.distance_m, 0);
  }
}

TEST(SegmentExtraction, TheCovarianceIsThatOfTheErrors) {
  Bench bench;
  bench.room.add_box({0, 0, 0}, 9, 7);
  bench.echoes->mount = {0.1, 0.05, 0.02};
  const RandomStream place(3, "r", "test.place");
  double sum = 0;
  int count = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    const Pose robot{place.uniform(i, 0) * 5 - 2.5, place.uniform(i, 1) * 4 - 2, place.uniform(i, 2) * 6 - 3};
    bench.laser.bias_m = 0.004 * place.normal(i, 3);
    for (const auto& segment : bench.look(robot, i).items) {
      double best = 1e9;
      for (const auto& wall : bench.room.walls()) {
        best = std::min(best, squared_error(segment, seen_from(robot, wall.from, wall.to)));
      }
      EXPECT_LT(best, 25);
      sum += best;
      ++count;
    }
  }
  ASSERT_GT(count, 900);
  // The mean of chi2 with two degrees of freedom is 2.
  RecordProperty("mean_squared_error", std::to_string(sum / count));
  EXPECT_GT(sum / count, 1.4);
  EXPECT_LT(sum / count, 2.6);
}

TEST(SegmentExtraction, SplitsAtCornersAndSteps) {
  Bench bench;
  // A wall with a recess of 12 cm between x = -1 and 1, three metres ahead.
  bench.room.add_wall({-4, 3}, {-1, 3});
  bench.room.add_wall({-1, 3}, {-1, 3.12});
  bench.room.add_wall({-1, 3.12}, {1, 3.12});
  bench.room.add_wall({1, 3.12}, {1, 3});
  bench.room.add_wall({1, 3}, {4, 3});
  const auto& segments = bench.look({0, 0, exact::pi / 2}).items;
  ASSERT_EQ(segments.size(), 3u);
  EXPECT_NEAR(segments[0].distance_m, 3, 0.01);
  EXPECT_NEAR(segments[1].distance_m, 3.12, 0.01);
  EXPECT_NEAR(segments[2].distance_m, 3, 0.01);
}

TEST(SegmentExtraction, BreaksAtADoor) {
  Bench bench;
  bench.room.add_wall({2, -3}, {2, -0.5});
  bench.room.add_wall({2, 0.5}, {2, 3});
  bench.room.add_wall({5, -6}, {5, 6});
  const auto& segments = bench.look({0, 0, 0}).items;
  ASSERT_EQ(segments.size(), 3u);
  EXPECT_NEAR(segments[0].end.y, -0.5, 0.05);
  EXPECT_NEAR(segments[1].distance_m, 5, 0.01);
  EXPECT_NEAR(segments[2].start.y, 0.5, 0.05);
}

TEST(SegmentExtraction, FollowsAWallThatTheBeamsGraze) {
  Bench bench;
  bench.room.add_wall({0, 1}, {20, 1});
  const auto& segments = bench.look({0, 0, 0.3}).items;
  ASSERT_EQ(segments.size(), 1u);
  EXPECT_GT(length(segments[0].end - segments[0].start), 7.0);
}

TEST(SegmentExtraction, RoundThingsAndClutterAreNoSegments) {
  Bench bench;
  bench.room.add_disc({{2, 0}, 0.25});
  bench.room.add_disc({{1, 2}, 0.4});
  bench.room.add_disc({{3, -2}, 1.0});
  bench.room.add_disc({{0.5, -0.8}, 0.15});
  EXPECT_EQ(bench.look({0, 0, 0}).items.size(), 0u);
}

TEST(SegmentExtraction, AWallOfRasterCellsIsOneSegment) {
  for (const double slope : {0.0, 0.3, 0.577, 1.0, 1.7}) {
    Bench bench;
    synthetic::Raster raster(0.05, {-10, -10}, 20, 20);
    const double norm = std::sqrt(1 + slope * slope);
    const Point along{1 / norm, slope / norm}, normal{-slope / norm, 1 / norm};
    const Point middle = 2.0 * normal;
    raster.draw(middle - 1.5 * along, middle + 1.5 * along);
    bench.room.set_raster(raster);
    const auto& segments = bench.look({0, 0, exact::atan2(normal.y, normal.x)}).items;
    ASSERT_EQ(segments.size(), 1u) << slope;
    EXPECT_NEAR(segments[0].normal_rad, 0, 0.02) << slope;
    EXPECT_NEAR(segments[0].distance_m, 2, 0.04) << slope;
    EXPECT_NEAR(length(segments[0].end - segments[0].start), 3, 0.25) << slope;
  }
}

TEST(SegmentExtraction, AScanWithoutEchoesGivesNone) {
  Bench bench;
  EXPECT_EQ(bench.look({0, 0, 0}).items.size(), 0u);
  bench.echoes->scan.range_m.clear();
  bench.extraction->extract(*bench.echoes, *bench.segments);
  EXPECT_EQ(bench.segments->items.size(), 0u);
}

TEST(SegmentExtraction, MoreThanThePosterHoldsGivesTheLongestFirst) {
  Bench bench;
  bench.laser.beams = 721;
  bench.laser.noise_m = bench.laser.resolution_m = 0;
  // Eighty tangents of a ring, three quarters of them long enough; none joins the next.
  const int count = 80;
  for (int i = 0; i < count; ++i) {
    const double angle = -1.5 + 3.0 * i / (count - 1), radius = i % 2 ? 20 : 23;
    const auto [s, c] = exact::sincos(angle);
    const double half = 0.3 + 0.001 * i;
    bench.room.add_wall(radius * Point{c, s} + half * Point{s, -c}, radius * Point{c, s} - half * Point{s, -c});
  }
  SegmentExtractionParameters parameters;
  parameters.points_min = 3;
  bench.extraction = std::make_unique<SegmentExtraction>(parameters);
  const auto& segments = bench.look({0, 0, 0}).items;
  ASSERT_EQ(segments.size(), posters::segment_count_max);
  for (std::size_t i = 1; i < segments.size(); ++i) {
    EXPECT_GE(length(segments[i - 1].end - segments[i - 1].start), length(segments[i].end - segments[i].start));
  }
}

TEST(SegmentExtraction, ImpossibleParametersAreBadInput) {
  SegmentExtractionParameters parameters;
  EXPECT_NO_THROW(genom::Settings({{"points_min", "3", "s.yaml", 1}}).read(parameters));
  EXPECT_THROW(genom::Settings({{"points_min", "2", "s.yaml", 1}}).read(parameters), BadInput);
}

TEST(SegmentExtraction, CostOfOneScan) {
  Bench bench;
  bench.room.add_box({0, 0, 0}, 12, 8);
  for (int i = 0; i < 12; ++i) bench.room.add_box({-5.0 + 0.9 * i, i % 3 - 1.5, 0.4 * i}, 0.6, 0.4);
  const int repeats = 100;
  std::vector<posters::Echoes> echoes(16);
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    bench.look({-5.0 + 0.6 * static_cast<double>(i), 2.5, -1.5}, i);
    echoes[i] = *bench.echoes;
  }
  std::size_t found = 0;
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < repeats; ++i) {
    for (const auto& e : echoes) {
      bench.extraction->extract(e, *bench.segments);
      found += bench.segments->items.size();
    }
  }
  const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
  const double scans = repeats * static_cast<double>(echoes.size());
  std::printf("[ measured ] %.1f us a scan of %u beams, %.1f segments\n", took.count() / scans, bench.laser.beams,
              static_cast<double>(found) / scans);
  EXPECT_GT(found, 0u);
}

}  // namespace
}  // namespace waitpoint::sick
