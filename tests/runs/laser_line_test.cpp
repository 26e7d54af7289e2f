// SPDX-License-Identifier: BSD-3-Clause
// A laser's serial line: the age of a scan in `sick` is its transmission time, to the microsecond.
#include <gtest/gtest.h>

#include "modules/posters/laser.hpp"
#include "tests/runs/shipped.hpp"
#include "tools/papers_modules.hpp"

namespace waitpoint::runs {
namespace {

using namespace std::chrono_literals;

template <class T>
std::optional<T> shown(const run::Experiment& experiment, const std::string& poster) {
  return dynamic_cast<const genom::Poster<T>&>(*experiment.robots()[0]->names().find_poster(poster)).look();
}

constexpr const char* slow_lms =
    "robot_types.rackham.lasers=[{name: laser, model: lms200, line_bit_s: 38400, period_ms: 200}]";

TEST(LaserLine, AScanReachesItsPosterWhenTheLastByteHasCome) {
  const std::vector<genom::ModuleType> types = tools::papers_modules();
  const scenario::Scenario scenario = shipped("office.yaml", {slow_lms});
  run::Experiment experiment(scenario, types, {1, kernel::Order::fifo, ""});
  Time now;
  const auto reading = [&] { return shown<posters::LaserReading>(experiment, "sick.reading"); };
  for (std::uint32_t number = 1; number <= 3; ++number) {
    while (!reading() || reading()->number < number) experiment.run_before(now += Duration(500us));
    // 732 bytes of 10 bits. run_before(t) executes the events before t.
    const Duration age = now - reading()->date;
    EXPECT_GT(age, Duration(190625us));
    EXPECT_LE(age, Duration(190625us + 500us));
    EXPECT_LT(now, Time() + Duration(1s));
  }
}

TEST(LaserLine, TheModuleDatesAScanBackToTheMiddleOfItsTurns) {
  const std::vector<genom::ModuleType> types = tools::papers_modules();
  const scenario::Scenario scenario =
      shipped("office.yaml", {slow_lms, "robot_types.rackham.modules.sick.scan_age_ms=10"});
  run::Experiment experiment(scenario, types, {1, kernel::Order::fifo, ""});
  experiment.run_before(Time() + Duration(1100ms));
  const auto reading = shown<posters::LaserReading>(experiment, "sick.reading");
  const auto echoes = shown<posters::Echoes>(experiment, "sick.echoes");
  const auto segments = shown<posters::Segments>(experiment, "sick.segments");
  ASSERT_TRUE(reading && echoes && segments);
  EXPECT_EQ(echoes->scan.number, reading->number);
  EXPECT_EQ(echoes->scan.date, reading->date - Duration(10ms));
  EXPECT_EQ(segments->date, echoes->scan.date);
}

}  // namespace
}  // namespace waitpoint::runs
