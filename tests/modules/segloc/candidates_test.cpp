// SPDX-License-Identifier: BSD-3-Clause
#include "modules/segloc/candidates.hpp"

#include <gtest/gtest.h>

namespace waitpoint::segloc {
namespace {

// The wall x = 2, from y = low to high, seen by a robot that looks along x.
LineObservation wall_ahead(const Pose& robot, double distance_m, double low_m, double high_m) {
  LineObservation o;
  o.angle_rad = -robot.heading;
  o.start = between(robot, {distance_m, low_m, 0}).position();
  o.end = between(robot, {distance_m, high_m, 0}).position();
  o.middle = 0.5 * (o.start + o.end);
  o.length_m = high_m - low_m;
  return o;
}

TEST(Candidates, ALineIsConfirmedWhenItWasSeenOftenEnoughFromElsewhere) {
  Candidates candidates({});
  Landmark confirmed;
  for (std::uint64_t update = 1; update <= 4; ++update) {
    const Pose robot{0.1 * static_cast<double>(update), 0, 0};
    const double high = static_cast<double>(update);  // more of it at each update
    const bool now = candidates.sight(robot, wall_ahead(robot, 2, -1, high), update, confirmed);
    EXPECT_EQ(now, update == 4) << update;
  }
  EXPECT_EQ(confirmed.sightings, 4u);
  EXPECT_NEAR(confirmed.seen.length_m(), 5, 1e-9);
  EXPECT_EQ(candidates.size(), 0u);
}

TEST(Candidates, StandingStillItTakesLonger) {
  Candidates candidates({});
  Landmark confirmed;
  std::uint64_t update = 1;
  while (!candidates.sight({}, wall_ahead({}, 2, -1, 1), update, confirmed)) ++update;
  EXPECT_EQ(update, CandidateParameters{}.sightings_enough);
}

TEST(Candidates, SomethingThatMovesIsNeverConfirmed) {
  Candidates candidates({});
  Landmark confirmed;
  for (std::uint64_t update = 1; update < 40; ++update) {
    const double at = 2 + 0.1 * static_cast<double>(update);
    EXPECT_FALSE(candidates.sight({}, wall_ahead({}, at, -1, 1), update, confirmed));
    candidates.forget_old(update);
  }
  EXPECT_LE(candidates.size(), CandidateParameters{}.patience_updates + 1);
}

TEST(Candidates, TwoSegmentsOfOneScanAreTwoLines) {
  Candidates candidates({});
  Landmark confirmed;
  candidates.sight({}, wall_ahead({}, 2, -1, 1), 1, confirmed);
  candidates.sight({}, wall_ahead({}, 2.02, -1, 1), 1, confirmed);
  EXPECT_EQ(candidates.size(), 2u);
}

TEST(Candidates, TheirNumberIsBounded) {
  Candidates candidates({});
  Landmark confirmed;
  for (std::uint64_t i = 0; i < 500; ++i) {
    candidates.sight({}, wall_ahead({}, 2 + static_cast<double>(i), -1, 1), i, confirmed);
  }
  EXPECT_LE(candidates.size(), 64u);
}

}  // namespace
}  // namespace waitpoint::segloc
