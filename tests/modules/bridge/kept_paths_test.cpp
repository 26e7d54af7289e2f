// SPDX-License-Identifier: BSD-3-Clause
#include "modules/bridge/kept_paths.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"

namespace waitpoint::bridge {
namespace {

/// The i-th sample, at 10 Hz and 0.5 m/s, of endless rounds about a square of 8 m.
DatedPose on_square(std::int64_t i) {
  const double way = std::fmod(0.05 * static_cast<double>(i), 32), along = std::fmod(way, 8);
  const Point corners[] = {{along, 0}, {8, along}, {8 - along, 8}, {0, 8 - along}};
  const Point p = corners[static_cast<std::size_t>(way / 8)];
  return {Time::from_ns(i * 100'000'000), {p.x, p.y, 0.001 * static_cast<double>(i)}};
}

double distance_to(const std::vector<DatedPose>& path, const DatedPose& sample) {
  const auto after = std::lower_bound(path.begin(), path.end(), sample.date,
                                      [](const DatedPose& at, Time date) { return at.date < date; });
  const Point p = sample.pose.position(), b = after->pose.position();
  if (after == path.begin()) return length(p - b);
  const Point a = std::prev(after)->pose.position(), along = b - a;
  const double squared = dot(along, along);
  const double part = squared > 0 ? std::clamp(dot(p - a, along) / squared, 0.0, 1.0) : 0;
  return length(p - (a + part * along));
}

TEST(KeptPath, KeepsEverySampleOfAShortRun) {
  KeptPath path;
  for (std::int64_t i = 0; i < 10'000; ++i) path.add(on_square(i));
  ASSERT_EQ(path.samples().size(), 10'000u);
  EXPECT_EQ(path.samples()[7777].date, on_square(7777).date);
}

TEST(KeptPath, KeepsTheLineOfADayInBoundedMemory) {
  KeptPath path;
  constexpr std::int64_t day = 864'000;
  for (std::int64_t i = 0; i < day; ++i) {
    path.add(on_square(i));
    ASSERT_LE(path.samples().size(), KeptPath::capacity);
  }
  EXPECT_EQ(path.samples().front().date, Time());
  EXPECT_EQ(path.samples().back().date, on_square(day - 1).date);
  EXPECT_EQ(path.samples().back().pose.heading, on_square(day - 1).pose.heading) << "what remains is exact";
  EXPECT_LE(path.tolerance_m(), 0.02) << "four corners a minute fit";
  for (std::int64_t i = 0; i < day; i += 7)
    ASSERT_LE(distance_to(path.samples(), on_square(i)), 2 * path.tolerance_m()) << "sample " << i;
}

TEST(KeptPath, KeepsAWildPathMoreCoarsely) {
  const RandomStream random(1, "", "path");
  KeptPath path;
  for (std::uint64_t i = 0; i < 100'000; ++i) {
    const double x = random.uniform(2 * i), y = random.uniform(2 * i + 1);
    path.add({Time::from_ns(static_cast<std::int64_t>(i)), {x, y, 0}});
    ASSERT_LE(path.samples().size(), KeptPath::capacity);
  }
  EXPECT_GT(path.tolerance_m(), 0.1);
}

}  // namespace
}  // namespace waitpoint::bridge
