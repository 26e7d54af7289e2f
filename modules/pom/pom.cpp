// SPDX-License-Identifier: BSD-3-Clause
#include "modules/pom/pom.hpp"

namespace waitpoint::pom {

using genom::Nothing;
using genom::PosterStatus;
using genom::Report;
using namespace std::chrono_literals;

template <class Parameters>
Parameters Pom::read(genom::Settings& settings) {
  Parameters parameters;
  settings.read(parameters);
  if constexpr (std::is_same_v<Parameters, FusionParameters>) settings.check_not_negative(parameters);
  return parameters;
}

Pom::Pom(genom::ModuleSetup& setup)
    : Module(setup, 24),
      parameters_(read<FusionParameters>(setup.settings)),
      fix_parameters_(read<FixParameters>(setup.settings)),
      fusing_(add_task("fusing", {.period_ms = 40ms, .delay_ms = 10ms, .cost_us = 200us})),
      odometry_(read_poster<posters::Odometry>("rflex.odometry")),
      localisations_{{{segloc, read_poster<posters::Localisation>("segloc.localisation", false), {}},
                      {locate, read_poster<posters::Localisation>("locate.localisation", false), {}}}},
      gps_(fix_parameters_.gps ? &read_poster<world::Gps::Reading>("rflex.gps") : nullptr),
      position_(add_poster<posters::FusedPosition>("position", fusing_)) {
  fusing_.set_permanent([this] { fuse(); });
  add_control<posters::KnownPose>("SetPos",
                                  [this](const posters::KnownPose& known, Nothing&) { return set_position(known); });
  const auto switch_source = [this](bool on) {
    return [this, on](const SourceInput& input, Nothing&) -> Report {
      if (!fusion_ || input.source >= PositionFusion::source_count_max)
        return report(genom::StandardReport::control_codel_error);
      fusion_->set_source(input.source, on);
      return genom::ok;
    };
  };
  add_control<SourceInput>("SourceOn", switch_source(true));
  add_control<SourceInput>("SourceOff", switch_source(false));
}

Report Pom::set_position(const posters::KnownPose& known) {
  UncertainPose pose;
  pose.pose = known.pose;
  pose.covariance[0] = pose.covariance[4] = known.position_deviation_m * known.position_deviation_m;
  pose.covariance[8] = known.heading_deviation_rad * known.heading_deviation_rad;
  if (fusion_)
    fusion_->reset(threads::now(), pose);
  else
    fusion_.emplace(parameters_, pose);
  return genom::ok;
}

void Pom::fuse() {
  if (!fusion_) return;
  posters::Odometry odometry;
  if (odometry_.read(odometry) == PosterStatus::empty) return;
  fusion_->add_odometry(odometry.position);
  bool lost = false;
  for (Source& source : localisations_) {
    posters::Localisation localisation;
    if (source.poster.read(localisation) != PosterStatus::ok) continue;
    lost = lost || localisation.lost;
    if (localisation.position.date == source.date || localisation.lost) continue;
    source.date = localisation.position.date;
    if (localisation.jumps == source.jumps) {
      fusion_->add_absolute(source.number, localisation.position);
    } else {  // a pose found elsewhere than the fusion leads contradicts all that was fused
      source.jumps = localisation.jumps;
      fusion_->reset(source.date, {localisation.position.pose, localisation.position.covariance});
    }
  }
  world::Gps::Reading fix;
  if (gps_ != nullptr && gps_->read(fix) == PosterStatus::ok && fix.number != fix_number_) {
    fix_number_ = fix.number;
    fusion_->add_fix(receiver, fix.date, fix_at(fix.position, fix_parameters_), fix_parameters_.gps_gate);
  }
  posters::FusedPosition position = fusion_->at(threads::now());
  if (lost && position.state == posters::FusionState::good) position.state = posters::FusionState::uncertain;
  position_.write(position);
}

}  // namespace waitpoint::pom
