// SPDX-License-Identifier: BSD-3-Clause
#include "modules/outside/source_clock.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace waitpoint::outside {
namespace {

constexpr double leap_s_max = 10;

}  // namespace

std::optional<SourceClock::Kind> SourceClock::kind_of(const std::string& name) {
  if (name == "own") return Kind::own;
  if (name == "unix") return Kind::unix;
  if (name == "run") return Kind::run;
  return std::nullopt;
}

SourceClock::Dated SourceClock::date(double stamp_s, Time now, double unix_s) {
  const double now_s = now.seconds();
  if (last_s_ && stamp_s <= *last_s_)
    return {0, fmt::format("from the past: stamp {} s after {} s", stamp_s, *last_s_)};
  const double ahead_s = kind_ == Kind::unix  ? stamp_s - unix_s
                         : kind_ == Kind::run ? stamp_s - now_s
                         : last_s_            ? (stamp_s - *last_s_) - (now_s - last_now_s_)
                                              : 0;
  if (ahead_s > leap_s_max) return {0, fmt::format("from the future: stamp {} s is {:.3f} s ahead", stamp_s, ahead_s)};
  ahead_s_ = last_s_ ? std::min(ahead_s_, now_s - stamp_s) : now_s - stamp_s;
  last_s_ = stamp_s;
  last_now_s_ = now_s;
  switch (kind_) {
    case Kind::own: return {stamp_s + ahead_s_, ""};
    case Kind::unix: return {now_s - (unix_s - stamp_s), ""};
    case Kind::run: return {stamp_s, ""};
  }
  return {};
}

}  // namespace waitpoint::outside
