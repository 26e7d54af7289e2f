// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/io/medium.hpp"

#include "core/error.hpp"

namespace waitpoint::io {
namespace {

void expect(bool condition, const char* message) {
  if (!condition) throw BadInput("medium", message);
}

}  // namespace

void check(const Medium& medium) {
  expect(medium.latency_least > Duration(),
         "expected a positive latency: no robot may affect another at the same instant");
  expect(medium.latency_most >= medium.latency_least, "expected a least latency of at most the greatest");
  expect(medium.latency_most <= Duration(std::chrono::hours(24)), "expected a latency of at most a day");
  expect(medium.latency_per_metre >= Duration() && medium.latency_per_metre <= Duration(std::chrono::seconds(1)),
         "expected a latency per metre from 0 to 1 s");
  expect(medium.range_m > 0, "expected a positive range");
  expect(medium.loss >= 0 && medium.loss <= 1, "expected a loss from 0 to 1");
  expect(medium.range_check > Duration(), "expected a positive period to check the range");
}

Duration time_on_air(const Medium& medium, std::uint64_t bytes) {
  if (medium.bandwidth_bit_s == 0) return Duration();
  using Wide = unsigned __int128;
  const Wide ns = (Wide{bytes} * 8 * 1'000'000'000 + medium.bandwidth_bit_s - 1) / medium.bandwidth_bit_s;
  WAITPOINT_REQUIRE(ns <= static_cast<Wide>(Duration::max().ns()), "virtual time overflows");
  return Duration::from_ns(static_cast<std::int64_t>(ns));
}

}  // namespace waitpoint::io
