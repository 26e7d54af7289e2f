// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/surveyor.hpp"

#include "modules/executive/looks.hpp"

namespace waitpoint::executive {

using genom::PosterStatus;

void Surveyor::connect(const genom::NameSpace& names) {
  connect_for_executive(names, position_);
  connect_for_executive(names, echoes_);
  connect_for_executive(names, odometry_);
}

void Surveyor::look() {
  posters::Odometry odometry;
  if (odometry_.read(odometry) == PosterStatus::ok) trail_.add(odometry.position.date, odometry.position.pose);
  posters::FusedPosition position;
  if (trail_.empty() || position_.read(position) == PosterStatus::empty) return;
  if (echoes_.read(scan_) == PosterStatus::empty || scan_.scan.number == number_) return;
  number_ = scan_.scan.number;
  const Pose since = between(trail_.at(position.position.date), trail_.at(scan_.scan.date));
  seen_.add(compose(compose(position.position.pose, since), scan_.mount), scan_.scan);
}

}  // namespace waitpoint::executive
