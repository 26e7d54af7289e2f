// SPDX-License-Identifier: BSD-3-Clause
// Search of a window of poses, as large as a building, for those at which a map explains a scan best, by branch and
// bound:
//
//   level 2   [        one block of 4 x 4 cells        ]     a score of which no pose in the block has a greater
//   level 1   [   2 x 2   ][   2 x 2   ] ...
//   level 0   [ 1 ][ 1 ] ...                                 the score of a pose
//
// The best block is opened first, so that the first pose reached is the best one, and the next ones that are not beside
// it are its rivals: a scan that fits at several places is ambiguous.
//
// Sources: Olson, "Real-time correlative scan matching", ICRA 2009; Hess, Kohler, Rapp, Andor, "Real-time loop closure
// in 2D LIDAR SLAM", ICRA 2016.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "modules/matching/surface_map.hpp"

namespace waitpoint::matching {

/// The scores of a map, and their maxima over blocks of cells.
class ScorePyramid {
 public:
  ScorePyramid(const SurfaceMap& map, unsigned levels);

  double cell_m() const { return cell_m_; }
  unsigned levels() const { return static_cast<unsigned>(levels_.size()); }
  /// Level 0: the score of the cell; level h: the maximum over all cells less than 2^h columns and rows beyond it, or
  /// of some more cells. 0 outside the map.
  std::uint8_t bound(unsigned level, int x, int y) const {
    const Level& l = levels_[level];
    const int bx = ((x - x_) >> level) + l.margin, by = ((y - y_) >> level) + l.margin;
    if (bx < 0 || by < 0 || bx >= l.width || by >= l.height) return 0;
    return l.values[static_cast<std::size_t>(by) * static_cast<std::size_t>(l.width) + static_cast<std::size_t>(bx)];
  }
  int column(double coordinate_m) const;
  /// The extent of the map, in cells.
  int x() const { return x_; }
  int y() const { return y_; }
  int width() const { return levels_[0].width; }
  int height() const { return levels_[0].height; }

 private:
  struct Level {
    int width = 0, height = 0, margin = 0;
    std::vector<std::uint8_t> values;
  };
  double cell_m_;
  int x_, y_;
  std::vector<Level> levels_;
};

struct SearchWindow {
  Pose centre;
  double half_width_m = 1, half_height_m = 1, half_turn_rad = 0.5;  ///< about the centre
};

struct SearchParameters {
  double score_min = 0.5;                 ///< of a pose: the mean of its points' scores, from 0 to 1
  double rival_share = 0.9;               ///< a rival has at least this share of the best score
  double apart_m = 0.5, apart_rad = 0.2;  ///< poses nearer than both are one
  unsigned peaks_max = 2;
  std::uint32_t openings_max = 200000;  ///< of blocks; a search that needs more ends without a result
  double spacing_m = 0.1;               ///< of the scan's points that are used
  double arm_m = 8;                     ///< a step of the heading moves a point at this distance by a cell
};

struct Peak {
  Pose pose;
  double score = 0;
};

/// The best pose of a window and its rivals, best first; none if no score is sufficient.
std::vector<Peak> search(const ScorePyramid& pyramid, std::span<const SurfacePoint> scan, const SearchWindow& window,
                         const SearchParameters& parameters);

}  // namespace waitpoint::matching
