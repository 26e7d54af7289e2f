// SPDX-License-Identifier: BSD-3-Clause
#include "modules/outside/source_clock.hpp"

#include <gtest/gtest.h>

namespace waitpoint::outside {
namespace {

using namespace std::chrono_literals;
using Kind = SourceClock::Kind;

TEST(SourceClock, OwnOriginIsDatedByTheReportWithTheLeastLag) {
  SourceClock clock;
  EXPECT_DOUBLE_EQ(clock.date(1000, Time() + 5s, 0).date_s, 5);
  EXPECT_DOUBLE_EQ(clock.date(1001, Time() + 6500ms, 0).date_s, 6) << "half a second late";
  EXPECT_DOUBLE_EQ(clock.date(1003, Time() + 7s, 0).date_s, 7) << "the first one was later: by a second";
  EXPECT_DOUBLE_EQ(clock.date(1004, Time() + 9s, 0).date_s, 8);
}

TEST(SourceClock, KnownOriginIsUsedAsItIs) {
  SourceClock unix(Kind::unix), run(Kind::run);
  EXPECT_DOUBLE_EQ(unix.date(1e9 - 0.25, Time() + 5s, 1e9).date_s, 4.75);
  EXPECT_DOUBLE_EQ(run.date(4.5, Time() + 5s, 1e9).date_s, 4.5);
}

TEST(SourceClock, RefusesThePastAndLeapsAhead) {
  for (const Kind kind : {Kind::own, Kind::run}) {
    SourceClock clock(kind);
    EXPECT_EQ(clock.date(5, Time() + 5s, 0).refused, "");
    EXPECT_EQ(clock.date(5, Time() + 6s, 0).refused, "from the past: stamp 5 s after 5 s");
    EXPECT_EQ(clock.date(100, Time() + 6s, 0).refused, "from the future: stamp 100 s is 94.000 s ahead");
    EXPECT_EQ(clock.date(6, Time() + 6s, 0).refused, "") << "what is refused has no effect";
  }
}

}  // namespace
}  // namespace waitpoint::outside
