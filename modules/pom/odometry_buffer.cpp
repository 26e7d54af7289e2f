// SPDX-License-Identifier: BSD-3-Clause
#include "modules/pom/odometry_buffer.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace waitpoint::pom {
namespace {

double ratio(Duration a, Duration b) { return static_cast<double>(a.ns()) / static_cast<double>(b.ns()); }

}  // namespace

OdometryBuffer::OdometryBuffer(std::size_t capacity) : capacity_(capacity) {
  WAITPOINT_CHECK(capacity >= 2, "a buffer too small to interpolate in");
}

const OdometryBuffer::Dated& OdometryBuffer::at_index(std::size_t i) const {
  WAITPOINT_CHECK(i < count_, "no such pose in the buffer");
  return ring_[(first_ + i) % ring_.size()];
}

void OdometryBuffer::add(Time date, const UncertainPose& pose) {
  std::size_t place = count_;
  while (place > 0 && at_index(place - 1).date >= date) --place;
  if (place < count_ && at_index(place).date == date) return;
  if (full()) {
    if (place == 0) return;
    first_ = (first_ + 1) % ring_.size();
    --count_;
    --place;
  }
  ++count_;
  if (ring_.size() < count_) ring_.emplace_back();
  for (std::size_t i = count_ - 1; i > place; --i) at_index(i) = at_index(i - 1);
  at_index(place) = {date, pose};
}

UncertainPose OdometryBuffer::at(Time date, Duration horizon) const {
  if (date <= oldest()) return at_index(0).estimate;
  if (date >= newest()) {
    const Dated& last = at_index(count_ - 1);
    const Duration ahead = std::min(date - last.date, horizon);
    if (count_ < 2 || ahead == Duration()) return last.estimate;
    const Dated& before = at_index(count_ - 2);
    const UncertainPose step = increment(before.estimate, last.estimate);
    return compose(last.estimate, part_of(step, ratio(ahead, last.date - before.date)));
  }
  std::size_t low = 0, high = count_ - 1;  // date of low <= date < date of high
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (at_index(middle).date <= date ? low : high) = middle;
  }
  const Dated &before = at_index(low), &after = at_index(high);
  const double fraction = ratio(date - before.date, after.date - before.date);
  return compose(before.estimate, part_of(increment(before.estimate, after.estimate), fraction));
}

UncertainPose OdometryBuffer::motion(Time from, Time to, Duration horizon) const {
  return increment(at(from), at(to, horizon));
}

}  // namespace waitpoint::pom
