// SPDX-License-Identifier: BSD-3-Clause
// The position fusion with a bug that few schedules show: late data is applied by its order of arrival, not by its
// date. `mended_pom` is the same without the bug.
#include <optional>
#include <waitpoint/modules/genom/module.hpp>
#include <waitpoint/modules/pom/position_fusion.hpp>
#include <waitpoint/modules/posters/navigation.hpp>
#include <waitpoint/modules/posters/position.hpp>
#include <waitpoint/tools/main.hpp>

using namespace std::chrono_literals;
using waitpoint::Duration;
using waitpoint::Time;
using waitpoint::genom::PosterStatus;
namespace posters = waitpoint::posters;
namespace pom = waitpoint::pom;

template <bool by_arrival>
class Pom : public waitpoint::genom::Module {
 public:
  explicit Pom(waitpoint::genom::ModuleSetup& setup)
      : Module(setup, 24),
        fusing_(add_task("fusing", {.period_ms = 40ms, .delay_ms = 10ms, .cost_us = 200us})),
        odometry_(read_poster<posters::Odometry>("rflex.odometry")),
        localisation_(read_poster<posters::Localisation>("segloc.localisation", false)),
        position_(add_poster<posters::FusedPosition>("position", fusing_)) {
    fusing_.set_permanent([this] { fuse(); });
    add_control<posters::KnownPose>("SetPos", [this](const posters::KnownPose& known, waitpoint::genom::Nothing&) {
      posters::UncertainPose pose;
      pose.pose = known.pose;
      pose.covariance[0] = pose.covariance[4] = known.position_deviation_m * known.position_deviation_m;
      pose.covariance[8] = known.heading_deviation_rad * known.heading_deviation_rad;
      fusion_.emplace(pom::FusionParameters(), pose);
      return waitpoint::genom::ok;
    });
  }

 private:
  void fuse() {
    posters::Odometry odometry;
    if (!fusion_ || odometry_.read(odometry) == PosterStatus::empty) return;
    fusion_->add_odometry(odometry.position);
    posters::Localisation localisation;
    if (localisation_.read(localisation) == PosterStatus::ok && localisation.position.date != localised_) {
      localised_ = localisation.position.date;
      // There is a scan every 100 ms: the n-th position is taken for that of the n-th scan. A position that is
      // overwritten before it is read never arrives, and from then on each is dated one scan too early.
      if (by_arrival) {
        expected_ = expected_ ? *expected_ + Duration(100ms) : localised_;
        localisation.position.date = *expected_;
      }
      fusion_->add_absolute(0, localisation.position);
    }
    position_.write(fusion_->at(waitpoint::threads::now()));
  }

  waitpoint::genom::ExecutionTask& fusing_;
  waitpoint::genom::PosterLink<posters::Odometry>& odometry_;
  waitpoint::genom::PosterLink<posters::Localisation>& localisation_;
  waitpoint::genom::OutputPoster<posters::FusedPosition>& position_;
  std::optional<pom::PositionFusion> fusion_;
  Time localised_;
  std::optional<Time> expected_;
};

int main(int argc, char** argv) {
  using waitpoint::genom::module_type;
  return waitpoint::main(argc, argv, {module_type<Pom<true>>("late_pom"), module_type<Pom<false>>("mended_pom")});
}
