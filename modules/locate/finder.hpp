// SPDX-License-Identifier: BSD-3-Clause
// Global localisation: the place of a panorama on the whole map, found without any idea of it.
//
// Every new view starts a search (matching/correlative_search.hpp). A place is accepted if the map explains the
// panorama there, no other place does nearly as well, and the search after the next view finds the robot at the same
// place. So a building whose parts look alike gives no place until the robot has seen a difference.
#pragma once

#include <optional>
#include <span>

#include "core/occupancy_grid.hpp"
#include "modules/locate/panorama.hpp"
#include "modules/matching/correlative_search.hpp"

namespace waitpoint::locate {

/// A map's surfaces, prepared for tracking and for searches.
struct MapSurfaces {
  explicit MapSurfaces(const OccupancyGrid& map);

  matching::SurfaceMap fine, coarse;
  matching::ScorePyramid pyramid;  ///< of the coarse ones

 private:
  explicit MapSurfaces(const std::vector<matching::SurfacePoint>& points);
};

enum class Finding : std::uint8_t {
  unchanged,   ///< the scan was no new view
  too_little,  ///< the panorama has too few views
  nowhere,     ///< no place explains it
  ambiguous,   ///< several places do
  candidate,   ///< one place does; the next search must confirm it
  found,
};

class Finder {
 public:
  /// The surfaces must outlive the finder.
  Finder(const MapSurfaces& surfaces, const FindingParameters& parameters)
      : surfaces_(surfaces), parameters_(parameters), panorama_(parameters) {}

  /// Adds a scan in the robot's frame, made at a pose of the odometry's frame.
  Finding look(const Pose& odometry, std::span<const matching::SurfacePoint> scan);
  /// The robot's pose at the last scan, after `found`.
  const Pose& pose() const { return *candidate_; }

 private:
  const MapSurfaces& surfaces_;
  FindingParameters parameters_;
  Panorama panorama_;
  std::optional<Pose> candidate_;  // at the last view
  Pose odometry_;                  // at the last view
};

}  // namespace waitpoint::locate
