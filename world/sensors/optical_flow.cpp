// SPDX-License-Identifier: BSD-3-Clause
#include "world/sensors/optical_flow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace waitpoint::world {

OpticalFlow::Model::Model(const Description& description, std::uint64_t seed, std::string_view robot)
    : description_(description),
      noise_(seed, robot, "optical_flow.noise"),
      dropout_(seed, robot, "optical_flow.dropout") {
  WAITPOINT_CHECK(description.period > Duration(), "an optical flow sensor has no positive period");
}

void OpticalFlow::Model::reseed(std::uint64_t seed, std::string_view robot) {
  noise_ = RandomStream(seed, robot, "optical_flow.noise");
  dropout_ = RandomStream(seed, robot, "optical_flow.dropout");
}

void OpticalFlow::Model::moved(const StepDone& step, const BodyState& body) {
  const Description& d = description_;
  const double height_m = d.height_m + body.height_m;
  floor_m_ = elapsed_ == Duration() ? height_m : std::min(floor_m_, height_m);
  elapsed_ += step.length;
  if (height_m > 0) {
    // The way of the lens: the body's, and the turn about the body's centre.
    const Point way = {body.arc.distance_m - body.arc.turn_rad * d.mount.y,
                       body.arc.side_m + body.arc.turn_rad * d.mount.x};
    const auto [s, c] = exact::sincos(d.mount.heading);
    flow_rad_ = flow_rad_ + (1 / height_m) * Point{c * way.x + s * way.y, c * way.y - s * way.x};
  }
  if (step.now / d.period != (step.now - step.length) / d.period) read();
}

void OpticalFlow::Model::read() {
  const Description& d = description_;
  const std::uint64_t number = ++reading_.number;
  const bool too_fast = length(flow_rad_) > d.flow_max_rad_s * elapsed_.seconds();
  reading_.tracked = floor_m_ >= d.range_min_m && !too_fast && dropout_.uniform(number) >= d.dropout;
  if (reading_.tracked) {
    const double counts_per_rad = d.scale * d.counts_per_rad;
    counts_.x += counts_per_rad * flow_rad_.x + d.noise_counts * noise_.normal(number, 0);
    counts_.y += counts_per_rad * flow_rad_.y + d.noise_counts * noise_.normal(number, 1);
  }
  reading_.ahead_counts = reading_.tracked ? take_counts(counts_.x) : 0;
  reading_.left_counts = reading_.tracked ? take_counts(counts_.y) : 0;
  flow_rad_ = {};
  elapsed_ = {};
}

std::int32_t OpticalFlow::Model::take_counts(double& sum) {
  constexpr double least = std::numeric_limits<std::int16_t>::min(), most = std::numeric_limits<std::int16_t>::max();
  const double whole = std::clamp(std::nearbyint(sum), least, most);
  sum -= std::nearbyint(sum);
  return static_cast<std::int32_t>(whole);
}

}  // namespace waitpoint::world
