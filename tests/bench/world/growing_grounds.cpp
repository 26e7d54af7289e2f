// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/bench/kernel/meter.hpp"
#include "tests/bench/world/contenders.hpp"
#include "tests/bench/world/crowds.hpp"
#include "tests/bench/world/grounds.hpp"

namespace waitpoint::bench {

void growing_grounds(bool quick, Figures& figures) {
  constexpr std::size_t least = 1000;
  // Near the border a scan leaves the place and finds nothing: the smaller the place, the more often.
  constexpr double square_m = 2, border_m = 24;
  double first_ns = 0;
  for (std::size_t obstacles = least; obstacles <= 1'000'000; obstacles *= 10) {
    const Place place = grounds(obstacles, square_m, 1000, border_m);
    const std::unique_ptr<Contender> ours = our_slice(place);
    double best_ns = HUGE_VAL;
    std::array<double, beams> ranges;
    for (int pass = 0; pass < (quick ? 3 : 15); ++pass) {
      const std::int64_t from = clock_ns(Clock::processor);
      for (const Pose& station : place.stations) ours->scan(station, ~0u, ranges);
      best_ns = std::min(best_ns, static_cast<double>(clock_ns(Clock::processor) - from) /
                                      static_cast<double>(place.stations.size() * beams));
    }
    Figure figure = {fmt::format("{} obstacles, a scan", obstacles), "waitpoint", best_ns, "ns a beam"};
    if (obstacles > least) {
      // Logarithmic: a thousand times the size may cost twice as much.
      const double growth = std::log(static_cast<double>(obstacles)) / std::log(static_cast<double>(least));
      figure.ratio = best_ns / first_ns;
      figure.must = Limit{growth, true};
    } else {
      first_ns = best_ns;
    }
    figures.add(figure);
  }
}

}  // namespace waitpoint::bench
