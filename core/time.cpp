// SPDX-License-Identifier: BSD-3-Clause
#include "core/time.hpp"

#include <cmath>
#include <cstdio>

namespace waitpoint {
namespace {

std::string seconds_text(std::int64_t ns) {
  const std::uint64_t magnitude = ns < 0 ? 0 - static_cast<std::uint64_t>(ns) : static_cast<std::uint64_t>(ns);
  char text[40];
  std::snprintf(text, sizeof text, "%s%llu.%09llu", ns < 0 ? "-" : "",
                static_cast<unsigned long long>(magnitude / 1'000'000'000),
                static_cast<unsigned long long>(magnitude % 1'000'000'000));
  return text;
}

}  // namespace

Duration Duration::from_seconds(double seconds) {
  const double ns = std::round(seconds * 1e9);
  WAITPOINT_CHECK(ns > -9.2e18 && ns < 9.2e18, "a duration in seconds is out of range");
  return from_ns(static_cast<std::int64_t>(ns));
}

Period Period::every(Duration d) {
  WAITPOINT_CHECK(d > Duration(), "a period must be positive");
  return Period(1, d);
}

Period Period::hertz(std::int64_t ticks) {
  WAITPOINT_CHECK(ticks > 0, "a rate must be positive");
  return Period(ticks, std::chrono::seconds(1));
}

Duration Period::tick(std::int64_t k) const {
  using Wide = __int128;
  const Wide product = static_cast<Wide>(k) * span_.ns();
  const Wide half = ticks_ / 2;
  const Wide rounded = (product >= 0 ? product + half : product - half) / ticks_;
  using Limits = std::numeric_limits<std::int64_t>;
  WAITPOINT_CHECK(rounded >= Limits::min() && rounded <= Limits::max(), "virtual time overflows");
  return Duration::from_ns(static_cast<std::int64_t>(rounded));
}

std::int64_t Period::first_tick_at_or_after(Duration d) const {
  WAITPOINT_CHECK(d >= Duration(), "a tick before the start of the run");
  const __int128 estimate = static_cast<__int128>(d.ns()) * ticks_ / span_.ns();
  std::int64_t k = static_cast<std::int64_t>(estimate);
  while (k > 0 && tick(k - 1) >= d) --k;
  while (tick(k) < d) ++k;
  return k;
}

std::string to_string(Time t) { return seconds_text(t.ns()); }
std::string to_string(Duration d) { return seconds_text(d.ns()); }

}  // namespace waitpoint
