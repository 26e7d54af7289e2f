// SPDX-License-Identifier: BSD-3-Clause
// Obstacles that move, by their echoes in successive scans, in the odometry frame.
//
// A scan is cut where neighbouring ranges differ by more than a gap. Pieces that nothing nearer hides in part, and that
// are no wider than a person or a robot, are taken as discs: of the angle that one fills and its range follow its
// centre and radius. The disc nearest to where a track is expected continues it; an alpha-beta filter estimates its
// velocity. A track that is not continued, since it is hidden or out of view, is kept for a second as it moved last.
#pragma once

#include <span>
#include <vector>

#include "modules/posters/laser.hpp"

namespace waitpoint::ndd {

struct Track {
  Point centre, velocity;  ///< when it was `seen`; in m/s
  double radius_m = 0;
  Time seen;
  std::uint32_t sightings = 0;

  Point at(Time date) const { return centre + (date - seen).seconds() * velocity; }
};

class ObstacleTracks {
 public:
  /// Adds a later scan than the last, made with the device at `device` in the odometry frame.
  void see(const Pose& device, const posters::LaserReading& scan);

  /// The tracks whose speed is more than the estimate's noise.
  std::span<const Track> moving() const { return moving_; }

 private:
  struct Disc {
    Point centre;
    double radius_m;
    bool taken;
  };
  void find_discs(const Pose& device, const posters::LaserReading& scan);
  void continue_tracks(Time date);

  std::vector<Disc> discs_;  // of the present scan
  std::vector<Track> tracks_, moving_;
};

}  // namespace waitpoint::ndd
