// SPDX-License-Identifier: BSD-3-Clause
// Robots drive back and forth in the office, and turn on contact. Their motions are recorded; the collision detection
// is measured on them, step by step.
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/random.hpp"
#include "tests/bench/kernel/meter.hpp"
#include "tests/bench/world/crowds.hpp"
#include "tests/bench/world/places.hpp"
#include "world/motion/meetings.hpp"
#include "world/slice/footprints.hpp"

namespace waitpoint::bench {
namespace {

using world::Arc;
using world::Meetings;
using world::Mover;
using world::Outline;

constexpr double step_s = 0.01, v_max_m_s = 0.9, w_max_rad_s = 0.5;

/// The state at the beginning of a step.
struct Step {
  std::vector<Outline> outlines;
  std::vector<Arc> arcs;
  std::vector<Meetings::Motion> motions;
};

class Office final : public world::MeetingPlace {
 public:
  explicit Office(const Place& place) : place_(place), footprints_(place.obstacles) {
    for (const world::Shape& shape : place.obstacles) obstacles_.push_back(world::outline_of(shape));
    own_.kind = world::Shape::Kind::cylinder;
    own_.radius_m = place.robots[0].radius_m;
  }
  void be(const Step& step) { step_ = &step; }

  const Outline& outline(std::uint32_t body) const override { return step_->outlines[body]; }
  Mover mover(std::uint32_t body) const override { return Mover(own_, step_->outlines[body], step_->arcs[body]); }
  void near(std::uint32_t, const world::Bounds& bounds, std::vector<std::uint32_t>& found) const override {
    const world::Heights any;
    footprints_.near(bounds, 0, any.low_m, any.high_m, found);
  }
  Mover obstacle(std::uint32_t obstacle) const override { return Mover(obstacles_[obstacle]); }
  double gap_m(std::uint32_t body, std::uint32_t obstacle) const override {
    return world::separation(outline(body), obstacles_[obstacle]).distance_m;
  }

  /// Records `count` steps of all robots; one in contact turns to a random heading.
  std::vector<Step> drive(std::size_t count) {
    const RandomStream stream(1, place_.name, "ways");
    std::vector<Step> steps;
    std::vector<Pose> poses(place_.stations.begin(), place_.stations.end());
    Meetings meetings(*this, place_.robots);
    for (std::size_t k = 0; k < count; ++k) {
      Step& step = steps.emplace_back();
      for (std::uint32_t i = 0; i < poses.size(); ++i) {
        const double v = v_max_m_s * (0.2 + 0.8 * stream.uniform(i)), w = w_max_rad_s * (2 * stream.uniform(i, 1) - 1);
        step.arcs.push_back(Arc::of(poses[i], {v, w}, step_s));
        step.outlines.push_back(world::outline_of(own_, poses[i]));
        step.motions.push_back({world::path_m(step.arcs[i], world::reach_m(own_)), true});
      }
      be(step);
      meetings.step(step.motions);
      for (std::uint32_t i = 0; i < poses.size(); ++i) {
        const std::optional<double> stop = meetings.stop(i);
        stops += stop ? 1 : 0;
        poses[i] = step.arcs[i].at(stop.value_or(1));
        if (stop) poses[i].heading = exact::pi * (2 * stream.uniform(i, 2 + k) - 1);
      }
    }
    return steps;
  }
  long stops = 0;

 private:
  const Place& place_;
  world::Footprints footprints_;
  std::vector<Outline> obstacles_;
  world::Shape own_;
  const Step* step_ = nullptr;
};

}  // namespace

void collisions_of_a_hundred(bool quick, Figures& figures) {
  const Place place = office(100);
  Office office(place);
  const std::vector<Step> steps = office.drive(2000);
  double best_us = HUGE_VAL;
  for (int pass = 0; pass < (quick ? 3 : 15); ++pass) {
    Meetings meetings(office, place.robots);
    long stops = 0;
    const std::int64_t from = clock_ns(Clock::processor);
    for (const Step& step : steps) {
      office.be(step);
      meetings.step(step.motions);
      for (std::uint32_t i = 0; i < step.motions.size(); ++i) stops += meetings.stop(i) ? 1 : 0;
    }
    best_us = std::min(
        best_us, 1e-3 * static_cast<double>(clock_ns(Clock::processor) - from) / static_cast<double>(steps.size()));
    WAITPOINT_CHECK(stops == office.stops, "the same steps, other stops");
  }
  const double a_second = static_cast<double>(office.stops) / (static_cast<double>(steps.size()) * step_s);
  figures.add(
      {"office, 100 robots: collisions", "waitpoint", best_us, "us a step", {}, Limit{10, true}, Limit{4, true}});
  figures.add({"office, 100 robots: collisions", "waitpoint", a_second, "contacts a simulated second"});
}

}  // namespace waitpoint::bench
